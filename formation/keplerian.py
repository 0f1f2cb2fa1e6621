"""Orbits given as Keplerian elements at an epoch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .constants import EARTH_EQUATORIAL_RADIUS
from .derivative import states_from_positions
from .elements import Elements, mean_motion, states_from_elements
from .frames import gcrs_to_itrs, sidereal_angle, true_of_epoch_to_gcrs
from .j2 import drifted, mean_elements, osculating_states
from .timescales import DAY, as_utc, moments
from .trajectory import States

Array = NDArray[np.float64]

LOWEST_PERIGEE = 100e3
"""Height of perigee below which an orbit has decayed [m]."""


class ElementKind(StrEnum):
    """What elements describe: the orbit without its periodic terms, or the state at the epoch."""

    MEAN = "mean"
    OSCULATING = "osculating"


@dataclass(frozen=True, kw_only=True)
class KeplerianOrbit:
    """An orbit from its elements, with or without the Earth's flattening (J2).

    Parameters
    ----------
    elements : scalars, referred to the true equator and equinox of the epoch [m, rad].
    epoch : of the elements, with a time zone.
    kind : whether the elements are mean (Brouwer's, first order in J2) or osculating.
    j2 : with J2, mean elements drift secularly and states are osculating; without, the orbit is a
        fixed ellipse and the kind makes no difference.

    Raises
    ------
    ValueError
        If the orbit is no ellipse, dips below 100 km, or the epoch has no time zone.

    Notes
    -----
    Drag, other harmonics, Sun and Moon are left out. docs/orbits.md has the accuracy.
    """

    elements: Elements
    epoch: datetime
    kind: ElementKind = ElementKind.MEAN
    j2: bool = True

    def __post_init__(self) -> None:
        _check(self.elements)
        object.__setattr__(self, "epoch", as_utc(self.epoch))

    @classmethod
    def circular(
        cls,
        *,
        altitude: float,
        inclination: float,
        epoch: datetime,
        raan: float = 0.0,
        argument_of_latitude: float = 0.0,
        j2: bool = True,
    ) -> KeplerianOrbit:
        """Build a circular orbit from its mean altitude above the equatorial radius.

        Parameters
        ----------
        altitude : scalar — mean semi-major axis less 6378.137 km [m].
        inclination : scalar [rad].
        epoch : with a time zone.
        raan : scalar — right ascension of the ascending node [rad].
        argument_of_latitude : scalar — at the epoch, from the ascending node [rad].
        j2 : whether the Earth is flattened.
        """
        axis = EARTH_EQUATORIAL_RADIUS + altitude
        elements = Elements(axis, 0.0, inclination, raan, 0.0, argument_of_latitude)
        return cls(elements=elements, epoch=epoch, j2=j2)

    @property
    def span(self) -> tuple[float, float]:
        """No limit."""
        return -math.inf, math.inf

    @property
    def source(self) -> str:
        """Kind of the elements, and the forces."""
        return f"{self.kind.value} elements{' with J2' if self.j2 else ', two bodies'}"

    @cached_property
    def mean(self) -> Elements:
        """Mean elements at the epoch; the elements themselves without J2."""
        if self.kind is ElementKind.MEAN or not self.j2:
            return self.elements
        return mean_elements(states_from_elements(self.elements))

    @cached_property
    def axes(self) -> Array:
        """(3, 3) — turn from the true equator and equinox of the epoch into the GCRS."""
        return true_of_epoch_to_gcrs(self.epoch)

    @property
    def perturbed(self) -> bool:
        """With J2, but not without."""
        return self.j2

    def inertial(self, times: ArrayLike) -> States:
        """States in the GCRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].
        """
        time = np.asarray(times, dtype=np.float64)
        if self.j2:
            states = states_from_positions(
                lambda t: osculating_states(drifted(self.mean, t)).position, time
            )
        else:
            anomaly = self.elements.mean_anomaly + mean_motion(self.elements.semi_major_axis) * time
            states = states_from_elements(self.elements._replace(mean_anomaly=anomaly))
        return States(states.position @ self.axes.T, states.velocity @ self.axes.T)

    def earth_fixed(self, times: ArrayLike) -> States:
        """States in the ITRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].
        """
        return gcrs_to_itrs(moments(self.epoch, times)).apply(self.inertial(times))


def raan_from_longitude(longitude: float, *, epoch: datetime) -> float:
    """Right ascension of a node from its longitude on the Earth.

    Parameters
    ----------
    longitude : scalar — of the ascending node at the epoch, east positive [rad].
    epoch : with a time zone.

    Returns
    -------
    scalar — in the true equator and equinox of the epoch, 0 to 2π [rad].
    """
    return (longitude + sidereal_angle(epoch)) % (2.0 * math.pi)


def raan_from_local_time(local_time: float, *, epoch: datetime) -> float:
    """Right ascension of a node from its local mean solar time.

    Parameters
    ----------
    local_time : scalar — of the ascending node at the epoch, since midnight [s].
    epoch : with a time zone.

    Returns
    -------
    scalar — in the true equator and equinox of the epoch, 0 to 2π [rad].
    """
    utc = as_utc(epoch)
    since_midnight = utc - utc.replace(hour=0, minute=0, second=0, microsecond=0)
    longitude = 2.0 * math.pi * (local_time - since_midnight.total_seconds()) / DAY
    return raan_from_longitude(longitude, epoch=epoch)


def _check(elements: Elements) -> None:
    for name, value in elements._asdict().items():
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value!r} must be a finite number")
    axis, e = float(elements.semi_major_axis), float(elements.eccentricity)
    if not 0.0 <= e < 1.0:
        raise ValueError(
            f"eccentricity = {e!r} must be 0 or more and below 1: a satellite that observes the "
            "Earth repeatedly is on an ellipse"
        )
    if not 0.0 <= elements.inclination <= math.pi:
        raise ValueError(
            f"inclination = {elements.inclination!r} rad must lie within 0 and π; give radians"
        )
    perigee = axis * (1.0 - e) - EARTH_EQUATORIAL_RADIUS
    if perigee < LOWEST_PERIGEE:
        raise ValueError(
            f"semi_major_axis = {axis:.0f} m with eccentricity = {e:g} puts perigee at a height of "
            f"{perigee / 1e3:.1f} km, below {LOWEST_PERIGEE / 1e3:.0f} km, where the orbit decays; "
            "raise the semi-major axis (meters from the center of the Earth) or lower the "
            "eccentricity"
        )
