"""Draws the pixels of one segment and estimates their heights."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import Scale
from ..phase_model import PhaseModel
from ..unwrapping import unwrapping_ladder
from .combining import linked_data
from .estimators import Processor, along_ladder, bootstrapped, likely_heights
from .linking import linked_phases
from .nature import Nature

Array = NDArray[np.float64]

_CHUNK = 12_000_000
"""Numbers of the largest array that lives at a time."""


class Draw(NamedTuple):
    """Height errors of pixels, (draws, pixels), those of a draw with the same scene-wide errors.

    Attributes
    ----------
    right_cycles : of weighted least squares with every cycle right [m].
    unwrapped : of the same estimate with the cycles that bootstrapping finds [m].
    right : whether it finds all of them.
    most_likely : of maximum likelihood with the prior height [m].
    mean : of the posterior mean [m].
    prior : of the height known beforehand [m].
    """

    right_cycles: Array
    unwrapped: Array
    right: NDArray[np.bool_]
    most_likely: Array
    mean: Array
    prior: Array


def draw(
    nature: Nature,
    *,
    prior_height_std: float,
    draws: int,
    pixels: int,
    rng: np.random.Generator,
) -> Draw:
    """Draw pixels and estimate their heights.

    Parameters
    ----------
    nature : the segment.
    prior_height_std : scalar — standard deviation of the height known beforehand [m].
    draws : of the errors that stay the same over the scene.
    pixels : of each draw.
    rng : source of random numbers.
    """
    count = len(nature.vertical_wavenumber)
    per_sample = max(count * count * 8, count * 600)
    size = max(1, _CHUNK // (per_sample * pixels))
    chunks = [
        _draw_chunk(nature, prior_height_std, min(size, draws - start), pixels, rng)
        for start in range(0, draws, size)
    ]
    return Draw(*(np.concatenate(parts) for parts in zip(*chunks, strict=True)))


def _draw_chunk(
    nature: Nature, prior_height_std: float, draws: int, pixels: int, rng: np.random.Generator
) -> Draw:
    shape, samples = (draws, pixels), draws * pixels
    kz = nature.vertical_wavenumber
    height = prior_height_std * rng.standard_normal(samples)
    scene_wide = rng.standard_normal((draws, nature.scene_factor.shape[-1])) @ nature.scene_factor.T
    own = rng.standard_normal((samples, nature.pixel_factor.shape[-1])) @ nature.pixel_factor.T
    shared = np.repeat(scene_wide, pixels, axis=0) + own
    moved = nature.scene_height_std * np.repeat(rng.standard_normal(draws), pixels)
    moved += nature.pixel_height_std * rng.standard_normal(samples)
    data = linked_data(nature, samples=samples, rng=rng)
    linked = linked_phases(data, rng=rng)

    processor = _processor(nature, prior_height_std)
    truth = height[:, None] * kz + shared
    noise = along_ladder(linked, pairs=processor.pairs)
    wrapped = np.angle(np.exp(1j * (truth + linked)))
    found = bootstrapped(processor, wrapped, truth=truth, noise=noise)
    likely = likely_heights(processor, wrapped, data=data, true_phase=truth)
    errors = (
        processor.height(truth + noise) - height,
        processor.height(found.phase) - height,
        likely.most_likely - height,
        likely.mean - height,
    )
    right, unwrapped, most_likely, mean = ((error + moved).reshape(shape) for error in errors)
    return Draw(
        right, unwrapped, found.right.reshape(shape), most_likely, mean, height.reshape(shape)
    )


def _processor(nature: Nature, prior_height_std: float) -> Processor:
    model = PhaseModel(
        vertical_wavenumber=nature.vertical_wavenumber[None],
        information=nature.information[None],
        nuisance={"shared": nature.factor[None]},
        pair_variance={},
        scale={"shared": Scale.SCENE},
    )
    return Processor(
        vertical_wavenumber=model.vertical_wavenumber,
        information=model.information,
        factor=model.nuisance["shared"],
        pairs=unwrapping_ladder(model, prior_height_std=prior_height_std).pairs,
        prior_height_std=prior_height_std,
    )
