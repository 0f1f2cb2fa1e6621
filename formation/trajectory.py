"""What every orbit on the real Earth answers: where the satellite is, and when."""

from __future__ import annotations

from datetime import datetime
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class States(NamedTuple):
    """Positions and velocities in one frame.

    Attributes
    ----------
    position : (..., 3) [m].
    velocity : (..., 3) — its rate of change in that frame [m/s].
    """

    position: Array
    velocity: Array


class Trajectory(Protocol):
    """An orbit on the real Earth, whatever it was given as.

    `KeplerianOrbit`, `TwoLineOrbit` and `Ephemeris` are such; times are seconds since `epoch`.
    """

    @property
    def epoch(self) -> datetime:
        """Time zero (UTC)."""
        ...

    @property
    def span(self) -> tuple[float, float]:
        """First and last time at which the states are known [s]; infinite if there is no limit."""
        ...

    @property
    def source(self) -> str:
        """What the orbit is known from, in a few words for reports."""
        ...

    @property
    def perturbed(self) -> bool:
        """Whether the states contain the periodic terms of J2, as those of a real orbit do."""
        ...

    def inertial(self, times: ArrayLike) -> States:
        """States in the geocentric celestial reference system (GCRS).

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If a time lies outside `span`, or in a gap.
        """
        ...

    def earth_fixed(self, times: ArrayLike) -> States:
        """States in the international terrestrial reference system (ITRS), WGS84's axes.

        The velocity is the one that a ground station sees: it does not contain the Earth's
        rotation.

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If a time lies outside `span`, or in a gap.
        """
        ...
