"""Reports of steering studies and of scenes from orbits: words, contract, maps, odd results."""

from __future__ import annotations

import csv
import dataclasses
import html
import io
import json
import math
import re
from datetime import UTC, datetime, timedelta
from pathlib import Path

import jsonschema
import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from formation import Elements, KeplerianOrbit, Orbit, equally_spaced, ground_track_circular
from insar import (
    Claim,
    ErrorBudget,
    ErrorSource,
    LookSide,
    Radar,
    Scene,
    SharedBy,
    Verdict,
    one_transmitter,
)
from insar.observe import (
    CaseResult,
    Compensation,
    CompensationRequest,
    FixedIncidence,
    FixedLook,
    Held,
    Law,
    Observation,
    Outcome,
    Reference,
    Selection,
    SelectionRequest,
    SteeringCase,
    SteeringResult,
    assess_case,
    compensate,
    select,
)
from insar.observe.agile.spotlight_plan import plan_spotlight
from insar.observe.agile.spotlight_results import SpotlightRequest
from insar.observe.agile.staring import StaringScene, staring_scene
from optimize import Constraints, EvaluateResult, Problem, assess
from reports import Provenance, StudyInfo, write_report
from reports.document import CodeListing, Document, Section
from reports.figures.height_error import series_line
from reports.figures.lines import name_lines
from reports.figures.maps import paint_ground
from reports.figures.observation_map import observation_map
from reports.figures.projection import (
    EARTH_RADIUS_KM,
    Azimuthal,
    center_of,
    filled_path,
    land_outline,
)
from reports.figures.steering import along_orbit
from reports.html import html_bytes
from reports.json_result import result_json, result_schema
from reports.pages import page_of
from reports.pages.claims import claims_section
from reports.pages.observation import observation_section
from reports.pages.steering_studies import selection_section
from reports.pages.steering_verdict import share_solved, steering_verdict
from reports.pdf import pdf_bytes
from reports.reading_steering import exact_laws
from reports.tables import csv_bytes
from reports.tables_steering import largest, steering_frame

EPOCH = datetime(2024, 3, 1, tzinfo=UTC)

PROVENANCE = Provenance(
    version="0.2.0",
    seed=None,
    python="3.11.7",
    platform="Linux",
    packages={"numpy": "2.0"},
    started="2026-01-01T00:00:00+00:00",
    wall_s=1.5,
    evaluations=0,
    command="formation-opt zhao2019_geosar",
)

STUDY = StudyInfo(
    name="Steering",
    kind="steering",
    description="",
    source_text="kind: steering\n",
    config_sha256="0" * 64,
    inputs=(("orbit.tle", "a" * 64),),
)


def make_case(
    name: str = "LEO",
    *,
    altitude: float = 700e3,
    eccentricity: float = 1e-3,
    look: float = 35.0,
    laws: tuple[Law, ...] = tuple(Law),
    offsets: tuple[float, ...] = (-0.5, 0.0, 0.5),
    samples: int = 61,
) -> CaseResult:
    orbit = KeplerianOrbit(
        elements=Elements(
            6378137.0 + altitude, eccentricity, math.radians(60.0), 0.3, math.radians(90.0), 0.0
        ),
        epoch=EPOCH,
    )
    period = 2.0 * math.pi * math.sqrt((6378137.0 + altitude) ** 3 / 3.986004418e14)
    return assess_case(
        SteeringCase(
            name=name,
            trajectory=orbit,
            times=np.linspace(0.0, period, samples),
            wavelength=0.24,
            side=LookSide.LEFT,
            boresight=FixedLook(math.radians(look)),
            laws=laws,
            swath_offsets=np.radians(offsets),
        )
    )


def make_selection(*, eccentricity: float = 0.0, angle: float = 7.53) -> Selection:
    return select(
        SelectionRequest(
            altitudes=np.geomspace(1e6, 3.6e7, 12),
            inclinations=np.radians([30.0, 80.0]),
            held=Held.LOOK,
            boresight_angle=math.radians(angle),
            slew_rate=math.radians(0.01),
            swath_offset=math.radians(0.5),
            wavelength=0.24,
            eccentricity=eccentricity,
            samples=61,
        )
    )


def make_compensation() -> Compensation:
    return compensate(
        CompensationRequest(
            semi_major_axis=7178137.0,
            inclination=math.radians(98.6),
            look_angle=math.radians(35.0),
            side=LookSide.RIGHT,
            eccentricity=2e-3,
            arguments_of_perigee=(0.0, math.pi / 2),
            eccentricities=np.linspace(0.0, 5e-3, 6),
            samples=73,
        )
    )


CLAIMS = (
    Claim("largest yaw", "3.8°", 3.72, "°", Verdict.HOLDS, "to the printed digits"),
    Claim(
        "largest yaw, GEO",
        "67°",
        75.04,
        "°",
        Verdict.FAILS,
        "Table 2 itself implies 75°",
        66.5,
        67.5,
    ),
    Claim("loss", "none", math.nan, "dB", Verdict.UNKNOWN, "no bandwidth is stated"),
)


@pytest.fixture(scope="module")
def full() -> SteeringResult:
    geo = make_case("GEO", altitude=35.786e6, eccentricity=0.1, look=4.0)
    return SteeringResult(
        cases=(make_case(), geo),
        selections=(make_selection(),),
        compensation=make_compensation(),
        claims=CLAIMS,
        warnings=("Take care.",),
    )


@pytest.fixture(scope="module")
def full_text(full: SteeringResult) -> str:
    return page_text(full)


def only(case: CaseResult) -> SteeringResult:
    return SteeringResult(cases=(case,), selections=(), compensation=None, claims=(), warnings=())


def never_solved() -> SteeringResult:
    case = make_case(laws=(Law.PITCH_ROLL,))
    curves = case.curves[0]
    nothing = {
        name: np.full_like(value, np.nan)
        for name, value in curves._asdict().items()
        if isinstance(value, np.ndarray) and name != "outcome"
    }
    outcome = np.full(curves.outcome.shape, Outcome.MISSES_EARTH.value)
    gone = curves._replace(**nothing, outcome=outcome)
    return only(dataclasses.replace(case, curves=(gone,)))


ODD_RESULTS = {
    "unsteered only": lambda: only(make_case(laws=(Law.NONE,))),
    "no offsets": lambda: only(make_case(offsets=())),
    "many offsets": lambda: only(make_case(offsets=tuple(np.linspace(-1.0, 1.0, 9)))),
    "never solved": never_solved,
    "several revolutions": lambda: dataclasses.replace(
        only(make_case()), selections=(make_selection(eccentricity=0.1, angle=3.0),)
    ),
    "circular": lambda: only(make_case(eccentricity=0.0, laws=(Law.YAW, Law.YAW_PITCH))),
    "six cases": lambda: dataclasses.replace(
        only(make_case()),
        cases=tuple(make_case(f"case {n}", offsets=(0.1 * n,)) for n in range(1, 7)),
    ),
}


def words_of(page: str) -> str:
    words = re.sub(r"<(style|script).*?</\1>|<[^>]+>", " ", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", html.unescape(words))


def page_text(result: object, study: StudyInfo = STUDY) -> str:
    return words_of(html_bytes(page_of(result).document(result, study, PROVENANCE)).decode())


def section_text(section: Section | None) -> str:
    assert section is not None
    return words_of(html_bytes(Document("", "", "", "", (section,))).decode())


def document_of(result: object, study: StudyInfo = STUDY) -> dict:
    body = page_of(result).json(result)
    return json.loads(result_json(body, study=study, provenance=PROVENANCE))


# -- steering ------------------------------------------------------------------------------------


def test_steering_report_is_written_whole(full: SteeringResult, tmp_path: Path) -> None:
    paths = write_report(full, study=STUDY, provenance=PROVENANCE, out=tmp_path)
    tables = {"steering.csv", "selection.csv", "compensation.csv", "claims.csv"}
    assert {path.name for path in paths} == tables | {"result.json", "report.html", "report.pdf"}
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    assert document["study"]["inputs"] == [{"file": "orbit.tle", "sha256": "a" * 64}]
    laws = document["steering"]["cases"][0]["laws"]
    assert [law["law"] for law in laws] == [law.value for law in Law]
    curves = full.cases[0].of(Law.PITCH_ROLL)
    assert laws[4]["max_swath_doppler_hz"][2] == np.abs(curves.swath_doppler[:, 2]).max()
    assert document["steering"]["claims"][2]["computed"] is None
    for table in tables:
        assert not re.search(r"\b(nan|inf)\b", (tmp_path / table).read_text("utf-8"))


def test_tables_of_an_earlier_run_do_not_stay(full: SteeringResult, tmp_path: Path) -> None:
    write_report(full, study=STUDY, provenance=PROVENANCE, out=tmp_path, formats=())
    write_report(only(make_case()), study=STUDY, provenance=PROVENANCE, out=tmp_path, formats=())
    assert {path.name for path in tmp_path.iterdir()} == {"result.json", "steering.csv"}


@pytest.mark.parametrize("name", ODD_RESULTS)
def test_odd_steering_is_reported_in_full(name: str, tmp_path: Path) -> None:
    odd = ODD_RESULTS[name]()
    write_report(odd, study=STUDY, provenance=PROVENANCE, out=tmp_path)
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    text = words_of((tmp_path / "report.html").read_text("utf-8"))
    assert not re.search(r"\b(nan|NaN|inf|Infinity|None)\b", text)


def test_verdict_is_honest_about_zero_price_and_gaps(full: SteeringResult, full_text: str) -> None:
    text = full_text
    parts = [
        f"{name} (on {100 * np.mean(full.cases[1].of(law).outcome == Outcome.SOLVED):.0f} % of the "
        "orbit only)"
        for name, law in (("yaw-pitch", Law.YAW_PITCH), ("pitch-roll", Law.PITCH_ROLL))
    ]
    assert f"Zero Doppler at the boresight with {' and '.join(parts)}" in text
    assert "The price over the swath:" in text
    worst = max(np.nanmax(np.abs(c.of(Law.PITCH_ROLL).swath_doppler)) for c in full.cases)
    assert re.search(rf"pitch-roll has up to {worst:.3g} Hz \(", text)
    assert "yaw-pitch stays at zero" in text
    share = np.mean(full.cases[1].of(Law.PITCH_ROLL).outcome == Outcome.TOO_NEAR_NADIR)
    assert (
        f"pitch-roll in GEO: the pitch needed exceeds the boresight's angle from nadir at "
        f"{100 * share:.0f} % of the samples" in text
    )
    assert "1 of 3 printed figures follow from the stated inputs, 1 do not, 1 cannot" in text


def test_residuals_are_only_called_zero_when_they_are_rounding() -> None:
    case = make_case(laws=(Law.YAW_PITCH_APPROXIMATE, Law.YAW_PITCH))
    assert exact_laws([case]) == (Law.YAW_PITCH,)
    curves = case.curves[1]
    spoilt = curves._replace(residual_doppler=curves.residual_doppler + 1e-3)
    worse = dataclasses.replace(case, curves=(case.curves[0], spoilt))
    assert exact_laws([worse]) == ()
    text = section_text(Section("result", "Result", steering_verdict(only(worse))))
    assert "Zero Doppler" not in text
    assert "Up to 0.00100 Hz is left with yaw-pitch steering" in text


def test_claims_show_both_figures_the_verdict_and_why(full: SteeringResult) -> None:
    text = section_text(claims_section(CLAIMS, "stated inputs"))
    assert "67° 66.5 … 67.5° 75.0° ✗ does not hold Table 2 itself implies 75°" in text
    assert "none — — ? not computable no bandwidth is stated" in text
    rows = list(csv.DictReader(io.StringIO(page_of(full).csv(full)["claims.csv"].to_csv())))
    assert [row["verdict"] for row in rows] == ["holds", "does not hold", "not computable"]


def test_selection_lists_the_crossovers(full: SteeringResult, full_text: str) -> None:
    for found in full.selections[0].crossovers:
        assert found
        assert f"{found[0] / 1e3:.0f} km" in full_text
    none = dataclasses.replace(full.selections[0], crossovers=((), ()))
    assert "none between 1000 and 36000 km" in section_text(selection_section((none,)))
    unsolved = dataclasses.replace(none, steering_angle=np.full_like(none.steering_angle, np.nan))
    text = section_text(selection_section((unsolved,)))
    assert "No law can be taken" in text
    assert "neither law has a solution" in text
    assert "Figure" not in text


def test_sweep_says_where_each_norm_falls_to_95_percent(full_text: str) -> None:
    compensation = make_compensation()
    assert compensation.sweep[-1] < 0.95 < compensation.sweep[0]
    expected = np.interp(-0.95, -compensation.sweep, compensation.eccentricities)
    assert f"an eccentricity of {expected:.3g} in the maximum norm" in full_text


def test_steering_csv_has_every_curve(full: SteeringResult) -> None:
    frame = steering_frame(full.cases)
    chosen = frame[(frame["case"] == "LEO") & (frame["law"] == "yaw_pitch")]
    np.testing.assert_array_equal(
        chosen["yaw_deg"], np.degrees(full.cases[0].of(Law.YAW_PITCH).yaw)
    )
    assert "doppler_at_-0.5_deg_hz" in frame.columns
    assert set(frame["outcome"]) == {"solved", "too_near_nadir"}


def test_shares_and_magnitudes_at_their_ends() -> None:
    assert [share_solved(share) for share in (1.0, 0.9999, 0.0)] == ["all", "100 %", "< 0.1 %"]
    assert largest(np.array([np.nan, -3.0, 2.0])) == 3.0
    assert math.isnan(largest(np.full(3, np.nan)))


@pytest.mark.parametrize(
    "break_it",
    [
        lambda d: d.pop("steering"),
        lambda d: d["study"].update(kind="evaluate"),
        lambda d: d["study"].pop("inputs"),
        lambda d: d["steering"]["cases"].clear(),
        lambda d: d["steering"]["cases"][0]["laws"][0].update(law="sideways"),
        lambda d: d["steering"]["cases"][0]["laws"][0].update(solved_fraction=2.0),
        lambda d: d["steering"]["claims"][0].update(verdict="maybe"),
        lambda d: d["steering"]["selections"][0]["laws"].pop(),
    ],
)
def test_schema_refuses_what_breaks_the_contract(full: SteeringResult, break_it) -> None:
    document = document_of(full)
    jsonschema.validate(document, result_schema())
    break_it(document)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(document, result_schema())


def test_names_of_cases_are_data() -> None:
    named = "<script>alert(1)</script> $x$ _y_"
    given = only(make_case(named, laws=(Law.YAW,)))
    text = html_bytes(page_of(given).document(given, STUDY, PROVENANCE)).decode()
    assert "<script>alert" not in text
    assert "&lt;script&gt;alert(1)" in text


# -- where the geometry lies ---------------------------------------------------------------------


def make_observation(
    latitude: float = 37.75,
    longitude: float = 15.0,
    *,
    segments: int = 6,
    missed: tuple[str, ...] = (),
    **changes: object,
) -> Observation:
    """Targets on a meridian, and a track and strip west of them, on a sphere."""
    lat0, lon0 = math.radians(latitude), math.radians(longitude)
    lat = lat0 + np.radians(np.linspace(-0.1, 0.1, segments) if segments > 1 else np.zeros(1))
    along = lat0 + np.radians(np.linspace(-4.0, 4.0, 41))
    look = np.full(segments, math.radians(30.0))

    def parallel(offset: float) -> dict[str, np.ndarray]:
        return np.full(41, lon0 + math.radians(offset))

    observation = Observation(
        scene=Scene(
            times=np.arange(segments, dtype=float),
            slant_range=np.full(segments, 600e3),
            look_angle=look,
            azimuth=np.full(segments, -1.6),
            incidence=look + math.radians(2.5),
        ),
        orbit=Orbit.circular(altitude=514e3, inclination=1.7),
        epoch=EPOCH,
        orbit_source="mean elements with J2",
        orbit_epoch=EPOCH,
        side=LookSide.RIGHT,
        law=Law.YAW_PITCH,
        boresight=FixedIncidence(math.radians(32.5)),
        reference=Reference.ZERO_DOPPLER,
        eccentricity=1.1e-3,
        ascending=True,
        passes=3,
        pass_number=2,
        latitude=lat,
        longitude=np.full(segments, lon0),
        height=np.zeros(segments),
        doppler=np.full(segments, 1e-9),
        off_boresight=np.zeros(segments),
        missed_latitude=np.full(len(missed), lat0 + 0.002),
        missed_longitude=np.full(len(missed), lon0 + 0.002),
        missed_reasons=missed,
        track_latitude=along,
        track_longitude=parallel(-3.0),
        near_latitude=along,
        near_longitude=parallel(-1.0),
        far_latitude=along,
        far_longitude=parallel(1.0),
        near_incidence=math.radians(20.0),
        far_incidence=math.radians(45.0),
        outlines=(np.array([lon0, lat0]) + 0.003 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]),),
    )
    return dataclasses.replace(observation, **changes)


def evaluated(observation: Observation | StaringScene) -> tuple[EvaluateResult, StudyInfo]:
    problem = Problem(
        mean_motion=observation.orbit.mean_motion,
        scene=observation.scene,
        radar=Radar(
            wavelength=0.031,
            slant_range_resolution=3.0,
            snr=10.0,
            looks=16.0,
            images=one_transmitter(3),
        ),
        errors=ErrorBudget(position=ErrorSource(0.001, SharedBy.SATELLITE)),
        constraints=Constraints(),
    )
    z0, zdot0 = equally_spaced(3, radius=1350.0, mean_motion=problem.mean_motion)
    states = ground_track_circular(z0, zdot0, mean_motion=problem.mean_motion)
    result = EvaluateResult(
        problem=problem,
        critical_baseline=2707.0,
        formation=assess(problem, states, label="formation", names=("1", "2", "3")),
        compare=(),
        warnings=(),
    )
    study = dataclasses.replace(
        STUDY,
        kind="evaluate",
        orbit_altitude=514e3,
        inclination=1.7,
        observation=observation,
    )
    return result, study


def test_scene_from_an_orbit_is_reported_with_map_table_and_json(tmp_path: Path) -> None:
    observation = make_observation(missed=("behind the horizon", "off the strip", "off the strip"))
    result, study = evaluated(observation)
    paths = write_report(result, study=study, provenance=PROVENANCE, out=tmp_path)
    assert "segments.csv" in {path.name for path in paths}
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    block = document["observation"]
    assert block["boresight"] == {"held": "incidence", "angle_rad": math.radians(32.5)}
    assert block["segments"][2]["latitude_rad"] == observation.latitude[2]
    assert [one["reason"] for one in block["missed"]] == list(observation.missed_reasons)
    rows = list(csv.DictReader(io.StringIO((tmp_path / "segments.csv").read_text("utf-8"))))
    assert rows[3]["utc"] == "2024-03-01T00:00:03.000000Z"
    assert float(rows[3]["incidence_deg"]) == pytest.approx(32.5, rel=1e-14)
    text = words_of((tmp_path / "report.html").read_text("utf-8"))
    assert "one ascending pass, looking right , of a real orbit" in text
    assert "6 segments of 9 targets" in text
    assert "off the strip 2 behind the horizon 1" in text
    assert "pass 2 of 3 found in the time searched" in text
    assert "over 6 of 9 targets" in text
    assert "orbit from mean elements with J2" in text
    assert block["orbit_source"] == "mean elements with J2"
    assert "referred to zero Doppler" in text
    assert not re.search(r"\b(nan|NaN|inf|Infinity|None)\b", text)


def test_orbit_of_a_pass_has_its_source_and_age() -> None:
    for days, age in ((3.2, "3.2 days before"), (-0.25, "6.0 hours after"), (0.0, "at the pass")):
        aged = make_observation(
            orbit_source="two-line elements of X",
            orbit_epoch=EPOCH - timedelta(days=days),
            epoch=EPOCH + timedelta(milliseconds=123),
        )
        text = section_text(observation_section(aged))
        assert "orbit from two-line elements of X" in text
        assert f"UTC, {age}" in text
        assert "2024-03-01 00:00:00.123 UTC, the first segment" in text


def test_table_of_segments_leaves_out_none_where_few_would_be() -> None:
    assert "segments.csv has all" not in section_text(
        observation_section(make_observation(segments=25))
    )
    many = section_text(observation_section(make_observation(segments=40)))
    assert "24 of 40; segments.csv has all" in many


def test_whole_revolution_is_not_a_pass_in_one_direction() -> None:
    turn = math.tau / make_observation().orbit.mean_motion
    band = make_observation(segments=9, latitude=0.0)
    around = dataclasses.replace(
        band,
        scene=dataclasses.replace(band.scene, times=np.linspace(0.0, turn, 9)),
        latitude=np.sin(np.linspace(0.0, math.tau, 9)),
        outlines=(),
    )
    text = section_text(observation_section(around))
    assert "a whole revolution, looking right" in text
    assert "ascending at the first segment" in text
    assert "one ascending pass" not in text


def test_constant_incidence_has_no_bar_of_colors() -> None:
    observation = make_observation()
    sloped = dataclasses.replace(
        observation.scene, incidence=observation.scene.look_angle + np.linspace(0.0, 0.1, 6)
    )
    bars = [
        observation_map(one).count(b"axes_")
        for one in (observation, dataclasses.replace(observation, scene=sloped))
    ]
    assert bars[0] < bars[1]


def test_names_on_a_map_keep_apart() -> None:
    figure = Figure(figsize=(4.0, 4.0))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(-1.0, 1.0)
    axes.set_ylim(-1.0, 1.0)
    along = np.linspace(-1.0, 1.0, 101)
    lines = [
        (np.stack([np.full(101, x), along], axis=-1), "far edge, 45°", "k") for x in (0.0, 0.01)
    ]
    name_lines(axes, lines, 1.0)
    figure.canvas.draw()
    first, second = (text.get_window_extent() for text in axes.texts)
    assert not first.overlaps(second)


def test_names_of_meridians_keep_apart() -> None:
    figure = Figure(figsize=(2.0, 2.0))
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    paint_ground(axes, Azimuthal(math.radians(20.0), math.radians(80.0)), 1500.0)
    figure.canvas.draw()
    boxes = [label.get_window_extent() for label in axes.get_xticklabels()]
    assert boxes
    assert not any(one.overlaps(other) for i, one in enumerate(boxes) for other in boxes[:i])


def test_staring_scene_is_reported_with_its_pass(tmp_path: Path) -> None:
    orbit = KeplerianOrbit.circular(altitude=514e3, inclination=1.7, epoch=EPOCH)
    request = SpotlightRequest(
        trajectory=orbit,
        latitude=math.radians(37.751),
        longitude=math.radians(14.993),
        height=3300.0,
        wavelength=0.031,
        resolution=0.25,
        start=0.0,
        stop=11 * 86400.0,
        near_incidence=math.radians(20.0),
        far_incidence=math.radians(55.0),
    )
    plan = plan_spotlight(request)
    staring = staring_scene(request, plan, duration=4.0, segments=5)
    assert staring.duration == 4.0
    result, study = evaluated(staring)
    write_report(result, study=study, provenance=PROVENANCE, out=tmp_path)
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    block = document["observation"]
    assert block["place"]["latitude_rad"] == request.latitude
    # Ahead before zero Doppler, in its plane in the middle, behind after it.
    squints = [one["squint_rad"] for one in block["segments"]]
    assert squints[0] > 0.0 > squints[-1]
    assert squints[2] == pytest.approx(0.0, abs=1e-9)
    text = words_of((tmp_path / "report.html").read_text("utf-8"))
    assert "Where the geometry lies" in text
    assert "37.751° N 14.993° E, 3300 m above the ellipsoid" in text
    assert f"pass 1 of {plan.passes} in the time searched" in text
    assert "how it moves over the scene" in text
    rows = list(csv.DictReader(io.StringIO((tmp_path / "segments.csv").read_text("utf-8"))))
    assert [float(row["since_zero_doppler_s"]) for row in rows] == [-2.0, -1.0, 0.0, 1.0, 2.0]


def test_csv_has_the_digits_that_mean_something() -> None:
    frame = pd.DataFrame({"look_deg": [37.58916666666667], "doppler_hz": [-1.2e-8], "x_m": [1 / 3]})
    _, row, _ = csv_bytes(frame).decode().split("\n")
    assert row == "37.5891667,0.0,0.3333333333333333"


def test_failing_claim_says_what_would_agree_and_why() -> None:
    within = Claim("pitch", "within ±0.07°", 0.075, "°", Verdict.HOLDS, "", -math.inf, 0.08)
    bare = Claim("yaw", "3°", 4.0, "°", Verdict.FAILS, "", 2.9, 3.1)
    rest = Claim("residual", "0", 3.8e-10, "Hz", Verdict.HOLDS, "", -math.inf, 1e-7)
    text = section_text(claims_section((within, bare, rest), "stated inputs"))
    assert "within ±0.07° ≤ 0.08° 0.0750° ✓ holds" in text
    assert "The study gives no reason." in text
    assert "≤ 10⁻⁷ Hz 0 Hz ✓ holds" in text


def test_argument_of_latitude_begins_in_the_first_revolution() -> None:
    degrees = along_orbit(np.radians(np.linspace(360.0, 720.0, 5)) - 1e-12)
    np.testing.assert_allclose(degrees, [0.0, 90.0, 180.0, 270.0, 360.0], atol=1e-6)
    np.testing.assert_allclose(along_orbit(np.radians([350.0, 380.0])), [350.0, 380.0])


def test_defaults_are_listed_in_html_only() -> None:
    listing = CodeListing("filled: in", "defaults", printed=False)
    page = Document("t", "s", "", "p", (Section("study", "The study", (listing,)),))
    assert b"filled: in" in html_bytes(page)
    assert b"filled: in" not in pdf_bytes(page)
    assert len(pdf_bytes(page)) < len(pdf_bytes(_printed(page)))


def _printed(page: Document) -> Document:
    (section,) = page.sections
    listing = section.blocks[0]
    assert isinstance(listing, CodeListing)
    blocks = (listing._replace(printed=True, text="filled: in\n" * 200),)
    return dataclasses.replace(page, sections=(section._replace(blocks=blocks),))


def test_segments_of_an_area_are_not_joined_by_a_line() -> None:
    scene = make_observation().scene
    assert series_line(0, scene)["linestyle"] == "-"
    aside = scene.look_angle + 0.01 * (-1.0) ** np.arange(len(scene))
    area = dataclasses.replace(scene, look_angle=aside)
    assert series_line(0, area) == {"linestyle": "", "marker": "o"}


def test_report_without_an_orbit_has_no_map() -> None:
    result, study = evaluated(make_observation())
    given = dataclasses.replace(study, observation=None)
    assert "Where the geometry lies" not in page_text(result, given)
    assert "observation" not in document_of(result, given)


def test_eccentric_orbit_is_a_warning_for_the_relative_motion() -> None:
    title = "The reference orbit is not a circle"
    text = section_text(observation_section(make_observation()))
    assert title not in text
    assert "a mean eccentricity of 0.00110" in text
    assert title in section_text(observation_section(make_observation(eccentricity=0.02)))


@pytest.mark.parametrize(
    ("latitude", "longitude", "segments"),
    [(37.75, 15.0, 6), (-17.0, 179.95, 30), (-89.95, 40.0, 3), (88.0, 0.0, 1)],
)
def test_maps_over_the_date_line_and_the_poles(
    latitude: float, longitude: float, segments: int
) -> None:
    drawn = observation_map(make_observation(latitude, longitude, segments=segments))
    assert drawn.count(b"<svg") == 1
    assert b"nan" not in drawn.lower().replace(b"nano", b"")


def test_azimuthal_projection_keeps_distance_and_direction_from_the_center() -> None:
    projection = Azimuthal(math.radians(179.0), math.radians(60.0))
    # A degree north of the center, and a point across the date line at the same latitude.
    north = projection(math.radians(179.0), math.radians(61.0))
    np.testing.assert_allclose(north, [0.0, math.radians(1.0) * EARTH_RADIUS_KM], atol=1e-9)
    east = projection(math.radians(-179.0), math.radians(60.0))
    arc = 2.0 * math.asin(math.cos(math.radians(60.0)) * math.sin(math.radians(1.0)))  # haversine
    assert math.hypot(*east) == pytest.approx(arc * EARTH_RADIUS_KM, rel=1e-12)
    assert east[0] > 0.0


def test_center_of_points_over_the_date_line_and_a_pole() -> None:
    lon, lat = center_of(np.radians([179.0, -179.0]), np.radians([10.0, 10.0]))
    assert abs(math.degrees(lon)) == pytest.approx(180.0)
    # The middle of a parallel's chord lies poleward of it, by δλ² sin 2φ/4 for small δλ.
    assert math.degrees(lat) == pytest.approx(10.0, abs=0.002)
    _, lat = center_of(np.radians([0.0, 90.0, 180.0, 270.0]), np.radians([89.0] * 4))
    assert math.degrees(lat) == pytest.approx(90.0, abs=1e-9)


@pytest.mark.parametrize(
    ("place", "is_land"),
    [
        ((14.2, 37.6), True),  # Sicily
        ((17.5, 36.5), False),  # Ionian Sea
        ((0.0, -89.9), True),  # Antarctica
        ((0.0, 89.9), False),  # Arctic Ocean
        ((179.0, 67.0), True),  # Chukotka, cut by the date line in many outlines
        ((-150.0, 0.0), False),  # Pacific, the antipode of land
        ((100.0, 60.0), True),  # Siberia
    ],
)
@pytest.mark.parametrize("globe", [False, True])
def test_land_is_where_it_is_in_any_projection(
    place: tuple[float, float], is_land: bool, globe: bool
) -> None:
    """The middle of a map is filled exactly where there is land, whatever lies at the antipode."""
    projection = Azimuthal(*np.radians(place), globe=globe)
    path = filled_path(land_outline().land, projection, reach=math.pi / 2)
    winding = 0.0
    for ring in path.to_polygons(closed_only=True):
        angle = np.unwrap(np.arctan2(ring[:, 1], ring[:, 0]))
        winding += (angle[-1] - angle[0]) / (2.0 * math.pi)
    assert (round(winding) != 0) is is_land


def test_land_covers_its_known_share_of_the_globe() -> None:
    """Area by the line integral of sin φ dλ: 29.2 % of the sphere, the Caspian Sea aside."""
    outline = land_outline()
    total = 0.0
    for ring in outline.land:
        lon, lat = np.unwrap(ring[:, 0]), ring[:, 1]
        middle = 0.5 * (np.sin(lat[:-1]) + np.sin(lat[1:]))
        area = -float(np.sum(middle * np.diff(lon)))
        # A ring around the South Pole contains what lies below it.
        total += area + (2.0 * math.pi if abs(lon[-1] - lon[0]) > math.pi else 0.0)
    assert total / (4.0 * math.pi) == pytest.approx(0.292, abs=0.004)
    assert len(outline.water) == 1
