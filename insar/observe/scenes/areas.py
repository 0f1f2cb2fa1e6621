"""Areas of the Earth: polygons read from GeoJSON, and points spread evenly over them.

Inside this module coordinates are those of GeoJSON, longitude and latitude in degrees, because
its messages and shapely's are about the user's numbers.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.validation import explain_validity

Array = NDArray[np.float64]

_LONGEST_EDGE = 1.0
"""Edges are cut to this before areas are taken, since parallels are curved in equal areas [°]."""

_REPROJECT = (
    "reproject the area, e.g. ogr2ogr -t_srs EPSG:4326 -lco RFC7946=YES out.geojson in.geojson"
)

_WRAP = (
    "longitudes beyond 180° are counted from the other side: subtract 360°, and cut a polygon that "
    "crosses the date line at ±180° into a MultiPolygon (RFC 7946), e.g. ogr2ogr -wrapdateline "
    "-t_srs EPSG:4326 out.geojson in.geojson"
)


def read_area(text: str) -> tuple[Polygon, ...]:
    """Polygons of a GeoJSON text, dissolved where they overlap.

    Parameters
    ----------
    text : see `Targets.from_geojson`.

    Returns
    -------
    Polygons in degrees of longitude and latitude; together they have an area above zero.

    Raises
    ------
    ValueError
        See `Targets.from_geojson`.

    References
    ----------
    RFC 7946, sections 3.1.6 (polygons), 3.1.9 (date line) and 4 (coordinates).
    """
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise ValueError(
            f"line {error.lineno}, column {error.colno} is not JSON ({error.msg}); "
            "export the area as GeoJSON"
        ) from error
    except RecursionError as error:
        raise ValueError("the JSON is nested too deeply to be GeoJSON") from error
    polygons = list(_polygons(document, "GeoJSON"))
    if not polygons:
        raise ValueError("GeoJSON: there is no polygon; draw the area as a Polygon or MultiPolygon")
    merged = shapely.get_parts(shapely.union_all(polygons))
    return tuple(part for part in merged if part.area > 0.0)


def _polygons(item: Any, place: str) -> Iterator[Polygon]:
    """Polygons of a GeoJSON object, whatever contains them."""
    if not isinstance(item, dict):
        raise ValueError(f"{place} is no GeoJSON object; it must be {{...}} with a type")
    _check_reference_system(item)
    match item.get("type"):
        case "FeatureCollection":
            yield from _members(item, "features", place)
        case "GeometryCollection":
            yield from _members(item, "geometries", place)
        case "Feature":
            # RFC 7946 section 3.2: a feature without a place has the geometry null.
            if item.get("geometry") is not None:
                yield from _polygons(item["geometry"], f"{place}: geometry")
        case "Polygon":
            yield _polygon(item.get("coordinates"), f"{place}: coordinates")
        case "MultiPolygon":
            parts = _list(item.get("coordinates"), f"{place}: coordinates")
            for index, part in enumerate(parts):
                yield _polygon(part, f"{place}: coordinates[{index}]")
        case other:
            raise ValueError(
                f"{place} has type {other!r}, which is no area; draw a Polygon or MultiPolygon, "
                "or list points as points"
            )


def _members(item: dict[str, Any], key: str, place: str) -> Iterator[Polygon]:
    for index, member in enumerate(_list(item.get(key), f"{place}: {key}")):
        yield from _polygons(member, f"{place}: {key}[{index}]")


def _check_reference_system(item: dict[str, Any]) -> None:
    """Refuse the `crs` member of old GeoJSON, unless it names the only system of the standard."""
    system = item.get("crs")
    if system is None:
        return
    properties = system.get("properties") if isinstance(system, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    if not str(name).upper().endswith("CRS84"):
        raise ValueError(
            f"GeoJSON: the reference system (crs) is {name or system!r}; it must be longitude and "
            f"latitude of WGS84; {_REPROJECT}"
        )


def _polygon(rings: Any, place: str) -> Polygon:
    coordinates = [
        _ring(ring, f"{place}[{index}]") for index, ring in enumerate(_list(rings, place))
    ]
    if not coordinates:
        raise ValueError(f"{place} is an empty polygon; remove it or draw it")
    polygon = Polygon(coordinates[0], coordinates[1:])
    if not polygon.is_valid:
        raise ValueError(
            f"{place} is no simple polygon: {explain_validity(polygon)} (longitude latitude); "
            "redraw it without crossing lines"
        )
    return polygon


def _ring(positions: Any, place: str) -> list[tuple[float, float]]:
    ring = [
        _position(position, f"{place}[{index}]")
        for index, position in enumerate(_list(positions, place))
    ]
    if len(ring) < 4 or ring[0] != ring[-1]:
        raise ValueError(
            f"{place} has {len(ring)} positions and is no closed ring; it needs at least four, "
            "the last equal to the first"
        )
    for index, (one, other) in enumerate(pairwise(ring)):
        if abs(other[0] - one[0]) > 180.0:
            raise ValueError(
                f"{place} jumps from longitude {one[0]:g}° to {other[0]:g}° after position "
                f"{index}: an edge over the date line, or longer than half the Earth; cut the "
                "polygon at ±180° into a MultiPolygon (RFC 7946, e.g. ogr2ogr -wrapdateline), or "
                "give more positions"
            )
    return ring


def _position(value: Any, place: str) -> tuple[float, float]:
    position = _list(value, place)
    numeric = [
        number
        for number in position[:2]
        if isinstance(number, int | float) and not isinstance(number, bool)
    ]
    if len(numeric) < 2 or not all(math.isfinite(number) for number in numeric):
        raise ValueError(f"{place} = {value!r} is no position; give [longitude, latitude]")
    longitude, latitude = (float(number) for number in numeric)
    if abs(longitude) > 180.0 or abs(latitude) > 90.0:
        if abs(longitude) <= 90.0 and abs(latitude) <= 180.0:
            remedy = "put the longitude first"
        elif abs(longitude) <= 360.0 and abs(latitude) <= 90.0:
            remedy = _WRAP
        else:
            remedy = f"these are coordinates of a map projection; {_REPROJECT}"
        raise ValueError(
            f"{place} = [{longitude:g}, {latitude:g}] is no longitude (±180°) and latitude (±90°); "
            f"{remedy}"
        )
    return longitude, latitude


def _list(value: Any, place: str) -> list[Any]:
    if not isinstance(value, list):
        raise ValueError(f"{place} must be a list, not {type(value).__name__}")
    return value


def sample_area(area: tuple[Polygon, ...], count: int) -> tuple[Array, Array]:
    """Points that each stand for an equal part of an area.

    Parameters
    ----------
    area : polygons in degrees of longitude and latitude.
    count : how many points.

    Returns
    -------
    latitude, longitude : (count,) — from south to north in each polygon, along parallels [rad].

    Notes
    -----
    Each polygon is cut into rows of latitude about as high as the points are apart; the points
    stand at equal steps of the area swept along the rows. Areas are those of a sphere, which are
    within 0.7 % of the ellipsoid's from one end of the Earth to the other.
    """
    spacing = math.degrees(math.sqrt(sum(_steradians(polygon) for polygon in area) / count))
    rows = np.concatenate([_rows(polygon, spacing) for polygon in area])
    latitude, west, east, weight = rows.T
    end = np.cumsum(weight)
    wanted = (np.arange(count) + 0.5) / count * end[-1]
    row = np.minimum(np.searchsorted(end, wanted), len(rows) - 1)
    part = 1.0 - (end[row] - wanted) / weight[row]
    return np.radians(latitude[row]), np.radians(west[row] + part * (east - west)[row])


def _steradians(polygon: Polygon) -> float:
    """Area on the unit sphere, by the cylindrical equal-area projection."""
    fine = shapely.segmentize(polygon, _LONGEST_EDGE)
    projected = shapely.transform(
        fine, lambda xy: np.column_stack([np.radians(xy[:, 0]), np.sin(np.radians(xy[:, 1]))])
    )
    return float(projected.area)


def _rows(polygon: Polygon, spacing: float) -> Array:
    """Pieces of parallels inside a polygon, (..., 4): latitude, west, east [°], area stood for."""
    west, south, east, north = polygon.bounds
    count = max(1, round((north - south) / spacing))
    height = (north - south) / count
    latitudes = south + (np.arange(count) + 0.5) * height
    lines = shapely.linestrings(
        [[(west - 1.0, latitude), (east + 1.0, latitude)] for latitude in latitudes]
    )
    pieces = shapely.get_parts(shapely.intersection(polygon, lines))
    pieces = pieces[shapely.length(pieces) > 0.0]
    start, latitude, end, _ = shapely.bounds(pieces).T
    weight = np.cos(np.radians(latitude)) * (end - start) * height
    return np.column_stack([latitude, start, end, weight])
