"""How well constellations keep places in view, and where a sizing falls short."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter
from numpy.typing import NDArray

from insar.observe.coverage.results import Coverage, SizingShortfall

from ..agile_words import walker_name
from ..tables_coverage import DAY, MINUTE
from ..wording import fixed, plain
from .style import (
    GRID,
    INK,
    MUTED,
    color,
    draw,
    marker,
    name_series,
    series_marker,
    shortened,
)

Array = NDArray[np.float64]

_LOST, _LEFT = color(1), color(0)

_LONGEST_SHOWN = 6.0 * 3600.0
"""Time that a chart of moments shows [s]."""

MOST_NAMED = 8
"""Constellations with a color of their own."""


class Step(NamedTuple):
    """One reason for which a sizing falls short.

    Attributes
    ----------
    name : of the reason.
    before, after : scalars — share of time covered without and with it.
    """

    name: str
    before: float
    after: float


def shortfall_steps(found: SizingShortfall) -> tuple[Step, ...]:
    """From what the sizing has in mind to what a target gets, reason by reason."""
    return (
        Step("planes as far apart as sized", found.in_plane, found.spacing),
        Step("least incidence", found.spacing, found.spacing_and_nadir),
        Step(
            "either side" if found.visibility.side is None else "one side only",
            found.spacing_and_nadir,
            found.all_reasons,
        ),
    )


def shortfall_figure(found: SizingShortfall) -> bytes:
    """Waterfall from the cover that the sizing has in mind to that which a place gets.

    Parameters
    ----------
    found : shares with one reason added at a time.
    """
    steps = shortfall_steps(found)
    names = ["target that stays in a plane", *(step.name for step in steps), "what is left"]
    rows = np.arange(len(names))[::-1]

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.barh(rows[0], 100.0 * found.in_plane, color=_LEFT, height=0.6)
        for row, step in zip(rows[1:-1], steps, strict=True):
            low, high = sorted((100.0 * step.before, 100.0 * step.after))
            axes.barh(row, high - low, left=low, color=_LOST, height=0.6)
            axes.plot([100.0 * step.before] * 2, [row + 0.3, row + 0.7], color=MUTED, linewidth=0.7)
        axes.plot(
            [100.0 * found.all_reasons] * 2, [rows[-1] + 0.3, rows[-1] + 0.7], color=MUTED, lw=0.7
        )
        axes.barh(rows[-1], 100.0 * found.all_reasons, color=_LEFT, height=0.6)
        held = [100.0 * found.held_least, 100.0 * found.held_most]
        axes.plot(held, [rows[1] - 0.42] * 2, color=INK, marker="|", markersize=5, linewidth=0.6)
        axes.annotate(
            "Earth held: from the worst to the best longitude",
            (held[0], rows[1] - 0.4),
            xytext=(5, 2),
            textcoords="offset points",
            fontsize=7.0,
            color=MUTED,
        )
        for row, text, at in _texts(found, steps, rows):
            axes.annotate(
                text,
                (at, row),
                xytext=(4, 0),
                textcoords="offset points",
                va="center",
                fontsize=8.0,
            )
        axes.set_yticks(rows, names)
        axes.set_ylim(-0.6, len(names) - 0.4)
        axes.set_xlim(0.0, 118.0)
        axes.set_xticks(np.arange(0.0, 101.0, 20.0))
        axes.set_xlabel("time covered [%]")
        axes.grid(visible=False, axis="y")

    return draw(paint, height=2.35)


def _texts(
    found: SizingShortfall, steps: Sequence[Step], rows: NDArray[np.int_]
) -> list[tuple[int, str, float]]:
    """Numbers beside the bars: row, text and where."""
    texts = [(int(rows[0]), f"{fixed(100.0 * found.in_plane, 1)} %", 100.0 * found.in_plane)]
    for row, step in zip(rows[1:-1], steps, strict=True):
        change = 100.0 * (step.after - step.before)
        at = 100.0 * max(step.before, step.after)
        texts.append((int(row), f"{fixed(change, 1)} %" if change else "none", at))
    end = 100.0 * found.all_reasons
    texts.append((int(rows[-1]), f"{fixed(end, 1)} %", end))
    return texts


def coverage_figure(simulations: Sequence[Coverage]) -> bytes:
    """Cover, gaps, waits and views over latitude; a band where longitudes differ.

    Parameters
    ----------
    simulations : of constellations, each with a color.
    """
    shown = simulations[:MOST_NAMED]
    panels: tuple[tuple[str, Callable[[Coverage], Array]], ...] = (
        ("time covered [%]", lambda one: 100.0 * one.cover),
        ("longest gap [min]", lambda one: one.longest_gap / MINUTE),
        ("mean wait [min]", lambda one: one.mean_wait / MINUTE),
        ("accesses per day", lambda one: one.accesses * np.float64(DAY / one.duration)),
    )

    def paint(figure: Figure) -> None:
        grid = figure.subplots(2, 2)
        for index, (axes, (label, read)) in enumerate(zip(grid.ravel(), panels, strict=True)):
            for number, one in enumerate(shown):
                _paint_latitudes(axes, one, read(one), number)
            axes.set_ylabel(label)
            axes.set_title(f"({'abcd'[index]})", loc="left")
            if "[min]" in label:
                _waiting_axis(axes)
            else:
                _from_zero(axes)
        for axes in grid[1]:
            axes.set_xlabel("latitude [°]")
        figure.align_ylabels()
        handles = [
            Line2D([], [], color=color(n), marker=marker(n), linestyle="-" if _wide(one) else "")
            for n, one in enumerate(shown)
        ]
        names = [shortened(walker_name(one.walker), 50) for one in shown]
        name_series(figure, handles, names, loc="outside lower center", ncols=min(3, len(names)))

    return draw(paint, height=3.9 + 0.17 * (len(shown) // 4))


def _wide(one: Coverage) -> bool:
    return np.unique(one.latitude).size > 1


def _waiting_axis(axes: Axes) -> None:
    """Axis of times from none to days: linear up to a minute, logarithmic beyond."""
    _, high = axes.get_ylim()
    axes.set_yscale("symlog", linthresh=1.0, linscale=0.6)
    axes.set_ylim(-0.08, max(1.5, 2.0 * high))
    decades = 10.0 ** np.arange(0, max(1, int(np.log10(max(high, 1.0))) + 1))
    ticks = [0.0, *decades.tolist()]
    axes.set_yticks(ticks, [plain(tick) if tick else "0" for tick in ticks])
    axes.yaxis.set_minor_formatter(NullFormatter())


def _from_zero(axes: Axes) -> None:
    """Vertical axis from zero; of what is zero throughout, to one."""
    _, high = axes.get_ylim()
    axes.set_ylim(0.0, high if high > 1e-9 else 1.0)
    axes.locator_params(axis="y", nbins=5)


def _paint_latitudes(axes: Axes, one: Coverage, values: Array, number: int) -> None:
    latitudes, groups = np.unique(one.latitude, return_inverse=True)
    grouped = [values.ravel()[groups.ravel() == index] for index in range(latitudes.size)]
    low, mean, high = (np.array([f(v) for v in grouped]) for f in (np.min, np.mean, np.max))
    degrees = np.rad2deg(latitudes)
    shade = color(number)
    axes.fill_between(degrees, low, high, color=shade, alpha=0.22, linewidth=0.0)
    mark = series_marker(number, latitudes.size)
    axes.plot(degrees, mean, color=shade, marker=mark, markersize=3.0)
    if latitudes.size == 1:
        axes.errorbar(degrees, mean, yerr=[mean - low, high - mean], color=shade, capsize=3.0)


def moments_figure(simulations: Sequence[Coverage]) -> bytes:
    """When the place that waits longest is seen, around its longest gap.

    Parameters
    ----------
    simulations : of constellations, a row each.
    """
    shown = simulations[:MOST_NAMED]

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        rows = np.arange(len(shown))[::-1]
        for number, (row, one) in enumerate(zip(rows, shown, strict=True)):
            start, end, first = _around_longest_gap(one)
            axes.barh(row, min(one.duration, _LONGEST_SHOWN) / 3600.0, color=GRID, height=0.5)
            axes.barh(
                np.full(start.size, row),
                (end - start) / 3600.0,
                left=(start - first) / 3600.0,
                color=color(number),
                height=0.5,
            )
        axes.set_yticks(rows, [_place_row(one) for one in shown])
        axes.set_ylim(-0.6, len(shown) - 0.4)
        longest = max(min(one.duration, _LONGEST_SHOWN) for one in shown)
        axes.set_xlim(0.0, longest / 3600.0)
        axes.set_xlabel("time [h]")
        axes.grid(visible=False, axis="y")

    return draw(paint, height=0.75 + 0.4 * len(shown))


def _place_row(one: Coverage) -> str:
    worst = _worst(one)
    latitude = float(np.rad2deg(one.latitude.ravel()[worst]))
    return f"{walker_name(one.walker)}\nat latitude {plain(latitude) if latitude else '0'}°"


def _worst(one: Coverage) -> int:
    """Target with the longest gap; of several, the least covered."""
    longest = one.longest_gap.ravel()
    tied = np.flatnonzero(longest >= longest.max() * (1.0 - 1e-9))
    return int(tied[np.argmin(one.cover.ravel()[tied])])


def _around_longest_gap(one: Coverage) -> tuple[Array, Array, float]:
    """Covered intervals of the worst target in a window about its longest gap, and its start."""
    start, end = one.intervals.of(_worst(one))
    length = min(one.duration, _LONGEST_SHOWN)
    edges = np.concatenate([[0.0], end]), np.concatenate([start, [one.duration]])
    widest = int(np.argmax(edges[1] - edges[0]))
    middle = 0.5 * float(edges[0][widest] + edges[1][widest])
    first = min(max(middle - 0.5 * length, 0.0), one.duration - length)
    inside = (end > first) & (start < first + length)
    return (
        np.maximum(start[inside], first),
        np.minimum(end[inside], first + length),
        first,
    )
