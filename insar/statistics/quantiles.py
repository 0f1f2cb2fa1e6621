"""Quantiles of the phase error, and of the difference of two: the point-to-point error."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from ..phase_information import pair_phase_variance
from .distribution import checked, phase_pdf

Array = NDArray[np.float64]

_INTERVALS = 240
"""Intervals of the grid from the center of the distribution to half a cycle."""

_NODE, _WEIGHT = np.polynomial.legendre.leggauss(4)


def phase_quantile(coherence: ArrayLike, *, looks: ArrayLike, level: float = 0.9) -> Array:
    """Limit that the magnitude of the phase error keeps with a given probability.

    Parameters
    ----------
    coherence : (...) — magnitude γ, 0 to below 1.
    looks : (...) — independent looks L, above 0; need not be whole.
    level : scalar — the probability, between 0 and 1.

    Returns
    -------
    (...) — α with P(|φ| ≤ α) = level, within 1e-6 of itself [rad].

    Raises
    ------
    ValueError
        If a coherence is outside [0, 1), a number of looks is not positive, or the level is not
        between 0 and 1.
    """
    return _each(coherence, looks, level, _phase_quantile)


def difference_quantile(coherence: ArrayLike, *, looks: ArrayLike, level: float = 0.9) -> Array:
    """Limit that the difference of two independent phase errors keeps with a given probability.

    The point-to-point height error of an elevation model is this times the height of ambiguity
    over 2π, at a level of 90 %.

    Parameters
    ----------
    coherence, looks, level : as for `phase_quantile`.

    Returns
    -------
    (...) — d with P(|φ₁ − φ₂| ≤ d) = level, within 1e-6 of itself; at most 2π [rad].

    Raises
    ------
    ValueError
        As `phase_quantile`.

    Notes
    -----
    Each phase error lies within half a cycle (the prior height decides the cycle), their
    difference within one: it is not wrapped again. Gaussian errors have 1.6449·√2·σ_φ at 90 %;
    with few looks it may be more or less. Some milliseconds for each distinct pair of arguments.

    References
    ----------
    Krieger et al. 2007, doi:10.1109/TGRS.2007.900693, section III-C.

    Examples
    --------
    >>> difference_quantile(0.8, looks=[1.0, 16.0]).round(4)
    array([2.2327, 0.3212])
    """
    return _each(coherence, looks, level, _difference_quantile)


class _Distribution(NamedTuple):
    """The half distribution of a phase error on a grid α = s·sinh t, fine at its center.

    Attributes
    ----------
    coherence, looks : γ and L.
    scale : s [rad].
    step : of t.
    tail : (n + 1,) — P(φ > α) at the grid.
    slope : (n + 1,) — its derivative by t.
    points, weights : (n, 4) — Gauss points α within the intervals, with the density: the sum of
        the weights is a half.
    """

    coherence: float
    looks: float
    scale: float
    step: float
    tail: Array
    slope: Array
    points: Array
    weights: Array

    def upper_tail(self, phase: Array) -> Array:
        """P(φ > phase) of phases of any sign, by cubics through values and slopes."""
        t = np.minimum(np.arcsinh(np.abs(phase) / self.scale) / self.step, float(_INTERVALS))
        interval = np.minimum(t.astype(np.intp), _INTERVALS - 1)
        u = t - interval
        left, right = self.tail[interval], self.tail[interval + 1]
        rise, fall = self.slope[interval] * self.step, self.slope[interval + 1] * self.step
        v = 1.0 - u
        tail = v**2 * ((1.0 + 2.0 * u) * left + u * rise) + u**2 * (
            (1.0 + 2.0 * v) * right - v * fall
        )
        return np.asarray(np.where(phase < 0.0, 1.0 - tail, tail))


def _distribution(coherence: float, looks: float) -> _Distribution:
    bound = float(pair_phase_variance(max(coherence, 1e-9), looks=looks))
    scale = min(np.sqrt(bound), 1.0)
    end = np.arcsinh(np.pi / scale)
    step = end / _INTERVALS
    grid = step * np.arange(_INTERVALS + 1)
    t = grid[:-1, None] + 0.5 * step * (_NODE + 1.0)
    points = scale * np.sinh(t)
    density = phase_pdf(points, coherence=coherence, looks=looks)
    weights = 0.5 * step * _WEIGHT * scale * np.cosh(t) * density
    tail = np.zeros(_INTERVALS + 1)
    tail[:-1] = np.cumsum(weights.sum(axis=-1)[::-1])[::-1]
    at_grid = phase_pdf(scale * np.sinh(grid), coherence=coherence, looks=looks)
    slope = -at_grid * scale * np.cosh(grid)
    return _Distribution(coherence, looks, scale, step, tail, slope, points, weights)


def _phase_quantile(given: _Distribution, level: float) -> float:
    half = 0.5 * (1.0 - level)
    return _root(lambda alpha: half - float(given.upper_tail(np.array(alpha))), np.pi)


def _difference_quantile(given: _Distribution, level: float) -> float:
    def excess(limit: float) -> float:
        # P(|φ₁ − φ₂| > d), φ₁ on either side alike.
        beyond = given.upper_tail(given.points + limit) + given.upper_tail(limit - given.points)
        return 1.0 - level - 2.0 * float(np.sum(given.weights * beyond))

    return _root(excess, 2.0 * np.pi)


def _root(function: Callable[[float], float], end: float) -> float:
    return float(brentq(function, 0.0, end, xtol=1e-300, rtol=1e-9))


def _each(
    coherence: ArrayLike,
    looks: ArrayLike,
    level: float,
    quantile: Callable[[_Distribution, float], float],
) -> Array:
    """Quantiles of each distinct pair of arguments."""
    if not 0.0 < level < 1.0:
        raise ValueError(f"level = {level!r} must lie between 0 and 1")
    gamma, number = np.broadcast_arrays(*checked(coherence, looks))
    arguments = np.stack([gamma.ravel(), number.ravel()], axis=-1)
    distinct, which = np.unique(arguments, axis=0, return_inverse=True)
    values = np.array([quantile(_distribution(*pair), level) for pair in distinct.tolist()])
    return np.asarray(values[which.ravel()].reshape(gamma.shape))
