"""Offset, tilt, calibration, relative and absolute errors: printed values and simulations."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scale,
    Scene,
    SharedBy,
    height_error,
    point_to_point_error,
)
from insar.accuracy import NORMAL_90, Cell, height_accuracy
from insar.atmosphere import TEC_UNIT, Ionosphere
from insar.calibration import (
    Calibration,
    area_variance,
    baseline_offset,
    baseline_tilt,
    calibrated_covariance,
    synchronization_height_error,
)
from insar.statistics import difference_quantile
from insar.statistics.quick import quick_difference_quantile
from insar.swath import across_swath

CALIBRATION = Calibration(
    swath=30e3, length=100e3, spacing_across=10e3, spacing_along=5e3, accuracy=0.8
)
RADAR = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0, images=((0, 0), (0, 1))
)
STRIP = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(32.0), altitude=514e3, earth_radius=6371e3
)


def _pair(scene, perpendicular, parallel=0.0):
    """Two satellites in the plane of incidence, (1, 2, 3)."""
    look = scene.look_angle[0]
    height = np.array([np.sin(look), 0.0, np.cos(look)])
    return np.stack([np.zeros(3), perpendicular * height + parallel * scene.line_of_sight[0]])[None]


def test_published_baseline_errors():
    tilt = baseline_tilt(1e-3, perpendicular_baseline=260.0)
    assert 1e6 * tilt == pytest.approx(3.85, abs=5e-3)  # mm/km
    offset = baseline_offset(1e-3, height_of_ambiguity=35.0, wavelength=0.0311)
    assert offset == pytest.approx(1.13, abs=5e-3)
    assert synchronization_height_error(2 * np.pi, height_of_ambiguity=45.0) == pytest.approx(45.0)


def test_offset_of_two_satellites_is_the_published_form():
    positions = _pair(STRIP, 250.0)
    errors = ErrorBudget(position=ErrorSource(1e-3 / np.sqrt(2.0), SharedBy.SATELLITE))
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=errors)
    ambiguity = 0.031 * STRIP.slant_range * np.sin(STRIP.incidence) / 250.0
    expected = baseline_offset(1e-3, height_of_ambiguity=ambiguity, wavelength=0.031)
    assert accuracy.sources["position"].offset == pytest.approx(expected)


def test_tilt_of_a_flat_earth_in_closed_form():
    """h = y δB∥/B⊥ for the component along û, and y dδB∥/dy of the one across it."""
    look, height = np.deg2rad(32.0), 514e3
    flat = Scene.flat_earth(
        times=[0.0], slant_range=[height / np.cos(look)], look_angle=[look], azimuth=[np.pi / 2]
    )
    errors = ErrorBudget(position=ErrorSource(1e-3 / np.sqrt(2.0), SharedBy.SATELLITE))
    # A narrow swath: the closed form is a derivative.
    accuracy = height_accuracy(
        _pair(flat, 250.0), flat, radar=RADAR, errors=errors, cell=Cell(swath=1e3)
    )
    along = baseline_tilt(1e-3, perpendicular_baseline=250.0)
    across = along * np.sin(look) * np.cos(look)  # δB⊥ turns into δB∥ as û turns
    assert accuracy.sources["position"].tilt == pytest.approx(np.hypot(along, across), rel=1e-4)


def test_offset_and_tilt_by_solving_for_the_target():
    """Displace a satellite, locate the target by range, and look at its height at both edges."""
    positions, shift = _pair(STRIP, 250.0, 40.0), np.array([0.7e-3, 0.0, 0.4e-3])
    heights = {}
    for place in (-15e3, 0.0, 15e3):
        scene = across_swath(STRIP, place)
        target = scene.slant_range[0] * scene.line_of_sight[0]
        up = scene.vertical[0]
        tangent = np.array([up[2], 0.0, -up[0]])

        def ranges(dh, dy, true, target=target, up=up, tangent=tangent):
            point = target + dh * up + dy * tangent
            return np.array([np.linalg.norm(point - p) for p in true])

        step = 1e-2
        measured = ranges(0.0, 0.0, positions[0])
        believed = positions[0] + np.array([np.zeros(3), shift])
        at = ranges(0.0, 0.0, believed)
        jacobian = np.stack(
            [
                (ranges(step, 0.0, believed) - at) / step,
                (ranges(0.0, step, believed) - at) / step,
            ],
            axis=-1,
        )
        heights[place] = np.linalg.solve(jacobian, measured - at)[0]
    errors = ErrorBudget(position=ErrorSource(1e-3, SharedBy.SATELLITE))
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=errors)

    # The same displacement through the covariance of the model: an error of 1 mm in any direction
    # gives what the model says; of this one, the part of û that it has at each place.
    def predicted(place):
        scene = across_swath(STRIP, place)
        geometry = positions[0, 1] - positions[0, 0]
        normal = np.array([np.sin(scene.look_angle[0]), 0.0, np.cos(scene.look_angle[0])])
        lever = scene.slant_range[0] * np.sin(scene.incidence[0]) / (geometry @ normal)
        return lever * (shift @ scene.line_of_sight[0])

    for place, height in heights.items():
        # Sign: the believed satellite lies nearer by û·δp. Curvature B/r is 5e-4.
        assert abs(height) == pytest.approx(abs(predicted(place)), rel=2e-3)
    tilt = (abs(heights[15e3]) - abs(heights[-15e3])) / 30e3
    assert tilt == pytest.approx((abs(predicted(15e3)) - abs(predicted(-15e3))) / 30e3, rel=2e-2)
    assert accuracy.sources["position"].offset[0] > abs(heights[0.0])


def test_errors_of_edges_add_up_to_the_model_of_edges():
    """Offset ± tilt half a swath is the error that the model has at the edges themselves."""
    positions = _pair(STRIP, 250.0)
    errors = ErrorBudget(
        azimuth=ErrorSource(2e-6, SharedBy.ALL),
        synchronization=ErrorSource(0.02, SharedBy.IMAGE),
        range=ErrorSource(0.05, SharedBy.ALL),
        troposphere=ErrorSource(0.1, SharedBy.ALL, Scale.ORBIT),
    )
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=errors)
    for side in (-1.0, 1.0):
        edge = height_error(positions, across_swath(STRIP, side * 15e3), radar=RADAR, errors=errors)
        for name in ("synchronization", "range", "troposphere"):
            matrix = accuracy.sources[name].covariance[0]
            slope = np.array([1.0, side * 15e3, 0.0])
            # The curvature of the error over 30 km is what a plane leaves.
            expected = float(edge.terms[name][0])
            assert np.sqrt(slope @ matrix @ slope) == pytest.approx(expected, rel=5e-3)


def test_calibration_against_simulated_adjustments():
    rng = np.random.default_rng(5)
    factor = np.array([[1.2, 0.0, 0.0], [2e-5, 3e-5, 0.0], [0.0, 0.0, 8e-6]])
    prior = factor @ factor.T
    noise, trials = 0.6, 20_000
    posterior = calibrated_covariance(prior, CALIBRATION, noise_std=noise)
    truth = rng.standard_normal((trials, 3)) @ factor.T
    points = CALIBRATION.points()
    design = np.column_stack([np.ones(len(points)), points])
    sigma = np.hypot(CALIBRATION.accuracy, noise)
    observed = truth @ design.T + sigma * rng.standard_normal((trials, len(points)))
    # Generalized least squares with the budget as prior, written with explicit inverses.
    weight = np.linalg.inv(np.linalg.inv(prior) + design.T @ design / sigma**2)
    estimate = observed @ design @ weight / sigma**2
    left = truth - estimate
    empirical = left.T @ left / trials
    scale = np.sqrt(np.diag(posterior))
    # A variance of 20 000 draws is known to 1 %.
    assert empirical / np.outer(scale, scale) == pytest.approx(
        posterior / np.outer(scale, scale), abs=0.04
    )


def test_heights_over_the_area_after_calibration():
    rng = np.random.default_rng(6)
    posterior = np.diag([0.3, 2e-5, 1e-5]) ** 2
    draws = rng.standard_normal((40_000, 3)) * np.sqrt(np.diag(posterior))
    place = rng.uniform(-0.5, 0.5, (40_000, 2)) * np.array([30e3, 100e3])
    heights = draws[:, 0] + np.sum(draws[:, 1:] * place, axis=-1)
    expected = area_variance(posterior, swath=30e3, length=100e3)
    assert np.mean(heights**2) == pytest.approx(expected, rel=0.03)


@given(offset=st.floats(1e-3, 50.0), tilt=st.floats(0.0, 1e-3), accuracy=st.floats(0.01, 20.0))
def test_calibration_never_harms_and_more_points_never_harm(offset, tilt, accuracy):
    prior = np.diag([offset**2, tilt**2, 0.0])
    sparse = replace(CALIBRATION, accuracy=accuracy)
    dense = replace(sparse, spacing_across=5e3)
    before = area_variance(prior, swath=30e3, length=100e3)
    after = area_variance(calibrated_covariance(prior, sparse), swath=30e3, length=100e3)
    denser = area_variance(calibrated_covariance(prior, dense), swath=30e3, length=100e3)
    assert denser <= after * (1 + 1e-9)
    assert after <= before * (1 + 1e-9)


def test_loose_budget_leaves_what_least_squares_leaves():
    prior = np.diag([1e8, 1e2, 1e2])
    ordinary = np.linalg.inv(CALIBRATION.normal_matrix()) * 0.8**2
    posterior = calibrated_covariance(prior, CALIBRATION)
    assert np.diag(posterior) == pytest.approx(np.diag(ordinary), rel=1e-6)
    points = CALIBRATION.points()
    design = np.column_stack([np.ones(len(points)), points])
    assert CALIBRATION.normal_matrix() == pytest.approx(design.T @ design, abs=1.0)


def test_one_track_tells_no_tilt_across():
    track = replace(CALIBRATION, spacing_across=30e3)
    prior = np.diag([4.0, 1e-8, 0.0])
    posterior = calibrated_covariance(prior, track)
    assert posterior[1, 1] == pytest.approx(1e-8)
    assert posterior[0, 0] < 0.05


def test_without_systematic_errors_relative_is_root_two():
    positions = _pair(STRIP, 250.0)
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=ErrorBudget())
    assert accuracy.relative == pytest.approx(np.sqrt(2.0) * accuracy.random)
    assert accuracy.absolute == pytest.approx(accuracy.random)
    exact = point_to_point_error(positions, STRIP, radar=RADAR, errors=ErrorBudget())
    assert accuracy.relative_90 == pytest.approx(exact, rel=1e-3)
    # The Cramér-Rao bound of 16 looks at 10 dB promises a few percent too much.
    assert accuracy.relative_90 == pytest.approx(NORMAL_90 * accuracy.relative, rel=0.05)
    many = replace(RADAR, looks=1000.0)
    accuracy = height_accuracy(positions, STRIP, radar=many, errors=ErrorBudget())
    assert accuracy.relative_90 == pytest.approx(NORMAL_90 * accuracy.relative, rel=2e-3)


@given(
    coherence=st.floats(0.05, 0.99), looks=st.floats(0.5, 300.0), level=st.sampled_from([0.9, 0.95])
)
@settings(max_examples=20, deadline=None)
def test_quick_quantile_is_the_exact_one(coherence, looks, level):
    exact = difference_quantile(coherence, looks=looks, level=level)
    quick = quick_difference_quantile(coherence, looks=looks, level=level)
    assert quick == pytest.approx(exact, rel=3e-3 if looks < 1.0 else 1.5e-3)


@pytest.mark.parametrize("share", [0.3, 1.0, 3.0])
def test_bounds_add_as_squares_within_three_percent(share):
    """Single-look noise, the worst case, plus a normal systematic error of a share of it."""
    rng = np.random.default_rng(8)
    gamma, trials = 0.7, 400_000
    first = rng.standard_normal((2, trials, 2)) @ np.array([1.0, 1j]) / np.sqrt(2.0)
    second = rng.standard_normal((2, trials, 2)) @ np.array([1.0, 1j]) / np.sqrt(2.0)
    phase = np.angle(first * np.conj(gamma * first + np.sqrt(1.0 - gamma**2) * second))
    difference = phase[0] - phase[1]
    normal = share * difference.std() * rng.standard_normal(trials)
    bound = np.quantile(np.abs(difference + normal), 0.9)
    alone = float(difference_quantile(gamma, looks=1.0))
    assert np.hypot(alone, NORMAL_90 * share * difference.std()) == pytest.approx(bound, rel=0.03)


@pytest.mark.parametrize(
    ("scale", "cell", "share"),
    [
        (Scale.SCENE, 20e3, 0.0),  # two points of one scene: an offset is common
        (Scale.SCENE, 100e3, 2.0),  # of two scenes: each has its own
        (Scale.DATA_TAKE, 100e3, 2.0),
        (Scale.ORBIT, 100e3, 0.0),
        (Scale.MISSION, 100e3, 0.0),
    ],
)
def test_scales_decide_what_two_points_share(scale, cell, share):
    """A mostly constant error: of a mean range error the tilt is a thousandth over the swath."""
    positions = _pair(STRIP, 250.0)
    errors = ErrorBudget(range=ErrorSource(1.0, SharedBy.ALL, scale))
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=errors, cell=Cell(size=cell))
    systematic = accuracy.relative**2 - 2.0 * accuracy.random**2
    assert systematic == pytest.approx(share * np.cos(STRIP.incidence) ** 2, abs=2e-3)
    assert accuracy.systematic(scale) == pytest.approx(np.cos(STRIP.incidence), rel=1e-3)


@pytest.mark.parametrize("scale", [s for s in Scale if s is not Scale.PIXEL])
@pytest.mark.parametrize("over", [s for s in Scale if s is not Scale.PIXEL])
def test_calibration_removes_what_is_constant_over_it(scale, over):
    errors = ErrorBudget(
        range=ErrorSource(5.0, SharedBy.ALL, scale),
        calibration=replace(CALIBRATION, over=over, bias=0.3),
    )
    positions = _pair(STRIP, 250.0)
    accuracy = height_accuracy(positions, STRIP, radar=RADAR, errors=errors)
    systematic = np.sqrt(accuracy.absolute**2 - accuracy.random**2)
    if scale.covers(over):
        assert systematic < 0.4
        assert systematic > 0.3
    else:
        assert systematic == pytest.approx(5.0 * np.cos(STRIP.incidence), rel=0.01)


def test_simulated_points_are_as_predicted():
    """Draw the errors at their scales and compare point pairs and heights with the bounds."""
    rng = np.random.default_rng(7)
    positions = _pair(STRIP, 250.0)
    errors = ErrorBudget(
        position=ErrorSource(1e-3, SharedBy.SATELLITE),
        troposphere=ErrorSource(0.3, SharedBy.ALL, Scale.DATA_TAKE),
    )
    # Noise of many looks is normal and can be drawn as such.
    radar = replace(RADAR, snr=0.7, looks=200.0)
    accuracy = height_accuracy(
        positions, STRIP, radar=radar, errors=errors, cell=Cell(size=30e3, swath=30e3)
    )
    trials = 40_000
    difference = np.sqrt(2.0) * accuracy.random * rng.standard_normal(trials)
    displaced = 1e-3 * rng.standard_normal((trials, 2, 3))
    baseline = displaced[:, 1] - displaced[:, 0]
    zenith = 0.3 * rng.standard_normal(trials)
    for side in (-1.0, 1.0):
        scene = across_swath(STRIP, side * 15e3)
        normal = np.array([np.sin(scene.look_angle[0]), 0.0, np.cos(scene.look_angle[0])])
        perpendicular = (positions[0, 1] - positions[0, 0]) @ normal
        lever = scene.slant_range[0] * np.sin(scene.incidence[0]) / perpendicular
        difference += side * lever * (baseline @ scene.line_of_sight[0])
        difference += side * np.tan(scene.incidence[0]) ** 2 * zenith
    bound = np.quantile(np.abs(difference), 0.9)
    assert bound == pytest.approx(accuracy.relative_90[0], rel=0.015)


def test_nothing_measured_is_infinite():
    accuracy = height_accuracy(
        _pair(STRIP, 0.0),
        STRIP,
        radar=RADAR,
        errors=ErrorBudget(position=ErrorSource(1e-3, SharedBy.SATELLITE), calibration=CALIBRATION),
    )
    assert np.isinf(accuracy.relative_90).all()
    assert np.isinf(accuracy.absolute_90).all()


@given(distance=st.floats(-60e3, 60e3))
def test_moving_across_the_swath_and_back(distance):
    there = across_swath(STRIP, distance)
    back = across_swath(there, -distance)
    for name in ("slant_range", "look_angle", "incidence"):
        assert getattr(back, name) == pytest.approx(getattr(STRIP, name), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"spacing_across": 40e3}, "spacing_across"),
        ({"accuracy": -1.0}, "accuracy"),
        ({"swath": 0.0}, "swath"),
        ({"over": Scale.PIXEL}, "over"),
    ],
)
def test_impossible_calibration_is_refused(change, said):
    with pytest.raises(ValueError, match=said):
        replace(CALIBRATION, **change)


def test_atmosphere_adds_to_the_total_whatever_the_formation():
    troposphere = ErrorSource(2.4, SharedBy.ALL, Scale.DATA_TAKE)
    for baseline in (100.0, 400.0):
        positions = _pair(STRIP, baseline)
        clear = height_error(positions, STRIP, radar=RADAR, errors=ErrorBudget())
        errors = ErrorBudget(
            troposphere=troposphere,
            ionosphere=Ionosphere(electrons=30 * TEC_UNIT, gradient=1e11),
        )
        error = height_error(positions, STRIP, radar=RADAR, errors=errors)
        added = error.terms["troposphere"] ** 2 + error.terms["ionosphere"] ** 2
        added = added + error.terms["ionosphere_gradient"] ** 2
        assert error.total**2 == pytest.approx(clear.total**2 + added)
        assert error.relative == pytest.approx(clear.relative)
        assert error.terms["troposphere"] == pytest.approx(2.4 * np.tan(STRIP.incidence) ** 2)


def test_residual_is_smooth_in_the_spacing():
    """No jump where a point falls out of the area: elasticities need a derivative."""
    prior = np.diag([4.0, 1e-8, 0.0])
    around = [
        area_variance(
            calibrated_covariance(prior, replace(CALIBRATION, spacing_across=10e3 * (1 + step))),
            swath=30e3,
            length=100e3,
        )
        for step in (-1e-4, 0.0, 1e-4)
    ]
    assert np.ptp(around) < 1e-3 * around[1]
    assert np.all(np.diff(around) > 0.0)
