"""Scenes from orbits: what a formation's radar sees of its targets on one pass."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ...scene import LookSide
from ..boresight import Boresight, FixedIncidence
from ..earth import intersect
from ..look import look_at
from ..steering import Law
from .arc import observe_arc
from .assembly import Missed, Recording, record
from .crossings import Crossings, nearest_crossings, zero_doppler
from .observation import Observation, Reference
from .passes import (
    FAR_INCIDENCE,
    NEAR_INCIDENCE,
    Direction,
    Sightings,
    Strip,
    group_passes,
    sight,
)
from .reasons import never_seen, why_missed
from .targets import Targets
from .windows import Window, search_window

Array = NDArray[np.float64]

__all__ = ["FAR_INCIDENCE", "NEAR_INCIDENCE", "observe", "observe_arc"]


def observe(
    trajectory: Trajectory,
    targets: Targets,
    *,
    wavelength: float,
    side: LookSide,
    stop: float,
    start: float = 0.0,
    law: Law = Law.YAW_PITCH,
    boresight: Boresight | None = None,
    near_incidence: float = NEAR_INCIDENCE,
    far_incidence: float = FAR_INCIDENCE,
    reference: Reference = Reference.ZERO_DOPPLER,
    direction: Direction = Direction.EITHER,
    number: int | None = None,
    slope: float = 0.0,
) -> Observation:
    """Observe targets in strip mode, on the pass that sees most of them.

    Parameters
    ----------
    trajectory : orbit of the formation's reference point.
    targets : what is to be seen.
    wavelength : scalar — of the carrier, for the Doppler centroid [m].
    side : where the radar looks.
    start, stop : scalars — the time that is searched, since the trajectory's epoch [s]; clipped to
        the trajectory's span.
    law : how the satellite is steered.
    boresight : what the boresight holds. None aims it for the pass: at the middle of the incidences
        at which the lines of sight to the seen targets meet the ellipsoid.
    near_incidence, far_incidence : scalars — at the target, between which the strip reaches
        [rad].
    reference : moment to which the geometry is referred.
    direction : which passes count.
    number : of the pass to take, from 1 in order of time. None takes the pass that sees most
        targets, the earliest of those.
    slope : scalar — of the terrain in range, positive towards the radar [rad].

    Returns
    -------
    Observation — segments in order of time; time zero is that of the first.

    Raises
    ------
    ValueError
        If the search lies outside the trajectory's span, no target is ever seen (the message says
        why, and the remedy), there is no pass of that number, or an input is out of bounds.

    Notes
    -----
    A target is seen when the plane of the antenna's beams passes over it, on the look side, within
    the strip. Passages less than a quarter of a revolution apart, and half a revolution in
    all, are one pass.
    """
    window = search_window(trajectory, start, stop)
    strip = Strip(
        law=law,
        # Any boresight finds the passes: the plane of the beams depends on it under pitch-roll
        # steering only, and little. The moments are found again once it is aimed.
        boresight=boresight or FixedIncidence(0.5 * (near_incidence + far_incidence)),
        side=side,
        near_incidence=near_incidence,
        far_incidence=far_incidence,
    )
    found = sight(trajectory, targets.position, strip, window, direction=direction)
    passes = group_passes(found.seen, window.period)
    if not passes:
        raise ValueError(
            never_seen(trajectory, targets, found, strip=strip, direction=direction, window=window)
        )
    index = _choose(passes, number, window)
    chosen = passes[index]
    position, times = targets.position[chosen.target], chosen.time
    if boresight is None:
        strip = _aimed(trajectory, position, times, strip, window.period)
        times = nearest_crossings(trajectory, position, strip.forward, times, period=window.period)
    kept = np.isfinite(times)  # a beam that is turned towards the others may miss one at the rim
    return record(
        Recording(
            trajectory=trajectory,
            strip=strip,
            wavelength=wavelength,
            slope=slope,
            reference=reference,
            window=window,
        ),
        targets.subset(chosen.target[kept]),
        times[kept],
        passes=len(passes),
        number=index + 1,
        missed=_missed(targets, found, chosen.where(kept), strip, window.period),
    )


def _choose(passes: tuple[Crossings, ...], number: int | None, window: Window) -> int:
    """Index of the pass of a number, or of the first that sees most targets."""
    if number is None:
        return int(np.argmax([len(each.target) for each in passes]))
    if not 1 <= number <= len(passes):
        raise ValueError(
            f"number = {number!r}: the search finds {len(passes)} "
            f"pass{'' if len(passes) == 1 else 'es'}; take "
            f"{'that' if len(passes) == 1 else f'1 to {len(passes)}'}, or {window.longer}"
        )
    return number - 1


def _aimed(
    trajectory: Trajectory, position: Array, times: Array, strip: Strip, period: float
) -> Strip:
    """Strip with its boresight at the middle of the targets (S, 3) that it sees at times (S,)."""
    if strip.law is Law.PITCH_ROLL:
        # Its boresight is at zero Doppler: a target on it is seen at that moment.
        times = nearest_crossings(trajectory, position, zero_doppler, times, period=period)
    states = trajectory.earth_fixed(times)
    line = look_at(states, position).line_of_sight
    incidence = look_at(states, intersect(states.position, line)).incidence
    middle = 0.5 * (np.min(incidence) + np.max(incidence))
    return dataclasses.replace(strip, boresight=FixedIncidence(float(middle)))


def _missed(
    targets: Targets, found: Sightings, chosen: Crossings, strip: Strip, period: float
) -> Missed:
    """Targets that the chosen pass does not see, and why."""
    indices = np.setdiff1d(np.arange(len(targets)), chosen.target)
    return Missed(
        targets.latitude[indices],
        targets.longitude[indices],
        tuple(why_missed(found, int(index), chosen, strip, period) for index in indices),
    )
