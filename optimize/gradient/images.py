"""The bands of the images as the derivatives need them."""

from __future__ import annotations

import numpy as np

from insar import BaselineDecorrelation
from insar.baselines import scene_critical_baseline
from insar.coherence import doppler_offset
from insar.image_model import image_model

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
    Bands; None where a factor belongs to pairs of images and not to single ones.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    images = image_model(population.positions[0], scene, radar=radar, errors=errors)
    if images.pair_factor is not None:
        return None
    squared = images.amplitude**2
    weight = np.broadcast_to(squared / (1.0 - squared), images.range_offset.shape)
    rate = 1.0 / scene_critical_baseline(scene, radar)
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        nothing = np.zeros_like(images.range_offset)
        return Bands(nothing, None, weight, radar.looks, 0.0 * rate, None, None)
    along = images.doppler_offset
    slope = None
    if along is not None and radar.azimuth_resolution is not None:
        slope = doppler_offset(
            1.0,
            wavelength=radar.wavelength,
            slant_range=scene.slant_range,
            azimuth_resolution=radar.azimuth_resolution,
        )
    return Bands(images.range_offset, along, weight, radar.looks, rate, slope, None)
