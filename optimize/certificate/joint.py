"""The lower bound where the segments of a scene differ: one formation for all of them.

A formation is the differences of its points v in the plane (z0, ż0/n): along the mean direction in
which the segments see heights, and across. Each segment sees its own combination of the two.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from insar.coherence import image_amplitude
from insar.height import common_height_errors

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import projection
from .orders import is_palindrome, known_gaps
from .plane import Frame, plane_frame
from .projected import ALIKE, ROUNDING, ProjectedBound, largest_failure, prior_of
from .segment import Boxes, PlaneBoxes, SegmentModel, gap_matrix
from .tree import Limits, explore

Array = NDArray[np.float64]

_CHUNK = 512
"""Boxes split at a time; each is looked at in every segment."""


def joint_bound(
    problem: Problem,
    space: DesignSpace,
    separate: ProjectedBound,
    *,
    start: Array | None,
    known: float = math.inf,
    tolerance: float,
    max_boxes: int,
) -> ProjectedBound:
    """Bound the region height error from below, one formation for all segments.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    separate : what is proved of each segment on its own.
    start : (N, 2) — points (z0, ż0/n) of a good formation; None without [m].
    known : scalar — region height error of a formation, of either sign [m].
    tolerance : relative distance of bound and best at which the tree is done.
    max_boxes : bounded at most, in all segments together.

    Returns
    -------
    ProjectedBound — with the larger of both bounds.
    """
    seen = projection(
        space, problem.scene, held_constant=problem.errors.held_constant, sign=separate.sign
    )
    frame = plane_frame(problem, space, seen)
    points = []
    if start is not None:
        at = start @ frame.axes.T / frame.radius
        points = [
            (order, np.concatenate([gaps[:, 0], gaps[:, 1] * frame.tilt]))
            for order, gaps in known_gaps(at, problem.radar, problem.errors, list(separate.orders))
        ]
    tree = explore(
        [joint_model(problem, frame, separate, order).feasible_error for order in separate.orders],
        limits=replace(
            _limits(problem, frame, separate, tolerance, max_boxes // len(problem.scene)),
            known=known**2,
        ),
        start=points,
    )
    value = math.sqrt(tree.squared_error) * (1.0 - ROUNDING)
    return separate._replace(value=max(value, separate.value), joint=tree)


@dataclass(frozen=True, kw_only=True, eq=False)
class JointModel:
    """All segments, for one order of the satellites.

    Parameters
    ----------
    models : of each segment, in the order in which they are looked at.
    height, azimuth : (S, 2) — what a segment sees of the coordinates along and across.
    floors : (S,) — squared error that each segment has at least [m²].
    failure : scalar — largest probability that a cycle is wrong in any.
    separation : scalar — smallest distance of two satellites, in parts of the disc.
    tilt : scalar — as in `Frame`.
    """

    models: tuple[SegmentModel, ...]
    height: Array
    azimuth: Array
    floors: Array
    failure: float
    separation: float
    tilt: float

    def feasible_error(self, boxes: Boxes, enough: float) -> Array:
        """Mean of the smallest squared errors of a box in each segment.

        Parameters
        ----------
        boxes : differences along, then across, between neighbors, (n, 2(N − 1)).
        enough : scalar — above which no more segments are looked at.

        Returns
        -------
        (n,) — `inf` where some segment can keep no limit.
        """
        total = np.full(len(boxes.lower), float(self.floors.mean()))
        total[~self._possible(boxes)] = np.inf
        left = np.flatnonzero(total < enough)
        for model, height, azimuth, floor in zip(
            self.models, self.height, self.azimuth, self.floors, strict=True
        ):
            if not left.size:
                break
            plane = PlaneBoxes(boxes.lower[left], boxes.upper[left], height, azimuth)
            squared = model.feasible_error(
                Boxes(*seen_gaps(plane), plane),
                failure=self.failure,
                enough=(enough - total[left]) * len(self.models) + floor,
            )
            total[left] += np.maximum(0.0, squared - floor) / len(self.models)
            left = left[total[left] < enough]
        return total

    def _possible(self, boxes: Boxes) -> NDArray[np.bool_]:
        """Whether satellites of a box can be in the disc, and every two of them apart."""
        count = boxes.lower.shape[-1] // 2
        possible = np.ones(len(boxes.lower), dtype=bool)
        for first in range(count):
            for last in range(first + 1, count + 1):
                least = most = np.zeros(len(boxes.lower))
                for axis, unit in ((0, 1.0), (count, 1.0 / self.tilt)):
                    pair = slice(axis + first, axis + last)
                    low = unit * boxes.lower[:, pair].sum(axis=-1)
                    high = unit * boxes.upper[:, pair].sum(axis=-1)
                    least = least + np.maximum(0.0, np.maximum(low, -high)) ** 2
                    most = most + np.maximum(high, -low) ** 2
                possible &= (least <= 4.0) & (most >= self.separation**2)
        return possible


def seen_gaps(plane: PlaneBoxes) -> tuple[Array, Array]:
    """Least and largest gaps as a segment sees them, (n, N − 1) each.

    Parameters
    ----------
    plane : the boxes, and what the segment sees of them.
    """
    count = plane.lower.shape[-1] // 2
    middle, half = 0.5 * (plane.lower + plane.upper), 0.5 * (plane.upper - plane.lower)
    along, across = plane.height
    center = along * middle[:, :count] + across * middle[:, count:]
    radius = abs(along) * half[:, :count] + abs(across) * half[:, count:]
    return center - radius, center + radius


def joint_model(
    problem: Problem, frame: Frame, separate: ProjectedBound, order: tuple[int, ...]
) -> JointModel:
    """All segments of a problem, for one order of the satellites.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    frame : from `plane_frame`.
    separate : what is proved of each segment on its own.
    order : satellites by increasing coordinate along the direction of the frame.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    every = image_amplitude(scene, radar=radar, errors=errors)
    every = np.broadcast_to(every, (len(scene), len(radar.images)))
    common = common_height_errors(scene, radar=radar, errors=errors)
    variance = sum((part**2 for part in common.values()), start=np.zeros(len(scene)))
    floors = np.zeros(len(scene))
    for group, tree in zip(separate.groups, separate.trees, strict=True):
        floors[group.members] = tree.squared_error
    # The nearest and the farthest first: what is feasible in both often is in all.
    ranked = np.argsort(frame.wavenumber * np.abs(frame.height[:, 0]), kind="stable")
    ranked = np.concatenate([ranked[[-1]], ranked[:-1]])
    models = tuple(
        SegmentModel(
            radar=radar,
            errors=errors,
            order=order,
            wavenumbers=(frame.wavenumber[index],) * 2,
            shifts=(frame.shift[index],) * 2,
            amplitude=float(every[index].max()),
            alike=bool(np.ptp(every[index]) <= ALIKE),
            range_variance=float(variance[index]) * (1.0 - ROUNDING),
            prior_height_std=prior_of(problem),
        )
        for index in ranked
    )
    return JointModel(
        models=models,
        height=frame.height[ranked],
        azimuth=frame.azimuth[ranked],
        floors=floors[ranked],
        failure=largest_failure(problem),
        # The closest approach of a pair over the orbit is twice its distance in the plane.
        separation=0.5
        * (problem.constraints.min_separation or 0.0)
        / frame.radius
        * (1 - ROUNDING),
        tilt=frame.tilt,
    )


def _limits(
    problem: Problem, frame: Frame, separate: ProjectedBound, tolerance: float, max_boxes: int
) -> Limits:
    radar, fraction = problem.radar, problem.constraints.max_baseline_fraction
    gaps = len(separate.orders[0]) - 1
    first, second = radar.image_pairs.T
    rows = []
    for order in separate.orders:
        matrix = gap_matrix(radar, order)
        of_order = [np.ones(gaps)]
        for row in matrix[second] - matrix[first]:
            one_sided = fraction is not None and (np.all(row >= 0.0) or np.all(row <= 0.0))
            of_order.append(np.abs(row) if one_sided else 0.0 * row)
        rows.append(np.pad(np.array(of_order), ((0, 0), (0, gaps))))
    bounds = np.full(rows[0].shape[0], np.inf)
    if fraction is not None:
        # |along·Δx + across·Δy|·shift ≤ fraction, whatever Δy of the two (or four) satellites.
        along, across = np.abs(frame.height.T)
        most = (fraction / frame.shift + 4.0 * across * frame.tilt) * (1.0 + ROUNDING)
        bounds[:] = np.min(most / np.maximum(along, 1e-9))
    bounds[0] = 2.0 * frame.reach[0]
    reach = np.repeat(2.0 * frame.reach * [1.0, frame.tilt], gaps)
    return Limits(
        reach=reach,
        gaps=gaps,
        rows=np.array(rows),
        bounds=bounds,
        mirrored=tuple(is_palindrome(order, radar, problem.errors) for order in separate.orders),
        tolerance=tolerance,
        max_boxes=max_boxes,
        chunk=_CHUNK,
    )
