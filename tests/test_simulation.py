"""The Monte-Carlo simulation, and what it says of the error model."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import hyp2f1, loggamma

from configs import example_path, load_study
from configs.build import build_optimize
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    Radar,
    Scale,
    Scene,
    SharedBy,
    filtered_information,
    fisher_information,
    height_error,
    one_transmitter,
    ping_pong,
)
from insar.bands import BandCell as Cell
from insar.bands import band_cells
from insar.phase_information import cell_information
from insar.simulation import (
    MAX_IMAGES,
    Comparison,
    Simulated,
    Verdict,
    natural_errors,
    refute,
)
from insar.simulation.estimators import Processor, along_ladder, bootstrapped, likely_heights
from insar.simulation.linking import laplacian, linked_phases, slope_and_weights
from insar.simulation.speckle import Speckle, link_matrices
from insar.simulation.varied import unfiltered_link_matrices, varied_link_matrices
from optimize import assess, refuted

STRIP = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6378137.0
)
NOISE_ONLY = ErrorBudget()
REALISTIC = ErrorBudget(
    position=ErrorSource(0.001, SharedBy.SATELLITE), range=ErrorSource(0.01, SharedBy.ALL)
)


def formation(baselines, scene=STRIP):
    """Satellites whose perpendicular baselines are given, (S, N, 3)."""
    across = np.cross(scene.line_of_sight, scene.velocity_direction)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    across *= np.sign(across[:, :1])
    return np.asarray(baselines, dtype=float)[None, :, None] * across[:, None, :]


def radar_of(count, *, coherence=10.0 / 11.0, looks=16.0):
    snr = coherence / (1.0 - coherence)  # γ = 1/(1 + 1/SNR)
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=snr,
        looks=looks,
        images=one_transmitter(count),
    )


def simulated(baselines, *, radar, errors=REALISTIC, prior=4.0, samples=4096, seed=1, scene=STRIP):
    result = refute(
        formation(baselines, scene),
        scene,
        radar=radar,
        errors=errors,
        prior_height_std=prior,
        samples=samples,
        rng=np.random.default_rng(seed),
    )
    return result.segments[0]


# -- speckle -------------------------------------------------------------------------------------


def test_cells_are_where_two_or_more_bands_overlap():
    cells = band_cells([0.0, 0.3, 0.9, 5.0])
    assert [cell.images.tolist() for cell in cells] == [[0, 1], [0, 1, 2], [1, 2]]
    assert [cell.share for cell in cells] == pytest.approx([0.6, 0.1, 0.3])


@pytest.mark.parametrize("looks", [3.0, 100.0])  # drawn look by look, and by Bartlett's triangle
def test_link_matrices_have_the_mean_and_spread_of_speckle(looks):
    """Σ y yᴴ of L looks has mean LΓ, and variance L of each element (circular Gaussian)."""
    coherence = np.array([[1.0, 0.6j], [-0.6j, 1.0]])
    speckle = Speckle(coherence, (Cell(1.0, np.arange(2)),), looks)
    samples = 40_000
    data = link_matrices(speckle, samples=samples, rng=np.random.default_rng(3))
    scatter = data[:, 0, 1] / -np.conj(np.linalg.inv(coherence)[0, 1])
    error = 4.0 * math.sqrt(looks / samples)  # four sampling errors
    assert abs(scatter.mean() - looks * coherence[0, 1]) < error
    assert scatter.var() == pytest.approx(looks, rel=0.05)
    assert np.allclose(data[:, 1, 0], np.conj(data[:, 0, 1]))


def test_looks_that_are_not_whole_are_right_on_average():
    """2.5 looks, a third of them common: 0.8 looks in a cell, some samples have none."""
    speckle = Speckle(np.array([[1.0, 0.9], [0.9, 1.0]]) + 0j, (Cell(0.32, np.arange(2)),), 2.5)
    data = link_matrices(speckle, samples=64_000, rng=np.random.default_rng(5))
    weight = -np.linalg.inv(speckle.coherence)[0, 1]
    assert (data[:, 0, 1] / weight).mean().real == pytest.approx(0.9 * 0.8, rel=0.02)
    assert (data[:, 0, 1] == 0.0).mean() == pytest.approx(0.2, abs=0.05)


@pytest.mark.parametrize("looks", [5.5, 24.0])
def test_mean_likelihood_is_the_fisher_information(looks):
    """E A = −X/2 off the diagonal, X in closed form: 2 % at 20 000 samples, drawn both ways."""
    offset, amplitude, rng = np.array([0.0, 0.3, 0.75]), 0.9, np.random.default_rng(6)
    expected = -0.5 * filtered_information(offset, image_coherence=amplitude, looks=looks)
    np.fill_diagonal(expected, 0.0)
    gamma = np.full((3, 3), amplitude**2, dtype=complex)
    np.fill_diagonal(gamma, 1.0)
    alike = link_matrices(Speckle(gamma, band_cells(offset), looks), samples=20_000, rng=rng)
    varied = varied_link_matrices(
        np.tile(offset, (20_000, 1)), np.full((20_000, 3), amplitude), looks=looks, rng=rng
    )
    for drawn in (alike, varied):
        assert drawn.mean(axis=0).real == pytest.approx(expected, abs=0.02 * expected.max())
        assert np.abs(drawn.mean(axis=0).imag).max() < 0.02 * expected.max()


def test_unequal_images_with_azimuth_bands_and_pair_factors_likewise():
    """Against `filtered_information` and `cell_information`: amplitudes, Doppler bands, volume."""
    rng, looks, samples = np.random.default_rng(11), 20.0, 20_000
    offset, doppler = np.array([0.0, 0.3, 0.75]), np.array([0.0, 0.2, 0.1])
    amplitude = np.array([0.95, 0.8, 0.9])
    factor = np.exp(-0.3 * np.abs(np.subtract.outer(offset, offset))) + 0j
    factor *= np.exp(0.4j * np.subtract.outer(offset, offset))
    gamma = np.outer(amplitude, amplitude) * factor
    np.fill_diagonal(gamma, 1.0)
    cases = (
        (
            None,
            filtered_information(
                offset, image_coherence=amplitude, looks=looks, doppler_offset=doppler
            ),
        ),
        (
            factor,
            cell_information(gamma, looks=looks, band_offset=offset, doppler_offset=doppler),
        ),
    )
    for pair_factor, information in cases:
        drawn = varied_link_matrices(
            np.tile(offset, (samples, 1)),
            np.tile(amplitude, (samples, 1)),
            looks=looks,
            rng=rng,
            doppler_offset=np.tile(doppler, (samples, 1)),
            pair_factor=None if pair_factor is None else np.tile(pair_factor, (samples, 1, 1)),
        )
        expected = -0.5 * information
        np.fill_diagonal(expected, 0.0)
        assert drawn.mean(axis=0).real == pytest.approx(expected, abs=0.02 * expected.max())


def test_unfiltered_images_likewise():
    rng, looks = np.random.default_rng(7), 6.4
    gamma = np.array([[1.0, 0.6, 0.2], [0.6, 1.0, 0.5], [0.2, 0.5, 1.0]])
    drawn = unfiltered_link_matrices(np.tile(gamma, (20_000, 1, 1)), looks=looks, rng=rng)
    expected = -0.5 * fisher_information(gamma, looks=looks)
    np.fill_diagonal(expected, 0.0)
    assert drawn.mean(axis=0).real == pytest.approx(expected, abs=0.03 * expected.max())


# -- phases of maximum likelihood ----------------------------------------------------------------


def test_linked_phases_beat_every_phase_of_a_grid():
    rng = np.random.default_rng(4)
    gamma = np.array([[1, 0.5, 0.3], [0.5, 1, 0.6], [0.3, 0.6, 1]]) + 0j
    data = link_matrices(Speckle(gamma, (Cell(1.0, np.arange(3)),), 4.0), samples=60, rng=rng)
    phase = linked_phases(data, rng=rng)
    axis = 2.0 * np.pi * np.arange(120) / 120
    grid = np.stack(np.meshgrid(0.0, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)

    def likelihood(phases):
        vector = np.exp(1j * phases)
        return np.einsum("...i,sij,...j->s...", np.conj(vector), data, vector).real

    best = likelihood(grid).max(axis=-1)
    found = np.array([likelihood(p)[s] for s, p in enumerate(phase)])
    # The grid of 3° misses its maximum by less than a thousandth; one start in many may end on a
    # lower hill, where the coherence is poor.
    assert np.mean(found >= best * (1.0 - 1e-9)) > 0.95


def test_linked_phases_reach_the_bound_at_many_looks():
    """400 looks of three images against the Fisher information, 20 000 samples: 4 %."""
    rng = np.random.default_rng(8)
    gamma = np.full((3, 3), 0.7) + 0.3 * np.eye(3) + 0j
    data = link_matrices(Speckle(gamma, (Cell(1.0, np.arange(3)),), 400.0), samples=20_000, rng=rng)
    phase = linked_phases(data, rng=rng)[:, 1:]
    bound = np.linalg.inv(fisher_information(gamma, looks=400.0)[1:, 1:])
    assert np.cov(phase.T) == pytest.approx(bound, rel=0.04, abs=0.04 * bound[0, 0])


def test_slope_of_the_likelihood_is_its_derivative():
    rng = np.random.default_rng(9)
    gamma = np.full((3, 3), 0.5) + 0.5 * np.eye(3) + 0j
    data = link_matrices(Speckle(gamma, (Cell(1.0, np.arange(3)),), 4.0), samples=5, rng=rng)
    phase, step = rng.uniform(-1.0, 1.0, (5, 3)), 1e-6

    def likelihood(phases):
        vector = np.exp(1j * phases)
        return np.einsum("si,sij,sj->s", np.conj(vector), data, vector).real

    gradient, weight = slope_and_weights(data, np.exp(1j * phase), sharp=True)
    for image in range(3):
        shift = step * np.eye(3)[image]
        numeric = (likelihood(phase + shift) - likelihood(phase - shift)) / (2.0 * step)
        assert gradient[:, image] == pytest.approx(numeric, abs=1e-6)
        other, _ = slope_and_weights(data, np.exp(1j * (phase + shift)), sharp=True)
        curvature = -(other - gradient) / step
        assert laplacian(weight)[:, :, image] == pytest.approx(curvature, abs=1e-3)


# -- estimators ----------------------------------------------------------------------------------


def test_likely_height_of_perfect_phases_is_the_height():
    """Two images without noise: the cycle nearest to the prior, exactly."""
    kz = np.array([0.0, 2.0 * np.pi / 30.0])
    height = np.array([-9.0, -2.0, 0.0, 3.0, 8.0])
    phase = height[:, None] * kz
    data = np.zeros((5, 2, 2), dtype=complex)
    data[:, 0, 1] = data[:, 1, 0] = 1e9
    processor = Processor(
        vertical_wavenumber=kz[None],
        information=1e9 * np.array([[[1.0, -1.0], [-1.0, 1.0]]]),
        factor=np.zeros((1, 2, 0)),
        pairs=np.array([[[0, 1]]]),
        prior_height_std=4.0,
    )
    wrapped = np.angle(np.exp(1j * phase))
    found = likely_heights(processor, wrapped, data=data, true_phase=phase)
    assert found.most_likely == pytest.approx(height, abs=1e-6)
    assert found.mean == pytest.approx(height, abs=1e-2)  # the other cycles weigh up to 1e-5


def test_bootstrapping_adds_whole_cycles():
    """Unwrapped phases are the measured ones but for multiples of 2π, right or wrong."""
    rng = np.random.default_rng(10)
    kz = np.array([[0.0, 0.05, 0.21]])
    processor = Processor(
        vertical_wavenumber=kz,
        information=laplacian(np.full((1, 3, 3), 8.0)),
        factor=0.4 * rng.standard_normal((1, 3, 2)) * [[[0.0], [1.0], [1.0]]],
        pairs=np.array([[[0, 1], [1, 2]]]),
        prior_height_std=10.0,
    )
    truth = rng.normal(0.0, 10.0, (500, 1)) * kz
    noise = along_ladder(rng.normal(0.0, 0.3, (500, 3)), pairs=processor.pairs)
    wrapped = np.angle(np.exp(1j * (truth + noise)))
    found = bootstrapped(processor, wrapped, truth=truth, noise=noise)
    cycles = (found.phase - wrapped) / (2.0 * np.pi)
    assert cycles == pytest.approx(np.round(cycles), abs=1e-9)
    right = np.abs(found.phase - truth - noise).max(axis=-1) < 1e-6
    assert np.array_equal(found.right, right)
    assert 0.5 < right.mean() < 1.0


def test_noise_adds_up_along_the_ladder():
    noise = np.array([[0.0, 3.0, 3.0 + 3.0 - 2.0 * np.pi]])
    pairs = np.array([[[0, 1], [1, 2]]])
    assert along_ladder(noise, pairs=pairs) == pytest.approx(np.array([[0.0, 3.0, 6.0]]))


# -- model against simulation --------------------------------------------------------------------


def exact_phase_std(coherence, looks):
    """Of the multilook phase, by quadrature of its density (Lee et al. 1994)."""
    phase = (np.arange(20_000) + 0.5) / 20_000 * np.pi
    beta = coherence * np.cos(phase)
    log = loggamma(looks + 0.5) - loggamma(looks) + looks * np.log1p(-(coherence**2))
    density = np.exp(log) * beta / (2 * np.sqrt(np.pi) * (1 - beta**2) ** (looks + 0.5))
    density += (1 - coherence**2) ** looks / (2 * np.pi) * hyp2f1(looks, 1, 0.5, beta**2)
    return math.sqrt(float((density * phase**2).sum() / density.sum()))


@pytest.mark.parametrize("ambiguity", [10.0, 30.0, 100.0])
@pytest.mark.parametrize("coherence", [0.7, 0.95])
@pytest.mark.parametrize("looks", [16, 64])
def test_three_images_agree_with_the_model(ambiguity, coherence, looks):
    """Third image at a quarter of the baseline: 5 %, and 10 % above a Cramér-Rao bound. Fewer looks
    at a lower coherence err more, see docs/simulation.md."""
    lever = STRIP.slant_range[0] * math.sin(STRIP.incidence[0])
    segment = simulated(
        np.array([0.0, 0.25, 1.0]) * 0.031 * lever / ambiguity,
        radar=radar_of(3, coherence=coherence, looks=float(looks)),
        errors=NOISE_ONLY,
        prior=0.1 * ambiguity,
    )
    ratio = segment.right_cycles.value / segment.predicted_total
    assert 0.945 < ratio < 1.10
    assert abs(segment.wrong.value - segment.predicted_failure) < 0.01


@pytest.mark.parametrize("ambiguity", [10.0, 30.0, 100.0])
@pytest.mark.parametrize("coherence", [0.4, 0.7, 0.95])
@pytest.mark.parametrize("looks", [4, 16, 64])
def test_two_images_have_the_exact_phase_noise(ambiguity, coherence, looks):
    """5 % (issue), at 1.1 % sampling error; the Cramér-Rao bound is never beaten."""
    lever = STRIP.slant_range[0] * math.sin(STRIP.incidence[0])
    baseline = 0.031 * lever / ambiguity
    radar = radar_of(2, coherence=coherence, looks=float(looks))
    errors = dataclasses.replace(
        NOISE_ONLY, baseline_decorrelation=BaselineDecorrelation.UNFILTERED
    )
    critical = 0.031 * STRIP.slant_range[0] * math.tan(STRIP.incidence[0]) / 3.0
    left = coherence * (1.0 - baseline / critical)
    segment = simulated([0.0, baseline], radar=radar, errors=errors, prior=0.1 * ambiguity)
    expected = exact_phase_std(left, looks) * ambiguity / (2.0 * np.pi)
    assert segment.right_cycles.value == pytest.approx(expected, rel=0.05)
    bound = ambiguity / (2 * np.pi) * math.sqrt((1 - left**2) / (2 * looks * left**2))
    # Wrapping keeps the phase within ±π, which beats the bound where it exceeds 1 rad.
    if 2 * np.pi * bound / ambiguity < 0.6:
        assert segment.right_cycles.value > bound * (1.0 - 0.033)


@pytest.mark.parametrize("seed", range(8))
def test_random_formations_agree_and_never_beat_the_bound(seed):
    """N = 2…8; three sampling errors, and the 5 % that phase noise may exceed the bound by."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 9))
    gaps = rng.uniform(50.0, 250.0, count)
    radar = radar_of(count, looks=float(rng.integers(16, 64)))
    prior = 2.0
    segment = simulated(np.cumsum(gaps), radar=radar, prior=prior, seed=seed, samples=2000)
    low = 1.0 - 3.5 * segment.right_cycles.sampling_error / segment.right_cycles.value
    assert segment.right_cycles.value > segment.predicted_total * low
    assert segment.right_cycles.value < segment.predicted_total * (1.05 + 1.0 - low)
    assert abs(segment.wrong_cycles.deviation) < 4.0
    # With the prior, no estimate is better than the bound with the prior.
    joint = 1.0 / math.sqrt(segment.predicted_total**-2 + prior**-2)
    best = segment.most_likely
    assert best.value > joint * (1.0 - 3.5 * best.sampling_error / best.value) - 1e-3


@pytest.mark.parametrize(
    ("baselines", "prior"), [((0, 600, 1350), 4.0), ((0, 900), 4.0), ((0, 150, 600, 1500), 8.0)]
)
def test_wrong_cycles_come_as_often_as_bootstrapping_predicts(baselines, prior):
    """Failures of 0.5 to 40 %, within four sampling errors (at most 2 % of the pixels)."""
    segment = simulated(
        baselines, radar=radar_of(len(baselines), looks=32.0), prior=prior, samples=12_000
    )
    assert segment.predicted_failure > 0.005
    assert abs(segment.wrong_cycles.deviation) < 4.0
    # What bootstrapping loses, maximum likelihood over all cycles wins back in part.
    assert segment.most_likely.value < 1.03 * segment.unwrapped.value
    assert segment.best.value < segment.most_likely.value * 1.01


def test_errors_of_the_scene_are_common_to_its_pixels():
    """Position errors move both pixels of a draw alike; declared random they do not."""
    common = simulated([0, 315, 1350], radar=radar_of(3))
    errors = dataclasses.replace(
        REALISTIC, position=ErrorSource(0.001, SharedBy.SATELLITE, Scale.PIXEL)
    )
    random = simulated([0, 315, 1350], radar=radar_of(3), errors=errors)
    assert common.relative.value < 0.5 * common.right_cycles.value
    assert random.relative.value == pytest.approx(random.predicted_relative, rel=0.07)
    assert random.right_cycles.value == pytest.approx(common.right_cycles.value, rel=0.07)


def test_three_satellites_of_the_example_agree():
    """physics.md section 2: 315 m and 1350 m, 0.25 m in total, P about 0.99."""
    segment = simulated([0, 315, 1350], radar=radar_of(3))
    assert segment.right_cycles.value == pytest.approx(0.25, abs=0.015)
    assert segment.wrong.value == pytest.approx(0.01, abs=0.006)
    assert segment.bits > 1.0
    assert segment.two_thirds == pytest.approx(0.26, abs=0.02)


# -- designs that measure nothing ----------------------------------------------------------------


def test_ladder_of_shared_errors_measures_nothing():
    """1 cm, one look, steps of 1350 m at the paper's geometry: predicted 1.39 m, simulated 1.430 m
    within the ambiguity, where guessing blindly gives 1.432 m (physics.md: 1.429 m)."""
    scene = Scene.flat_earth(
        times=[0.0], slant_range=[557.58e3], look_angle=np.deg2rad([22.80]), azimuth=[np.pi / 2]
    )
    errors = ErrorBudget(
        position=ErrorSource(0.01, SharedBy.SATELLITE),
        range=ErrorSource(0.01, SharedBy.ALL),
        baseline_decorrelation=BaselineDecorrelation.UNFILTERED,
    )
    radar = radar_of(3, looks=1.0)
    segment = simulated(
        [0, 1350, 2700], radar=radar, errors=errors, prior=10.0, samples=20_000, scene=scene
    )
    ambiguity = 0.031 * 557.58e3 * math.sin(math.radians(22.80)) / 1350.0
    assert ambiguity / math.sqrt(12.0) == pytest.approx(1.432, abs=5e-4)
    within = segment.likely_errors - ambiguity * np.round(segment.likely_errors / ambiguity)
    # 20 000 samples give 0.3 %, 0.004 m.
    assert math.sqrt(np.mean(within**2)) == pytest.approx(1.429, abs=0.012)
    assert segment.predicted_total == pytest.approx(1.390, abs=1e-3)
    assert segment.bits == 0.0
    assert segment.verdict is Verdict.MEASURES_NOTHING


@pytest.mark.parametrize("name", ["li2009_space", "li2009_ground_track"])
def test_published_optimum_measures_nothing(name):
    """1.50 m and 1.30 m by the paper's covariance; in nature no more than the prior of 4 m."""
    setup = build_optimize(load_study(example_path(name)).study)
    problem = setup.problem
    published = assess(problem, setup.compare[0].states, label="published", names=("a", "b", "c"))
    assert published.height_error.region < 1.51
    (refuted_one,) = refuted(problem, [published], settings=setup.refutation, seed=1)
    result = refuted_one.refutation
    assert result.verdict is Verdict.MEASURES_NOTHING
    assert all(segment.wrong.value > 0.99 for segment in result.segments)
    assert all(segment.prior_height_std == 4.0 for segment in result.segments)
    assert len(result.departures) == 4


def test_nature_keeps_a_natural_budget_and_mends_the_others():
    assert natural_errors(REALISTIC) == (REALISTIC, ())
    mended = natural_errors(ErrorBudget.li2009()).errors
    assert mended.azimuth.shared_by is SharedBy.ALL
    assert mended.phase_std is None
    assert natural_errors(mended) == (mended, ())


@pytest.mark.parametrize(
    ("predicted", "value", "sampling_error", "height", "share"),
    [
        (1.00, 1.04, 0.001, False, True),  # 40 sampling errors, but no user notices 4 % of a height
        (1.00, 1.06, 0.001, True, True),
        (1.00, 1.06, 0.021, False, False),  # within three sampling errors
        (0.010, 0.019, 0.001, True, False),  # 0.9 % of the pixels
        (0.010, 0.021, 0.001, True, True),
        (math.inf, 1.0, 0.1, True, True),
    ],
)
def test_a_difference_counts_beyond_chance_and_beyond_what_matters(
    predicted, value, sampling_error, height, share
):
    comparison = Comparison(predicted, Simulated(value, sampling_error))
    assert (comparison.height_differs, comparison.share_differs) == (height, share)


def test_images_without_a_common_band_measure_nothing():
    segment = simulated([0, 4000], radar=radar_of(2), samples=400)
    assert not math.isfinite(segment.predicted_total)
    assert math.isnan(segment.total.deviation)
    assert segment.verdict is Verdict.MEASURES_NOTHING


# -- randomness and wrong input ------------------------------------------------------------------


def test_same_seed_same_bytes():
    one, same, other = (
        simulated([0, 315, 1350], radar=radar_of(3), samples=400, seed=seed) for seed in (7, 7, 8)
    )
    assert one.errors.tobytes() == same.errors.tobytes()
    assert one.likely_errors.tobytes() == same.likely_errors.tobytes()
    assert one.errors.tobytes() != other.errors.tobytes()


def test_many_images_are_drawn_less_often():
    radar = dataclasses.replace(radar_of(4), images=ping_pong(4))
    result = refute(
        formation([0, 100, 250, 500]),
        STRIP,
        radar=radar,
        errors=REALISTIC,
        prior_height_std=4.0,
        samples=4096,
        rng=np.random.default_rng(1),
    )
    assert 200 <= result.samples < 1000
    total = height_error(formation([0, 100, 250, 500]), STRIP, radar=radar, errors=REALISTIC).total[
        0
    ]
    assert result.segments[0].right_cycles.value == pytest.approx(total, rel=0.2)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"samples": 99}, "samples = 99 must be at least 100"),
        ({"prior_height_std": 0.0}, "prior_height_std = 0.0 must be"),
        ({"prior_height_std": math.inf}, "prior_height_std = inf must be"),
    ],
)
def test_wrong_input_is_refused(changes, message):
    arguments = {
        "radar": radar_of(2),
        "errors": REALISTIC,
        "prior_height_std": 4.0,
        "samples": 100,
        "rng": np.random.default_rng(1),
    }
    with pytest.raises(ValueError, match=message):
        refute(formation([0, 300]), STRIP, **(arguments | changes))


def test_too_many_images_are_refused():
    radar = dataclasses.replace(radar_of(11), images=ping_pong(11))
    assert len(radar.images) > MAX_IMAGES
    with pytest.raises(ValueError, match="too many to simulate"):
        refute(
            formation(np.arange(11) * 100.0),
            STRIP,
            radar=radar,
            errors=REALISTIC,
            prior_height_std=4.0,
            samples=100,
            rng=np.random.default_rng(1),
        )
