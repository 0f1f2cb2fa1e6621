"""Sections on coverage: the sizing and its shortfall, simulations, the search."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from insar.observe.coverage.results import Coverage, SizingShortfall, Verdict, WalkerSearch

from ..document import Block, Column, Figure, Paragraph, Section, Status, Table
from ..figures.coverage import (
    MOST_NAMED,
    coverage_figure,
    moments_figure,
    shortfall_figure,
)
from ..figures.coverage_search import search_figure
from ..tables_coverage import MINUTE, best_frame, constellations_frame
from ..wording import (
    counted,
    fixed,
    latitude_text,
    plain,
    quantity,
    significant,
    to_decimals,
)
from .closing import facts
from .coverage_verdict import share_text, time_text

_MOST_LISTED = 14
"""Numbers of satellites that the table of the search lists."""


def sizing_section(found: SizingShortfall | None) -> Section | None:
    """What the sizing asks for, and why it falls short; None where the study sizes none."""
    if found is None:
        return None
    return Section(
        "sizing",
        "The sizing, and where it falls short",
        (
            Paragraph(
                "The sizing counts the satellites of one plane that follow each other over a "
                "target in that plane, and as many planes as bring one over the target when the "
                "Earth has turned for a revolution. Inclination, latitude, phasing, the least "
                "incidence and the side do not enter."
            ),
            facts(_sizing_rows(found), "The sizing (Liang 2018, eqs. 14 to 20)."),
            Figure(
                shortfall_figure(found),
                "Time for which the sized constellation covers "
                f"{latitude_text(math.degrees(found.latitude))}, one reason for failure added at a "
                "time. The thin line under the second bar: from the worst to the best longitude of "
                "an Earth that does not turn; on the turning Earth every longitude gets the mean.",
                "A waterfall chart of the time covered.",
            ),
            _shares_table(found),
        ),
    )


def _sizing_rows(found: SizingShortfall) -> list[tuple[str, str]]:
    sizing = found.sizing
    return [
        ("altitude", f"{plain(sizing.altitude / 1e3)} km"),
        ("largest zenith angle β at the target", f"{plain(math.degrees(sizing.max_incidence))}°"),
        ("half angle α at the Earth's center", f"{fixed(math.degrees(sizing.half_angle), 3)}°"),
        ("period of a revolution", quantity(fixed(sizing.period, 1), "s")),
        ("time of a pass through the zenith", quantity(fixed(sizing.view_time, 1), "s")),
        (
            "satellites of a plane S, period by time of a pass, rounded up",
            str(sizing.satellites_per_plane),
        ),
        ("turn Δφ of the Earth in a revolution", f"{fixed(math.degrees(sizing.node_shift), 3)}°"),
        ("planes P = ⌈2π/Δφ⌉", str(sizing.planes)),
        ("satellites N = P·S", str(sizing.total)),
    ]


def _shares_table(found: SizingShortfall) -> Table:
    rows = [
        ("A target that stays in an orbit plane", found.in_plane),
        ("Planes as far apart as sized, Earth held: worst longitude", found.held_least),
        ("The same: best longitude", found.held_most),
        ("The same, turning Earth: any longitude", found.spacing),
    ]
    if found.visibility.min_incidence > 0.0:
        rows.append(("… and no view within the least incidence", found.spacing_and_nadir))
    if found.visibility.side is not None:
        rows.append(("… and one side only, at any incidence", found.spacing_and_side))
    rows.append(("All reasons", found.all_reasons))
    frame = pd.DataFrame(rows, columns=["what", "share"])
    return Table(
        frame,
        (Column("what", "What is considered"), Column("share", "Time covered", "", _shares)),
        f"Long-run share of time covered; {fixed(found.seen_by, 2)} satellites see the target on "
        "average, with all reasons.",
    )


def _shares(values: Sequence[float]) -> list[str]:
    return [share_text(float(value)) for value in values]


def simulation_section(simulations: Sequence[Coverage]) -> Section | None:
    """Cover over latitude; None where nothing was simulated."""
    if not simulations:
        return None
    frame = constellations_frame(tuple(simulations))
    never = any(np.any(one.accesses == 0) for one in simulations)
    blocks: list[Block] = [
        Paragraph(
            "Cover in the window that was simulated, with exact edges of every view: no gap is "
            "missed for want of a step."
            + (" A place that is never seen has a gap as long as the window." if never else "")
        ),
        *_latitudes_figure(simulations),
        Figure(
            moments_figure(simulations),
            "When the place with the longest gap of each constellation is seen (color), in a "
            "window about that gap.",
            "A chart of the moments at which a place is seen, a row for each constellation.",
        ),
        Table(
            frame,
            (
                Column("name", "Constellation"),
                Column("satellites", "Satellites", "", to_decimals(0)),
                Column("least", "Least cover", "%", _percents),
                Column("mean", "Mean cover", "%", _percents),
                Column("seen_by", "Seen by", "", to_decimals(2)),
                Column("longest", "Longest gap", "min", to_decimals(1)),
                Column("wait", "Largest mean wait", "min", to_decimals(2)),
                Column("accesses", "Accesses per day", "", to_decimals(1)),
                Column("access", "Mean access", "min", to_decimals(2)),
            ),
            "Over all places of the simulation. Seen by: satellites that see a place, on average.",
        ),
    ]
    return Section("simulation", "Simulated cover", tuple(blocks))


def _latitudes_figure(simulations: Sequence[Coverage]) -> tuple[Block, ...]:
    """Curves over latitude; of one place or two, the table says it all."""
    if all(np.unique(one.latitude).size < 3 for one in simulations):
        return ()
    return (
        Figure(
            coverage_figure(simulations),
            "Over latitude, for each constellation: (a) time in which any satellite sees the "
            "place, (b) the longest gap and (c) the mean time from a random moment to the next "
            "cover, both on an axis that is linear up to a minute and logarithmic beyond, (d) "
            "unbroken views by single satellites. Lines: mean over longitude; bands: from the "
            "least to the largest."
            + (f" The first {MOST_NAMED} constellations." if len(simulations) > MOST_NAMED else ""),
            "Four line charts of cover, gaps, waits and accesses against latitude.",
        ),
    )


def _percents(values: Sequence[float]) -> list[str]:
    return [share_text(float(value) / 100.0).removesuffix("\u00a0%") for value in values]


def search_section(search: WalkerSearch | None) -> Section | None:
    """The smallest pattern with continuous cover; None where none was searched."""
    if search is None:
        return None
    found = search.candidates
    undecided = int(np.count_nonzero(found.verdict == Verdict.UNDECIDED))
    if not found.total.size:
        why = (
            f"No pattern was searched. Fewer than {search.least_total} satellites cannot keep the "
            "band in view, since one satellite sees a place for too short a part of the time, and "
            "the range of the study has no such number."
        )
        return Section("search", "The smallest constellation", (Paragraph(why),))
    blocks: list[Block] = [
        Paragraph(
            f"{counted(int(found.total.size), 'pattern')} were searched, up to the first number of "
            "satellites with continuous cover. A gap on a grid rejects a pattern; only a proof, "
            "which holds for every longitude, latitude of the band and moment, accepts one."
            + (
                f" {counted(undecided, 'pattern')} cover so narrowly that neither was found: they "
                "are not taken."
                if undecided
                else ""
            )
        )
    ]
    blocks += [_search_figure(search), _search_table(search)]
    return Section("search", "The smallest constellation", tuple(blocks))


def _search_figure(search: WalkerSearch) -> Figure:
    return Figure(
        search_figure(search),
        "Patterns by their number of satellites: the part of the time that is not covered at the "
        "worst latitude, on a logarithmic axis, and the longest gap there, along the lines of the "
        f"grid (to {time_text(search.gap_resolution)}; gaps beyond two days are not drawn). A "
        "pattern at “none” without a star has gaps that the grid does not see.",
        "Two charts of the time not covered and of the longest gap against the number of "
        "satellites.",
    )


def _search_table(search: WalkerSearch) -> Table:
    frame = best_frame(search, _MOST_LISTED)
    frame["pattern"] = [
        f"{row.satellites}/{row.planes}/{row.phasing}" for row in frame.itertuples()
    ]
    frame["gap"] = frame["longest_gap_s"] / MINUTE
    return Table(
        frame,
        (
            Column("pattern", "T/P/F"),
            Column("inclination_deg", "Inclination", "°", to_decimals(2)),
            Column("cover", "Least cover", "", _shares),
            Column("gap", "Longest gap", "min", _gaps),
            Column("verdict", "Verdict"),
        ),
        "For the last numbers of satellites searched, the pattern that covers most, on the grid of "
        "the search. candidates.csv has all.",
        tuple(
            Status.GOOD if verdict == "continuous" else Status.NOTE for verdict in frame["verdict"]
        ),
    )


def _gaps(values: Sequence[float]) -> list[str]:
    return [
        "> 2 days"
        if math.isnan(value)
        else significant(float(value))
        if value
        else "none on the grid"
        for value in values
    ]
