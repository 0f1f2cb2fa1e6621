"""Yaw laws of a staring beam: the direction of the body's X about the line of sight.

The beam is along the body's Z. Everything is in the axes of the orbit frame but for what is held,
which rests on the Earth.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States

from ..frames import EARTH_ROTATION
from ..vectors import dot, rotate, safe_arccos, unit
from .turning import OrbitFrame, path_in_orbit_frame
from .video_request import YawLaw

Array = NDArray[np.float64]

_X_AXIS: Final = np.array([1.0, 0.0, 0.0])
_ALONG: Final = 1e-9
"""Sine of the angle between the line of sight and a direction that no turn about it moves."""


class Beam(NamedTuple):
    """Half widths of the beam about the antenna's Y and X axes: in azimuth and elevation [rad]."""

    azimuth: float
    elevation: float


class Sight(NamedTuple):
    """A target and the frame it is seen from, in the axes of the orbit frame, and how both move.

    Attributes
    ----------
    frame : axes and angular velocity of the orbit frame.
    path, path_rate : (S, 3) — from the satellite to the target [m, m/s].
    line, line_rate : (S, 3) — unit line of sight and its derivative.
    """

    frame: OrbitFrame
    path: Array
    path_rate: Array
    line: Array
    line_rate: Array

    def ground(self, vector: Array) -> tuple[Array, Array]:
        """A direction at rest on the Earth, (3,) Earth-fixed, and its rate in the frame."""
        here = rotate(self.frame.axes, vector)
        against_earth = self.frame.rate - rotate(self.frame.axes, EARTH_ROTATION)
        return here, -np.cross(against_earth, here)


class Held(NamedTuple):
    """What a yaw law holds, Earth-fixed; from the reference time.

    Attributes
    ----------
    law : which.
    target, up : (3,) — the aim point [m] and its vertical.
    direction : (3,) — horizontal, that is held; NaN for the laws that hold none.
    beam : half widths, for the major axis.
    branch : of the two turns that lay the major axis along `direction`, and of X forward or back.
    """

    law: YawLaw
    target: Array
    up: Array
    direction: Array
    beam: Beam
    branch: tuple[float, float] = (1.0, 1.0)


def ground_map(body: Array, path: Array, up: Array) -> Array:
    """How the footprint moves over the ground by small angles off the boresight.

    Parameters
    ----------
    body : (..., 3, 3) — rows are the body axes, Earth-fixed; the beam is the last.
    path : (..., 3) — from the satellite to the target, along the beam [m].
    up : (3,) — vertical at the target.

    Returns
    -------
    (..., 3, 2) — displacement along the ground by an angle off the beam towards X and towards Y
    [m/rad]: the traces of the azimuth and of the range plane.
    """
    line = unit(path)
    slant_range = np.sqrt(dot(path, path))[..., None]
    traces = [
        slant_range * (axis - line * (dot(axis, up) / dot(line, up))[..., None])
        for axis in (body[..., 0, :], body[..., 1, :])
    ]
    return np.stack(traces, axis=-1)


def sight_of(states: States, frame: OrbitFrame, target: Array) -> Sight:
    """Line of sight to a point at rest on the Earth, (3,) Earth-fixed [m], and how it moves."""
    path, path_rate = path_in_orbit_frame(states, frame, target)
    line = unit(path)
    turning = path_rate / np.sqrt(dot(path, path))[:, None]
    return Sight(frame, path, path_rate, line, turning - dot(turning, line)[:, None] * line)


def major_axis(ground: Array, beam: Beam) -> Array:
    """Direction of the footprint's longest diameter, Earth-fixed, from `ground_map`, (3,)."""
    directions, _, _ = np.linalg.svd(ground * np.array(beam))
    axis: Array = directions[:, 0]
    return axis


def _unyawed(sight: Sight, held: Held) -> tuple[Array, Array]:
    """X of the body without yaw, and its spin: the orbit frame's X, made perpendicular to û."""
    return _about_sight(sight, np.broadcast_to(_X_AXIS, sight.line.shape), np.zeros(3))


def _along_azimuth(sight: Sight, held: Held) -> tuple[Array, Array]:
    """X that lays the azimuth trace along the held direction, and its spin."""
    return _about_sight(sight, *sight.ground(held.direction))


def _along_range(sight: Sight, held: Held) -> tuple[Array, Array]:
    """X that lays the range trace, on which Y lies, along the held direction, and its spin."""
    side, spin = _along_azimuth(sight, held)
    return np.cross(side, sight.line), spin


def _about_sight(sight: Sight, vector: Array, rate: Array) -> tuple[Array, Array]:
    """Unit part of a vector across the line of sight, and its spin about it [rad/s].

    NaN for a vector along the line of sight.
    """
    line = sight.line
    along = dot(vector, line)[:, None]
    across = vector - along * line
    squared = dot(across, across)
    squared = np.where(squared > _ALONG**2 * dot(vector, vector), squared, np.nan)
    change = rate - along * sight.line_rate
    spin = dot(line, np.cross(across, change)) / squared
    return across / np.sqrt(squared)[:, None], spin


def _along_major_axis(sight: Sight, held: Held) -> tuple[Array, Array]:
    """X that lays the footprint's major axis along the held direction V, and its spin.

    With p = û×V and q = û×W, W horizontal and across V, the footprint's ellipse has an axis along V
    if s p·q + d |p||q| cos(2α − φ_p − φ_q) = 0: α, φ_p, φ_q the directions of X, p, q about û, and
    s, d the sum and the difference of the squared half widths. X then stands at an angle
    β = arccos(−(s/d) cos δ)/2 to either side of the bisector of p and q, δ the angle between them.
    """
    line, ratio = sight.line, _axis_ratio(held.beam)
    p, p_spin, q, q_spin = _bases(sight, held)
    cosine, sine = dot(p, q), dot(line, np.cross(q, p))
    bisector = unit(p + q)
    with np.errstate(invalid="ignore", divide="ignore"):  # no such turn, or a round beam
        doubled = -ratio * cosine  # cos 2β
        half_angle = 0.5 * safe_arccos(doubled)
        opening = -0.5 * ratio * sine * (p_spin - q_spin) / np.sqrt(1.0 - doubled**2)
    side, sign = held.branch
    cos_half, sin_half = np.cos(half_angle)[:, None], np.sin(half_angle)[:, None]
    forward = cos_half * bisector + side * sin_half * np.cross(line, bisector)
    spin = 0.5 * (p_spin + q_spin) + side * opening
    laid = _along_over_across(sight, forward, held) > 1.0  # else it is the minor axis
    return sign * forward, np.where(laid & np.isfinite(spin), spin, np.nan)


def _bases(sight: Sight, held: Held) -> tuple[Array, Array, Array, Array]:
    """Unit p = û×V and q = û×W and their spins about û."""
    both = []
    for direction in (held.direction, np.cross(held.up, held.direction)):
        vector, rate = sight.ground(direction)
        base = np.cross(sight.line, vector)
        change = np.cross(sight.line_rate, vector) + np.cross(sight.line, rate)
        spin = dot(sight.line, np.cross(base, change)) / dot(base, base)
        both += [unit(base), spin]
    return both[0], both[1], both[2], both[3]


def _along_over_across(sight: Sight, forward: Array, held: Held) -> Array:
    """Extent of the footprint along the held direction by that across it, squared."""
    body = np.stack([forward, np.cross(sight.line, forward), sight.line], axis=-2)
    up, _ = sight.ground(held.up)
    ground = ground_map(body, sight.path, up) * np.array(held.beam)
    extents = []
    for direction in (held.direction, np.cross(held.up, held.direction)):
        here, _ = sight.ground(direction)
        extents.append(np.sum(np.einsum("si,sij->sj", here, ground) ** 2, axis=-1))
    ratio: Array = extents[0] / extents[1]
    return ratio


def _axis_ratio(beam: Beam) -> float:
    """(a² + b²)/(a² − b²) of the half widths; infinite for a round beam."""
    total = beam.azimuth**2 + beam.elevation**2
    difference = beam.azimuth**2 - beam.elevation**2
    return total / difference if difference != 0.0 else np.inf


X_DIRECTIONS: Final = {
    YawLaw.NONE: _unyawed,
    YawLaw.AZIMUTH_TRACE: _along_azimuth,
    YawLaw.RANGE_TRACE: _along_range,
    YawLaw.MAJOR_AXIS: _along_major_axis,
}
"""X of the body and its spin about the line of sight [rad/s], (S, 3) and (S,), by law."""
