"""The coherence of each pair, factor by factor: what a report shows of the budget."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .coherence import common_band, image_snr, volume_bias
from .errors import BaselineDecorrelation, ErrorBudget
from .image_model import ImageModel, image_model
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]


class PairBudget(NamedTuple):
    """Factors of the coherence of K pairs of images.

    Attributes
    ----------
    factors : name → (..., S, K) — magnitudes, whose product is the coherence of the parts of the
        spectrum that the two images share: noise, quantization, ambiguities, coregistration,
        processing, other, volume, temporal.
    common_range, common_azimuth : (..., S, K) — shares of the bands in common; of the coherence
        where bands are not filtered, of the looks where they are.
    volume_bias : (..., S, K) — height above the ground that the pair reports of a volume [m]; None
        without one.
    """

    factors: dict[str, Array]
    common_range: Array
    common_azimuth: Array
    volume_bias: Array | None


def pair_budget(
    positions: ArrayLike, scene: Scene, *, radar: Radar, errors: ErrorBudget
) -> PairBudget:
    """Split the coherence of each pair into its factors.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar, whose `image_pairs` order the K pairs.
    errors : the error budget.

    Returns
    -------
    PairBudget — of (..., S, K) arrays.

    Notes
    -----
    The bias is what the pair's own phase makes of the volume, against the ground; an estimate that
    knows the profile has none. It is no part of the height error, which is a deviation.
    """
    images = image_model(positions, scene, radar=radar, errors=errors)
    first, second = radar.image_pairs.T
    shape = (*images.range_offset.shape[:-1], len(first))
    snr = image_snr(scene, radar=radar, errors=errors)
    kept = np.sqrt(1.0 / (1.0 + 1.0 / snr))
    factors = {"noise": kept[:, first] * kept[:, second]}
    for name, factor in errors.coherence.single_image_factors().items():
        factors[name] = factor[:, None] if factor.ndim else factor
    factors["other"] = np.asarray(radar.other_coherence)
    bias = None
    if images.volume is not None:
        volume = np.conj(images.volume[..., first, second])  # of the phase φ_j − φ_i
        factors["volume"] = np.abs(volume)
        kz = images.vertical_wavenumber
        bias = volume_bias(volume, kz[..., second] - kz[..., first])
    if images.temporal is not None:
        factors["temporal"] = images.temporal[..., first, second]
    across, along = _common_bands(images, first, second, errors)
    return PairBudget(
        factors={name: np.broadcast_to(value, shape) for name, value in factors.items()},
        common_range=np.broadcast_to(across, shape),
        common_azimuth=np.broadcast_to(along, shape),
        volume_bias=bias,
    )


def _common_bands(
    images: ImageModel,
    first: NDArray[np.intp],
    second: NDArray[np.intp],
    errors: ErrorBudget,
) -> tuple[Array, Array]:
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        return np.ones(()), np.ones(())
    across = common_band(images.range_offset[..., first], images.range_offset[..., second])
    doppler = images.doppler_offset
    if doppler is None:
        return across, np.ones(())
    return across, common_band(doppler[..., first], doppler[..., second])
