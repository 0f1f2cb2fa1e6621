"""The frames of a film, and what a yaw law leaves of the footprint's rotation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe.agile.video_results import LawSummary, VideoResult

from ..agile_words import yaw_law_name
from .axes import thinned
from .style import BROKEN, INK, MUTED, color, draw, error_axis, name_series
from .turning import DASHES, TIME_LABEL

Array = NDArray[np.float64]

_EXACT: dict[str, Any] = {"color": color(0), "linewidth": 1.4}
_HYPERBOLIC: dict[str, Any] = {"color": color(1), "linewidth": 1.3, "linestyle": (0, (5, 2))}
_PRINTED: dict[str, Any] = {"color": color(7), "linewidth": 1.2, "linestyle": (0, (1, 1.2))}
_ASKED: dict[str, Any] = {"color": BROKEN, "linewidth": 1.0, "linestyle": (0, (1, 1))}

_NOTHING = 1e-6
"""Rotations [°] below this are rounding."""

_KINDS = (
    ("azimuth_trace", "azimuth trace", "o"),
    ("range_trace", "range trace", "s"),
    ("major_axis", "major axis", "D"),
    ("shear", "shear", "^"),
)


def frames_figure(result: VideoResult) -> bytes:
    """Data, overlap, rates and resolution of every frame, by the hyperbola and exact.

    Parameters
    ----------
    result : whose frames are drawn.
    """
    frames, request = result.frames, result.request

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 3)
        data, difference, overlap = panels[0]
        _both(data, result, frames.hyperbolic.length / 1e3, frames.exact.length / 1e3)
        data.plot(frames.times, frames.printed_length / 1e3, **_PRINTED)
        data.set_ylabel("aperture of a frame [km]")
        departure = 100.0 * (frames.hyperbolic.length / frames.exact.length - 1.0)
        difference.plot(frames.times, departure, color=INK, linewidth=1.2)
        difference.set_ylabel("hyperbola less exact [%]")
        _both(overlap, result, 100.0 * frames.hyperbolic.overlap, 100.0 * frames.exact.overlap)
        if request.max_overlap:
            overlap.axhline(100.0 * request.max_overlap, **_ASKED)
        overlap.set_ylim(-4.0, 104.0)
        overlap.set_ylabel("data in common [%]")
        independent, limit, resolution = panels[1]
        _both(
            independent, result, frames.hyperbolic.independent_rate, frames.exact.independent_rate
        )
        _rate_axis(independent, request.frame_rate, "rate without common data [Hz]")
        if request.max_overlap:
            _both(limit, result, frames.hyperbolic.rate_limit, frames.exact.rate_limit)
            _rate_axis(
                limit, request.frame_rate, f"rate for {100.0 * request.max_overlap:.3g} % [Hz]"
            )
        else:
            limit.plot(frames.times, np.rad2deg(frames.squint), color=INK, linewidth=1.2)
            limit.set_ylabel("squint [°]")
        resolution.plot(frames.times, frames.ground_resolution, color=INK, linewidth=1.2)
        resolution.set_ylabel("ground resolution [m]")
        for index, axes in enumerate(panels.ravel()):
            axes.set_title(f"({'abcdef'[index]})", loc="left")
            axes.locator_params(axis="x", nbins=5)
            axes.set_xlim(float(result.times[0]), float(result.times[-1]))
        for axes in panels[1]:
            axes.set_xlabel(TIME_LABEL)
        styles = (_EXACT, _HYPERBOLIC, _PRINTED, _ASKED)
        names = ("exact", "hyperbola", "hyperbola as printed", "asked for")
        handles = [Line2D([], [], **style) for style in styles]
        name_series(figure, handles, names, loc="outside lower center", ncols=4, handlelength=3.0)

    return draw(paint, height=4.0)


def _both(axes: Axes, result: VideoResult, hyperbolic: Array, exact: Array) -> None:
    times = result.frames.times
    axes.plot(times, exact, **_EXACT)
    axes.plot(times, hyperbolic, **_HYPERBOLIC)


def _rate_axis(axes: Axes, asked: float, label: str) -> None:
    """Rates from zero on, with the one that is asked for."""
    axes.axhline(asked, **_ASKED)
    axes.set_ylim(0.0, None)
    axes.set_ylabel(label)


def distortion_figure(result: VideoResult) -> bytes:
    """Rotation and shear of the footprint, and its size, over the film.

    Parameters
    ----------
    result : whose yaw law is drawn.
    """
    few, left = thinned(len(result.times)), result.distortion

    def paint(figure: Figure) -> None:
        turns, sizes = figure.subplots(1, 2)
        handles = []
        for index, (name, label, _) in enumerate(_KINDS):
            values = np.rad2deg(getattr(left, name)[few])
            style: dict[str, Any] = {"color": color(index), "linestyle": DASHES[index]}
            turns.plot(result.times[few], values, **style)
            handles.append(Line2D([], [], **style, label=label))
        turns.set_ylabel("rotation, shear [°]")
        _widen(turns)
        for index, (name, label) in enumerate(
            (
                ("azimuth_stretch", "length along azimuth"),
                ("range_stretch", "length along range"),
                ("area", "area"),
            )
        ):
            style = {"color": color(4 + index), "linestyle": DASHES[index]}
            sizes.plot(result.times[few], getattr(left, name)[few], **style)
            handles.append(Line2D([], [], **style, label=label))
        sizes.set_ylabel("by that at the reference time")
        for axes in (turns, sizes):
            axes.axvline(result.request.reference_time, color=MUTED, linewidth=0.6)
            axes.set_xlabel(TIME_LABEL)
            axes.set_xlim(float(result.times[0]), float(result.times[-1]))
        names = [str(handle.get_label()) for handle in handles]
        name_series(figure, handles, names, loc="outside lower center", ncols=4, handlelength=3.0)

    return draw(paint, height=2.75)


def _widen(axes: Axes) -> None:
    """Keep an axis so wide that rounding does not look like a motion."""
    low, high = axes.get_ylim()
    if high - low < _NOTHING:
        axes.set_ylim(-1.0, 1.0)


def laws_figure(laws: Sequence[LawSummary]) -> bytes:
    """What every yaw law leaves, and the turn that it takes.

    Parameters
    ----------
    laws : summed up over the film.
    """
    rows = np.arange(len(laws))[::-1]

    def paint(figure: Figure) -> None:
        left, right = figure.subplots(1, 2, sharey=True, width_ratios=(2.0, 1.0))
        for index, (name, _, mark) in enumerate(_KINDS):
            values = np.rad2deg([getattr(law, name) for law in laws])
            shift = 0.12 * (1.5 - index)
            left.plot(
                np.where(values < _NOTHING, 0.0, values),
                rows + shift,
                mark,
                color=color(index),
                markersize=5.5,
            )
        left.set_xlim(left=min(-0.02 * left.get_xlim()[1], 0.0))
        left.set_yticks(rows, [yaw_law_name(law.law) for law in laws])
        left.set_ylim(-0.6, len(laws) - 0.4)
        left.set_xlabel("largest rotation, shear [°]")
        for row in rows[:-1]:
            for axes in (left, right):
                axes.axhline(row - 0.5, color="#eeeeee", linewidth=0.8, zorder=0.5)
        shares = 100.0 * np.nan_to_num([law.common_area for law in laws])
        right.barh(rows, shares, height=0.5, color=color(5))
        right.set_xlim(0.0, max(104.0, 1.04 * float(shares.max())))
        right.set_xlabel("seen all the time [%]")
        for axes in (left, right):
            axes.grid(visible=False, axis="y")
        handles = [
            Line2D([], [], color=color(n), marker=mark, linestyle="", markersize=5.5)
            for n, (_, _, mark) in enumerate(_KINDS)
        ]
        name_series(
            figure,
            handles,
            [label for _, label, _ in _KINDS],
            loc="outside lower center",
            ncols=4,
        )

    return draw(paint, height=2.6)


def pointing_figure(result: VideoResult) -> bytes:
    """What the pointing errors asked for do to the footprint over the film.

    Parameters
    ----------
    result : whose errors are drawn.
    """
    few, effect = thinned(len(result.times)), result.pointing

    def paint(figure: Figure) -> None:
        center, rotation = figure.subplots(1, 2)
        center.plot(result.times[few], effect.center[few], color=color(0))
        center.set_ylabel("center, RMS [m]")
        rotation.plot(result.times[few], np.rad2deg(effect.rotation[few]), color=color(1))
        rotation.set_ylabel("rotation, standard deviation [°]")
        error_axis(center, [effect.center])
        error_axis(rotation, [np.rad2deg(effect.rotation)])
        for axes in (center, rotation):
            axes.set_xlabel(TIME_LABEL)
            axes.set_xlim(float(result.times[0]), float(result.times[-1]))

    return draw(paint, height=2.2)
