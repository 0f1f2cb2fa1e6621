"""How much of the Doppler the simplified yaw law compensates (Meng 2003, figures 3 to 6)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from insar.observe import Compensation, CompensationCurve

from ..steering_words import effect_name
from ..wording import fixed, plain
from .axes import along_orbit, mark_orbit
from .style import BROKEN, INK, color, draw, name_series

_SOUGHT = 95.0
"""Compensation that Meng asks for [%]."""


_NOTHING = 1e-6
"""Difference of range rates that is rounding, as in the table beside it [m/s]."""

_SHADES = (INK, color(0), color(1), color(2))
_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 2)), "-.")
"""Of the differences, for each argument of perigee."""

_SIMPLIFIED: dict[str, Any] = {"color": color(1), "linestyle": (0, (4, 2))}


def effects_figure(compensation: Compensation) -> bytes:
    """Exact and simplified Doppler over a revolution, and their difference.

    Parameters
    ----------
    compensation : a row for each of its effects, whose differences are drawn for each perigee.
    """
    effects = dict.fromkeys(curve.effect for curve in compensation.curves)
    groups = [[c for c in compensation.curves if c.effect is effect] for effect in effects]

    def paint(figure: Figure) -> None:
        panels = figure.subplots(len(groups), 2, squeeze=False)
        for row, curves in zip(panels, groups, strict=True):
            _paint_effect(row[0], row[1], curves)
        for axes in panels[-1]:
            axes.set_xlabel("argument of latitude [°]")
        figure.align_ylabels()
        _name_lines(figure, max(groups, key=len))

    return draw(paint, height=0.75 + 1.28 * len(groups))


def _paint_effect(left: Axes, right: Axes, curves: Sequence[CompensationCurve]) -> None:
    """One effect: the Doppler of both models, and their difference for each perigee."""
    for index, curve in enumerate(curves):
        abscissa = along_orbit(curve.argument_of_latitude)
        left.plot(abscissa, curve.exact, color=color(5), linewidth=2.4)
        right.plot(
            abscissa,
            curve.exact - curve.simplified,
            color=_SHADES[index % len(_SHADES)],
            linestyle=_DASHES[index % len(_DASHES)],
        )
        mark_orbit(left, curve.argument_of_latitude)
        mark_orbit(right, curve.argument_of_latitude)
    left.plot(abscissa, curves[0].simplified, **_SIMPLIFIED)
    _widen(right)
    left.set_ylabel("λf/2 [m/s]")
    right.set_ylabel("difference [m/s]")
    title = effect_name(curves[0].effect)
    if curves[0].eccentricity > 0.0:
        title += f", e = {plain(curves[0].eccentricity)}"
    left.set_title(title, loc="left")


def _name_lines(figure: Figure, curves: Sequence[CompensationCurve]) -> None:
    handles = [Line2D([], [], color=color(5), linewidth=2.4), Line2D([], [], **_SIMPLIFIED)]
    names = ["exact, Meng (1)", "simplified, Meng (5)"]
    if len(curves) > 1:
        for index, curve in enumerate(curves):
            handles.append(
                Line2D(
                    [],
                    [],
                    color=_SHADES[index % len(_SHADES)],
                    linestyle=_DASHES[index % len(_DASHES)],
                )
            )
            names.append(f"perigee at {fixed(math.degrees(curve.argument_of_perigee), 0)}°")
    name_series(figure, handles, names, loc="outside lower center", ncols=min(len(names), 5))


def _widen(axes: Axes) -> None:
    """Draw a difference that is rounding as the zero that it is."""
    low, high = axes.get_ylim()
    if max(abs(low), abs(high)) < _NOTHING:
        axes.set_ylim(-1.0, 1.0)


def sweep_figure(compensation: Compensation) -> bytes:
    """Compensation against the eccentricity, in both norms.

    Parameters
    ----------
    compensation : with its sweep.
    """

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.axhline(_SOUGHT, color=BROKEN, linewidth=0.9, linestyle=(0, (5, 3)))
        axes.annotate(
            f"{plain(_SOUGHT)} %",
            (1.0, _SOUGHT),
            xycoords=("axes fraction", "data"),
            xytext=(-3, 3),
            textcoords="offset points",
            ha="right",
            color=BROKEN,
            fontsize=8.0,
        )
        for values, shade, dashes, name in (
            (compensation.sweep, color(0), "-", "maximum norm"),
            (compensation.sweep_rms, color(2), (0, (5, 2)), "root-mean-square norm"),
        ):
            axes.plot(
                compensation.eccentricities,
                100.0 * values,
                color=shade,
                linestyle=dashes,
                label=name,
            )
        axes.set_xlabel("eccentricity")
        axes.set_ylabel("compensated [%]")
        axes.set_xlim(compensation.eccentricities.min(), compensation.eccentricities.max())
        axes.legend(loc="lower left")

    return draw(paint, height=2.3)
