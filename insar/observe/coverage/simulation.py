"""How well a Walker constellation covers targets over a window of time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..earth import WGS84, Ellipsoid
from .accesses import Accesses, find_accesses
from .results import Coverage, CoverIntervals
from .walker import GroundPoints, Visibility, Walker, ground_points

Array = NDArray[np.float64]
Integers = NDArray[np.int_]

_EDGE_ERROR = 1e-6
"""Gaps shorter than this are rounding of the edges [s]."""


def simulate_coverage(
    walker: Walker,
    *,
    latitude: ArrayLike,
    longitude: ArrayLike,
    visibility: Visibility,
    duration: float,
    ellipsoid: Ellipsoid = WGS84,
) -> Coverage:
    """When and how well a constellation sees targets.

    Parameters
    ----------
    walker : the constellation.
    latitude, longitude : (...) — geodetic, of the targets; they broadcast [rad].
    visibility : what a satellite sees of its surroundings.
    duration : scalar — of the window, from time 0 [s].
    ellipsoid : on which the targets lie; `sphere(radius)` for textbook cases.

    Returns
    -------
    Coverage — arrays of the broadcast shape.

    Raises
    ------
    ValueError
        If the window is not a positive time or a latitude is out of bounds.

    Notes
    -----
    Exact for circular orbits under secular J2, to about 1e-9 s; nothing depends on a step. Targets
    are at their distance from the center of the ellipsoid, with a geocentric vertical: incidence
    is off by up to 0.19°. That is less than what the circular orbit leaves out: 10 km of height,
    from J2 and a frozen eccentricity, are 0.5° at 500 km and 45°.
    """
    if not 0.0 < duration < np.inf:
        raise ValueError(f"duration = {duration!r} s must be a positive number of seconds")
    points = ground_points(latitude, longitude, ellipsoid=ellipsoid)
    flat = GroundPoints(*(np.ravel(coordinate) for coordinate in points))
    accesses = find_accesses(walker, flat, visibility, duration)
    return _statistics(walker, visibility, points, accesses, latitude, duration)


def symmetric_longitudes(walker: Walker, count: int) -> Array:
    """Longitudes that stand for all: evenly between two neighboring planes.

    Parameters
    ----------
    walker : the constellation.
    count : how many.

    Returns
    -------
    (count,) [rad].

    Notes
    -----
    A longitude 2π/P farther east sees the same as this one, some moments shifted, so over times
    longer than a day the statistics of all longitudes repeat from plane to plane.
    """
    return walker.first_node + 2 * np.pi / walker.planes * (np.arange(count) + 0.5) / count


def _merge(target: Integers, start: Array, end: Array) -> CoverIntervals:
    """Unions of the intervals of each target."""
    order = np.lexsort((start, target))
    target, start, end = target[order], start[order], end[order]
    # Ranks sorted by target first, so that a running maximum never reaches the next target.
    by_end = np.lexsort((end, target))
    rank = np.empty_like(by_end)
    rank[by_end] = np.arange(rank.size)
    latest = np.maximum.accumulate(rank)
    reach = end[by_end][latest]
    fresh = np.ones(target.size, dtype=bool)
    fresh[1:] = (target[1:] != target[:-1]) | (start[1:] > reach[:-1])
    last = np.append(fresh[1:], True)
    return CoverIntervals(target[fresh], start[fresh], reach[last])


def _statistics(
    walker: Walker,
    visibility: Visibility,
    points: GroundPoints,
    accesses: Accesses,
    latitude: ArrayLike,
    duration: float,
) -> Coverage:
    shape, count = points.latitude.shape, points.latitude.size
    # An empty interval at each end of the window lets every gap lie between two intervals.
    ends = np.repeat([0.0, duration], count)
    merged = _merge(
        np.concatenate([accesses.target, np.tile(np.arange(count), 2)]),
        np.concatenate([accesses.start, ends]),
        np.concatenate([accesses.end, ends]),
    )
    gap = merged.start[1:] - merged.end[:-1]
    real = (merged.target[1:] == merged.target[:-1]) & (gap > _EDGE_ERROR)
    where, gap = merged.target[1:][real], gap[real]
    longest = np.zeros(count)
    np.maximum.at(longest, where, gap)
    views = _total(accesses.target, count)
    seconds = _total(accesses.target, count, accesses.end - accesses.start)
    gaps, lost = _total(where, count), _total(where, count, gap)
    with np.errstate(invalid="ignore"):
        mean_access = seconds / np.where(views > 0, views, np.nan)
    return Coverage(
        walker=walker,
        visibility=visibility,
        latitude=np.broadcast_to(np.asarray(latitude, dtype=np.float64), shape),
        longitude=points.longitude,
        duration=duration,
        cover=(1.0 - lost / duration).reshape(shape),
        seen_by=(seconds / duration).reshape(shape),
        longest_gap=longest.reshape(shape),
        mean_gap=(lost / np.maximum(gaps, 1)).reshape(shape),
        mean_wait=(0.5 * _total(where, count, gap**2) / duration).reshape(shape),
        gaps=gaps.astype(int).reshape(shape),
        accesses=views.astype(int).reshape(shape),
        mean_access=mean_access.reshape(shape),
        intervals=merged.select(merged.end > merged.start),
    )


def _total(index: Integers, count: int, weights: Array | None = None) -> Array:
    return np.bincount(index, weights=weights, minlength=count).astype(np.float64)
