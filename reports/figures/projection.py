"""Maps of parts of the Earth: two azimuthal projections, and the outline of the land in them."""

from __future__ import annotations

from functools import cache
from importlib import resources
from typing import NamedTuple

import numpy as np
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

EARTH_RADIUS_KM = 6371.0
"""Mean radius: a map needs no ellipsoid, which would change distances by up to 0.3 %."""

_AZIMUTH_STEP = np.radians(5.0)
"""Rings that pass the antipode of a map's center, where azimuths turn fast, are refined to it."""


class Azimuthal(NamedTuple):
    """Azimuthal projection about a center, north up: every distance from the center is true.

    Attributes
    ----------
    longitude, latitude : scalars — of the center [rad].
    globe : whether it is the view from far away (orthographic) instead; what lies behind the
        horizon falls on it.
    """

    longitude: float
    latitude: float
    globe: bool = False

    def polar(self, longitude: ArrayLike, latitude: ArrayLike) -> tuple[Array, Array]:
        """Angular distance from the center and azimuth from north, clockwise, of points [rad]."""
        east = np.asarray(longitude) - self.longitude
        lat = np.asarray(latitude)
        x = np.cos(lat) * np.sin(east)
        y = np.cos(self.latitude) * np.sin(lat) - np.sin(self.latitude) * np.cos(lat) * np.cos(east)
        z = np.sin(self.latitude) * np.sin(lat) + np.cos(self.latitude) * np.cos(lat) * np.cos(east)
        return np.arctan2(np.hypot(x, y), z), np.arctan2(x, y)

    def plane(self, distance: Array, azimuth: Array) -> Array:
        """Points of the map (..., 2) [km]."""
        if self.globe:
            distance = np.sin(np.minimum(distance, np.pi / 2))
        east, north = distance * np.sin(azimuth), distance * np.cos(azimuth)
        return EARTH_RADIUS_KM * np.stack([east, north], axis=-1)

    def __call__(self, longitude: ArrayLike, latitude: ArrayLike) -> Array:
        """Points of the map (..., 2) of geodetic points [rad → km]."""
        return self.plane(*self.polar(longitude, latitude))

    @property
    def rim(self) -> float:
        """Radius of the whole map [km]."""
        return EARTH_RADIUS_KM * (1.0 if self.globe else np.pi)


def center_of(longitude: Array, latitude: Array) -> tuple[float, float]:
    """Longitude and latitude of the middle of points, also over the date line and a pole [rad]."""
    x, y, z = (
        float(np.mean(axis))
        for axis in (
            np.cos(latitude) * np.cos(longitude),
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
        )
    )
    return float(np.arctan2(y, x)), float(np.arctan2(z, np.hypot(x, y)))


class Land(NamedTuple):
    """The land, and the inland water that is drawn over it: rings (V, 2) of lon and lat [rad]."""

    land: tuple[Array, ...]
    water: tuple[Array, ...]


@cache
def land_outline() -> Land:
    """Land of Natural Earth, 1:50 million; `data/README.md` describes the file."""
    file = resources.files(__package__).joinpath("data", "land.npz")
    with file.open("rb") as stream, np.load(stream) as data:
        lengths, steps, is_water = (data[name] for name in ("lengths", "steps", "water"))
    # The sums are right modulo 2¹⁶, whatever steps cross the date line.
    points = np.cumsum(steps, axis=0, dtype=np.int16).astype(np.float64)
    rings = np.split(np.radians(points / 100.0), np.cumsum(lengths)[:-1])
    return Land(
        tuple(ring for ring, water in zip(rings, is_water, strict=True) if not water),
        tuple(ring for ring, water in zip(rings, is_water, strict=True) if water),
    )


def filled_path(rings: tuple[Array, ...], projection: Azimuthal, *, reach: float) -> Path:
    """Path that fills the rings on a map.

    Parameters
    ----------
    rings : each (V, 2) of longitude and latitude, closed, its area at its left [rad].
    projection : of the map.
    reach : angular distance from the center beyond which a ring need not be drawn [rad].
    """
    paths: list[Path] = []
    for ring in rings:
        distance, azimuth = projection.polar(*ring.T)
        around = abs(np.unwrap(azimuth)[-1] - azimuth[0]) > np.pi
        if distance.min() > reach and not around:
            continue
        paths.append(Path(projection.plane(*_refined(distance, azimuth)), closed=True))
        if _signed_area(distance, azimuth) < 0.0:
            # The antipode is inside: the area is what lies between the ring and the rim.
            paths.append(Path.circle((0.0, 0.0), 1.01 * projection.rim))
    if not paths:
        return Path(np.zeros((0, 2)))
    return Path.make_compound_path(*paths)


def _refined(distance: Array, azimuth: Array) -> tuple[Array, Array]:
    """Points added where the azimuth turns fast beyond 90° from the center.

    Otherwise a chord of the back side would cross the front of the map.
    """
    azimuth = np.unwrap(azimuth)
    turn = np.abs(np.diff(azimuth))
    is_far = (distance[:-1] > np.pi / 2) & (distance[1:] > np.pi / 2)
    pieces = np.where(is_far, np.ceil(turn / _AZIMUTH_STEP), 1.0).clip(1.0).astype(int)
    at = np.arange(len(distance), dtype=np.float64)
    stops = np.concatenate([[0.0], np.cumsum(pieces)])
    wanted = np.interp(np.arange(stops[-1] + 1.0), stops, at)
    return np.interp(wanted, at, distance), np.interp(wanted, at, azimuth)


def _signed_area(distance: Array, azimuth: Array) -> float:
    x, y = distance * np.sin(azimuth), distance * np.cos(azimuth)
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
