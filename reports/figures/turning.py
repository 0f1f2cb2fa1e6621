"""How a body turns during an imaging: angles, quaternions, rates and accelerations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe.agile.agility import Agility
from insar.observe.agile.profiles import Profile

from ..tables_steering import rate_of
from .axes import thinned
from .style import BROKEN, INK, MUTED, color, draw, name_series

Array = NDArray[np.float64]

TIME_LABEL = "time from zero Doppler [s]"

_AXES = ("X", "Y", "Z")
_PARTS = ("i", "j", "k", "scalar")
DASHES: tuple[Any, ...] = ("-", (0, (6, 1.5)), (0, (2, 1.2)), (0, (6, 1.5, 1.5, 1.5)))

_LIMIT: Any = (0, (1, 1))

_IN_VIEW = 2.5
"""A limit is drawn if it is within so many times what it limits; beyond, its value is written."""

_STEADY = 1e-6
"""Angles [°] whose variation is smaller are drawn as the constants that they are."""


class Angle(NamedTuple):
    """One of the angles of an attitude, (S,) [rad]."""

    name: str
    values: Array


def attitude_figure(times: Array, angles: Sequence[Angle], profile: Profile) -> bytes:
    """Euler angles on scales of their own, and quaternions.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    angles : in the order of the sequence.
    profile : whose quaternions are drawn.
    """
    few = thinned(len(times))

    def paint(figure: Figure) -> None:
        grid = figure.add_gridspec(2, 6)
        for index, angle in enumerate(angles):
            axes = figure.add_subplot(grid[0, 2 * index : 2 * index + 2])
            axes.plot(times[few], np.rad2deg(angle.values[few]), color=color(index))
            axes.set_ylabel(f"{angle.name} [°]")
            _widen(axes)
            _time_axis(axes, times)
        for index, (name, values) in enumerate(
            (
                ("against the orbit frame", profile.quaternion_orbit),
                ("against the GCRS", profile.quaternion_inertial),
            )
        ):
            axes = figure.add_subplot(grid[1, 3 * index : 3 * index + 3])
            for part in range(4):
                axes.plot(times[few], values[few, part], color=color(part), linestyle=DASHES[part])
            axes.set_ylim(-1.06, 1.06)
            axes.set_ylabel("quaternion")
            axes.set_title(name, loc="right", color=MUTED, fontsize=8.0)
            axes.set_xlabel(TIME_LABEL)
            _time_axis(axes, times)
        handles = [Line2D([], [], color=color(n), linestyle=DASHES[n]) for n in range(4)]
        name_series(figure, handles, _PARTS, loc="outside lower center", ncols=4, handlelength=3.0)

    return draw(paint, height=3.7)


def _widen(axes: Axes) -> None:
    """Keep an axis so wide that rounding does not look like a motion."""
    low, high = axes.get_ylim()
    if high - low < _STEADY:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5, middle + 0.5)


def _time_axis(axes: Axes, times: Array) -> None:
    axes.set_xlim(float(times[0]), float(times[-1]))
    axes.locator_params(axis="both", nbins=6)


def rates_figure(times: Array, profile: Profile, agility: Agility | None) -> bytes:
    """Angular rates and accelerations, against the orbit frame and against inertial space.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    profile : what is drawn.
    agility : limits of what is inertial; None for none.
    """

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 2, sharex=True)
        rows = (
            ("against the orbit frame", profile.rate_orbit, profile.acceleration_orbit),
            ("inertial", profile.rate_inertial, profile.acceleration_inertial),
        )
        for row, (name, rate, acceleration) in zip(panels, rows, strict=True):
            _paint_vectors(row[0], times, rate, "rate [°/s]")
            _paint_vectors(row[1], times, acceleration, "acceleration [°/s²]")
            for axes in row:
                axes.set_title(name, loc="right", color=MUTED, fontsize=8.0)
        if agility is not None:
            _paint_limit(panels[1][0], agility.max_rate, "°/s")
            _paint_limit(panels[1][1], agility.max_acceleration, "°/s²")
            _shade(panels[1][0], times, profile.rate_exceeded)
            _shade(panels[1][1], times, profile.acceleration_exceeded)
        for axes in panels[1]:
            axes.set_xlabel(TIME_LABEL)
        figure.align_ylabels()
        handles = [Line2D([], [], color=color(n), linestyle=DASHES[n]) for n in range(3)]
        names = [*_AXES, "magnitude"]
        handles.append(Line2D([], [], color=INK, linewidth=1.6))
        if agility is not None:
            each = BROKEN if np.ndim(agility.max_rate) == 0 else MUTED
            handles.append(Line2D([], [], color=each, linestyle=_LIMIT))
            names.append("limit")
        name_series(
            figure, handles, names, loc="outside lower center", ncols=len(names), handlelength=3.0
        )

    return draw(paint, height=3.9)


def _paint_vectors(axes: Axes, times: Array, vectors: Array, label: str) -> None:
    few = thinned(len(times))
    for axis in range(3):
        axes.plot(
            times[few], np.rad2deg(vectors[few, axis]), color=color(axis), linestyle=DASHES[axis]
        )
    axes.plot(times[few], np.rad2deg(rate_of(vectors)[few]), color=INK, linewidth=1.6, zorder=1.9)
    axes.set_ylabel(label)
    _time_axis(axes, times)


def _paint_limit(axes: Axes, limit: float | tuple[float, float, float], unit: str) -> None:
    """Limits that are near what they limit as lines, others in words."""
    low, high = axes.get_ylim()
    reach = _IN_VIEW * max(abs(low), abs(high))
    far = []
    total = np.ndim(limit) == 0
    for axis, value in enumerate(np.rad2deg(np.atleast_1d(limit))):
        if not np.isfinite(value):
            continue
        if value > reach:
            far.append(f"{'' if total else f'{_AXES[axis]}: '}{value:.3g}{unit}")
            continue
        for signed in (value,) if total else (-value, value):
            shade = BROKEN if total else color(axis)
            axes.axhline(signed, color=shade, linewidth=1.0, linestyle=_LIMIT, zorder=2.5)
    if np.any(np.rad2deg(np.atleast_1d(limit)) <= reach):
        axes.relim()
        axes.margins(y=0.08)
        axes.autoscale_view(scalex=False)
    if far:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.22 * (high - low))
        axes.annotate(
            f"limit far above: {', '.join(far)}",
            (0.98, 0.93),
            xycoords="axes fraction",
            ha="right",
            va="top",
            fontsize=7.0,
            color=MUTED,
            bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1.0},
        )


def _shade(axes: Axes, times: Array, where: NDArray[np.bool_]) -> None:
    """The times at which a limit is exceeded."""
    low, high = axes.get_ylim()
    axes.fill_between(
        times, low, high, where=where.tolist(), color=BROKEN, alpha=0.08, linewidth=0.0
    )
    axes.set_ylim(low, high)
