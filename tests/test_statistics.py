"""Exact statistics of the multilook phase."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.special import gammaln, hyp2f1, spence

from insar.statistics import (
    cramer_rao_std,
    difference_quantile,
    efficiency_curves,
    phase_cdf,
    phase_efficiency,
    phase_exceedance,
    phase_pdf,
    phase_quantile,
    phase_std,
    phase_variance,
)

COHERENCES = st.one_of(
    st.floats(0.01, 0.999), st.floats(1e-8, 1e-2).map(lambda loss: 1.0 - loss), st.just(0.0)
)
LOOKS = st.floats(math.log(0.05), math.log(5e3)).map(math.exp)


def published_pdf(phi, gamma, looks):
    """The density as it is printed, for arguments that overflow nothing."""
    beta = gamma * np.cos(phi)
    ratio = np.exp(gammaln(looks + 0.5) - gammaln(looks))
    return ratio * (1 - gamma**2) ** looks * beta / (
        2 * math.sqrt(math.pi) * (1 - beta**2) ** (looks + 0.5)
    ) + (1 - gamma**2) ** looks / (2 * math.pi) * hyp2f1(looks, 1, 0.5, beta**2)


def panels(gamma, looks):
    """Ends of panels from the center of the distribution to half a cycle, each twice as long."""
    ends = [0.0, min(0.3 * float(cramer_rao_std(max(gamma, 1e-3), looks=looks)), 1.0)]
    while ends[-1] < math.pi:
        ends.append(min(2.0 * ends[-1], math.pi))
    return ends


def quadrature(function, ends):
    """Integral of a function over panels of 50 Gauss points each."""
    node, weight = np.polynomial.legendre.leggauss(50)
    start, width = np.array(ends[:-1])[:, None], np.diff(ends)[:, None]
    return float(np.sum(0.5 * width * weight * function(start + 0.5 * width * (node + 1))))


def correlated_speckle(gamma, looks, count, rng):
    """Phase errors of `count` interferograms of complex circular Gaussian speckle."""
    first, second = rng.normal(size=(2, 2, looks, count))
    one = first[0] + 1j * first[1]
    two = gamma * one + math.sqrt(1 - gamma**2) * (second[0] + 1j * second[1])
    return np.angle(np.sum(one.conj() * two, axis=0))


@pytest.mark.parametrize(
    ("gamma", "looks", "exact", "bound"),
    [
        (0.6, 1, 1.2177, 0.9428),
        (0.9, 1, 0.6916, 0.3425),
        (0.7, 4, 0.4843, 0.3607),
        (0.8, 16, 0.1384, 0.1326),
    ],
)
def test_tabulated_values(gamma, looks, exact, bound):
    assert phase_std(gamma, looks=looks) == pytest.approx(exact, abs=5e-5)
    assert cramer_rao_std(gamma, looks=looks) == pytest.approx(bound, abs=5e-5)


@pytest.mark.parametrize("gamma", [0.0, 0.1, 0.5, 0.9, 0.99, 0.9999])
def test_single_look_in_closed_form(gamma):
    """σ² = π²/3 − π asin γ + asin² γ − Li₂(γ²)/2, Li₂(x) = spence(1 − x)."""
    variance = (
        math.pi**2 / 3
        - math.pi * math.asin(gamma)
        + math.asin(gamma) ** 2
        - spence(1 - gamma**2) / 2
    )
    # The closed form itself loses digits where it is small.
    assert phase_variance(gamma, looks=1.0) == pytest.approx(variance, rel=2e-6, abs=1e-12)


@given(COHERENCES, LOOKS)
def test_the_table_against_quadrature(gamma, looks):
    variance = quadrature(
        lambda phi: 2 * phi**2 * phase_pdf(phi, coherence=gamma, looks=looks), panels(gamma, looks)
    )
    assert phase_std(gamma, looks=looks) == pytest.approx(math.sqrt(variance), rel=1e-6)


@given(st.floats(0.01, 0.95), st.floats(0.2, 60.0), st.floats(-math.pi, math.pi))
def test_the_density_is_the_published_one(gamma, looks, phi):
    expected = published_pdf(phi, gamma, looks)
    # The printed form subtracts equal terms opposite the signal: relative to its first term.
    scale = published_pdf(math.pi - abs(phi) if abs(phi) > math.pi / 2 else phi, gamma, looks)
    assert phase_pdf(phi, coherence=gamma, looks=looks) == pytest.approx(
        expected, rel=1e-9, abs=1e-9 * scale
    )


@given(COHERENCES, LOOKS)
def test_the_density_integrates_to_one(gamma, looks):
    half = quadrature(
        lambda phi: phase_pdf(phi, coherence=gamma, looks=looks), panels(gamma, looks)
    )
    assert half == pytest.approx(0.5, abs=1e-8)


@given(COHERENCES, LOOKS, st.floats(0.02, 6.0))
def test_the_tail_is_the_integral_of_the_density(gamma, looks, deviations):
    limit = min(deviations * float(phase_std(gamma, looks=looks)), 3.0)
    ends = [limit, *(end for end in panels(gamma, looks) if end > limit)]
    tail = quadrature(lambda phi: phase_pdf(phi, coherence=gamma, looks=looks), ends)
    exceeded = float(phase_exceedance(limit, coherence=gamma, looks=looks))
    assert exceeded == pytest.approx(2 * tail, rel=1e-7, abs=1e-10)
    assert phase_cdf(limit, coherence=gamma, looks=looks) == pytest.approx(1 - exceeded / 2)
    assert phase_cdf(-limit, coherence=gamma, looks=looks) == pytest.approx(exceeded / 2)


def test_many_looks_meet_the_cramer_rao_bound():
    """The exact variance exceeds the bound by a part of order 1/L: tenfold looks, a tenth of it."""
    looks = np.array([100.0, 1000.0, 10000.0])
    for gamma in (0.3, 0.6, 0.9):
        excess = 1 / phase_efficiency(gamma, looks=looks) - 1
        assert np.all(excess > 0)
        assert_allclose(excess[1:] / excess[:-1], 0.1, rtol=0.2)
    assert phase_efficiency(0.6, looks=10000.0) == pytest.approx(1.0, abs=3e-4)


@pytest.mark.parametrize(("gamma", "looks"), [(0.4, 1), (0.7, 4), (0.95, 1), (0.8, 16)])
def test_correlated_speckle_has_this_distribution(gamma, looks):
    rng = np.random.default_rng(5)
    count = 200_000
    phase = correlated_speckle(gamma, looks, count, rng)
    deviation = float(phase_std(gamma, looks=looks))
    # 4 sigma of the sample variance, by the sample's own fourth moment.
    spread = np.std(phase**2) / math.sqrt(count)
    assert np.mean(phase**2) == pytest.approx(deviation**2, abs=4 * spread)
    limits = deviation * np.array([0.5, 1.0, 2.0])
    within = np.mean(np.abs(phase[:, None]) <= limits, axis=0)
    expected = 1 - phase_exceedance(limits, coherence=gamma, looks=looks)
    assert_allclose(within, expected, atol=4 * 0.5 / math.sqrt(count))
    pairs = np.abs(phase[::2] - phase[1::2])
    limit = difference_quantile(gamma, looks=looks)
    assert np.mean(pairs <= limit) == pytest.approx(0.9, abs=4 * 0.3 / math.sqrt(count / 2))


@pytest.mark.parametrize(("gamma", "looks"), [(0.8, 0.3), (0.6, 2.5)])
def test_a_number_of_looks_need_not_be_whole(gamma, looks):
    """Drawn as a constant in noise whose signal power is gamma distributed."""
    rng = np.random.default_rng(6)
    count = 300_000
    power = gamma**2 / (1 - gamma**2) * rng.gamma(looks, size=count)
    noise = rng.normal(size=(2, count)) / math.sqrt(2)
    phase = np.angle(np.sqrt(power) + noise[0] + 1j * noise[1])
    spread = np.std(phase**2) / math.sqrt(count)
    assert np.mean(phase**2) == pytest.approx(
        float(phase_variance(gamma, looks=looks)), abs=4 * spread
    )


def test_without_coherence_or_looks_the_phase_is_uniform():
    assert phase_std(0.0, looks=5.0) == pytest.approx(math.pi / math.sqrt(3), rel=1e-7)
    assert phase_std(0.7, looks=1e-6) == pytest.approx(math.pi / math.sqrt(3), rel=1e-4)
    assert_allclose(phase_pdf([0, 1, 3], coherence=0.0, looks=3.0), 1 / (2 * math.pi))
    # The difference of two uniform phases is triangular over ±2π.
    uniform = 2 * math.pi * (1 - math.sqrt(0.1))
    assert difference_quantile(0.0, looks=1.0) == pytest.approx(uniform, rel=1e-6)


def test_full_coherence_in_the_limit():
    """γ → 1 above one look: (1 − γ²)/(2(L − 1)), one look less than the bound has."""
    loss = 1e-7
    variance = phase_variance(1 - loss, looks=np.array([3.0, 30.0]))
    assert_allclose(variance, (2 * loss - loss**2) / (2 * np.array([2.0, 29.0])), rtol=1e-4)


@given(st.floats(0.0, 0.999), st.floats(0.0, 0.999), LOOKS, st.floats(1.0, 10.0))
def test_more_coherence_or_looks_is_less_noise(one, two, looks, factor):
    low, high = sorted((one, two))
    rounding = 1 + 1e-6
    assert phase_std(high, looks=looks) <= phase_std(low, looks=looks) * rounding
    assert phase_std(low, looks=looks * factor) <= phase_std(low, looks=looks) * rounding


@given(st.floats(0.01, 0.99), st.floats(0.2, 200.0), st.sampled_from([0.5, 0.9, 0.99]))
def test_quantiles_invert_the_distribution(gamma, looks, level):
    limit = phase_quantile(gamma, looks=looks, level=level)
    exceeded = float(phase_exceedance(limit, coherence=gamma, looks=looks))
    assert exceeded == pytest.approx(1 - level, rel=1e-6)


def test_point_to_point_quantile_of_many_looks_is_gaussian():
    gaussian = 1.644854 * math.sqrt(2) * phase_std(0.8, looks=5000.0)
    assert difference_quantile(0.8, looks=5000.0) == pytest.approx(gaussian, rel=1e-4)


@given(st.lists(COHERENCES, min_size=1, max_size=4), st.floats(1e-4, 1e5))
def test_curves_are_the_efficiency(coherences, looks):
    curves = efficiency_curves(coherences)
    expected = phase_efficiency(coherences, looks=looks)
    assert_allclose(curves(np.full(len(coherences), looks)), expected, rtol=1e-5)
    assert np.all(curves(np.zeros(len(coherences))) == 1.0)


def test_arrays_equal_single_calls():
    rng = np.random.default_rng(3)
    gamma, looks = rng.uniform(0, 1, (2, 1)), rng.uniform(0.3, 40, 5000)
    together = phase_std(gamma, looks=looks)
    assert together.shape == (2, 5000)
    assert together[1, 4321] == phase_std(gamma[1, 0], looks=looks[4321])
    tail = phase_exceedance(1.0, coherence=gamma, looks=looks)
    assert tail[1, 4321] == phase_exceedance(1.0, coherence=gamma[1, 0], looks=looks[4321])


@pytest.mark.parametrize(
    ("gamma", "looks", "reason"),
    [
        (1.0, 4.0, "coherence = "),
        (-0.1, 4.0, "coherence = "),
        (math.nan, 4.0, "coherence = "),
        (0.5, 0.0, "looks = "),
        (0.5, math.inf, "looks = "),
    ],
)
def test_impossible_arguments_are_refused(gamma, looks, reason):
    for function in (phase_std, cramer_rao_std, phase_efficiency, difference_quantile):
        with pytest.raises(ValueError, match=reason):
            function(gamma, looks=looks)
    with pytest.raises(ValueError, match="level = 1"):
        difference_quantile(0.5, looks=1.0, level=1.0)
