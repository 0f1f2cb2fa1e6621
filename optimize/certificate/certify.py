"""How far from the best possible a design is at most, by every bound that applies."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, SharedBy

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import plane_radius
from .infeasible import infeasibility, packing_proof
from .joint import joint_bound
from .orders import MAX_ORDERS, order_count, relevant_satellites, satellite_classes
from .packing import scatter_support
from .projected import ProjectedBound, projected_bound
from .reduction import (
    Reduction,
    reduction,
    scatter_of,
    what_is_left_out,
    why_not_reduced,
)
from .result import Certificate, Infeasibility, LowerBound, Method
from .semidefinite import SolverError, best_scatter
from .separable import separable_bound, why_not_separable

Array = NDArray[np.float64]

_MAX_GAPS = 4
"""Gaps between satellites up to which a branch and bound is tried."""

_MAX_JOINT_GAPS = 2
"""Gaps up to which a loose bound is followed by that of one formation for all segments."""

_FEW = 5
"""Satellites from which on a sum over single ones is tried even beside a branch and bound."""

_ROUNDING = 1e-9
"""Part by which a bound is lowered, for the rounding of its arithmetic."""

_CLOSE = 2e-6
"""Distance of the squared errors at which a tangent at the design needs no second."""


class CertificateSettings(NamedTuple):
    """Settings of `certify`.

    Attributes
    ----------
    max_boxes : of the branch and bound, for each sign of the cross-track motion; it gives a looser
        bound when they are used up. A number of boxes and not of seconds, so that a bound does not
        depend on the machine.
    tolerance : relative distance of bound and best at which the branch and bound is done.
    target : height error that is wanted, for `judge_target`; None for none [m].
    """

    max_boxes: int = 400_000
    tolerance: float = 5e-4
    target: float | None = None


def certify(
    problem: Problem,
    space: DesignSpace,
    *,
    design: Array,
    settings: CertificateSettings = CertificateSettings(),  # noqa: B008 - immutable
) -> Certificate:
    """Bound the region height error from below over all designs within the limits.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    design : (D,) — the design to compare with; it also guides the proof, and may be infeasible.
    settings : of the proof.

    Returns
    -------
    Certificate — its lower bound holds whatever the design: a poor one only makes it looser.
    """
    proof = _prove(problem, space, design, settings)
    blocked: Infeasibility | None = None
    if proof.exhausted:
        blocked = infeasibility(problem, space, proof.trees, settings.max_boxes)
    elif not proof.feasible:
        blocked = packing_proof(problem, space)
    leading = min(proof.trees, key=lambda tree: tree.value) if proof.trees else None
    return Certificate(
        objective=proof.objective,
        bounds=tuple(proof.bounds),
        assumptions=_assumptions(problem, proof.trees),
        convergence=None if leading is None else leading.convergence,
        boxes=sum(tree.boxes for tree in proof.trees),
        infeasibility=blocked,
    )


def lower_bound(
    problem: Problem, space: DesignSpace, *, design: Array, settings: CertificateSettings
) -> float:
    """Largest lower bound of the region height error, and nothing else of `certify` [m].

    Parameters
    ----------
    problem, space, design, settings : as of `certify`.

    Returns
    -------
    scalar — `inf` where no formation is feasible, 0 where no bound applies.
    """
    proof = _prove(problem, space, design, settings)
    if proof.exhausted:
        return math.inf
    return max((one.value for one in proof.bounds if math.isfinite(one.value)), default=0.0)


class _Proof(NamedTuple):
    """Every bound that applies, and the trees that one of them comes from."""

    objective: float
    bounds: list[LowerBound]
    trees: list[ProjectedBound]

    @property
    def feasible(self) -> bool:
        """Whether the design keeps the limits."""
        return math.isfinite(self.objective)

    @property
    def exhausted(self) -> bool:
        """Whether the trees prove that no formation is feasible."""
        return bool(self.trees) and all(math.isinf(tree.value) for tree in self.trees)


def _prove(
    problem: Problem, space: DesignSpace, design: Array, settings: CertificateSettings
) -> _Proof:
    evaluation = problem.evaluate(space.states(design[None]))
    feasible = bool(evaluation.feasible[0])
    objective = float(evaluation.objectives[0]) if feasible else math.inf
    z0, rate, _ = space.decode(design)
    points = np.stack([z0, rate / space.mean_motion], axis=-1)
    signs = tuple(dict.fromkeys(space.signs))
    bounds = [*_convex_bounds(problem, space, signs, points)]
    start = points if feasible else None
    trees, reason = _trees(problem, space, signs, start, objective, settings)
    value = min((tree.value for tree in trees), default=math.nan)
    if math.isinf(value):
        value, reason = math.nan, "no formation is feasible"
    if space.satellites >= _FEW or not trees:
        bounds.append(_separable(problem, space, signs))
    bounds.append(LowerBound(Method.BRANCH_AND_BOUND, value, reason))
    return _Proof(objective, bounds, trees)


def _trees(
    problem: Problem,
    space: DesignSpace,
    signs: tuple[int, ...],
    points: Array | None,
    objective: float,
    settings: CertificateSettings,
) -> tuple[list[ProjectedBound], str]:
    """A branch and bound for each sign, or why there is none."""
    reason = why_no_trees(problem)
    if reason:
        return [], reason
    gaps = len(relevant_satellites(problem.radar)) - 1
    trees = []
    for sign in signs:
        tree = projected_bound(
            problem,
            space,
            sign=sign,
            start=points,
            known=objective,
            tolerance=settings.tolerance,
            max_boxes=settings.max_boxes,
        )
        # Without a design to compare with, only where segments differ.
        loose = (
            objective > tree.value * (1.0 + 2.0 * settings.tolerance)
            if math.isfinite(objective)
            else math.isfinite(tree.value) and len(tree.groups) > 1
        )
        if gaps <= _MAX_JOINT_GAPS and loose:
            tree = joint_bound(
                problem,
                space,
                tree,
                start=points,
                known=objective,
                tolerance=settings.tolerance,
                max_boxes=settings.max_boxes,
            )
        trees.append(tree)
    return trees, ""


def why_no_trees(problem: Problem) -> str:
    """Why there is no branch and bound; empty where there is one.

    Parameters
    ----------
    problem : for its images.
    """
    radar, errors = problem.radar, problem.errors
    gaps = len(relevant_satellites(radar)) - 1
    if gaps > _MAX_GAPS:
        return f"{gaps + 1} satellites are too many to exhaust their baselines"
    if order_count(satellite_classes(radar, errors)) > MAX_ORDERS:
        return "the satellites differ, and there are too many orders of them"
    return ""


def _convex_bounds(
    problem: Problem, space: DesignSpace, signs: tuple[int, ...], points: Array
) -> list[LowerBound]:
    """The bounds of the convex reduction: of each method the smallest over the signs."""
    methods = (Method.CLOSED_FORM, Method.SEMIDEFINITE, Method.ONE_SHOT)
    reason = why_not_reduced(problem)
    if reason:
        return [LowerBound(method, math.nan, reason) for method in methods]
    problems = [reduction(problem, space, sign=sign) for sign in signs]
    closed = _over_signs(Method.CLOSED_FORM, problems, lambda one: one.closed_form())
    if what_is_left_out(problem):
        loose = "only where nothing but radius and separation limits satellites alike"
        return [closed, *(LowerBound(method, math.nan, loose) for method in methods[1:])]
    radius = plane_radius(space, max_radius=problem.constraints.max_radius)
    scatter = scatter_of(points) / radius**2
    return [
        closed,
        _over_signs(Method.SEMIDEFINITE, problems, _semidefinite),
        _over_signs(Method.ONE_SHOT, problems, lambda one: _one_shot(one, scatter)),
    ]


def _separable(problem: Problem, space: DesignSpace, signs: tuple[int, ...]) -> LowerBound:
    reason = why_not_separable(problem)
    if reason:
        return LowerBound(Method.SEPARABLE, math.nan, reason)
    squared = min(separable_bound(problem, space, sign=sign) for sign in signs)
    if not squared > 0.0:
        return LowerBound(
            Method.SEPARABLE, math.nan, "the limits let satellites stand too far apart"
        )
    return LowerBound(Method.SEPARABLE, math.sqrt(squared))


def _over_signs(
    method: Method, problems: list[Reduction], bound: Callable[[Reduction], float]
) -> LowerBound:
    try:
        squared = min(bound(problem) for problem in problems)
    except SolverError as error:
        return LowerBound(method, math.nan, str(error))
    if not squared > 0.0:
        return LowerBound(method, math.nan, "the tangent is too steep to bound anything")
    return LowerBound(method, math.sqrt(squared) * (1.0 - _ROUNDING))


def _semidefinite(problem: Reduction) -> float:
    return problem.tangent_bound(best_scatter(problem))


def _one_shot(problem: Reduction, scatter: Array) -> float:
    """From the tangent at the design, and at the best scatter for a sign it does not have."""
    support = scatter_support(
        problem.count, separation=problem.separation, weight=problem.flatness(scatter)
    )
    bound = problem.tangent_bound(scatter, support.upper)
    if bound >= problem.squared_error(scatter) * (1.0 - _CLOSE):
        return bound
    # The design may be far from the best, or made for the other sign: then the tangent at the
    # program's own optimum, under the cut known by now, serves better.
    try:
        other = best_scatter(problem, ((problem.flatness(scatter), support.upper),))
    except SolverError:
        return bound
    support = scatter_support(
        problem.count, separation=problem.separation, weight=problem.flatness(other)
    )
    return max(bound, problem.tangent_bound(other, support.upper))


def _assumptions(problem: Problem, trees: Sequence[ProjectedBound]) -> tuple[str, ...]:
    """What the bounds leave out, each of which makes them looser and never wrong."""
    notes = []
    if trees:
        together = all(tree.joint is not None for tree in trees)
        if together:
            notes.append(
                "The branch and bound takes one formation for all segments, with its azimuth error "
                "and its separations."
            )
        elif problem.errors.azimuth.std > 0.0:
            notes.append(
                "The branch and bound leaves the azimuth error and the separation out: both can "
                "only make a formation worse."
            )
        else:
            notes.append(
                "The branch and bound leaves the separation out: it only takes designs away."
            )
        if not problem.errors.coherence.spectral:
            notes.append(
                "Volume and time make the coherence matrix general; the phases are taken to be "
                "known as well as if the signal were known without noise."
            )
        if len(problem.scene) > 1 and not together:
            notes.append(
                "It gives every segment of the scene its own best formation: no single one does "
                "better in all of them."
            )
        if problem.errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED:
            notes.append(
                "Without filtering the phase information is not monotone in the coherence; it is "
                "bounded over intervals of it."
            )
    if not why_not_reduced(problem):
        left = what_is_left_out(problem)
        if left:
            notes.append(
                "The bounds from the scatter of the satellites leave out "
                + ", ".join(left[:-1])
                + (" and " if len(left) > 1 else "")
                + left[-1]
                + "."
            )
    by_pair = problem.errors.azimuth
    if by_pair.std > 0.0 and by_pair.shared_by is SharedBy.PAIR:
        notes.append(
            "The study draws the azimuth error anew for every pair, which no bound here counts: "
            "they are looser for it."
        )
    return tuple(notes)
