"""Yaw-pitch or pitch-roll: what each costs, over altitude and inclination."""

from __future__ import annotations

import math
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe import Selection

from ..reading_steering import ROUNDING
from ..steering_words import law_name
from ..tables_steering import POINTING_STEP
from ..wording import fixed, plain
from .style import INK, draw, name_series, plain_log_ticks

Array = NDArray[np.float64]

_DASHES: tuple[Any, ...] = ("-", (0, (4, 1.6)))


def selection_figure(selection: Selection) -> bytes:
    """Five costs of both laws against altitude, a color for each inclination.

    Parameters
    ----------
    selection : both laws over altitude and inclination.
    """
    offset = plain(math.degrees(selection.swath_offset))
    limit = plain(math.degrees(selection.slew_rate))
    costs = (
        ("(a) steered angles, added", "angle [°]", np.rad2deg(selection.steering_angle), False),
        (f"(b) slew at {limit} °/s", "time [min]", selection.slew_time / 60.0, True),
        ("(c) rate of the angles", "rate [°/s]", np.rad2deg(selection.rate), True),
        (
            "(d) sensitivity to pointing",
            "Doppler [Hz per 0.01°]",
            selection.pointing_sensitivity * POINTING_STEP,
            True,
        ),
        (f"(e) {offset}° off the boresight", "Doppler [Hz]", selection.swath_doppler, True),
    )

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 3).ravel()
        for axes, (title, label, values, is_log) in zip(panels, costs, strict=False):
            _paint_cost(axes, selection, values, is_log=is_log)
            axes.set_title(title, loc="left")
            axes.set_ylabel(label)
        _mark_crossovers(panels[0], selection)
        for axes in panels[2:5]:
            axes.set_xlabel("altitude [10³ km]")
        panels[5].set_axis_off()
        _name_lines(panels[5], selection)

    return draw(paint, height=4.1)


def _shade(index: int, count: int) -> str:
    """Color of an inclination: dark to light, also for the color-blind."""
    position = 0.0 if count == 1 else 0.88 * index / (count - 1)
    return str(mpl.colors.to_hex(mpl.colormaps["viridis"](position)))


def _paint_cost(axes: Axes, selection: Selection, values: Array, *, is_log: bool) -> None:
    altitudes = selection.altitudes / 1e6
    count = len(selection.inclinations)
    for law, dashes in enumerate(_DASHES):
        for index in range(count):
            series = values[law, index]
            if is_log and np.nanmax(series, initial=0.0) < ROUNDING:
                continue  # a zero has no place on a logarithmic axis; the caption says so
            axes.plot(
                altitudes, series, color=_shade(index, count), linestyle=dashes, linewidth=1.1
            )
    if is_log:
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        plain_log_ticks(axes.yaxis, decades=math.log10(high / low))
    if altitudes.max() > 4.0 * altitudes.min():
        axes.set_xscale("log")
        plain_log_ticks(axes.xaxis, decades=2.0)
    axes.set_xlim(altitudes.min(), altitudes.max())


def _mark_crossovers(axes: Axes, selection: Selection) -> None:
    for index, found in enumerate(selection.crossovers):
        angle = np.rad2deg(
            np.interp(found, selection.altitudes, selection.steering_angle[0, index])
        )
        axes.plot(np.array(found) / 1e6, angle, "o", markersize=4.0, mfc="white", mec=INK, zorder=5)


def _name_lines(axes: Axes, selection: Selection) -> None:
    count = len(selection.inclinations)
    handles = [Line2D([], [], color=INK, linestyle=dashes) for dashes in _DASHES]
    names = [law_name(law) for law in selection.laws]
    if any(selection.crossovers):
        handles.append(Line2D([], [], color=INK, marker="o", mfc="white", linestyle=""))
        names.append("equal angles")
    for index, inclination in enumerate(selection.inclinations):
        handles.append(Line2D([], [], color=_shade(index, count), linewidth=2.0))
        names.append(f"inclination {fixed(math.degrees(inclination), 0)}°")
    name_series(
        axes,
        handles,
        names,
        loc="upper left",
        borderaxespad=0.0,
        handlelength=2.4,
        labelspacing=0.3,
        ncols=1 if len(names) <= 10 else 2,
    )
