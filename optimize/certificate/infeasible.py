"""Proofs that nothing keeps the limits: which limit blocks, and where it would no longer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..constraints import Constraints
from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import plane_radius
from .projected import ProjectedBound, projected_bound
from .realize import realize
from .reliefs import reliefs
from .result import Infeasibility, Relief

Array = NDArray[np.float64]

_LOOSE = 0.999999
"""Tolerance of a tree that only asks whether something is feasible."""

_DISTANCES = {
    2: 2.0,
    3: math.sqrt(3.0),
    4: math.sqrt(2.0),
    5: 2 * math.sin(math.pi / 5),
    6: 1.0,
    7: 1.0,
}
"""Largest smallest distance of a few points of the unit disc."""


def packing_proof(problem: Problem, space: DesignSpace) -> Infeasibility | None:
    """Prove that the satellites do not fit beside one another, if they don't.

    Parameters
    ----------
    problem : the problem, for its limits.
    space : the designs.

    References
    ----------
    Oler 1961, doi:10.1007/BF02559537: points of a convex region at least d apart are no more than
    2/(√3 d²)·area + perimeter/(2d) + 1.
    """
    limits = problem.constraints
    if limits.min_separation is None or space.satellites < 2:
        return None
    radius = plane_radius(space, max_radius=limits.max_radius)
    distance = 0.5 * limits.min_separation
    largest = _largest_distance(space.satellites) * radius
    if distance <= largest * (1.0 + 1e-9):
        return None
    reliefs = [
        Relief("separation of each pair", "m", limits.min_separation, 2.0 * largest, math.nan)
    ]
    if space.satellites in _DISTANCES:
        reliefs = [reliefs[0]._replace(passes_at=2.0 * largest * (1.0 - 1e-9))]
    return Infeasibility(
        statement=f"{space.satellites} satellites within a radius of {2.0 * radius:.4g} m can't "
        f"all stay {limits.min_separation:.4g} m apart: at most {2.0 * largest:.4g} m.",
        reliefs=tuple(reliefs),
    )


def _largest_distance(count: int) -> float:
    """No `count` points of the unit disc are farther apart than this."""
    if count in _DISTANCES:
        return _DISTANCES[count]
    # Oler: count − 1 ≤ 2π/(√3 d²) + π/d, a quadratic in 1/d.
    a, b, c = 2.0 * math.pi / math.sqrt(3.0), math.pi, 1.0 - count
    return 2.0 * a / (-b + math.sqrt(b**2 - 4.0 * a * c))


def infeasibility(
    problem: Problem, space: DesignSpace, trees: Sequence[ProjectedBound], max_boxes: int
) -> Infeasibility:
    """Say what the trees prove, and what would help.

    Parameters
    ----------
    problem : the problem, of which no formation is feasible.
    space : the designs.
    trees : the exhausted trees, one for each sign.
    max_boxes : of each tree that is tried with a limit relaxed.
    """
    limits = problem.constraints
    segments = sorted({int(index) + 1 for index in trees[0].blocked})
    if not segments:
        where = "all segments at once"
    elif len(segments) == len(problem.scene):
        where = "every segment"
    elif len(segments) == 1:
        where = f"segment {segments[0]}"
    else:
        where = f"{len(segments)} of the segments"
    together = any(tree.joint is not None for tree in trees)
    statement = f"no {space.satellites} satellites{within(limits, apart=together)}"
    if limits.min_unwrapping_probability is not None:
        statement += (
            f" can be unwrapped with a probability of {limits.min_unwrapping_probability:.6g} from "
            f"heights known to {limits.prior_height_std:.4g} m in {where}"
        )
    else:
        statement += f" measure a height in {where}"
    return Infeasibility(
        statement=statement[0].upper() + statement[1:] + ".",
        reliefs=reliefs(problem, space, partial(_verdict, max_boxes=max_boxes)),
    )


def within(limits: Constraints, *, apart: bool) -> str:
    """The limits on places that a proof counts on, in words that begin with a space.

    Parameters
    ----------
    limits : of the problem.
    apart : whether the separation counts.
    """
    parts = []
    if limits.max_radius is not None:
        parts.append(f"within a radius of {limits.max_radius:.4g} m")
    if limits.min_separation is not None and apart:
        parts.append(f"at least {limits.min_separation:.4g} m apart")
    if limits.max_baseline_fraction is not None:
        parts.append(
            f"with perpendicular baselines of at most {limits.max_baseline_fraction:.4g} of the "
            "critical one"
        )
    return (" " + ", ".join(parts)) if parts else ""


def _verdict(problem: Problem, space: DesignSpace, *, max_boxes: int) -> bool | None:
    """Whether a formation that exists keeps the limits; False if proved that none does."""
    proved = True
    for sign in dict.fromkeys(space.signs):
        bound = projected_bound(
            problem, space, sign=sign, start=None, tolerance=_LOOSE, max_boxes=max_boxes
        )
        if math.isinf(bound.value):
            continue
        proved = False
        design = realize(problem, space, bound)
        if design is not None and problem.evaluate(space.states(design[None])).feasible[0]:
            return True
    return False if proved else None
