"""The Earth's figure, look geometry, and the planes in which a beam meets the Earth."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from formation import States
from insar import LookSide, line_of_sight
from insar.observe import (
    WGS84,
    Ellipsoid,
    FixedIncidence,
    FixedLook,
    angle_at_incidence,
    angle_at_look,
    beam_plane,
    from_geodetic,
    intersect,
    look_at,
    meets,
    orbit_axes,
    orbit_geometry,
    rtn_axes,
    sphere,
    swath,
    to_geodetic,
    vertical,
    zero_doppler_plane,
)

MILLIMETER = 1e-3
NANOMETERS = 1e-8  # rounding of coordinates of 1e7 m
latitudes = st.floats(-np.pi / 2, np.pi / 2)
longitudes = st.floats(-np.pi, np.pi)


# -- coordinates ---------------------------------------------------------------------------------


def test_wgs84_is_the_published_ellipsoid():
    """NIMA TR8350.2, table 3.3: b = 6356752.3142 m."""
    assert_allclose(WGS84.semi_minor_axis, 6_356_752.3142, atol=5e-5)


def test_distance_from_the_axis_in_closed_form():
    """(N + h) cosφ with the radius of curvature N = a/√(1 − e² sin²φ); e² of NIMA TR8350.2."""
    latitude, longitude = np.deg2rad([40.0, -75.0])
    curvature = 6_378_137.0 / np.sqrt(1.0 - 6.694_379_990_14e-3 * np.sin(latitude) ** 2)
    x, y, _ = from_geodetic(latitude=latitude, longitude=longitude, height=100.0)
    assert_allclose(np.hypot(x, y), (curvature + 100.0) * np.cos(latitude), atol=NANOMETERS)
    assert_allclose(np.arctan2(y, x), longitude, rtol=1e-15)


@given(latitudes, longitudes, st.floats(-5e3, 4e7))
def test_coordinates_there_and_back(latitude, longitude, height):
    point = from_geodetic(latitude=latitude, longitude=longitude, height=height)
    back = to_geodetic(point)
    # ERFA's inverse is not iterated: 1e-9 rad would be 6 mm on the ground.
    assert_allclose(
        from_geodetic(latitude=back.latitude, longitude=back.longitude, height=back.height),
        point,
        atol=1e-6,
    )
    assert_allclose(back.latitude, latitude, atol=1e-12)


@given(latitudes, longitudes, st.floats(0.0, 1e6))
def test_vertical_is_the_gradient_of_the_height(latitude, longitude, height):
    point = from_geodetic(latitude=latitude, longitude=longitude, height=height)
    up = vertical(point)
    assert_allclose(to_geodetic(point + 1000.0 * up).height, height + 1000.0, atol=1e-6)
    assert_allclose(np.linalg.norm(up), 1.0, rtol=1e-15)


def test_missing_points_stay_missing_without_a_warning():
    assert np.all(np.isnan(to_geodetic([np.nan] * 3)))
    assert np.all(np.isnan(vertical([np.nan] * 3)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"semi_major_axis": -1.0}, r"semi_major_axis = -1.0 m must be positive"),
        ({"flattening": 298.257}, r"flattening = 298.257 must lie in \[0, 1\); .* not its inverse"),
    ],
)
def test_impossible_ellipsoids_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Ellipsoid(**({"semi_major_axis": 6.4e6, "flattening": 0.0} | change))


# -- intersection --------------------------------------------------------------------------------


@given(latitudes, longitudes, st.floats(0.0, 1.4), st.floats(-np.pi, np.pi), st.floats(-500, 9e3))
def test_a_ray_meets_the_point_that_it_was_aimed_at(latitude, longitude, zenith, azimuth, height):
    """Aimed from a satellite seen at a zenith angle of up to 80°."""
    target = from_geodetic(latitude=latitude, longitude=longitude, height=height)
    up = vertical(target)
    east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
    level = np.cos(azimuth) * east + np.sin(azimuth) * np.cross(up, east)
    towards = np.cos(zenith) * up + np.sin(zenith) * level
    for distance in (7e5, 4e7):
        met = intersect(target + distance * towards, -3.0 * towards, height=height)
        assert_allclose(met, target, atol=MILLIMETER)
        assert_allclose(to_geodetic(met).height, height, atol=1e-7)


def test_intersection_with_a_sphere_in_closed_form():
    """Law of cosines: r cosγ − √(R² − r² sin²γ)."""
    radius, distance, look = 6.371e6, 6.885e6, np.deg2rad(30.0)
    direction = line_of_sight(look_angle=look, azimuth=np.pi / 2)
    point = intersect([distance, 0.0, 0.0], direction, ellipsoid=sphere(radius))
    expected = distance * np.cos(look) - np.sqrt(radius**2 - (distance * np.sin(look)) ** 2)
    assert_allclose(point[0], distance - expected * np.cos(look), atol=NANOMETERS)
    assert_allclose(point[2], expected * np.sin(look), atol=NANOMETERS)


def test_rays_that_miss_or_point_away_or_start_below_are_missing():
    position = np.array([7e6, 0.0, 0.0])
    directions = np.array([[-1.0, 0, 0], [0, 1.0, 0], [1.0, 0, 0], [np.nan] * 3, [0.0, 0.0, 0.0]])
    for height in (0.0, 3e3):
        points = intersect(position, directions, height=height)
        assert_allclose(points[0], [6_378_137.0 + height, 0.0, 0.0], atol=NANOMETERS)
        assert np.all(np.isnan(points[1:]))
    assert meets(position, directions).tolist() == [True, False, False, False, False]
    assert np.all(np.isnan(intersect([6.3e6, 0.0, 0.0], [-1.0, 0.0, 0.0])))


def test_intersection_broadcasts():
    points = intersect(
        np.tile([7e6, 0.0, 0.0], (4, 1, 1)), [[-1.0, 0, 0], [-1, 0.1, 0]], height=np.zeros((4, 2))
    )
    assert points.shape == (4, 2, 3)


# -- axes and look geometry ----------------------------------------------------------------------

moments = st.tuples(st.floats(-np.pi, np.pi), st.floats(0.05, 3.1), st.floats(-np.pi, np.pi))


def state(latitude_argument, inclination, node, *, radius=6.9e6, climb=0.02):
    """Earth-fixed state of a satellite that climbs at a part of its forward velocity."""
    n = np.array([np.sin(node) * np.sin(inclination), -np.cos(node) * np.sin(inclination), 0.0])
    n[2] = np.cos(inclination)
    ascending = np.array([np.cos(node), np.sin(node), 0.0])
    r = np.cos(latitude_argument) * ascending + np.sin(latitude_argument) * np.cross(n, ascending)
    inertial = 7.6e3 * (np.cross(n, r) + climb * r)
    position = radius * r
    return States(position, inertial - np.cross([0.0, 0.0, 7.2921159e-5], position))


@given(moments)
def test_orbit_quantities_are_those_of_the_state(moment):
    latitude_argument, inclination, _ = moment
    states = state(*moment)
    geometry = orbit_geometry(states)
    assert_allclose(geometry.inclination, inclination, atol=1e-12)
    turns = (geometry.argument_of_latitude - latitude_argument) / (2.0 * np.pi)
    assert_allclose(turns, np.round(turns), atol=1e-12)
    assert_allclose(geometry.angular_rate, 7.6e3 / 6.9e6, rtol=1e-12)
    assert_allclose(geometry.radial_velocity, 0.02 * 7.6e3, rtol=1e-9)
    # X forward, Y = −N, Z nadir
    forward, right, nadir = orbit_axes(states)
    assert_allclose([-nadir, forward, -right], rtn_axes(states), atol=1e-15)
    assert_allclose(np.cross(forward, right), nadir, atol=1e-14)


@given(moments, st.floats(0.02, 0.9), st.floats(-np.pi, np.pi))
def test_look_geometry_inverts_the_line_of_sight(moment, look_angle, azimuth):
    states = state(*moment)
    line = line_of_sight(look_angle=look_angle, azimuth=azimuth) @ rtn_axes(states)
    target = intersect(states.position, line)
    look = look_at(states, target)
    assert_allclose(look.look_angle, look_angle, atol=1e-13)
    assert_allclose(np.cos(look.azimuth - azimuth), 1.0, atol=1e-13)
    assert_allclose(look.line_of_sight, line, atol=1e-14)
    assert_allclose(target, states.position + look.slant_range * line, atol=NANOMETERS)
    # The triangle Earth's center, satellite, target, with the geocentric vertical, is within the
    # deflection of the ellipsoid's normal (0.1924° at most).
    sine = np.linalg.norm(states.position) / np.linalg.norm(target) * np.sin(look_angle)
    assert abs(np.arcsin(sine) - look.incidence) < np.deg2rad(0.1925)
    assert look.visible


def test_targets_beyond_the_horizon_are_not_visible():
    states = States(np.array([7e6, 0.0, 0.0]), np.array([0.0, 0.0, 7.5e3]))
    longitudes = np.arccos(6_378_137.0 / 7e6) + np.array([-1e-6, 1e-6])
    targets = from_geodetic(latitude=0.0, longitude=longitudes)
    assert look_at(states, targets).visible.tolist() == [True, False]
    assert not look_at(states, [np.nan] * 3).visible


# -- beam planes ---------------------------------------------------------------------------------


@given(moments, st.floats(0.02, 1.0), st.sampled_from(LookSide))
def test_zero_doppler_plane_is_perpendicular_to_the_earth_fixed_velocity(moment, angle, side):
    states = state(*moment)
    plane = zero_doppler_plane(states, side=side)
    beam = plane.direction(angle)
    assert abs(beam @ states.velocity) < 1e-11  # m/s
    assert_allclose(np.linalg.norm(beam), 1.0, rtol=1e-14)
    assert abs(plane.aside @ plane.nadir) < 1e-15
    # LEFT = 1 is the side of +N, seen along the Earth-fixed velocity.
    left = np.cross(states.position, states.velocity)
    assert np.sign(beam @ left) == side


@given(moments, st.floats(0.05, 1.0), st.sampled_from(LookSide))
def test_elevation_at_a_look_angle(moment, look_angle, side):
    plane = zero_doppler_plane(state(*moment), side=side)
    beam = plane.direction(angle_at_look(plane, look_angle))
    assert_allclose(np.arccos(beam @ plane.nadir), look_angle, atol=1e-12)


@given(
    moments,
    st.floats(np.deg2rad(3.0), np.deg2rad(89.9)),
    st.sampled_from(LookSide),
    st.sampled_from([6.7e6, 8e6, 42.2e6]),
)
def test_elevation_at_an_incidence_is_the_root_of_the_incidence(moment, incidence, side, radius):
    """Against Brent's method between nadir and the horizon."""
    states = state(*moment, radius=radius)
    plane = zero_doppler_plane(states, side=side)
    angle = angle_at_incidence(states.position, plane, incidence)

    def excess(elevation):
        target = intersect(states.position, plane.direction(elevation))
        return look_at(states, target).incidence - incidence

    horizon = brentq(
        lambda x: -1.0 if meets(states.position, plane.direction(x)) else 1.0,
        0.0,
        np.pi / 2,
        xtol=1e-15,
    )
    nearest = np.deg2rad(0.05)
    if excess(nearest) > 0.0:  # the plane passes too far from nadir
        assert np.isnan(angle) or angle < nearest
        return
    # One step inside: the bracket of `meets` ends on either side of the horizon.
    expected = brentq(excess, nearest, horizon - 1e-14, xtol=1e-15)
    assert_allclose(angle, expected, atol=1e-12)
    assert_allclose(excess(angle), 0.0, atol=1e-10)


def test_incidence_on_a_sphere_is_the_sine_law():
    states = state(0.3, 1.7, 0.1)
    plane = zero_doppler_plane(states, side=LookSide.LEFT)
    incidence = np.deg2rad([0.1, 5.0, 45.0, 89.999])
    tilt = np.arccos(plane.down @ plane.nadir)
    # The incidence of a sphere follows from the look angle alone; below the tilt there is none.
    look = np.arcsin(6.371e6 / 6.9e6 * np.sin(incidence))
    with np.errstate(invalid="ignore"):
        expected = np.arccos(np.cos(look) / np.cos(tilt))
    angle = angle_at_incidence(states.position, plane, incidence, ellipsoid=sphere(6.371e6))
    assert_allclose(angle, expected, atol=1e-12)
    assert np.isnan(angle[0])


@given(moments, st.floats(np.deg2rad(0.01), np.deg2rad(0.3)), st.sampled_from(LookSide))
def test_an_incidence_near_nadir_is_met_on_the_look_side_or_not_at_all(moment, incidence, side):
    """The normal leans by up to 0.19° against the radius: small incidences may be elsewhere."""
    states = state(*moment, climb=0.0)
    angle = angle_at_incidence(
        states.position, zero_doppler_plane(states, side=side), np.array([incidence, 0.5])
    )
    assert angle[0] > 0.0 or np.isnan(angle[0])
    assert angle[1] > 0.0


def test_no_incidence_from_below_the_surface():
    states = state(0.3, 1.7, 0.1, radius=6.3e6)
    plane = zero_doppler_plane(states, side=LookSide.LEFT)
    assert np.isnan(angle_at_incidence(states.position, plane, 0.7))


@pytest.mark.parametrize("side", list(LookSide))
def test_edges_of_a_strip_are_at_the_given_angles(side):
    states = state(0.8, 1.7, 0.4)
    plane = beam_plane(states.position, states.velocity, side=side)
    edges = swath(
        states.position, plane, near=FixedLook(0.35), far=FixedIncidence(np.deg2rad(45.0))
    )
    near, far = look_at(states, edges.near), look_at(states, edges.far)
    assert_allclose(near.look_angle, 0.35, atol=1e-12)
    assert_allclose(far.incidence, np.deg2rad(45.0), atol=1e-12)
    assert np.sign(near.azimuth) == np.sign(far.azimuth) == side
    missed = swath(states.position, plane, near=FixedLook(0.35), far=FixedLook(1.3))
    assert np.all(np.isnan(missed.far))


def test_edges_in_the_wrong_order_are_refused():
    states = state(0.8, 1.7, 0.4)
    plane = zero_doppler_plane(states, side=LookSide.LEFT)
    with pytest.raises(ValueError, match=r"near edge = 0.7 rad must be below .*; exchange them"):
        swath(states.position, plane, near=FixedIncidence(0.7), far=FixedIncidence(0.5))


def test_latitudes_beyond_the_poles_are_refused():
    with pytest.raises(ValueError, match=r"latitude = 37\.75 rad must lie within ±π/2; give rad"):
        from_geodetic(latitude=37.75, longitude=0.2)
