"""Coherence of single images: the amplitudes γ_i whose product is that of a pair."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .budget import CoherenceBudget

if TYPE_CHECKING:
    from ..errors import ErrorBudget
    from ..radar import Radar
    from ..scene import Scene

Array = NDArray[np.float64]


def image_amplitude(scene: Scene, *, radar: Radar, errors: ErrorBudget) -> Array:
    """Amplitude γ_i of each image in each segment.

    Parameters
    ----------
    scene : the S segments.
    radar : the radar and its M images.
    errors : the error budget, for its coherence budget.

    Returns
    -------
    (S, M) — γ_i, below 1; γ_i γ_j is the coherence of a pair but for what depends on the pair:
    common bands, volume, time.

    Raises
    ------
    ValueError
        If the budget has another number of segments or images.

    Notes
    -----
    Noise of images is independent from image to image, so that the coherence matrix of these
    factors is γγᵀ off its diagonal: of rank one plus a diagonal.
    """
    return np.sqrt(
        _squared_amplitude(
            len(scene), len(radar.images), radar.snr, radar.other_coherence, errors.coherence
        )
    )


def largest_amplitude(*, radar: Radar, errors: ErrorBudget) -> Array:
    """Largest amplitude γ_i of each image over the segments, (M,): what bounds rest on.

    Parameters
    ----------
    radar, errors : as for `image_amplitude`.
    """
    budget = errors.coherence
    lists = (budget.relative_snr, budget.rasr, budget.aasr)
    segments = max(len(values) if isinstance(values, tuple) else 1 for values in lists)
    squared = _squared_amplitude(
        segments, len(radar.images), radar.snr, radar.other_coherence, budget
    )
    return np.asarray(np.sqrt(squared.max(axis=0)))


def image_snr(scene: Scene, *, radar: Radar, errors: ErrorBudget) -> Array:
    """Signal-to-noise ratio of each image in each segment, (S, M), as a power ratio.

    Parameters
    ----------
    scene, radar, errors : as for `image_amplitude`.
    """
    return _snr(len(scene), len(radar.images), radar.snr, errors.coherence)


@lru_cache(maxsize=64)
def _squared_amplitude(
    segments: int, images: int, snr: float, other: float, budget: CoherenceBudget
) -> Array:
    squared = other / (1.0 + 1.0 / _snr(segments, images, snr, budget))
    for name, factor in budget.single_image_factors().items():
        squared = squared * _of_segments(factor, segments, name)[:, None]
    squared.setflags(write=False)
    return squared


def _snr(segments: int, images: int, snr: float, budget: CoherenceBudget) -> Array:
    relative = _of_segments(np.asarray(budget.relative_snr), segments, "relative_snr")
    each = np.asarray(budget.image_snr or 1.0, dtype=np.float64)
    if each.ndim and len(each) != images:
        raise ValueError(
            f"image_snr holds {len(each)} numbers, but there are {images} images; each needs one"
        )
    return np.asarray(snr * relative[:, None] * np.broadcast_to(each, (images,)))


def _of_segments(values: Array, segments: int, name: str) -> Array:
    if values.ndim and len(values) != segments:
        raise ValueError(
            f"{name} holds {len(values)} numbers, but the scene has {segments} segments; "
            "give one for each, or one for all"
        )
    return np.broadcast_to(values, (segments,))
