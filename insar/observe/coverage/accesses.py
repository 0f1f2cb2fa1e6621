"""Every unbroken view of targets by the satellites of a Walker constellation, with exact edges.

The cosine q of the central angle between a satellite on a circular orbit and a target on the
turning Earth is a sum of three cosines of time. Its second derivative is −u̇²q to within
u̇²(2ε + ε²), with ε the Earth's rate by the orbit's: up to `MAX_ALTITUDE` q is concave wherever the
satellite is in view. So each pass has one closest approach, and one edge of the annulus on each
side of it: all are found by Newton's method, none is left to a step of time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation.constants import EARTH_ROTATION_RATE

from ...scene import LookSide
from ..vectors import safe_arccos
from .walker import GroundPoints, Visibility, Walker, annulus

Array = NDArray[np.float64]
Integers = NDArray[np.int_]

_NODES = 24
"""Samples of a revolution between which closest approaches are bracketed."""
_NEWTON_STEPS = 7
"""From errors of up to 0.2 rad to rounding; a grazing pass takes the most."""
_CHUNK = 4_000_000
"""Numbers held at once while bracketing."""


class Accesses(NamedTuple):
    """Unbroken views of targets by single satellites; the nadir gap breaks a pass in two.

    Attributes
    ----------
    target, satellite : (A,) — their indices.
    start, end : (A,) — since time 0 [s].
    """

    target: Integers
    satellite: Integers
    start: Array
    end: Array

    def select(self, chosen: NDArray[np.bool_]) -> Accesses:
        """Keep some, chosen by an (A,) mask."""
        return Accesses(
            self.target[chosen], self.satellite[chosen], self.start[chosen], self.end[chosen]
        )

    def join(self, other: Accesses) -> Accesses:
        """Append others."""
        return Accesses(
            np.concatenate([self.target, other.target]),
            np.concatenate([self.satellite, other.satellite]),
            np.concatenate([self.start, other.start]),
            np.concatenate([self.end, other.end]),
        )


class _Closeness(NamedTuple):
    """Cosine of the central angle of E (satellite, target) pairs: Σ a cos(f t + p) of 3 terms."""

    amplitude: Array  # (E, 3)
    rate: Array  # (3,)
    phase: Array  # (E, 3)

    def value(self, time: Array) -> tuple[Array, Array]:
        """The sum q and its rate, (E,) each."""
        angle = time[:, None] * self.rate + self.phase
        slope = -self.amplitude * self.rate * np.sin(angle)
        return np.vecdot(self.amplitude, np.cos(angle)), slope.sum(axis=-1)

    def curvature(self, time: Array) -> Array:
        """Second derivative of q, (E,)."""
        angle = time[:, None] * self.rate + self.phase
        bend: Array = -np.vecdot(self.amplitude * self.rate**2, np.cos(angle))
        return bend


def find_accesses(
    walker: Walker, points: GroundPoints, visibility: Visibility, duration: float
) -> Accesses:
    """Views of targets within a window of time.

    Parameters
    ----------
    walker : the constellation.
    points : (K,) — the targets.
    visibility : what a satellite sees.
    duration : scalar — of the window, from time 0 [s].

    Returns
    -------
    Accesses — in no particular order; the ends of the window cut them.
    """
    inner, outer = annulus(
        visibility, orbit_radius=walker.semi_major_axis, target_radius=points.radius
    )
    satellite, target, guess = _approaches(walker, points, outer, duration)
    closeness = _closeness(walker, points, satellite, target)
    peak = _peak(closeness, guess)
    far = _edges(closeness, peak, np.cos(outer)[target])
    # At nadir itself the annulus has no hole: a level that no cosine reaches.
    near = _edges(closeness, peak, np.where(inner > 0.0, np.cos(inner), np.inf)[target])
    whole = np.isnan(near[0])
    before = Accesses(target, satellite, far[0], np.where(whole, far[1], near[0]))
    after = Accesses(target, satellite, near[1], far[1])
    views = before.join(after.select(~whole))
    views = views.select(np.isfinite(views.start))
    if visibility.side is not None:
        views = _on_side(walker, points, views, visibility.side)
    clipped = views._replace(
        start=np.maximum(views.start, 0.0), end=np.minimum(views.end, duration)
    )
    return clipped.select(clipped.end > clipped.start)


def _turning(walker: Walker) -> float:
    """Rate at which the Earth turns under the orbit planes [rad/s]."""
    return EARTH_ROTATION_RATE - walker.rates.node


def _approaches(
    walker: Walker, points: GroundPoints, reach: Array, duration: float
) -> tuple[Integers, Integers, Array]:
    """Satellite, target and rough time of every approach to within the reach, (E,) each.

    A sample is at most half a step from the closest approach, and the angle from there changes by
    at most the sum of both rates: no pass is missed.
    """
    step = 2 * np.pi / walker.rates.argument_of_latitude / _NODES
    margin = 0.5 * step * (walker.rates.argument_of_latitude + _turning(walker))
    times = step * np.arange(-_NODES // 2, np.ceil(duration / step) + _NODES // 2 + 1)
    satellites = _directions(walker, times)
    targets = _unit_vectors(points.latitude, points.longitude)
    level = np.cos(reach + margin)
    found = []
    size = max(1, _CHUNK // (walker.total * times.size))
    for first in range(0, targets.shape[0], size):
        near = satellites @ targets[first : first + size].T  # (T, times, targets)
        middle = near[:, 1:-1]
        top = (middle >= near[:, :-2]) & (middle > near[:, 2:])
        satellite, node, target = np.nonzero(top & (middle > level[first : first + size]))
        found.append((satellite, target + first, times[node + 1]))
    satellite, target, guess = (np.concatenate(column) for column in zip(*found, strict=True))
    return satellite, target, guess


def _directions(walker: Walker, times: Array) -> Array:
    """Earth-fixed unit vectors of the satellites, (T, times, 3)."""
    node, argument = walker.pattern()
    east = node[:, None] - _turning(walker) * times
    along = argument[:, None] + walker.rates.argument_of_latitude * times
    forward = np.sin(along) * np.cos(walker.inclination)
    return np.stack(
        [
            np.cos(along) * np.cos(east) - forward * np.sin(east),
            np.cos(along) * np.sin(east) + forward * np.cos(east),
            np.sin(along) * np.sin(walker.inclination),
        ],
        axis=-1,
    )


def _unit_vectors(latitude: Array, longitude: Array) -> Array:
    cosine = np.cos(latitude)
    return np.stack(
        [cosine * np.cos(longitude), cosine * np.sin(longitude), np.sin(latitude)], axis=-1
    )


def _closeness(
    walker: Walker, points: GroundPoints, satellite: Integers, target: Integers
) -> _Closeness:
    """Cosine of the central angle as three cosines, of u − θ, u + θ and u (θ from the node)."""
    node, argument = walker.pattern()
    latitude = points.latitude[target]
    along, east = argument[satellite], points.longitude[target] - node[satellite]
    motion, turning = walker.rates.argument_of_latitude, _turning(walker)
    half = walker.inclination / 2
    amplitude = [
        np.cos(latitude) * np.cos(half) ** 2,
        np.cos(latitude) * np.sin(half) ** 2,
        np.sin(latitude) * np.sin(walker.inclination),
    ]
    return _Closeness(
        amplitude=np.stack(amplitude, axis=-1),
        rate=np.array([motion - turning, motion + turning, motion]),
        phase=np.stack([along - east, along + east, along - np.pi / 2], axis=-1),
    )


def _peak(closeness: _Closeness, guess: Array) -> Array:
    """Times of closest approach, (E,)."""
    time = guess
    for _ in range(_NEWTON_STEPS):
        time = time - closeness.value(time)[1] / closeness.curvature(time)
    return time


def _edges(closeness: _Closeness, peak: Array, level: Array) -> tuple[Array, Array]:
    """Times before and after the peak at which q equals the level; NaN where it stays below."""
    top = closeness.value(peak)[0]
    with np.errstate(invalid="ignore", divide="ignore"):
        width = safe_arccos(level / top) / np.sqrt(-closeness.curvature(peak) / top)
        before, after = peak - width, peak + width
        for _ in range(_NEWTON_STEPS):
            before = _newton(closeness, before, level)
            after = _newton(closeness, after, level)
    return before, after


def _newton(closeness: _Closeness, time: Array, level: Array) -> Array:
    value, slope = closeness.value(time)
    return time - (value - level) / slope


def _on_side(walker: Walker, points: GroundPoints, views: Accesses, side: LookSide) -> Accesses:
    """Parts of the views in which the target is on a side of the orbit plane.

    Its distance to the left of the plane is sin φ cos i − cos φ sin i sin θ, with θ its longitude
    from the node: each side is an arc of θ, about 90° for the right and −90° for the left.
    """
    latitude = points.latitude[views.target]
    rise = np.sin(latitude) * np.cos(walker.inclination)
    swing = np.cos(latitude) * np.sin(walker.inclination)
    # Angle by which the left arc exceeds half a turn at each end.
    excess = np.arcsin(np.clip(rise / np.maximum(swing, 1e-300), -1.0, 1.0))
    half_width = np.pi / 2 + side * excess
    half_width = np.where(half_width > np.pi - 1e-12, np.inf, half_width)
    east = points.longitude[views.target] - walker.pattern()[0][views.satellite]
    turning = _turning(walker)
    center = -side * np.pi / 2
    turn = np.round((east + turning * views.start - center) / (2 * np.pi))
    parts = [
        _within(views, (center + 2 * np.pi * number - east) / turning, half_width / turning)
        for number in (turn, turn + 1)
    ]
    # A side that is never left is one arc.
    return parts[0].join(parts[1].select(np.isfinite(half_width)))


def _within(views: Accesses, center: Array, half_width: Array) -> Accesses:
    """Views cut to center ± half_width; an empty one ends before it starts."""
    return views._replace(
        start=np.maximum(views.start, center - half_width),
        end=np.minimum(views.end, center + half_width),
    )
