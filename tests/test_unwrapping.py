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
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    decorrelated_unwrapping,
    one_transmitter,
    phase_model,
    try_unwrapping,
    two_baseline_probability,
    unwrapping_ladder,
    unwrapping_probability,
)
from insar.unwrapping import (
    bootstrap_failure,
    float_covariance,
    noise_covariance,
    success_ceiling,
)

SCENE = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6_378_137.0
)
BUDGET = ErrorBudget(
    position=ErrorSource(0.001, SharedBy.SATELLITE), phase_statistics=PhaseStatistics.CRAMER_RAO
)


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


def written_out_covariance(model, prior):
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
    covariance = written_out_covariance(model, prior)
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
    covariance = difference @ written_out_covariance(model, 4.0) @ difference.T
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


# -- decorrelation -------------------------------------------------------------------------------

FOUR = [0.0, 200.0, 800.0, 1900.0]


def model_of(baselines):
    radar = radar_for(len(baselines))
    return phase_model(ladder_positions(baselines), SCENE, radar=radar, errors=BUDGET)


def test_four_satellites_fail_nine_times_less_often_decorrelated():
    model = model_of(FOUR)
    ladder = unwrapping_ladder(model, prior_height_std=4.0)
    decorrelated = decorrelated_unwrapping(model, prior_height_std=4.0)
    assert ladder.failure[0] == pytest.approx(1.5e-3, rel=0.04)
    assert decorrelated.failure[0] == pytest.approx(1.7e-4, rel=0.04)


@given(st.lists(st.floats(-1500, 1500), min_size=1, max_size=6, unique=True), st.floats(1.0, 10.0))
def test_decorrelation_is_unimodular_and_never_worse(baselines, prior):
    model = model_of([0.0, *baselines])
    ladder = unwrapping_ladder(model, prior_height_std=prior)
    result = decorrelated_unwrapping(model, prior_height_std=prior, ladder=ladder)
    assert result.failure[0] <= ladder.failure[0] * (1 + 1e-6) + 1e-13
    assert result.probability[0] <= result.ceiling[0] + 1e-12
    combinations = result.combinations[0]
    assert abs(np.linalg.det(combinations[:, 1:])) == pytest.approx(1.0, abs=1e-6)
    assert np.all(combinations.sum(axis=-1) == 0)
    # The factors are those of the combinations' covariance.
    covariance = combinations @ float_covariance(model, prior)[0] @ combinations.T
    expected = np.diag(np.linalg.cholesky(covariance))
    assert_allclose(result.cycle_std[0], expected, rtol=1e-4)
    assert np.all(np.abs(np.tril(result.gain[0], -1)) <= 0.5 + 1e-9)


def brute_force_reduction(covariance, reach):
    """Best bootstrapped probability of two ambiguities over all small unimodular combinations."""
    best = 1.0
    whole = range(-reach, reach + 1)
    for a, b, c, d in itertools.product(whole, repeat=4):
        if abs(a * d - b * c) == 1:
            transform = np.array([[a, b], [c, d]])
            factor = np.linalg.cholesky(transform @ covariance @ transform.T)
            best = min(best, float(bootstrap_failure(np.diag(factor))))
    return best


@pytest.mark.parametrize("baselines", [[0, 330, 1400], [0, 900, 1300], [0, 450, 1100]])
def test_of_two_ambiguities_no_combination_is_better(baselines):
    model = model_of(baselines)
    result = decorrelated_unwrapping(model, prior_height_std=4.0)
    best = brute_force_reduction(float_covariance(model, 4.0)[0, 1:, 1:], 5)
    assert result.failure[0] <= best * (1 + 1e-6)


@pytest.mark.parametrize("baselines", [[0, 330, 1700], [0, 300, 1000, 2300]])
def test_predicted_failure_is_that_of_drawn_phases(baselines):
    model = model_of(baselines)
    result = decorrelated_unwrapping(model, prior_height_std=7.0)
    trial = try_unwrapping(
        model, result, prior_height_std=7.0, samples=300_000, rng=np.random.default_rng(11)
    )
    assert result.failure[0] > 1e-3  # enough failures to count
    assert abs(trial.failure[0] - result.failure[0]) < 4 * trial.sampling_error[0]
    again = try_unwrapping(
        model, result, prior_height_std=7.0, samples=300_000, rng=np.random.default_rng(11)
    )
    assert again.failure == trial.failure


def test_integer_least_squares_lies_between_bootstrapping_and_the_ceiling():
    """Two ambiguities, the nearest integer in the metric of Q by trying all neighbors."""
    rng = np.random.default_rng(3)
    model = model_of([0.0, 330.0, 1700.0])
    result = decorrelated_unwrapping(model, prior_height_std=7.0)
    covariance = float_covariance(model, 7.0)[0, 1:, 1:]
    transform = result.combinations[0][:, 1:]
    reduced = transform @ covariance @ transform.T
    floats = rng.multivariate_normal([0, 0], reduced, size=200_000)
    inverse = np.linalg.inv(reduced)
    distances = [
        np.einsum("ni,ij,nj->n", floats - shift, inverse, floats - shift)
        for shift in itertools.product(range(-3, 4), repeat=2)
    ]
    success = np.mean(np.argmin(distances, axis=0) == 24)  # the shift (0, 0) is the middle one
    sampling = 4 * np.sqrt(0.25 / len(floats)) * 2 * np.sqrt(result.failure[0])
    assert result.probability[0] - sampling <= success <= result.ceiling[0] + sampling


def test_one_ambiguity_meets_its_ceiling():
    assert success_ceiling(np.array([0.3])) == pytest.approx(2 * norm.cdf(0.5 / 0.3) - 1)


def test_drawing_needs_samples():
    model = model_of([0.0, 330.0])
    result = decorrelated_unwrapping(model, prior_height_std=4.0)
    with pytest.raises(ValueError, match="samples = 0"):
        try_unwrapping(model, result, prior_height_std=4.0, samples=0, rng=np.random.default_rng(1))


def test_images_that_share_nothing_with_the_first_are_no_singular_matrix():
    # Two images that know much of one another: 1e-12 more on the diagonal is lost to rounding.
    information = np.zeros((1, 3, 3))
    information[0, 1:, 1:] = 2.0**20 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    with pytest.raises(np.linalg.LinAlgError):
        np.linalg.inv(information[:, 1:, 1:] + 1e-12 * np.eye(2))
    covariance = noise_covariance(information)
    assert np.all(np.isfinite(covariance))
    assert covariance[0, 1, 1] > 1e6  # all but unknown against the first
