"""Local refinement of a design by sequential quadratic programming, never for the worse."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from .constraints import FEASIBILITY_TOLERANCE
from .gradient import DesignSlopes

Array = NDArray[np.float64]
Score = Callable[[Array], tuple[Array, Array]]
"""Objectives (P,) and margins (P, items), positive when kept, of (P, D) designs."""
Differentiate = Callable[[Array], DesignSlopes | None]
"""Scores of one (D,) design with their derivatives; None where they are not known."""

_STEP = 1e-6
"""Step of the central differences in parts of the box: truncation and rounding near 1e-10."""

_TOLERANCE = 1e-10
"""Change of the logarithm of the error that ends a descent: what the differences resolve."""

_SAFE_MARGIN = 1e-8
"""Margin that the quadratic programs keep, so that their last digits stay feasible."""

_ROUGH_MARGIN = 1e-6
"""The same of a rough descent: what the kinks of the limits leave uncertain."""

_PROGRESS = 1e-6
"""Change of the logarithm of the error, from one quadratic program to the next, that is none."""

_NEARLY_KEPT = 1e-5
"""Margin by which a limit may be missed while a descent no longer makes progress."""

_PATIENCE = 8
"""Quadratic programs without progress after which a descent ends, feasible or not."""

_LAST_HOPE = 25
"""Quadratic programs after which a descent ends that found nothing feasible, nor a hundredth less
violation."""


class Refinement(NamedTuple):
    """Result of `refine`.

    Attributes
    ----------
    design : (D,) — the best design met, the start included.
    interrupted : whether a KeyboardInterrupt ended the descent.
    """

    design: Array
    interrupted: bool


def refine(
    score: Score,
    start: Array,
    *,
    upper: Array,
    free: int,
    differentiate: Differentiate | None = None,
    max_iterations: int = 100,
    rough: bool = False,
) -> Refinement:
    """Descend from a design to a local optimum within the constraints.

    Parameters
    ----------
    score : scores a batch of designs.
    start : (D,) — the design to improve; it may be infeasible.
    upper : (D,) — the box is ±upper.
    free : how many leading variables may move; a sign, which is not continuous, may not.
    differentiate : the derivatives in closed form; where it gives None, and without it, central
        differences are taken.
    max_iterations : of the quadratic programs.
    rough : whether limits may be left with a millionth to spare, which is quicker: the best of many
        rough descents is refined again.

    Returns
    -------
    Refinement — feasible if the start is, and never worse than it.

    Notes
    -----
    SLSQP on the logarithm of the height error. Central differences are scored as one batch, of
    twice as many designs as variables.
    Every point on the way is a candidate, so a failed line search loses nothing.

    The overlap of azimuth bands, 1 − |d_i − d_j|, has a kink where two phase centers are abreast,
    and good designs are nearly abreast in all segments: there the slopes jump by a thousandth from
    one segment's kink to the next, and SLSQP, which would see them settle, zigzags over a ridge of
    1e-8 in height for hundreds of line searches. A descent therefore ends where its quadratic
    programs make no progress.
    """
    descent = _Descent(score, start, upper, free, differentiate)
    descent.safe_margin = _ROUGH_MARGIN if rough else _SAFE_MARGIN
    interrupted = False
    try:
        minimize(
            descent.objective,
            start[:free] / upper[:free],
            jac=descent.objective_gradient,
            method="SLSQP",
            bounds=[(-1.0, 1.0)] * free,
            constraints=descent.constraints(),
            callback=descent.accept,
            options={"maxiter": max_iterations, "ftol": _TOLERANCE},
        )
    except _EndOfDescentError:
        pass  # No progress, or a design that measures no height: the best so far stands.
    except KeyboardInterrupt:
        interrupted = True
    return Refinement(descent.best_design, interrupted)


class _EndOfDescentError(Exception):
    """The descent makes no progress, or reached a design without a finite error or margin."""


class _Descent:
    """Values and gradients at the current point, in closed form or from a batch of neighbors."""

    def __init__(
        self,
        score: Score,
        start: Array,
        upper: Array,
        free: int,
        differentiate: Differentiate | None,
    ) -> None:
        self._differentiate = differentiate
        self._score, self._start, self._upper, self._free = score, start, upper, free
        self._point: Array | None = None
        self.best_design = start
        self._best = (np.inf, np.inf)
        self.safe_margin = _SAFE_MARGIN
        self._accepted = math.inf
        self._idle = 0
        self._landmark = math.inf
        self._since = 0

    def accept(self, point: Array) -> None:
        """Take the outcome of a quadratic program; end the descent if they make no progress."""
        self._visit(point)
        kept = np.all(self._margins > -_NEARLY_KEPT)
        idle = kept and abs(self._value - self._accepted) < _PROGRESS
        self._idle = self._idle + 1 if idle else 0
        self._accepted = self._value
        violation, objective = self._best
        reached = violation == 0.0 and math.log(objective) < self._value + _PROGRESS
        if violation == 0.0 or violation < 0.99 * self._landmark:
            self._landmark, self._since = violation, 0
        else:
            self._since += 1
        if self._idle >= (2 if reached else _PATIENCE) or self._since >= _LAST_HOPE:
            raise _EndOfDescentError

    def constraints(self) -> tuple[dict[str, object], ...]:
        """The constraints as SLSQP takes them; none if there are no margins."""
        self._visit(self._start[: self._free] / self._upper[: self._free])
        if self._margins.size == 0:
            return ()
        return ({"type": "ineq", "fun": self.margins, "jac": self.margins_gradient},)

    def objective(self, point: Array) -> float:
        self._visit(point)
        return self._value

    def objective_gradient(self, point: Array) -> Array:
        self._visit(point)
        return self._value_slopes

    def margins(self, point: Array) -> Array:
        self._visit(point)
        safe: Array = self._margins - self.safe_margin
        return safe

    def margins_gradient(self, point: Array) -> Array:
        self._visit(point)
        return self._margin_slopes

    def _difference(self, values: Array) -> Array:
        forward, backward = values[1 : 1 + self._free], values[1 + self._free :]
        gradient: Array = (forward - backward) / (2.0 * _STEP)
        return gradient

    def _visit(self, point: Array) -> None:
        if self._point is not None and np.array_equal(point, self._point):
            return
        scale = self._upper[: self._free]
        design = self._start.copy()
        design[: self._free] = point * scale
        known = None if self._differentiate is None else self._differentiate(design)
        if known is None:
            self._visit_neighbors(point)
        else:
            self._remember(design, known.objective, known.margins)
            self._value, self._margins = math.log(known.objective), known.margins
            self._value_slopes = known.log_objective_slopes * scale
            self._margin_slopes = known.margin_slopes * scale
            slopes = (self._value_slopes, self._margin_slopes)
            if not all(np.all(np.isfinite(part)) for part in (self._margins, *slopes)):
                raise _EndOfDescentError
        self._point = np.array(point)

    def _visit_neighbors(self, point: Array) -> None:
        steps = _STEP * np.eye(self._free)
        points = np.concatenate([point[None], point + steps, point - steps])
        designs = np.broadcast_to(self._start, (len(points), self._start.size)).copy()
        designs[:, : self._free] = points * self._upper[: self._free]
        objectives, margins = self._score(designs)
        self._remember(designs[0], float(objectives[0]), margins[0])
        if not (np.all(np.isfinite(objectives)) and np.all(np.isfinite(margins))):
            raise _EndOfDescentError
        values = np.log(objectives)
        self._value, self._margins = float(values[0]), margins[0]
        self._value_slopes = self._difference(values)
        self._margin_slopes = self._difference(margins).T

    def _remember(self, design: Array, objective: float, margins: Array) -> None:
        overshoot = np.where(margins < -FEASIBILITY_TOLERANCE, -margins, 0.0)
        rank = (float(overshoot.sum()), objective)
        if np.all(np.abs(design) <= self._upper) and rank < self._best:
            self.best_design, self._best = design.copy(), rank
