"""Look geometry: a target as the satellite sees it, and where a beam plane meets the Earth.

Vectors are Earth-fixed (ITRS), last axis (x, y, z).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import States

from ..scene import LookSide
from .boresight import Boresight, FixedLook
from .earth import WGS84, Ellipsoid, intersect, vertical
from .frames import rtn_axes
from .vectors import dot, rotate, safe_arccos, unit

Array = NDArray[np.float64]

_SECANT_STEPS = 12
"""Most of `angle_at_incidence`; from 3° of incidence it needs four."""

_CONVERGED = 1e-13
"""Change of an elevation after which the next is below rounding [rad]."""


class Look(NamedTuple):
    """A target as the satellite sees it.

    Attributes
    ----------
    look_angle : (...) — of the line of sight from the geocentric nadir [rad].
    azimuth : (...) — of the line of sight about nadir, from T towards N: positive on the left of
        the orbit [rad].
    incidence : (...) — between the line of sight and the ellipsoid's normal at the target [rad].
    slant_range : (...) [m].
    line_of_sight : (..., 3) — unit vector from the satellite to the target, Earth-fixed.
    visible : (...) of bool — the target sees the satellite above its horizon.
    """

    look_angle: Array
    azimuth: Array
    incidence: Array
    slant_range: Array
    line_of_sight: Array
    visible: NDArray[np.bool_]


def look_at(states: States, target: ArrayLike, *, ellipsoid: Ellipsoid = WGS84) -> Look:
    """Look geometry of targets.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    target : (..., 3) — Earth-fixed [m]; broadcasts with the states.
    ellipsoid : to whose normal the incidence refers.

    Returns
    -------
    Look — NaN, and not visible, for a target of NaN.
    """
    point = np.asarray(target, dtype=np.float64)
    path = point - states.position
    slant_range = np.sqrt(dot(path, path))
    line = path / slant_range[..., None]
    radial, along, normal = np.moveaxis(rotate(rtn_axes(states), line), -1, 0)
    incidence = angle_between(vertical(point, ellipsoid=ellipsoid), -line)
    return Look(
        look_angle=np.arctan2(np.hypot(along, normal), -radial),
        azimuth=np.arctan2(normal, along),
        incidence=incidence,
        slant_range=slant_range,
        line_of_sight=line,
        visible=incidence < np.pi / 2,
    )


def angle_between(one: Array, other: Array) -> Array:
    """Angle between unit vectors, (..., 3) and (..., 3) to (...) [rad]; accurate at any angle."""
    difference, total = one - other, one + other
    half = np.arctan2(np.sqrt(dot(difference, difference)), np.sqrt(dot(total, total)))
    return 2.0 * half


class BeamPlane(NamedTuple):
    """The plane through the satellite in which a beam is turned in elevation.

    The direction at elevation β is cosβ `down` + sinβ `aside`.

    Attributes
    ----------
    nadir : (..., 3) — unit vector to the Earth's center.
    down : (..., 3) — unit vector of the plane nearest to nadir.
    aside : (..., 3) — horizontal unit vector of the plane, on the look side.
    """

    nadir: Array
    down: Array
    aside: Array

    def direction(self, elevation: ArrayLike) -> Array:
        """Unit vector at an elevation from `down` [rad], (...) to (..., 3)."""
        angle = np.asarray(elevation, dtype=np.float64)[..., None]
        return np.cos(angle) * self.down + np.sin(angle) * self.aside


def beam_plane(position: Array, axis: Array, *, side: LookSide) -> BeamPlane:
    """Plane of the beams perpendicular to an axis.

    Parameters
    ----------
    position : (..., 3) — of the satellite [m].
    axis : (..., 3) — forward, need not be normalized: the antenna's azimuth axis, or the
        Earth-fixed velocity for the plane of zero Doppler.
    side : where the radar looks, seen along the axis.

    Returns
    -------
    BeamPlane.
    """
    nadir = -unit(position)
    forward = unit(axis)
    down = unit(nadir - dot(nadir, forward)[..., None] * forward)
    # down × forward points right: Z × X = Y of the orbit frame.
    return BeamPlane(nadir, down, -int(side) * np.cross(down, forward))


def zero_doppler_plane(states: States, *, side: LookSide) -> BeamPlane:
    """Plane of the beams in which every target at rest on the Earth has zero Doppler.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    side : where the radar looks, seen along the Earth-fixed velocity.
    """
    return beam_plane(states.position, states.velocity, side=side)


def angle_at_look(plane: BeamPlane, look_angle: ArrayLike) -> Array:
    """Elevation in the plane at a look angle from the geocentric nadir.

    Parameters
    ----------
    plane : of the beam, (...).
    look_angle : (...) [rad].

    Returns
    -------
    (...) — from `plane.down`, towards the look side [rad]; NaN where the whole plane is farther
    from nadir than that.
    """
    # `aside` is horizontal, so the spherical triangle is right-angled: cosγ = cosβ cos(tilt).
    return safe_arccos(np.cos(look_angle) / dot(plane.down, plane.nadir))


def angle_at_incidence(
    position: Array, plane: BeamPlane, incidence: ArrayLike, *, ellipsoid: Ellipsoid = WGS84
) -> Array:
    """Elevation in the plane at which the beam meets the ellipsoid at an incidence.

    Parameters
    ----------
    position : (..., 3) — of the satellite, Earth-fixed [m].
    plane : of the beam, (...).
    incidence : (...) — to the ellipsoid's normal [rad]; from 0.5° for full accuracy.
    ellipsoid : the Earth's figure.

    Returns
    -------
    (...) — from `plane.down`, towards the look side [rad]; NaN where the incidence is not reached.

    Notes
    -----
    With M = diag(a⁻², a⁻², b⁻²) and p the point met, cos²(incidence) |Mp|² = B² − AC, the
    discriminant of the intersection, which is a quadratic form of the direction: mean +
    amplitude cos(2β − phase) at elevation β. That gives β in closed form for a known |Mp|, and |Mp|
    varies by 0.3 % over the whole Earth: the secant method on this map needs three or four steps.
    Unlike the incidence itself, its cosine squared is smooth up to the horizon.
    """
    mean, amplitude, phase, outside = _discriminant_over_elevation(position, plane, ellipsoid)
    cosine_squared = np.cos(incidence) ** 2

    def improved(angle: Array) -> Array:
        normal = _normal_at(position, plane.direction(angle), ellipsoid)
        with np.errstate(invalid="ignore"):
            ratio = (cosine_squared * dot(normal, normal) - mean) / amplitude
        return 0.5 * (phase + safe_arccos(ratio))

    angle = improved(np.zeros_like(mean))
    error = improved(angle) - angle
    step = error
    for _ in range(_SECANT_STEPS):
        if not np.any(np.abs(error) > _CONVERGED):
            break
        angle = angle + step
        last, error = error, improved(angle) - angle
        change = last - error
        step = np.where(change == 0.0, error, error * step / np.where(change == 0.0, 1.0, change))
    return np.where(
        (np.abs(error) < 10.0 * _CONVERGED) & (angle > 0.0) & (outside > 0.0), angle, np.nan
    )


def _discriminant_over_elevation(
    position: Array, plane: BeamPlane, ellipsoid: Ellipsoid
) -> tuple[Array, Array, Array, Array]:
    """Mean, amplitude and phase of B² − AC = mean + amplitude cos(2β − phase), and C."""
    scaled = position / ellipsoid.squared_axes
    outside = dot(scaled, position) - 1.0

    def form(one: Array, other: Array) -> Array:
        product = dot(scaled, one) * dot(scaled, other)
        return product - outside * dot(one / ellipsoid.squared_axes, other)

    downward, sideward = form(plane.down, plane.down), form(plane.aside, plane.aside)
    half, cross = 0.5 * (downward - sideward), form(plane.down, plane.aside)
    return 0.5 * (downward + sideward), np.hypot(half, cross), np.arctan2(cross, half), outside


def _normal_at(position: Array, direction: Array, ellipsoid: Ellipsoid) -> Array:
    """Mp, along the normal, where a ray meets the ellipsoid or, in its metric, passes nearest."""
    squared = ellipsoid.squared_axes
    scaled = direction / squared
    a, b = dot(scaled, direction), dot(scaled, position)
    c = dot(position / squared, position) - 1.0
    distance = (-b - np.sqrt(np.maximum(b**2 - a * c, 0.0))) / a
    normal: Array = (position + distance[..., None] * direction) / squared
    return normal


def aim(
    position: Array, plane: BeamPlane, boresight: Boresight, *, ellipsoid: Ellipsoid = WGS84
) -> Array:
    """Elevation in the plane of a boresight held at a look angle or an incidence.

    Parameters
    ----------
    position : (..., 3) — of the satellite, Earth-fixed [m].
    plane : of the beam, (...).
    boresight : what is held constant.
    ellipsoid : the Earth's figure.

    Returns
    -------
    (...) — from `plane.down`, towards the look side [rad]; NaN where there is none.
    """
    if isinstance(boresight, FixedLook):
        return angle_at_look(plane, boresight.angle)
    return angle_at_incidence(position, plane, boresight.angle, ellipsoid=ellipsoid)


class Swath(NamedTuple):
    """The edges of a strip on the ellipsoid, (..., 3) each, Earth-fixed [m]; NaN for none."""

    near: Array
    far: Array


def swath(
    position: Array,
    plane: BeamPlane,
    *,
    near: Boresight,
    far: Boresight,
    ellipsoid: Ellipsoid = WGS84,
) -> Swath:
    """Edges of the strip that a beam plane illuminates.

    Parameters
    ----------
    position : (..., 3) — of the satellite, Earth-fixed [m].
    plane : of the beam, (...).
    near, far : look angle or incidence of the edges.
    ellipsoid : the Earth's figure.

    Raises
    ------
    ValueError
        If both edges are given alike and the near one is not the nearer.
    """
    if type(near) is type(far) and near.angle >= far.angle:
        raise ValueError(
            f"near edge = {near.angle!r} rad must be below the far edge = {far.angle!r} rad; "
            "exchange them"
        )
    edges = (
        plane.direction(aim(position, plane, edge, ellipsoid=ellipsoid)) for edge in (near, far)
    )
    return Swath(*(intersect(position, edge, ellipsoid=ellipsoid) for edge in edges))
