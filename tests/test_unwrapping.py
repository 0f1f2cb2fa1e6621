"""Integer bootstrapping along the ladder of baselines."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.stats import norm

from insar import (
    ErrorBudget,
    ErrorSource,
    PhaseModel,
    Radar,
    Scene,
    SharedBy,
    one_transmitter,
    phase_model,
    two_baseline_probability,
    unwrapping_ladder,
    unwrapping_probability,
)
from insar.unwrapping import bootstrap_failure

SCENE = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6_378_137.0
)
BUDGET = ErrorBudget(position=ErrorSource(0.001, SharedBy.SATELLITE))


def radar_for(count):
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=16.0,
        images=one_transmitter(count),
    )


def ladder_positions(baselines):
    """Satellites along the height direction at given perpendicular offsets: (1, N, 3)."""
    los = SCENE.line_of_sight[0]
    direction = np.cross(los, [0.0, 1.0, 0.0])
    return np.array(baselines)[None, :, None] * direction


def test_two_baselines_against_the_published_values():
    probability = two_baseline_probability(
        short_std=0.3, long_std=0.3, covariance=0.0, ratio=[4.0, 6.0]
    )
    assert_allclose(probability, [0.9889, 0.9149], atol=5e-5)


def test_two_baselines_by_monte_carlo():
    rng = np.random.default_rng(2)
    covariance = np.array([[0.09, 0.02], [0.02, 0.12]])
    short, long = rng.multivariate_normal([0, 0], covariance, size=400_000).T
    ratio = 5.0
    wrong = np.rint((long - ratio * short) / (2 * np.pi)) != 0
    expected = two_baseline_probability(
        short_std=0.3, long_std=np.sqrt(0.12), covariance=0.02, ratio=ratio
    )
    assert 1 - wrong.mean() == pytest.approx(float(expected), abs=0.002)  # 4 sigma of 400 000


def test_one_rung_is_the_prior_against_the_height_of_ambiguity():
    """Two images, no noise to speak of: P = 2Φ(HoA/(2σ_0)) − 1."""
    positions = ladder_positions([0.0, 1000.0])
    radar = radar_for(2)
    model = phase_model(positions, SCENE, radar=radar, errors=ErrorBudget())
    ambiguity = 2 * np.pi / abs(model.vertical_wavenumber[0, 1])
    noise = 1 / np.sqrt(model.information[0, 0, 0])
    for prior in (2.0, 4.0, 10.0):
        cycles = np.hypot(prior / ambiguity, noise / (2 * np.pi))
        expected = 2 * norm.cdf(0.5 / cycles) - 1
        result = unwrapping_probability(
            positions, SCENE, radar=radar, errors=ErrorBudget(), prior_height_std=prior
        )
        assert result[0] == pytest.approx(expected, rel=1e-9)


def float_covariance(model, prior):
    """Covariance of the image phases relative to the first [cycles²], written out."""
    count = model.vertical_wavenumber.shape[-1]
    covariance = np.zeros((count, count))
    covariance[1:, 1:] = np.linalg.inv(model.information[0][1:, 1:])
    for factor in model.nuisance.values():
        relative = factor[0] - factor[0][:1]
        covariance += relative @ relative.T
    kz = model.vertical_wavenumber[0]
    return (covariance + prior**2 * np.outer(kz, kz)) / (2 * np.pi) ** 2


def bootstrap_in_order(model, prior, order):
    """Fix the cycle differences of images joined in a given order, by plain conditioning."""
    covariance = float_covariance(model, prior)
    count = len(covariance)
    difference = np.zeros((count - 1, count))
    for row, (one, two) in enumerate(itertools.pairwise(order)):
        difference[row, one], difference[row, two] = -1, 1
    # Conditional variances are the squared diagonal of the Cholesky factor.
    deviation = np.diag(np.linalg.cholesky(difference @ covariance @ difference.T))
    return float(bootstrap_failure(deviation))


@given(
    st.lists(st.floats(-1500, 1500), min_size=2, max_size=3, unique=True),
    st.floats(1.0, 10.0),
)
def test_the_ladder_is_no_worse_than_any_chain(baselines, prior):
    """Every order of joining the images one after the other, by brute force."""
    radar = radar_for(len(baselines) + 1)
    model = phase_model(ladder_positions([0.0, *baselines]), SCENE, radar=radar, errors=BUDGET)
    ladder = unwrapping_ladder(model, prior_height_std=prior)
    chains = [
        bootstrap_in_order(model, prior, order)
        for order in itertools.permutations(range(len(baselines) + 1))
    ]
    assert ladder.failure[0] <= min(chains) * (1 + 1e-6) + 1e-12


@given(st.lists(st.floats(-1500, 1500), min_size=2, max_size=5, unique=True))
def test_the_pairs_of_the_rungs_explain_their_deviations(baselines):
    """The pairs named join all images, and conditioning on them in turn gives the deviations."""
    count = len(baselines) + 1
    radar = radar_for(count)
    model = phase_model(ladder_positions([0.0, *baselines]), SCENE, radar=radar, errors=BUDGET)
    ladder = unwrapping_ladder(model, prior_height_std=4.0)
    difference = np.zeros((count - 1, count))
    for row, (one, two) in enumerate(ladder.pairs[0]):
        difference[row, one], difference[row, two] = -1, 1
    assert np.linalg.matrix_rank(difference) == count - 1
    covariance = difference @ float_covariance(model, 4.0) @ difference.T
    expected = np.diag(np.linalg.cholesky(covariance))
    assert_allclose(ladder.cycle_std[0], expected, rtol=1e-5)


def test_bootstrapping_by_monte_carlo():
    """Draw prior height, shared errors and noise; round rung by rung."""
    rng = np.random.default_rng(7)
    radar = radar_for(3)
    model = phase_model(ladder_positions([0.0, 330.0, 1400.0]), SCENE, radar=radar, errors=BUDGET)
    prior = 5.0
    ladder = unwrapping_ladder(model, prior_height_std=prior)
    samples = 400_000
    kz = model.vertical_wavenumber[0, 1:]
    noise = np.linalg.inv(model.information[0][1:, 1:])
    factor = model.nuisance["position"][0]
    relative = factor[1:] - factor[:1]
    errors = rng.multivariate_normal(np.zeros(2), noise + relative @ relative.T, size=samples)
    errors -= rng.normal(scale=prior, size=(samples, 1)) * kz  # phase less the prior's phase
    covariance = noise + relative @ relative.T + prior**2 * np.outer(kz, kz)
    first = np.rint(errors[:, 0] / (2 * np.pi))
    conditioned = errors[:, 1] - covariance[0, 1] / covariance[0, 0] * (
        errors[:, 0] - 2 * np.pi * first
    )
    right = (first == 0) & (np.rint(conditioned / (2 * np.pi)) == 0)
    assert set(ladder.pairs[0, 0]) == {0, 1}  # the short pair is the first rung
    assert right.mean() == pytest.approx(ladder.probability[0], abs=0.003)


@given(st.floats(50, 1500), st.floats(0.5, 9.0), st.floats(1.05, 3.0))
def test_a_better_prior_never_hurts(baseline, prior, factor):
    positions = ladder_positions([0.0, baseline, 4 * baseline])
    arguments = {"radar": radar_for(3), "errors": BUDGET}
    better = unwrapping_probability(positions, SCENE, **arguments, prior_height_std=prior)
    worse = unwrapping_probability(positions, SCENE, **arguments, prior_height_std=prior * factor)
    assert worse[0] <= better[0] + 1e-12


def test_the_number_of_the_images_does_not_matter():
    offsets = [0.0, 300.0, 1300.0, 2400.0]
    failures = [
        unwrapping_ladder(
            phase_model(
                ladder_positions(np.array(offsets)[list(order)]),
                SCENE,
                radar=radar_for(4),
                errors=BUDGET,
            ),
            prior_height_std=4.0,
        ).failure[0]
        for order in itertools.permutations(range(4))
    ]
    assert_allclose(failures, failures[0], rtol=1e-6)


def test_an_image_without_a_common_band_cannot_be_unwrapped():
    positions = ladder_positions([0.0, 300.0, 9000.0])
    probability = unwrapping_probability(
        positions, SCENE, radar=radar_for(3), errors=BUDGET, prior_height_std=4.0
    )
    assert probability[0] < 1e-5


def test_failure_keeps_its_digits_near_certainty():
    # 1 − P of a deviation of 0.05 cycles: 2Φ(−10) = 1.5e-23, lost if computed as 1 − P.
    assert bootstrap_failure([0.05]) == pytest.approx(2 * norm.cdf(-10), rel=1e-9)
    assert bootstrap_failure([0.0]) == 0.0


def test_batches_equal_single_designs():
    rng = np.random.default_rng(1)
    positions = rng.uniform(-500, 500, size=(6, 1, 4, 3))
    arguments = {"radar": radar_for(4), "errors": BUDGET, "prior_height_std": 4.0}
    batch = unwrapping_probability(positions, SCENE, **arguments)
    single = [unwrapping_probability(p, SCENE, **arguments) for p in positions]
    assert_allclose(batch, single, rtol=1e-9)
    assert isinstance(phase_model(positions, SCENE, radar=radar_for(4), errors=BUDGET), PhaseModel)
