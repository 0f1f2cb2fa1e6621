"""Reports: contract of result.json, texts as data, one file without network, odd results."""

from __future__ import annotations

import copy
import csv
import dataclasses
import html
import io
import json
import math
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import jsonschema
import numpy as np
import pandas as pd
import pytest

from formation import Orbit, equally_spaced, ground_track_circular
from insar import ErrorBudget, ErrorSource, Radar, Scene, SharedBy, one_transmitter, ping_pong
from insar.dem import DTED2, HRTI4, Resolution, Specification
from optimize import (
    Assessment,
    Constraints,
    DemRequest,
    DesignSpace,
    EvaluateResult,
    FailureLimit,
    GeneticSettings,
    OptimizeResult,
    Problem,
    SearchSettings,
    assess,
    dem_verdict,
    search,
)
from reports import Provenance, StudyInfo, write_report
from reports.document import Column, Document, Figure, Section, Strong, Symbol, Table
from reports.figures.convergence import convergence_figure
from reports.figures.orbits import half_extents
from reports.figures.orbits_interactive import interactive_orbits
from reports.html import html_bytes
from reports.json_result import result_json, result_schema
from reports.pages import page_of
from reports.pdf import pdf_bytes
from reports.reading import active, drawn_baselines, listed_pairs
from reports.wording import to_digits

ORBIT = Orbit.circular(altitude=514e3, inclination=1.7)
RADIUS = 1350.0

ATTACKS = (
    "<script>alert(1)</script>",
    '#include "x"',
    "$x$ *bold* _under_",
    '"quote" & ]',
    "\\ #panic() `raw` </script>",
)


def make_problem(*, satellites: int = 3, segments: int = 4, **limits: float) -> Problem:
    scene = Scene.broadside_strip(
        times=np.linspace(0.0, 9.0, segments),
        look_angle=math.radians(23.0),
        altitude=514e3,
        earth_radius=6378137.0,
    )
    radar = Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=16.0,
        images=one_transmitter(satellites),
    )
    errors = ErrorBudget(
        position=ErrorSource(0.001, SharedBy.SATELLITE), range=ErrorSource(0.01, SharedBy.ALL)
    )
    constraints = Constraints(**({"max_radius": RADIUS, "min_separation": 100.0} | limits))
    return Problem(
        mean_motion=ORBIT.mean_motion,
        scene=scene,
        radar=radar,
        errors=errors,
        constraints=constraints,
    )


def make_space(names: tuple[str, ...]) -> DesignSpace:
    return DesignSpace(
        names=names,
        family=ground_track_circular,
        mean_motion=ORBIT.mean_motion,
        max_offset=RADIUS / 2.0,
        max_rate=RADIUS / 2.0 * ORBIT.mean_motion,
    )


def circle(problem: Problem, names: tuple[str, ...], label: str, radius: float) -> Assessment:
    z0, zdot0 = equally_spaced(len(names), radius=radius, mean_motion=problem.mean_motion)
    states = ground_track_circular(z0, zdot0, mean_motion=problem.mean_motion)
    return assess(problem, states, label=label, names=names)


def optimized(
    problem: Problem, names: tuple[str, ...] = ("1", "2", "3"), refinements: int = 1
) -> OptimizeResult:
    space = make_space(names)
    settings = SearchSettings(GeneticSettings(population=12, generations=4), refinements)
    found = search(problem, space, settings=settings, rng=np.random.default_rng(1))
    return OptimizeResult(
        problem=problem,
        critical_baseline=2707.0,
        initial=circle(problem, names, "initial", RADIUS),
        best=assess(problem, space.states(found.design), label="best", names=names),
        compare=(),
        search=found,
        notices=(),
        warnings=(),
    )


def study_info(kind: str = "optimize", **changes: str) -> StudyInfo:
    info = StudyInfo(
        name="Three satellites",
        kind=kind,
        description="A strip to the left.",
        source_text="kind: optimize\n",
        config_sha256="0" * 64,
        orbit_altitude=514e3,
        inclination=1.7,
    )
    return dataclasses.replace(info, **changes)


PROVENANCE = Provenance(
    version="0.1.0",
    seed=1,
    python="3.11.7",
    platform="Linux",
    packages={"numpy": "2.0"},
    started="2026-01-01T00:00:00+00:00",
    wall_s=1.5,
    evaluations=100,
    command="formation-opt three_sat",
)


def rendered_html(result: object, study: StudyInfo) -> str:
    return html_bytes(page_of(result).document(result, study, PROVENANCE)).decode()


class Page(HTMLParser):
    """Tags with their attributes, and the text outside scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self._quiet = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self._quiet = tag in ("script", "style")

    def handle_endtag(self, tag: str) -> None:
        self._quiet = False

    def handle_data(self, data: str) -> None:
        if not self._quiet:
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(self.words)


@pytest.fixture(scope="module")
def result() -> OptimizeResult:
    problem = make_problem(min_unwrapping_probability=0.99, prior_height_std=4.0)
    names = ("1", "2", "3")
    found = optimized(problem, names)
    wide = circle(problem, names, "wide", 3.0 * RADIUS)
    return dataclasses.replace(
        found, compare=(wide,), notices=("Stopped early.",), warnings=("Check the prior DEM.",)
    )


def no_baseline() -> OptimizeResult:
    problem = make_problem(prior_height_std=4.0)
    found = optimized(problem)
    still = assess(problem, np.zeros((3, 6)), label="still", names=("1", "2", "3"))
    return dataclasses.replace(found, initial=still, best=still)


def interrupted() -> OptimizeResult:
    found = optimized(make_problem(), refinements=0)
    cut = dataclasses.replace(found.search, interrupted=True, history=found.search.history[:1])
    return dataclasses.replace(found, search=cut)


def evaluated() -> EvaluateResult:
    problem = make_problem(prior_height_std=4.0)
    names = ("1", "2", "3")
    return EvaluateResult(
        problem=problem,
        critical_baseline=2707.0,
        formation=circle(problem, names, "given", RADIUS),
        compare=(circle(problem, names, "small", 500.0),),
        warnings=(),
    )


def switching_transmitters() -> EvaluateResult:
    problem = make_problem(satellites=2, prior_height_std=4.0)
    problem = dataclasses.replace(
        problem, radar=dataclasses.replace(problem.radar, images=ping_pong(2))
    )
    return EvaluateResult(
        problem=problem,
        critical_baseline=1353.0,
        formation=circle(problem, ("A", "B"), "given", 400.0),
        compare=(),
        warnings=(),
    )


def planar() -> EvaluateResult:
    """A cartwheel without cross-track motion."""
    problem, phase = make_problem(), 2.0 * math.pi * np.arange(3) / 3.0
    states = np.zeros((3, 6))
    states[:, 0], states[:, 1] = 300.0 * np.cos(phase), -600.0 * np.sin(phase)
    states[:, 3:5] = ORBIT.mean_motion * np.stack([states[:, 1] / 2.0, -2.0 * states[:, 0]], -1)
    given = assess(problem, states, label="formation", names=("1", "2", "3"))
    return EvaluateResult(
        problem=problem, critical_baseline=2707.0, formation=given, compare=(), warnings=()
    )


def crowd(satellites: int = 12) -> EvaluateResult:
    problem = make_problem(satellites=satellites, prior_height_std=4.0)
    names = tuple(f"S{number}" for number in range(1, satellites + 1))
    given = circle(problem, names, "formation", RADIUS)
    return EvaluateResult(
        problem=problem, critical_baseline=2707.0, formation=given, compare=(), warnings=()
    )


ODD_RESULTS = {
    "no feasible formation": lambda: optimized(make_problem(min_separation=1e5)),
    "no baseline": no_baseline,
    "interrupted": interrupted,
    "eight satellites": lambda: optimized(make_problem(satellites=8), tuple("ABCDEFGH")),
    "one segment": lambda: optimized(make_problem(satellites=2, segments=1), ("1", "2")),
    "no limits": lambda: optimized(make_problem(max_radius=None, min_separation=None)),
    "given formation": evaluated,
    "several transmitters": switching_transmitters,
    "planar": planar,
    "crowd": crowd,
}


def kind_of(result: object) -> str:
    return "evaluate" if isinstance(result, EvaluateResult) else "optimize"


def test_every_file_is_written_whole_and_nothing_else(
    result: OptimizeResult, tmp_path: Path
) -> None:
    paths = write_report(result, study=study_info(), provenance=PROVENANCE, out=tmp_path / "out")
    names = {"result.json", "height_error.csv", "formation.csv", "report.html", "report.pdf"}
    assert {path.name for path in paths} == names
    assert {path.name for path in (tmp_path / "out").iterdir()} == names
    assert (tmp_path / "out" / "report.pdf").read_bytes().startswith(b"%PDF-")


def test_a_failed_write_leaves_the_old_file_and_no_other(
    result: OptimizeResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise OSError("disk full")

    (tmp_path / "result.json").write_text("old")
    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        write_report(result, study=study_info(), provenance=PROVENANCE, out=tmp_path, formats=())
    assert [path.name for path in tmp_path.iterdir()] == ["result.json"]
    assert (tmp_path / "result.json").read_text() == "old"


def test_same_result_gives_same_bytes(result: OptimizeResult, tmp_path: Path) -> None:
    later = dataclasses.replace(PROVENANCE, started="2027-01-01T00:00:00+00:00", wall_s=9.0)
    for name, provenance in (("a", PROVENANCE), ("b", PROVENANCE), ("c", later)):
        formats = ("html", "pdf") if name != "c" else ()
        write_report(
            result,
            study=study_info(),
            provenance=provenance,
            out=tmp_path / name,
            formats=formats,
        )
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes(), path.name
    first, other = (json.loads((tmp_path / n / "result.json").read_text()) for n in "ac")
    assert first.pop("provenance") != other.pop("provenance")
    assert first == other


def test_unknown_formats_and_results_are_refused(result: OptimizeResult, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"'docx'.* choose of html, pdf"):
        write_report(
            result, study=study_info(), provenance=PROVENANCE, out=tmp_path, formats=("docx",)
        )
    with pytest.raises(TypeError, match="no report page for str"):
        write_report("text", study=study_info(), provenance=PROVENANCE, out=tmp_path)


def test_json_keeps_its_contract(result: OptimizeResult, tmp_path: Path) -> None:
    write_report(result, study=study_info(), provenance=PROVENANCE, out=tmp_path, formats=())
    text = (tmp_path / "result.json").read_text("utf-8")
    assert text.endswith("}\n")
    document = json.loads(text)
    schema = result_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(document, schema)
    best = document["best"]
    assert best["height_error"]["region_rms_m"] == float(result.best.height_error.region)
    squares = sum(term**2 for term in best["height_error"]["terms_m"].values())
    assert math.sqrt(squares) == pytest.approx(best["height_error"]["region_rms_m"], rel=1e-12)
    assert best["pairs"][1]["images"] == ["1→1", "1→3"]
    assert best["pairs"][1]["satellites"] == ["1", "3"]
    proof = document["certificate"]
    assert proof["lower_bound_m"] is proof["gap"] is None
    assert proof["reason"] == "it was not tried"
    assert document["warnings"] == ["Stopped early.", "Check the prior DEM."]


@pytest.fixture(scope="module")
def judged(result: OptimizeResult) -> OptimizeResult:
    """The result with an elevation model that passes one class and fails two."""
    mine = Specification(name="mine", relative_90=0.9 * _relative(result), absolute_90=1e-4)
    request = DemRequest(
        posting=12.0,
        resolution=Resolution(slant_range=3.0, azimuth=3.0),
        specifications=(DTED2, HRTI4, mine),
    )
    positions = result.best.scene_positions
    verdict = dem_verdict(result.problem, positions, label="best", request=request)
    return dataclasses.replace(result, dem=verdict)


def _relative(result: OptimizeResult) -> float:
    plain = dem_verdict(
        result.problem, result.best.scene_positions, label="best", request=DemRequest()
    )
    return float(plain.accuracy.relative_90.max())


def test_elevation_model_is_judged_in_words_and_numbers(judged: OptimizeResult) -> None:
    page = page_of(judged)
    found = page.document(judged, study_info(), PROVENANCE)
    sections = {section.key: section for section in found.sections}
    callout = sections["dem"].blocks[0]
    assert callout.title == "The elevation model passes DTED-2 and fails HRTI-4, mine"
    assert any("It would pass with" in line for line in callout.paragraphs)
    assert any("No single item of the budget" in line for line in callout.paragraphs)
    figures = [b for b in sections["improvements"].blocks if isinstance(b, Figure)]
    assert len(figures) == 1
    text = result_json(page.json(judged), study=study_info(), provenance=PROVENANCE)
    document = json.loads(text)
    jsonschema.validate(document, result_schema())
    passed = [one["passed"] for one in document["dem"]["judgments"]]
    assert passed == [True, False, False]
    assert document["dem"]["relative_90_m"] == float(judged.dem.accuracy.relative_90.max())
    assert "It would pass with" in rendered_html(judged, study_info())


@pytest.mark.parametrize(
    "break_it",
    [
        lambda d: d.pop("history"),
        lambda d: d.update(schema_version=2),
        lambda d: d.update(extra=1),
        lambda d: d["study"].update(kind="evaluate"),
        lambda d: d["best"]["height_error"].update(region_rms_m=None),
        lambda d: d["best"]["height_error"]["segments_m"].clear(),
        lambda d: d["best"]["unwrapping"].update(probability=1.5),
        lambda d: d["best"]["satellites"][0]["position_rtn_m"].pop(),
        lambda d: d["best"]["constraints"][0].update(bound="below"),
    ],
)
def test_schema_refuses_what_breaks_the_contract(result: OptimizeResult, break_it) -> None:
    page = page_of(result)
    text = result_json(page.json(result), study=study_info(), provenance=PROVENANCE)
    document = copy.deepcopy(json.loads(text))
    break_it(document)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(document, result_schema())


def test_csv_has_every_digit(result: OptimizeResult, tmp_path: Path) -> None:
    write_report(result, study=study_info(), provenance=PROVENANCE, out=tmp_path, formats=())
    rows = list(csv.DictReader(io.StringIO((tmp_path / "height_error.csv").read_text("utf-8"))))
    assert [row["label"] for row in rows[::4]] == ["initial", "best", "wide"]
    best = [float(row["total_m"]) for row in rows if row["label"] == "best"]
    np.testing.assert_array_equal(best, result.best.height_error.total)
    assert float(rows[0]["look_deg"]) == pytest.approx(23.0, rel=1e-15)
    states = list(csv.DictReader(io.StringIO((tmp_path / "formation.csv").read_text("utf-8"))))
    assert float(states[3]["z0_m"]) == result.best.motion.states[0, 0]
    assert float(states[5]["vn_m_s"]) == result.best.motion.states[2, 5]


@pytest.mark.parametrize("name", ODD_RESULTS)
def test_odd_results_are_reported_in_full(name: str, tmp_path: Path) -> None:
    odd = ODD_RESULTS[name]()
    study = study_info(kind_of(odd))
    write_report(odd, study=study, provenance=PROVENANCE, out=tmp_path)
    document = json.loads((tmp_path / "result.json").read_text("utf-8"))
    jsonschema.validate(document, result_schema())
    page = Page((tmp_path / "report.html").read_text("utf-8"))
    assert not re.search(r"\b(nan|NaN|inf|Infinity|None)\b", page.text)
    for table in tmp_path.glob("*.csv"):
        assert not re.search(r"\b(nan|inf)\b", table.read_text("utf-8"))


def test_infeasible_result_says_what_is_broken_and_the_remedy() -> None:
    text = Page(rendered_html(ODD_RESULTS["no feasible formation"](), study_info())).text
    assert "No feasible formation" in text
    assert "Broken: separation of each pair at all times." in text
    assert "at least 100000\u00a0m is required" in text
    assert "Remedy: allow a smaller separation" in text


def test_interrupted_search_says_so() -> None:
    assert "The search was interrupted" in Page(rendered_html(interrupted(), study_info())).text


def test_page_says_once_what_the_verdict_says() -> None:
    found = dataclasses.replace(
        ODD_RESULTS["no feasible formation"](), notices=("Nothing feasible: a notice.",)
    )
    text = Page(rendered_html(found, study_info())).text
    assert "a notice" not in text
    assert text.count("Broken: separation of each pair at all times.") == 1


def test_refinement_of_a_search_that_found_nothing_itself_is_worded() -> None:
    found = optimized(make_problem())
    late = dataclasses.replace(found.search, population_objective=math.inf)
    text = Page(rendered_html(dataclasses.replace(found, search=late), study_info())).text
    assert "The genetic algorithm alone found none that keeps every limit" in text


def test_every_value_of_a_column_keeps_its_digits() -> None:
    assert to_digits(4)([1653.66, 1.23449, 0.999999, math.nan]) == ["1654", "1.234", "1.000", "—"]


@pytest.mark.parametrize(("value", "near"), [(0.99009, True), (0.9905, False), (0.98, False)])
def test_probability_is_active_within_one_percent_of_the_allowed_failure(
    result: OptimizeResult, value: float, near: bool
) -> None:
    report = next(one for one in result.best.constraints if isinstance(one.limit, FailureLimit))
    assert report.limit.value == 0.99
    given = report._replace(value=value, satisfied=value >= 0.99)
    assert active(given) is near


def test_setting_says_what_the_scene_is() -> None:
    given = planar()
    text = Page(rendered_html(given, study_info("evaluate"))).text
    assert "2707\u00a0m, the smallest over the scene" in text
    assert "0 … 9 s, a span of 9 s" in text
    assert "flat Earth" not in text
    assert "terrain slope" not in text
    scene = given.problem.scene
    flat = dataclasses.replace(scene, incidence=scene.look_angle, slope=np.radians(5.0))
    problem = dataclasses.replace(given.problem, scene=flat)
    text = Page(
        rendered_html(dataclasses.replace(given, problem=problem), study_info("evaluate"))
    ).text
    assert "23.00°, flat Earth (incidence equals look)" in text
    assert "terrain slope, towards the radar 5.00°" in re.sub(r"\s+", " ", text)


def test_rungs_without_a_common_band_are_explained() -> None:
    given = evaluated()
    ladder = given.formation.unwrapping
    assert ladder is not None
    sentence = "Rung 2 joins two images that have no common band with each other"
    assert sentence not in Page(rendered_html(given, study_info("evaluate"))).text
    pairs = tuple(
        pair._replace(baseline_over_critical=np.full(4, 1.2))
        if pair.images == ladder.rungs[1].images
        else pair
        for pair in given.formation.pairs
    )
    beyond = dataclasses.replace(given.formation, pairs=pairs)
    text = Page(
        rendered_html(dataclasses.replace(given, formation=beyond), study_info("evaluate"))
    ).text
    assert sentence in text


def test_of_many_pairs_the_rungs_and_the_longest_are_listed() -> None:
    given = crowd()
    listed = listed_pairs(given.formation)
    pairs = given.formation.pairs
    rungs = [rung.images for rung in given.formation.unwrapping.rungs]
    assert [pairs[index].images for index in listed[: len(rungs)]] == rungs
    others = [index for index in range(len(pairs)) if pairs[index].images not in rungs]
    longest = max(others, key=lambda i: np.abs(pairs[i].perpendicular_baseline).max())
    assert listed[len(rungs)] == longest
    assert len(listed) == len(set(listed)) == 20
    text = Page(rendered_html(given, study_info("evaluate"))).text
    assert "The rungs and the longest of 66; result.json has the 46 left out." in text
    assert "gray lines the baselines of the unwrapping ladder" in text
    assert len(drawn_baselines(given.problem, given.formation).ends) == len(rungs)
    few = evaluated()
    assert listed_pairs(few.formation) == (0, 1, 2)
    assert len(drawn_baselines(few.problem, few.formation).ends) == 3


def test_names_are_literal_in_the_figure_that_turns() -> None:
    given = evaluated().formation
    named = dataclasses.replace(given, names=("<b>x</b>", "a & b %{x}", '"3"'))
    figure = interactive_orbits([named], [()], np.array([-1.0, 0.0, 0.0]))
    lines = [trace["name"] for trace in figure["data"] if trace["mode"] == "lines"]
    # Legends and hovers: plotly takes them for HTML and templates, and knows numeric entities.
    assert lines == ["&#60;b&#62;x&#60;/b&#62;", "a &#38; b &#37;{x}", '"3"']
    assert [html.unescape(line) for line in lines] == list(named.names)
    # Marks in space: no entities there, and no tag but a few, exactly spelled.
    marks = [trace["text"][0] for trace in figure["data"] if trace["mode"] == "markers+text"]
    assert [mark.replace("\N{WORD JOINER}", "") for mark in marks] == list(named.names)
    assert not any(re.search(r"</?(b|i|br|sub|sup)>", mark) for mark in marks)


def test_panels_of_a_planar_formation_have_room_for_their_titles() -> None:
    half = half_extents(planar().formation)
    assert half.min() >= 0.35 * half.max()


def test_unmeasured_height_gives_its_reason() -> None:
    text = Page(rendered_html(no_baseline(), study_info())).text
    assert "no pair has a perpendicular baseline" in text


def test_incoherent_pairs_are_marked() -> None:
    # Baselines up to three times 1350 m exceed the critical 2.7 km.
    problem = make_problem()
    wide = circle(problem, ("1", "2", "3"), "wide", 3.0 * RADIUS)
    given = EvaluateResult(
        problem=problem, critical_baseline=2707.0, formation=wide, compare=(), warnings=()
    )
    text = Page(rendered_html(given, study_info("evaluate"))).text
    assert "not coherent" in text
    assert "carries no information" in text


def test_texts_of_a_study_are_data_in_html() -> None:
    everything = " ".join(ATTACKS)
    problem = make_problem(satellites=len(ATTACKS))
    changes = dict.fromkeys(("name", "description", "source_text", "effective"), everything)
    attacked = dataclasses.replace(optimized(problem, ATTACKS), warnings=(everything,))
    harmless = dataclasses.replace(optimized(problem, tuple("abcde")), warnings=("text",))
    page = Page(rendered_html(attacked, study_info(**changes)))
    plain = Page(rendered_html(harmless, study_info(effective="x")))
    # Every attack is there as text, and not one element more than without them.
    assert all(page.text.count(attack) > 5 for attack in ATTACKS)
    assert [tag for tag, _ in page.tags] == [tag for tag, _ in plain.tags]


def test_texts_of_a_study_are_data_in_pdf(monkeypatch: pytest.MonkeyPatch) -> None:
    import typst

    seen: dict[str, str] = {}
    compile_ = typst.compile

    def spy(path: str, **options: object) -> bytes:
        folder = Path(path).parent
        seen["template"] = Path(path).read_text("utf-8")
        seen["data"] = (folder / "document.json").read_text("utf-8")
        return compile_(path, **options)

    monkeypatch.setattr(typst, "compile", spy)
    everything = " ".join(ATTACKS)
    found = dataclasses.replace(
        optimized(make_problem(), ATTACKS[:3]), warnings=ATTACKS, compare=()
    )
    changes = dict.fromkeys(("name", "description", "source_text", "effective"), everything)
    document = page_of(found).document(found, study_info(**changes), PROVENANCE)
    assert pdf_bytes(document).startswith(b"%PDF-")
    assert not any(attack in seen["template"] for attack in ATTACKS)
    data = json.loads(seen["data"])
    assert data["title"] == everything
    evaluated_as_markup = [
        block["math"]
        for section in data["sections"]
        for block in section["blocks"]
        if block["kind"] == "equation"
    ]
    assert evaluated_as_markup
    assert not any(attack in math_ for attack in ATTACKS for math_ in evaluated_as_markup)
    # The template evaluates nothing but the equations.
    assert seen["template"].count("eval(") == 1
    assert "@preview" not in seen["template"]


def test_html_needs_no_network_and_is_accessible(result: OptimizeResult) -> None:
    text = rendered_html(result, study_info())
    page = Page(text)
    policy = next(a["content"] for t, a in page.tags if a.get("http-equiv"))
    assert policy is not None
    assert "default-src 'none'" in policy
    assert "http" not in policy
    for tag, attributes in page.tags:
        for name in ("src", "href", "data", "action", "srcset", "poster"):
            value = attributes.get(name) or ""
            if value.startswith("https://doi.org/"):
                assert tag == "a"
            else:
                assert value == "" or value.startswith(("data:", "#")), (tag, name, value[:60])
        if tag == "img":
            assert attributes["alt"]
    style = text[text.index("<style>") : text.index("</style>")]
    assert "url(" not in style
    assert "@import" not in style
    assert ("html", {"lang": "en"}) in page.tags
    assert all(a.get("scope") for t, a in page.tags if t == "th")
    identifiers = [a["id"] for _, a in page.tags if "id" in a]
    assert len(identifiers) == len(set(identifiers))


def test_verdict_does_not_compare_with_a_formation_that_breaks_limits() -> None:
    problem = make_problem(min_unwrapping_probability=0.99, prior_height_std=4.0)
    found = optimized(problem)
    assert not found.initial.feasible
    text = Page(rendered_html(found, study_info())).text
    assert "times as much" not in text


def test_figures_leave_matplotlib_as_it_was_and_are_repeatable(result: OptimizeResult) -> None:
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    first, second = convergence_figure(result.search), convergence_figure(result.search)
    assert dict(mpl.rcParams) == before
    assert first == second
    assert b"<dc:date>" not in first


def test_names_are_not_read_as_mathematics_in_figures() -> None:
    found = optimized(make_problem(), (r"$\frac{1$", "_hidden", "$"))
    assert "svg" in rendered_html(found, study_info())


def test_strong_and_symbol_are_the_only_marked_parts() -> None:
    assert isinstance(Strong("a"), str)
    assert str(Symbol("B_crit")) == "B_crit"


def test_import_is_light() -> None:
    heavy = ["matplotlib", "pandas", "plotly", "typst", "latex2mathml", "optimize", "numpy"]
    code = f"import sys, reports; print([m for m in {heavy!r} if m in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_a_note_stands_beneath_its_row_over_the_whole_width():
    table = Table(
        pd.DataFrame({"name": ["one", "two"], "value": ["1", "2"]}),
        (Column("name", "Name"), Column("value", "Value")),
        "Numbers.",
        notes=("why < one", ""),
    )
    document = Document(
        title="t", subtitle="", description="", producer="", sections=(Section("a", "A", (table,)),)
    )
    page = html_bytes(document).decode()
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", page.split("<tbody>")[1])
    assert len(rows) == 3
    assert rows[1] == '<td colspan="2">why &lt; one</td>'
    assert pdf_bytes(document).startswith(b"%PDF-")
    with pytest.raises(ValueError, match="zip"):
        html_bytes(
            dataclasses.replace(
                document,
                sections=(Section("a", "A", (dataclasses.replace(table, notes=("one",)),)),),
            )
        )
