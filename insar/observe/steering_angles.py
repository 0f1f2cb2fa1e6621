"""Closed forms of the steering laws: attitude angles from where the satellite is on its orbit.

Yaw ψ is about Z (nadir), pitch θ lifts the nose (`attitude.attitude_matrix`). With N the ratio of
the orbital rate to the Earth's, the Earth-fixed velocity in the orbit frame is
r ω_e (N − cos i, −sin i cos u, −V_r/(r ω_e)): exactly so for the instantaneous rate h/r².
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation.constants import EARTH_ROTATION_RATE

from ..scene import LookSide
from .frames import OrbitGeometry
from .vectors import safe_arcsin

Array = NDArray[np.float64]


class YawPitch(NamedTuple):
    """Yaw, then pitch, (...) each [rad]."""

    yaw: Array
    pitch: Array


class PitchRoll(NamedTuple):
    """Pitch, then roll about the pitched axis, (...) each [rad]."""

    pitch: Array
    roll: Array


def unsteered(geometry: OrbitGeometry) -> YawPitch:
    """No steering: the body is the orbit frame."""
    return YawPitch(np.zeros_like(geometry.radius), np.zeros_like(geometry.radius))


def raney(geometry: OrbitGeometry) -> YawPitch:
    """Yaw of a circular orbit with the same mean motion.

    Returns
    -------
    YawPitch — tanψ = −sin i cos u/(N − cos i) with N = n/ω_e, n the mean motion of the osculating
    semi-major axis; no pitch.

    References
    ----------
    Raney 1986.
    """
    return YawPitch(_yaw(geometry, geometry.mean_motion), np.zeros_like(geometry.radius))


def fiedler(geometry: OrbitGeometry) -> YawPitch:
    """Raney's yaw, and a pitch for the radial velocity.

    Returns
    -------
    YawPitch — tanθ = e sin f/(1 + e cos f).

    Notes
    -----
    Fiedler et al. 2005, as TerraSAR-X flies it: Zhao 2019 describes it as Raney's yaw with an
    approximate pitch. e sin f/(1 + e cos f) is V_r/V_t of the instant, the flight-path angle; it is
    taken from the velocity, where the osculating e and f of a nearly circular orbit are not needed.
    """
    along = geometry.angular_rate * geometry.radius
    return YawPitch(raney(geometry).yaw, np.arctan2(geometry.radial_velocity, along))


def total_zero_doppler(geometry: OrbitGeometry) -> YawPitch:
    """Yaw and pitch that lay the body's X axis along the Earth-fixed velocity.

    Returns
    -------
    YawPitch — tanψ = −sin i cos u/(N − cos i), tanθ = V_r/(r ω_e √((N − cos i)² +
    sin² i cos² u)), with N = (h/r²)/ω_e. Exact for any orbit and beam.

    Notes
    -----
    ψ is beyond ±π/2 where the satellite flies westward over the Earth faster than its orbit is
    retrograde: N < cos i, near the apogee of an eccentric geosynchronous orbit.
    """
    yaw = _yaw(geometry, geometry.angular_rate)
    forward = geometry.angular_rate - EARTH_ROTATION_RATE * geometry.axis_normal
    ground = geometry.radius * np.hypot(forward, EARTH_ROTATION_RATE * geometry.axis_along)
    return YawPitch(yaw, np.arctan2(geometry.radial_velocity, ground))


def zhao(geometry: OrbitGeometry, *, look_angle: ArrayLike, side: LookSide) -> PitchRoll:
    """Pitch and roll that point the body's Z axis into the zero-Doppler plane at a look angle.

    Parameters
    ----------
    geometry : where the satellite is, (...).
    look_angle : (...) — γ of the boresight from the geocentric nadir [rad].
    side : where the radar looks.

    Returns
    -------
    PitchRoll — with θ_d = −kψ + asin(tanθ_p/tanγ), k = 1 to the right and −1 to the left:
    tanθ = tanγ sinθ_d, tanφ = −k tanγ cosθ_d/√(1 + tan²γ sin²θ_d). NaN where |θ_p| > γ.

    Notes
    -----
    Zhao 2019 eqs (5) and (6), whose printed ground squint k(θ_yd + θ_pd) is right for k = 1 only;
    ψ and θ_p are those of `total_zero_doppler` (the paper's θ_y is −ψ). The altitude cancels. The
    roll is about the pitched axis.
    """
    yaw, pitch = total_zero_doppler(geometry)
    k = -int(side)
    tangent = np.tan(look_angle)
    squint = -k * yaw + safe_arcsin(np.tan(pitch) / tangent)  # eq. (5), corrected
    forward, aside = tangent * np.sin(squint), tangent * np.cos(squint)
    return PitchRoll(np.arctan(forward), -k * np.arctan2(aside, np.hypot(1.0, forward)))  # eq. (6)


def pitch_roll_towards(direction: Array) -> PitchRoll:
    """Pitch and roll that point the body's Z axis along a direction.

    Parameters
    ----------
    direction : (..., 3) — unit vectors in the orbit frame, below the horizon.
    """
    forward, right, down = np.moveaxis(direction, -1, 0)
    return PitchRoll(np.arctan2(forward, down), -np.arctan2(right, np.hypot(forward, down)))


def _yaw(geometry: OrbitGeometry, rate: Array) -> Array:
    """Horizontal direction of the Earth-fixed velocity at an orbital rate [rad]."""
    forward = rate / EARTH_ROTATION_RATE - geometry.axis_normal
    yaw: Array = np.arctan2(-geometry.axis_along, forward)
    return yaw
