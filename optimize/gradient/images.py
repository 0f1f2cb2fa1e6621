"""The bands of the images as the derivatives need them."""

from __future__ import annotations

import numpy as np

from insar import BaselineDecorrelation
from insar.baselines import image_projections, scene_critical_baseline, sensitivity

from ..constraints import Population
from ..problem import Problem
from .edges import Bands


def bands_of(population: Population, problem: Problem) -> Bands | None:
    """Bands of the images of the first formation of a population.

    Parameters
    ----------
    population : from `problem`.
    problem : what it is scored by.

    Returns
    -------
    Bands; None where the coherence model is not one of single images.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    projected = image_projections(
        population.positions[0], sensitivity(scene, errors.held_constant), radar=radar
    )
    rate = 1.0 / scene_critical_baseline(scene, radar)
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        rate = np.zeros_like(rate)
    squared = radar.image_coherence**2
    return Bands(
        range_offset=projected[..., 0] * rate[:, None],
        doppler_offset=None,
        weight=np.full(projected.shape[:-1], squared / (1.0 - squared)),
        looks=radar.looks,
        range_rate=rate,
        doppler_rate=None,
        efficiency=None,
    )
