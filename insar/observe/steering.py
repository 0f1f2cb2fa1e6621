"""Steering laws: the attitude that takes the Earth's rotation out of the Doppler centroid."""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum, StrEnum
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import States

from ..scene import LookSide
from .attitude import EulerAngles, attitude_matrix
from .boresight import Boresight, FixedLook
from .earth import WGS84, Ellipsoid, meets
from .frames import OrbitGeometry, orbit_axes, orbit_geometry
from .look import (
    BeamPlane,
    aim,
    angle_at_incidence,
    angle_between,
    beam_plane,
    zero_doppler_plane,
)
from .steering_angles import (
    YawPitch,
    fiedler,
    pitch_roll_towards,
    raney,
    total_zero_doppler,
    unsteered,
    zhao,
)
from .vectors import dot, rotate, unit

Array = NDArray[np.float64]


class Law(StrEnum):
    """How the satellite is steered."""

    NONE = "none"
    YAW = "yaw"
    YAW_PITCH_APPROXIMATE = "yaw_pitch_approximate"
    YAW_PITCH = "yaw_pitch"
    PITCH_ROLL = "pitch_roll"


class Outcome(IntEnum):
    """Whether a sample has a solution, and why not."""

    SOLVED = 0
    MISSES_EARTH = 1
    TOO_NEAR_NADIR = 2
    """The needed pitch exceeds the boresight's angle from nadir."""
    INCIDENCE_UNREACHED = 3


class Steering(NamedTuple):
    """Attitude and beam that a law gives; NaN where it has no solution.

    Attributes
    ----------
    attitude : (..., 3, 3) — orbit frame (X forward, Y = −N, Z nadir) to body: rows are body axes.
    yaw, pitch, roll : (...) — of the attitude, in this order [rad].
    antenna : (..., 3, 3) — rows are the antenna's axes, Earth-fixed: x azimuth (forward), y,
        z boresight. It is the body, but rolled about x by a constant or slowly varying mount angle
        (not part of `roll`) for every law except pitch-roll.
    off_nadir : (...) — of the boresight from the geocentric nadir [rad].
    outcome : (...) of `Outcome` — solved, or why not.
    outward : (..., 3) — the antenna's y axis or its opposite, whichever leads away from nadir.
    """

    attitude: Array
    yaw: Array
    pitch: Array
    roll: Array
    antenna: Array
    off_nadir: Array
    outcome: NDArray[np.int_]
    outward: Array

    @property
    def boresight(self) -> Array:
        """Line of sight of the beam's center, (..., 3), Earth-fixed."""
        return self.antenna[..., 2, :]


BODY_ANGLES: dict[Law, Callable[[OrbitGeometry], YawPitch]] = {
    Law.NONE: unsteered,
    Law.YAW: raney,
    Law.YAW_PITCH_APPROXIMATE: fiedler,
    Law.YAW_PITCH: total_zero_doppler,
}
"""Laws that turn the body and leave the look angle to the antenna's mount."""


def steer(
    law: Law,
    states: States,
    *,
    boresight: Boresight,
    side: LookSide,
    ellipsoid: Ellipsoid = WGS84,
) -> Steering:
    """Attitude of the body and direction of the beam under a steering law.

    Parameters
    ----------
    law : which.
    states : Earth-fixed, (..., 3) each [m, m/s]; perturbed orbits too.
    boresight : what is held constant: the look angle from the geocentric nadir, or the incidence
        on the ellipsoid.
    side : where the radar looks: seen along the Earth-fixed velocity for the exact laws, along the
        body's X axis for the others.
    ellipsoid : the Earth's figure.

    Returns
    -------
    Steering — with the reason where a sample has no solution.

    Notes
    -----
    Yaw-pitch and pitch-roll (exact) point the same beam; they differ in the antenna's turn
    about it, so that off the boresight only yaw-pitch keeps zero Doppler.
    """
    point = _pitch_roll if law is Law.PITCH_ROLL else partial(_mounted, BODY_ANGLES[law])
    found = point(states, boresight=boresight, side=side, ellipsoid=ellipsoid)
    beam = found.antenna[..., 2, :]
    outcome = _outcome(states.position, beam, found.down, boresight, ellipsoid)
    missing = np.where(outcome == Outcome.SOLVED, 0.0, np.nan)  # added, it leaves or erases
    nadir, elevation_axis = -unit(states.position), found.antenna[..., 1, :]
    inward = dot(elevation_axis, nadir)[..., None] > 0.0
    return Steering(
        attitude=found.attitude + missing[..., None, None],
        yaw=found.angles.yaw + missing,
        pitch=found.angles.pitch + missing,
        roll=found.angles.roll + missing,
        antenna=found.antenna + missing[..., None, None],
        off_nadir=angle_between(beam, nadir) + missing,
        outcome=outcome,
        outward=np.where(inward, -elevation_axis, elevation_axis) + missing[..., None],
    )


def off_boresight(steering: Steering, offset: ArrayLike) -> Array:
    """Lines of sight at elevations off the boresight, in the antenna's y-z plane.

    Parameters
    ----------
    steering : (...).
    offset : (E,) or scalar — positive away from nadir [rad].

    Returns
    -------
    (..., E, 3), or (..., 3) for a scalar — unit vectors, Earth-fixed.
    """
    angle = np.asarray(offset, dtype=np.float64)
    each = (..., *(None,) * angle.ndim, slice(None))
    cosine, sine = np.cos(angle)[..., None], np.sin(angle)[..., None]
    lines: Array = cosine * steering.boresight[each] + sine * steering.outward[each]
    return lines


def antenna_plane(steering: Steering, states: States) -> BeamPlane:
    """Plane of the antenna's beams, where `look.swath` finds the edges of the strip.

    Parameters
    ----------
    steering : (...).
    states : that were steered, Earth-fixed.

    Returns
    -------
    BeamPlane — with `aside` on the boresight's side.
    """
    plane = beam_plane(states.position, steering.antenna[..., 0, :], side=LookSide.RIGHT)
    towards = dot(plane.aside, steering.outward)[..., None] > 0.0
    return plane._replace(aside=np.where(towards, plane.aside, -plane.aside))


class _Pointing(NamedTuple):
    """Attitude, its angles, the antenna, and the direction of the beam plane nearest to nadir."""

    angles: EulerAngles
    attitude: Array
    antenna: Array
    down: Array


def _mounted(
    law: Callable[[OrbitGeometry], YawPitch],
    states: States,
    *,
    boresight: Boresight,
    side: LookSide,
    ellipsoid: Ellipsoid,
) -> _Pointing:
    """Turn the body by yaw and pitch, and roll the antenna about its X axis to the look angle."""
    axes = orbit_axes(states)
    yaw, pitch = law(orbit_geometry(states))
    angles = EulerAngles(yaw, pitch, np.zeros_like(yaw))
    attitude = attitude_matrix(yaw=yaw, pitch=pitch, roll=0.0)
    body = attitude @ axes
    forward, right, down = np.moveaxis(body, -2, 0)
    plane = BeamPlane(nadir=axes[..., 2, :], down=down, aside=-int(side) * right)
    beam = plane.direction(aim(states.position, plane, boresight, ellipsoid=ellipsoid))
    antenna = np.stack([forward, np.cross(beam, forward), beam], axis=-2)
    return _Pointing(angles, attitude, antenna, down)


def _pitch_roll(
    states: States, *, boresight: Boresight, side: LookSide, ellipsoid: Ellipsoid
) -> _Pointing:
    """Turn the body by pitch and roll until its Z axis, the boresight, is at zero Doppler."""
    axes = orbit_axes(states)
    plane = zero_doppler_plane(states, side=side)
    if isinstance(boresight, FixedLook):
        pitch, roll = zhao(orbit_geometry(states), look_angle=boresight.angle, side=side)
    else:
        elevation = angle_at_incidence(states.position, plane, boresight.angle, ellipsoid=ellipsoid)
        pitch, roll = pitch_roll_towards(rotate(axes, plane.direction(elevation)))
    angles = EulerAngles(np.zeros_like(pitch), pitch, roll)
    attitude = attitude_matrix(yaw=0.0, pitch=pitch, roll=roll)
    return _Pointing(angles, attitude, attitude @ axes, plane.down)


def _outcome(
    position: Array, beam: Array, down: Array, boresight: Boresight, ellipsoid: Ellipsoid
) -> NDArray[np.int_]:
    """Whether a beam exists and meets the Earth, and why not."""
    if isinstance(boresight, FixedLook):
        missing: Array | Outcome = Outcome.TOO_NEAR_NADIR
    else:
        reachable = meets(position, down, ellipsoid=ellipsoid)
        missing = np.where(reachable, Outcome.INCIDENCE_UNREACHED, Outcome.MISSES_EARTH)
    hit = meets(position, beam, ellipsoid=ellipsoid)
    exists = np.isfinite(beam[..., 0])
    return np.where(exists, np.where(hit, Outcome.SOLVED, Outcome.MISSES_EARTH), missing)
