"""What the phases of N images tell."""

from __future__ import annotations

import itertools
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from insar import common_band, fisher_information, snr_coherence
from insar.phase_information import (
    filtered_information,
    independent_pairs_information,
    pair_phase_variance,
)

PUBLISHED = tomllib.loads(
    (Path(__file__).parent / "published" / "error_model.toml").read_text(encoding="utf-8")
)
offsets = st.lists(st.floats(-1.5, 1.5), min_size=2, max_size=5).map(np.array)


def height_std(information, kz):
    return 1 / np.sqrt(kz @ information @ kz)


def test_three_images_are_not_three_independent_pairs():
    case = PUBLISHED["three_images"]
    gamma, looks = case["coherence"], case["looks"]
    kz = np.array(case["vertical_wavenumber_rad_m"])
    coherence = np.full((3, 3), gamma) + (1 - gamma) * np.eye(3)
    pairs = np.array([[0, 1], [0, 2], [1, 2]])
    variance = np.full(3, pair_phase_variance(gamma, looks=looks))
    independent = independent_pairs_information(variance, pairs=pairs, count=3)
    joint = fisher_information(coherence, looks=looks)
    assert height_std(joint, kz) == pytest.approx(case["joint_m"], abs=5e-5)
    assert height_std(independent, kz) == pytest.approx(case["independent_pairs_m"], abs=5e-5)
    longest = np.sqrt(variance[0]) / kz[2]
    assert longest == pytest.approx(case["longest_pair_m"], abs=5e-5)


def test_two_images_meet_the_pair_bound():
    gamma, looks = 0.7, 4.0
    information = fisher_information(np.array([[1, gamma], [gamma, 1]]), looks=looks)
    expected = 1 / pair_phase_variance(gamma, looks=looks)
    assert_allclose(information, expected * np.array([[1, -1], [-1, 1]]))
    # Cramér-Rao checks of physics: (0.7, 4) → 0.3607 rad, (0.8, 16) → 0.1326 rad.
    assert np.sqrt(1 / expected) == pytest.approx(0.3607, abs=5e-5)
    assert np.sqrt(pair_phase_variance(0.8, looks=16)) == pytest.approx(0.1326, abs=5e-5)


def test_fisher_information_against_the_score_of_simulated_speckle():
    """The covariance of the log-likelihood's numerical gradient, complex coherence included."""
    rng = np.random.default_rng(3)
    mixing = rng.normal(size=(3, 5)) + 1j * rng.normal(size=(3, 5))
    gamma = mixing @ mixing.conj().T
    scale = np.sqrt(np.real(np.diag(gamma)))
    gamma = gamma / scale[:, None] / scale
    root = np.linalg.cholesky(gamma)
    samples = 40_000
    z = (rng.normal(size=(samples, 3)) + 1j * rng.normal(size=(samples, 3))) / np.sqrt(2) @ root.T

    def log_likelihood(phase):
        turn = np.exp(1j * phase)
        sigma = gamma * turn[:, None] * turn.conj()
        return -np.real(np.einsum("si,ij,sj->s", z.conj(), np.linalg.inv(sigma), z))

    step = 1e-5
    score = np.stack(
        [
            (log_likelihood(step * axis) - log_likelihood(-step * axis)) / (2 * step)
            for axis in np.eye(3)
        ]
    )
    expected = fisher_information(gamma, looks=1.0)
    # 40 000 samples: 1 % of the largest entry, at three sigma.
    assert_allclose(score @ score.T / samples, expected, atol=0.03 * np.max(np.abs(expected)))


@given(offsets, st.floats(0.3, 0.99), st.floats(1, 50))
def test_filtered_information_against_explicit_subsets(offset, amplitude, looks):
    """Sum over band intervals of the Fisher information of the images that see each."""
    count = len(offset)
    edges = np.unique(np.concatenate([offset, offset + 1]))
    expected = np.zeros((count, count))
    for low, high in itertools.pairwise(edges):
        middle = (low + high) / 2
        seen = np.flatnonzero((offset <= middle) & (middle <= offset + 1))
        if len(seen) < 2:
            continue
        gamma = np.full((len(seen), len(seen)), amplitude**2)
        np.fill_diagonal(gamma, 1.0)
        expected[np.ix_(seen, seen)] += (high - low) * fisher_information(gamma, looks=looks)
    result = filtered_information(offset, image_coherence=amplitude, looks=looks)
    assert_allclose(result, expected, rtol=1e-9, atol=1e-9 * looks / (1 - amplitude**2))


@given(offsets, st.floats(0.3, 0.99))
def test_information_is_a_semidefinite_laplacian(offset, amplitude):
    information = filtered_information(offset, image_coherence=amplitude, looks=5.0)
    assert_allclose(information.sum(axis=-1), 0, atol=1e-9)
    assert_allclose(information, information.T)
    assert np.linalg.eigvalsh(information).min() > -1e-9


@given(offsets, st.floats(0.01, 0.5))
def test_information_grows_with_the_common_band(offset, shrink):
    """Bringing all bands closer removes no data, so it removes no information."""
    wide = filtered_information(offset, image_coherence=0.95, looks=1.0)
    narrow = filtered_information(offset * (1 - shrink), image_coherence=0.95, looks=1.0)
    assert np.linalg.eigvalsh(narrow - wide).min() > -1e-8


def test_two_filtered_images_keep_their_coherence_and_lose_looks():
    gamma, looks, shift = 0.9, 16.0, 0.25
    result = filtered_information([0.0, shift], image_coherence=np.sqrt(gamma), looks=looks)
    expected = 1 / pair_phase_variance(gamma, looks=looks * common_band(0.0, shift))
    assert result[0, 0] == pytest.approx(expected)


@pytest.mark.parametrize(("share", "gain"), [(0.25, 4.0), (0.5, 9.0)])
def test_filtering_gain(share, gain):
    """4 to 9 times the unfiltered information, at SNR 10 dB (physics, section 2)."""
    gamma = snr_coherence(10.0, 10.0)
    filtered = 1 / pair_phase_variance(gamma, looks=1 - share)
    unfiltered = 1 / pair_phase_variance(gamma * (1 - share), looks=1)
    assert filtered / unfiltered == pytest.approx(gain, rel=0.1)


@pytest.mark.parametrize(("filtered", "optimum"), [(True, 2 / 3), (False, 0.42)])
def test_optimal_two_image_baseline(filtered, optimum):
    gamma = snr_coherence(10.0, 10.0)

    def height_variance(share):
        if filtered:
            return pair_phase_variance(gamma, looks=1 - share) / share**2
        return pair_phase_variance(gamma * (1 - share), looks=1) / share**2

    best = minimize_scalar(height_variance, bounds=(0.05, 0.95), method="bounded").x
    assert best == pytest.approx(optimum, abs=5e-3)


def test_images_without_a_common_band_tell_nothing():
    information = filtered_information([0.0, 1.0, 5.0], image_coherence=0.9, looks=10.0)
    assert np.all(information == 0.0)
    assert np.isinf(pair_phase_variance(0.0, looks=4.0))
