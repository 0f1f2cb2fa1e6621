"""The time that is searched on an orbit."""

from __future__ import annotations

import math
from datetime import datetime, timedelta
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory, reference_orbit

Array = NDArray[np.float64]


class Window(NamedTuple):
    """Times between which an orbit is searched, since its epoch, and its mean period.

    Attributes
    ----------
    start, stop : scalars [s].
    period : scalar — of a revolution [s].
    cut : whether more was asked for, and the orbit is not known for longer.
    """

    start: float
    stop: float
    period: float
    cut: bool = False

    @property
    def longer(self) -> str:
        """Advice to search longer, as far as that can help."""
        if self.cut:
            return "take an ephemeris that reaches farther (the search was cut to its span)"
        return "search longer"

    @property
    def days(self) -> str:
        """Length in words."""
        number = f"{(self.stop - self.start) / 86_400.0:.3g}"
        return f"{number} day{'' if number == '1' else 's'}"


def search_window(trajectory: Trajectory, start: float, stop: float) -> Window:
    """Part of a time window in which the orbit is known.

    Parameters
    ----------
    trajectory : of the satellite.
    start, stop : scalars — since its epoch [s].

    Raises
    ------
    ValueError
        If the times are not in order, or there is no such part.
    """
    if not (math.isfinite(start) and math.isfinite(stop) and start < stop):
        raise ValueError(
            f"start = {start!r} s and stop = {stop!r} s must be finite and in order; "
            "give seconds since the trajectory's epoch"
        )
    first, last = max(start, trajectory.span[0]), min(stop, trajectory.span[1])
    if not first < last:
        wanted = f"{utc(trajectory, start)} to {utc(trajectory, stop)}"
        known = " to ".join(utc(trajectory, time) for time in trajectory.span)
        raise ValueError(
            f"the searched time, {wanted}, lies outside that of the orbit, {known}; "
            "move the search, or take an ephemeris that covers it"
        )
    return Window(first, last, reference_orbit(trajectory, first).period, cut=last < stop)


def window_around(
    trajectory: Trajectory, times: Array, *, period: float, revolutions: float
) -> Window:
    """Window around some times, as far as the orbit is known.

    Parameters
    ----------
    trajectory : of the satellite.
    times : (S,) — since its epoch [s].
    period : scalar — of a revolution [s].
    revolutions : scalar — margin before the first and after the last time.
    """
    margin = revolutions * period
    return Window(
        max(float(np.min(times)) - margin, trajectory.span[0]),
        min(float(np.max(times)) + margin, trajectory.span[1]),
        period,
    )


def moment(trajectory: Trajectory, time: float) -> datetime:
    """UTC of a time since the trajectory's epoch [s]."""
    return trajectory.epoch + timedelta(seconds=float(time))


def utc(trajectory: Trajectory, time: float) -> str:
    """UTC of a time since the trajectory's epoch [s], to the second, for messages."""
    if not math.isfinite(time):
        return "any time"
    return f"{moment(trajectory, time):%Y-%m-%d %H:%M:%S} UTC"
