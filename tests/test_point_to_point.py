"""Point-to-point height error by phase noise."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    height_error,
    one_transmitter,
    phase_model,
    point_to_point_error,
)
from insar.statistics import difference_quantile

SCENE = Scene.broadside_strip(
    times=[0.0, 1.0], look_angle=np.deg2rad(30), altitude=514e3, earth_radius=6_371_000.0
)
BUDGET = ErrorBudget(position=ErrorSource(0.001, SharedBy.SATELLITE))


def radar_for(count, looks):
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=4.0,
        looks=looks,
        images=one_transmitter(count),
    )


def cross_track(*offsets):
    positions = np.zeros((2, len(offsets), 3))
    positions[..., 2] = offsets
    return positions


@pytest.mark.parametrize("looks", [1.5, 4.0, 16.0])
def test_two_images_are_the_quantile_times_the_height_of_ambiguity(looks):
    radar, positions = radar_for(2, looks), cross_track(0.0, 260.0)
    model = phase_model(positions, SCENE, radar=radar, errors=BUDGET)
    ambiguity = 2 * math.pi / np.abs(model.vertical_wavenumber[:, 1])
    band = 1 - np.abs(positions[0, 1, 2]) * math.cos(math.radians(30)) / (
        # B_crit of each image, with B⊥ = B cos θ at broadside
        radar.wavelength * SCENE.slant_range * np.tan(SCENE.incidence) / 3.0
    )
    expected = difference_quantile(0.8, looks=looks * band) * ambiguity / (2 * math.pi)
    bound = point_to_point_error(positions, SCENE, radar=radar, errors=BUDGET)
    assert_allclose(bound, expected, rtol=1e-6)


def test_many_looks_are_normal():
    """At 2000 looks the bound is 1.6449·√2 deviations, for any number of images."""
    for offsets in ((0.0, 260.0), (0.0, 200.0, 500.0)):
        radar, positions = radar_for(len(offsets), 2000.0), cross_track(*offsets)
        error = height_error(positions, SCENE, radar=radar, errors=BUDGET)
        bound = point_to_point_error(positions, SCENE, radar=radar, errors=BUDGET)
        assert_allclose(bound / error.relative, 1.64485 * math.sqrt(2), rtol=1e-3)


def test_a_better_level_is_a_wider_bound():
    radar, positions = radar_for(3, 8.0), cross_track(0.0, 200.0, 500.0)
    bounds = [
        point_to_point_error(positions, SCENE, radar=radar, errors=BUDGET, level=level)
        for level in (0.5, 0.9, 0.99)
    ]
    assert np.all(np.diff(bounds, axis=0) > 0)


def test_without_a_height_there_is_no_bound():
    for positions in (cross_track(0.0, 0.0), cross_track(0.0, 50e3)):
        bound = point_to_point_error(positions, SCENE, radar=radar_for(2, 4.0), errors=BUDGET)
        assert np.all(np.isinf(bound))


def test_batches_equal_single_designs():
    rng = np.random.default_rng(4)
    positions = rng.uniform(-400, 400, (3, 2, 3, 3))
    arguments = {"radar": radar_for(3, 4.0), "errors": BUDGET}
    batch = point_to_point_error(positions, SCENE, **arguments)
    single = [point_to_point_error(one, SCENE, **arguments) for one in positions]
    assert_allclose(batch, single, rtol=1e-12)
