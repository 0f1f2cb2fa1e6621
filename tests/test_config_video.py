"""Studies of video: what they become, the shipped one, and what is refused."""

from __future__ import annotations

import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest

from configs import (
    BuildError,
    StudyError,
    VideoStudy,
    effective_text,
    example_path,
    example_text,
    load_study,
)
from configs.agile_claims import VIDEO_UNITS, VideoClaimBlock
from configs.staring import build_video
from formation_opt.runs import Options
from formation_opt.runs import video as runs_video
from insar import LookSide
from insar.observe.agile.video_claims import VideoClaim, VideoQuantity, judge_video
from insar.observe.agile.video_request import YawLaw
from insar.observe.scenes.passes import Direction

LIANG = example_text("liang2018_video")
MINIMAL = {
    "kind": "video",
    "orbit": {
        "altitude_km": 514,
        "inclination_deg": 97.44,
        "node_local_time": "18:00",
        "epoch": "2026-03-20T12:00:00Z",
    },
    "radar": {"wavelength_m": 0.031},
    "video": {
        "target": {"latitude_deg": 37.751, "longitude_deg": 14.993, "height_m": 3300},
        "resolution_m": 1,
        "frame_rate_hz": 0.5,
        "duration_s": 20,
    },
    "beam": {"azimuth_beamwidth_deg": 0.4, "elevation_beamwidth_deg": 1.5},
}


def built(video=None, **keys):
    block = MINIMAL["video"] | (video or {})
    return build_video(VideoStudy.model_validate(MINIMAL | {"video": block} | keys))


# --- requests ------------------------------------------------------------------------------------


def test_a_study_that_says_little_holds_the_azimuth_trace_from_zero_doppler_on():
    setup = built()
    request = setup.request
    assert (request.yaw_law, request.reference_time) == (YawLaw.AZIMUTH_TRACE, 0.0)
    assert (request.max_overlap, request.pointing_error) == (0.0, (0.0, 0.0, 0.0))
    assert (request.side, request.direction, request.number) == (None, Direction.EITHER, 1)
    assert request.agility is not None
    assert request.agility.max_rate == math.inf
    assert (setup.samples, setup.footprints) == (1001, 101)
    assert setup.orbit.altitude == pytest.approx(514e3)


@pytest.mark.parametrize("law", list(YawLaw))
def test_every_yaw_law_has_a_name(law):
    assert built(yaw={"law": law.value}).request.yaw_law is law


def test_every_key_reaches_the_request():
    setup = built(
        video={
            "side": "right",
            "start": "2026-03-21T12:00:00Z",
            "search_days": 20,
            "direction": "descending",
            "pass_number": 2,
            "near_incidence_deg": 25,
            "far_incidence_deg": 50,
            "max_overlap": 0.25,
        },
        yaw={"law": "range_trace", "reference_time_s": -10},
        pointing_error_deg=[0.1, 0.2, 0.3],
        agility={"max_rate_deg_s": [1, 2, 3]},
        samples=11,
        footprints=7,
    )
    request = setup.request
    assert (request.start, request.stop) == (86_400.0, 21 * 86_400.0)
    assert (request.side, request.direction, request.number) == (
        LookSide.RIGHT,
        Direction.DESCENDING,
        2,
    )
    angles = (
        request.latitude,
        request.longitude,
        request.near_incidence,
        request.far_incidence,
        request.azimuth_beamwidth,
        request.elevation_beamwidth,
        *request.pointing_error,
    )
    expected = [37.751, 14.993, 25, 50, 0.4, 1.5, 0.1, 0.2, 0.3]
    np.testing.assert_allclose(np.degrees(angles), expected)
    assert (request.height, request.wavelength, request.resolution) == (3300, 0.031, 1)
    assert (request.frame_rate, request.duration, request.max_overlap) == (0.5, 20, 0.25)
    assert (request.yaw_law, request.reference_time) == (YawLaw.RANGE_TRACE, -10)
    assert request.agility is not None
    np.testing.assert_allclose(np.degrees(request.agility.max_rate), [1, 2, 3])
    assert (setup.samples, setup.footprints) == (11, 7)


# --- the shipped example -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sasebo():
    study = load_study(example_path("liang2018_video")).study
    return runs_video.run(study, build_video(study), Options())


def test_the_film_of_sasebo_is_that_of_the_reference(sasebo):
    """A reference calculation has a pitch of about 49°, and rates of 0.67 and 0.72 °/s."""
    profile, plan = sasebo.result.profile, sasebo.result.plan
    assert abs(plan.time) < 1e-2
    assert math.degrees(plan.look_angle) == pytest.approx(30.0, abs=1e-3)
    # The Earth turns below: ahead it takes 3° more than behind.
    np.testing.assert_allclose(np.degrees(profile.pitch[[0, -1]]), [48.8, -45.8], atol=0.1)
    rates = (profile.rate_orbit, profile.rate_inertial)
    peaks = [np.degrees(np.linalg.norm(rate, axis=-1).max()) for rate in rates]
    # The reference holds no direction on the ground; the yaw of the trace adds a little.
    assert peaks == pytest.approx([0.67, 0.72], abs=0.02)
    assert np.degrees(np.abs(sasebo.result.distortion.azimuth_trace).max()) < 1e-9


def test_what_the_paper_says_is_judged(sasebo):
    """Four statements hold, one of them by construction, four do not; each says why."""
    claims = {claim.text: claim for claim in sasebo.result.claims}
    assert len(claims) == 8
    verdicts = [claim.verdict.value for claim in claims.values()]
    assert verdicts.count("holds") == 4
    assert verdicts.count("does not hold") == 4
    assert [text for text, claim in claims.items() if claim.fitted] == ["Moment of zero Doppler"]
    assert all(claim.note or claim.fitted for claim in claims.values())
    # The measures against what the result has.
    law = next(law for law in sasebo.result.laws if law.law is YawLaw.AZIMUTH_TRACE)
    computed = {claim.text.split("; ")[-1]: claim.computed for claim in claims.values()}
    assert computed["trace of the range plane"] == pytest.approx(math.degrees(law.range_trace))
    assert computed["longest diameter"] == pytest.approx(math.degrees(law.major_axis))
    assert computed["Moment of zero Doppler"] == pytest.approx(29383.0, abs=0.01)
    speed, frames = sasebo.result.plan.ground_speed, sasebo.result.frames
    # Of small aperture angles: 3e-5.
    assert computed[
        "Frame length by eq. 3, at zero Doppler, by the one that the resolution needs"
    ] == pytest.approx(frames.effective_speed / speed, rel=1e-4)


@pytest.mark.parametrize("quantity", VideoQuantity)
def test_every_quantity_of_a_film_is_computed(quantity, sasebo):
    block = VideoClaimBlock(text="a", printed="b", quantity=quantity.value, value=1.0)
    counted = VIDEO_UNITS[block.quantity]
    claim = VideoClaim(quantity=quantity, **block.figure(counted))
    judged = judge_video(claim, sasebo.result)
    assert math.isfinite(judged.computed)
    assert judged.unit == counted.unit
    lost = dataclasses.replace(
        sasebo.result,
        profile=sasebo.result.profile._replace(
            pitch=np.full_like(sasebo.result.profile.pitch, np.nan)
        ),
    )
    if quantity in (VideoQuantity.LARGEST_PITCH, VideoQuantity.PITCH_TO_ROLL):
        assert judge_video(claim, lost).verdict.value == "not computable"


def test_what_is_not_the_papers_is_called_inferred():
    study = load_study(example_path("liang2018_video")).study
    assert "inferred" in study.description
    printed = [line for line in LIANG.splitlines() if "# printed" in line]
    assert [line.split(":")[0].strip() for line in printed] == ["epoch", "duration_s"]
    named = dict(study.inferred_inputs)
    assert named["orbit.altitude_km"] == "514"
    assert named["video.target.latitude_deg"] == "33.16"  # a block is named key by key
    marked = {
        line.split(":")[0].strip()
        for line in LIANG[: LIANG.index("inferred:   ")].splitlines()
        if re.search(r": .*# inferred", line)
    }
    left_out = {"target", "max_overlap", "pointing_error_deg"}
    assert marked - left_out <= {part for key in named for part in key.split(".")}


def test_the_terminal_says_what_the_law_leaves(sasebo):
    assert sasebo.summary.headings == ("azimuth trace",)
    rows = {label: value for label, (value,) in sasebo.summary.rows}
    assert rows["zero Doppler"] == "2016-11-25 08:09:43 UTC"
    assert rows["frames"].startswith("201, ")
    assert rows["agility"] == "kept"
    assert float(rows["range trace turns by"].rstrip("°")) > 10.0


# --- what is refused -----------------------------------------------------------------------------

# (old, new, where the message points, what it says)
WRONG = {
    "no beam": (
        LIANG[LIANG.index("beam:") : LIANG.index("yaw:")],
        "",
        "kind:",
        "beam is missing (The beam, for the footprints); add this block as in the example that "
        "formation-opt --new liang2018_video prints",
    ),
    "unknown law": (
        "law: azimuth_trace ",
        "law: azimuth ",
        "azimuth ",
        "yaw.law = 'azimuth' must be one of none, shortest_rotation, azimuth_trace, range_trace, "
        "major_axis; did you mean 'azimuth_trace'?",
    ),
    "frames beyond the limit": (
        "  duration_s: 200         # printed: 100 s before and after zero Doppler\n"
        "  resolution_m: 1         # inferred; of every frame, in azimuth on the ground\n"
        "  frame_rate_hz: 1 ",
        "  duration_s: 300\n  resolution_m: 1\n  frame_rate_hz: 90 ",
        "90 ",
        "video.frame_rate_hz = 90 times duration_s makes 2.7e+04 frames, and 20000 is the limit; "
        "take fewer frames, or a shorter film",
    ),
    "reference outside the film": (
        "reference_time_s: 0 ",
        "reference_time_s: 150 ",
        "150 ",
        "yaw.reference_time_s = 150 lies outside the film, which is from -100 to 100 s about zero "
        "Doppler; choose a moment of the film",
    ),
    "never seen": (
        "  side: right ",
        "  side: left ",
        "video:",
        "video cannot be used: the aim point is not imaged from 2016-11-25 08:00:00 UTC to "
        "2016-11-25 08:28:48 UTC: it is in reach once, but on the right of the flight "
        "direction; look right, to either side, or search longer",
    ),
    "pass that there is not": (
        "  search_days: 0.02\n",
        "  search_days: 0.02\n  pass_number: 2\n",
        "2\n  duration",
        "video.pass_number = 2 cannot be used: the aim point can be imaged on 1 pass in the "
        "searched time; take it, or search longer",
    ),
    "beamwidth in radians": (
        "azimuth_beamwidth_deg: 0.4",
        "azimuth_beamwidth_deg: 0",
        "0\n",
        "beam.azimuth_beamwidth_deg = 0 must be a number above 0 and at most 30 degrees; check the "
        "value and its unit",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_video_is_named_with_place_limit_and_remedy(tmp_path, monkeypatch, name):
    old, new, where, says = WRONG[name]
    assert LIANG.count(old) == 1, old
    text = LIANG.replace(old, new)
    monkeypatch.chdir(tmp_path)
    Path("my.yaml").write_text(text, encoding="utf-8")
    start = LIANG.index(old)
    before = text[: text.index(where, start) if where in text[start:] else text.index(where)]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    assert refusal() == f"my.yaml:{line}:{column}: {says}"


def refusal() -> str:
    """What the author of `my.yaml` reads, on loading or on building."""
    try:
        loaded = load_study(Path("my.yaml"))
    except StudyError as error:
        return str(error)
    with pytest.raises(BuildError) as error:
        build_video(loaded.study)
    return str(loaded.located(error.value))


def test_an_ephemeris_that_ends_in_the_film_is_blamed(tmp_path, monkeypatch):
    """The pass is known, and 100 s after it are not."""
    monkeypatch.chdir(tmp_path)
    Path("short.oem").write_text(ephemeris(seconds=60), encoding="utf-8")
    start, stop = LIANG.index("orbit:"), LIANG.index("radar:")
    text = LIANG.replace(LIANG[start:stop], "orbit:\n  oem_file: short.oem\n\n")
    Path("my.yaml").write_text(text, encoding="utf-8")
    assert refusal().startswith("my.yaml:")
    assert "the orbit is needed from" in refusal()
    assert "image for a shorter time, or take an ephemeris that reaches farther" in refusal()


def ephemeris(*, seconds: int) -> str:
    """The orbit of the example as an OEM, until that many seconds after zero Doppler."""
    orbit = build_video(load_study(example_path("liang2018_video")).study).request.trajectory
    times = np.arange(-600, seconds + 1, 20.0)
    states = orbit.inertial(times)
    stamps = np.datetime64("2016-11-25T08:09:43") + times.astype("timedelta64[s]")
    rows = [
        " ".join([str(stamp), *(f"{value / 1e3:.9f}" for value in (*position, *velocity))])
        for stamp, position, velocity in zip(stamps, states.position, states.velocity, strict=True)
    ]
    head = f"""CCSDS_OEM_VERS = 2.0
CREATION_DATE = 2016-11-25T00:00:00
ORIGINATOR = TEST
META_START
OBJECT_NAME = TEST
OBJECT_ID = 2016-000A
CENTER_NAME = EARTH
REF_FRAME = GCRF
TIME_SYSTEM = UTC
START_TIME = {stamps[0]}
STOP_TIME = {stamps[-1]}
INTERPOLATION = HERMITE
INTERPOLATION_DEGREE = 7
META_STOP
"""
    return head + "\n".join(rows) + "\n"


def test_the_effective_text_says_everything(tmp_path):
    original = load_study(example_path("liang2018_video")).study
    text = effective_text(original)
    (tmp_path / "copy.yaml").write_text(text, encoding="utf-8")
    assert load_study(tmp_path / "copy.yaml").study == original
    assert "direction: either" in text


def test_a_satellite_that_falls_behind_the_earth_is_refused(tmp_path):
    """At geosynchronous height the line of zero Doppler may move backward over the place."""
    text = example_text("liang2018_video")
    for key, value in (("altitude_km", 35786), ("inclination_deg", 60), ("search_days", 5)):
        text = re.sub(rf"{key}: \S+", f"{key}: {value}", text, count=1)
    file = tmp_path / "my.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(BuildError, match="falls behind the Earth's rotation"):
        build_video(load_study(file).study)
