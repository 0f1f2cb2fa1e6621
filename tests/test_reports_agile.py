"""Reports of spotlight, video and coverage: words, contract, moving figure, odd results."""

from __future__ import annotations

import dataclasses
import html
import itertools
import json
import math
import re
from datetime import UTC, datetime
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from formation import KeplerianOrbit, Trajectory, raan_from_longitude
from insar import Claim, LookSide, Verdict
from insar.observe.agile.agility import Agility
from insar.observe.agile.spotlight import spotlight
from insar.observe.agile.spotlight_results import Pointing, SpotlightRequest, SpotlightResult
from insar.observe.agile.video import video
from insar.observe.agile.video_request import VideoRequest, YawLaw
from insar.observe.agile.video_results import VideoResult
from insar.observe.coverage.results import Coverage, CoverageResult
from insar.observe.coverage.simulation import simulate_coverage, symmetric_longitudes
from insar.observe.coverage.sizing import sizing_shortfall, walker_sizing
from insar.observe.coverage.walker import Visibility, Walker
from insar.observe.coverage.walker_search import smallest_walker
from reports import Provenance, StudyInfo, write_report
from reports.agile_words import visibility_text
from reports.figures.coverage import shortfall_steps
from reports.figures.footprints_moving import moving_footprints
from reports.html import html_bytes
from reports.json_result import result_json, result_schema
from reports.pages import page_of
from reports.pages.coverage_verdict import share_text, time_text
from reports.pages.turning import limit_text
from reports.reading_agile import demand, is_limited, passage_of, path_length
from reports.tables_coverage import best_frame
from reports.tables_spotlight import spotlight_frame
from reports.wording import significant

EPOCH = datetime(2016, 11, 25, 8, 9, 43, tzinfo=UTC)
DAY = 86400.0
SASEBO = (math.radians(33.16), math.radians(129.72))

PROVENANCE = Provenance(
    version="0.2.0",
    seed=None,
    python="3.11.7",
    platform="Linux",
    packages={"numpy": "2.0"},
    started="2026-01-01T00:00:00+00:00",
    wall_s=1.5,
    evaluations=0,
    command="formation-opt han2016_spotlight",
)

CLAIMS = (
    Claim("ground speed", "6894 m/s", 6894.07, "m/s", Verdict.HOLDS, "inferred inputs"),
    Claim("resolution", "0.6 m", 0.7, "m", Verdict.FAILS, "inferred inputs"),
)


def study_of(kind: str) -> StudyInfo:
    return StudyInfo(
        name="Agile",
        kind=kind,
        description="",
        source_text=f"kind: {kind}\n",
        config_sha256="0" * 64,
    )


def orbit() -> KeplerianOrbit:
    """514 km, sun-synchronous; Sasebo is seen to the right at a look of about 30°."""
    return KeplerianOrbit.circular(
        altitude=514e3,
        inclination=math.radians(97.44),
        epoch=EPOCH,
        raan=raan_from_longitude(math.radians(131.25746), epoch=EPOCH),
        argument_of_latitude=math.radians(32.75796),
    )


def make_spotlight(**changes: object) -> SpotlightResult:
    values = {
        "trajectory": orbit(),
        "latitude": SASEBO[0],
        "longitude": SASEBO[1],
        "wavelength": 0.031,
        "resolution": 0.5,
        "start": -300.0,
        "stop": 300.0,
        "off_axis": math.radians(5.0),
        "phase_center": (1.2, -0.4, 1.5),
        "agility": Agility(max_rate=math.radians(1.0), max_acceleration=math.radians(0.1)),
    }
    return spotlight(SpotlightRequest(**(values | changes)), 61)


def make_video(**changes: object) -> VideoResult:
    values = {
        "trajectory": orbit(),
        "latitude": SASEBO[0],
        "longitude": SASEBO[1],
        "wavelength": 0.031,
        "resolution": 1.0,
        "frame_rate": 0.4,
        "duration": 120.0,
        "start": -300.0,
        "stop": 300.0,
        "azimuth_beamwidth": math.radians(0.5),
        "elevation_beamwidth": math.radians(1.2),
        "max_overlap": 0.5,
        "pointing_error": (1e-4, 1e-4, 1e-4),
        "agility": Agility(max_rate=math.radians(1.0)),
    }
    return video(VideoRequest(**(values | changes)), 61, 9)


WIDE = Visibility(max_incidence=math.radians(70.0), min_incidence=math.radians(20.0))
RIGHT = dataclasses.replace(WIDE, side=LookSide.RIGHT)


def make_simulation(walker: Walker, latitudes: tuple[float, ...] = (0.0, 30.0, 60.0)) -> Coverage:
    return simulate_coverage(
        walker,
        latitude=np.radians(latitudes)[:, None],
        longitude=symmetric_longitudes(walker, 2)[None, :],
        visibility=WIDE,
        duration=0.5 * DAY,
    )


def make_coverage(*, totals: tuple[int, ...] = (38, 39, 40)) -> CoverageResult:
    sizing = walker_sizing(altitude=600e3, max_incidence=math.radians(60.0))
    shortfall = sizing_shortfall(
        sizing,
        latitude=SASEBO[0],
        inclination=math.radians(97.6),
        visibility=dataclasses.replace(RIGHT, max_incidence=sizing.max_incidence),
    )
    search = smallest_walker(
        altitude=2000e3,
        inclinations=[math.radians(45.0)],
        totals=totals,
        latitudes=(math.radians(20.0), math.radians(45.0)),
        visibility=WIDE,
    )
    walkers = [Walker(total=24, planes=6, phasing=1, inclination=1.7, altitude=600e3)]
    walkers += [] if search.best is None else [search.best]
    return CoverageResult(
        shortfall=shortfall,
        simulations=tuple(make_simulation(walker) for walker in walkers),
        search=search,
        warnings=(),
    )


@pytest.fixture(scope="module")
def image() -> SpotlightResult:
    return dataclasses.replace(make_spotlight(), claims=CLAIMS)


@pytest.fixture(scope="module")
def film() -> VideoResult:
    return make_video()


@pytest.fixture(scope="module")
def covered() -> CoverageResult:
    return make_coverage()


RESULTS = {
    "spotlight": lambda: dataclasses.replace(make_spotlight(), claims=CLAIMS),
    "video": make_video,
    "coverage": make_coverage,
}

TABLES = {
    "spotlight": {"spotlight.csv", "claims.csv"},
    "video": {"video.csv", "frames.csv", "footprints.csv", "yaw_laws.csv"},
    "coverage": {"coverage.csv", "candidates.csv"},
}

ODD_RESULTS = {
    "spotlight, not agile": lambda: make_spotlight(
        agility=Agility(max_rate=(0.01, 0.001, math.inf), max_acceleration=1e-6)
    ),
    "spotlight, beyond the horizon": lambda: make_spotlight(duration=1400.0, agility=None),
    "spotlight, sliding, plain antenna": lambda: make_spotlight(
        sliding_factor=0.4, scene_length=5e3, off_axis=0.0, phase_center=(0.0, 0.0, 0.0)
    ),
    "spotlight, beam off the Earth": lambda: make_spotlight(off_axis=math.radians(-60.0)),
    "video, no overlap allowed": lambda: make_video(max_overlap=0.0, agility=None),
    "video, axis lost and beyond the horizon": lambda: make_video(
        yaw_law=YawLaw.MAJOR_AXIS, duration=700.0, pointing_error=(0.0, 0.0, 0.0)
    ),
    "video, no yaw": lambda: make_video(yaw_law=YawLaw.NONE),
    "video, beam wider than the Earth": lambda: make_video(
        elevation_beamwidth=math.radians(85.0), azimuth_beamwidth=math.radians(85.0)
    ),
    "video, resolution out of reach": lambda: make_video(resolution=0.02),
    "coverage, nothing found": lambda: make_coverage(totals=(20,)),
    "coverage, one place": lambda: CoverageResult(
        shortfall=None,
        simulations=(
            make_simulation(
                Walker(total=4, planes=2, phasing=0, inclination=0.3, altitude=600e3), (70.0,)
            ),
        ),
        search=None,
        warnings=("take care",),
    ),
    "coverage, nothing asked": lambda: CoverageResult(
        shortfall=None, simulations=(), search=None, warnings=()
    ),
}


def kind_of(result: object) -> str:
    return {
        SpotlightResult: "spotlight",
        VideoResult: "video",
        CoverageResult: "coverage",
    }[type(result)]


def words_of(page: str) -> str:
    words = re.sub(r"<(style|script).*?</\1>|<[^>]+>", " ", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", html.unescape(words))


def page_text(result: object) -> str:
    page = page_of(result).document(result, study_of(kind_of(result)), PROVENANCE)
    return words_of(html_bytes(page).decode())


def document_of(result: object) -> dict:
    body = page_of(result).json(result)
    return json.loads(result_json(body, study=study_of(kind_of(result)), provenance=PROVENANCE))


# -- every kind ----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", RESULTS)
def test_report_is_written_whole(kind: str, tmp_path: Path) -> None:
    paths = write_report(RESULTS[kind](), study=study_of(kind), provenance=PROVENANCE, out=tmp_path)
    expected = TABLES[kind] | {"result.json", "report.html", "report.pdf"}
    assert {path.name for path in paths} == expected
    jsonschema.validate(json.loads((tmp_path / "result.json").read_text("utf-8")), result_schema())
    for table in TABLES[kind]:
        assert not re.search(r"\b(nan|inf)\b", (tmp_path / table).read_text("utf-8"))


@pytest.mark.parametrize("name", ODD_RESULTS)
def test_odd_results_are_reported_in_full(name: str, tmp_path: Path) -> None:
    odd = ODD_RESULTS[name]()
    write_report(odd, study=study_of(kind_of(odd)), provenance=PROVENANCE, out=tmp_path)
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    text = words_of((tmp_path / "report.html").read_text("utf-8"))
    assert not re.search(r"\b(nan|NaN|inf|Infinity|None)\b", text)


@pytest.mark.parametrize(
    ("kind", "break_it"),
    [
        ("spotlight", lambda d: d["spotlight"].pop("plan")),
        ("spotlight", lambda d: d["spotlight"]["plan"].update(side="up")),
        ("spotlight", lambda d: d["spotlight"]["maneuver"].update(yaw_rad=[0.0])),
        ("spotlight", lambda d: d["spotlight"].update(solved_fraction=2.0)),
        ("video", lambda d: d["video"]["yaw_laws"].clear()),
        ("video", lambda d: d["video"].update(yaw_law="sideways")),
        ("video", lambda d: d["study"].update(kind="spotlight")),
        ("coverage", lambda d: d["coverage"]["search"]["verdicts"].update(perhaps=1)),
        ("coverage", lambda d: d["coverage"]["simulations"][0].update(min_cover=-0.1)),
    ],
)
def test_schema_refuses_what_breaks_the_contract(kind, break_it, image, film, covered) -> None:
    document = document_of({"spotlight": image, "video": film, "coverage": covered}[kind])
    jsonschema.validate(document, result_schema())
    break_it(document)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(document, result_schema())


# -- spotlight -----------------------------------------------------------------------------------


def test_spotlight_verdict_tells_agility_and_claims(image: SpotlightResult) -> None:
    text = page_text(image)
    rate = np.linalg.norm(image.profile.rate_inertial, axis=-1).max()
    assert f"{significant(math.degrees(rate))}°/s" in text
    assert f"{100.0 * rate / math.radians(1.0):.0f} % of the allowed rate" in text
    assert "but a printed figure does not hold" in text
    assert "1 of 2 printed figures follow from the inputs of this study, 1 do not" in text
    assert "Within the agility" in page_text(dataclasses.replace(image, claims=()))


def test_a_satellite_that_is_not_agile_enough_is_called_so() -> None:
    slow = ODD_RESULTS["spotlight, not agile"]()
    text = page_text(slow)
    assert "not agile enough for 100 % of the time" in text
    assert "The body would have to turn faster" in text  # the warning, as a sentence
    assert document_of(slow)["spotlight"]["maneuver"]["rate_limit_rad_s"] == [0.01, 0.001, None]


def test_what_is_known_of_no_sample_is_null_with_a_reason() -> None:
    """A beam that has no attitude exceeds no limit, and keeps none."""
    image = make_spotlight(agility=Agility(max_rate=1e-6))
    exceeded = document_of(image)["spotlight"]["maneuver"]
    assert (exceeded["rate_exceeded_fraction"], exceeded["reason"]) == (1.0, None)
    outcome = np.full_like(image.profile.outcome, Pointing.BELOW_HORIZON)
    lost = dataclasses.replace(image, profile=image.profile._replace(outcome=outcome))
    maneuver = document_of(lost)["spotlight"]["maneuver"]
    for name in ("rate_exceeded_fraction", "acceleration_exceeded_fraction", "singular_fraction"):
        assert maneuver[name] is None
    assert "100 % of the samples" in maneuver["reason"].replace("\u00a0", " ")
    # Of some: the share is that of the others.
    outcome = np.where(np.arange(len(outcome)) < 10, Pointing.BELOW_HORIZON, 0)
    partly = dataclasses.replace(image, profile=image.profile._replace(outcome=outcome))
    assert document_of(partly)["spotlight"]["maneuver"]["rate_exceeded_fraction"] == 1.0


def test_inferred_inputs_are_named_in_the_result(image: SpotlightResult) -> None:
    study = dataclasses.replace(study_of("spotlight"), inferred=(("orbit.altitude_km", "514"),))
    document = json.loads(
        result_json(page_of(image).json(image), study=study, provenance=PROVENANCE)
    )
    jsonschema.validate(document, result_schema())
    assert document["study"]["inferred"] == [{"key": "orbit.altitude_km", "value": "514"}]


def test_aim_errors_that_are_rounding_are_zero(image: SpotlightResult) -> None:
    text = page_text(image)
    assert "Everything, closed form 0 0" in text
    lost = image.aim_error.without_both
    assert f"{lost.max() / 1e3:.0f} km" in text or f"{lost.max():.0f}" in text
    off = document_of(ODD_RESULTS["spotlight, beam off the Earth"]())["spotlight"]["aim_error"]
    assert off["max_without_both_m"] is None
    assert "never meets the Earth" in off["reason"]


def test_spotlight_csv_has_the_profile(image: SpotlightResult) -> None:
    frame = spotlight_frame(image)
    np.testing.assert_array_equal(frame["pitch_deg"], np.degrees(image.profile.pitch))
    parts = [f"quaternion_inertial_{part}" for part in ("i", "j", "k", "scalar")]
    np.testing.assert_array_equal(frame[parts], image.profile.quaternion_inertial)
    assert set(frame["outcome"]) == {"solved"}


def test_share_of_a_limit_is_that_of_the_axis_that_needs_most() -> None:
    vectors = np.array([[0.3, 0.4, 0.0], [0.0, np.nan, 0.0]])
    assert demand(vectors, 1.0) == pytest.approx((0.5, 0.5))
    assert demand(vectors, (1.0, 0.2, math.inf)) == pytest.approx((0.5, 2.0))
    assert math.isnan(demand(vectors, None).share)
    assert math.isnan(demand(vectors, math.inf).share)
    assert not is_limited(Agility())
    assert limit_text((math.radians(1.0), math.inf, math.radians(0.5))) == "X 1, Y none, Z 0.5"


def test_passage_sees_the_satellite_where_the_plan_does(image: SpotlightResult) -> None:
    passage = passage_of(image)
    middle = np.argmin(np.abs(passage.times))
    assert passage.times[0] < image.times[0] < image.times[-1] < passage.times[-1]
    # The times of the map are not those of the plan: up to 20 ms or 1e-3 rad apart.
    assert passage.zenith_angle[middle] == pytest.approx(image.plan.incidence, abs=1e-3)
    # A satellite that flies north and looks right stands west of the place.
    assert image.plan.ascending
    assert image.plan.side is LookSide.RIGHT
    assert passage.azimuth[middle] == pytest.approx(-math.pi / 2, abs=0.3)


class Gaps:
    """A trajectory that is known around zero Doppler only."""

    def __init__(self, of: Trajectory, until: float) -> None:
        self.epoch, self.span = of.epoch, of.span
        self._of, self._until = of, until

    def inertial(self, times):
        return self._of.inertial(times)

    def earth_fixed(self, times):
        if np.max(np.abs(times)) > self._until:
            raise ValueError("gap")
        return self._of.earth_fixed(times)


def test_passage_over_a_gap_is_that_of_the_imaging(image: SpotlightResult) -> None:
    known = Gaps(image.request.trajectory, 10.0)
    request = dataclasses.replace(image.request, trajectory=known)
    passage = passage_of(dataclasses.replace(image, request=request))
    assert (passage.times[0], passage.times[-1]) == (image.times[0], image.times[-1])


def test_path_length_over_the_date_line() -> None:
    longitude = np.radians([179.5, -179.5, np.nan])
    assert path_length(np.zeros(2), longitude[:2]) == pytest.approx(math.radians(1.0) * 6371e3)


# -- video ---------------------------------------------------------------------------------------


def test_video_verdict_tells_frames_and_rotation(film: VideoResult) -> None:
    text = page_text(film)
    assert f"Of {len(film.frames.times)} frames" in text
    assert f"{film.frames.exact.independent_rate.min():.3g} Hz" in text
    law = film.laws[list(YawLaw).index(film.request.yaw_law)]
    assert (
        f"azimuth trace turns by 0°, its range trace by {math.degrees(law.range_trace):.1f}°"
        in text
    )
    assert "azimuth trace held (this film)" in text
    shared = film.frames.exact.overlap.max()
    assert ("more data in common than is allowed" in text) == (shared > 0.5)


def test_moving_figure_has_a_frame_for_each_outline(film: VideoResult) -> None:
    figure = moving_footprints(film, passage_of(film))
    assert len(figure["frames"]) == len(film.footprints.times)
    numbers = figure["frames"][0]["traces"]
    assert len(figure["data"]) == numbers[-1] + 1
    slider = figure["layout"]["sliders"][0]
    assert [step["args"][0][0] for step in slider["steps"]] == [
        frame["name"] for frame in figure["frames"]
    ]
    assert slider["steps"][0]["label"].startswith("−60.0 s · roll ")
    # The footprint of a frame surrounds the aim point, and its line of sight ends there.
    sight, outline = figure["frames"][4]["data"]
    assert (sight["x"][1], sight["y"][1]) == (0.0, 0.0)
    assert min(outline["x"]) < 0.0 < max(outline["x"])
    json.dumps(figure, allow_nan=False)


def test_html_tells_what_a_moving_figure_does(film: VideoResult) -> None:
    page = html_bytes(page_of(film).document(film, study_of("video"), PROVENANCE)).decode()
    assert "Play, or drag the slider." in page
    assert "drag to turn them" not in page
    assert '"frames": [{' in page


def test_laws_that_hold_a_direction_leave_none_of_it(film: VideoResult) -> None:
    frame = page_of(film).csv(film)["yaw_laws.csv"].set_index("law")
    for law in ("azimuth_trace", "range_trace", "major_axis"):
        assert abs(frame.loc[law, f"{law}_deg"]) < 1e-6
    assert frame["shear_deg"].min() > 1.0


# -- coverage ------------------------------------------------------------------------------------


def test_coverage_verdict_tells_shortfall_and_proof(covered: CoverageResult) -> None:
    text = page_text(covered)
    assert covered.search is not None
    assert covered.search.best is not None
    assert "40 satellites keep the band in view at all times" in text
    assert "15 planes of 24 satellites, 360 in all" in text
    assert covered.shortfall is not None
    assert share_text(covered.shortfall.all_reasons).replace("\u00a0", " ") in text
    assert "Within the band of the search it is 100 %" in text  # 60° is beyond it


def test_no_constellation_found_is_not_a_success() -> None:
    text = page_text(make_coverage(totals=(20,)))
    assert "The range of the search is too small for any pattern to do" in text


def test_waterfall_ends_where_the_reasons_do(covered: CoverageResult) -> None:
    assert covered.shortfall is not None
    steps = shortfall_steps(covered.shortfall)
    assert steps[0].before == covered.shortfall.in_plane
    assert all(one.after == other.before for one, other in itertools.pairwise(steps))
    assert steps[-1].after == covered.shortfall.all_reasons


def test_best_of_each_number_of_satellites(covered: CoverageResult) -> None:
    assert covered.search is not None
    best = best_frame(covered.search, 2)
    assert best["satellites"].tolist() == [39, 40]
    assert best["verdict"].tolist() == ["gaps", "continuous"]
    found = covered.search.candidates
    assert best["cover"][0] == found.cover[found.total == 39].max()


def test_shares_and_times_in_words() -> None:
    assert [share_text(share) for share in (0.0, 0.99949, 0.9999999)] == [
        "0.0\u00a0%",
        "99.9\u00a0%",
        "> 99.9\u00a0%",
    ]
    assert [time_text(seconds) for seconds in (0.0, 90.0, 3600.0, 86400.0)] == [
        "none",
        "90.0\u00a0s",
        "60.0\u00a0min",
        "24.0\u00a0h",
    ]
    assert visibility_text(RIGHT) == "incidence 20° … 70°, to the right only"
