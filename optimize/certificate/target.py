"""Whether a height error that a mission needs can be reached, and what would make it possible."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..design_space import DesignSpace
from ..problem import Problem
from ..refinement import refine
from .certify import CertificateSettings, lower_bound, why_no_trees
from .infeasible import within
from .projected import projected_bound
from .realize import realize
from .reliefs import reliefs
from .result import Certificate, Infeasibility, TargetVerdict

Array = NDArray[np.float64]

_TOLERANCE = 5e-3
"""Distance of bound and best at which the proof for an eased study is done."""

_DESCENT = 25
"""Quadratic programs that a formation gets to reach the target."""


def judge_target(
    problem: Problem,
    space: DesignSpace,
    *,
    target: float,
    design: Array,
    certificate: Certificate,
    settings: CertificateSettings = CertificateSettings(),  # noqa: B008 - immutable
) -> TargetVerdict:
    """Say whether a height error can be reached within the limits.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    target : scalar — region height error that is wanted [m].
    design : (D,) — the best design known.
    certificate : of that design.
    settings : of the proofs with a limit or an error eased.

    Returns
    -------
    TargetVerdict — out of reach only where a lower bound is above the target; then it says what,
    eased alone, would be enough.
    """
    if certificate.infeasibility is not None:
        return TargetVerdict(target, False, certificate.infeasibility)
    if not certificate.lower_bound > target:
        return TargetVerdict(target, certificate.objective <= target, None)
    cheap = settings._replace(tolerance=max(settings.tolerance, _TOLERANCE))
    return TargetVerdict(
        target,
        False,
        Infeasibility(
            statement=_statement(problem, space, target),
            reliefs=reliefs(
                problem, space, partial(_reaches, target=target, design=design, settings=cheap)
            ),
        ),
    )


def _statement(problem: Problem, space: DesignSpace, target: float) -> str:
    limits = problem.constraints
    parts = [
        f"No {space.satellites} satellites{within(limits, apart=False)} reach a height error of "
        f"{target:.4g} m"
    ]
    if limits.min_unwrapping_probability is not None:
        parts.append(
            f"with an unwrapping probability of {limits.min_unwrapping_probability:.6g} from "
            f"heights known to {limits.prior_height_std:.4g} m"
        )
    return " ".join(parts) + "."


def _reaches(
    problem: Problem,
    space: DesignSpace,
    *,
    target: float,
    design: Array,
    settings: CertificateSettings,
) -> bool | None:
    """Whether a formation that exists reaches the target; False if proved that none does."""
    if why_no_trees(problem):
        bound = lower_bound(problem, space, design=design, settings=settings)
        return False if bound > target else _hits(problem, space, design, target) or None
    trees = [
        projected_bound(
            problem,
            space,
            sign=sign,
            start=None,
            known=target * (1.0 + 2.0 * settings.tolerance),  # more than that is no use
            tolerance=settings.tolerance,
            max_boxes=settings.max_boxes,
        )
        for sign in dict.fromkeys(space.signs)
    ]
    if all(tree.value > target for tree in trees):
        return False
    starts = [realize(problem, space, tree) for tree in trees if tree.value <= target]
    hit = any(_hits(problem, space, start, target) for start in starts if start is not None)
    return hit or None


def _hits(problem: Problem, space: DesignSpace, start: Array, target: float) -> bool:
    """Whether a descent from a formation ends at the target or below."""

    def score(designs: Array) -> tuple[Array, Array]:
        objectives, margins = problem.objectives_and_margins(space.states(designs))
        return objectives, np.concatenate([np.empty((len(designs), 0)), *margins], axis=-1)

    def reached(design: Array) -> bool:
        evaluation = problem.evaluate(space.states(design[None]))
        return bool(evaluation.feasible[0] and evaluation.objectives[0] <= target)

    if reached(start):
        return True
    free = 2 * space.satellites
    return reached(
        refine(
            score, start, upper=space.upper, free=free, max_iterations=_DESCENT, rough=True
        ).design
    )
