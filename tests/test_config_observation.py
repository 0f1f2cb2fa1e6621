"""Scenes seen from orbits: how a study asks for them, what they become, what is refused."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
import yaml

from configs import BuildError, OptimizeStudy, StudyError, effective_text, example_text, load_study
from configs.build import build_optimize
from configs.orbits import OrbitBlock, build_trajectory
from insar import LookSide
from insar.observe import FixedIncidence, FixedLook, Law, Reference

REAL = example_text("three_sat_real")
ORBIT = REAL[REAL.index("orbit:") : REAL.index("radar:")]
SCENE = REAL[REAL.index("scene:") : REAL.index("errors:")]


def observing(text, *, orbit=ORBIT):
    """The example with another observation; keys of one indented block."""
    lines = "".join(f"    {line}\n" for line in text.strip().splitlines())
    study = REAL.replace(SCENE, f"scene:\n  observation:\n{lines}\n")
    return study.replace(ORBIT, orbit)


POINTS = "points: [{latitude_deg: 37.75, longitude_deg: 14.99, height_m: 3000}]\nside: right"
BAND = "latitude_deg: [37, 38]\nincidence_deg: 35\nsegments: 4\nside: right"


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def load(text):
        Path("my.yaml").write_text(text, encoding="utf-8")
        return load_study(Path("my.yaml"))

    return load


@pytest.fixture
def observation(study):
    return lambda text, **keys: build_optimize(study(observing(text, **keys)).study).observation


@pytest.fixture
def refused(study):
    """What the author of a study reads whose observation is refused, on loading or building."""

    def read(text):
        try:
            loaded = study(text)
        except StudyError as error:
            return str(error)
        with pytest.raises(BuildError) as error:
            build_optimize(loaded.study)
        return str(loaded.located(error.value))

    return read


# --- what a study asks for -----------------------------------------------------------------------


def test_the_shipped_example_sees_its_whole_area_on_the_real_earth():
    setup = build_optimize(OptimizeStudy.model_validate(yaml.safe_load(REAL)))
    seen = setup.observation
    assert len(setup.problem.scene) == len(seen.latitude) == 25
    assert not seen.missed_reasons
    assert (seen.side, seen.law, seen.reference) == (
        LookSide.RIGHT,
        Law.YAW_PITCH,
        Reference.ZERO_DOPPLER,
    )
    assert setup.orbit is seen.orbit
    assert setup.problem.mean_motion == seen.orbit.mean_motion
    assert setup.problem.scene is seen.scene
    latitude, longitude = np.degrees(seen.latitude), np.degrees(seen.longitude)
    assert np.all((latitude > 37.55) & (latitude < 37.95))
    assert np.all((longitude > 14.8) & (longitude < 15.2))
    np.testing.assert_allclose(seen.height, 1000.0, atol=1e-6)
    # Dusk-dawn: an ascending pass is in the evening, a descending one in the morning (UTC + 1 h).
    assert abs(seen.epoch.hour - (17 if seen.ascending else 5)) <= 1


def test_an_observation_survives_the_round_trip(study):
    for text in (REAL, observing(POINTS), observing(BAND)):
        original = study(text).study
        assert study(effective_text(original)).study == original


def test_points_are_seen_where_they_are(observation):
    seen = observation(POINTS)
    np.testing.assert_allclose(np.degrees([seen.latitude[0], seen.longitude[0]]), [37.75, 14.99])
    assert seen.height[0] == pytest.approx(3000.0, abs=1e-6)
    assert isinstance(seen.boresight, FixedIncidence)  # aimed at the target
    assert seen.scene.incidence[0] == pytest.approx(seen.boresight.angle, abs=1e-3)


def test_every_key_of_an_observation_counts(observation):
    keys = POINTS + (
        "\nsteering: pitch_roll\nlook_deg: 33\nreference: as_observed\ndirection: descending"
        "\nnear_incidence_deg: 15\nfar_incidence_deg: 60\nslope_deg: 4\nstart: 2026-04-01"
        "\npass_number: 2"
    )
    seen = observation(keys)
    assert (seen.law, seen.reference, seen.ascending) == (
        Law.PITCH_ROLL,
        Reference.AS_OBSERVED,
        False,
    )
    assert seen.boresight == FixedLook(math.radians(33.0))
    assert seen.epoch >= datetime(2026, 4, 1, tzinfo=UTC)
    assert seen.pass_number == 2
    np.testing.assert_allclose(np.degrees([seen.near_incidence, seen.far_incidence]), [15, 60])
    np.testing.assert_allclose(np.degrees(seen.scene.slope), 4.0)


def test_a_band_is_what_the_boresight_sweeps(observation):
    seen = observation(BAND)
    np.testing.assert_allclose(np.degrees(seen.latitude)[[0, -1]], [37.0, 38.0], atol=1e-6)
    assert len(seen.scene) == 4
    np.testing.assert_allclose(np.degrees(seen.scene.incidence), 35.0, atol=1e-6)


def test_an_arc_is_counted_from_the_node(observation):
    seen = observation("argument_of_latitude_deg: [80, 100]\nlook_deg: 30\nside: left")
    assert len(seen.scene) == 10
    # 20 degrees of a revolution of 94.9 minutes.
    assert seen.scene.times[-1] == pytest.approx(20 / 360 * seen.orbit.period, rel=5e-3)
    assert seen.side is LookSide.LEFT


# --- what is refused -----------------------------------------------------------------------------

# (observation, where the message points, whole message)
WRONG = {
    "no targets": (
        "side: left",
        "observation:",
        "scene.observation lacks its targets; add one of points, geojson_file, latitude_deg, "
        "argument_of_latitude_deg",
    ),
    "two kinds of targets": (
        POINTS + "\nlatitude_deg: [1, 2]",
        "[1, 2]",
        "scene.observation.latitude_deg = [1, 2] is given beside points; keep one of them",
    ),
    "near beyond far": (
        POINTS + "\nnear_incidence_deg: 50\nfar_incidence_deg: 40",
        "50\n",
        "scene.observation.near_incidence_deg = 50 must be below far_incidence_deg, 40; check that "
        "the two are not swapped",
    ),
    "unknown law": (
        POINTS + "\nsteering: yaw_pitsch",
        "yaw_pitsch",
        "scene.observation.steering = 'yaw_pitsch' must be one of none, yaw, "
        "yaw_pitch_approximate, yaw_pitch, pitch_roll; did you mean 'yaw_pitch'?",
    ),
    "no side": (
        "points: [{latitude_deg: 1, longitude_deg: 2}]",
        "observation:",
        "scene.observation.side is missing; add one of left, right (Side of the flight direction "
        "that is observed)",
    ),
    "latitude in the pole's sky": (
        "points: [{latitude_deg: 91, longitude_deg: 2}]\nside: left",
        "91",
        "scene.observation.points[#1].latitude_deg = 91 must be a number from -90 to 90 degrees; "
        "check the value and its unit",
    ),
    "band without a boresight": (
        "latitude_deg: [37, 38]\nside: left",
        "observation:",
        "scene.observation lacks incidence_deg or look_deg, without which latitude_deg is no line "
        "on the ground; add incidence_deg: 35",
    ),
    "two boresights": (
        BAND + "\nlook_deg: 30",
        "30\n",
        "scene.observation.look_deg = 30 excludes incidence_deg; keep one",
    ),
    "samples of points": (
        POINTS + "\nsamples: 9",
        "9\n",
        "scene.observation.samples = 9 is only for geojson_file; remove it",
    ),
    "arc backwards": (
        "argument_of_latitude_deg: [350, 10]\nlook_deg: 30\nside: left",
        "[350, 10]",
        "scene.observation.argument_of_latitude_deg = [350, 10] must grow, by 360 at most; write "
        "[350, 370] to pass the ascending node",
    ),
    "beam into the sky": (
        POINTS + "\nlook_deg: 75",
        "75\n",
        "scene.observation.look_deg = 75 misses the Earth: from 506.625 km it must be below 67.88; "
        "choose a smaller look angle",
    ),
    "incidence outside the strip": (
        BAND.replace("35", "70"),
        "70\n",
        "scene.observation.incidence_deg = 70 lies outside the strip, near_incidence_deg = 20 to "
        "far_incidence_deg = 55; choose an incidence within, or widen the strip",
    ),
    "look angle outside the strip": (
        POINTS + "\nlook_deg: 60",
        "60\n",
        "scene.observation.look_deg = 60 meets the ground at an incidence of 69.2 to 69.5 degrees, "
        "outside the strip, near_incidence_deg = 20 to far_incidence_deg = 55; choose a look angle "
        "from 18.4 to 49.4, or widen the strip",
    ),
    "look angle short of the strip": (
        POINTS + "\nlook_deg: 10\nnear_incidence_deg: 30",
        "10\n",
        "scene.observation.look_deg = 10 meets the ground at an incidence of 10.8 degrees, outside "
        "the strip, near_incidence_deg = 30 to far_incidence_deg = 55; choose a look angle from "
        "27.5 to 49.4, or widen the strip",
    ),
}


def placed(study, where, says):
    before = study[: study.index(where)]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    return f"my.yaml:{line}:{column}: {says}"


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_observation_is_named_with_place_limit_and_remedy(refused, case):
    keys, where, says = WRONG[case]
    text = observing(keys)
    start = text.index("  observation:")
    found = text[:start] + text[start:].replace(where, "\0", 1)
    assert refused(text) == placed(found, "\0", says)


def test_an_orbit_without_an_epoch_is_above_no_place(refused):
    orbit = ORBIT[: ORBIT.index("  node_local_time")] + "\n"
    text = observing(POINTS, orbit=orbit)
    assert refused(text) == placed(
        text,
        "orbit:",
        "orbit lacks an epoch, without which nobody knows when the satellite is above the targets; "
        "add epoch: 2026-11-23T05:07:00Z, or give tle, tle_file or oem_file",
    )


def test_a_target_that_is_never_seen_says_why(refused):
    """From an inclination of 97 degrees the South Pole lies on the left only."""
    text = observing("points: [{latitude_deg: -90, longitude_deg: 0}]\nside: right\nsearch_days: 1")
    shown = refused(text)
    assert shown.startswith(placed(text, "observation:", "scene.observation cannot be used: "))
    assert "\n" not in shown
    assert "; " in shown


def test_a_pass_that_there_is_not_is_blamed(refused):
    text = observing(POINTS + "\npass_number: 99")
    shown = refused(text)
    says = (
        "scene.observation.pass_number = 99 cannot be used: the search finds 5 passes; take 1 to "
        "5, or search longer"
    )
    assert shown == placed(text, "99\n", says)


GEOJSON = {
    "not JSON": ("hello", "line 1, column 1 is not JSON"),
    "projected": (
        '{"type": "Polygon", "coordinates": [[[500000, 4170000], [510000, 4170000], '
        "[510000, 4180000], [500000, 4170000]]]}",
        "is no longitude (±180°) and latitude (±90°); these are coordinates of a map projection",
    ),
    "another reference system": (
        '{"type": "Polygon", "crs": {"properties": {"name": "EPSG:32633"}}, "coordinates": []}',
        "the reference system (crs) is",
    ),
    "longitudes from 0 to 360": (
        '{"type": "Polygon", "coordinates": [[[179, 0], [181, 0], [181, 1], [179, 0]]]}',
        "[181, 0] is no longitude (±180°) and latitude (±90°); longitudes beyond 180° are counted "
        "from the other side: subtract 360°, and cut a polygon that crosses the date line at ±180° "
        "into a MultiPolygon (RFC 7946), e.g. ogr2ogr -wrapdateline -t_srs EPSG:4326 out.geojson "
        "in.geojson",
    ),
    "date line": (
        '{"type": "Polygon", "coordinates": [[[179, 0], [-179, 0], [-179, 1], [179, 0]]]}',
        "an edge over the date line",
    ),
}


@pytest.mark.parametrize("case", GEOJSON)
def test_a_file_that_is_no_area_is_named_with_its_key(refused, tmp_path, case):
    content, says = GEOJSON[case]
    (tmp_path / "area.geojson").write_text(content, encoding="utf-8")
    text = observing("geojson_file: area.geojson\nside: right")
    shown = refused(text)
    assert shown.startswith(
        placed(
            text,
            "area.geojson",
            "scene.observation.geojson_file = 'area.geojson' cannot be used: ",
        )
    )
    assert says in shown
    assert "\n" not in shown


def test_an_area_that_is_missing_names_both_places(refused, tmp_path):
    text = observing("geojson_file: etma.geojson\nside: right")
    assert refused(text) == placed(
        text,
        "etma.geojson",
        "scene.observation.geojson_file = 'etma.geojson' is neither a file beside the study, in "
        f"{tmp_path}, nor one that comes with formation-opt (etna.geojson); did you mean "
        "'etna.geojson'? write its path from the folder of the study",
    )


def oem_with_gap():
    """A day of the example's orbit without its lines from 04:00 to 06:00."""
    orbit = build_trajectory(OrbitBlock.model_validate(yaml.safe_load(ORBIT)["orbit"]))
    minutes = np.concatenate([np.arange(0, 240), np.arange(360, 1440)])
    rows = np.hstack(orbit.inertial(60.0 * minutes)) / 1e3
    header = {
        "OBJECT_NAME": "X",
        "OBJECT_ID": "2026-001A",
        "CENTER_NAME": "EARTH",
        "REF_FRAME": "GCRF",
        "TIME_SYSTEM": "UTC",
        "START_TIME": "2026-03-20T12:00:00",
        "STOP_TIME": "2026-03-21T11:59:00",
    }
    lines = [f"{key} = {value}" for key, value in header.items()]
    lines = ["CCSDS_OEM_VERS = 2.0", "META_START", *lines, "META_STOP"]
    for minute, row in zip(minutes, rows, strict=True):
        moment = orbit.epoch + timedelta(minutes=int(minute))
        lines.append(f"{moment:%Y-%m-%dT%H:%M:%S} {' '.join(f'{value:.9f}' for value in row)}")
    return "\n".join(lines) + "\n"


def test_a_gap_in_the_search_says_with_which_keys_to_avoid_it(refused, tmp_path):
    (tmp_path / "gap.oem").write_text(oem_with_gap(), encoding="utf-8")
    text = observing(POINTS, orbit="orbit: {oem_file: gap.oem}\n\n")
    shown = refused(text)
    assert shown.startswith(
        placed(text, "gap.oem", "orbit.oem_file = 'gap.oem' cannot be used: 2026-03-20T1")
    )
    assert shown.endswith(
        "lies in a gap from 2026-03-20T15:59:00Z to 2026-03-20T18:00:00Z of the ephemeris of X; "
        "choose other times, or a message that covers them, or search another time, by start and "
        "search_days of scene.observation"
    )


def test_a_search_between_the_gaps_succeeds(study, tmp_path):
    """The pass of the next morning, which a search from the epoch on does not reach."""
    (tmp_path / "gap.oem").write_text(oem_with_gap(), encoding="utf-8")
    keys = POINTS + "\nfar_incidence_deg: 80\nnear_incidence_deg: 5\nstart: 2026-03-20T19:00"
    text = observing(keys, orbit="orbit: {oem_file: gap.oem}\n\n")
    seen = build_optimize(study(text).study).observation
    assert seen.orbit_source == "ephemeris of X"
    assert seen.orbit_epoch == datetime(2026, 3, 20, 12, tzinfo=UTC)
