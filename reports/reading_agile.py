"""What the reports of spotlight and video read out of a result before they word or draw it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar.observe.agile.agility import Agility
from insar.observe.agile.plans import PassPlan
from insar.observe.agile.profiles import Profile
from insar.observe.agile.spotlight_results import (
    SpotlightRequest,
    SpotlightResult,
)
from insar.observe.agile.staring import StaringScene
from insar.observe.agile.video_footprint import horizontal_axes
from insar.observe.agile.video_request import VideoRequest
from insar.observe.agile.video_results import VideoResult
from insar.observe.earth import from_geodetic, to_geodetic, vertical
from insar.observe.vectors import dot, unit

from .tables_steering import largest, rate_of

Array = NDArray[np.float64]

AIM_ROUNDING = 1e-7
"""Aim error that is the rounding of the arithmetic: positions of 10⁷ m carry 10⁻⁹ m [m]."""

_AROUND = 300.0
"""Flown before and after, of which a map shows what fits [s]."""

_POINTS = 401


class Passage(NamedTuple):
    """The flight past a place: N moments, of which some belong to the imaging.

    Attributes
    ----------
    latitude, longitude : scalars — of the place [rad].
    times : (N,) — since zero Doppler [s].
    track_latitude, track_longitude : (N,) — of the point below the satellite [rad].
    azimuth, zenith_angle : (N,) — where the satellite stands in the sky of the place, from north
        clockwise and from the vertical [rad].
    start, stop : scalars — of the imaging, since zero Doppler [s].
    """

    latitude: float
    longitude: float
    times: Array
    track_latitude: Array
    track_longitude: Array
    azimuth: Array
    zenith_angle: Array
    start: float
    stop: float

    @property
    def imaging(self) -> NDArray[np.bool_]:
        """Moments of the imaging, (N,)."""
        found: NDArray[np.bool_] = (self.times >= self.start) & (self.times <= self.stop)
        return found


def passage_of(result: SpotlightResult | VideoResult) -> Passage:
    """The flight past the aim point, some minutes longer than the imaging where it is known."""
    return _around(result.plan, result.request, float(result.times[0]), float(result.times[-1]))


def passage_of_scene(staring: StaringScene) -> Passage:
    """The flight past the place that a formation watches, some minutes longer than it does."""
    half = 0.5 * staring.duration
    return _around(staring.plan, staring.request, -half, half)


def _around(
    plan: PassPlan, request: SpotlightRequest | VideoRequest, start: float, stop: float
) -> Passage:
    first, last = (end - plan.time for end in request.trajectory.span)
    during = np.linspace(start, stop, _POINTS)
    before = np.linspace(max(start - _AROUND, first), start, _POINTS)[:-1]
    after = np.linspace(stop, min(stop + _AROUND, last), _POINTS)[1:]
    try:
        return _passage(plan, request, np.concatenate([before, during, after]), start, stop)
    except ValueError:  # an ephemeris has a gap before or after
        return _passage(plan, request, during, start, stop)


def _passage(
    plan: PassPlan,
    request: SpotlightRequest | VideoRequest,
    times: Array,
    start: float,
    stop: float,
) -> Passage:
    position = request.trajectory.earth_fixed(plan.time + times).position
    below = to_geodetic(position)
    target = from_geodetic(
        latitude=request.latitude, longitude=request.longitude, height=request.height
    )
    line = unit(position - target)
    east, north = (dot(line, axis) for axis in horizontal_axes(target))
    return Passage(
        latitude=request.latitude,
        longitude=request.longitude,
        times=times,
        track_latitude=below.latitude,
        track_longitude=below.longitude,
        azimuth=np.arctan2(east, north),
        zenith_angle=np.arctan2(np.hypot(east, north), dot(line, vertical(target))),
        start=start,
        stop=stop,
    )


class Demand(NamedTuple):
    """The largest rate or acceleration against inertial space, and what is allowed.

    Attributes
    ----------
    largest : scalar — magnitude [rad/s or rad/s²].
    share : scalar — of the limit that is used, of the axis that uses the most; NaN without a limit.
    """

    largest: float
    share: float


def demand(vectors: Array, limit: float | tuple[float, float, float] | None) -> Demand:
    """What an imaging asks of the actuators.

    Parameters
    ----------
    vectors : (S, 3) — against inertial space, in body axes.
    limit : on the magnitude or on each axis; None for none.
    """
    magnitude = largest(rate_of(vectors))
    if limit is None or np.all(np.isinf(limit)):
        return Demand(magnitude, np.nan)
    if isinstance(limit, tuple):
        return Demand(magnitude, largest(vectors / np.array(limit)))
    return Demand(magnitude, magnitude / limit)


def demands(profile: Profile, agility: Agility | None) -> tuple[Demand, Demand]:
    """Rate and acceleration."""
    return (
        demand(profile.rate_inertial, None if agility is None else agility.max_rate),
        demand(
            profile.acceleration_inertial, None if agility is None else agility.max_acceleration
        ),
    )


def exceeds(profile: Profile) -> bool:
    """Whether the agility does not do at some sample."""
    return bool(np.any(profile.rate_exceeded | profile.acceleration_exceeded))


def is_limited(agility: Agility | None) -> bool:
    """Whether the study limits rate or acceleration at all."""
    return agility is not None and agility.limited


def path_length(latitude: Array, longitude: Array, radius: float = 6371e3) -> float:
    """Way along points on the ground that are known [m]."""
    known = np.isfinite(latitude)
    lat, lon = latitude[known], longitude[known]
    north = np.diff(lat)
    east = np.diff(np.unwrap(lon)) * np.cos(0.5 * (lat[1:] + lat[:-1]))
    return float(radius * np.hypot(north, east).sum())
