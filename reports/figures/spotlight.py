"""Where the beam of a spotlight falls, and what the radar sees."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe.agile.spotlight_results import AimError, SpotlightResult

from ..reading_agile import AIM_ROUNDING
from ..tables_steering import largest, least
from .axes import drawn_values, rounding_axis, thinned
from .style import INK, color, draw, name_series
from .turning import TIME_LABEL

Array = NDArray[np.float64]

AIM_METHODS = {
    "closed_form": "everything, closed form",
    "iterated": "everything, by iteration",
    "without_phase_center": "off-axis angle, no phase center",
    "without_both": "neither",
}
"""What an attitude considers, by the name of its error."""

_STYLES: tuple[tuple[str, Any, float], ...] = (
    (color(2), "-", 2.4),
    (color(3), (0, (3, 2)), 1.2),
    (color(4), (0, (6, 2)), 1.4),
    (color(1), "-", 1.4),
)

_FLOOR = 1e-11
"""Aim error at which a zero is drawn on a logarithmic axis [m]."""


def aim_figure(times: Array, error: AimError) -> bytes:
    """Aim error of what an attitude considers, on a logarithmic axis.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    error : of every attitude.
    """
    few = thinned(len(times))

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        for name, (shade, dashes, width) in zip(AIM_METHODS, _STYLES, strict=True):
            values = np.maximum(getattr(error, name)[few], _FLOOR)
            axes.plot(times[few], values, color=shade, linestyle=dashes, linewidth=width)
        _aim_axis(axes)
        axes.set_xlim(float(times[0]), float(times[-1]))
        axes.set_xlabel(TIME_LABEL)
        axes.set_ylabel("aim error [m]")
        handles = [Line2D([], [], color=c, linestyle=d, linewidth=w) for c, d, w in _STYLES]
        name_series(
            figure,
            handles,
            list(AIM_METHODS.values()),
            loc="outside lower center",
            ncols=4,
            handlelength=3.0,
            columnspacing=1.2,
        )

    return draw(paint, height=2.7)


def _aim_axis(axes: Axes) -> None:
    high = 8.0 * np.fmax(largest(drawn_values(axes)), 10.0 * AIM_ROUNDING)
    rounding_axis(axes, low=_FLOOR / 3.0, high=high, rounding=AIM_ROUNDING, ticks=9)


def echo_figure(result: SpotlightResult) -> bytes:
    """Slant range, Doppler, and what of the Doppler is not a straight line.

    Parameters
    ----------
    result : whose echo is drawn.
    """
    times, history = result.times, result.history
    few = thinned(len(times))
    straight = result.plan.doppler_rate * times

    def paint(figure: Figure) -> None:
        panels = figure.subplots(1, 3)
        curves = (
            (history.slant_range - least(history.slant_range), "range, less the least [m]"),
            (history.doppler / 1e3, "Doppler [kHz]"),
            (history.doppler - straight, "Doppler, less its tangent [Hz]"),
        )
        for index, (axes, (values, label)) in enumerate(zip(panels, curves, strict=True)):
            axes.plot(times[few], values[few], color=color(0))
            axes.set_ylabel(label)
            axes.set_xlabel(TIME_LABEL)
            axes.set_xlim(float(times[0]), float(times[-1]))
            axes.locator_params(axis="both", nbins=5)
            axes.set_title(f"({'abc'[index]})", loc="left")
            _mark_aperture(axes, times, 0.5 * result.plan.aperture_time)

    return draw(paint, height=2.25)


def _mark_aperture(axes: Axes, times: Array, half: float) -> None:
    """Ends of the aperture time, where the curves go beyond it."""
    if half < 0.995 * float(times[-1]):
        for end in (-half, half):
            axes.axvline(end, color=INK, linewidth=0.8, linestyle=(0, (1, 1.5)))
