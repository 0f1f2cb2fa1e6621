"""Exact distribution of the multilook interferometric phase."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import betainc, gammaln

Array = NDArray[np.float64]

_STEP = 0.2
_REACH = 125
"""The tail integral is a sum over 2·125 + 1 points, 0.2 apart in the logarithm: the trapezoidal
rule of an analytic integrand that dies away at both ends, exact to about 1e-10."""

_BLOCK = 2048
"""Elements of one pass of the tail integral: its accuracy and memory don't depend on the caller."""


def phase_pdf(phase_error: ArrayLike, *, coherence: ArrayLike, looks: ArrayLike) -> Array:
    """Probability density of the phase error of an interferogram.

    Parameters
    ----------
    phase_error : (...) — φ, the phase less its expectation [rad]; periodic.
    coherence : (...) — magnitude γ, 0 to below 1.
    looks : (...) — independent looks L, above 0; need not be whole.

    Returns
    -------
    (...) — density over (−π, π] [1/rad].

    Raises
    ------
    ValueError
        If a coherence is outside [0, 1) or a number of looks is not positive.

    Notes
    -----
    With β = γ cos φ the published form is
    f = Γ(L+½)(1−γ²)^L β / [2√π Γ(L)(1−β²)^{L+½}] + (1−γ²)^L/(2π)·₂F₁(L, 1; ½; β²). The
    hypergeometric function is elementary but for an incomplete beta function,
    ₂F₁(L, 1; ½; β²) = 1 + √π β Γ(L+½)/Γ(L) (1−β²)^{−L−½} [1 − I_{1−β²}(L+½, ½)], so that

        f = (1−γ²)^L/(2π) + Γ(L+½)(1−γ²)^L |β| T / [√π Γ(L)(1−β²)^{L+½}]

    with T = 1 − I/2 for β > 0 and −I/2 below. Powers and gamma functions are taken together in
    the logarithm: nothing overflows. Below one look see `insar.statistics`.

    References
    ----------
    Lee et al. 1994, doi:10.1109/36.312890; Tough et al. 1995, doi:10.1098/rspa.1995.0071.

    Examples
    --------
    >>> phase_pdf([0.0, 1.0, 3.0], coherence=0.8, looks=4.0).round(6)
    array([1.458739e+00, 2.095700e-02, 4.110000e-04])
    """
    phi = np.asarray(phase_error, dtype=np.float64)
    gamma, number = checked(coherence, looks)
    beta = gamma * np.cos(phi)
    # 1 − β² without loss near γ = 1, φ = 0.
    uncorrelated = (1.0 - gamma) * (1.0 + gamma)
    spread = uncorrelated + (gamma * np.sin(phi)) ** 2
    half = 0.5 * betainc(number + 0.5, 0.5, spread)
    side = np.where(beta > 0.0, 1.0 - half, -half)
    scale = (
        gammaln(number + 0.5)
        - gammaln(number)
        + number * np.log(uncorrelated / spread)
        - 0.5 * np.log(spread)
    )
    floor = np.exp(number * np.log(uncorrelated)) / (2.0 * np.pi)
    density = floor + np.exp(scale) * np.abs(beta) * side / math.sqrt(np.pi)
    # Opposite the signal the two terms nearly cancel; rounding must not leave less than nothing.
    return np.asarray(np.maximum(density, 0.0))


def phase_cdf(phase_error: ArrayLike, *, coherence: ArrayLike, looks: ArrayLike) -> Array:
    """Probability that the phase error is at most a given value.

    Parameters
    ----------
    phase_error : (...) — φ from −π to π; values outside count as the nearer end [rad].
    coherence, looks : (...) — as for `phase_pdf`.

    Returns
    -------
    (...) — F(φ), from 0 to 1, within 1e-9.

    Raises
    ------
    ValueError
        If a coherence is outside [0, 1) or a number of looks is not positive.
    """
    phi = np.asarray(phase_error, dtype=np.float64)
    tail = 0.5 * phase_exceedance(np.abs(phi), coherence=coherence, looks=looks)
    return np.asarray(np.where(phi < 0.0, tail, 1.0 - tail))


def phase_exceedance(limit: ArrayLike, *, coherence: ArrayLike, looks: ArrayLike) -> Array:
    """Probability that the phase error exceeds a limit in magnitude.

    Parameters
    ----------
    limit : (...) — α, 0 to π; values above π count as π [rad].
    coherence, looks : (...) — as for `phase_pdf`.

    Returns
    -------
    (...) — P(|φ| > α); its relative error is about 1e-9, also far out.

    Raises
    ------
    ValueError
        If a coherence is outside [0, 1) or a number of looks is not positive.

    Notes
    -----
    Given the power a of the first image, summed over the looks, the interferogram is a constant
    plus circular Gaussian noise, of signal-to-noise ratio κa, κ = γ²/(1 − γ²). Its phase leaves a
    wedge ±α with probability (1/π)∫₀^{π−α} exp(−κa sin²α/sin²θ) dθ, and a is gamma distributed
    with L, so

        P(|φ| > α) = (1/π) ∫₀^{π−α} (1 + κ sin²α/sin²θ)^{−L} dθ:

    no special function, nothing negative, for any real L > 0. With x = cot θ and b = B/(1 + B),
    B = κ sin²α, the integrand is (1 + B)^{−L}(1 + bx²)^{−L}/(1 + x²).

    References
    ----------
    The wedge: Craig 1991, doi:10.1109/MILCOM.1991.258319; Pawula 1999, doi:10.1109/26.752119.
    """
    alpha = np.asarray(limit, dtype=np.float64)
    gamma, number = checked(coherence, looks)
    alpha, gamma, number = np.broadcast_arrays(np.clip(alpha, 0.0, np.pi), gamma, number)
    shape = alpha.shape
    result = np.empty(alpha.size)
    flat = [value.ravel() for value in (alpha, gamma, number)]
    for start in range(0, alpha.size, _BLOCK):
        part = slice(start, start + _BLOCK)
        result[part] = _exceedance(*(value[part] for value in flat))
    return np.asarray(result.reshape(shape))


def _exceedance(alpha: Array, gamma: Array, looks: Array) -> Array:
    sine, cosine = np.sin(alpha), np.cos(alpha)
    uncorrelated = (1.0 - gamma) * (1.0 + gamma)
    base = (gamma * sine) ** 2 / uncorrelated  # B
    share = base / (1.0 + base)
    with np.errstate(divide="ignore"):
        edge = np.abs(cosine) / sine  # |cot α|
    beyond = np.where(np.isfinite(edge), _tail(np.where(sine > 0.0, edge, 0.0), share, looks), 0.0)
    inside = cosine > 0.0
    whole = _tail(np.zeros_like(edge), share, looks)
    integral = np.where(inside, 2.0 * whole - beyond, beyond)
    return np.exp(-looks * np.log1p(base)) * integral / np.pi


def _tail(edge: Array, share: Array, looks: Array) -> Array:
    """∫ from `edge` of (1 + bx²)^{−L}/(1 + x²) dx, by the trapezoidal rule in ln(x − edge)."""
    # The scale on which the integrand falls beyond the edge, from its logarithmic derivative.
    slope = 2.0 * edge / (1.0 + edge**2) + 2.0 * looks * share * edge / (1.0 + share * edge**2)
    curvature = 1.0 / (1.0 + edge**2) + looks * share / (1.0 + share * edge**2)
    scale = 1.0 / (slope + np.sqrt(curvature))
    nodes = _STEP * np.arange(-_REACH, _REACH + 1)
    step = scale[:, None] * np.exp(nodes)
    squared = (edge[:, None] + step) ** 2
    exponent = -looks[:, None] * np.log1p(share[:, None] * squared)
    integral: Array = _STEP * np.sum(np.exp(exponent) * step / (1.0 + squared), axis=-1)
    return integral


def checked(coherence: ArrayLike, looks: ArrayLike) -> tuple[Array, Array]:
    """Coherence and looks as arrays, refused where no distribution exists."""
    gamma = np.asarray(coherence, dtype=np.float64)
    number = np.asarray(looks, dtype=np.float64)
    if not np.all((gamma >= 0.0) & (gamma < 1.0)):
        wrong = gamma[~((gamma >= 0.0) & (gamma < 1.0))].flat[0]
        raise ValueError(f"coherence = {wrong!r} must lie from 0 to below 1")
    if not np.all((number > 0.0) & np.isfinite(number)):
        wrong = number[~((number > 0.0) & np.isfinite(number))].flat[0]
        raise ValueError(f"looks = {wrong!r} must be finite and positive")
    return gamma, number
