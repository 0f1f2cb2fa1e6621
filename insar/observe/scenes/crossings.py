"""When a plane that a satellite carries along sweeps over targets."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States, Trajectory

from ..earth import vertical
from ..look import look_at
from ..vectors import dot, unit
from .windows import Window, window_around

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Indices = NDArray[np.intp]
Axis = Callable[[States], Array]
"""Normal of the plane: unit vectors (..., 3) of Earth-fixed states; NaN where it has none."""

STEPS_PER_REVOLUTION: Final = 120
"""Of the search. A target passes through the plane about twice in a revolution."""
TIME_TOLERANCE: Final = 1e-7
"""Of a crossing [s]; the satellite moves less than a millimeter."""
_BLOCK = 4096
"""Samples that are searched at a time, to bound the memory of long searches."""
_LOWEST = -0.1
"""Height of the satellite over the target's horizon plane, by its distance from the Earth's center,
below which it does not come into view within a step of the search."""


class Crossings(NamedTuple):
    """Moments at which targets lie in the plane, in order of time; C of them.

    Attributes
    ----------
    target : (C,) — index.
    time : (C,) — since the trajectory's epoch [s].
    """

    target: Indices
    time: Array

    def where(self, chosen: Mask) -> Crossings:
        """Some of them, by a mask (C,)."""
        return Crossings(self.target[chosen], self.time[chosen])


def find_crossings(
    trajectory: Trajectory, position: Array, axis: Axis, window: Window
) -> Crossings:
    """Moments at which targets lie in the plane through the satellite perpendicular to an axis.

    Parameters
    ----------
    trajectory : of the satellite.
    position : (K, 3) — of the targets, Earth-fixed [m].
    axis : of the plane.
    window : that is searched.

    Returns
    -------
    Crossings — to `TIME_TOLERANCE`; of targets that have the satellite above their horizon, and of
    some that have it a little below.

    Notes
    -----
    The target's coordinate along the axis is a slow wave over the revolution, and so its signs at
    `STEPS_PER_REVOLUTION` bracket the roots. Two within a step, where the plane only just reaches
    a target and turns back, are not found.
    """
    found = list(_brackets(trajectory, position, axis, window))
    target = np.concatenate([bracket.target for bracket in found])

    def ahead(times: Array) -> Array:
        states = trajectory.earth_fixed(times)
        return dot(position[target] - states.position, axis(states))

    time = refine_root(
        ahead,
        np.concatenate([bracket.low for bracket in found]),
        np.concatenate([bracket.high for bracket in found]),
    )
    order = np.lexsort((target, time))
    return Crossings(target[order], time[order])


class _Brackets(NamedTuple):
    """Targets that cross the plane between two times, (C,) each."""

    target: Indices
    low: Array
    high: Array


def _brackets(
    trajectory: Trajectory, position: Array, axis: Axis, window: Window
) -> Iterator[_Brackets]:
    """Crossings in view, bracketed by the steps of the search."""
    up = vertical(position)
    for times in sample_blocks(window, STEPS_PER_REVOLUTION):
        states = trajectory.earth_fixed(times)
        forward = axis(states)
        ahead = forward @ position.T - dot(forward, states.position)[:, None]
        height = states.position @ up.T - dot(position, up)
        in_view = height > _LOWEST * np.linalg.norm(states.position, axis=-1)[:, None]
        crossed = sign_changes(ahead) & (in_view[:-1] | in_view[1:])
        step, target = np.nonzero(crossed)
        yield _Brackets(target, times[step], times[step + 1])


def sign_changes(values: Array) -> Mask:
    """Whether a sign changes between samples, (S, ...) to (S − 1, ...); not next to NaN."""
    positive, known = values > 0.0, np.isfinite(values)
    changed: Mask = (positive[:-1] != positive[1:]) & known[:-1] & known[1:]
    return changed


def sample_blocks(window: Window, steps_per_revolution: int) -> Iterator[Array]:
    """Evenly spaced times of a window, in blocks that share their ends."""
    count = math.ceil((window.stop - window.start) / window.period * steps_per_revolution)
    times = np.linspace(window.start, window.stop, max(count, 1) + 1)
    for first in range(0, len(times) - 1, _BLOCK):
        yield times[first : first + _BLOCK + 1]


def refine_root(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Roots of a smooth function, many at once, between times at which its signs differ.

    Parameters
    ----------
    function : takes and returns (C,).
    low, high : (C,) [s].

    Returns
    -------
    (C,) — to `TIME_TOLERANCE` [s]; NaN where the function is.

    References
    ----------
    Regula falsi, "Illinois": Dowell & Jarratt 1971, doi:10.1007/BF01934364.
    """
    if low.size == 0:
        return low
    older, newer = low, high
    older_value, newer_value = function(low), function(high)
    for _ in range(60):
        slope = newer_value - older_value
        with np.errstate(invalid="ignore", divide="ignore"):
            step = -newer_value * (newer - older) / slope
        # Both ends are zero once the root is hit exactly.
        root = newer + np.where(slope == 0.0, 0.0, step)
        value = function(root)
        kept = (value > 0.0) == (newer_value > 0.0)
        older = np.where(kept, older, newer)
        older_value = np.where(kept, 0.5 * older_value, newer_value)
        moved, newer, newer_value = np.abs(root - newer), root, value
        if not np.any(moved > 0.1 * TIME_TOLERANCE):
            break
    return newer


def zero_doppler(states: States) -> Array:
    """Axis whose plane holds the targets of zero Doppler: the Earth-fixed velocity."""
    return unit(states.velocity)


def nearest_crossings(
    trajectory: Trajectory, position: Array, axis: Axis, times: Array, *, period: float
) -> Array:
    """Moments at which targets cross a plane, in view, nearest to given ones.

    Parameters
    ----------
    trajectory : of the satellite.
    position : (S, 3) — of the targets, Earth-fixed [m].
    axis : of the plane.
    times : (S,) — since the trajectory's epoch [s].
    period : scalar — of a revolution [s].

    Returns
    -------
    (S,) — [s]; NaN where there is none within a quarter of a revolution.
    """
    window = window_around(trajectory, times, period=period, revolutions=0.25)
    crossings = find_crossings(trajectory, position, axis, window)
    states = trajectory.earth_fixed(crossings.time)
    target, time = crossings.where(look_at(states, position[crossings.target]).visible)
    nearest = np.full(times.shape, np.nan)
    # Written from the farthest to the nearest, which stays.
    order = np.argsort(-np.abs(time - times[target]), kind="stable")
    nearest[target[order]] = time[order]
    return np.where(np.abs(nearest - times) <= period / 4, nearest, np.nan)
