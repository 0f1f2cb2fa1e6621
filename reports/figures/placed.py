"""Satellites that are placed by a table: where they are, and the heights of ambiguity they make."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar import Scene

from ..reading import Shown
from .height_error import mark_abscissa, scene_axis, series_line
from .style import MUTED, color, draw, error_axis, marker, name_series, shortened

Array = NDArray[np.float64]

_R, _N = 0, 2
_MOST_PAIRS = 15
"""Curves of heights of ambiguity that one panel takes."""


def placed_figure(formations: Sequence[Shown], scene: Scene) -> bytes:
    """Satellites seen along the flight, and the heights of ambiguity over the scene.

    Parameters
    ----------
    formations : the formation, or each acquisition, of the same satellites.
    scene : the segments.
    """
    names = formations[0].assessment.names

    def paint(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        _paint_places(left, formations, scene)
        _paint_ambiguities(right, formations, scene)
        handles = [
            Line2D([], [], color=MUTED, marker=marker(i), linestyle="") for i in range(len(names))
        ]
        labels = [shortened(name, 24) for name in names]
        if len(formations) > 1:
            handles += [Line2D([], [], color=color(shown.style)) for shown in formations]
            labels += [shortened(shown.assessment.label, 30) for shown in formations]
        name_series(figure, handles, labels, loc="outside lower center", ncols=4)

    entries = len(names) + (len(formations) if len(formations) > 1 else 0)
    return draw(paint, height=2.75 + 0.18 * -(-entries // 4))


def _paint_places(axes: Axes, formations: Sequence[Shown], scene: Scene) -> None:
    """Orbit normal and radial of each satellite, its course over the scene as a line."""
    for one, shade in formations:
        for index in range(len(one.names)):
            path = one.scene_positions[:, index]
            axes.plot(path[:, _N], path[:, _R], color=color(shade), linewidth=0.8, zorder=2)
            axes.plot(
                *path[len(path) // 2, [_N, _R]],
                color=color(shade),
                marker=marker(index),
                linestyle="",
                markersize=5.5,
                markeredgecolor="white",
                markeredgewidth=0.6,
                zorder=3,
            )
    places = np.concatenate([one.scene_positions.reshape(-1, 3) for one, _ in formations])
    low, high = places[:, [_N, _R]].min(axis=0), places[:, [_N, _R]].max(axis=0)
    half = 0.62 * max(float((high - low).max()), 1e-3)
    middle = 0.5 * (low + high)
    look = scene.line_of_sight[len(scene) // 2][[_N, _R]]
    axes.annotate(
        "",
        xy=tuple(middle + 0.95 * half * look),
        xytext=tuple(middle + 0.55 * half * look),
        arrowprops={"arrowstyle": "-|>", "color": MUTED, "linewidth": 1.0},
    )
    axes.annotate(
        "look", tuple(middle + 0.5 * half * look), color=MUTED, ha="center", va="center", fontsize=8
    )
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    axes.set_aspect("equal")
    axes.set_xlabel("orbit normal N [m]")
    axes.set_ylabel("radial R [m]")
    axes.set_title("(a) seen along the flight", loc="left")


def _paint_ambiguities(axes: Axes, formations: Sequence[Shown], scene: Scene) -> None:
    abscissa, label = scene_axis(scene)
    drawn = []
    for one, shade in formations:
        for pair in one.pairs[: max(1, _MOST_PAIRS // len(formations))]:
            values = np.where(
                np.isfinite(pair.height_of_ambiguity), pair.height_of_ambiguity, np.nan
            )
            axes.plot(abscissa, values, color=color(shade), **series_line(shade, scene))
            drawn.append(values)
    mark_abscissa(axes, abscissa, label)
    axes.set_ylabel("height of ambiguity [m]")
    axes.set_title("(b) pairs of images", loc="left")
    error_axis(axes, drawn)
