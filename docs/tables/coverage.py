"""Tables on coverage by Walker constellations."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from configs import load_study
from configs.covered import build_coverage
from insar import LookSide
from insar.observe.coverage.claims import judge_coverage
from insar.observe.coverage.results import CoverageResult, SizingShortfall
from insar.observe.coverage.sizing import sizing_shortfall, walker_sizing
from insar.observe.coverage.walker import Visibility
from insar.observe.coverage.walker_search import smallest_walker

from .markdown import DOCS, markdown_table
from .verdicts import verdict_table

_SASEBO = math.radians(33.16)


def _shortfall(altitude: float, incidence: float, latitude: float) -> SizingShortfall:
    return sizing_shortfall(
        walker_sizing(altitude=altitude, max_incidence=math.radians(incidence)),
        latitude=latitude,
        inclination=math.radians(97.6),
        visibility=Visibility(
            max_incidence=math.radians(incidence),
            min_incidence=math.radians(20.0),
            side=LookSide.RIGHT,
        ),
    )


def coverage_shortfall() -> str:
    """What the sizing covers, one reason for failure at a time."""
    rows = []
    for altitude in (500e3, 600e3, 700e3):
        found = _shortfall(altitude, 60.0, _SASEBO)
        sizing = found.sizing
        size = f"{sizing.planes} × {sizing.satellites_per_plane} = {sizing.total}"
        shares = (found.spacing, found.spacing_and_nadir, found.spacing_and_side, found.all_reasons)
        rows.append(
            [
                f"{altitude / 1e3:.0f} km",
                size,
                f"{100.0 * found.in_plane:.0f} %",
                f"{100.0 * found.held_least:.0f} %, {100.0 * found.held_most:.0f} %",
                *(f"{100.0 * share:.1f} %" for share in shares),
            ]
        )
    head = ["altitude", "P × S = N", "target in a plane", "Earth held: worst, best longitude"]
    more = ["planes as spaced", "and incidence ≥ 20°", "and right side only", "both"]
    return markdown_table([*head, *more], rows)


class _Search(NamedTuple):
    """A row of the table: kilometers and degrees."""

    altitude: float
    inclination: float
    incidences: tuple[float, float]
    totals: range
    most_planes: int | None = None
    band: tuple[float, float] = (33.16, 33.16)
    side: LookSide | None = None


_SEARCHES = (
    _Search(600, 45.0, (0, 60), range(191, 193)),
    _Search(600, 45.0, (20, 60), range(246, 251), most_planes=40),
    _Search(600, 97.6, (0, 60), range(350, 371, 5), most_planes=40),
    _Search(2000, 55.0, (0, 70), range(18, 24)),
    _Search(2000, 55.0, (20, 70), range(45, 48), band=(20, 45)),
    _Search(2000, 55.0, (20, 70), range(29, 40), side=LookSide.RIGHT),
)


def coverage_searches() -> str:
    """The smallest Walker constellations in the ranges that are searched."""
    return markdown_table(
        ["altitude, i", "incidence", "least by area", "T searched", "patterns", "smallest T/P/F"],
        [_searched(search) for search in _SEARCHES],
    )


def _searched(row: _Search) -> Sequence[str]:
    low, high = row.incidences
    south, north = (math.radians(angle) for angle in row.band)
    found = smallest_walker(
        altitude=1e3 * row.altitude,
        inclinations=[math.radians(row.inclination)],
        totals=row.totals,
        latitudes=(south, north),
        visibility=Visibility(
            max_incidence=math.radians(high), min_incidence=math.radians(low), side=row.side
        ),
        planes=None if row.most_planes is None else range(1, row.most_planes + 1),
    )
    seen = f"{low:g}–{high:g}°"
    if row.most_planes is not None:
        seen += f", P ≤ {row.most_planes}"
    if row.band[0] != row.band[1]:
        seen += f", band {row.band[0]:g}–{row.band[1]:g}°"
    if row.side is not None:
        seen += f", {row.side.name.lower()} only"
    step = f", step {row.totals.step}" if row.totals.step > 1 else ""
    best = found.best
    return [
        f"{row.altitude:g} km, {row.inclination:g}°",
        seen,
        f"{found.least_total}",
        f"{row.totals[0]}–{row.totals[-1]}{step}",
        f"{found.candidates.total.size}",
        "none" if best is None else f"{best.total}/{best.planes}/{best.phasing}",
    ]


def coverage_verdicts() -> str:
    """What the sizing says of itself, judged."""
    setup = build_coverage(load_study(DOCS.parent / "configs" / "walker_coverage.yaml").study)
    task = setup.sizing
    if task is None:
        raise ValueError("walker_coverage.yaml has no sizing; restore it")
    shortfall = sizing_shortfall(
        task.sizing,
        latitude=task.latitude,
        inclination=task.inclination,
        visibility=setup.visibility,
        phasing=task.phasing,
    )
    result = CoverageResult(shortfall=shortfall, simulations=(), search=None, warnings=())
    claims = [judge_coverage(claim, result) for claim in setup.claims]
    return verdict_table(claims, "from inferred inputs")


TABLES: dict[str, Callable[[], str]] = {
    "coverage_verdicts": coverage_verdicts,
    "coverage_shortfall": coverage_shortfall,
    "coverage_searches": coverage_searches,
}
"""Tables by the name that a page calls them."""
