"""Verdict on coverage: what a sizing leaves out, and what it takes."""

from __future__ import annotations

import math
from collections.abc import Sequence

from insar.observe.coverage.results import Coverage, CoverageResult, SizingShortfall, WalkerSearch

from ..agile_words import walker_name
from ..document import Block, Callout, Metric, Metrics, Status, Strong, Text
from ..tables_coverage import DAY, MINUTE
from ..wording import counted, fixed, joined, latitude_text, plain, quantity, significant
from .claims import claims_text

_ALL = 1.0 - 1e-12
"""Share of time from which a place counts as seen all the time."""


def share_text(share: float) -> str:
    r"""Share of time to a tenth of a percent; never rounded up to all of it.

    >>> share_text(1.0), share_text(0.99999), share_text(0.765)
    ('100\xa0%', '> 99.9\xa0%', '76.5\xa0%')
    """
    if share >= _ALL:
        return "100\u00a0%"
    return "> 99.9\u00a0%" if share >= 0.9995 else f"{fixed(100.0 * share, 1)}\u00a0%"


def time_text(seconds: float) -> str:
    """Duration in the unit that suits it."""
    if seconds < 2.0 * MINUTE:
        return quantity(significant(seconds), "s") if seconds else "none"
    if seconds < 180.0 * MINUTE:
        return quantity(fixed(seconds / MINUTE, 1), "min")
    return quantity(fixed(seconds / 3600.0, 1), "h")


def coverage_verdict(result: CoverageResult) -> tuple[Block, ...]:
    """Verdict on a study of coverage."""
    paragraphs: list[Text] = []
    if result.shortfall is not None:
        paragraphs.append(_sizing(result.shortfall))
    if result.search is not None:
        paragraphs.append(_search(result.search))
    paragraphs += _simulations(result.simulations, result.search)
    paragraphs += claims_text(result.claims, "inputs of this study")
    status, title = _title(result)
    blocks: list[Block] = [Callout(status, title, tuple(paragraphs))]
    items = _metrics(result)
    if items:
        blocks.append(Metrics(items))
    return tuple(blocks)


def _title(result: CoverageResult) -> tuple[Status, str]:
    if result.search is not None and result.search.best is not None:
        count = counted(result.search.best.total, "satellite")
        return Status.GOOD, f"{count} keep {_band(result.search)} in view at all times"
    if result.search is not None and result.search.candidates.total.size == 0:
        return (
            Status.BAD,
            "The range of the search is too small for any pattern to do",
        )
    if result.search is not None:
        return Status.BAD, "No pattern that was searched keeps the band in view at all times"
    best = max((float(one.cover.min()) for one in result.simulations), default=0.0)
    if result.shortfall is not None:
        best = max(best, result.shortfall.all_reasons)
        if result.shortfall.all_reasons < _ALL:
            share = share_text(result.shortfall.all_reasons)
            return Status.WARNING, f"The sizing promises all of the time, and covers {share}"
    if best >= _ALL:
        return Status.GOOD, "Every place is seen all the time of the simulation"
    return Status.NOTE, f"The place that is seen least is seen {share_text(best)} of the time"


def _band(search: WalkerSearch) -> str:
    if search.latitudes[0] == search.latitudes[-1]:
        return latitude_text(math.degrees(search.latitudes[0]))
    return "the band"


def _sizing(found: SizingShortfall) -> Text:
    sizing = found.sizing
    return (
        Strong(
            f"The sizing asks for {sizing.planes} planes of {sizing.satellites_per_plane} "
            f"satellites, {sizing.total} in all"
        ),
        f", at {plain(sizing.altitude / 1e3)} km and an incidence of up to "
        f"{plain(math.degrees(sizing.max_incidence))}°. They cover "
        f"{latitude_text(math.degrees(found.latitude))} for ",
        Strong(share_text(found.all_reasons)),
        f" of the time: {joined(_reasons(found))}. The sizing counts a target that stays in an "
        "orbit plane, and does not guarantee what it is for.",
    )


def _reasons(found: SizingShortfall) -> list[str]:
    """What is left of the cover with each reason that applies."""
    reasons = [f"{share_text(found.spacing)} with planes so far apart"]
    if found.visibility.min_incidence > 0.0:
        reasons.append(f"{share_text(found.spacing_and_nadir)} with the least incidence too")
    if found.visibility.side is not None:
        reasons.append(f"{share_text(found.all_reasons)} with one side only")
    return reasons


def _in_band(one: Coverage, search: WalkerSearch | None) -> str:
    """Cover of the pattern that was found within the band of its search, if others were seen."""
    if search is None or one.walker != search.best:
        return ""
    low, high = search.latitudes[0] - 1e-9, search.latitudes[-1] + 1e-9
    inside = (one.latitude >= low) & (one.latitude <= high)
    if inside.all():
        return ""
    if not inside.any():
        return " None of these places lies in the band of the search, for which cover is proven."
    least = share_text(float(one.cover[inside].min()))
    return f" Within the band of the search it is {least}."


def days_text(seconds: float) -> str:
    """Length of a window in days."""
    return f"{plain(seconds / DAY)} day{'' if seconds == DAY else 's'}"


def _simulations(simulations: Sequence[Coverage], search: WalkerSearch | None) -> list[Text]:
    return [
        (
            Strong(walker_name(one.walker)),
            f", simulated over {days_text(one.duration)}: the place seen least is seen "
            f"{share_text(float(one.cover.min()))} of the time, all of them on average "
            f"{share_text(float(one.cover.mean()))}; the longest gap is "
            f"{time_text(float(one.longest_gap.max()))}.{_in_band(one, search)}",
        )
        for one in simulations
    ]


def _search(search: WalkerSearch) -> Text:
    tried = counted(int(search.candidates.total.size), "pattern")
    bound = (
        f"By the time that one satellite sees a target, fewer than {search.least_total} satellites "
        "cannot do."
    )
    if search.candidates.total.size == 0:
        return f"No pattern was searched, for the range has none that could do. {bound}"
    if search.best is None:
        return f"No continuous cover with any of {tried} searched. {bound}"
    return (
        "The smallest pattern searched with continuous cover is ",
        Strong(walker_name(search.best)),
        f", proven for every longitude, latitude of the band and moment; {tried} were searched. "
        f"{bound}",
    )


def _metrics(result: CoverageResult) -> tuple[Metric, ...]:
    items = []
    if result.shortfall is not None:
        found = result.shortfall
        items.append(
            Metric(
                "Sized constellation",
                str(found.sizing.total),
                f"satellites; cover {share_text(found.all_reasons)} of the time",
                Status.GOOD if found.all_reasons >= _ALL else Status.BAD,
            )
        )
    if result.search is not None and result.search.best is not None:
        items.append(
            Metric(
                "Continuous cover",
                str(result.search.best.total),
                f"satellites; {walker_name(result.search.best)}",
                Status.GOOD,
            )
        )
    if result.search is not None:
        items.append(
            Metric("Least by area", str(result.search.least_total), "satellites; no fewer can do")
        )
    if result.simulations:
        worst = result.simulations[0]  # the sized one, where there is one
        if result.shortfall is None:
            worst = max(result.simulations, key=lambda one: float(one.longest_gap.max()))
        items.append(
            Metric(
                "Longest gap",
                time_text(float(worst.longest_gap.max())),
                walker_name(worst.walker),
            )
        )
    return tuple(items)
