"""What the boresight of the radar holds constant while the satellite moves."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class FixedLook:
    """A boresight at a constant angle from the geocentric nadir.

    Parameters
    ----------
    angle : scalar — look angle, between 0 and π/2 [rad].

    Raises
    ------
    ValueError
        If the angle is out of bounds.
    """

    angle: float

    def __post_init__(self) -> None:
        _check(self.angle, "look angle")


@dataclass(frozen=True)
class FixedIncidence:
    """A boresight that meets the ellipsoid at a constant incidence.

    Parameters
    ----------
    angle : scalar — between the line of sight and the ellipsoid's normal, 0 to π/2 [rad].

    Raises
    ------
    ValueError
        If the angle is out of bounds.
    """

    angle: float

    def __post_init__(self) -> None:
        _check(self.angle, "incidence")


Boresight = FixedLook | FixedIncidence


def _check(angle: float, name: str) -> None:
    if not 0.0 < angle < math.pi / 2:
        raise ValueError(f"{name} = {angle!r} rad must lie between 0 and π/2; give radians")
