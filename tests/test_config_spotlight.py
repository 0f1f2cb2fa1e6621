"""Studies of spotlight, and its scenes: what they become, the shipped ones, what is refused."""

from __future__ import annotations

import math
import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from configs import (
    BuildError,
    OptimizeStudy,
    SpotlightStudy,
    StudyError,
    effective_text,
    example_path,
    example_text,
    load_study,
)
from configs.agile_claims import SPOTLIGHT_UNITS as UNITS
from configs.build import build_optimize
from configs.staring import build_spotlight
from formation_opt.runs import Options
from formation_opt.runs import spotlight as runs_spotlight
from insar import LookSide, Relation, Verdict
from insar.observe.agile.spotlight import spotlight, spotlight_scene
from insar.observe.agile.spotlight_claims import SpotlightClaim, SpotlightQuantity, judge_spotlight
from insar.observe.agile.spotlight_plan import plan_spotlight
from insar.observe.agile.staring import StaringScene
from insar.observe.scenes.passes import Direction

ETNA = {"latitude_deg": 37.751, "longitude_deg": 14.993, "height_m": 3300}
ORBIT = {
    "altitude_km": 514,
    "inclination_deg": 97.44,
    "node_local_time": "18:00",
    "epoch": "2026-03-20T12:00:00Z",
}
MINIMAL = {
    "kind": "spotlight",
    "orbit": ORBIT,
    "radar": {"wavelength_m": 0.031},
    "spotlight": {"target": ETNA, "resolution_m": 0.5},
}
HAN = example_text("han2016_spotlight")
SCENE = example_text("three_sat_spotlight")


def built(spotlight=None, **keys):
    block = MINIMAL["spotlight"] | (spotlight or {})
    return build_spotlight(SpotlightStudy.model_validate(MINIMAL | {"spotlight": block} | keys))


# --- requests ------------------------------------------------------------------------------------


def test_a_study_that_says_little_stares_with_a_beam_along_the_axis():
    setup = built()
    request = setup.request
    assert (request.weighting, request.sliding_factor, request.scene_length) == (1.0, 0.0, 0.0)
    assert (request.side, request.direction, request.number) == (None, Direction.EITHER, 1)
    assert (request.off_axis, request.phase_center) == (0.0, (0, 0, 0))
    assert request.duration is None
    assert request.agility is not None
    assert request.agility.max_rate == request.agility.max_acceleration == math.inf
    assert (setup.samples, setup.claims) == (1001, ())
    assert setup.orbit.altitude == pytest.approx(514e3)


def test_every_key_reaches_the_request():
    setup = built(
        spotlight={
            "side": "left",
            "start": "2026-03-21T12:00:00Z",
            "search_days": 5,
            "direction": "descending",
            "pass_number": 2,
            "near_incidence_deg": 25,
            "far_incidence_deg": 50,
            "weighting_factor": 1.2,
            "sliding_factor": 0.4,
            "scene_length_m": 9000,
        },
        antenna={"off_axis_deg": -8, "phase_center_m": [1, 2, 3]},
        agility={"max_rate_deg_s": 2, "max_acceleration_deg_s2": [0.1, 0.2, 0.3]},
        duration_s=30,
        samples=11,
    )
    request = setup.request
    assert (request.start, request.stop) == (86_400.0, 6 * 86_400.0)
    assert (request.side, request.direction, request.number) == (
        LookSide.LEFT,
        Direction.DESCENDING,
        2,
    )
    angles = (request.latitude, request.longitude, request.near_incidence, request.far_incidence)
    np.testing.assert_allclose(np.degrees(angles), [37.751, 14.993, 25, 50])
    assert (request.height, request.wavelength, request.resolution) == (3300, 0.031, 0.5)
    assert (request.weighting, request.sliding_factor, request.scene_length) == (1.2, 0.4, 9000)
    assert math.degrees(request.off_axis) == pytest.approx(-8)
    assert request.phase_center == (1, 2, 3)
    assert (request.duration, setup.samples) == (30, 11)
    assert request.agility is not None
    assert np.degrees(request.agility.max_rate) == pytest.approx(2)
    np.testing.assert_allclose(np.degrees(request.agility.max_acceleration), [0.1, 0.2, 0.3])


def test_a_claim_is_counted_in_the_unit_of_its_quantity():
    claims = [
        {"text": "t", "printed": "p", "quantity": quantity, "value": 2, "tolerance": 1, "note": "n"}
        for quantity in UNITS
    ]
    made = built(claims=claims).claims
    assert [claim.quantity for claim in made] == list(SpotlightQuantity)
    for claim in made:
        assert claim.scale == pytest.approx(math.radians(1) if "°" in claim.unit else 1.0)
        assert (claim.value, claim.tolerance) == pytest.approx((2 * claim.scale, claim.scale))
        assert (claim.relation, claim.note) == (Relation.EQUALS, "n")


def test_claims_are_judged_by_what_is_computed():
    setup = built(antenna={"off_axis_deg": 5, "phase_center_m": [1, 0, 1]}, samples=101)
    result = spotlight(setup.request, 101)
    profile = result.profile
    expected = {
        SpotlightQuantity.YAW_RANGE: profile.yaw.max() - profile.yaw.min(),
        SpotlightQuantity.PITCH_RANGE: profile.pitch.max() - profile.pitch.min(),
        SpotlightQuantity.ROLL_RANGE: profile.roll.max() - profile.roll.min(),
        SpotlightQuantity.LARGEST_RATE: math.sqrt(np.max(np.sum(profile.rate_inertial**2, -1))),
        SpotlightQuantity.LARGEST_ACCELERATION: math.sqrt(
            np.max(np.sum(profile.acceleration_inertial**2, -1))
        ),
        SpotlightQuantity.IMAGING_TIME: result.plan.imaging_time,
        SpotlightQuantity.GROUND_SPEED: result.plan.ground_speed,
        SpotlightQuantity.BANDWIDTH: result.history.bandwidth,
        SpotlightQuantity.RESOLUTION: result.history.resolution,
        SpotlightQuantity.AIM_ERROR: result.aim_error.closed_form.max(),
    }
    for quantity, value in expected.items():
        claim = SpotlightClaim(text="t", printed="p", quantity=quantity, value=2 * value)
        found = judge_spotlight(claim, result)
        assert found.computed == pytest.approx(value, rel=1e-12), quantity
        assert found.verdict is Verdict.FAILS


# --- the shipped example -------------------------------------------------------------------------


def test_every_printed_figure_of_han_holds_and_its_inputs_are_called_inferred():
    study = load_study(example_path("han2016_spotlight")).study
    outcome = runs_spotlight.run(study, build_spotlight(study), Options())
    assert len(outcome.result.claims) == 7
    assert {claim.verdict for claim in outcome.result.claims} == {Verdict.HOLDS}
    assert outcome.result.warnings == ()
    assert "inferred" in study.description
    # The aim point is that of the look angle, at the epoch.
    assert abs(outcome.result.plan.time) < 1e-3
    assert math.degrees(outcome.result.plan.look_angle) == pytest.approx(53.7721, abs=1e-4)


def test_the_terminal_says_when_how_and_what_it_takes():
    study = load_study(example_path("han2016_spotlight")).study
    summary = runs_spotlight.run(study, build_spotlight(study), Options()).summary
    rows = {label: value for label, (value,) in summary.rows}
    assert rows["zero Doppler"] == "2016-07-01 00:00:00 UTC"
    assert rows["pass"] == "1 of 1, flying northward, looking left"
    assert rows["resolution in azimuth"] == "0.600 m of 12625 Hz"
    assert rows["agility"] == "kept"


def test_agility_that_does_not_do_is_said():
    study = SpotlightStudy.model_validate(MINIMAL | {"agility": {"max_rate_deg_s": 0.01}})
    outcome = runs_spotlight.run(study, build_spotlight(study), Options())
    assert dict(outcome.summary.rows)["agility"] == ("exceeded",)
    assert "faster" in " ".join(outcome.result.warnings)


# --- a formation in spotlight mode ---------------------------------------------------------------


def formation(block, mode="spotlight"):
    study = load_study(example_path("three_sat_spotlight")).study.model_dump(exclude_none=True)
    study["scene"] = {mode: block}
    return build_optimize(OptimizeStudy.model_validate(study))


def test_a_formation_sees_the_place_from_the_whole_aperture():
    setup = build_optimize(load_study(example_path("three_sat_spotlight")).study)
    scene = setup.problem.scene
    assert len(scene) == 11
    assert isinstance(setup.observation, StaringScene)
    assert setup.observation.scene is scene
    # The same as the spotlight study of that place, computed on its own.
    alone = build_spotlight(
        SpotlightStudy.model_validate(
            MINIMAL
            | {
                "orbit": ORBIT | {"eccentricity": 0.00107, "argument_of_perigee_deg": 90},
                "spotlight": {
                    "target": ETNA,
                    "side": "right",
                    "resolution_m": 0.25,
                    "weighting_factor": 1.1,
                },
            }
        )
    )
    seen = spotlight_scene(spotlight(alone.request, 3), 11)
    np.testing.assert_array_equal(scene.line_of_sight, seen.scene.line_of_sight)
    np.testing.assert_array_equal(scene.times, seen.scene.times)
    assert setup.orbit == seen.orbit
    plan = plan_spotlight(alone.request)
    assert scene.times[-1] == pytest.approx(plan.imaging_time, rel=1e-9)
    # From ahead to behind.
    ahead = np.sum(scene.line_of_sight * scene.velocity_direction, axis=-1)
    assert ahead[0] > 0.02
    assert abs(ahead[5]) < 1e-6
    assert np.all(np.diff(ahead) < 0.0)


def test_a_formation_films_the_place_of_the_other_example_for_longer():
    still, film = (
        build_optimize(load_study(example_path(name)).study).problem.scene
        for name in ("three_sat_spotlight", "three_sat_video")
    )
    # The same pass: at zero Doppler, in the middle of both, the geometry is one.
    for one in ("slant_range", "incidence", "look_angle"):
        assert getattr(film, one)[6] == pytest.approx(getattr(still, one)[5], rel=1e-9)
    np.testing.assert_allclose(film.times, np.arange(0, 130, 10), atol=1e-6)
    # From zero Doppler on the range grows both ways: the height error of each frame is its own.
    assert np.all(np.diff(film.slant_range[6:]) > 0)
    assert np.all(np.diff(film.slant_range[:7]) < 0)
    assert film.slant_range[0] > 1.15 * film.slant_range[6]
    assert np.ptp(film.slant_range) > 10 * np.ptp(still.slant_range)


def test_a_film_is_as_long_as_asked_for():
    block = {"target": ETNA, "duration_s": 60, "segments": 5, "slope_deg": 3}
    scene = formation(block, "video").problem.scene
    np.testing.assert_allclose(scene.times, [0, 15, 30, 45, 60], atol=1e-6)
    np.testing.assert_allclose(np.degrees(scene.slope), 3)


# --- what is refused -----------------------------------------------------------------------------

_SPOTLIGHT_KEYS = (
    "target, side, start, search_days, direction, pass_number, near_incidence_deg, "
    "far_incidence_deg, resolution_m, weighting_factor, sliding_factor, scene_length_m"
)

# (study, old, new, where the message points, what it says)
WRONG = {
    "an orbit above no place": (
        HAN,
        HAN[HAN.index("  node_longitude_deg") : HAN.index("  j2: false")],
        "",
        "orbit:",
        "orbit lacks an epoch, without which nobody knows when the satellite is above the targets; "
        "add epoch: 2026-11-23T05:07:00Z, or give tle, tle_file or oem_file",
    ),
    "no target": (
        HAN,
        "  target: {latitude_deg: 72.6706337, longitude_deg: 126.0000003}",
        "  #",
        "spotlight:                #",
        "spotlight.target is missing (The place that the beam stays on); add this block as in the "
        "example that formation-opt --new han2016_spotlight prints",
    ),
    "swapped incidences": (
        HAN,
        "far_incidence_deg: 70   #",
        "near_incidence_deg: 70\n  far_incidence_deg: 20   #",
        "70\n",
        "spotlight.near_incidence_deg = 70 must be below far_incidence_deg, 20; check that the two "
        "are not swapped",
    ),
    "length of a staring scene": (
        HAN,
        "  sliding_factor: 0 ",
        "  scene_length_m: 5000\n  sliding_factor: 0 ",
        "5000",
        "spotlight.scene_length_m = 5000 needs a beam that slides: without it the scene is as long "
        "as the beam is wide; add sliding_factor: 0.5, or remove it",
    ),
    "rate in radians": (
        HAN,
        "max_rate_deg_s: 1.0",
        "max_rate_deg_s: 0",
        "0\n  max_acc",
        "agility.max_rate_deg_s = 0 must be a number above 0 and at most 90 degrees per second, or "
        "a list of 3 entries, each a number above 0 and at most 90 degrees per second; check the "
        "value and its unit",
    ),
    "two limits": (
        HAN,
        "max_acceleration_deg_s2: 0.1",
        "max_acceleration_deg_s2: [0.1, 0.1]",
        "[0.1, 0.1]",
        "agility.max_acceleration_deg_s2 = [0.1, 0.1] must be a number above 0 and at most 90 "
        "degrees per second squared, or a list of 3 entries, each a number above 0 and at most 90 "
        "degrees per second squared; add or remove entries",
    ),
    "unknown quantity": (
        HAN,
        "quantity: bandwidth",
        "quantity: bandwith",
        "bandwith",
        "claims[#5].quantity = 'bandwith' must be one of yaw_range, pitch_range, roll_range, "
        "largest_rate, largest_acceleration, imaging_time, first_order_time, ground_speed, "
        "bandwidth, resolution, aim_error; did you mean 'bandwidth'?",
    ),
    "unknown key": (
        HAN,
        "  weighting_factor: 1.098781",
        "  weighting: 1.098781",
        "weighting:",
        "spotlight.weighting is not a known key; did you mean 'weighting_factor'? the keys of "
        f"spotlight are {_SPOTLIGHT_KEYS}",
    ),
    "inferred input that is not there": (
        HAN,
        "  - orbit.altitude_km\n",
        "  - orbit.altitud_km\n",
        "orbit.altitud_km",
        "inferred[#1] = 'orbit.altitud_km' names no input of the study: there is no 'altitud_km'; "
        "did you mean 'altitude_km'? write keys with points between, as in orbit.altitude_km",
    ),
    "resolution out of reach": (
        HAN.replace("wavelength_m: 0.0312283810", "wavelength_m: 0.24"),
        "resolution_m: 0.6 ",
        "resolution_m: 0.05 ",
        "0.05 ",
        "spotlight.resolution_m = 0.05 cannot be used: is out of reach: while the aim point sees "
        "the satellite, ",
    ),
    "never seen": (
        HAN,
        "  far_incidence_deg: 70 ",
        "  far_incidence_deg: 50 ",
        "spotlight:                #",
        "spotlight cannot be used: the aim point is not imaged from 2016-06-30 23:50:00 UTC to "
        "2016-07-01 00:18:48 UTC: the nearest of 1 pass sees it at incidence 63.39°, outside "
        "20.00° to 50.00°, too near to the horizon; search longer, or allow other incidences",
    ),
    "wrong side": (
        HAN,
        "  side: left ",
        "  side: right ",
        "spotlight:                #",
        "spotlight cannot be used: the aim point is not imaged from 2016-06-30 23:50:00 UTC to "
        "2016-07-01 00:18:48 UTC: it is in reach once, but on the left of the flight direction; "
        "look left, to either side, or search longer",
    ),
    "pass that there is not": (
        HAN,
        "  search_days: 0.02 ",
        "  pass_number: 3\n  search_days: 0.02 ",
        "3\n",
        "spotlight.pass_number = 3 cannot be used: the aim point can be imaged on 1 pass in the "
        "searched time; take it, or search longer",
    ),
    "scene of a formation above no place": (
        SCENE,
        '  node_local_time: "18:00"\n  epoch: "2026-03-20T12:00:00Z"\n',
        "",
        "orbit:",
        "orbit lacks an epoch, without which nobody knows when the satellite is above the targets; "
        "add epoch: 2026-11-23T05:07:00Z, or give tle, tle_file or oem_file",
    ),
    "scene that is never seen": (
        SCENE,
        "search_days: 11 ",
        "search_days: 0.01 ",
        "spotlight:",
        "scene.spotlight cannot be used: the aim point is not imaged from 2026-03-20 12:00:00 UTC "
        "to 2026-03-20 12:14:24 UTC: it never sees the satellite above its horizon at zero "
        "Doppler; the satellite itself reaches latitudes of ±54.10°; search longer, or change the "
        "orbit",
    ),
    "scene with a pass that there is not": (
        SCENE,
        "    search_days: 11 ",
        "    pass_number: 99\n    search_days: 11 ",
        "99",
        "scene.spotlight.pass_number = 99 cannot be used: the aim point can be imaged on",
    ),
    "scene in layover": (
        SCENE,
        "    segments: 11 ",
        "    slope_deg: 59\n    segments: 11 ",
        "59\n",
        "scene.spotlight.slope_deg = 59 cannot be used: lies in layover or shadow, where no phase "
        "is measured: at incidences of 40.01° to 40.05° it must be between -49.95° and 40.01°; "
        "choose a gentler slope, or 0",
    ),
    "film beyond the horizon": (
        SCENE,
        SCENE[SCENE.index("  spotlight:") : SCENE.index("errors:")],
        "  video:\n    target: {latitude_deg: 37.751, longitude_deg: 14.993}\n"
        "    duration_s: 1800\n\n",
        "video:",
        "scene.video cannot be used: the place sees the satellite in 3 of 11 segments only, over "
        "1800 s; take a shorter time",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_spotlight_is_named_with_place_limit_and_remedy(tmp_path, monkeypatch, name):
    base, old, new, where, says = WRONG[name]
    assert base.count(old) == 1, old
    text = base.replace(old, new)
    monkeypatch.chdir(tmp_path)
    Path("my.yaml").write_text(text, encoding="utf-8")
    read = refusal()
    start = base.index(old)
    before = text[: text.index(where, start) if where in text[start:] else text.index(where)]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    assert read.startswith(f"my.yaml:{line}:{column}: {says}"), read


def refusal() -> str:
    """What the author of `my.yaml` reads, on loading or on building."""
    try:
        loaded = load_study(Path("my.yaml"))
    except StudyError as error:
        return str(error)
    build = build_spotlight if loaded.study.kind == "spotlight" else build_optimize
    with pytest.raises(BuildError) as error:
        build(loaded.study)
    return str(loaded.located(error.value))


def test_two_line_elements_date_the_pass():
    lines = (
        "1 31698U 07026A   16330.34007000  .00000500  00000-0  30000-4 0  9990",
        "2 31698  97.4460 338.0000 0001800  90.0000 270.0000 15.19150000520000",
    )
    setup = built(orbit={"tle": [_with_checksum(line) for line in lines]})
    plan = plan_spotlight(setup.request)
    assert datetime(2016, 11, 25, tzinfo=UTC) < plan.epoch < datetime(2016, 12, 7, tzinfo=UTC)
    assert 20.0 <= math.degrees(plan.incidence) <= 55.0


def _with_checksum(line: str) -> str:
    digits = sum(int(d) for d in re.findall(r"\d", line[:68])) + line[:68].count("-")
    return f"{line[:68]}{digits % 10}"


def test_the_effective_text_says_everything(tmp_path):
    original = load_study(example_path("han2016_spotlight")).study
    text = effective_text(original)
    (tmp_path / "copy.yaml").write_text(text, encoding="utf-8")
    assert load_study(tmp_path / "copy.yaml").study == original
    assert "direction: either" in text
    assert "pass_number: 1" in text
