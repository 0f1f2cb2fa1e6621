"""A formation with given projected baselines, in the disc, apart, and without azimuth baseline."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import plane_radius, projection
from .projected import ProjectedBound

Array = NDArray[np.float64]

_SPARE = 1.0 + 1e-9
"""Factor on the safety distance, so that rounding does not break it."""


def realize(problem: Problem, space: DesignSpace, bound: ProjectedBound) -> Array | None:
    """A design with the projected baselines that a branch and bound found best.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    bound : for one sign of the cross-track motion.

    Returns
    -------
    (D,) — a design to refine, for the middle segment of the largest group; it need not keep every
    limit. None where the search met nothing feasible.

    Notes
    -----
    Along a the coordinates are given; across, each satellite stands where its azimuth coordinate
    c·v is the same for all, as far as the disc allows. Neighbors that come too close are set
    apart across.
    """
    group, tree = max(zip(bound.groups, bound.trees, strict=True), key=lambda g: len(g[0].members))
    if tree.gaps is None:
        return None
    errors, limits = problem.errors, problem.constraints
    segment = group.members[len(group.members) // 2]
    seen = projection(space, problem.scene, held_constant=errors.held_constant, sign=bound.sign)
    a, c = seen.height[segment], seen.azimuth[segment]
    size = float(np.linalg.norm(a))
    radius = plane_radius(space, max_radius=limits.max_radius, inscribed=True)
    along = np.concatenate([[0.0], np.cumsum(tree.gaps)])
    along = (along - 0.5 * along[-1]) * plane_radius(space, max_radius=limits.max_radius)
    unit, across = a / size, np.array([-a[1], a[0]]) / size
    steer = float(c @ across)
    slope = -float(c @ unit) / steer if abs(steer) > 1e-12 * np.linalg.norm(c) else 0.0
    room = np.sqrt(np.maximum(radius**2 - along**2, 0.0)) * (1.0 - 1e-12)
    beside = np.clip(slope * along, -room, room)
    apart = 0.5 * (limits.min_separation or 0.0) * _SPARE
    for index in range(1, len(along)):
        before = np.arange(index)
        needed = np.sqrt(np.maximum(apart**2 - (along[index] - along[before]) ** 2, 0.0))
        choices = np.concatenate(
            [[beside[index]], beside[before] + needed, beside[before] - needed]
        )
        choices = choices[np.abs(choices) <= room[index]]
        clear = [
            bool(np.all(np.abs(choice - beside[before]) >= needed * (1.0 - 1e-12)))
            for choice in choices
        ]
        possible = choices[clear]
        if possible.size:
            beside[index] = possible[np.argmin(np.abs(possible - beside[index]))]
    points = along[:, None] * unit + beside[:, None] * across
    plane = np.zeros((space.satellites, 2))
    plane[list(bound.orders[tree.order])] = points
    design = space.encode(
        plane[:, 0], plane[:, 1] * space.mean_motion, np.asarray(float(bound.sign))
    )
    return np.clip(design, -space.upper, space.upper)
