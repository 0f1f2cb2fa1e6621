"""When to choose which steering law: yaw-pitch and pitch-roll over altitude and inclination."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from formation import States
from formation.constants import EARTH_EQUATORIAL_RADIUS
from formation.elements import Elements, mean_motion, states_from_elements

from ...scene import LookSide
from ..boresight import Boresight, FixedIncidence, FixedLook
from ..doppler import pointing_sensitivity
from ..frames import rotation_velocity
from ..steering import Law, Steering, steer
from .assess import swath_doppler
from .results import Held, Selection

Array = NDArray[np.float64]

LAWS = (Law.YAW_PITCH, Law.PITCH_ROLL)
"""The two laws with zero residual Doppler, between which a designer chooses."""

_ALTITUDE_TOLERANCE = 1.0
"""Of a crossover [m]; its sampling over the orbit leaves up to 0.3 km."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SelectionRequest:
    """Orbits and boresight on which yaw-pitch and pitch-roll steering are compared.

    Parameters
    ----------
    altitudes : (A,) — of the semi-major axis above the equatorial radius, increasing [m].
    inclinations : (I,) [rad].
    held : what is the same for all orbits.
    boresight_angle : scalar — the look angle or incidence held [rad].
    slew_rate : scalar — rate limit of the slew times [rad/s].
    swath_offset : scalar — elevation off the boresight of the swath Doppler, both ways [rad].
    wavelength : scalar [m].
    side : where the radar looks.
    eccentricity, argument_of_perigee : scalars, of all orbits [1, rad].
    samples : of one revolution, evenly in time.

    Raises
    ------
    ValueError
        If the altitudes do not increase, an orbit dips below the equatorial radius, or a rate, an
        offset, a wavelength or the number of samples is not positive.
    """

    altitudes: Array
    inclinations: Array
    held: Held
    boresight_angle: float
    slew_rate: float
    swath_offset: float
    wavelength: float
    side: LookSide = LookSide.RIGHT
    eccentricity: float = 0.0
    argument_of_perigee: float = 0.0
    samples: int = 361

    def __post_init__(self) -> None:
        for name in ("altitudes", "inclinations"):
            values = np.atleast_1d(np.asarray(getattr(self, name), dtype=np.float64))
            object.__setattr__(self, name, values)
        self._check()

    @property
    def boresight(self) -> Boresight:
        """What is held constant along each orbit."""
        kind = FixedLook if self.held is Held.LOOK else FixedIncidence
        return kind(self.boresight_angle)

    def _check(self) -> None:
        _ = self.boresight  # checks its angle
        if not np.all(np.diff(self.altitudes) > 0.0):
            raise ValueError("altitudes must increase; sort them and leave out repeated ones")
        if not 0.0 <= self.eccentricity < 1.0:
            raise ValueError(f"eccentricity = {self.eccentricity!r} must lie in [0, 1)")
        perigee = _semi_major_axis(self.altitudes[0]) * (1.0 - self.eccentricity)
        if not perigee > EARTH_EQUATORIAL_RADIUS:
            raise ValueError(
                f"altitudes[0] = {self.altitudes[0]:.0f} m with eccentricity = "
                f"{self.eccentricity!r} puts perigee inside the Earth; raise the altitude"
            )
        for name in ("slew_rate", "swath_offset", "wavelength"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name)!r} must be positive")
        if self.samples < 8:
            raise ValueError(f"samples = {self.samples!r} must be 8 or more; 361 resolve an orbit")


def select(request: SelectionRequest) -> Selection:
    """Compare yaw-pitch and pitch-roll steering over altitude and inclination.

    Parameters
    ----------
    request : orbits, what the boresight holds, and the limits that the comparison needs.

    Returns
    -------
    Selection — NaN where a law has no solution all around the orbit.

    Notes
    -----
    Two-body orbits on the WGS84 ellipsoid: J2 moves the angles by less than 0.1°. The longitude
    of the node does not matter. Zhao 2019 compares the sum of the two angles (its fig. 6); the slew
    time goes by the larger of the two, as in its table 2, since both can turn at once.
    """
    orbits = _orbits(request, request.inclinations, request.altitudes)
    by_law = [_extremes(law, orbits, request) for law in LAWS]
    angle, slew, rate, sensitivity, swath = (np.stack(pair) for pair in zip(*by_law, strict=True))
    return Selection(
        altitudes=request.altitudes,
        inclinations=request.inclinations,
        eccentricity=request.eccentricity,
        argument_of_perigee=request.argument_of_perigee,
        held=request.held,
        boresight_angle=request.boresight_angle,
        slew_rate=request.slew_rate,
        swath_offset=request.swath_offset,
        laws=LAWS,
        steering_angle=angle,
        slew_time=slew / request.slew_rate,
        rate=rate,
        pointing_sensitivity=sensitivity,
        swath_doppler=swath,
        crossovers=tuple(
            _crossovers(request, float(inclination), angle[0, row] - angle[1, row])
            for row, inclination in enumerate(request.inclinations)
        ),
    )


class _Orbits(NamedTuple):
    """One revolution of each orbit: Earth-fixed states (I, A, S, 3), and time step (A, 1) [s]."""

    states: States
    step: Array


class _Extremes(NamedTuple):
    """Largest values of one law over a revolution, (I, A) each."""

    steering_angle: Array
    single_angle: Array
    rate: Array
    pointing_sensitivity: Array
    swath_doppler: Array


def _orbits(request: SelectionRequest, inclinations: Array, altitudes: Array) -> _Orbits:
    """Sample the orbits evenly in time, the last sample a step before the first."""
    axis = _semi_major_axis(altitudes)[:, None]
    anomaly = 2.0 * np.pi * np.arange(request.samples) / request.samples
    inertial = states_from_elements(
        Elements(
            semi_major_axis=axis,
            eccentricity=np.asarray(request.eccentricity),
            inclination=inclinations[:, None, None],
            raan=np.zeros(()),
            argument_of_perigee=np.asarray(request.argument_of_perigee),
            mean_anomaly=anomaly,
        )
    )
    velocity = inertial.velocity - rotation_velocity(inertial.position)
    step = 2.0 * np.pi / request.samples / mean_motion(axis)
    return _Orbits(States(inertial.position, velocity), step)


def _extremes(law: Law, orbits: _Orbits, request: SelectionRequest) -> _Extremes:
    states = orbits.states
    steering = _steer(law, orbits, request)
    angles = np.stack([steering.yaw, steering.pitch, steering.roll])
    offsets = request.swath_offset * np.array([-1.0, 1.0])
    swath = swath_doppler(states, steering, offsets, wavelength=request.wavelength)
    sensitivity = pointing_sensitivity(states, steering.boresight, wavelength=request.wavelength)
    return _Extremes(
        steering_angle=_total(angles),
        single_angle=np.abs(angles).max(axis=(0, -1)),
        rate=np.abs(_rate(angles, orbits.step)).max(axis=(0, -1)),
        pointing_sensitivity=sensitivity.max(axis=-1),
        swath_doppler=np.abs(swath).max(axis=(-2, -1)),
    )


def _steer(law: Law, orbits: _Orbits, request: SelectionRequest) -> Steering:
    return steer(law, orbits.states, boresight=request.boresight, side=request.side)


def _total(angles: Array) -> Array:
    """Largest sum of the steered angles over a revolution; yaw, pitch and roll first."""
    total: Array = np.abs(angles).sum(axis=0).max(axis=-1)
    return total


def _rate(angles: Array, step: Array) -> Array:
    """Rates of angles sampled evenly around a revolution, (..., S) [rad/s].

    Fourth-order differences: 2e-5 of the largest rate at 361 samples; between them a sharp peak may
    be 0.1 % higher. An angle may jump by 2π.
    """

    def change(samples: int) -> Array:
        difference = np.roll(angles, -samples, axis=-1) - np.roll(angles, samples, axis=-1)
        turn: Array = np.remainder(difference + np.pi, 2.0 * np.pi) - np.pi
        return turn

    rate: Array = (8.0 * change(1) - change(2)) / (12.0 * step)
    return rate


def _crossovers(request: SelectionRequest, inclination: float, excess: Array) -> tuple[float, ...]:
    """Altitudes where the two laws steer the same total angle, from below.

    Parameters
    ----------
    request : as for `select`.
    inclination : of the orbits [rad].
    excess : (A,) — steering angle of yaw-pitch over that of pitch-roll [rad].
    """

    def difference(altitude: float) -> float:
        orbit = _orbits(request, np.array([inclination]), np.array([altitude]))
        one, other = (
            _total(np.stack([found.yaw, found.pitch, found.roll]))
            for found in (_steer(law, orbit, request) for law in LAWS)
        )
        return float((one - other).item())

    return tuple(
        float(
            brentq(
                difference,
                request.altitudes[below],
                request.altitudes[below + 1],
                xtol=_ALTITUDE_TOLERANCE,
            )
        )
        for below in np.flatnonzero(excess[:-1] * excess[1:] < 0.0)
    )


def _semi_major_axis(altitude: Array) -> Array:
    axis: Array = EARTH_EQUATORIAL_RADIUS + altitude
    return axis
