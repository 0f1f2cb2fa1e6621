"""Where a study looks: points on the Earth, given one by one or sampled from an area."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..earth import from_geodetic
from .areas import read_area, sample_area

Array = NDArray[np.float64]

LOWEST, HIGHEST = -1_000.0, 10_000.0
"""Heights above the ellipsoid that land has, with a margin [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Targets:
    """Points on the Earth that a radar is to see, K of them.

    Parameters
    ----------
    latitude, longitude : (K,) — geodetic, WGS84 [rad]; longitudes are brought to −π to π.
    height : (K,) or scalar — above the ellipsoid [m].
    outlines : outer boundaries of the area that they sample, each (V, 2) of longitude, latitude,
        closed [rad].

    Raises
    ------
    ValueError
        If there is no point, the shapes differ, a latitude lies beyond a pole, a longitude beyond
        one turn, or a height where no land is.

    Examples
    --------
    >>> etna = Targets.from_points(latitude=0.65877, longitude=0.26174, height=3357.0)
    >>> len(etna), etna.position.shape
    (1, (1, 3))
    """

    latitude: Array
    longitude: Array
    height: Array
    outlines: tuple[Array, ...] = ()

    def __post_init__(self) -> None:
        count = np.atleast_1d(np.asarray(self.latitude, dtype=np.float64)).shape[0]
        if count == 0:
            raise ValueError("latitude is empty: give at least one target")
        for name in ("latitude", "longitude", "height"):
            self._store(name, (count,))
        self._check("latitude", lambda value: np.abs(value) <= math.pi / 2, "rad, −π/2 to π/2")
        self._check("longitude", lambda value: np.abs(value) <= math.tau, "rad, −2π to 2π")
        self._check(
            "height",
            lambda value: (value >= LOWEST) & (value <= HIGHEST),
            f"m above the ellipsoid, {LOWEST:.0f} to {HIGHEST:.0f}",
        )
        wrapped = np.remainder(self.longitude + math.pi, math.tau) - math.pi
        # Rounding in the remainder would move longitudes that need no wrapping.
        inside = np.abs(self.longitude) <= math.pi
        object.__setattr__(self, "longitude", np.where(inside, self.longitude, wrapped))

    def _store(self, name: str, shape: tuple[int, ...]) -> None:
        value = np.asarray(getattr(self, name), dtype=np.float64)
        try:
            stored = np.array(np.broadcast_to(value, shape))
        except ValueError as error:
            raise ValueError(
                f"{name} has shape {value.shape}; {shape[0]} latitudes need {shape}"
            ) from error
        object.__setattr__(self, name, stored)

    def _check(
        self, name: str, accepts: Callable[[Array], NDArray[np.bool_]], requirement: str
    ) -> None:
        values = getattr(self, name)
        valid = accepts(values)  # False for NaN
        if not np.all(valid):
            worst = int(np.argmin(valid))
            raise ValueError(
                f"{name} = {values[worst]} of target {worst + 1} must be finite: {requirement}"
            )

    def __len__(self) -> int:
        return len(self.latitude)

    @property
    def position(self) -> Array:
        """Earth-fixed, (K, 3) [m]."""
        return from_geodetic(latitude=self.latitude, longitude=self.longitude, height=self.height)

    def subset(self, indices: NDArray[np.intp]) -> Targets:
        """Some of the points, in the order of their indices (S,); the outlines stay."""
        return Targets(
            latitude=self.latitude[indices],
            longitude=self.longitude[indices],
            height=self.height[indices],
            outlines=self.outlines,
        )

    @classmethod
    def from_points(
        cls, *, latitude: ArrayLike, longitude: ArrayLike, height: ArrayLike = 0.0
    ) -> Targets:
        """Points given one by one.

        Parameters
        ----------
        latitude, longitude : (K,) — geodetic, WGS84 [rad].
        height : (K,) or scalar — above the ellipsoid [m].

        Raises
        ------
        ValueError
            As the class.
        """
        return cls(
            latitude=np.asarray(latitude, dtype=np.float64),
            longitude=np.asarray(longitude, dtype=np.float64),
            height=np.asarray(height, dtype=np.float64),
        )

    @classmethod
    def from_geojson(cls, text: str, *, count: int = 25, height: float = 0.0) -> Targets:
        """Points spread evenly over the polygons of a GeoJSON text.

        Parameters
        ----------
        text : a Polygon, MultiPolygon or GeometryCollection, bare or in a Feature or
            FeatureCollection; longitude, then latitude, in degrees (RFC 7946). Polygons that cross
            the date line are cut there, as the standard asks.
        count : how many points; each stands for an equal part of the area.
        height : scalar — of all points above the ellipsoid [m].

        Raises
        ------
        ValueError
            If the text is no such area or its coordinates are no longitudes and latitudes: the
            message says where and what to do.
        """
        if count < 1:
            raise ValueError(f"count = {count!r} must be at least 1")
        area = read_area(text)
        latitude, longitude = sample_area(area, count)
        outlines = tuple(np.radians(polygon.exterior.coords) for polygon in area)
        return cls(
            latitude=latitude,
            longitude=longitude,
            height=np.asarray(height, dtype=np.float64),
            outlines=outlines,
        )
