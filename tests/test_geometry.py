"""Line of sight, sensitivity and scenes."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from insar import HeldConstant, LookSide, Scene, line_of_sight
from insar.baselines import sensitivity

PUBLISHED = tomllib.loads(
    (Path(__file__).parent / "published" / "error_model.toml").read_text(encoding="utf-8")
)
EARTH_RADIUS = 6_378_137.0


def spherical_scene(look, azimuth, velocity=(0.0, 1.0, 0.0), altitude=514e3):
    incidence = np.arcsin((EARTH_RADIUS + altitude) / EARTH_RADIUS * np.sin(look))
    slant_range = EARTH_RADIUS * np.sin(incidence - look) / np.sin(look)
    return Scene(
        times=np.zeros(1),
        slant_range=slant_range,
        look_angle=look,
        azimuth=azimuth,
        incidence=incidence,
        velocity_direction=np.array(velocity),
    )


def test_line_of_sight_points_left_of_the_flight_direction():
    assert_allclose(line_of_sight(look_angle=np.pi / 2, azimuth=np.pi / 2), [0, 0, 1], atol=1e-15)
    assert_allclose(line_of_sight(look_angle=0.0, azimuth=1.0), [-1, 0, 0], atol=1e-15)


@given(st.floats(0.05, 1.0), st.floats(-np.pi, np.pi))
def test_line_of_sight_and_vertical_meet_at_the_incidence(look, azimuth):
    scene = spherical_scene(look, azimuth)
    cosine = np.sum(scene.line_of_sight * scene.vertical, axis=-1)
    assert_allclose(cosine, -np.cos(scene.incidence), atol=1e-12)
    # The vertical is the direction from the Earth's center to the target.
    center_to_target = (
        np.array([EARTH_RADIUS + 514e3, 0, 0]) + scene.slant_range[:, None] * scene.line_of_sight
    )
    assert_allclose(scene.vertical, center_to_target / EARTH_RADIUS, atol=1e-9)


@pytest.mark.parametrize("side", list(LookSide))
def test_broadside_sensitivity_is_the_textbook_one(side):
    """e_h = ∂û/∂θ and the lever is r sin θ_inc, 1.08 times the flat Earth's at 514 km, 23°."""
    scene = Scene.broadside_strip(
        times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=EARTH_RADIUS, side=side
    )
    doppler = sensitivity(scene, HeldConstant.DOPPLER)
    azimuth = sensitivity(scene, HeldConstant.AZIMUTH)
    assert_allclose(doppler.height_direction, azimuth.height_direction, atol=1e-12)
    assert_allclose(doppler.height_lever, scene.slant_range * np.sin(scene.incidence))
    assert_allclose(doppler.azimuth_direction, [[0, 1, 0]], atol=1e-12)
    assert float((doppler.height_lever / azimuth.height_lever)[0]) == pytest.approx(1.08, abs=5e-3)


@given(
    look=st.floats(0.2, 0.9),
    azimuth=st.floats(-np.pi, np.pi),
    tilt=st.tuples(st.floats(-0.05, 0.05), st.floats(-0.1, 0.1)),
    baseline=st.tuples(*[st.floats(-1500, 1500)] * 3),
)
def test_sensitivity_against_a_moved_target(look, azimuth, tilt, baseline):
    """Raise a target at constant range and Doppler, and watch the path difference change."""
    velocity = np.array([tilt[0], 1.0, tilt[1]])
    velocity /= np.linalg.norm(velocity)
    scene = spherical_scene(look, azimuth, velocity)
    los = scene.line_of_sight[0]
    assume(abs(np.cross(los, velocity) @ scene.vertical[0]) > 0.1)  # not along the ground track
    satellite = np.array([EARTH_RADIUS + 514e3, 0.0, 0.0])

    # Directions of constant Doppler form a cone about the velocity: turn û around it.
    side = los - (los @ velocity) * velocity
    across = np.cross(velocity, side)

    def turned(angle):
        return (los @ velocity) * velocity + np.cos(angle) * side + np.sin(angle) * across

    def height(angle):
        return np.linalg.norm(satellite + scene.slant_range[0] * turned(angle)) - EARTH_RADIUS

    climb = 1.0
    slope = (height(1e-6) - height(-1e-6)) / 2e-6
    up = brentq(lambda a: height(a) - climb, 0.0, 2.5 * climb / slope, xtol=1e-15)
    down = brentq(lambda a: height(a) + climb, 0.0, -2.5 * climb / slope, xtol=1e-15)
    measured = np.array(baseline) @ (turned(up) - turned(down)) / (2 * climb)
    direction = sensitivity(scene, HeldConstant.DOPPLER)
    expected = np.array(baseline) @ direction.height_direction[0] / direction.height_lever[0]
    # 1 m of 600 km: the second-order remainder is 1e-12 of a baseline of 1500 m.
    assert measured == pytest.approx(expected, rel=1e-5, abs=2e-8)


def test_published_sensitivities():
    case = PUBLISHED["height_sensitivity"]
    look, azimuth = np.deg2rad(case["look_deg"]), np.deg2rad(case["azimuth_deg"])
    scene = Scene.flat_earth(
        times=[0.0],
        slant_range=[case["slant_range_km"] * 1e3],
        look_angle=[look],
        azimuth=[azimuth],
    )
    for held, key in [
        (HeldConstant.DOPPLER, "constant_doppler"),
        (HeldConstant.AZIMUTH, "constant_azimuth"),
    ]:
        direction = sensitivity(scene, held)
        value = direction.height_direction[0] @ case["baseline_rtn_m"] / direction.height_lever[0]
        assert value == pytest.approx(case[key], abs=5e-8)  # printed to four decimals


def test_tandem_x_like_geometry():
    case = PUBLISHED["tandem_x_like"]
    scene = Scene.broadside_strip(
        times=[0.0],
        look_angle=np.deg2rad(case["look_deg"]),
        altitude=case["altitude_km"] * 1e3,
        earth_radius=case["earth_radius_km"] * 1e3,
    )
    assert np.rad2deg(scene.incidence[0]) == pytest.approx(case["incidence_deg"], abs=1e-3)
    assert scene.slant_range[0] / 1e3 == pytest.approx(case["slant_range_km"], abs=5e-3)


def test_scene_is_immutable_and_copies_its_input():
    times = np.arange(2.0)
    scene = Scene.broadside_strip(
        times=times, look_angle=0.4, altitude=514e3, earth_radius=EARTH_RADIUS
    )
    times[0] = 99.0
    assert scene.times[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        scene.slant_range[0] = 1.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"slant_range": [5e5, -1.0]}, "slant_range = -1.0 in segment 2 m must be positive"),
        ({"look_angle": [0.4, 23.0]}, "look_angle = 23.0 in segment 2"),
        ({"incidence": [0.4, 0.3]}, "incidence = 0.3 in segment 2"),
        ({"azimuth": [np.nan, 1.0]}, "must be finite"),
        ({"times": [[0.0, 1.0], [0.0, 1.0]]}, "shape"),
        ({"slope": 0.5}, "layover"),
        ({"velocity_direction": [0.0, 0.0, 0.0]}, "zero vector"),
    ],
)
def test_impossible_scenes_are_refused(change, message):
    valid = {
        "times": [0.0, 1.0],
        "slant_range": [5e5, 5e5],
        "look_angle": [0.4, 0.4],
        "azimuth": [1.5, 1.5],
        "incidence": [0.44, 0.44],
    }
    with pytest.raises(ValueError, match=message):
        Scene(**(valid | change))


def test_a_line_of_sight_that_misses_the_earth_is_refused():
    with pytest.raises(ValueError, match=r"misses the Earth .* between 0 and 67\.7"):
        Scene.broadside_strip(
            times=[0.0], look_angle=np.deg2rad(70), altitude=514e3, earth_radius=EARTH_RADIUS
        )


def test_looking_along_the_ground_track_is_refused():
    with pytest.raises(ValueError, match="along the ground track"):
        sensitivity(spherical_scene(0.4, 0.0), HeldConstant.DOPPLER)
