"""Why a radar does not see a target, in words for its user."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ...scene import LookSide
from ..earth import to_geodetic
from .crossings import Crossings, Mask
from .passes import Direction, Sightings, Strip
from .targets import Targets
from .windows import Window, utc

Array = NDArray[np.float64]


def why_missed(
    sightings: Sightings, target: int, chosen: Crossings, strip: Strip, period: float
) -> str:
    """Reason for which a pass does not see a target.

    Parameters
    ----------
    sightings : around the pass.
    target : index.
    chosen : what the pass sees.
    strip : steering and reach.
    period : scalar — of a revolution [s].
    """
    away = np.abs(sightings.time - np.median(chosen.time))
    candidates = (sightings.target == target) & (away < period / 4)
    if not np.any(candidates):
        return "not in view of the beam during the pass"
    nearest = int(np.argmin(np.where(candidates, away, np.inf)))
    incidence = sightings.incidence[nearest]
    if not sightings.on_side[nearest]:
        return f"on the {_other(strip.side)} of the track, at incidence {_degrees(incidence)}"
    if incidence < strip.near_incidence:
        return (
            f"incidence {_degrees(incidence)} is below the strip's {_degrees(strip.near_incidence)}"
        )
    if incidence > strip.far_incidence:
        return (
            f"incidence {_degrees(incidence)} is above the strip's {_degrees(strip.far_incidence)}"
        )
    heading = "northward" if sightings.ascending[nearest] else "southward"
    return f"passed over while the satellite flies {heading}"


def never_seen(
    trajectory: Trajectory,
    targets: Targets,
    sightings: Sightings,
    *,
    strip: Strip,
    direction: Direction,
    window: Window,
) -> str:
    """Message for targets that no pass sees: what was searched, why in vain, and the remedy.

    Parameters
    ----------
    trajectory, targets : searched and not found.
    sightings : of the whole search.
    strip, direction, window : what was searched.
    """
    subject = "the target is not" if len(targets) == 1 else f"none of the {len(targets)} targets is"
    heading = "" if direction is Direction.EITHER else f" while {direction.value}"
    return (
        f"{subject} seen from {utc(trajectory, window.start)} to {utc(trajectory, window.stop)} "
        f"({window.days}) by a radar that looks {_name(strip.side)}{heading} at incidences of "
        f"{_degrees(strip.near_incidence)} to {_degrees(strip.far_incidence)}: "
        + (
            _nearest_miss(trajectory, targets, sightings, strip, window)
            if len(sightings.time)
            else _out_of_view(trajectory, window)
        )
    )


def _out_of_view(trajectory: Trajectory, window: Window) -> str:
    states = trajectory.earth_fixed(np.linspace(window.start, window.stop, 2000))
    reach = float(np.max(np.abs(to_geodetic(states.position).latitude)))
    return (
        "the beam never passes over a target in view; the satellite itself reaches latitudes of "
        f"±{_degrees(reach)}; {window.longer}, or change the orbit"
    )


def _nearest_miss(
    trajectory: Trajectory,
    targets: Targets,
    sightings: Sightings,
    strip: Strip,
    window: Window,
) -> str:
    """What the search came nearest to, and what would let the radar see it."""
    unwanted = sightings.in_reach & sightings.on_side
    if np.any(unwanted):
        return f"{_count(unwanted)} flown in the other direction; take either direction"
    opposite = sightings.in_reach & sightings.wanted
    if np.any(opposite):
        return f"{_count(opposite)} on the {_other(strip.side)}; look there, or {window.longer}"
    away = np.abs(sightings.incidence - (strip.near_incidence + strip.far_incidence) / 2)
    best = int(np.argmin(np.where(sightings.wanted & sightings.on_side, away, away + math.pi)))
    side = strip.side if sightings.on_side[best] else LookSide(-strip.side)
    return (
        f"the nearest miss is {_place(targets, int(sightings.target[best]))} at incidence "
        f"{_degrees(sightings.incidence[best])} on the {_name(side)}, "
        f"{utc(trajectory, sightings.time[best])}; {window.longer}, or let the strip reach farther"
    )


def _count(crossings: Mask) -> str:
    number = np.count_nonzero(crossings)
    return "the one crossing in reach is" if number == 1 else f"all {number} crossings in reach are"


def _place(targets: Targets, index: int) -> str:
    latitude, longitude = (
        math.degrees(value[index]) for value in (targets.latitude, targets.longitude)
    )
    return (
        f"target {index + 1} ({abs(latitude):.2f}°{'N' if latitude >= 0.0 else 'S'}, "
        f"{abs(longitude):.2f}°{'E' if longitude >= 0.0 else 'W'})"
    )


def _name(side: LookSide) -> str:
    return side.name.lower()


def _other(side: LookSide) -> str:
    return _name(LookSide(-side))


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.2f}°"
