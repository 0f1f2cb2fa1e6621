"""How far satellites can scatter: the support function of the attainable scatter matrices.

h(μ) = max Σ|w_i − w̄|²_H, H = diag(1, μ), over N points of the unit disc at least δ apart. The sum
is the minimum over m of Σ f_m(w_i), f_m(w) = |w − m|²_H, so any fixed m bounds it from above and
separates the points. The bound here takes every split of the points by the sign of their first
coordinate and, on each side, the points by polar angle, of which only neighbors are kept δ apart:
a longest path over cells of the half disc, refined until it meets a formation that exists.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

Array = NDArray[np.float64]

_RADII, _ANGLES = 4, 16
"""First cells of the half disc."""

_MAX_CELLS = 2500
"""Cells of one point above which the bound is left as it is."""

_ROUNDING = 1e-12
"""Slack of the bounds for rounding."""


class Support(NamedTuple):
    """Value of the support function.

    Attributes
    ----------
    upper : scalar — no points exceed it.
    attained : scalar — points that exist reach it.
    """

    upper: float
    attained: float


def scatter_support(
    count: int, *, separation: float, weight: float, tolerance: float = 8e-7
) -> Support:
    """Bound the weighted scatter of points of the unit disc that keep a distance.

    Parameters
    ----------
    count : number N of points, at least 2.
    separation : scalar — smallest distance δ of two points.
    weight : scalar — μ of the second coordinate, 0 to 1.
    tolerance : relative distance of bound and attained value at which it stops.

    Returns
    -------
    Support
    """
    attained = max(
        _dumbbell(count, right, separation, weight) for right in range(1, count // 2 + 1)
    )
    upper = attained
    for right in range(count // 2 + 1):
        upper = max(
            upper, _split_bound(count, right, separation, weight, attained, tolerance * attained)
        )
    return Support(upper * (1.0 + _ROUNDING), attained)


def _phases(count: int, separation: float) -> Array:
    step = 2.0 * math.asin(min(1.0, 0.5 * separation))
    return np.asarray((np.arange(count) - 0.5 * (count - 1)) * step, dtype=np.float64)


def _dumbbell(count: int, right: int, separation: float, weight: float) -> float:
    """Scatter of a dumbbell that stands in the first direction; 0 if it does not fit."""
    left = count - right
    if left > 1 and _phases(left, separation)[-1] > math.pi / 2:
        return 0.0
    angle = np.concatenate([_phases(right, separation), math.pi + _phases(left, separation)])
    x, y = np.cos(angle), np.sin(angle)
    return float(count * (x.var() + weight * y.var()))


def _split_bound(
    count: int, right: int, separation: float, weight: float, attained: float, slack: float
) -> float:
    """Bound with `right` points on the right; the attained value where that is larger."""

    def crude(middle: float) -> float:
        return right * _largest(middle, weight) + (count - right) * _largest(-middle, weight)

    middle = float(minimize_scalar(crude, bounds=(-1.0, 1.0), method="bounded").x)
    if crude(middle) <= attained:
        return attained
    left = count - right
    if right and (right - 1) * 2.0 * math.asin(min(1.0, 0.5 * separation)) < math.pi:
        angle = np.concatenate([_phases(right, separation), math.pi + _phases(left, separation)])
        middle = float(np.cos(angle).mean())
    halves = [
        _Half(right, middle, separation, weight),
        _Half(left, -middle, separation, weight),
    ]
    while True:
        bound = halves[0].bound + halves[1].bound
        if bound <= attained + slack:
            return max(bound, attained)
        refined = [half.refine(attained - bound + half.bound) for half in halves]
        if not any(refined):
            return bound


def _largest(middle: float, weight: float) -> float:
    """Largest f_m over the half disc: convex in the radius and in the cosine."""
    return max(middle**2, (1.0 - middle) ** 2, middle**2 + weight)


@dataclass
class _Half:
    """Points of one half disc, sorted by polar angle, as a path through cells.

    Every place in the sorted sequence has cells of its own: few of them stay possible.
    """

    count: int
    middle: float
    separation: float
    weight: float

    def __post_init__(self) -> None:
        radii = np.linspace(0.0, 1.0, _RADII + 1)
        angles = np.linspace(-math.pi / 2, math.pi / 2, _ANGLES + 1)
        inner, first = np.meshgrid(radii[:-1], angles[:-1], indexing="ij")
        outer, last = np.meshgrid(radii[1:], angles[1:], indexing="ij")
        cells = np.stack([inner, outer, first, last], axis=-1).reshape(-1, 4)
        self._set([cells] * self.count)

    def refine(self, worth: float) -> bool:
        """Split the cells through which a path may reach a total; whether there was room to."""
        stages = [
            cells[through >= worth - 1e-12 * abs(worth)]
            for cells, through in zip(self._stages, self._through, strict=True)
        ]
        if not stages or not all(len(cells) for cells in stages):
            return False  # the other half alone decides
        if max(len(cells) for cells in stages) * 4 > _MAX_CELLS:
            return False
        self._set([_quarters(cells) for cells in stages])
        return True

    def _set(self, stages: list[Array]) -> None:
        """Take the cells of each place, and find the best path through each."""
        self._stages = stages
        if not stages:
            self.bound, self._through = 0.0, list[Array]()
            return
        values = [self._values(cells) for cells in stages]
        linked = [self._linked(one, two) for one, two in pairwise(stages)]
        forward, backward = [values[0]], [values[-1]]
        for value, link in zip(values[1:], linked, strict=True):
            best = np.where(link, forward[-1][:, None], -np.inf).max(axis=0)
            forward.append(value + best)
        for value, link in zip(values[-2::-1], linked[::-1], strict=True):
            best = np.where(link, backward[-1][None, :], -np.inf).max(axis=1)
            backward.append(value + best)
        self.bound = float(forward[-1].max())
        self._through = [
            one + two - value
            for one, two, value in zip(forward, backward[::-1], values, strict=True)
        ]

    def _values(self, cells: Array) -> Array:
        """Largest f_m of each cell: convex in r and in cos θ, so taken at their ends."""
        inner, outer, first, last = cells.T
        cosines = np.stack([np.cos(first), np.cos(last)])
        most = np.where((first <= 0.0) & (last >= 0.0), 1.0, cosines.max(axis=0))
        values = [
            (radius * cosine - self.middle) ** 2
            + self.weight * radius**2 * np.maximum(0.0, 1.0 - cosine**2)
            for radius in (inner, outer)
            for cosine in (cosines.min(axis=0), most)
        ]
        return np.asarray(np.max(values, axis=0))

    def _linked(self, one: Array, two: Array) -> NDArray[np.bool_]:
        """Whether a point of one cell can be followed by a point of another."""
        turn = two[None, :, 3] - one[:, None, 2]
        cosine = np.cos(np.clip(turn, 0.0, math.pi))
        farthest = np.zeros_like(turn)
        for near in (one[:, 0], one[:, 1]):
            for far in (two[:, 0], two[:, 1]):
                square = near[:, None] ** 2 + far[None, :] ** 2
                farthest = np.maximum(farthest, square - 2.0 * np.outer(near, far) * cosine)
        apart: NDArray[np.bool_] = farthest >= self.separation**2 * (1.0 - _ROUNDING)
        return apart & (turn >= 0.0)


def _quarters(cells: Array) -> Array:
    inner, outer, first, last = cells.T
    radius, angle = 0.5 * (inner + outer), 0.5 * (first + last)
    return np.concatenate(
        [
            np.stack([one, two, three, four], axis=-1)
            for one, two in ((inner, radius), (radius, outer))
            for three, four in ((first, angle), (angle, last))
        ]
    )
