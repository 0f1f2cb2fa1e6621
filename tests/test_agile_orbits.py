"""Spotlight and video studies of a place at the nadir, and of an orbit from an OEM file."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import timedelta
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import yaml

from configs import BuildError, StudyError, example_path, example_text, load_study
from configs.placed import PlacedTrajectory, placed_trajectory
from configs.staring import build_spotlight, build_video
from formation_opt.runs import Options
from formation_opt.runs import spotlight as runs_spotlight
from formation_opt.runs import video as runs_video
from insar.observe.earth import to_geodetic


class Kind(NamedTuple):
    """Of a study: block of the pass, what builds it, what computes it."""

    block: str
    build: Callable[..., Any]
    run: Callable[..., Any]


BY_EXAMPLE = {
    "han2016_spotlight": Kind("spotlight", build_spotlight, runs_spotlight.run),
    "liang2018_video": Kind("video", build_video, runs_video.run),
}


def read(data: dict[str, Any], folder: Path) -> Any:
    path = folder / "study.yaml"
    path.write_text(yaml.safe_dump(data), encoding="utf-8")
    return load_study(path).study


def path_of(name: str) -> PlacedTrajectory:
    return placed_trajectory(load_study(example_path(name)).study.orbit, ("orbit",))


def oem_text(path: PlacedTrajectory, half: float) -> str:
    """An ephemeris in steps of a minute, `half` seconds before and after the epoch."""
    times = np.arange(-half, half + 1.0, 60.0)
    stamps = [f"{path.epoch + timedelta(seconds=t):%Y-%m-%dT%H:%M:%S.%f}" for t in times]
    head = (
        "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-03-20T00:00:00\nORIGINATOR = TEST\n"
        "META_START\nOBJECT_NAME = X\nOBJECT_ID = 2026-001A\nCENTER_NAME = EARTH\n"
        f"REF_FRAME = GCRF\nTIME_SYSTEM = UTC\nSTART_TIME = {stamps[0]}\n"
        f"STOP_TIME = {stamps[-1]}\nMETA_STOP\n"
    )
    states = np.concatenate(path.inertial(times), axis=-1) / 1e3
    lines = (
        f"{stamp} {' '.join(f'{value:.9f}' for value in state)}"
        for stamp, state in zip(stamps, states, strict=True)
    )
    return head + "\n".join(lines) + "\n"


@pytest.mark.parametrize("name", ["han2016_spotlight", "liang2018_video"])
def test_a_place_right_below_the_orbit_is_seen_where_it_is_asked_for(name, tmp_path):
    """The nadir is no singularity of the attitude; that range resolves nothing there is said."""
    kind, build, run = BY_EXAMPLE[name]
    data = yaml.safe_load(example_text(name))
    del data["claims"]
    # An orbit's foot point is at zero Doppler a little later: the Earth is no sphere.
    below = to_geodetic(path_of(name).earth_fixed(0.0).position)
    data[kind]["target"] = {
        "latitude_deg": math.degrees(below.latitude),
        "longitude_deg": math.degrees(below.longitude),
    }
    data[kind]["side"] = "either"
    data["samples"] = 41
    with pytest.raises(BuildError, match=r"satellite's nadir, .*; search longer, or allow other"):
        build(read(data, tmp_path))
    data[kind]["near_incidence_deg"] = 0
    study = read(data, tmp_path)
    result = run(study, build(study), Options()).result
    assert result.plan.incidence < math.radians(0.3)
    assert np.all(result.profile.solved)
    assert "from the satellite's nadir at zero Doppler: on the ground range resolves" in " ".join(
        result.warnings
    )


@pytest.mark.parametrize("name", ["han2016_spotlight", "liang2018_video"])
def test_an_ephemeris_gives_what_its_elements_give(name, tmp_path):
    """The whole study from a CCSDS OEM file, in steps of a minute, cut close about the pass."""
    kind, build, run = BY_EXAMPLE[name]
    elements = load_study(example_path(name)).study
    data = yaml.safe_load(example_text(name))
    (tmp_path / "orbit.oem").write_text(oem_text(path_of(name), 600.0), encoding="utf-8")
    data["orbit"] = {"oem_file": "orbit.oem"}
    data["inferred"] = [key for key in data["inferred"] if not key.startswith("orbit.")]
    del data[kind]["start"]
    found = read(data, tmp_path)
    one, two = (run(study, build(study), Options()).result for study in (found, elements))
    assert abs((one.plan.epoch - two.plan.epoch).total_seconds()) < 1e-4
    assert one.plan.incidence == pytest.approx(two.plan.incidence, abs=1e-7)
    for angle in ("yaw", "pitch", "roll"):
        # An interpolation of ninth degree keeps micrometers to millimeters over a minute.
        np.testing.assert_allclose(
            getattr(one.profile, angle), getattr(two.profile, angle), rtol=0, atol=1e-6
        )
    assert [claim.verdict for claim in one.claims] == [claim.verdict for claim in two.claims]
    assert one.warnings == two.warnings


def test_a_formation_does_not_measure_heights_at_the_nadir(tmp_path):
    data = yaml.safe_load(example_text("three_sat_video"))
    data["scene"]["video"]["near_incidence_deg"] = 0
    with pytest.raises(StudyError, match="near_incidence_deg = 0 must be a number from 1 to 85"):
        read(data, tmp_path)
