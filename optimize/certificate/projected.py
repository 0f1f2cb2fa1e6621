"""The lower bound by branch and bound: every segment on its own, every order and sign."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar.baselines import scene_critical_baseline
from insar.coherence import image_amplitude
from insar.height import common_height_errors

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import Projection, plane_radius, projection
from .orders import is_palindrome, known_gaps, orders
from .result import Convergence
from .segment import Boxes, SegmentModel, gap_matrix
from .tree import Limits, TreeResult, explore

Array = NDArray[np.float64]

ROUNDING = 1e-8
"""Slack, in parts, that the bounds leave for the rounding of limits and arithmetic."""

ALIKE = 1e-6
"""Amplitudes that differ by no more count as one."""

_MAX_GROUPS = 12
"""Trees that the segments of a scene share at most."""


class SegmentGroup(NamedTuple):
    """Segments so alike that one tree serves them, with the range of their properties.

    Attributes
    ----------
    members : (n,) — 0-based segments.
    wavenumbers, shifts, amplitude, alike, range_variance : as in `SegmentModel`.
    """

    members: NDArray[np.intp]
    wavenumbers: tuple[float, float]
    shifts: tuple[float, float]
    amplitude: float
    alike: bool
    range_variance: float


class ProjectedBound(NamedTuple):
    """What the branch and bound proves for one sign of the cross-track motion.

    Attributes
    ----------
    sign : ±1.
    value : scalar — no formation has a smaller region height error; `inf` if none is feasible [m].
    best : scalar — what formations met in every segment on its own would give [m].
    orders : the orders of the satellites that were tried.
    groups : the groups of segments.
    trees : the tree of each.
    joint : the tree of all segments with one formation, where there is one.
    """

    sign: int
    value: float
    best: float
    orders: tuple[tuple[int, ...], ...]
    groups: tuple[SegmentGroup, ...]
    trees: tuple[TreeResult, ...]
    joint: TreeResult | None = None

    @property
    def boxes(self) -> int:
        """Boxes bounded."""
        together = 0 if self.joint is None else self.joint.boxes
        return together + sum(tree.boxes for tree in self.trees)

    @property
    def blocked(self) -> NDArray[np.intp]:
        """0-based segments in which no formation is feasible; none if only in all at once."""
        return np.concatenate(
            [np.empty(0, dtype=np.intp)]
            + [
                group.members
                for group, tree in zip(self.groups, self.trees, strict=True)
                if math.isinf(tree.squared_error)
            ]
        )

    @property
    def convergence(self) -> Convergence:
        """How the bound of all segments, or of the largest group of them, closed in."""
        if self.joint is not None:
            history = self.joint.history
            return Convergence(history[:, 0], np.sqrt(history[:, 1]), np.sqrt(history[:, 2]))
        largest = max(range(len(self.groups)), key=lambda i: len(self.groups[i].members))
        history = self.trees[largest].history
        return Convergence(history[:, 0], np.sqrt(history[:, 1]), np.sqrt(history[:, 2]))


def projected_bound(
    problem: Problem,
    space: DesignSpace,
    *,
    sign: int,
    start: Array | None,
    known: float = math.inf,
    tolerance: float,
    max_boxes: int,
) -> ProjectedBound:
    """Bound the region height error from below, each segment on its own.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    sign : ±1 — of the cross-track motion.
    start : (N, 2) — points (z0, ż0/n) of a good formation, which saves boxes; None without [m].
    known : scalar — region height error of a formation, of either sign [m].
    tolerance : relative distance of bound and best at which a tree is done.
    max_boxes : over all segments.

    Returns
    -------
    ProjectedBound
    """
    seen = projection(space, problem.scene, held_constant=problem.errors.held_constant, sign=sign)
    reach = largest_coordinates(problem, space, seen)
    groups = _groups(problem, seen, reach)
    radar, errors = problem.radar, problem.errors
    sequences = list(orders(radar, errors))
    trees = []
    for group in groups:
        models = [
            SegmentModel(
                radar=radar,
                errors=errors,
                order=order,
                wavenumbers=group.wavenumbers,
                shifts=group.shifts,
                amplitude=group.amplitude,
                alike=group.alike,
                range_variance=group.range_variance,
                prior_height_std=prior_of(problem),
            )
            for order in sequences
        ]
        points = []
        if start is not None:
            segment = group.members[0]
            points = known_gaps(
                start @ seen.height[segment] / reach[segment], radar, errors, sequences
            )
        trees.append(
            explore(
                [partial(_feasible, model, largest_failure(problem)) for model in models],
                limits=replace(
                    _limits(problem, group, sequences, tolerance, max_boxes // len(groups)),
                    known=known**2 if len(groups) == 1 else math.inf,
                ),
                start=points,
            )
        )
    count = len(problem.scene)
    shares = [len(group.members) / count for group in groups]
    value = sum(s * tree.squared_error for s, tree in zip(shares, trees, strict=True))
    best = sum(s * tree.best for s, tree in zip(shares, trees, strict=True))
    return ProjectedBound(
        sign,
        math.sqrt(value) * (1.0 - ROUNDING),
        math.sqrt(best),
        tuple(sequences),
        tuple(groups),
        tuple(trees),
    )


def _feasible(model: SegmentModel, failure: float, boxes: Boxes, enough: float) -> Array:
    return model.feasible_error(boxes, failure=failure, enough=enough)


def largest_failure(problem: Problem) -> float:
    """Largest probability that a cycle is wrong; one that overshoots by rounding still keeps it.

    Parameters
    ----------
    problem : for its limits.
    """
    probability = problem.constraints.min_unwrapping_probability
    return 1.0 if probability is None else (1.0 - probability) * (1.0 + ROUNDING)


def prior_of(problem: Problem) -> float | None:
    """Deviation of the height known beforehand, where phases need be unwrapped; else None [m].

    Parameters
    ----------
    problem : for its limits.
    """
    constraints = problem.constraints
    if constraints.min_unwrapping_probability is None:
        return None
    return constraints.prior_height_std


def largest_coordinates(problem: Problem, space: DesignSpace, seen: Projection) -> Array:
    """Largest coordinate |a·v| of a satellite in each segment, (S,) [m].

    Parameters
    ----------
    problem : for its limit on the radius.
    space : for its box.
    seen : what the segments see of the plane.
    """
    of_disc = np.linalg.norm(seen.height, axis=-1) * plane_radius(
        space, max_radius=problem.constraints.max_radius
    )
    of_box = np.abs(seen.height) @ [space.max_offset, space.max_rate / space.mean_motion]
    return np.asarray(np.minimum(of_disc, of_box) * (1.0 + ROUNDING))


def _groups(problem: Problem, seen: Projection, reach: Array) -> list[SegmentGroup]:
    """Segments sorted into as few groups as their properties allow."""
    scene, radar = problem.scene, problem.radar
    wavenumber = 2.0 * np.pi / radar.wavelength * reach / seen.lever
    shift = reach / scene_critical_baseline(scene, radar)
    every = image_amplitude(scene, radar=radar, errors=problem.errors)
    every = np.broadcast_to(every, (len(scene), len(radar.images)))
    amplitude = every.max(axis=-1)
    common = common_height_errors(scene, radar=radar, errors=problem.errors)
    variance = sum((part**2 for part in common.values()), start=np.zeros(len(scene)))
    properties = np.log(np.stack([wavenumber, shift, amplitude], axis=-1))
    grid = 1e-6
    while True:
        cells = np.round((properties - properties.min(axis=0)) / grid)
        _, label = np.unique(cells, axis=0, return_inverse=True)
        if label.max() < _MAX_GROUPS:
            break
        grid *= 2.0
    groups = []
    for index in range(int(label.max()) + 1):
        members = np.flatnonzero(label.ravel() == index)
        groups.append(
            SegmentGroup(
                members,
                _range(wavenumber[members]),
                _range(shift[members]),
                float(amplitude[members].max()),
                bool(np.ptp(every[members]) <= ALIKE),
                float(variance[members].min()) * (1.0 - ROUNDING),
            )
        )
    return groups


def _range(values: Array) -> tuple[float, float]:
    return float(values.min()), float(values.max())


def _limits(
    problem: Problem,
    group: SegmentGroup,
    sequences: list[tuple[int, ...]],
    tolerance: float,
    max_boxes: int,
) -> Limits:
    radar, constraints = problem.radar, problem.constraints
    fraction = constraints.max_baseline_fraction
    first, second = radar.image_pairs.T
    rows = []
    for order in sequences:
        matrix = gap_matrix(radar, order)
        of_order = [np.ones(matrix.shape[-1])]
        for row in matrix[second] - matrix[first]:
            if fraction is not None:
                # |B⊥| over critical is row·gaps where no gap counts against another; else no
                # limit is drawn from this pair.
                one_sided = np.all(row >= 0.0) or np.all(row <= 0.0)
                of_order.append(np.abs(row) * group.shifts[0] if one_sided else 0.0 * row)
        rows.append(np.array(of_order))
    bounds = np.full(rows[0].shape[0], (fraction or 1.0) * (1.0 + ROUNDING))
    bounds[0] = 2.0
    return Limits(
        reach=np.full(rows[0].shape[-1], 2.0),
        gaps=rows[0].shape[-1],
        rows=np.array(rows),
        bounds=bounds,
        mirrored=tuple(is_palindrome(order, radar, problem.errors) for order in sequences),
        tolerance=tolerance,
        max_boxes=max_boxes,
    )
