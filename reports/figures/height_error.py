"""Height error of each segment of the scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from insar import Scene

from ..reading import Shown
from .style import GRID, color, draw, error_axis, legend_rows, name_formations, series_marker

Array = NDArray[np.float64]

_STANDING, _LITTLE = 1e-6, 0.05
"""Relative spread over the scene below which an error stands still, and from which it is seen."""

_SEGMENT = "segment"


def scene_axis(scene: Scene) -> tuple[Array, str]:
    """Abscissa of the segments and its label: time, or the incidence where time stands still.

    The number of the segment where neither runs.
    """
    if len(scene) > 1 and bool(np.all(np.diff(scene.times) > 0.0)):
        return scene.times, "time since the epoch of the states [s]"
    still = bool(np.all(scene.times == scene.times[0]))
    if len(scene) > 1 and still and bool(np.all(np.diff(scene.incidence) > 0.0)):
        return np.rad2deg(scene.incidence), "incidence [°]"
    return np.arange(1.0, len(scene) + 1.0), _SEGMENT


def series_line(style: int, scene: Scene) -> dict[str, Any]:
    """Line and marker of a series over the scene.

    Segments of an area lie beside one another, near and far by turns: a line through them in the
    order of time would show a course that there is not, so they are marked one by one.
    """
    look = scene.look_angle
    turns = np.count_nonzero(np.diff(np.sign(np.diff(look))))
    if 3 * turns > len(scene):
        return {"linestyle": "", "marker": series_marker(style, len(scene)) or "."}
    return {"linestyle": "-", "marker": series_marker(style, len(scene))}


def height_error_figure(formations: Sequence[Shown], scene: Scene) -> bytes:
    """Total and relative error over the scene, with the RMS of each dashed.

    Parameters
    ----------
    formations : those compared.
    scene : the segments.
    """
    moving = moves_little(formations, scene)

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2 if moving else 1, 2, squeeze=False)
        total, relative = panels[0]
        errors = [f.assessment.height_error for f in formations]
        styles = [f.style for f in formations]
        _paint_panel(total, scene, styles, [(e.total, e.region) for e in errors])
        _paint_panel(relative, scene, styles, [(e.relative, e.relative_region) for e in errors])
        total.set_title("(a) total", loc="left")
        relative.set_title("(b) relative", loc="left")
        if moving:
            _paint_course(panels[1, 0], scene, styles, [(e.total, e.region) for e in errors])
            _paint_course(
                panels[1, 1], scene, styles, [(e.relative, e.relative_region) for e in errors]
            )
            panels[1, 0].set_title("(c) total, against its RMS", loc="left")
            panels[1, 1].set_title("(d) relative, against its RMS", loc="left")
        name_formations(figure, formations)

    return draw(paint, height=(4.4 if moving else 2.4) + 0.18 * legend_rows(formations))


def moves_little(formations: Sequence[Shown], scene: Scene) -> bool:
    """Whether the error moves over the scene, but by too little to be seen beside its size."""
    if series_line(0, scene)["linestyle"] == "" or scene_axis(scene)[1] == _SEGMENT:
        return False
    spreads = [_spread(shown.assessment.height_error.total) for shown in formations]
    return _STANDING < max(spreads, default=0.0) < _LITTLE


def _spread(values: Array) -> float:
    """Largest less smallest over the largest; infinite where one is."""
    if not np.all(np.isfinite(values)):
        return np.inf
    return float(np.ptp(values) / values.max())


def _paint_course(
    axes: Axes, scene: Scene, styles: Sequence[int], series: Sequence[tuple[Array, Array]]
) -> None:
    """How an error moves over the scene, in per cent of its RMS."""
    abscissa, label = scene_axis(scene)
    axes.axhline(0.0, color=GRID, linewidth=0.9)
    for style, (values, region) in zip(styles, series, strict=True):
        change = 100.0 * (values / region - 1.0)
        axes.plot(abscissa, change, color=color(style), **series_line(style, scene))
    mark_abscissa(axes, abscissa, label)
    axes.set_ylabel("change [%]")


def _paint_panel(
    axes: Axes, scene: Scene, styles: Sequence[int], series: Sequence[tuple[Array, Array]]
) -> None:
    abscissa, label = scene_axis(scene)
    for style, (values, region) in zip(styles, series, strict=True):
        shown = np.where(np.isfinite(values), values, np.nan)
        if np.isfinite(region):
            axes.axhline(float(region), color=color(style), linestyle=(0, (5, 3)), linewidth=0.8)
        axes.plot(abscissa, shown, color=color(style), **series_line(style, scene))
    mark_abscissa(axes, abscissa, label)
    axes.set_ylabel("height error [m]")
    error_axis(axes, [values for values, _ in series])


def mark_abscissa(axes: Axes, abscissa: Array, label: str) -> None:
    """Label the abscissa of `scene_axis`; segments are counted in whole numbers."""
    axes.set_xlabel(label)
    if label == _SEGMENT:
        if abscissa.size < 12:
            axes.set_xticks(abscissa)
        else:
            axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_xlim(abscissa[0] - 0.5, abscissa[-1] + 0.5)
