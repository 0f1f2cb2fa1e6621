"""Whether the states of an ephemeris message can be those of a satellite of the Earth."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from .constants import EARTH_GRAVITATIONAL_PARAMETER
from .trajectory import States

Array = NDArray[np.float64]

NEAREST: Final = 6.3567e6
"""Polar radius of the Earth: nearer to its center there is no satellite [m]."""

FARTHEST: Final = 4.0e8
"""Distance of the Moon: farther out nothing orbits the Earth [m]."""

_ROUNDING: Final = 100.0
"""Positions printed to 0.1 km, twice, are this inconsistent [m]."""

_SPEED: Final = 5.0
"""Half of the largest maneuver that is allowed between two lines; velocities printed to 1 m/s are
less inconsistent [m/s]."""

_OBLATENESS: Final = 3.3e-3
"""Largest part of the Earth's attraction that is not that of a sphere: 3 J2, above the poles."""

_REMAINDER: Final = 45.0 / 720.0
"""Of the corrected trapezoid: h⁵/720 times the fifth derivative of the position, which for two
bodies is r (μ/r³)^(5/2) on a circle and below 45 times that up to an eccentricity of 0.9."""

_LONGEST: Final = 0.5
"""Step beyond which the remainder says nothing any more, in √(r³/μ): 7 min in low orbit."""


def check_distances(position: Array, lines: tuple[int, ...]) -> None:
    """Refuse positions that are not about the Earth.

    Parameters
    ----------
    position : (N, 3) — from the center of the Earth [m].
    lines : number of each one's line.

    Raises
    ------
    ValueError
        If one lies inside the Earth or beyond the Moon.
    """
    distance = np.linalg.norm(position, axis=-1)
    wrong = (distance < NEAREST) | (distance > FARTHEST)
    if np.any(wrong):
        first = int(np.argmax(wrong))
        raise ValueError(
            f"OEM line {lines[first]}: the position is {distance[first] / 1e3:.6g} km from the "
            f"center of the Earth, and satellites are between {NEAREST / 1e3:.0f} and "
            f"{FARTHEST / 1e3:.0f} km; give positions in km and velocities in km/s"
        )


def check_motion(times: Array, states: States, lines: tuple[int, ...]) -> None:
    """Refuse positions to which the velocities do not lead.

    Parameters
    ----------
    times : (N,) — of the states, increasing, without a gap [s].
    states : (N, 3) each, in axes that do not turn [m, m/s].
    lines : number of each one's line.

    Raises
    ------
    ValueError
        If a position is elsewhere than the velocities take the satellite.

    Notes
    -----
    From one line to the next the satellite moves by the corrected trapezoid (Euler-Maclaurin),

        r2 − r1 = h (v1 + v2) / 2 + h² (a1 − a2) / 12 + h⁵ r⁽⁵⁾ / 720,

    with the accelerations of two bodies. What may be missing: the remainder, the flattening of the
    Earth in a1 − a2, and, far larger with ordinary steps, rounding and small maneuvers. With lines
    each minute, 0.4 km are allowed; the remainder itself is below a meter there.
    """
    missed, allowed = _missed(times, states)
    wrong = missed > allowed
    if not np.any(wrong):
        return
    if np.count_nonzero(wrong) > max(2, wrong.size // 2):
        raise ValueError(_everywhere(times, states, lines))
    first = int(np.argmax(wrong))
    # A single wrong line is wrong against both of its neighbors; before the first there is none.
    alone = first == 0 and not wrong[1:2].any()
    blamed = first if alone and wrong.size > 1 else first + 1
    raise ValueError(
        f"OEM line {lines[blamed]}: the position is {missed[first] / 1e3:.2g} km from where the "
        f"velocities of lines {lines[first]} and {lines[first + 1]} lead, and "
        f"{allowed[first] / 1e3:.1g} km are allowed; correct the line, or begin a new segment "
        "after a maneuver"
    )


def _missed(times: Array, states: States) -> tuple[Array, Array]:
    """Inconsistency of each step, and how much of it is allowed, (N − 1,) each [m]."""
    position, velocity = states
    distance = np.linalg.norm(position, axis=-1)
    acceleration = -EARTH_GRAVITATIONAL_PARAMETER * position / distance[:, None] ** 3
    h = np.diff(times)
    moved = 0.5 * h[:, None] * (velocity[1:] + velocity[:-1])
    moved -= h[:, None] ** 2 / 12.0 * np.diff(acceleration, axis=0)
    missed = np.linalg.norm(np.diff(position, axis=0) - moved, axis=-1)
    lowest = np.minimum(distance[1:], distance[:-1])
    pull = EARTH_GRAVITATIONAL_PARAMETER / lowest**2
    angle = h * np.sqrt(pull / lowest)
    allowed = (
        _ROUNDING + _SPEED * h + h**2 / 6.0 * _OBLATENESS * pull + _REMAINDER * angle**5 * lowest
    )
    return missed, np.where(angle < _LONGEST, allowed, np.inf)


def _everywhere(times: Array, states: States, lines: tuple[int, ...]) -> str:
    """Message for velocities that have nothing to do with the positions."""
    moved = np.linalg.norm(np.diff(states.position, axis=0), axis=-1) / np.diff(times)
    said = float(np.median(np.linalg.norm(states.velocity, axis=-1)))
    return (
        f"OEM line {lines[0]}: from here on the positions move at {np.median(moved) / 1e3:.4g} "
        f"km/s, but the velocities are {said / 1e3:.4g} km/s or point elsewhere; give km and km/s, "
        "the velocities as seen in REF_FRAME"
    )
