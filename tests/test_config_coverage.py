"""Studies of coverage: what they become, the shipped one, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from configs import (
    BuildError,
    CoverageStudy,
    StudyError,
    effective_text,
    example_path,
    example_text,
    load_study,
)
from configs.covered import build_coverage
from formation_opt.runs import Options
from formation_opt.runs import coverage as runs_coverage
from insar import LookSide
from insar.observe.coverage.claims import CoverageQuantity
from insar.observe.coverage.results import Verdict
from insar.observe.coverage.walker import Visibility, Walker

WALKER = example_text("walker_coverage")
HIGH = {"altitude_km": 2000, "inclination_deg": 55, "satellites": 24, "planes": 6, "phasing": 2}
MINIMAL = {
    "kind": "coverage",
    "visibility": {"max_incidence_deg": 70},
    "constellations": [HIGH],
    "simulation": {"latitudes_deg": [20, 40], "latitude_samples": 3, "longitudes": 2},
}
SEARCH = {
    "altitude_km": 2000,
    "inclinations_deg": [55],
    "satellites": [18, 24],
    "latitudes_deg": [33.16, 33.16],
}


def built(**keys):
    return build_coverage(CoverageStudy.model_validate(MINIMAL | keys))


def ran(**keys):
    study = CoverageStudy.model_validate(MINIMAL | keys)
    return runs_coverage.run(study, build_coverage(study), Options())


# --- what is computed ----------------------------------------------------------------------------


def test_a_constellation_and_what_it_sees_are_taken_as_given():
    setup = built()
    assert setup.walkers == (
        Walker(total=24, planes=6, phasing=2, inclination=math.radians(55), altitude=2e6),
    )
    assert setup.visibility == Visibility(
        max_incidence=math.radians(70), min_incidence=math.radians(20), side=None
    )
    assert (setup.sizing, setup.search) == (None, None)
    np.testing.assert_allclose(np.degrees(setup.latitudes), [20, 30, 40])
    assert (setup.longitudes, setup.duration) == (2, 86_400.0)


@pytest.mark.parametrize(
    ("side", "meant"), [("either", None), ("left", LookSide.LEFT), ("right", LookSide.RIGHT)]
)
def test_a_side_may_be_all_that_is_seen(side, meant):
    visibility = {"max_incidence_deg": 60, "min_incidence_deg": 0, "side": side}
    assert built(visibility=visibility).visibility.side is meant


def test_a_sizing_is_that_of_the_largest_incidence():
    block = {"altitude_km": 600, "inclination_deg": 97.6, "latitude_deg": 33.16, "phasing": 4}
    task = built(sizing=block, visibility={"max_incidence_deg": 60}).sizing
    assert task is not None
    # docs/coverage.md: 15 planes of 24.
    assert (task.sizing.planes, task.sizing.satellites_per_plane) == (15, 24)
    assert task.walker == Walker(
        total=360, planes=15, phasing=4, inclination=math.radians(97.6), altitude=6e5
    )
    assert math.degrees(task.latitude) == pytest.approx(33.16)


def test_a_search_reaches_its_task():
    keys = {"latitudes_deg": [20, 30], "satellite_step": 3, "max_planes": 5, "latitude_samples": 7}
    task = built(search=SEARCH | keys)
    assert task.search is not None
    assert list(task.search.totals) == [18, 21, 24]
    assert list(task.search.planes) == [1, 2, 3, 4, 5]
    assert (task.search.altitude, task.search.samples) == (2e6, 7)
    np.testing.assert_allclose(np.degrees(task.search.latitudes), [20, 30])
    assert built(search=SEARCH).search.planes is None


def test_what_is_sized_given_and_found_is_simulated():
    sizing = {"altitude_km": 2000, "inclination_deg": 55, "latitude_deg": 33.16}
    outcome = ran(
        sizing=sizing,
        search=SEARCH,
        visibility={"max_incidence_deg": 70, "min_incidence_deg": 0},
        simulation={"latitudes_deg": [33.16, 40], "latitude_samples": 3, "longitudes": 2},
    )
    result = outcome.result
    sized, given, found = result.simulations
    assert sized.walker.total == result.shortfall.sizing.total
    assert given.walker.total == 24
    # docs/coverage.md: 23/23/18, one more than the search by area can exclude.
    assert (found.walker.total, found.walker.planes) == (23, 23)
    assert found.walker == result.search.best
    for each in result.simulations:
        assert each.cover.shape == (3, 2)
    assert found.cover[0].min() == 1.0
    assert given.cover[0].min() < 1.0
    assert result.warnings == ()
    rows = dict(outcome.summary.rows)
    assert rows["2000 km, 55°: 24/6/2"][0] == "24"


def test_a_search_in_vain_or_in_steps_says_so():
    vain = ran(search=SEARCH | {"satellites": [18, 20]}).result
    assert vain.search.best is None
    assert len(vain.simulations) == 1
    assert vain.warnings[0].startswith("No pattern of up to 20 satellites keeps the whole band")
    stepped = ran(
        search=SEARCH | {"satellites": [15, 30], "satellite_step": 15},
        visibility={"max_incidence_deg": 70, "min_incidence_deg": 0},
    ).result
    assert stepped.search.best.total == 30
    assert stepped.warnings[0].startswith("Only every 15th number of satellites was tried")
    assert Verdict.CONTINUOUS in stepped.search.candidates.verdict


# --- the shipped example -------------------------------------------------------------------------


def test_a_range_below_the_least_says_why_nothing_was_searched():
    outcome = ran(search=SEARCH | {"satellites": [2, 9]})
    result = outcome.result
    assert result.search.candidates.total.size == 0
    least = result.search.least_total
    assert least > 9
    (text,) = result.warnings
    assert text.startswith("Nothing was searched: by the time that one satellite sees a place, ")
    assert f"fewer than {least} satellites" in text
    assert f"the range ends at 9; search from {least} on" in text


def test_claims_of_a_sizing_are_judged():
    sizing = {"altitude_km": 600, "inclination_deg": 97.6, "latitude_deg": 33.16}
    claims = [
        {"text": "a", "printed": "b", "quantity": quantity.value, "value": 24}
        for quantity in CoverageQuantity
    ]
    result = ran(visibility={"max_incidence_deg": 60}, sizing=sizing, claims=claims).result
    found = dict(zip(CoverageQuantity, result.claims, strict=True))
    assert found[CoverageQuantity.SATELLITES_PER_PLANE].verdict.value == "holds"
    assert found[CoverageQuantity.SATELLITES].computed == 360.0
    assert found[CoverageQuantity.SIZED_COVER].computed == pytest.approx(76.5, abs=0.1)
    assert found[CoverageQuantity.SIZED_COVER_ALL].unit == "%"
    # Nothing is searched.
    assert found[CoverageQuantity.SMALLEST].verdict.value == "not computable"


def test_the_example_sizes_360_which_do_not_do_and_finds_250_which_do():
    """docs/coverage.md: 59.4 % with the nadir gap on one side, here 76.0 % with both; 250/10/7."""
    study = load_study(example_path("walker_coverage")).study
    result = runs_coverage.run(study, build_coverage(study), Options()).result
    assert result.shortfall.sizing.total == 360
    assert result.shortfall.all_reasons == pytest.approx(0.760, abs=2e-3)
    best = result.search.best
    assert (best.total, best.planes, best.phasing) == (250, 10, 7)


# --- what is refused -----------------------------------------------------------------------------

# (old, new, where the message points, what it says)
WRONG = {
    "nothing to do": (
        WALKER[WALKER.index("sizing:") : WALKER.index("simulation:")],
        "",
        "kind:",
        "the study asks for nothing; add at least one of sizing, constellations and search",
    ),
    "swapped incidences": (
        "max_incidence_deg: 60 ",
        "max_incidence_deg: 15 ",
        "20   # default; nearer",
        "visibility.min_incidence_deg = 20 must be below max_incidence_deg, 15; check that the two "
        "are not swapped",
    ),
    "planes that do not divide": (
        "satellites: 360, planes: 15, phasing: 1",
        "satellites: 361, planes: 15, phasing: 1",
        "15, phasing",
        "constellations[#1].planes = 15 must divide the satellites, 361; give every plane as many "
        "satellites",
    ),
    "phasing of another plane": (
        "planes: 15, phasing: 1",
        "planes: 15, phasing: 16",
        "16}",
        "constellations[#1].phasing = 16 must be less than the planes, 15; the same pattern has 1",
    ),
    "phasing of the sized pattern": (
        "  phasing: 0 ",
        "  phasing: 20 ",
        "20 ",
        "sizing.phasing = 20 must be less than the planes that are sized, 15; the same pattern has "
        "5",
    ),
    "fewer and fewer satellites": (
        "satellites: [150, 300]",
        "satellites: [300, 150]",
        "[300",
        "search.satellites = [300, 150] must not shrink: from, to; check that the two are not "
        "swapped",
    ),
    "southward": (
        "latitudes_deg: [0, 50] ",
        "latitudes_deg: [50, 0] ",
        "[50, 0]",
        "simulation.latitudes_deg = [50, 0] must go from south to north; check that the two are "
        "not swapped",
    ),
    "too long a simulation": (
        "duration_days: 1 ",
        "duration_days: 60 ",
        "simulation:",
        "simulation watches 208 places for 60 days with up to 360 satellites, and the product of "
        "these may reach 2e+06; take fewer places or days",
    ),
    "altitude in meters": (
        "sizing:                   # eqs 14 to 20 of the paper\n  altitude_km: 600 ",
        "sizing:\n  altitude_km: 600000 ",
        "600000 ",
        "sizing.altitude_km = 600000 must be a number from 150 to 6000 km; if it is in meters, "
        "write 600",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_coverage_is_named_with_place_limit_and_remedy(tmp_path, monkeypatch, name):
    old, new, where, says = WRONG[name]
    assert WALKER.count(old) == 1, old
    text = WALKER.replace(old, new)
    monkeypatch.chdir(tmp_path)
    Path("my.yaml").write_text(text, encoding="utf-8")
    start = WALKER.index(old)
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
        build_coverage(loaded.study)
    return str(loaded.located(error.value))


def test_too_large_a_search_is_refused(tmp_path):
    text = WALKER.replace("  max_planes: 40 ", "  #").replace("  satellite_step: 5 ", "  #")
    text = text.replace("satellites: [150, 300]", "satellites: [1, 2000]")
    (tmp_path / "my.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(StudyError, match=r"search.satellites = \[1, 2000\] makes 3\d{6} patterns"):
        load_study(tmp_path / "my.yaml")


def test_a_band_that_no_orbit_sees_is_refused_when_it_is_searched(tmp_path):
    text = WALKER.replace("latitudes_deg: [33.16, 33.16] ", "latitudes_deg: [80, 80] ")
    (tmp_path / "my.yaml").write_text(text, encoding="utf-8")
    loaded = load_study(tmp_path / "my.yaml")
    with pytest.raises(BuildError) as error:
        runs_coverage.run(loaded.study, build_coverage(loaded.study), Options())
    assert "my.yaml:29:1: search cannot succeed: no satellite of the given inclinations ever" in (
        str(loaded.located(error.value))
    )


def test_the_effective_text_says_everything(tmp_path):
    original = load_study(example_path("walker_coverage")).study
    text = effective_text(original)
    (tmp_path / "copy.yaml").write_text(text, encoding="utf-8")
    assert load_study(tmp_path / "copy.yaml").study == original
    assert "side: either" in text
