"""Relative orbits: three views to one scale, and a view in space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch
from matplotlib.ticker import FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from optimize import Assessment

from .style import WIDTH, color, draw, marker, name_series, shortened

Array = NDArray[np.float64]

_R, _T, _N = 0, 1, 2
_AXIS_NAMES = ("radial R", "along-track T", "orbit normal N")

_IN_KILOMETERS = 5000.0
"""Half extent beyond which axes are in kilometers: five digits a tick would not fit [m]."""


_LEFT, _BOTTOM, _GAP_X, _GAP_Y = 0.62, 0.4, 0.68, 0.62
"""Room for the labels around the panels [inch]."""

_WIDEST = 1.95
"""Width of the panel of the longest axis [inch]."""


_LEAST = np.array([0.4, 0.72, 0.72])
"""Least extents along R, T and N in parts of the largest: what a panel's title and arrows need."""


class _View(NamedTuple):
    """A projection: its axes, and the panel [inch] that it fills."""

    horizontal: int
    vertical: int
    left: float
    bottom: float
    width: float
    height: float


def orbits_figure(
    assessment: Assessment, *, baselines: Sequence[tuple[int, int]], line_of_sight: Array
) -> bytes:
    """Relative orbits of one formation.

    Parameters
    ----------
    assessment : the formation.
    baselines : those that are drawn, two satellites each.
    line_of_sight : (3,) — direction of view in the middle of the scene, RTN.
    """
    half = half_extents(assessment)
    scale = _WIDEST / (2.0 * max(half[_T], half[_N]))
    width_t, width_n, height_r = (2.0 * scale * float(half[i]) for i in (_T, _N, _R))
    right, top = _LEFT + width_t + _GAP_X, _BOTTOM + width_n + _GAP_Y
    views = (
        _View(_T, _R, _LEFT, top, width_t, height_r),
        _View(_N, _R, right, top, width_n, height_r),
        _View(_T, _N, _LEFT, _BOTTOM, width_t, width_n),
    )
    height = top + height_r + 0.22

    def paint(figure: Figure) -> None:
        for letter, view in zip("abc", views, strict=True):
            axes = figure.add_axes(
                (
                    view.left / WIDTH,
                    view.bottom / height,
                    view.width / WIDTH,
                    view.height / height,
                )
            )
            _paint_view(figure, axes, view, assessment, baselines, half, line_of_sight)
            title = f"({letter}) {_TITLES[view.horizontal, view.vertical]}"
            axes.set_title(title, loc="left", pad=4)
        space = (right - 0.2, 0.0, WIDTH - right + 0.2, top - 0.35)
        _paint_space(figure, space, half, assessment, baselines)
        trans = figure.dpi_scale_trans
        figure.text(right, _BOTTOM + width_n + 0.055, "(d) in space", transform=trans)
        _paint_key(figure, assessment, (right + width_n + 0.12, top + height_r))

    return draw(paint, height=height, layout=None)


def _paint_key(figure: Figure, assessment: Assessment, corner: tuple[float, float]) -> None:
    """What arrows and marks mean, from a corner given in inches downwards."""
    left, top = corner
    trans = figure.dpi_scale_trans
    for row, (name, shade) in enumerate(_DIRECTIONS):
        y = top - 0.06 - 0.15 * row
        _paint_arrow(figure, np.array([left + 0.13, y]), np.array([0.2, 0.0]), shade)
        figure.text(left + 0.3, y, name, transform=trans, fontsize=8, va="center_baseline")
    names = [shortened(name, 15) for name in assessment.names]
    handles = [
        Line2D([], [], color=color(i), marker=marker(i), markersize=6, markeredgecolor="white")
        for i in range(len(names))
    ]
    name_series(
        figure,
        handles,
        names,
        loc="upper left",
        bbox_to_anchor=(left, top - 0.3),
        bbox_transform=trans,
        borderaxespad=0.0,
        borderpad=0.0,
        handlelength=1.7,
        handletextpad=0.4,
        labelspacing=0.3,
        columnspacing=0.8,
        fontsize=8.0 if len(names) <= 8 else 6.5,
        ncols=1 if len(names) <= 8 else 2,
    )


_DIRECTIONS = (("flight", "#8a8a8a"), ("look", "#111111"))
_TITLES = {(_T, _R): "from the right", (_N, _R): "from ahead", (_T, _N): "from above"}
_VIEWER = {(_T, _R): -1.0, (_N, _R): 1.0, (_T, _N): 1.0}
"""Side of the third axis on which the viewer is; its sign makes the view right-handed."""


def half_extents(assessment: Assessment) -> Array:
    """Half the size of the box around all orbits, along R, T and N, with room for names."""
    reach = np.abs(assessment.flown.orbits).max(axis=(0, 1))
    largest = float(reach.max())
    if largest == 0.0:
        return np.ones(3)
    return np.asarray(1.13 * np.maximum(reach, _LEAST * largest), dtype=np.float64)


def _axis_unit(half: Array) -> str:
    """Unit of the axes of a figure with these half extents [m]."""
    return "km" if float(half.max()) > _IN_KILOMETERS else "m"


def _in_unit(unit: str) -> FuncFormatter:
    """Ticks in that unit of positions in meters."""
    scale = 1e-3 if unit == "km" else 1.0
    return FuncFormatter(lambda value, _: f"{scale * value:g}".replace("-", "−"))


def open_side(assessment: Assessment) -> float:
    """Side along N, +1 or −1, from which the orbits are not seen edge on."""
    tilt = float(np.sum(assessment.flown.orbits[..., _R] * assessment.flown.orbits[..., _N]))
    return 1.0 if tilt < 0.0 else -1.0


def orbit_dashes(assessment: Assessment) -> list[Any]:
    """Line style of each orbit: dashed on top of another that it would hide."""
    size = assessment.flown.orbits.max(axis=0)
    tolerance = 0.015 * max(float(size.max()), 1e-9)  # the eye cannot separate these
    alike = np.abs(size[:, None] - size[None, :]).max(axis=-1) < tolerance
    styles: list[Any] = []
    for index, same in enumerate(alike):
        turn, count = int(same[:index].sum()), int(same.sum())
        styles.append("-" if turn == 0 else (4.0 * turn, (4.0, 4.0 * (count - 1))))
    return styles


def _paint_view(
    figure: Figure,
    axes: Axes,
    view: _View,
    assessment: Assessment,
    baselines: Sequence[tuple[int, int]],
    half: Array,
    line_of_sight: Array,
) -> None:
    plane = [view.horizontal, view.vertical]
    start = assessment.flown.states[:, plane]
    for first, second in baselines:
        axes.plot(*start[[first, second]].T, color="#bbbbbb", linewidth=0.7, zorder=1)
    for index, style in enumerate(orbit_dashes(assessment)):
        track = assessment.flown.orbits[:, index, plane].T
        axes.plot(*track, color=color(index), linestyle=style, linewidth=1.0, zorder=2)
        axes.plot(
            *start[index],
            color=color(index),
            marker=marker(index),
            markersize=6.0,
            markeredgecolor="white",
            markeredgewidth=0.6,
            zorder=3,
        )
    axes.set_xlim(-half[view.horizontal], half[view.horizontal])
    axes.set_ylim(-half[view.vertical], half[view.vertical])
    unit = _axis_unit(half)
    axes.set_xlabel(f"{_AXIS_NAMES[view.horizontal]} [{unit}]", labelpad=2)
    axes.set_ylabel(f"{_AXIS_NAMES[view.vertical]} [{unit}]", labelpad=1)
    for axis, length in ((axes.xaxis, view.width), (axes.yaxis, view.height)):
        axis.set_major_formatter(_in_unit(unit))
        axis.set_major_locator(MaxNLocator(max(3, int(length / 0.45)), steps=[1, 2, 4, 5, 10]))
    _paint_directions(figure, view, line_of_sight)


def _paint_directions(figure: Figure, view: _View, line_of_sight: Array) -> None:
    """Flight and look direction above the panel, where no orbit is hidden."""
    plane = [view.horizontal, view.vertical]
    depth = 3 - sum(plane)
    towards_viewer = _VIEWER[view.horizontal, view.vertical]
    vectors = (np.eye(3)[_T], line_of_sight)
    for index, (vector, (_, shade)) in enumerate(zip(vectors, _DIRECTIONS, strict=True)):
        center = np.array(
            [view.left + view.width - 0.4 + 0.3 * index, view.bottom + view.height + 0.11]
        )
        projected = float(np.linalg.norm(vector[plane]))
        if projected > 0.1:
            _paint_arrow(figure, center, 0.17 * vector[plane] / projected, shade)
        else:
            _paint_along_view(
                figure, center, shade, out_of_page=vector[depth] * towards_viewer > 0.0
            )


def _paint_arrow(figure: Figure, center: Array, step: Array, shade: str) -> None:
    arrow = FancyArrowPatch(
        tuple(center - 0.5 * step),
        tuple(center + 0.5 * step),
        transform=figure.dpi_scale_trans,
        arrowstyle="-|>",
        mutation_scale=7,
        linewidth=1.1,
        color=shade,
        shrinkA=0,
        shrinkB=0,
    )
    figure.add_artist(arrow)


def _paint_along_view(figure: Figure, center: Array, shade: str, *, out_of_page: bool) -> None:
    """A circle with a dot for an arrow out of the page, with a cross for one into it."""
    trans, at = figure.dpi_scale_trans, (float(center[0]), float(center[1]))
    figure.add_artist(Circle(at, 0.05, transform=trans, fill=False, color=shade, linewidth=1.0))
    if out_of_page:
        figure.add_artist(Circle(at, 0.016, transform=trans, color=shade, linewidth=0))
    else:
        figure.text(*at, "×", transform=trans, fontsize=8, color=shade, ha="center", va="center")


def _paint_space(
    figure: Figure,
    cell: tuple[float, float, float, float],
    half: Array,
    assessment: Assessment,
    baselines: Sequence[tuple[int, int]],
) -> None:
    left, bottom, width, tall = cell
    height = figure.get_figheight()
    axes: Any = figure.add_axes(
        (left / WIDTH, bottom / height, width / WIDTH, tall / height), projection="3d"
    )
    axes.patch.set_visible(False)
    order = [_T, _N, _R]
    start = assessment.flown.states[:, order]
    for first, second in baselines:
        axes.plot(*start[[first, second]].T, color="#bbbbbb", linewidth=0.7)
    for index, style in enumerate(orbit_dashes(assessment)):
        axes.plot(
            *assessment.flown.orbits[:, index, order].T,
            color=color(index),
            linestyle=style,
            linewidth=1.0,
        )
        axes.plot(
            *start[index][:, None],
            color=color(index),
            marker=marker(index),
            markersize=5.5,
            markeredgecolor="white",
            markeredgewidth=0.5,
        )
    axes.set_box_aspect(half[order], zoom=0.98)
    axes.view_init(elev=24, azim=56 * open_side(assessment))
    unit = _axis_unit(half)
    for letter, index in zip("xyz", order, strict=True):
        getattr(axes, f"set_{letter}lim")(-half[index], half[index])
        axis = getattr(axes, f"{letter}axis")
        axis.set_rotate_label(letter != "z")
        axis.set_label_text(f"{'TNR'['xyz'.index(letter)]} [{unit}]", rotation=90)
        axis.labelpad = -6
        axis.set_major_locator(MaxNLocator(3, steps=[1, 2, 4, 5, 10]))
        axis.set_major_formatter(_in_unit(unit))
        axis.set_tick_params(pad=-3, labelsize=7)
        axis.pane.set_facecolor("white")
        axis.pane.set_edgecolor("#cccccc")
