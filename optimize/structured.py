"""Structured designs: dumbbells and ladders, the shapes that optimal formations take.

Without decorrelation the best formation is a *dumbbell*: all satellites on the largest allowed
orbit, in two opposite groups, exactly the safety distance apart. Where baselines cost coherence, or
the phase must be unwrapped, it is a *ladder*: satellites along a line of the plane (z0, ż0/n) that
nulls the azimuth baseline, with unequal gaps. A search that starts from the best of both depends on
luck no more (docs/certificate.md).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from .design_space import DesignSpace
from .problem import Evaluation, Problem
from .projection import plane_radius, projection

Array = NDArray[np.float64]

_ANGLES = 90
"""Orientations of a dumbbell over half a turn; turned by the other half it is the same."""

_RATIOS = (1.0, 1.5, 2.2, 3.2, 4.5, 7.0)
"""Ratios of one gap of a ladder to the next."""

_LENGTHS = 16
"""Lengths of a ladder, up to the diameter of the plane."""

_SPARE = 1.0 + 1e-6
"""Factor on the safety distance, so that rounding breaks no limit."""

_APART = 0.05
"""Designs that are returned differ by this in their largest coordinate, in parts of the box."""


def structured_designs(
    problem: Problem,
    space: DesignSpace,
    *,
    count: int = 8,
    evaluate: Callable[[Array], Evaluation] | None = None,
) -> Array:
    """Return the best dumbbells and ladders, each shape with the others that are well away from it.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs that are searched.
    count : how many designs at most.
    evaluate : scores (P, D) designs instead of `problem`, for a search that counts them.

    Returns
    -------
    (≤ count, D) — designs in the box, best first: feasible ones by height error, then the others
    by violation; empty for a single satellite.
    """
    if space.satellites < 2:
        return np.empty((0, space.dimension))
    score = evaluate or (lambda designs: problem.evaluate(space.states(designs)))
    candidates, violation, objective = [], [], []
    for planes, sign in _shapes(problem, space):
        z0, rate = planes[..., 0], planes[..., 1] * space.mean_motion
        designs = space.encode(z0, rate, np.full(len(planes), float(sign)))
        evaluation = score(designs)
        order = np.lexsort((evaluation.objectives, evaluation.total_violation))[: 40 * count]
        candidates.append(designs[order])
        violation.append(evaluation.total_violation[order])
        objective.append(evaluation.objectives[order])
    designs = np.concatenate(candidates)
    order = np.lexsort((np.concatenate(objective), np.concatenate(violation)))
    return _distinct(designs[order], np.concatenate(objective)[order], space.upper, count)


def dumbbells(count: int, *, radius: float, separation: float) -> Iterator[Array]:
    """Dumbbells of every split into two opposite groups and every orientation.

    Parameters
    ----------
    count : number N of satellites.
    radius : scalar — radius of the disc in the plane (z0, ż0/n) [m].
    separation : scalar — smallest distance of two satellites in that plane [m].

    Yields
    ------
    (90, N, 2) — points of the plane, for each split that fits, the even one first.
    """
    turn = np.linspace(0.0, np.pi, _ANGLES, endpoint=False)[:, None]
    step = 2.0 * np.arcsin(min(1.0, 0.5 * separation * _SPARE / radius))
    for smaller in _splits(count):
        larger = count - smaller
        if (larger - 1) * step > np.pi:
            continue
        phases = np.concatenate(
            [
                (np.arange(larger) - 0.5 * (larger - 1)) * step,
                np.pi + (np.arange(smaller) - 0.5 * (smaller - 1)) * step,
            ]
        )
        angle = turn + phases
        # Just inside the circle: its rounding must not break the limit on the radius.
        yield (1.0 - 1e-12) * radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def ladders(count: int, *, direction: Array, radius: float, separation: float) -> Array:
    """Ladders along one direction, of every length, ratio and order of the gaps.

    Parameters
    ----------
    count : number N of satellites.
    direction : (2,) — unit vector along the ladder.
    radius : scalar — radius of the disc in the plane (z0, ż0/n) [m].
    separation : scalar — smallest distance of two satellites in that plane [m].

    Returns
    -------
    (Q, N, 2) — points of the plane; satellites whose gap is below the separation stand side by
    side, alternately on the line and off it.
    """
    gaps = np.array(list(dict.fromkeys(_gap_patterns(count))))
    fractions = np.linspace(0.0, 1.0, _LENGTHS + 1)[1:]
    along = np.concatenate([np.zeros((len(gaps), 1)), np.cumsum(gaps, axis=-1)], axis=-1) - 0.5
    along = (2.0 * radius * fractions[:, None, None] * along).reshape(-1, count)
    missing = np.sqrt(np.maximum((separation * _SPARE) ** 2 - np.diff(along) ** 2, 0.0))
    aside = np.zeros_like(along)
    for rung in range(1, count):  # the next stands off the line if its neighbor is on it
        aside[:, rung] = np.where(aside[:, rung - 1] > 0.0, 0.0, missing[:, rung - 1])
    across = np.array([-direction[1], direction[0]])
    points = along[..., None] * direction + aside[..., None] * across
    # A rung beside the line, at the very end of a full ladder, would leave the disc.
    size = np.max(np.hypot(points[..., 0], points[..., 1]), axis=-1)
    fitted: Array = points * np.minimum(1.0, (1.0 - 1e-12) * radius / size)[:, None, None]
    return fitted


def _shapes(problem: Problem, space: DesignSpace) -> Iterator[tuple[Array, int]]:
    """Batches of points (Q, N, 2) of the plane, each with its cross-track sign."""
    limits = problem.constraints
    radius = plane_radius(space, max_radius=limits.max_radius, inscribed=True)
    # The closest approach of a pair over the orbit is twice its distance in the plane.
    separation = 0.5 * (limits.min_separation or 0.0)
    for sign in space.signs:
        for shape in dumbbells(space.satellites, radius=radius, separation=separation):
            yield shape, sign
        seen = projection(
            space, problem.scene, held_constant=problem.errors.held_constant, sign=sign
        )
        for direction in _ladder_directions(seen.height, seen.azimuth):
            yield (
                ladders(
                    space.satellites, direction=direction, radius=radius, separation=separation
                ),
                sign,
            )


def _ladder_directions(height: Array, azimuth: Array) -> list[Array]:
    """Directions that null the azimuth baseline, that see most of the height, and between them."""
    _, _, rows = np.linalg.svd(azimuth)
    null = rows[-1]
    _, _, rows = np.linalg.svd(height)
    most = rows[0]
    most = most if most @ null >= 0.0 else -most
    between = null + most
    return [null, most, between / np.linalg.norm(between)]


def _splits(count: int) -> list[int]:
    """Sizes of the smaller group: even, and a few uneven ones."""
    half = count // 2
    return list(dict.fromkeys([half, max(1, half - 1), max(1, count // 4), 1]))


def _gap_patterns(count: int) -> Iterator[tuple[float, ...]]:
    """Gaps of ladders of unit length: geometric, in every order for few satellites."""
    for ratio in _RATIOS:
        gaps = ratio ** np.arange(count - 1)
        gaps /= gaps.sum()
        if count <= 4:
            yield from permutations(gaps.round(12).tolist())
        else:
            yield tuple(gaps.tolist())
            # The smallest in the middle, and the largest: the two ends then help each other.
            yield tuple(np.concatenate([gaps[::-2], gaps[::2] if count % 2 else gaps[1::2]]))
            yield tuple(np.concatenate([gaps[::2], gaps[::-2] if count % 2 else gaps[-2::-2]]))


def _distinct(designs: Array, objectives: Array, upper: Array, count: int) -> Array:
    """The first designs that are well apart, and not one another turned by half a turn."""
    chosen: list[Array] = []
    scores: list[float] = []
    for design, objective in zip(designs, objectives.tolist(), strict=True):
        if len(chosen) == count:
            break
        twin = any(math.isclose(objective, score, rel_tol=1e-9) for score in scores)
        if not twin and all(np.max(np.abs(design - other) / upper) > _APART for other in chosen):
            chosen.append(design)
            scores.append(objective)
    return np.array(chosen).reshape(-1, designs.shape[-1])
