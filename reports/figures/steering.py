"""What steering laws do along the orbit: small multiples, a row for each case."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe import CaseResult, Law, LawCurves

from ..reading_steering import ROUNDING, exact_laws, laws_of, steers
from ..steering_words import law_name
from ..tables_steering import rate_of
from .axes import along_orbit, drawn_values, mark_orbit, rounding_axis, thinned
from .style import MUTED, color, draw, name_series, shortened

Array = NDArray[np.float64]

LAW_STYLES: dict[Law, dict[str, Any]] = {
    Law.NONE: {"color": color(7), "linewidth": 1.2, "linestyle": (0, (1, 1.2)), "zorder": 2.0},
    Law.YAW: {"color": color(4), "linewidth": 1.3, "linestyle": (0, (6, 2)), "zorder": 2.4},
    Law.YAW_PITCH_APPROXIMATE: {
        "color": color(1),
        "linewidth": 1.2,
        "linestyle": (0, (2, 2)),
        "zorder": 2.5,
    },
    Law.YAW_PITCH: {"color": color(5), "linewidth": 2.6, "linestyle": "-", "zorder": 2.1},
    Law.PITCH_ROLL: {"color": color(2), "linewidth": 1.3, "linestyle": "-", "zorder": 2.3},
}
"""Laws that nearly coincide are told apart: the exact one lies broad beneath the others."""

LAW_MARKERS = {
    Law.NONE: "P",
    Law.YAW: "^",
    Law.YAW_PITCH_APPROXIMATE: "D",
    Law.YAW_PITCH: "s",
    Law.PITCH_ROLL: "o",
}

_FLOOR = 1e-13
"""Doppler [Hz] at which a zero is drawn on a logarithmic axis."""

_NO_ANGLE, _NO_RATE = 1e-5, 1e-9
"""Angles [°] and rates [°/s] that no axis shows: they are drawn as the zero that they are."""

_ROW = 1.28
"""Height of a row of panels [inch]."""


class _Column(NamedTuple):
    """A quantity that is drawn along the orbit, and of which laws."""

    heading: str
    label: str
    nothing: float
    read: Callable[[LawCurves], Array]
    keep: Callable[[LawCurves], bool] = lambda _: True


def attitude_figure(cases: Sequence[CaseResult]) -> bytes:
    """Angles of each law that steers; those of pitch-roll on scales of their own.

    Parameters
    ----------
    cases : a row each.
    """

    def turns_yaw(curves: LawCurves) -> bool:
        return curves.law is not Law.PITCH_ROLL and steers(curves)

    def rolls(curves: LawCurves) -> bool:
        return curves.law is Law.PITCH_ROLL

    columns = [
        _Column("", "yaw [°]", _NO_ANGLE, lambda curves: np.rad2deg(curves.yaw), turns_yaw),
        _Column(
            "laws that yaw",
            "pitch [°]",
            _NO_ANGLE,
            lambda curves: np.rad2deg(curves.pitch),
            turns_yaw,
        ),
        _Column("", "pitch [°]", _NO_ANGLE, lambda curves: np.rad2deg(curves.pitch), rolls),
        _Column("pitch-roll", "roll [°]", _NO_ANGLE, lambda curves: np.rad2deg(curves.roll), rolls),
    ]
    return _rows(cases, [one for one in columns if any(one.keep(c) for c in _all(cases))])


def rates_figure(cases: Sequence[CaseResult]) -> bytes:
    """Magnitude of the body's angular velocity against the orbit frame and inertial space.

    Parameters
    ----------
    cases : a row each.
    """
    return _rows(
        cases,
        [
            _Column(
                "against the orbit frame",
                "rate [°/s]",
                _NO_RATE,
                lambda curves: np.rad2deg(rate_of(curves.rate_orbit)),
            ),
            _Column(
                "inertial",
                "rate [°/s]",
                _NO_RATE,
                lambda curves: np.rad2deg(rate_of(curves.rate_inertial)),
            ),
        ],
    )


def boresight_figure(cases: Sequence[CaseResult]) -> bytes:
    """Residual Doppler of the boresight, on a logarithmic axis, and the incidence it has.

    Parameters
    ----------
    cases : a row each.
    """

    def finish(panels: Any) -> None:
        for row in panels:
            _doppler_axis(row[0])

    columns = [
        _Column(
            "at the boresight",
            "|Doppler| [Hz]",
            0.0,
            lambda curves: np.maximum(np.abs(curves.residual_doppler), _FLOOR),
        ),
        _Column("", "incidence [°]", _NO_ANGLE, lambda curves: np.rad2deg(curves.incidence)),
    ]
    return _rows(cases, columns, finish=finish)


def swath_figure(cases: Sequence[CaseResult]) -> bytes:
    """Doppler off the boresight: the largest of the orbit, and along it for the exact laws.

    Parameters
    ----------
    cases : a row each.
    """

    def paint(figure: Figure) -> None:
        panels = figure.subplots(len(cases), 2, squeeze=False)
        for row, case in zip(panels, cases, strict=True):
            _paint_offsets(row[0], case)
            _paint_bands(row[1], case)
            row[0].set_title(shortened(case.name, 48), loc="left")
        panels[-1][0].set_xlabel("elevation off the boresight [°]")
        panels[-1][1].set_xlabel("argument of latitude [°]")
        figure.align_ylabels()
        _name_laws(figure, laws_of(cases), marked=True)

    return draw(paint, height=_height(cases))


def _height(cases: Sequence[CaseResult]) -> float:
    return 0.75 + _ROW * len(cases)


def _rows(
    cases: Sequence[CaseResult],
    columns: Sequence[_Column],
    *,
    finish: Callable[[Any], None] = lambda _: None,
) -> bytes:
    """Panels of curves along the orbit: a row for each case, a column for each quantity."""
    shown = [curves for curves in _all(cases) if any(one.keep(curves) for one in columns)]

    def paint(figure: Figure) -> None:
        panels = figure.subplots(len(cases), len(columns), squeeze=False)
        for row, case in zip(panels, cases, strict=True):
            for axes, column in zip(row, columns, strict=True):
                _paint_panel(axes, case, column, many=len(columns) > 2)
            row[0].set_title(shortened(case.name, 34), loc="left")
        for axes, column in zip(panels[0], columns, strict=True):
            axes.set_title(column.heading, loc="right", color=MUTED, fontsize=8.0)
        for axes in panels[-1]:
            axes.set_xlabel("argument of latitude [°]")
        finish(panels)
        figure.align_ylabels()
        _name_laws(figure, [law for law in laws_of(cases) if law in {c.law for c in shown}])

    return draw(paint, height=_height(cases))


def _paint_panel(axes: Axes, case: CaseResult, column: _Column, *, many: bool) -> None:
    few = thinned(case.argument_of_latitude.size)
    abscissa = along_orbit(case.argument_of_latitude)[few]
    for curves in case.curves:
        if column.keep(curves):
            axes.plot(abscissa, column.read(curves)[few], **LAW_STYLES[curves.law])
    if not axes.lines:
        axes.set_axis_off()
        axes.annotate(
            "not compared",
            (0.5, 0.5),
            xycoords="axes fraction",
            ha="center",
            color=MUTED,
            fontsize=8.0,
        )
        return
    _widen(axes, column.nothing)
    axes.set_ylabel(column.label)
    mark_orbit(axes, case.argument_of_latitude, most=3 if many else 6)


def _widen(axes: Axes, nothing: float) -> None:
    """Keep a vertical axis so wide that rounding does not look like a motion."""
    low, high = axes.get_ylim()
    if max(abs(low), abs(high)) < nothing:
        axes.set_ylim(-1.0, 1.0)
        return
    least = 0.004 * max(abs(low), abs(high))
    if high - low < least:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5 * least, middle + 0.5 * least)


def _all(cases: Sequence[CaseResult]) -> list[LawCurves]:
    return [curves for case in cases for curves in case.curves]


def _doppler_axis(axes: Axes) -> None:
    values = drawn_values(axes)
    high = max(float(values.max(initial=1.0)), 10.0 * ROUNDING)
    low = max(float(values.min(initial=1.0)), _FLOOR)
    rounding_axis(axes, low=low / 5.0, high=high * 5.0, rounding=ROUNDING, ticks=6)


def _paint_offsets(axes: Axes, case: CaseResult) -> None:
    """Largest Doppler of the orbit against the elevation off the boresight."""
    offsets = np.rad2deg(case.case.swath_offsets)
    order = np.argsort(offsets)
    for curves in case.curves:
        found = np.abs(curves.swath_doppler)
        worst = np.max(found, axis=0, initial=0.0, where=np.isfinite(found))
        style = LAW_STYLES[curves.law] | {"linewidth": 1.0, "marker": LAW_MARKERS[curves.law]}
        axes.plot(offsets[order], np.maximum(worst, _FLOOR)[order], **style)
    _doppler_axis(axes)
    axes.set_ylabel("largest |Doppler| [Hz]")


def _paint_bands(axes: Axes, case: CaseResult) -> None:
    """Doppler along the orbit between the lowest and the highest over the swath."""
    few = thinned(case.argument_of_latitude.size)
    abscissa = along_orbit(case.argument_of_latitude)[few]
    exact = exact_laws([case])
    for curves in case.curves:
        if curves.law not in exact:
            continue
        style, found = LAW_STYLES[curves.law], curves.swath_doppler[few]
        low, high = found.min(axis=-1), found.max(axis=-1)
        axes.fill_between(abscissa, low, high, color=style["color"], alpha=0.35, linewidth=0.0)
        for edge in (low, high):
            axes.plot(abscissa, edge, color=style["color"], linewidth=0.8)
    _widen(axes, ROUNDING)
    mark_orbit(axes, case.argument_of_latitude)
    axes.set_ylabel("Doppler [Hz]")
    if not exact:
        axes.annotate("no law is exact here", (0.5, 0.5), xycoords="axes fraction", ha="center")


def _name_laws(figure: Figure, laws: Sequence[Law], *, marked: bool = False) -> None:
    handles = [
        Line2D([], [], **LAW_STYLES[law], marker=LAW_MARKERS[law] if marked else "") for law in laws
    ]
    name_series(
        figure,
        handles,
        [law_name(law) for law in laws],
        loc="outside lower center",
        ncols=min(len(laws), 5) or 1,
        handlelength=3.0,
    )
