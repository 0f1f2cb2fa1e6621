"""How a body turns over an imaging: angles, quaternions, rates, accelerations, and their limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..frames import orbit_axes
from .agility import Agility, exceeds
from .rotations import EulerSequence, continuous, euler_sequence, quaternion, upright
from .smooth_orbit import SmoothOrbit

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Outcomes = NDArray[np.int_]

_DIFFERENCE: Final = 1e-3
"""Step of the rates' derivative, in units of range by speed, in which geometry changes: an error
of 1e-6 of the acceleration."""


class Pointed(NamedTuple):
    """Attitude (S, 3, 3) and its rates against orbit frame and inertial space, (S, 3) [rad/s]."""

    attitude: Array
    rate_orbit: Array
    rate_inertial: Array


class Profile(NamedTuple):
    """Attitude of the body over an imaging, S samples; NaN where it has no solution.

    Attributes
    ----------
    attitude : (S, 3, 3) — orbit frame to body.
    yaw, pitch, roll : (S,) — in the sequence that was asked for, of its two triples the one with
        the outer angles nearer to zero [rad].
    singular : (S,) — the middle angle is ±90°, where the outer two are not told apart.
    upside_down : (S,) — the body's Z axis points above the horizontal.
    quaternion_orbit, quaternion_inertial : (S, 4) — against the orbit frame and against the GCRS,
        scalar last, without jumps of sign.
    rate_orbit, rate_inertial : (S, 3) — angular velocity in body axes [rad/s].
    acceleration_orbit, acceleration_inertial : (S, 3) — rates of change of these [rad/s²].
    outcome : (S,) — 0 where it is solved, or why not, of `Pointing` or `Staring`.
    rate_exceeded, acceleration_exceeded : (S,) — the agility would not do; not where it has no
        solution.
    """

    attitude: Array
    yaw: Array
    pitch: Array
    roll: Array
    singular: Mask
    upside_down: Mask
    quaternion_orbit: Array
    quaternion_inertial: Array
    rate_orbit: Array
    rate_inertial: Array
    acceleration_orbit: Array
    acceleration_inertial: Array
    outcome: Outcomes
    rate_exceeded: Mask
    acceleration_exceeded: Mask

    @property
    def solved(self) -> Mask:
        """Where there is an attitude, (S,)."""
        found: Mask = self.outcome == 0
        return found


def profile_of(
    orbit: SmoothOrbit,
    times: Array,
    pointed: Callable[[Array], Pointed],
    *,
    target: Array,
    sequence: EulerSequence,
    outcomes: Callable[[Array], Outcomes],
    agility: Agility | None,
) -> Profile:
    """Everything about a body that is turned in a known way.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    pointed : how it is turned, by times.
    target : (3,) — what it turns to, Earth-fixed: sets the step of the accelerations [m].
    sequence : of the Euler angles.
    outcomes : (S,) 0 or why there is no solution, by attitudes (S, 3, 3).
    agility : limits; None for none.

    Returns
    -------
    Profile — the rates are those of `pointed`; the accelerations are differences of them over
    `_DIFFERENCE`, whatever the spacing of the times.
    """
    states = orbit.states(times)
    now = pointed(times)
    outcome = outcomes(now.attitude)
    mask = np.where(outcome == 0, 0.0, np.nan)[:, None]
    step = _DIFFERENCE * float(
        np.min(np.linalg.norm(target - states.position, axis=-1))
        / np.max(np.linalg.norm(states.velocity, axis=-1))
    )
    before, after = (pointed(times + shift) for shift in (-step, step))
    attitude = now.attitude + mask[..., None]
    angles = upright(euler_sequence(attitude, sequence), sequence)
    to_body = attitude @ orbit_axes(states) @ orbit.from_celestial(times)
    rate_inertial = now.rate_inertial + mask
    acceleration = (after.rate_inertial - before.rate_inertial) / (2.0 * step) + mask
    limits = agility or Agility()
    return Profile(
        attitude=attitude,
        yaw=angles.yaw,
        pitch=angles.pitch,
        roll=angles.roll,
        singular=angles.singular,
        upside_down=attitude[:, 2, 2] < 0.0,
        quaternion_orbit=continuous(quaternion(attitude)),
        quaternion_inertial=continuous(quaternion(to_body)),
        rate_orbit=now.rate_orbit + mask,
        rate_inertial=rate_inertial,
        acceleration_orbit=(after.rate_orbit - before.rate_orbit) / (2.0 * step) + mask,
        acceleration_inertial=acceleration,
        outcome=outcome,
        rate_exceeded=exceeds(rate_inertial, limits.max_rate),
        acceleration_exceeded=exceeds(acceleration, limits.max_acceleration),
    )
