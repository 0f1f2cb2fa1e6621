"""Walker constellations: circular orbits of one altitude and inclination, evenly spread."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation.constants import EARTH_EQUATORIAL_RADIUS
from formation.elements import Elements
from formation.j2 import secular_rates

from ...scene import LookSide
from ..earth import WGS84, Ellipsoid, from_geodetic

Array = NDArray[np.float64]

MAX_ALTITUDE: Final = 6_000e3
"""Up to here every pass over a target has one closest approach, see `coverage` [m]."""


class CircularRates(NamedTuple):
    """Secular rates of a circular orbit under J2 [rad/s].

    Attributes
    ----------
    argument_of_latitude : mean motion, with the drift of perigee and of the anomaly.
    node : of the right ascension of the ascending node.
    """

    argument_of_latitude: float
    node: float


def circular_rates(*, altitude: float, inclination: float) -> CircularRates:
    """Secular rates of a circular orbit of a mean altitude.

    Parameters
    ----------
    altitude : scalar — of the mean semi-major axis above the equatorial radius [m].
    inclination : scalar — mean [rad].

    Returns
    -------
    CircularRates — of mean elements, see `formation.j2`.
    """
    elements = Elements(EARTH_EQUATORIAL_RADIUS + altitude, 0.0, inclination, 0.0, 0.0, 0.0)
    rates = secular_rates(elements)
    return CircularRates(
        argument_of_latitude=float(rates.argument_of_perigee + rates.mean_anomaly),
        node=float(rates.raan),
    )


@dataclass(frozen=True, kw_only=True)
class Walker:
    """A Walker delta pattern i: T/P/F of circular orbits.

    Satellite k of plane j has its node 2πj/P east of that of plane 0 and is 2πk/S + 2πFj/T ahead
    of satellite 0 of plane 0, with S = T/P.

    Parameters
    ----------
    total : T, satellites.
    planes : P, a divisor of T.
    phasing : F, between 0 and P − 1.
    inclination : scalar, 0 to π [rad].
    altitude : scalar — of the mean semi-major axis above the equatorial radius [m].
    first_node : scalar — Earth-fixed longitude of the ascending node of plane 0 at time 0 [rad].
    first_argument : scalar — argument of latitude of satellite 0 of plane 0 at time 0 [rad].

    Raises
    ------
    ValueError
        If the numbers make no pattern.

    Notes
    -----
    All orbits drift alike under the secular J2, so the pattern keeps its shape. Short-period
    motion is left out: radially at most 10 km in low orbit, along-track as much.

    References
    ----------
    Walker (1984), Satellite constellations, J. British Interplanetary Society 37, 559–571.
    """

    total: int
    planes: int
    phasing: int
    inclination: float
    altitude: float
    first_node: float = 0.0
    first_argument: float = 0.0

    def __post_init__(self) -> None:
        _check_pattern(self.total, self.planes, self.phasing)
        _check_orbit(self.altitude, self.inclination)

    @property
    def satellites_per_plane(self) -> int:
        """S = T/P."""
        return self.total // self.planes

    @property
    def semi_major_axis(self) -> float:
        """Mean, of every orbit [m]."""
        return EARTH_EQUATORIAL_RADIUS + self.altitude

    @property
    def rates(self) -> CircularRates:
        """Secular rates of every orbit."""
        return circular_rates(altitude=self.altitude, inclination=self.inclination)

    @property
    def name(self) -> str:
        """Walker's notation, inclination in degrees."""
        degrees = math.degrees(self.inclination)
        return f"{degrees:g}°: {self.total}/{self.planes}/{self.phasing}"

    def pattern(self) -> tuple[Array, Array]:
        """Longitudes of the nodes and arguments of latitude at time 0, (T,) each [rad].

        Plane by plane: satellite k of plane j is number jS + k.
        """
        plane, slot = np.divmod(np.arange(self.total), self.satellites_per_plane)
        argument = slot / self.satellites_per_plane + plane * self.phasing / self.total
        node = plane / self.planes
        return self.first_node + 2 * np.pi * node, self.first_argument + 2 * np.pi * argument


@dataclass(frozen=True, kw_only=True)
class Visibility:
    """From where a radar can image a target: an annulus around it, or one half of it.

    Parameters
    ----------
    max_incidence : scalar — zenith angle of the satellite at the target, below π/2 [rad].
    min_incidence : scalar — a SAR cannot look at its nadir, where range does not resolve the
        ground; 0 for the papers that forget it [rad].
    side : of the orbit plane on which the target must lie; None for a satellite that can turn to
        either.

    Raises
    ------
    ValueError
        If the incidences are not in order.
    """

    max_incidence: float
    min_incidence: float = 0.0
    side: LookSide | None = None

    def __post_init__(self) -> None:
        if not 0.0 <= self.min_incidence < self.max_incidence < math.pi / 2:
            raise ValueError(
                f"min_incidence = {self.min_incidence!r} rad and max_incidence = "
                f"{self.max_incidence!r} rad must satisfy 0 ≤ min < max < π/2; give radians"
            )


def central_angle(incidence: ArrayLike, *, orbit_radius: float, target_radius: ArrayLike) -> Array:
    """Angle at the Earth's center between a target and the satellite that it sees at an incidence.

    Parameters
    ----------
    incidence : (...) — zenith angle of the satellite at the target, 0 to π/2 [rad].
    orbit_radius : scalar — of the satellite [m].
    target_radius : (...) — of the target, both from the center of the Earth [m].

    Returns
    -------
    (...) [rad].

    Notes
    -----
    The solution α of Liang (2018) eq. 14, (Rₑ + h) cos α − (Rₑ + h) sin α / tan β = Rₑ: the β of
    that equation is the zenith angle at the target. The vertical is geocentric.
    """
    angle = np.asarray(incidence, dtype=np.float64)
    look: Array = np.arcsin(np.asarray(target_radius) * np.sin(angle) / orbit_radius)
    return angle - look


def central_cosine(*, latitude: Array, theta: Array, u: Array, inclination: float) -> Array:
    """Cosine of the angle at the Earth's center between target and satellite.

    Parameters
    ----------
    latitude : (...) — geocentric, of the target [rad].
    theta : (...) — longitude of the target east of the ascending node [rad].
    u : (...) — argument of latitude of the satellite [rad].
    inclination : scalar — of the orbit [rad].
    """
    along = np.cos(latitude) * np.cos(inclination) * np.sin(theta)
    along = along + np.sin(latitude) * np.sin(inclination)
    cosine: Array = np.cos(latitude) * np.cos(theta) * np.cos(u) + along * np.sin(u)
    return cosine


def left_of_plane(*, latitude: Array, theta: Array, inclination: float) -> Array:
    """Sine of the angle by which a target is left of the orbit plane, (...); negative right.

    Parameters
    ----------
    latitude, theta, inclination : as for `central_cosine`.
    """
    lift, swing = np.cos(inclination), np.sin(inclination)
    sine: Array = np.sin(latitude) * lift - np.cos(latitude) * swing * np.sin(theta)
    return sine


def geocentric_radius(latitude: ArrayLike, *, ellipsoid: Ellipsoid = WGS84) -> Array:
    """Distance of the ellipsoid from its center at a geocentric latitude, (...) to (...) [m]."""
    a, b = ellipsoid.semi_major_axis, ellipsoid.semi_minor_axis
    angle = np.asarray(latitude, dtype=np.float64)
    radius: Array = a * b / np.hypot(b * np.cos(angle), a * np.sin(angle))
    return radius


class GroundPoints(NamedTuple):
    """Targets on the ellipsoid, in geocentric coordinates.

    Attributes
    ----------
    latitude : (...) — geocentric [rad].
    longitude : (...) [rad].
    radius : (...) — from the center of the Earth [m].
    """

    latitude: Array
    longitude: Array
    radius: Array


def ground_points(
    latitude: ArrayLike, longitude: ArrayLike, *, ellipsoid: Ellipsoid = WGS84
) -> GroundPoints:
    """Geocentric coordinates of targets on the ellipsoid.

    Parameters
    ----------
    latitude, longitude : (...) — geodetic; they broadcast [rad].
    ellipsoid : on which the targets lie.
    """
    north, east = np.broadcast_arrays(
        np.asarray(latitude, dtype=np.float64), np.asarray(longitude, dtype=np.float64)
    )
    if not np.all(np.abs(north) <= np.pi / 2):
        raise ValueError("latitude must lie between −π/2 and π/2; give radians")
    position = from_geodetic(latitude=north, longitude=east, ellipsoid=ellipsoid)
    radius: Array = np.linalg.norm(position, axis=-1)
    return GroundPoints(np.arcsin(position[..., 2] / radius), east, radius)


def annulus(
    visibility: Visibility, *, orbit_radius: float, target_radius: ArrayLike
) -> tuple[Array, Array]:
    """Inner and outer central angle of the annulus, (...) each [rad]; the inner may be 0."""
    inner, outer = (
        central_angle(incidence, orbit_radius=orbit_radius, target_radius=target_radius)
        for incidence in (visibility.min_incidence, visibility.max_incidence)
    )
    return inner, outer


def _check_pattern(total: int, planes: int, phasing: int) -> None:
    if total < 1 or planes < 1 or total % planes:
        raise ValueError(
            f"planes = {planes!r} must divide total = {total!r}: "
            "the planes of a Walker pattern hold equally many satellites"
        )
    if not 0 <= phasing < planes:
        raise ValueError(f"phasing = {phasing!r} must lie between 0 and planes − 1 = {planes - 1}")


def _check_orbit(altitude: float, inclination: float) -> None:
    """Refuse what the search for passes could not treat exactly (see `coverage`)."""
    if not 100e3 <= altitude <= MAX_ALTITUDE:
        raise ValueError(
            f"altitude = {altitude!r} m must lie between 100 km and {MAX_ALTITUDE / 1e3:.0f} km, "
            "where a pass has one closest approach; give meters above the equatorial radius"
        )
    if not 0.0 <= inclination <= math.pi:
        raise ValueError(f"inclination = {inclination!r} rad must lie within 0 and π; give radians")
