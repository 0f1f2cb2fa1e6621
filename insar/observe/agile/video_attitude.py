"""Attitude of a body that stares at a point, and the turn about the line of sight.

The beam is along the body's Z. Roll and pitch point it; a yaw law settles the rest by a direction
that the body's X axis keeps about the line of sight.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..earth import vertical
from ..frames import orbit_axes
from ..look import look_at
from ..vectors import rotate, unit
from .agility import Agility
from .profiles import Outcomes, Pointed, Profile, profile_of
from .rotations import EulerSequence
from .smooth_orbit import SmoothOrbit
from .turning import inertial_rate, moving_shortest_turn, orbit_frame
from .video_request import YawLaw
from .video_results import Staring
from .video_yaw import X_DIRECTIONS, Beam, Held, ground_map, major_axis, sight_of

Array = NDArray[np.float64]

_Z_AXIS: Final = np.array([0.0, 0.0, 1.0])


def hold(law: YawLaw, orbit: SmoothOrbit, time: float, target: Array, beam: Beam) -> Held:
    """Take the direction that a law holds from the footprint at a moment, with zero yaw.

    Parameters
    ----------
    law : which.
    orbit : of the satellite.
    time : scalar — of reference, since the trajectory's epoch [s].
    target : (3,) — aim point, Earth-fixed [m].
    beam : half widths.
    """
    up = vertical(target)
    states = orbit.states(np.array([time]))
    free = Held(YawLaw.NONE, target, up, np.full(3, np.nan), beam)
    body = (stare(orbit, np.array([time]), free).attitude @ orbit_axes(states))[0]
    ground = ground_map(body, target - states.position[0], up)
    if law in (YawLaw.NONE, YawLaw.SHORTEST_ROTATION):
        return free._replace(law=law)
    if law is YawLaw.AZIMUTH_TRACE:
        return free._replace(law=law, direction=unit(ground[:, 0]))
    if law is YawLaw.RANGE_TRACE:
        return free._replace(law=law, direction=unit(ground[:, 1]))
    return _nearest_branch(
        free._replace(law=law, direction=major_axis(ground, beam)), orbit, time, body
    )


def stare(orbit: SmoothOrbit, times: Array, held: Held) -> Pointed:
    """Attitude that points the body's Z at the target, and its rates.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    held : yaw law, target, and what is held.

    Returns
    -------
    Pointed — NaN where the law leaves the turn about the line of sight open.

    Notes
    -----
    Z is the line of sight û. X keeps the direction, about û, of a vector w ⊥ û: of the held
    direction less its part along û, or of the orbit frame's X for zero yaw. The body then turns by
    û×û̇ + û[û·(w×ẇ)]/|w|², with no Euler angle in it and no singularity at a pitch of ±90°.

    Liang's eqs (8)-(13) with these corrections give the same: the vector to the target is
    normalized, with |r_s(t)| for R_e + h; the ground vector of eq. (12) is turned by roll and pitch
    before the yaw is taken from it.
    """
    states = orbit.states(times)
    frame = orbit_frame(states, orbit.acceleration(times))
    sight = sight_of(states, frame, held.target)
    if held.law is YawLaw.SHORTEST_ROTATION:
        turn = moving_shortest_turn(_Z_AXIS, np.zeros(3), sight.path, sight.path_rate)
        attitude, rate = turn.attitude, turn.rate
    else:
        forward, spin = X_DIRECTIONS[held.law](sight, held)
        line = sight.line
        attitude = np.stack([forward, np.cross(line, forward), line], axis=-2)
        turning = np.cross(line, sight.line_rate) + spin[:, None] * line
        rate = rotate(attitude, turning)
        attitude = attitude + 0.0 * spin[:, None, None]  # rows of one sample are all NaN or none
    return Pointed(attitude, rate, inertial_rate(attitude, rate, frame.rate))


def staring_profile(
    orbit: SmoothOrbit, times: Array, held: Held, *, agility: Agility | None = None
) -> Profile:
    """Attitude, angles, rates and accelerations while the body stares.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    held : yaw law, target, and what is held.
    agility : limits; None for none.

    Returns
    -------
    Profile — angles in the sequence 1-2-3; the rates are closed forms.
    """
    visible = look_at(orbit.states(times), held.target).visible
    return profile_of(
        orbit,
        times,
        lambda moments: stare(orbit, moments, held),
        target=held.target,
        sequence=EulerSequence.ONE_TWO_THREE,
        outcomes=lambda attitude: _staring(visible, attitude, held.law),
        agility=agility,
    )


def _nearest_branch(held: Held, orbit: SmoothOrbit, time: float, body: Array) -> Held:
    """Choose, of the four turns that lay the major axis in place, the one with zero yaw."""
    signs = (1.0, -1.0)
    candidates = [held._replace(branch=(side, sign)) for side in signs for sign in signs]
    axes = orbit_axes(orbit.states(np.array([time])))
    alignments = [
        float((stare(orbit, np.array([time]), each).attitude @ axes)[0, 0] @ body[0])
        for each in candidates
    ]
    if not np.any(np.isfinite(alignments)):
        return held
    return candidates[int(np.nanargmax(alignments))]


def _staring(visible: NDArray[np.bool_], attitude: Array, law: YawLaw) -> Outcomes:
    """Reasons, (S,)."""
    why = Staring.AXIS_LOST if law is YawLaw.MAJOR_AXIS else Staring.UNDEFINED
    solved = np.isfinite(np.sum(attitude, axis=(-1, -2)))
    return np.where(visible, np.where(solved, Staring.SOLVED, why), Staring.BELOW_HORIZON)
