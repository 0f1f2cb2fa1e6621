"""When a radar on an orbit sees targets: sightings, grouped into passes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States, Trajectory

from ...scene import LookSide
from ..boresight import Boresight
from ..look import look_at
from ..steering import Law, Steering, antenna_plane, steer
from ..vectors import dot
from .crossings import Crossings, Indices, Mask, find_crossings
from .windows import Window

Array = NDArray[np.float64]

NEAR_INCIDENCE = math.radians(20.0)
FAR_INCIDENCE = math.radians(55.0)
"""Incidences between which the strips of radar satellites usually reach [rad]."""


class Direction(StrEnum):
    """Which passes are wanted: northward (ascending), southward (descending), or either."""

    EITHER = "either"
    ASCENDING = "ascending"
    DESCENDING = "descending"

    def accepts(self, ascending: Mask) -> Mask:
        """Whether passes that fly northward (or not) are wanted, (...) of bool."""
        if self is Direction.EITHER:
            return np.ones_like(ascending)
        wanted: Mask = ascending == (self is Direction.ASCENDING)
        return wanted


@dataclass(frozen=True, kw_only=True)
class Strip:
    """How the beam is steered, and what it reaches.

    Parameters
    ----------
    law, boresight, side : of the steering.
    near_incidence, far_incidence : scalars — at the target, of the strip's edges [rad].

    Raises
    ------
    ValueError
        If the incidences are not in order between 0 and π/2.
    """

    law: Law
    boresight: Boresight
    side: LookSide
    near_incidence: float = NEAR_INCIDENCE
    far_incidence: float = FAR_INCIDENCE

    def __post_init__(self) -> None:
        if not 0.0 < self.near_incidence < self.far_incidence < math.pi / 2:
            raise ValueError(
                f"near_incidence = {self.near_incidence!r} rad and far_incidence = "
                f"{self.far_incidence!r} rad must be in order between 0 and π/2; give radians, "
                "the nearer edge first"
            )

    def steer(self, states: States) -> Steering:
        """Steering of Earth-fixed states (...)."""
        return steer(self.law, states, boresight=self.boresight, side=self.side)

    def forward(self, states: States) -> Array:
        """Azimuth axis of the antenna, normal to the plane of its beams, (..., 3)."""
        return self.steer(states).antenna[..., 0, :]


class Sightings(NamedTuple):
    """Passages of the beam's plane over targets in view, and what hinders an image; C of them.

    Attributes
    ----------
    target : (C,) — index.
    time : (C,) — since the trajectory's epoch, in order [s].
    incidence : (C,) — at the target [rad].
    on_side : (C,) of bool — the target is on the side that the radar looks to.
    in_reach : (C,) of bool — its incidence is within the strip.
    ascending : (C,) of bool — the satellite flies northward.
    wanted : (C,) of bool — it flies in the wanted direction.
    """

    target: Indices
    time: Array
    incidence: Array
    on_side: Mask
    in_reach: Mask
    ascending: Mask
    wanted: Mask

    @property
    def seen(self) -> Crossings:
        """Those that the radar images."""
        return Crossings(self.target, self.time).where(self.on_side & self.in_reach & self.wanted)


def sight(
    trajectory: Trajectory,
    position: Array,
    strip: Strip,
    window: Window,
    *,
    direction: Direction = Direction.EITHER,
) -> Sightings:
    """Find when the plane of the beam passes over targets.

    Parameters
    ----------
    trajectory : of the satellite.
    position : (K, 3) — of the targets, Earth-fixed [m].
    strip : steering and reach.
    window : that is searched.
    direction : that is wanted.
    """
    crossings = find_crossings(trajectory, position, strip.forward, window)
    states = trajectory.earth_fixed(crossings.time)
    visible = look_at(states, position[crossings.target]).visible
    target, time = crossings.where(visible)
    states = States(states.position[visible], states.velocity[visible])
    look = look_at(states, position[target])
    ascending = states.velocity[:, 2] > 0.0
    return Sightings(
        target=target,
        time=time,
        incidence=look.incidence,
        on_side=dot(look.line_of_sight, antenna_plane(strip.steer(states), states).aside) > 0.0,
        in_reach=(look.incidence >= strip.near_incidence) & (look.incidence <= strip.far_incidence),
        ascending=ascending,
        wanted=direction.accepts(ascending),
    )


def group_passes(crossings: Crossings, period: float) -> tuple[Crossings, ...]:
    """Group crossings into passes.

    Parameters
    ----------
    crossings : in order of time.
    period : scalar — of a revolution [s].

    Returns
    -------
    Passes in order of time: less than a quarter of a revolution from one crossing to the next,
    and half a revolution in all. A target that a pass crosses twice counts the first time.
    """
    starts: list[int] = []
    for index, time in enumerate(crossings.time):
        rests = index > 0 and time - crossings.time[index - 1] > period / 4
        if not starts or rests or time - crossings.time[starts[-1]] > period / 2:
            starts.append(index)
    if not starts:
        return ()
    members = np.split(np.arange(len(crossings.time)), starts[1:])
    return tuple(_first_of_each_target(crossings, each) for each in members)


def _first_of_each_target(crossings: Crossings, members: Indices) -> Crossings:
    _, first = np.unique(crossings.target[members], return_index=True)
    chosen = members[np.sort(first)]
    return Crossings(crossings.target[chosen], crossings.time[chosen])
