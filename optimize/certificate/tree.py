"""Branch and bound over the projected baselines of one segment, or of all."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .segment import Boxes

Array = NDArray[np.float64]


class TreeResult(NamedTuple):
    """What a tree proves of a segment.

    Attributes
    ----------
    squared_error : scalar — no formation has a smaller squared height error; `inf` if none is
        feasible [m²].
    best : scalar — squared height error of the best formation met, by the same relaxed model, or
        known beforehand [m²].
    gaps : (G,) — its gaps and other coordinates, in parts of the largest; None if none was met.
    order : index of its order of satellites.
    boxes : bounded so far.
    complete : whether the bound is within the tolerance of `best`, or infeasibility is proved.
    history : (steps, 3) — boxes, bound and best after each step: how the two close in [1, m², m²].
    """

    squared_error: float
    best: float
    gaps: Array | None
    order: int
    boxes: int
    complete: bool
    history: Array


@dataclass(frozen=True, kw_only=True)
class Limits:
    """What a tree may not go beyond.

    Parameters
    ----------
    reach : (G,) — largest magnitude of each coordinate.
    gaps : number of coordinates, the first of all, that are gaps of sorted satellites and so not
        negative.
    rows, bounds : (orders, limits, G), (limits,) — linear limits on the gaps, row·gaps ≤ bound,
        with rows that are not negative, and zero but for gaps.
    mirrored : for each order, whether a formation and its mirror image are equally good, so that
        one of them is enough.
    tolerance : relative distance of bound and best, of the error, at which the tree is done.
    max_boxes : after which it gives up, with a looser bound.
    known : scalar — squared error of a formation that is known, and need not be met [m²].
    chunk : boxes split at a time: enough for NumPy, few enough not to split in vain.
    """

    reach: Array
    gaps: int
    rows: Array
    bounds: Array
    mirrored: tuple[bool, ...]
    tolerance: float
    max_boxes: int
    known: float = np.inf
    chunk: int = 4096


Bounding = Callable[[Boxes, float], Array]
"""Smallest squared error of boxes, (n,), `inf` where nothing is feasible; of a box that is not
below a second argument, any lower bound that isn't either."""


def explore(
    bounding: list[Bounding], *, limits: Limits, start: list[tuple[int, Array]]
) -> TreeResult:
    """Bound the squared height error from below over every formation within the limits.

    Parameters
    ----------
    bounding : bounds boxes, one for each order of the satellites.
    limits : of the formations and of the tree.
    start : formations known beforehand, as (order, gaps): the better they are, the fewer boxes.

    Returns
    -------
    TreeResult
    """
    tree = _Tree(bounding, limits)
    for order, point in start:
        tree.offer(order, point[None])
    lowest = -limits.reach
    lowest[: limits.gaps] = 0.0
    for order in range(len(bounding)):
        tree.add(order, lowest[None], limits.reach[None], np.zeros(1))
    while tree.open and tree.count < limits.max_boxes:
        tree.split()
    return tree.result()


@dataclass
class _Tree:
    bounding: list[Bounding]
    limits: Limits
    best: float = field(init=False)
    gaps: Array | None = None
    best_order: int = 0
    count: int = 0
    discarded: float = np.inf
    history: list[tuple[float, float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.best = self.limits.known
        width = self.limits.rows.shape[-1]
        self.order = np.empty(0, dtype=np.intp)
        self.lower, self.upper = np.empty((0, width)), np.empty((0, width))
        self.bound = np.empty(0)

    @property
    def open(self) -> bool:
        return bool(self.bound.size)

    @property
    def threshold(self) -> float:
        """Bound from which on a box is not worth splitting."""
        return self.best * (1.0 - self.limits.tolerance) ** 2

    def split(self) -> None:
        """Split the most promising boxes."""
        chosen = np.argsort(self.bound, kind="stable")[: self.limits.chunk]
        keep = np.ones(self.bound.size, dtype=bool)
        keep[chosen] = False
        order, lower, upper = self.order[chosen], self.lower[chosen], self.upper[chosen]
        bound = self.bound[chosen]
        self._keep(keep)
        axis = np.argmax(upper - lower, axis=-1)
        row = np.arange(len(axis))
        middle = 0.5 * (lower[row, axis] + upper[row, axis])
        below, above = upper.copy(), lower.copy()
        below[row, axis], above[row, axis] = middle, middle
        for index in np.unique(order):
            of = order == index
            self.add(
                int(index),
                np.concatenate([lower[of], above[of]]),
                np.concatenate([below[of], upper[of]]),
                np.concatenate([bound[of], bound[of]]),
            )
        worthwhile = self.bound < self.threshold
        self._discard(self.bound[~worthwhile])
        self._keep(worthwhile)
        self.history.append((float(self.count), self._lower_bound(), self.best))

    def add(self, order: int, lower: Array, upper: Array, parent: Array) -> None:
        """Bound boxes, parts of some with a bound, and keep those that may be worth it."""
        lower, upper, parent = self._within(order, lower, upper, parent)
        if not len(lower):
            return
        self.count += len(lower)
        squared = np.maximum(self.bounding[order](Boxes(lower, upper), self.threshold), parent)
        possible = squared < np.inf
        lower, upper, squared = lower[possible], upper[possible], squared[possible]
        if not len(lower):
            return
        middle = 0.5 * (lower + upper)
        promising = squared < self.threshold
        self.offer(order, middle[promising])
        worthwhile = squared < self.threshold
        self._discard(squared[~worthwhile])
        self.order = np.append(self.order, np.full(int(worthwhile.sum()), order))
        self.lower = np.concatenate([self.lower, lower[worthwhile]])
        self.upper = np.concatenate([self.upper, upper[worthwhile]])
        self.bound = np.append(self.bound, squared[worthwhile])

    def offer(self, order: int, points: Array) -> None:
        """Take the best of some formations, if it is better than what is known."""
        within = np.all(points @ self.limits.rows[order].T <= self.limits.bounds, axis=-1)
        points = points[within]
        if not len(points):
            return
        squared = self.bounding[order](Boxes(points, points), self.best)
        index = int(np.argmin(squared))
        if squared[index] < self.best:
            self.best, self.gaps, self.best_order = float(squared[index]), points[index], order

    def result(self) -> TreeResult:
        return TreeResult(
            squared_error=self._lower_bound(),
            best=self.best,
            gaps=self.gaps,
            order=self.best_order,
            boxes=self.count,
            complete=not self.open,
            history=np.array(self.history).reshape(-1, 3),
        )

    def _lower_bound(self) -> float:
        return min(self.discarded, float(self.bound.min(initial=np.inf)))

    def _within(
        self, order: int, lower: Array, upper: Array, parent: Array
    ) -> tuple[Array, Array, Array]:
        """Cut boxes back to the linear limits; drop those outside, and mirror images."""
        rows, bounds = self.limits.rows[order], self.limits.bounds
        spare = bounds - lower @ rows.T
        inside = np.all(spare >= 0.0, axis=-1)
        if self.limits.mirrored[order]:
            inside &= upper[:, 0] >= lower[:, self.limits.gaps - 1]
        lower, upper, spare = lower[inside], upper[inside], spare[inside]
        with np.errstate(divide="ignore"):
            room = np.where(rows > 0.0, spare[:, :, None] / rows, np.inf).min(axis=1)
        return lower, np.minimum(upper, lower + room), parent[inside]

    def _keep(self, which: NDArray[np.bool_]) -> None:
        self.order, self.bound = self.order[which], self.bound[which]
        self.lower, self.upper = self.lower[which], self.upper[which]

    def _discard(self, bounds: Array) -> None:
        self.discarded = min(self.discarded, float(bounds.min(initial=np.inf)))
