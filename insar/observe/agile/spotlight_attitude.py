"""Attitude of a body whose beam stays on a point: closed form, Han's iteration, and rates."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..frames import orbit_axes
from ..look import look_at
from ..vectors import dot, rotate
from .agility import Agility
from .profiles import Outcomes, Pointed, Profile, profile_of
from .rotations import EulerSequence
from .smooth_orbit import SmoothOrbit
from .spotlight_results import Iteration, Pointing, SpotlightRequest
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
) -> Profile:
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
    Profile — angles in the sequence 3-1-2; the rates are closed forms.
    """
    visible = look_at(orbit.states(times), target if place is None else place).visible
    return profile_of(
        orbit,
        times,
        lambda moments: point(orbit, moments, target, antenna),
        target=target,
        sequence=EulerSequence.THREE_ONE_TWO,
        outcomes=lambda attitude: _pointing(visible, attitude),
        agility=agility,
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


def _pointing(visible: NDArray[np.bool_], attitude: Array) -> Outcomes:
    """Reasons, (S,)."""
    turned = np.where(np.isfinite(attitude[:, 0, 0]), Pointing.SOLVED, Pointing.OPPOSITE)
    return np.where(visible, turned, Pointing.BELOW_HORIZON)
