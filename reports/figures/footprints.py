"""The footprints of a film on a map."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar.observe.agile.video_results import VideoResult

from ..wording import fixed
from .maps import paint_ground, paint_scale
from .projection import Azimuthal
from .style import BROKEN, MUTED, color, draw, name_series

Array = NDArray[np.float64]

_SHADES = (color(0), color(1), color(2))
"""Of the first outline, the one nearest to zero Doppler, and the last."""

COMMON = color(4)
"""Of the ground that is seen all the time."""

_MOST_BETWEEN = 21
"""Outlines that a still map shows."""


class Plane(NamedTuple):
    """Footprints on the map about the aim point, east and north [km].

    Attributes
    ----------
    times : (K,) [s].
    outlines : (K, V, 2) — of those that lie on the Earth throughout, NaN else.
    common : (W, 2) — what all of them see.
    window : scalar — half the width of a square that shows them.
    """

    times: Array
    outlines: Array
    common: Array
    window: float


def plane_of(result: VideoResult) -> Plane:
    """Footprints of a film on the map about its aim point."""
    projection, prints = projection_of(result), result.footprints
    outlines = projection(prints.longitude, prints.latitude)
    whole = np.all(np.isfinite(outlines), axis=(1, 2))
    outlines = np.where(whole[:, None, None], outlines, np.nan)
    reach = np.abs(outlines[whole]).max(axis=(1, 2))
    # A footprint near the horizon would shrink all others to a dot.
    window = 1.12 * min(reach.max(), 4.0 * reach.min()) if reach.size else 1.0
    return Plane(
        prints.times,
        outlines,
        projection(prints.common_longitude, prints.common_latitude),
        float(window),
    )


def projection_of(result: VideoResult) -> Azimuthal:
    """Of the map about the aim point."""
    return Azimuthal(result.request.longitude, result.request.latitude)


def footprints_map(result: VideoResult) -> bytes:
    """Outlines of the beam at the start, at zero Doppler and at the end, on one map.

    Parameters
    ----------
    result : whose footprints are drawn.
    """
    plane = plane_of(result)

    def paint(figure: Figure) -> None:
        axes = figure.add_axes((0.22, 0.08, 0.45, 0.887))
        paint_ground(axes, projection_of(result), plane.window)
        for index in _few(len(plane.times)):
            outline = closed(plane.outlines[index])
            axes.plot(*outline.T, color=MUTED, linewidth=0.4, alpha=0.6)
        if len(plane.common):
            axes.fill(*plane.common.T, facecolor=COMMON, alpha=0.3, edgecolor=COMMON)
        for index, shade in zip(shown(plane), _SHADES, strict=True):
            axes.plot(*closed(plane.outlines[index]).T, color=shade, linewidth=1.6)
        axes.plot(0.0, 0.0, "+", color=BROKEN, markersize=8, zorder=5)
        paint_scale(axes, plane.window)
        _name(axes, plane)

    return draw(paint, height=3.4, layout=None)


def closed(outline: Array) -> Array:
    """Outline that ends where it begins."""
    return np.concatenate([outline, outline[:1]])


def _few(count: int) -> NDArray[np.int_]:
    return np.unique(np.linspace(0, count - 1, _MOST_BETWEEN).round().astype(int))


def shown(plane: Plane) -> tuple[int, int, int]:
    """The first outline, the one nearest to zero Doppler and the last, of those that there are."""
    known = np.flatnonzero(np.isfinite(plane.outlines[:, 0, 0]))
    if known.size == 0:
        known = np.arange(len(plane.times))
    middle = known[np.argmin(np.abs(plane.times[known]))]
    return int(known[0]), int(middle), int(known[-1])


def _name(axes: Axes, plane: Plane) -> None:
    handles = [Line2D([], [], color=shade, linewidth=1.6) for shade in _SHADES]
    names = [f"{fixed(float(plane.times[index]), 1)} s" for index in shown(plane)]
    handles.append(Line2D([], [], color=MUTED, linewidth=0.6))
    names.append("between")
    if len(plane.common):
        handles.append(Line2D([], [], color=COMMON, linewidth=5.0, alpha=0.5))
        names.append("seen all the time")
    name_series(
        axes, handles, names, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0
    )
