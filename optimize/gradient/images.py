"""The bands of the images as the derivatives need them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, ErrorBudget, PhaseStatistics, Radar
from insar.baselines import scene_critical_baseline
from insar.coherence import doppler_offset
from insar.image_model import image_model
from insar.statistics import efficiency_curves

from ..population import Population
from ..problem import Problem
from .edges import Bands

Array = NDArray[np.float64]


def bands_of(population: Population, problem: Problem) -> Bands | None:
    """Bands of the images of the first formation of a population.

    Parameters
    ----------
    population : from `problem`.
    problem : what it is scored by.

    Returns
    -------
    Bands; None where a factor belongs to pairs of images and not to single ones.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    images = image_model(population.positions[0], scene, radar=radar, errors=errors)
    if images.pair_factor is not None:
        return None
    squared = images.amplitude**2
    weight = np.broadcast_to(squared / (1.0 - squared), images.range_offset.shape)
    efficiency = _efficiency(images.amplitude, radar, errors)
    rate = 1.0 / scene_critical_baseline(scene, radar)
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        nothing = np.zeros_like(images.range_offset)
        return Bands(nothing, None, weight, radar.looks, 0.0 * rate, None, efficiency)
    along = images.doppler_offset
    slope = None
    if along is not None and radar.azimuth_resolution is not None:
        slope = doppler_offset(
            1.0,
            wavelength=radar.wavelength,
            slant_range=scene.slant_range,
            azimuth_resolution=radar.azimuth_resolution,
        )
    return Bands(images.range_offset, along, weight, radar.looks, rate, slope, efficiency)


def _efficiency(
    amplitude: Array, radar: Radar, errors: ErrorBudget
) -> Callable[[Array], Array] | None:
    """Common areas of the bands (S, M, M) → efficiency of the pairs; None under Cramér-Rao."""
    if errors.phase_statistics is PhaseStatistics.CRAMER_RAO:
        return None
    curves = efficiency_curves(amplitude[:, :, None] * amplitude[:, None, :])
    return lambda area: curves(radar.looks * area)
