"""Exact phase noise in the height error, against maximum-likelihood heights of drawn speckle."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from insar import fisher_information, lessen_information, pair_efficiency
from insar.statistics import phase_efficiency, phase_variance

SAMPLES = 4000


def coherence_matrix(count, gamma):
    return np.where(np.eye(count, dtype=bool), 1.0, gamma)


def all_pairs(count):
    return np.stack(np.triu_indices(count, k=1), axis=-1)


def predicted(gamma, looks, kz, *, exact):
    """Height error of images with a coherence matrix, noise only."""
    information = fisher_information(gamma, looks=looks)
    pairs = all_pairs(len(kz))
    if exact:
        efficiency = pair_efficiency(gamma[tuple(pairs.T)], np.full(len(pairs), float(looks)))
        information = lessen_information(information, efficiency, pairs=pairs)
    return float(1 / np.sqrt(kz @ information @ kz))


def likely_heights(gamma, looks, kz, *, half, samples, rng):
    """Maximum-likelihood heights within ±half of the truth, from drawn complex speckle.

    The likelihood of a height depends on the data by the sample coherences of the pairs only. It
    is maximized on a grid, and refined on three finer ones.
    """
    count = len(kz)
    root = np.linalg.cholesky(gamma)
    drawn = rng.normal(size=(2, samples, count, looks))
    images = root @ (drawn[0] + 1j * drawn[1])
    sample = images @ np.conj(np.swapaxes(images, -1, -2))
    inverse = np.linalg.inv(gamma)
    pairs = all_pairs(count)

    def likelihood(height):
        total = np.zeros(height.shape)
        for i, j in pairs:
            turned = sample[:, i, j, None] * np.exp(-1j * height * (kz[i] - kz[j]))
            total -= 2 * inverse[i, j] * turned.real
        return total

    step = half / 48
    grid = np.broadcast_to(np.arange(-half, half + step / 2, step), (samples, 97))
    row = np.arange(samples)
    best = grid[row, np.argmax(likelihood(grid), axis=1)]
    for width in (step, step / 8, step / 64):
        grid = best[:, None] + np.linspace(-width, width, 17)
        best = grid[row, np.argmax(likelihood(grid), axis=1)]
    return np.clip(best, -half, half)


TWO = [(gamma, looks) for gamma in (0.4, 0.6, 0.8, 0.95) for looks in (4, 16, 64)]


@pytest.mark.parametrize(("gamma", "looks"), TWO)
@pytest.mark.parametrize("ambiguity", [10.0, 100.0])
def test_two_images_err_as_the_exact_statistics_say(gamma, looks, ambiguity):
    """Within 5 % (three sampling errors here) for every coherence and number of looks.

    The height is sought within half a height of ambiguity, which the phase error cannot leave.
    """
    kz = np.array([0.0, 2 * math.pi / ambiguity])
    matrix = coherence_matrix(2, gamma)
    rng = np.random.default_rng(round(100 * gamma) + looks)
    heights = likely_heights(matrix, looks, kz, half=ambiguity / 2, samples=SAMPLES, rng=rng)
    error = np.sqrt(np.mean(heights**2))
    assert error == pytest.approx(predicted(matrix, looks, kz, exact=True), rel=0.05)


@pytest.mark.parametrize(("gamma", "looks"), [(0.6, 16), (0.8, 8), (0.95, 4), (0.4, 64)])
@pytest.mark.parametrize("ambiguity", [10.0, 100.0])
def test_three_images_err_within_five_percent_where_cycles_are_found(gamma, looks, ambiguity):
    kz = 2 * math.pi / ambiguity * np.array([0.0, 0.25, 1.0])
    matrix = coherence_matrix(3, gamma)
    rng = np.random.default_rng(round(100 * gamma) + looks)
    heights = likely_heights(matrix, looks, kz, half=ambiguity / 2, samples=SAMPLES, rng=rng)
    error = np.sqrt(np.mean(heights**2))
    assert error == pytest.approx(predicted(matrix, looks, kz, exact=True), rel=0.05)


@pytest.mark.parametrize("count", range(2, 9))
def test_no_estimator_beats_the_bound(count):
    """Random formations and coherences: drawn errors are never below Cramér-Rao, beyond chance."""
    rng = np.random.default_rng(count)
    for _ in range(3):
        amplitude = rng.uniform(0.75, 0.97, count)
        matrix = np.outer(amplitude, amplitude)
        np.fill_diagonal(matrix, 1.0)
        kz = np.concatenate([[0.0], rng.uniform(-0.2, 0.2, count - 1)])
        looks = int(rng.integers(4, 24))
        longest = np.ptp(kz)
        heights = likely_heights(matrix, looks, kz, half=math.pi / longest, samples=1500, rng=rng)
        error = np.sqrt(np.mean(heights**2))
        bound = predicted(matrix, looks, kz, exact=False)
        # Sampling error of a deviation: 1/√(2n).
        assert error > bound * (1 - 4 / math.sqrt(2 * 1500))
        assert predicted(matrix, looks, kz, exact=True) >= bound


def test_two_images_have_the_exact_variance():
    for gamma, looks in [(0.3, 2.0), (0.9, 1.0), (0.8, 0.4), (0.7, 30.0)]:
        information = fisher_information(coherence_matrix(2, gamma), looks=looks)
        efficiency = pair_efficiency(np.array([gamma]), np.array([looks]))
        lessened = lessen_information(information, efficiency, pairs=all_pairs(2))
        exact = float(phase_variance(gamma, looks=looks))
        bound = 1 / information[0, 0]
        assert 1 / lessened[0, 0] == pytest.approx(max(exact, bound), rel=1e-5)
        assert_allclose(lessened.sum(axis=-1), 0.0, atol=1e-12)


def test_pairs_without_looks_or_coherence_lose_nothing():
    efficiency = pair_efficiency(np.array([0.0, 0.8, 0.8]), np.array([5.0, 0.0, 5.0]))
    assert_allclose(efficiency, [1.0, 1.0, phase_efficiency(0.8, looks=5.0)])
