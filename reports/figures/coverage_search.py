"""What a search for the smallest constellation found."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from insar.observe.coverage.results import Verdict, WalkerSearch

from ..tables_coverage import MINUTE
from ..wording import plain
from .style import (
    BROKEN,
    MUTED,
    color,
    draw,
    marker,
    name_series,
    series_marker,
)

Array = NDArray[np.float64]

_LEAST_LEFT = 1e-3
"""Share that is not covered at which none is drawn on a logarithmic axis [%]."""


def search_figure(search: WalkerSearch) -> bytes:
    """The best and the worst pattern of every number of satellites, and those that are proved.

    Parameters
    ----------
    search : whose candidates are drawn.
    """
    found = search.candidates
    inclinations = np.unique(found.inclination)

    def paint(figure: Figure) -> None:
        cover, gap = figure.subplots(1, 2)
        missing = np.maximum(100.0 * (1.0 - found.cover), _LEAST_LEFT)
        waits = np.where(np.isfinite(found.longest_gap), found.longest_gap, np.nan) / MINUTE
        for index, inclination in enumerate(inclinations):
            own = found.inclination == inclination
            _paint_best(cover, found.total[own], missing[own], index)
            _paint_best(gap, found.total[own], waits[own], index)
        proved = found.verdict == Verdict.CONTINUOUS
        cover.plot(found.total[proved], missing[proved], "*", color=BROKEN, markersize=9, zorder=5)
        gap.plot(found.total[proved], waits[proved], "*", color=BROKEN, markersize=9, zorder=5)
        _missing_axis(cover)
        cover.set_ylabel("time not covered [%]")
        gap.set_ylabel("longest gap [min]")
        high = gap.get_ylim()[1]
        gap.set_ylim(-0.04 * high, high)
        for axes in (cover, gap):
            axes.set_xlabel("satellites")
            if search.least_total >= axes.get_xlim()[0] - 5:
                axes.axvline(search.least_total, color=MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
        _name_search(figure, inclinations, proved=bool(np.any(proved)))

    return draw(paint, height=2.9)


def _paint_best(axes: Axes, totals: NDArray[np.int_], values: Array, index: int) -> None:
    """Least value of each total as a line, and the middle half of all as a band."""
    known = np.isfinite(values)
    numbers = np.unique(totals[known])
    if numbers.size == 0:
        return
    groups = [values[known & (totals == number)] for number in numbers]
    low, quarter, three = (
        np.array([np.quantile(group, part) for group in groups]) for part in (0.0, 0.25, 0.75)
    )
    axes.fill_between(numbers, quarter, three, color=color(index), alpha=0.18, linewidth=0.0)
    axes.plot(
        numbers, low, color=color(index), marker=series_marker(index, numbers.size), markersize=3.0
    )


def _missing_axis(axes: Axes) -> None:
    axes.set_yscale("log")
    axes.set_ylim(_LEAST_LEFT / 2.0, 150.0)
    axes.yaxis.set_major_locator(LogLocator(numticks=7))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_formatter(
        FuncFormatter(lambda value, _: "none" if value <= _LEAST_LEFT * 1.01 else plain(value))
    )


def _name_search(figure: Figure, inclinations: Array, *, proved: bool) -> None:
    handles = [
        Line2D([], [], color=color(index), marker=marker(index), markersize=3.5)
        for index in range(len(inclinations))
    ]
    names = [f"best at {plain(float(np.rad2deg(value)))}°" for value in inclinations]
    handles.append(Line2D([], [], color=MUTED, linewidth=5.0, alpha=0.4))
    names.append("middle half of all patterns")
    if proved:
        handles.append(Line2D([], [], color=BROKEN, marker="*", linestyle="", markersize=9))
        names.append("proved continuous")
    handles.append(Line2D([], [], color=MUTED, linewidth=0.8, linestyle=(0, (2, 2))))
    names.append("least by area")
    name_series(figure, handles, names, loc="outside lower center", ncols=min(4, len(names)))
