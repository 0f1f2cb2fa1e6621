"""Targets: points as given, areas from GeoJSON, and the messages for what is no area."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from shapely.geometry import Point, Polygon

from insar.observe.scenes.targets import Targets

ETNA = Path(__file__).parent.parent / "configs" / "areas" / "etna.geojson"


def box(west, south, east, north):
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


def polygon(*rings):
    return {"type": "Polygon", "coordinates": list(rings)}


def sampled(document, count=25):
    targets = Targets.from_geojson(json.dumps(document), count=count)
    return np.degrees(targets.latitude), np.degrees(targets.longitude)


# -- points --------------------------------------------------------------------------------------


def test_a_single_point_is_one_target():
    targets = Targets.from_points(latitude=0.5, longitude=-1.0, height=20.0)
    assert len(targets) == 1
    assert targets.outlines == ()
    # On the ellipsoid and 20 m up; 0.3 % covers the flattening.
    assert_allclose(np.linalg.norm(targets.position, axis=-1), 6_373_000.0, rtol=3e-3)


@given(st.floats(-2 * np.pi, 2 * np.pi))
def test_longitudes_are_brought_to_half_a_turn_without_moving_the_point(longitude):
    targets = Targets.from_points(latitude=0.3, longitude=longitude)
    assert -np.pi <= targets.longitude[0] <= np.pi
    assert_allclose(np.exp(1j * targets.longitude[0]), np.exp(1j * longitude), atol=1e-14)


def test_heights_may_be_one_for_all_and_a_subset_keeps_the_order():
    targets = Targets.from_points(latitude=[0.1, 0.2, 0.3], longitude=[1.0, 1.1, 1.2], height=5.0)
    part = targets.subset(np.array([2, 0]))
    assert part.latitude.tolist() == [0.3, 0.1]
    assert part.height.tolist() == [5.0, 5.0]


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ({"latitude": [], "longitude": []}, "at least one target"),
        ({"latitude": [0.1, 0.2], "longitude": [1.0] * 3}, r"longitude has shape \(3,\)"),
        ({"latitude": [0.1, 37.6], "longitude": 0.0}, r"latitude = 37.6 of target 2"),
        ({"latitude": 0.1, "longitude": 15.0}, r"longitude = 15.0 of target 1"),
        ({"latitude": 0.1, "longitude": np.nan}, r"longitude = nan of target 1 must be finite"),
        ({"latitude": 0.1, "longitude": 0.0, "height": 5e5}, r"height = 500000.0 of target 1"),
    ],
)
def test_impossible_points_are_refused(points, message):
    with pytest.raises(ValueError, match=message):
        Targets.from_points(**points)


# -- sampling ------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 2, 7, 25, 400])
def test_the_shipped_area_gives_as_many_points_inside_as_asked(count):
    targets = Targets.from_geojson(ETNA.read_text(encoding="utf-8"), count=count, height=1500.0)
    (outline,) = targets.outlines
    area = Polygon(outline)
    assert len(targets) == count
    assert all(
        area.contains(Point(*point))
        for point in zip(targets.longitude, targets.latitude, strict=True)
    )
    assert_allclose(targets.height, 1500.0)
    # The summit craters, 37.751° N, 14.994° E, are near its middle.
    assert_allclose(np.degrees(outline.mean(axis=0)), [14.994, 37.751], atol=0.05)


def test_points_stand_for_equal_areas_far_from_the_equator():
    """60° to 80°: the parallel that halves the area, not the latitudes, halves the points."""
    latitude, longitude = sampled(polygon(box(-20, 60, 20, 80)), count=2000)
    half = np.degrees(np.arcsin(0.5 * (np.sin(np.radians(60)) + np.sin(np.radians(80)))))
    # A row of some 30 points may fall to either side.
    assert abs(np.mean(latitude < half) - 0.5) < 0.02
    assert abs(np.mean(longitude < 0.0) - 0.5) < 0.01


@given(
    st.floats(-179, 150),
    st.floats(-85, 70),
    st.floats(0.05, 25),
    st.floats(0.05, 14),
    st.integers(1, 60),
)
def test_points_are_inside_and_about_as_far_apart_as_their_share(west, south, width, height, count):
    latitude, longitude = sampled(
        polygon(box(west, south, west + width, south + height)), count=count
    )
    assert len(latitude) == count
    assert np.all((longitude > west) & (longitude < west + width))
    assert np.all((latitude > south) & (latitude < south + height))
    assert len({*zip(latitude, longitude, strict=True)}) == count


def test_no_point_falls_in_a_hole():
    latitude, longitude = sampled(polygon(box(0, 0, 10, 10), box(2, 2, 8, 8)), count=200)
    inside = (abs(latitude - 5) < 3) & (abs(longitude - 5) < 3)
    assert not np.any(inside)


def test_polygons_share_the_points_by_their_area():
    parts = {"type": "MultiPolygon", "coordinates": [[box(0, 0, 1, 1)], [box(5, 0, 8, 1)]]}
    _, longitude = sampled(parts, count=40)
    assert np.count_nonzero(longitude < 2) == 10


def test_overlapping_polygons_count_once():
    collection = {
        "type": "GeometryCollection",
        "geometries": [polygon(box(0, 0, 2, 2)), polygon(box(0, 0, 2, 2))],
    }
    assert len(Targets.from_geojson(json.dumps(collection)).outlines) == 1


def test_an_area_cut_at_the_date_line_is_sampled_on_both_sides():
    parts = {
        "type": "MultiPolygon",
        "coordinates": [[box(179, -18, 180, -16)], [box(-180, -18, -179, -16)]],
    }
    _, longitude = sampled(parts, count=20)
    assert np.count_nonzero(longitude > 179) == np.count_nonzero(longitude < -179) == 10


def test_an_area_around_the_pole_is_sampled_evenly():
    """Fewer points near the pole: half the area within 5° of it is within 3.53°."""
    cap = [[-180, 85], [-60, 85], [60, 85], [180, 85], [180, 90], [-180, 90], [-180, 85]]
    cap[4:5] = [[180, 90], [60, 90], [-60, 90]]
    latitude, longitude = sampled(polygon(cap), count=300)
    half = 90 - np.degrees(np.arccos((1 + np.cos(np.radians(5))) / 2))
    assert abs(np.mean(latitude > half) - 0.5) < 0.08  # one row of points
    assert_allclose(np.exp(1j * np.radians(longitude)).mean(), 0.0, atol=0.08)


# -- what GeoJSON may look like ------------------------------------------------------------------


@pytest.mark.parametrize(
    "wrap",
    [
        lambda area: area,
        lambda area: {"type": "Feature", "properties": None, "geometry": area},
        lambda area: {
            "type": "FeatureCollection",
            "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}},
            "features": [
                {"type": "Feature", "geometry": None},
                {"type": "Feature", "geometry": area},
            ],
        },
    ],
)
def test_an_area_may_be_bare_or_in_features(wrap):
    area = polygon([[*position, 250.0] for position in box(10, 40, 11, 41)])
    latitude, _ = sampled(wrap(area), count=4)
    assert_allclose(np.unique(latitude), [40.25, 40.75], atol=1e-9)


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ([1, 2], "GeoJSON is no GeoJSON object"),
        ({"type": "FeatureCollection", "features": []}, "there is no polygon; draw the area"),
        ({"type": "Point", "coordinates": [15, 37]}, "has type 'Point', which is no area"),
        ({"type": "Topology"}, "has type 'Topology'"),
        (polygon(), "empty polygon"),
        (polygon([[0, 0], [1, 0], [0, 0]]), "has 3 positions and is no closed ring"),
        (polygon([[0, 0], [1, 0], [1, 1], [0, 1]]), "is no closed ring"),
        (polygon([[0, 0], [1, "x"], [1, 1], [0, 0]]), r"coordinates\[0\]\[1\] = \[1, 'x'\]"),
        (polygon([[0, 0], [1], [1, 1], [0, 0]]), r"= \[1\] is no position"),
        (polygon(7), r"coordinates\[0\] must be a list, not int"),
        (
            polygon(box(500000, 4150000, 540000, 4190000)),
            r"\[500000, 4.15e\+06\] is no longitude \(±180°\) and latitude \(±90°\); these are "
            "coordinates of a map projection; reproject the area, e.g. ogr2ogr",
        ),
        (polygon(box(35, 138, 36, 139)), "put the longitude first"),
        (
            {
                **polygon(box(0, 0, 1, 1)),
                "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}},
            },
            r"reference system \(crs\) is 'urn:ogc:def:crs:EPSG::32633'; it must be longitude",
        ),
        (
            polygon(box(179, -18, -179, -16)),
            "jumps from longitude 179° to -179° after position 0: an edge over the date line",
        ),
        (polygon(box(-180, -60, 180, 60)), "longer than half the Earth"),
        (polygon([[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]), r"Self-intersection\[0.5 0.5\]"),
        (polygon([[0, 0], [1, 1], [2, 2], [0, 0]]), "no simple polygon"),
    ],
)
def test_what_is_no_area_is_refused_with_the_place_and_the_remedy(document, message):
    with pytest.raises(ValueError, match=message):
        Targets.from_geojson(json.dumps(document))


def test_text_that_is_no_json_is_refused_with_its_line():
    with pytest.raises(ValueError, match=r"line 2, column 1 is not JSON .* export the area"):
        Targets.from_geojson('{"type":\n<xml>')
    with pytest.raises(ValueError, match="nested too deeply"):
        Targets.from_geojson("[" * 100_000)


def test_numbers_that_json_does_not_have_are_refused():
    with pytest.raises(ValueError, match="is no position"):
        Targets.from_geojson(
            '{"type":"Polygon","coordinates":[[[0,0],[1,NaN],[1,1],[0,0]]]}',
        )


def test_count_must_be_positive():
    with pytest.raises(ValueError, match="count = 0 must be at least 1"):
        Targets.from_geojson(ETNA.read_text(encoding="utf-8"), count=0)
