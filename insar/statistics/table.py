"""Variance of the multilook phase, computed once for all coherences and numbers of looks."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf, erfcx, gammaln

Array = NDArray[np.float64]

UNIFORM_VARIANCE = np.pi**2 / 3.0
"""Variance of a phase without information, uniform over a cycle [rad²]."""

_PER_UNIT = 16
"""Points of the trapezoidal rule, in the logarithm of the power, per unit. Its error is
exp(−2π²·256/L) where the gamma density of L looks is a narrow peak: 3e-9 at 256 looks."""

_LOWEST, _HIGHEST = -32, 46
"""Range of ln(κ(1 + L)): below it the phase is uniform within 1e-7, above it no double is."""

_MEMORY = 90
"""Reach of the gamma density to small powers, in the logarithm. What lies below meets a uniform
phase, and is added in closed form."""

SPACING = 1.0 / _PER_UNIT
"""Step of the table in ln(κ(1 + L))."""

SHARES = 256
"""Steps of the table in 1/(1 + L), from 0 (infinitely many looks) to 1 (none)."""


def fixed_signal_variance(signal_to_noise: Array) -> Array:
    """Variance of the phase of a constant signal in circular Gaussian noise.

    Parameters
    ----------
    signal_to_noise : (...) — ρ, power ratio, above 0.

    Returns
    -------
    (...) — π²/3 at ρ → 0, 1/(2ρ) at ρ → ∞ [rad²].

    Notes
    -----
    Twice the integral of φ² times the density
    e^{−ρ}/2π + √(ρ/π)/2·cos φ e^{−ρ sin²φ}(1 + erf(√ρ cos φ)) over half a cycle, or the part of
    it that matters, by 96 Gauss points.
    """
    node, weight = np.polynomial.legendre.leggauss(96)
    root = np.sqrt(np.asarray(signal_to_noise, dtype=np.float64))[..., None]
    reach = np.minimum(np.pi, 20.0 / root)
    phi = 0.5 * reach * (node + 1.0)
    amplitude = root * np.cos(phi)
    ahead = np.maximum(amplitude, 0.0)
    behind = np.maximum(-amplitude, 0.0)
    # (1 + erf x) of negative x as erfcx(−x)e^{−x²}, so that the two terms cancel to the last digit.
    near = 0.5 / np.sqrt(np.pi) * ahead * np.exp(-((root * np.sin(phi)) ** 2)) * (1.0 + erf(ahead))
    far = -0.5 / np.sqrt(np.pi) * behind * erfcx(behind) * np.exp(-(root**2))
    density = np.exp(-(root**2)) / (2.0 * np.pi) + near + far
    variance: Array = reach[..., 0] * np.sum(weight * phi**2 * density, axis=-1)
    return variance


@cache
def log_variance_table() -> Array:
    """Logarithm of the exact phase variance over ln(κ(1 + L)) and 1/(1 + L).

    Returns
    -------
    (rows, SHARES + 1) — ln σ² [ln rad²], κ = γ²/(1 − γ²); row i at `_LOWEST` + i·`SPACING`.

    Notes
    -----
    Given the power a of one image summed over the looks, the interferogram is a constant in
    noise of signal-to-noise ratio κa; a is gamma distributed with L. So σ²(γ, L) is the gamma
    mean of `fixed_signal_variance`: over ln a, on equal steps, a sum of one function of κa times
    one function of a. In the coordinates of the table both limits are regular: many looks
    (1/(1 + L) → 0) is `fixed_signal_variance` itself.
    """
    step = 1.0 / _PER_UNIT
    share = np.arange(SHARES + 1)[1:-1] / SHARES
    looks = 1.0 / share - 1.0
    lags = np.arange(-_MEMORY * _PER_UNIT, 5 * _PER_UNIT + 1)
    # With a = e^lag/share the power κa is e^(row + lag).
    log_power = step * lags[:, None] - np.log(share)
    kernel = step * np.exp(looks * log_power - np.exp(log_power) - gammaln(looks))
    # The sum goes on to −∞ as a geometric series: e^{−a} is 1 there, and the phase uniform.
    below = looks * (log_power[0] - step) - gammaln(looks)
    constant = UNIFORM_VARIANCE * step * np.exp(below) / -np.expm1(-looks * step)

    count = (_HIGHEST - _LOWEST) * _PER_UNIT
    points = _LOWEST + step * np.arange(lags[0], count + lags[-1])
    variance = fixed_signal_variance(np.exp(points))
    windows = np.lib.stride_tricks.sliding_window_view(variance, len(lags))
    table = np.empty((count, SHARES + 1))
    table[:, 0] = variance[-lags[0] : -lags[0] + count]
    table[:, 1:-1] = windows @ kernel + constant
    table[:, -1] = UNIFORM_VARIANCE
    logarithm: Array = np.log(table)
    logarithm.setflags(write=False)
    return logarithm


def log_variance(log_contrast: Array, looks: Array) -> Array:
    """Logarithm of the exact phase variance, read from the table.

    Parameters
    ----------
    log_contrast : (...) — ln κ, κ = γ²/(1 − γ²); −inf without coherence.
    looks : (...) — L, 0 or more.

    Returns
    -------
    (...) — ln σ² [ln rad²], by cubic interpolation over 4 × 4 points.
    """
    table = log_variance_table()
    share = 1.0 / (1.0 + looks)
    row = (log_contrast - np.log(share) - _LOWEST) / SPACING
    row = np.clip(row, 0.0, len(table) - 1.0)
    row_start, row_weight = _cubic(row, len(table))
    start, weight = _cubic(share * SHARES, SHARES + 1)
    flat = table.ravel()
    corner = row_start * (SHARES + 1) + start
    result = np.zeros(np.broadcast_shapes(log_contrast.shape, looks.shape))
    for i in range(4):
        along = np.zeros_like(result)
        for j in range(4):
            along += weight[j] * np.take(flat, corner + (i * (SHARES + 1) + j))
        result += row_weight[i] * along
    return result


class VarianceLine(NamedTuple):
    """The table at a given number of looks.

    Attributes
    ----------
    start : ln κ of the first value.
    spacing : step of ln κ from value to value.
    values : (rows,) — ln σ² [ln rad²].
    """

    start: float
    spacing: float
    values: Array


def log_variance_line(looks: float) -> VarianceLine:
    """Logarithm of the exact phase variance over the contrast alone.

    Parameters
    ----------
    looks : scalar — L, above 0.

    Returns
    -------
    VarianceLine — the cubics over its points are those of `log_variance`.
    """
    share = 1.0 / (1.0 + looks)
    start, weight = _cubic(np.array(share * SHARES), SHARES + 1)
    columns = log_variance_table()[:, int(start) : int(start) + 4]
    values = columns @ np.array([float(part) for part in weight])
    return VarianceLine(float(_LOWEST + np.log(share)), SPACING, values)


def _cubic(position: Array, count: int) -> tuple[NDArray[np.intp], tuple[Array, ...]]:
    """First of the four points around a position, and their Lagrange weights."""
    start = np.clip(position.astype(np.intp) - 1, 0, count - 4)
    t = position - start
    a, b, c = t - 1.0, t - 2.0, t - 3.0
    ab, tc = a * b, t * c
    return start, (ab * c / -6.0, tc * b * 0.5, tc * a * -0.5, t * ab / 6.0)
