"""Orbits in a study: what their keys mean, the files they name, and what is refused."""

from __future__ import annotations

import hashlib
import math
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from configs import BuildError, StudyError, effective_text, example_text, load_study
from configs.build import build_evaluate
from configs.orbits import OrbitBlock, build_reference, build_trajectory
from configs.steered import build_steering
from formation import ElementKind, Ephemeris, KeplerianOrbit, Orbit, TwoLineOrbit
from formation.timescales import DAY

EPOCH = "2026-03-20T12:00:00Z"
CIRCLE = {"altitude_km": 514, "inclination_deg": 97.44}
TWO_BODIES = CIRCLE | {"eccentricity": 0.05, "argument_of_perigee_deg": 40, "j2": False}

# The example of the article on two-line elements in Wikipedia: the ISS, 2008-09-20.
TLE = (
    "1 25544U 98067A   08264.51782528 -.00002182  00000-0 -11606-4 0  2927",
    "2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391563537",
)
EVALUATE = example_text("evaluate_example")
ORBIT_LINE = "orbit: {altitude_km: 514, inclination_deg: 97.44}\n"


def trajectory(**keys):
    return build_trajectory(OrbitBlock.model_validate(keys))


def with_orbit(text):
    """The evaluated example with other text for its orbit."""
    assert EVALUATE.count(ORBIT_LINE) == 1
    return EVALUATE.replace(ORBIT_LINE, text)


def strip_only(text):
    """The same without satellites whose velocity belongs to the old orbit."""
    return text.replace("[0, -1.32410, 0]", "[0, 0, 0]").replace("[600, 0, 1200]", "[0, 500, 0]")


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Loads ``my.yaml`` from the folder that holds the files a study names."""
    monkeypatch.chdir(tmp_path)

    def load(text):
        Path("my.yaml").write_text(text, encoding="utf-8")
        return load_study(Path("my.yaml"))

    return load


def oem(*, starts=(0.0,), minutes=20):
    """An ephemeris in segments of 20 minutes, made of an orbit that is known."""
    orbit = build_trajectory(OrbitBlock.model_validate(CIRCLE | {"epoch": EPOCH}))
    epoch = datetime(2026, 3, 20, 12, tzinfo=UTC)
    lines = ["CCSDS_OEM_VERS = 2.0", "CREATION_DATE = 2026-03-20T00:00:00", "ORIGINATOR = TEST"]
    for start in starts:
        times = start + 60.0 * np.arange(minutes + 1)
        states = orbit.inertial(times)
        stamps = [(epoch + timedelta(seconds=t)).strftime("%Y-%m-%dT%H:%M:%S.%f") for t in times]
        lines += [
            "META_START",
            "OBJECT_NAME = X",
            "OBJECT_ID = 2026-001A",
            "CENTER_NAME = EARTH",
            "REF_FRAME = GCRF",
            "TIME_SYSTEM = UTC",
            f"START_TIME = {stamps[0]}",
            f"STOP_TIME = {stamps[-1]}",
            "META_STOP",
        ]
        for stamp, position, velocity in zip(stamps, *states, strict=True):
            numbers = " ".join(f"{value / 1e3:.9f}" for value in (*position, *velocity))
            lines.append(f"{stamp} {numbers}")
    return "\n".join(lines) + "\n"


# --- the keys ------------------------------------------------------------------------------------


def test_altitude_and_inclination_alone_are_the_circle_that_they_always_were():
    orbit = build_reference(OrbitBlock.model_validate(CIRCLE))
    assert orbit == Orbit.circular(altitude=514e3, inclination=math.radians(97.44))


def test_elements_reach_the_orbit_in_meters_and_radians():
    orbit = trajectory(
        **CIRCLE, eccentricity=0.01, argument_of_perigee_deg=30, raan_deg=20, mean_anomaly_deg=10
    )
    assert isinstance(orbit, KeplerianOrbit)
    assert orbit.elements == pytest.approx(
        (6_892_137.0, 0.01, *np.radians([97.44, 20, 30, 10])), rel=1e-12
    )
    assert orbit.kind is ElementKind.MEAN
    assert orbit.j2


def test_the_other_words_for_an_orbit_reach_it():
    orbit = trajectory(
        semi_major_axis_km=7000, inclination_deg=60, elements="osculating", j2=False, epoch=EPOCH
    )
    assert orbit.elements.semi_major_axis == 7e6
    assert orbit.kind is ElementKind.OSCULATING
    assert not orbit.j2
    assert orbit.epoch == datetime(2026, 3, 20, 12, tzinfo=UTC)


@pytest.mark.parametrize("latitude", [0.0, 75.0, 200.0, -100.0])
def test_the_argument_of_latitude_is_where_the_satellite_is(latitude):
    states = trajectory(**TWO_BODIES, argument_of_latitude_deg=latitude, epoch=EPOCH).inertial(0.0)
    height = states.position[2] / np.linalg.norm(states.position)
    sine = math.sin(math.radians(97.44)) * math.sin(math.radians(latitude))
    # The pole of the date and that of the GCRS are 0.15 degrees apart, 26 years after J2000.
    assert height == pytest.approx(sine, abs=math.radians(0.15))
    assert height != pytest.approx(sine + 0.01, abs=math.radians(0.15))


def test_without_a_place_the_satellite_begins_at_its_ascending_node():
    states = trajectory(**TWO_BODIES, epoch=EPOCH).earth_fixed(0.0)
    assert states.position[2] == pytest.approx(0.0, abs=100.0)  # polar motion: 0.3" are 10 m
    assert states.velocity[2] > 0.0


@pytest.mark.parametrize("longitude", [-170.0, 15.0, 200.0])
def test_the_node_is_above_its_longitude(longitude):
    position = trajectory(**TWO_BODIES, epoch=EPOCH, node_longitude_deg=longitude).earth_fixed(0.0)[
        0
    ]
    shift = math.atan2(position[1], position[0]) - math.radians(longitude)
    assert math.remainder(shift, 2 * math.pi) == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize(("time", "east"), [("18:00", 90), ("06:30", -82.5), ("12:00:24", 0.1)])
def test_the_node_has_its_local_mean_solar_time(time, east):
    position = trajectory(**TWO_BODIES, epoch=EPOCH, node_local_time=time).earth_fixed(0.0)[0]
    # At 12:00 UTC it is 18:00 a quarter of a turn further east.
    assert math.degrees(math.atan2(position[1], position[0])) == pytest.approx(east, abs=1e-3)


@pytest.mark.parametrize(
    ("text", "moment"),
    [
        ("2026-03-20T12:00:00Z", datetime(2026, 3, 20, 12, tzinfo=UTC)),
        ("'2026-03-20 12:00'", datetime(2026, 3, 20, 12, tzinfo=UTC)),
        ("2026-03-20", datetime(2026, 3, 20, tzinfo=UTC)),
        ("2026-03-20T01:02:03.25", datetime(2026, 3, 20, 1, 2, 3, 250_000, tzinfo=UTC)),
    ],
)
def test_an_epoch_is_utc_with_quotes_or_without(study, text, moment):
    loaded = study(with_orbit(ORBIT_LINE.replace("}", f", epoch: {text}}}")))
    assert build_trajectory(loaded.study.orbit).epoch == moment


def test_two_line_elements_as_text_list_and_file_are_one_orbit(study):
    Path("iss.tle").write_text("ISS\n" + "\n".join(TLE), encoding="utf-8")
    block = f"orbit:\n  tle: |\n    ISS\n    {TLE[0]}\n    {TLE[1]}\n"
    forms = [
        f"orbit:\n  tle:\n    - '{TLE[0]}'\n    - '{TLE[1]}'\n",
        block,
        "orbit: {tle_file: iss.tle}\n",
    ]
    expected = TwoLineOrbit.from_lines(*TLE)
    for form in forms:
        loaded = study(strip_only(with_orbit(form)))
        orbit = build_trajectory(loaded.study.orbit)
        assert (orbit.line1, orbit.line2) == TLE
        assert orbit.epoch == expected.epoch
        reference = loaded.study.reference_orbit
        # Mean elements: 15.7 revolutions a day.
        assert reference.period == pytest.approx(DAY / 15.721, rel=2e-3)
        assert math.degrees(reference.inclination) == pytest.approx(51.64, abs=0.02)


def test_an_ephemeris_file_is_an_orbit(study):
    Path("x.oem").write_text(oem(), encoding="utf-8")
    loaded = study(strip_only(with_orbit("orbit: {oem_file: x.oem}\n")))
    setup = build_evaluate(loaded.study)
    assert setup.orbit.altitude == pytest.approx(514e3, abs=500.0)  # mean, to first order in J2
    assert loaded.files[0].name == "x.oem"
    assert loaded.files[0].sha256 == hashlib.sha256(Path("x.oem").read_bytes()).hexdigest()


def test_an_orbit_of_any_kind_survives_the_round_trip(study):
    Path("iss.tle").write_text("\n".join(TLE), encoding="utf-8")
    forms = [
        ORBIT_LINE.replace("}", f", epoch: {EPOCH}, node_local_time: '18:00'}}"),
        f"orbit: {{tle: ['{TLE[0]}', '{TLE[1]}']}}\n",
        f"orbit:\n  tle: |\n    {TLE[0]}\n    {TLE[1]}\n",
        "orbit: {tle_file: iss.tle}\n",
    ]
    for form in forms:
        original = study(strip_only(with_orbit(form))).study
        assert study(effective_text(original)).study == original


_ORBITS = st.fixed_dictionaries(
    {
        "altitude_km": st.sampled_from([150, 514, 12_000, 36_000]),
        "inclination_deg": st.sampled_from([0, 1e-9, 30, 63.4349, 90, 116.565, 179, 180]),
        "eccentricity": st.sampled_from([0, 1e-12, 0.001, 0.3, 0.7, 0.9]),
        "argument_of_perigee_deg": st.floats(-360, 360),
        "argument_of_latitude_deg": st.floats(-360, 360),
        "elements": st.sampled_from(["mean", "osculating"]),
        "j2": st.booleans(),
        "epoch": st.sampled_from(["1972-01-01", EPOCH, "2016-12-31T23:59:59Z", "2099-12-31"]),
    }
)


@given(keys=_ORBITS)
def test_whatever_the_schema_allows_is_an_orbit(keys):
    try:
        block = OrbitBlock.model_validate(keys)
    except ValidationError:
        return
    states = build_trajectory(block).earth_fixed(np.linspace(0.0, 6000.0, 7))
    assert np.all(np.isfinite(states.position))
    assert np.all(np.isfinite(states.velocity))
    assert build_reference(block).period > 0.0


# --- files ---------------------------------------------------------------------------------------


def test_a_file_beside_the_study_comes_before_a_shipped_one(tmp_path, monkeypatch):
    text = example_text("three_sat_real")
    (tmp_path / "deep").mkdir()
    path = tmp_path / "deep" / "my.yaml"
    path.write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    shipped = load_study(path).files[0]
    (tmp_path / "deep" / "etna.geojson").write_text("{}", encoding="utf-8")
    own = load_study(path).files[0]
    assert (shipped.name, own.name) == ("etna.geojson", "etna.geojson")
    assert "Etna" in shipped.text
    assert own.text == "{}"
    assert load_study(path).study != yaml.safe_load(text)


def test_the_sha256_of_a_file_is_that_of_its_bytes_whatever_its_line_ends(study):
    Path("iss.tle").write_bytes(b"\xef\xbb\xbf" + "\r\n".join(TLE).encode())
    loaded = study(strip_only(with_orbit("orbit: {tle_file: iss.tle}\n")))
    assert loaded.files[0].sha256 == hashlib.sha256(Path("iss.tle").read_bytes()).hexdigest()


def test_a_study_without_files_has_none(study):
    assert study(EVALUATE).files == ()


# --- what is refused -----------------------------------------------------------------------------

BAD_SUM = TLE[0][:-1] + "3"
FILES = {
    "bad.tle": f"{BAD_SUM}\n{TLE[1]}\n",
    "torn.oem": "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-03-20T00:00:00\n",
    "image.tle": b"\x89PNG\x00\x01",
    "latin.tle": b"satellite\ncaf\xe9",
    "utf16.tle": "name".encode("utf-16"),
    "large.oem": b"x" * 5_000_001,
}


def reason(reader, text, part):
    """What a reader says of a text, on one line."""
    with pytest.raises(ValueError, match=part) as error:
        reader(text)
    return " ".join(str(error.value).split())


# (text of the orbit, column in its line, whole message)
REFUSED = {
    "hyperbolic": (
        "orbit: {altitude_km: 514, inclination_deg: 97, eccentricity: 1.2}\n",
        "1.2",
        "orbit.eccentricity = 1.2 must be a number from 0 to 0.9; choose a value within these "
        "limits",
    ),
    "decayed": (
        "orbit: {altitude_km: 514, inclination_deg: 97, eccentricity: 0.1}\n",
        "0.1",
        "orbit.eccentricity = 0.1 brings the perigee to -175 km, and below 100 km an orbit decays "
        "at once; choose a smaller eccentricity or a higher orbit",
    ),
    "no size": (
        "orbit: {inclination_deg: 97}\n",
        "orbit:",
        "orbit.altitude_km is missing; add a number from 150 to 36000 km (Height above the "
        "equatorial radius of the Earth, 6378.137 km)",
    ),
    "no inclination": (
        "orbit: {altitude_km: 514}\n",
        "orbit:",
        "orbit.inclination_deg is missing; add a number from 0 to 180 degrees (Angle between the "
        "orbit and the equator; above 90 retrograde)",
    ),
    "number for two lines": (
        "orbit: {tle: /home/me/sat.tle}\n",
        "/home",
        "orbit.tle = '/home/me/sat.tle' looks like the name of a file, and takes the two lines "
        "themselves; write tle_file: /home/me/sat.tle",
    ),
    "name of a file in a list": (
        "orbit: {tle: [sat.tle, other.tle]}\n",
        "[sat",
        "orbit.tle = ['sat.tle', 'other.tle'] looks like the name of a file, and takes the two "
        "lines themselves; write tle_file: sat.tle",
    ),
    "number as elements": (
        "orbit: {tle: 31698}\n",
        "31698",
        "orbit.tle = 31698 must be text such as '1 25544U 98067A ...', or a list of 2 to 3 "
        "entries, each text of at most 100 characters; give its two lines, as text or as a list",
    ),
    "maybe J2": (
        "orbit: {altitude_km: 514, inclination_deg: 97, j2: maybe}\n",
        "maybe",
        "orbit.j2 = 'maybe' must be true or false; write true or false",
    ),
    "two sizes": (
        "orbit: {altitude_km: 514, inclination_deg: 97, semi_major_axis_km: 6900}\n",
        "6900",
        "orbit.semi_major_axis_km = 6900 excludes altitude_km, which says the same; keep one",
    ),
    "two nodes": (
        "orbit: {altitude_km: 514, inclination_deg: 97, epoch: 2026-03-20, node_longitude_deg: 5, "
        "node_local_time: '18:00'}\n",
        "'18:00'",
        "orbit.node_local_time = '18:00' excludes node_longitude_deg, which says the same; keep "
        "one",
    ),
    "two anomalies": (
        "orbit: {altitude_km: 514, inclination_deg: 97, mean_anomaly_deg: 1, "
        "argument_of_latitude_deg: 2}\n",
        "2}",
        "orbit.argument_of_latitude_deg = 2 excludes mean_anomaly_deg, which says the same; keep "
        "one",
    ),
    "node on no Earth": (
        "orbit: {altitude_km: 514, inclination_deg: 97, node_longitude_deg: 5}\n",
        "5}",
        "orbit.node_longitude_deg = 5 needs an epoch, since the Earth turns below the orbit; add "
        "epoch: 2026-11-23T05:07:00Z, the moment that you mean",
    ),
    "time of no day": (
        "orbit: {altitude_km: 514, inclination_deg: 97, node_local_time: 6pm}\n",
        "6pm",
        "orbit.node_local_time = '6pm' must be text such as '18:00'; correct the text",
    ),
    "epoch in words": (
        "orbit: {altitude_km: 514, inclination_deg: 97, epoch: 20 March 2026}\n",
        "20 March",
        "orbit.epoch = '20 March 2026' must be text such as '2026-11-23T05:07:00Z'; correct the "
        "text",
    ),
    "epoch that is a number": (
        "orbit: {altitude_km: 514, inclination_deg: 97, epoch: 2026}\n",
        "2026",
        "orbit.epoch = 2026 must be text such as '2026-11-23T05:07:00Z'; as a text it needs "
        "quotes: '2026'",
    ),
    "epoch of no calendar": (
        "orbit: {altitude_km: 514, inclination_deg: 97, epoch: 2026-02-30}\n",
        "2026-02-30",
        "orbit.epoch = '2026-02-30' does not exist (day is out of range for month); correct the "
        "date or the time",
    ),
    "epoch before UTC": (
        "orbit: {altitude_km: 514, inclination_deg: 97, epoch: 1957-10-04}\n",
        "1957",
        "orbit.epoch = '1957-10-04' lies outside the years 1972 to 2099: before them UTC had no SI "
        "seconds, and after them nobody knows how the Earth has turned; correct the year",
    ),
    "elements beside two lines": (
        f"orbit: {{altitude_km: 514, tle: ['{TLE[0]}', '{TLE[1]}']}}\n",
        "514",
        "orbit.altitude_km = 514 contradicts tle, which gives the whole orbit; keep one",
    ),
    "two whole orbits": (
        f"orbit: {{tle_file: bad.tle, tle: ['{TLE[0]}', '{TLE[1]}']}}\n",
        "bad.tle",
        "orbit.tle_file = 'bad.tle' contradicts tle, which gives the whole orbit; keep one",
    ),
    "wrong checksum": (
        f"orbit: {{tle: ['{BAD_SUM}', '{TLE[1]}']}}\n",
        "['1 2",
        "orbit.tle cannot be used: "
        + reason(TwoLineOrbit.from_text, FILES["bad.tle"], "ends with checksum 3"),
    ),
    "wrong checksum in lines of text": (
        f"orbit:\n  tle: |\n    {BAD_SUM}\n    {TLE[1]}\n",
        "|",
        "orbit.tle cannot be used: "
        + reason(TwoLineOrbit.from_text, FILES["bad.tle"], "ends with checksum 3"),
    ),
    "wrong checksum in a file": (
        "orbit: {tle_file: bad.tle}\n",
        "bad.tle",
        "orbit.tle_file = 'bad.tle' cannot be used: "
        + reason(TwoLineOrbit.from_text, FILES["bad.tle"], "ends with checksum 3"),
    ),
    "malformed ephemeris": (
        "orbit: {oem_file: torn.oem}\n",
        "torn.oem",
        "orbit.oem_file = 'torn.oem' cannot be used: "
        + reason(Ephemeris.from_oem, FILES["torn.oem"], "there is no META_START"),
    ),
    "image for text": (
        "orbit: {tle_file: image.tle}\n",
        "image.tle",
        "orbit.tle_file = 'image.tle' cannot be read in line 1: byte 0x89 is not UTF-8 text; save "
        "the file as UTF-8",
    ),
    "another encoding": (
        "orbit: {tle_file: latin.tle}\n",
        "latin.tle",
        "orbit.tle_file = 'latin.tle' cannot be read in line 2: byte 0xe9 is not UTF-8 text; save "
        "the file as UTF-8",
    ),
    "wide text": (
        "orbit: {tle_file: utf16.tle}\n",
        "utf16.tle",
        "orbit.tle_file = 'utf16.tle' is UTF-16 text; save it as UTF-8",
    ),
    "large file": (
        "orbit: {oem_file: large.oem}\n",
        "large.oem",
        "orbit.oem_file = 'large.oem' is larger than 5 MB, the limit for such a file; cut it down "
        "to what the study needs",
    ),
    "folder": (
        "orbit: {tle_file: ..}\n",
        "..",
        "orbit.tle_file = '..' is no file but a folder or a device; name a file",
    ),
    "number for a file": (
        "orbit: {tle_file: 5}\n",
        "5}",
        "orbit.tle_file = 5 must be the name of a file; as a text it needs quotes: '5'",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_wrong_orbit_is_named_with_place_limit_and_remedy(study, case):
    for name, content in FILES.items():
        Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())
    orbit, where, says = REFUSED[case]
    text = with_orbit(orbit)
    with pytest.raises(StudyError) as error:
        study(text)
    before = text[: text.index(orbit) + orbit.index(where)]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    assert str(error.value) == f"my.yaml:{line}:{column}: {says}"


def test_a_gap_in_an_ephemeris_blames_the_file(study):
    """The satellite is needed where the file does not know it: for the steering over the gap."""
    Path("gap.oem").write_text(oem(starts=(0.0, 3600.0), minutes=40), encoding="utf-8")
    text = (
        "kind: steering\nradar: {wavelength_m: 0.031}\nboresight: {look_deg: 30}\ncases:\n"
        "  - name: Gap\n    orbit: {oem_file: gap.oem}\n"
    )
    loaded = study(text)
    with pytest.raises(BuildError) as error:
        build_steering(loaded.study)
    own = build_trajectory(loaded.study.cases[0].orbit)
    times = np.linspace(0.0, build_reference(loaded.study.cases[0].orbit).period, 721)
    assert str(loaded.located(error.value)) == (
        "my.yaml:6:23: cases[#1].orbit.oem_file = 'gap.oem' cannot be used: "
        + reason(own.earth_fixed, times, "gap")
    )
    assert str(error.value).startswith("cases[#1].orbit.oem_file cannot be used: ")


def test_a_file_that_is_missing_names_where_it_was_looked_for(study, tmp_path):
    """No area is offered for an orbit."""
    with pytest.raises(StudyError) as error:
        study(with_orbit("orbit: {tle_file: sub/sat.tle}\n"))
    assert str(error.value) == (
        f"my.yaml:14:19: orbit.tle_file = 'sub/sat.tle' is not a file beside the study, in "
        f"{tmp_path}; write its path from the folder of the study"
    )


def test_a_block_without_a_study_looks_for_files_here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValidationError, match="is not a file beside the study"):
        OrbitBlock.model_validate({"tle_file": "sat.tle"})
    Path("sat.tle").write_text("\n".join(TLE), encoding="utf-8")
    assert OrbitBlock.model_validate({"tle_file": "sat.tle"}).tle_file.name == "sat.tle"


@pytest.mark.parametrize("name", ["a\0b", "x" * 299])
def test_an_impossible_name_of_a_file_is_one_message(study, name):
    with pytest.raises(StudyError) as error:
        study(with_orbit(f"orbit: {{tle_file: {yaml.safe_dump(name).strip().splitlines()[0]}}}\n"))
    assert str(error.value).isprintable()
