"""The Earth's figure: geodetic coordinates, verticals, and where a line of sight meets it.

Vectors are Earth-fixed (ITRS), last axis (x, y, z) [m].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import erfa
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .vectors import dot, unit

Array = NDArray[np.float64]

_HEIGHT_TOLERANCE = 1e-6
"""Height to which an intersection above the ellipsoid is found; Newton's last step leaves less."""


@dataclass(frozen=True, kw_only=True)
class Ellipsoid:
    """An ellipsoid of revolution about the Earth's axis.

    Parameters
    ----------
    semi_major_axis : scalar — equatorial radius [m].
    flattening : scalar — (a − b)/a; 0 is a sphere.

    Raises
    ------
    ValueError
        If the radius is not positive or the flattening is not in [0, 1).
    """

    semi_major_axis: float
    flattening: float

    def __post_init__(self) -> None:
        if not (self.semi_major_axis > 0.0 and math.isfinite(self.semi_major_axis)):
            raise ValueError(
                f"semi_major_axis = {self.semi_major_axis!r} m must be positive; give meters"
            )
        if not 0.0 <= self.flattening < 1.0:
            raise ValueError(
                f"flattening = {self.flattening!r} must lie in [0, 1); "
                "give f itself (1/298.257 for the Earth), not its inverse"
            )

    @property
    def semi_minor_axis(self) -> float:
        """Polar radius [m]."""
        return self.semi_major_axis * (1.0 - self.flattening)

    @property
    def squared_axes(self) -> Array:
        """(a², a², b²), (3,) [m²]."""
        return np.array([self.semi_major_axis, self.semi_major_axis, self.semi_minor_axis]) ** 2


WGS84: Final = Ellipsoid(semi_major_axis=6_378_137.0, flattening=1.0 / 298.257223563)
"""The ellipsoid of GPS, of digital elevation models and of this project's heights."""


def sphere(radius: float) -> Ellipsoid:
    """Spherical Earth of a radius [m]."""
    return Ellipsoid(semi_major_axis=radius, flattening=0.0)


class Geodetic(NamedTuple):
    """Geodetic coordinates.

    Attributes
    ----------
    latitude : (...) — of the ellipsoid's normal above the equator [rad].
    longitude : (...) — eastward, −π to π [rad].
    height : (...) — above the ellipsoid, along its normal [m].
    """

    latitude: Array
    longitude: Array
    height: Array


def to_geodetic(position: ArrayLike, *, ellipsoid: Ellipsoid = WGS84) -> Geodetic:
    """Geodetic coordinates of points.

    Parameters
    ----------
    position : (..., 3) — Earth-fixed [m].
    ellipsoid : to which they refer.

    Returns
    -------
    Geodetic — NaN for NaN.

    References
    ----------
    ERFA `gc2gde` (Fukushima 2006).
    """
    with np.errstate(invalid="ignore"):
        longitude, latitude, height = erfa.gc2gde(
            ellipsoid.semi_major_axis, ellipsoid.flattening, np.asarray(position, dtype=np.float64)
        )
    missing = 0.0 * height  # ERFA takes a point of NaN for one on the axis
    return Geodetic(latitude + missing, longitude + missing, height)


def from_geodetic(
    *,
    latitude: ArrayLike,
    longitude: ArrayLike,
    height: ArrayLike = 0.0,
    ellipsoid: Ellipsoid = WGS84,
) -> Array:
    """Points of geodetic coordinates.

    Parameters
    ----------
    latitude, longitude : (...) — geodetic [rad].
    height : (...) — above the ellipsoid [m].
    ellipsoid : to which they refer.

    Returns
    -------
    (..., 3) — Earth-fixed [m].

    Raises
    ------
    ValueError
        If a latitude lies beyond the poles, as one in degrees does.
    """
    beyond = np.abs(np.asarray(latitude, dtype=np.float64)) > np.pi / 2 + 1e-12
    if np.any(beyond):
        worst = float(np.asarray(latitude)[beyond].flat[0])
        raise ValueError(f"latitude = {worst!r} rad must lie within ±π/2; give radians")
    with np.errstate(invalid="ignore"):
        position: Array = erfa.gd2gce(
            ellipsoid.semi_major_axis, ellipsoid.flattening, longitude, latitude, height
        )
    return position


def vertical(position: ArrayLike, *, ellipsoid: Ellipsoid = WGS84) -> Array:
    """Unit vector upward, along the ellipsoid's normal, at points of any height.

    Parameters
    ----------
    position : (..., 3) — Earth-fixed [m].

    Returns
    -------
    (..., 3).
    """
    latitude, longitude, _ = to_geodetic(position, ellipsoid=ellipsoid)
    cosine = np.cos(latitude)
    return np.stack(
        [cosine * np.cos(longitude), cosine * np.sin(longitude), np.sin(latitude)], axis=-1
    )


def meets(
    position: ArrayLike, direction: ArrayLike, *, ellipsoid: Ellipsoid = WGS84
) -> NDArray[np.bool_]:
    """Whether a ray from outside meets the ellipsoid, (...) of bool; False for NaN.

    Parameters
    ----------
    position : (..., 3) — of the satellite, Earth-fixed [m].
    direction : (..., 3) — of the ray; need not be normalized.
    """
    return _quadratic(position, direction, ellipsoid.squared_axes).solvable


def intersect(
    position: ArrayLike,
    direction: ArrayLike,
    *,
    height: ArrayLike = 0.0,
    ellipsoid: Ellipsoid = WGS84,
) -> Array:
    """First point of a ray that has a given height above the ellipsoid.

    Parameters
    ----------
    position : (..., 3) — of the satellite, Earth-fixed [m].
    direction : (..., 3) — of the ray; need not be normalized.
    height : (...) — above the ellipsoid, along its normal [m]; above −b.
    ellipsoid : the Earth's figure.

    Returns
    -------
    (..., 3) — NaN where the ray misses, points away, or starts below the height.

    Notes
    -----
    Closed form on the ellipsoid itself. The surface of a constant height is no ellipsoid: Newton's
    method goes on from the one whose axes are longer by the height, which is within 2e-6 of the
    height, to below 1e-6 m. A ray that only grazes the surface within that is a miss.
    """
    start, ray, level = _broadcast(position, direction, height)
    axes = np.sqrt(ellipsoid.squared_axes) + level[..., None]
    squared = np.where(level[..., None] == 0.0, ellipsoid.squared_axes, axes**2)
    distance = _quadratic(start, ray, squared).smaller_root
    if np.any(level != 0.0):
        distance = _refine(start, ray, distance, level, ellipsoid)
    return start + distance[..., None] * ray


def _refine(
    start: Array, ray: Array, distance: Array, height: Array, ellipsoid: Ellipsoid
) -> Array:
    """Distances along the rays at which the geodetic height is exact; NaN where there is none."""
    error = np.full_like(distance, np.nan)
    for _ in range(4):
        point = start + distance[..., None] * ray
        error = to_geodetic(point, ellipsoid=ellipsoid).height - height
        with np.errstate(invalid="ignore", divide="ignore"):
            distance = distance - error / dot(vertical(point, ellipsoid=ellipsoid), ray)
    return np.where(np.abs(error) < _HEIGHT_TOLERANCE, distance, np.nan)


class _Quadratic(NamedTuple):
    """B, C and B² − AC of the equation As² + 2Bs + C = 0 for the distance s along a ray, (...)."""

    half_slope: Array
    constant: Array
    discriminant: Array

    @property
    def solvable(self) -> NDArray[np.bool_]:
        """Whether the ray comes from outside and meets the ellipsoid."""
        ahead: NDArray[np.bool_] = (self.half_slope < 0.0) & (self.constant >= 0.0)
        return ahead & (self.discriminant >= 0.0)

    @property
    def smaller_root(self) -> Array:
        """Distance to the first intersection, in the form without cancellation; NaN for none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            root = self.constant / (np.sqrt(self.discriminant) - self.half_slope)
        return np.where(self.solvable, root, np.nan)


def _quadratic(position: ArrayLike, direction: ArrayLike, squared_axes: Array) -> _Quadratic:
    start = np.asarray(position, dtype=np.float64)
    ray = np.asarray(direction, dtype=np.float64)
    scaled = ray / squared_axes
    half_slope = dot(scaled, start)
    constant = dot(start / squared_axes, start) - 1.0
    return _Quadratic(half_slope, constant, half_slope**2 - dot(scaled, ray) * constant)


def _broadcast(
    position: ArrayLike, direction: ArrayLike, height: ArrayLike
) -> tuple[Array, Array, Array]:
    start, ray = np.broadcast_arrays(
        np.asarray(position, dtype=np.float64), unit(np.asarray(direction, dtype=np.float64))
    )
    level = np.asarray(height, dtype=np.float64)
    shape = np.broadcast_shapes(start.shape[:-1], level.shape)
    return (
        np.broadcast_to(start, (*shape, 3)),
        np.broadcast_to(ray, (*shape, 3)),
        np.broadcast_to(level, shape),
    )
