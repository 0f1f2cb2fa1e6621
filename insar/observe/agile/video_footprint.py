"""The footprint of a staring beam: how it turns and shears, its outlines, and pointing errors."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import shapely
from numpy.typing import NDArray

from formation import States

from ..earth import intersect, to_geodetic, vertical
from ..frames import orbit_axes
from ..vectors import dot, rotate, unit
from .video_results import Distortion, Footprints, PointingEffect
from .video_yaw import Beam, ground_map

Array = NDArray[np.float64]

VERTICES: Final = 72
"""Corners of an outline: an inscribed polygon has 0.13 % less than the area of its ellipse."""


def horizontal_axes(target: Array) -> Array:
    """East and north at a point, (3,) Earth-fixed to (2, 3)."""
    up = vertical(target)
    east = unit(np.array([-up[1], up[0], 0.0])) if abs(up[2]) < 1.0 else np.array([0.0, 1.0, 0.0])
    return np.stack([east, np.cross(up, east)])


def footprint_map(states: States, attitude: Array, target: Array) -> Array:
    """Footprint to first order: (..., 2, 2) from angles towards X and Y to east and north [m/rad].

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    attitude : (..., 3, 3) — orbit frame to body, Z towards the target.
    target : (3,) — Earth-fixed [m].
    """
    body = attitude @ orbit_axes(states)
    ground = ground_map(body, target - states.position, vertical(target))
    level: Array = horizontal_axes(target) @ ground
    return level


def distortion(ground: Array, reference: Array, beam: Beam) -> Distortion:
    """How footprints differ from one of reference.

    Parameters
    ----------
    ground : (S, 2, 2) — `footprint_map`.
    reference : (2, 2) — the same at the reference time.
    beam : half widths, for the major axis.
    """
    azimuth, of_range = (
        _wrapped(_direction(ground[..., k]) - _direction(reference[..., k]), math.tau)
        for k in (0, 1)
    )
    azimuth_stretch, range_stretch = (
        np.hypot(*np.moveaxis(ground[..., k], -1, 0)) / np.hypot(*reference[..., k]) for k in (0, 1)
    )
    major = _major_direction(ground, beam) - _major_direction(reference, beam)
    return Distortion(
        azimuth_trace=azimuth,
        range_trace=of_range,
        major_axis=_wrapped(major, math.pi),
        shear=_wrapped(of_range - azimuth, math.tau),
        azimuth_stretch=azimuth_stretch,
        range_stretch=range_stretch,
        area=_determinant(ground) / _determinant(reference),
    )


def pointing_effect(
    states: States, attitude: Array, target: Array, error: tuple[float, float, float]
) -> PointingEffect:
    """Displacement and rotation of the footprint by small turns of the body.

    Parameters
    ----------
    states : Earth-fixed, (S, 3) each [m, m/s].
    attitude : (S, 3, 3) — orbit frame to body, Z towards the target.
    target : (3,) — Earth-fixed [m].
    error : (3,) — standard deviations of independent turns about X, Y, Z [rad].

    Notes
    -----
    The trace of the azimuth plane is a = x − û(x·n)/(û·n), n the vertical. A turn about an axis e
    moves x by e×x and û by e×û, and a by the derivative of that. A turn about Z, of the yaw,
    leaves the center where it is; turns about X and Y move it, and at a slant they rotate the
    trace too, though the paper gives all rotation to the yaw.
    """
    body = attitude @ orbit_axes(states)
    up, level = vertical(target), horizontal_axes(target)
    forward, line = body[..., 0, :], body[..., 2, :]
    path = target - states.position
    ground = level @ ground_map(body, path, up)  # (S, 2, 2)
    still = np.zeros_like(ground[..., 0])
    center = np.stack([-ground[..., 1], ground[..., 0], still], axis=-1)  # e×û: −y, x, 0
    forward_part, line_part = dot(forward, up), dot(line, up)
    trace = forward - line * (forward_part / line_part)[..., None]
    turns = []
    for axis in np.moveaxis(body, -2, 0):
        forward_change, line_change = np.cross(axis, forward), np.cross(axis, line)
        slope = dot(forward_change, up) - dot(line_change, up) * forward_part / line_part
        change = (
            forward_change
            - line_change * (forward_part / line_part)[..., None]
            - line * (slope / line_part)[..., None]
        )
        turns.append(dot(np.cross(trace, change), up) / dot(trace, trace))
    rotation = np.stack(turns, axis=-1)
    return PointingEffect(
        center_per_turn=center,
        rotation_per_turn=rotation,
        center=np.sqrt(np.sum((center * np.array(error)) ** 2, axis=(-1, -2))),
        rotation=np.sqrt(np.sum((rotation * np.array(error)) ** 2, axis=-1)),
    )


def footprints(
    times: Array,
    states: States,
    attitude: Array,
    target: Array,
    *,
    beam: Beam,
    vertices: int = VERTICES,
) -> Footprints:
    """Outlines of an elliptic beam on the ground, at the height of the target.

    Parameters
    ----------
    times : (K,) — since zero Doppler [s].
    states : Earth-fixed, (K, 3) each [m, m/s].
    attitude : (K, 3, 3) — orbit frame to body, Z towards the target; NaN for none.
    target : (3,) — Earth-fixed [m].
    beam : half widths.
    vertices : V, of each outline.
    """
    height = to_geodetic(target).height
    around = np.arange(vertices) * (math.tau / vertices)
    body = attitude @ orbit_axes(states)
    offsets = np.stack(
        [
            math.tan(beam.azimuth) * np.cos(around),
            math.tan(beam.elevation) * np.sin(around),
            np.ones(vertices),
        ],
        axis=-1,
    )
    lines = np.einsum("vi,kij->kvj", offsets, body)
    points = intersect(states.position[:, None, :], lines, height=height)
    place = to_geodetic(points)
    local = rotate(horizontal_axes(target), points - target)
    common = _common(local)
    known = common is not None
    shared = np.empty((0, 2)) if common is None else common
    outline = _onto_surface(shared, target, height)
    return Footprints(
        times=times,
        latitude=place.latitude,
        longitude=place.longitude,
        area=_enclosed(local),
        common_latitude=outline[0],
        common_longitude=outline[1],
        common_area=float(_enclosed(shared)) if known else np.nan,
    )


def _direction(vector: Array) -> Array:
    """Angle from east to north, (..., 2) to (...) [rad]."""
    angle: Array = np.arctan2(vector[..., 1], vector[..., 0])
    return angle


def _major_direction(ground: Array, beam: Beam) -> Array:
    """Angle of the longest diameter of the footprint from east, within ±π/2 [rad]."""
    scaled = ground * np.array(beam)
    shape = scaled @ np.swapaxes(scaled, -1, -2)
    angle: Array = 0.5 * np.arctan2(2.0 * shape[..., 0, 1], shape[..., 0, 0] - shape[..., 1, 1])
    return angle


def _wrapped(angle: Array, period: float) -> Array:
    """Angle less the whole periods in it, within half a period of 0."""
    return np.remainder(angle + 0.5 * period, period) - 0.5 * period


def _determinant(matrix: Array) -> Array:
    determinant: Array = (
        matrix[..., 0, 0] * matrix[..., 1, 1] - matrix[..., 0, 1] * matrix[..., 1, 0]
    )
    return determinant


def _enclosed(outline: Array) -> Array:
    """Area within open outlines, (..., V, 2) to (...) [m²]."""
    x, y = outline[..., 0], outline[..., 1]
    area: Array = 0.5 * np.abs(
        np.sum(x * np.roll(y, -1, axis=-1) - y * np.roll(x, -1, axis=-1), axis=-1)
    )
    return area


def _common(outlines: Array) -> Array | None:
    """Outline of what all outlines have in common, (K, V, 2) to (W, 2); empty for nothing.

    Outlines that are missing don't count. None where it is not known: there is no outline, or one
    goes beyond the horizon and has no corners there.
    """
    finite = np.isfinite(outlines[..., 0])
    drawn = outlines[np.any(finite, axis=-1)]
    if len(drawn) == 0 or not np.all(np.isfinite(drawn)):
        return None
    shared = shapely.intersection_all(shapely.polygons(drawn))
    if shared.is_empty or shared.geom_type != "Polygon":
        return np.empty((0, 2))
    corners: Array = shapely.get_coordinates(shared.exterior)[:-1]
    return corners


def _onto_surface(local: Array, target: Array, height: Array) -> tuple[Array, Array]:
    """Latitude and longitude of points east and north of a target, at its height, (W,) each."""
    level = target + local @ horizontal_axes(target)
    # The vertical through a point of the tangent plane is the line along which it was projected.
    surface = intersect(level + 1e5 * vertical(target), -vertical(target), height=height)
    place = to_geodetic(surface)
    return place.latitude, place.longitude
