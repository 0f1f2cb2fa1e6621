"""Attitude of a body whose beam stays on a point: closed form, Han's iteration, and rates."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..frames import orbit_axes
from ..look import look_at
from ..vectors import dot, rotate
from .rotations import EulerSequence, continuous, euler_sequence, quaternion
from .smooth_orbit import SmoothOrbit
from .spotlight_results import (
    Agility,
    AttitudeProfile,
    Iteration,
    Pointing,
    SpotlightRequest,
)
from .turning import (
    inertial_rate,
    moving_shortest_turn,
    orbit_frame,
    path_in_orbit_frame,
    shortest_turn,
    turn_between,
)

Array = NDArray[np.float64]

_ITERATIONS: Final = 20
_CONVERGED: Final = 1e-15
"""Change of the attitude matrix at which Han's iteration stops: rounding."""
_DIFFERENCE: Final = 1e-3
"""Step of the rates' derivative, in units of range by speed, in which geometry changes: an error
of 1e-6 of the acceleration."""


class Antenna(NamedTuple):
    """Where the beam leaves the body, and in which direction, in body axes.

    Attributes
    ----------
    beam : (3,) — unit vector b.
    phase_center : (3,) — p, from the center of mass [m].
    """

    beam: Array
    phase_center: Array

    @classmethod
    def of(cls, request: SpotlightRequest) -> Antenna:
        """Antenna of a request: b = (0, −sin, cos) of the off-axis angle."""
        angle = request.off_axis
        beam = np.array([0.0, -math.sin(angle), math.cos(angle)])
        return cls(beam, np.asarray(request.phase_center, dtype=np.float64))


class Pointed(NamedTuple):
    """Attitude (S, 3, 3) and its rates against orbit frame and inertial space, (S, 3) [rad/s]."""

    attitude: Array
    rate_orbit: Array
    rate_inertial: Array


def point(orbit: SmoothOrbit, times: Array, target: Array, antenna: Antenna) -> Pointed:
    """Attitude by the closed form, and its rates.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    target : (3,) — where the beam points, Earth-fixed [m].
    antenna : beam and phase center.

    Notes
    -----
    The beam meets the target T at the distance s from the phase center if |p + s b| = |T|:
    s = −b·p + √((b·p)² + |T|² − |p|²). The shortest turn that takes p + s b to T does the rest;
    nothing needs to be iterated.
    """
    states = orbit.states(times)
    frame = orbit_frame(states, orbit.acceleration(times))
    path, path_rate = path_in_orbit_frame(states, frame, target)
    beam, offset = antenna
    projection = dot(beam, offset)
    root = np.sqrt(projection**2 + dot(path, path) - dot(offset, offset))
    start = offset + (root - projection)[:, None] * beam
    start_rate = (dot(path, path_rate) / root)[:, None] * beam
    attitude, rate = moving_shortest_turn(start, start_rate, path, path_rate)
    return Pointed(attitude, rate, inertial_rate(attitude, rate, frame.rate))


def attitude_profile(
    orbit: SmoothOrbit,
    times: Array,
    target: Array,
    antenna: Antenna,
    *,
    place: Array | None = None,
    agility: Agility | None = None,
) -> AttitudeProfile:
    """Attitude, rates and accelerations while the beam stays on a point.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    target : (3,) — where the beam points, Earth-fixed [m].
    antenna : beam and phase center.
    place : (3,) — point on the ground that must see the satellite, Earth-fixed [m]; the target if
        None. The target of a sliding beam lies below the ground.
    agility : limits; None for none.

    Returns
    -------
    AttitudeProfile — the rates are closed forms; the accelerations are differences of them over
    `_DIFFERENCE`, whatever the spacing of the times.
    """
    states = orbit.states(times)
    now = point(orbit, times, target, antenna)
    visible = look_at(states, target if place is None else place).visible
    pointing = _pointing(visible, now.attitude)
    mask = np.where(pointing == Pointing.SOLVED, 0.0, np.nan)
    step = _DIFFERENCE * float(
        np.min(np.linalg.norm(target - states.position, axis=-1))
        / np.max(np.linalg.norm(states.velocity, axis=-1))
    )
    before, after = (point(orbit, times + shift, target, antenna) for shift in (-step, step))
    attitude = now.attitude + mask[:, None, None]
    angles = euler_sequence(attitude, EulerSequence.THREE_ONE_TWO)
    axes = orbit_axes(states)
    rate_inertial = now.rate_inertial + mask[:, None]
    acceleration = (after.rate_inertial - before.rate_inertial) / (2.0 * step) + mask[:, None]
    limits = agility or Agility()
    return AttitudeProfile(
        attitude=attitude,
        yaw=angles.yaw,
        pitch=angles.pitch,
        roll=angles.roll,
        singular=angles.singular,
        quaternion_orbit=continuous(quaternion(attitude)),
        quaternion_inertial=continuous(quaternion(attitude @ axes @ orbit.from_celestial(times))),
        rate_orbit=now.rate_orbit + mask[:, None],
        rate_inertial=rate_inertial,
        acceleration_orbit=(after.rate_orbit - before.rate_orbit) / (2.0 * step) + mask[:, None],
        acceleration_inertial=acceleration,
        pointing=pointing,
        rate_exceeded=_exceeds(rate_inertial, limits.max_rate),
        acceleration_exceeded=_exceeds(acceleration, limits.max_acceleration),
    )


def iterate(
    orbit: SmoothOrbit, times: Array, target: Array, antenna: Antenna, *, closed_form: Array
) -> Iteration:
    """Attitude by Han's iteration.

    Parameters
    ----------
    orbit, times, target, antenna : as in `point`.
    closed_form : (S, 3, 3) — attitude to compare with.

    Returns
    -------
    Iteration — all times go through as many steps as the slowest.

    Notes
    -----
    The phase center is first taken at p in the orbit frame, as if the body were not turned. The
    shortest turn of b onto the direction from there to the target gives an attitude; that moves
    the phase center to Cᵀp, and so on. Each step shrinks the error by |p| over the range, 1e-6.

    References
    ----------
    Han 2016 eqs (7)-(10) and figure 3.
    """
    states = orbit.states(times)
    path = rotate(orbit_axes(states), target - states.position)
    attitude = np.broadcast_to(np.eye(3), (len(times), 3, 3))
    steps, change = 0, np.inf
    while change > _CONVERGED and steps < _ITERATIONS:
        offset = rotate(np.swapaxes(attitude, -1, -2), antenna.phase_center)
        improved = shortest_turn(antenna.beam, path - offset)
        change = float(np.fmax.reduce(np.abs(improved - attitude), axis=None, initial=0.0))
        attitude, steps = improved, steps + 1
    return Iteration(attitude, steps, turn_between(closed_form, attitude))


def _pointing(visible: NDArray[np.bool_], attitude: Array) -> NDArray[np.int_]:
    """Reasons, (S,)."""
    turned = np.where(np.isfinite(attitude[:, 0, 0]), Pointing.SOLVED, Pointing.OPPOSITE)
    return np.where(visible, turned, Pointing.BELOW_HORIZON)


def _exceeds(vector: Array, limit: float | tuple[float, float, float]) -> NDArray[np.bool_]:
    """Whether a magnitude, or any component, is above its limit, (S,); not where it is NaN."""
    bound = np.asarray(limit, dtype=np.float64)
    if bound.ndim == 0:
        above: NDArray[np.bool_] = np.sqrt(dot(vector, vector)) > bound
    else:
        above = np.any(np.abs(vector) > bound, axis=-1)
    return above
