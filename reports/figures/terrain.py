"""Maps of a simulated terrain, and how its height errors are distributed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LightSource, LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from insar.simulation import TerrainSimulation

from .style import INK, MUTED, color, draw, name_series, plain_log_ticks

Array = NDArray[np.float64]

_LAYOVER, _SHADOW, _INCOHERENT = "#b3261e", "#222222", "#e69f00"
_LAND = LinearSegmentedColormap.from_list("land", colormaps["terrain"](np.linspace(0.25, 1.0, 256)))
"""From green to white: the blue of the seas says nothing true of low land."""

_PLACE = (0.25, 0.25)
"""Where flight and look begin, in parts of the panel: their names fit inside on every side."""

_BINS = 81


def terrain_figure(result: TerrainSimulation, names: tuple[str, ...]) -> bytes:
    """Terrain with what is not measured, interferograms, coherence.

    Parameters
    ----------
    result : of the simulation.
    names : of the pairs of images, each with the first.
    """
    view, maps = result.request.view, result.maps
    longest = int(np.argmax(np.nanmean(-maps.coherence, axis=(1, 2))))
    shortest = int(np.argmin(np.nanmean(-maps.coherence, axis=(1, 2))))

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 2)
        _paint_terrain(figure, panels[0, 0], result)
        for axes, phases, pair, title in (
            (panels[0, 1], maps.phase, shortest, "(b) interferogram"),
            (panels[1, 0], maps.residual_phase, longest, "(c) less the known heights"),
        ):
            image = _map(axes, result, phases[pair], cmap="twilight", vmin=-np.pi, vmax=np.pi)
            bar = figure.colorbar(image, ax=axes, ticks=[-np.pi, 0.0, np.pi], shrink=0.9)
            bar.ax.set_yticklabels(["−π", "0", "π"])
            bar.set_label("phase [rad]")
            axes.set_title(f"{title}, {names[pair]}", loc="left")
        axes = panels[1, 1]
        image = _map(axes, result, maps.coherence[longest], cmap="gray", vmin=0, vmax=1)
        figure.colorbar(image, ax=axes, shrink=0.9).set_label("coherence")
        axes.set_title(f"(d) coherence, {names[longest]}", loc="left")

    return draw(paint, height=_height(view.terrain.shape, rows=2))


def error_maps_figure(result: TerrainSimulation) -> bytes:
    """Height errors of the first acquisition, and what is predicted.

    Parameters
    ----------
    result : of the simulation.
    """
    maps = result.maps
    clear = maps.clear
    spread = 3.0 * float(np.sqrt(np.mean(maps.predicted_total[clear] ** 2)))
    prior = 2.5 * result.request.prior_height_std

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 2)
        shown = (
            ("(a) least squares", maps.least_squares_error, spread),
            ("(b) maximum likelihood", maps.likely_error, spread),
            ("(c) the height known beforehand", maps.prior_error, prior),
        )
        for axes, (title, values, limit) in zip(panels.ravel(), shown, strict=False):
            image = _map(axes, result, values, cmap="RdBu_r", vmin=-limit, vmax=limit)
            figure.colorbar(image, ax=axes, extend="both", shrink=0.9).set_label("error [m]")
            axes.set_title(title, loc="left")
        low, high = np.quantile(maps.predicted_total[clear], [0.02, 0.98])
        image = _map(
            axes := panels[1, 1], result, maps.predicted_total, cmap="viridis", vmin=low, vmax=high
        )
        figure.colorbar(image, ax=axes, extend="both", shrink=0.9).set_label("deviation [m]")
        axes.set_title("(d) predicted, total", loc="left")

    return draw(paint, height=_height(result.request.view.terrain.shape, rows=2))


def error_histogram_figure(result: TerrainSimulation) -> bytes:
    """Height errors over all clear points, and random errors against the slope.

    Parameters
    ----------
    result : of the simulation.
    """

    def paint(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        _paint_histogram(left, result)
        _paint_by_slope(right, result)
        left.set_title("(a) all clear points, logarithmic", loc="left")
        right.set_title("(b) random error against the slope", loc="left")
        name_series(
            figure,
            [
                Patch(color=color(0), alpha=0.45),
                Line2D([], [], color=color(1)),
                Line2D([], [], color=MUTED, linestyle="--"),
                Line2D([], [], color=INK),
            ],
            ["least squares", "maximum likelihood", "known beforehand", "predicted"],
            loc="outside lower center",
            ncols=4,
        )

    return draw(paint, height=3.0)


def _paint_histogram(axes: Axes, result: TerrainSimulation) -> None:
    maps = result.maps
    clear = maps.clear
    reach = float(
        max(
            np.quantile(np.abs(maps.least_squares_error[clear]), 0.9995),
            3.0 * result.request.prior_height_std,
        )
    )
    edges = np.linspace(-1.1 * reach, 1.1 * reach, _BINS)
    shape: dict[str, Any]
    for values, shape in (
        (maps.least_squares_error, {"fill": True, "color": color(0), "alpha": 0.45}),
        (maps.likely_error, {"color": color(1)}),
        (maps.prior_error, {"color": MUTED, "linestyle": "--"}),
    ):
        counts, _ = np.histogram(values[clear], edges)
        axes.stairs(counts / (np.count_nonzero(clear) * np.diff(edges)), edges, **shape)
    heights = np.linspace(edges[0], edges[-1], 801)
    sigma = np.quantile(maps.predicted_total[clear], np.linspace(0.005, 0.995, 100))
    density = np.exp(-0.5 * (heights[:, None] / sigma) ** 2) / (np.sqrt(2.0 * np.pi) * sigma)
    axes.plot(heights, density.mean(axis=-1), color=INK)
    least = 0.5 / (np.count_nonzero(clear) * float(edges[1] - edges[0]))
    axes.set_yscale("log")
    axes.set_ylim(least, 3.0 * float(density.max()))
    plain_log_ticks(axes.yaxis, decades=math.log10(3.0 * float(density.max()) / least))
    axes.set_xlim(edges[0], edges[-1])
    axes.set_xlabel("height error [m]")
    axes.set_ylabel("density [1/m]")


def _paint_by_slope(axes: Axes, result: TerrainSimulation) -> None:
    maps = result.maps
    clear = maps.clear
    slope = np.degrees(result.request.view.slope[clear])
    error, predicted = maps.random_error[clear], maps.predicted_relative[clear]
    edges = np.unique(np.quantile(slope, np.linspace(0.0, 1.0, 13)))
    which = np.clip(np.searchsorted(edges, slope, side="right") - 1, 0, max(len(edges) - 2, 0))
    middle, simulated, spread, expected = [], [], [], []
    for one in np.unique(which):
        inside = which == one
        squares = error[inside] ** 2
        value = math.sqrt(float(squares.mean()))
        middle.append(float(slope[inside].mean()))
        simulated.append(value)
        spread.append(3.0 * float(squares.std()) / math.sqrt(squares.size) / (2.0 * value))
        expected.append(math.sqrt(float(np.mean(predicted[inside] ** 2))))
    axes.errorbar(middle, simulated, yerr=spread, fmt="o", color=color(0), markersize=3.5)
    axes.plot(middle, expected, color=INK)
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("slope towards the radar [°]")
    axes.set_ylabel("random height error [m]")


def _paint_terrain(figure: Figure, axes: Axes, result: TerrainSimulation) -> None:
    view = result.request.view
    terrain = view.terrain
    filled = np.where(np.isfinite(terrain.heights), terrain.heights, np.nanmin(terrain.heights))
    image = _map(axes, result, terrain.heights, cmap=_LAND, alpha=0.75)
    shade = LightSource(azdeg=315, altdeg=45).hillshade(
        filled, vert_exag=3.0, dx=terrain.posting_east, dy=terrain.posting_north
    )
    axes.imshow(shade, cmap="gray", alpha=0.35, extent=_extent(result), interpolation="nearest")
    for mask, ink in (
        (view.layover, _LAYOVER),
        (view.shadow, _SHADOW),
        (view.seen & ~result.maps.clear, _INCOHERENT),
    ):
        if mask.any():
            axes.imshow(
                np.where(mask, 1.0, np.nan),
                cmap=ListedColormap([ink]),
                extent=_extent(result),
                interpolation="nearest",
            )
    figure.colorbar(image, ax=axes, shrink=0.9).set_label("height [m]")
    axes.set_title("(a) terrain", loc="left")
    heading, side = view.heading, int(view.side)
    look = heading - side * math.pi / 2
    for angle, text in ((heading, "flight"), (look, "look")):
        tip = (_PLACE[0] + 0.13 * math.sin(angle), _PLACE[1] + 0.13 * math.cos(angle))
        axes.annotate(
            "",
            xy=tip,
            xytext=_PLACE,
            xycoords="axes fraction",
            arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 1.2},
        )
        axes.text(
            *(_PLACE[0] + 0.19 * math.sin(angle), _PLACE[1] + 0.19 * math.cos(angle)),
            text,
            transform=axes.transAxes,
            ha="center",
            va="center",
            fontsize=7.5,
            bbox={"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.8},
        )


def _map(axes: Axes, result: TerrainSimulation, values: Array, **look: Any) -> Any:
    image = axes.imshow(values, extent=_extent(result), interpolation="nearest", **look)
    axes.set_xlabel("east [km]")
    axes.set_ylabel("north [km]")
    axes.grid(visible=False)
    axes.set_facecolor("#f2f2f2")
    return image


def _extent(result: TerrainSimulation) -> tuple[float, float, float, float]:
    terrain = result.request.view.terrain
    half = 0.5 * terrain.posting_east, 0.5 * terrain.posting_north
    east, north = terrain.east, terrain.north
    return (
        float(east[0] - half[0]) / 1e3,
        float(east[-1] + half[0]) / 1e3,
        float(north[-1] - half[1]) / 1e3,
        float(north[0] + half[1]) / 1e3,
    )


def _height(shape: tuple[int, int], *, rows: int) -> float:
    """Of a figure whose panels are as high as the terrain's shape wants, within reason [inch]."""
    return rows * float(np.clip(2.5 * shape[0] / shape[1] + 0.7, 1.8, 4.2))
