"""Redraw the figures of the documentation: ``python docs/draw.py`` writes them to ``docs/images``.

They are computed like the tables of ``generate.py``, but not compared by a test: their look depends
on the version of matplotlib.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from configs import example_path, load_study
from configs.build import OptimizeSetup, build_optimize
from optimize import Certificate, certify, search
from optimize.projection import Projection, plane_radius, projection
from reports.figures.style import BROKEN, MUTED, color, draw, marker, plain_log_ticks

Array = NDArray[np.float64]

IMAGES = Path(__file__).parent / "images"

_CELLS = 160
"""Points of the map for each gap."""

_RANGE = (0.24, 0.6)
"""Height errors that the map tells apart [m]."""


def certificate_figure() -> bytes:
    """The best formation of `three_sat` in its plane, every formation by its gaps, the proof."""
    setup = build_optimize(load_study(example_path("three_sat")).study)
    problem, space = setup.problem, setup.space
    found = search(problem, space, settings=setup.settings, rng=np.random.default_rng(1))
    certificate = certify(problem, space, design=found.design)
    z0, rate, sign = space.decode(found.design)
    points = np.stack([z0, rate / space.mean_motion], axis=-1)
    seen = projection(
        space, problem.scene, held_constant=problem.errors.held_constant, sign=int(sign)
    )
    middle = len(problem.scene) // 2
    radius = plane_radius(space, max_radius=problem.constraints.max_radius)

    def paint(figure: Figure) -> None:
        left, center, right = figure.subplots(1, 3, width_ratios=(1.0, 1.15, 1.0))
        _plane(left, points, seen, middle, radius)
        _gaps(figure, center, setup, points, seen, middle, radius, int(sign))
        _proof(right, certificate)

    return draw(paint, height=2.9, width=9.6)


def _plane(axes: Axes, points: Array, seen: Projection, middle: int, radius: float) -> None:
    unit = seen.height[middle] / np.linalg.norm(seen.height[middle])
    axes.add_patch(Circle((0.0, 0.0), radius, fill=False, color=MUTED, linestyle=(0, (4, 2))))
    axes.plot(*(np.outer([-1.0, 1.0], unit) * radius).T, color=MUTED, linewidth=0.9)
    for index, point in enumerate(points):
        foot = (point @ unit) * unit
        axes.plot(*np.array([point, foot]).T, color=MUTED, linestyle=":", linewidth=0.9)
        axes.plot(*point, marker(index), color=color(index), label=f"S{index + 1}")
        axes.plot(*foot, ".", color=color(index), markersize=4)
    axes.annotate(
        "direction of the height", -0.8 * radius * unit, (0, -11), textcoords="offset points"
    )
    axes.set_aspect("equal")
    axes.set_xlabel("z₀ [m]")
    axes.set_ylabel("ż₀/n [m]")
    axes.set_title("(a) satellites, and what the height sees", fontsize="medium", loc="left")


def _gaps(
    figure: Figure,
    axes: Axes,
    setup: OptimizeSetup,
    points: Array,
    seen: Projection,
    middle: int,
    radius: float,
    sign: int,
) -> None:
    """Height error of formations in line, by their two gaps; gray where a cycle may be lost."""
    problem, space = setup.problem, setup.space
    a, c = seen.height[middle], seen.azimuth[middle]
    unit = a / np.linalg.norm(a)
    across = np.array([-unit[1], unit[0]])
    line = unit - (c @ unit) / (c @ across) * across  # no azimuth baseline along it
    gaps = np.linspace(0.0, radius, _CELLS)
    first, second = np.meshgrid(gaps, gaps)
    along = np.stack([np.zeros_like(first), first, first + second], axis=-1)
    along -= along.mean(axis=-1, keepdims=True)
    places = (along[..., None] * line).reshape(-1, 3, 2)
    designs = space.encode(
        places[..., 0], places[..., 1] * space.mean_motion, np.full(len(places), float(sign))
    )
    evaluation = problem.evaluate(space.states(designs))
    names = [limit.name for limit in problem.limits]
    lost = evaluation.violations[:, names.index("unwrapping probability")].reshape(first.shape)
    error = evaluation.objectives.reshape(first.shape)
    error[first + second > 2.0 * radius] = np.nan
    drawn = axes.pcolormesh(
        first, second, np.clip(error, *_RANGE), cmap="viridis_r", rasterized=True, shading="auto"
    )
    blocked = np.where((lost > 0.0) & np.isfinite(error), 1.0, np.nan)
    axes.pcolormesh(
        first, second, blocked, cmap="Greys", vmin=0, vmax=2.2, rasterized=True, shading="auto"
    )
    figure.colorbar(drawn, ax=axes, label="height error [m]", extend="max")
    best = np.diff(np.sort(points @ unit))
    for gap in (best, best[::-1]):
        axes.plot(*gap, "*", color=BROKEN, markersize=9)
    axes.text(0.65, 0.75, "cycles\nmay be lost", ha="center", transform=axes.transAxes)
    axes.set_aspect("equal")
    axes.set_xlabel("first gap [m]")
    axes.set_ylabel("second gap [m]")
    axes.set_title("(b) every formation, by its two gaps", fontsize="medium", loc="left")


def _proof(axes: Axes, certificate: Certificate) -> None:
    progress = certificate.convergence
    if progress is None:
        raise ValueError("the example has a branch and bound")
    axes.fill_between(
        progress.boxes,
        progress.lower_bound,
        certificate.objective,
        color=color(5),
        alpha=0.3,
        linewidth=0.0,
        step="post",
    )
    axes.plot(progress.boxes, progress.lower_bound, color=color(1), drawstyle="steps-post")
    axes.axhline(certificate.objective, color=MUTED, linewidth=0.9, linestyle=(0, (4, 2)))
    axes.text(
        progress.boxes[0], certificate.objective, "the formation found", va="bottom", color=MUTED
    )
    axes.text(progress.boxes[-1], progress.lower_bound[0], "no formation\nis below", ha="right")
    axes.set_ylim(None, certificate.objective * 1.08)
    axes.set_xscale("log")
    plain_log_ticks(axes.xaxis, decades=float(np.log10(progress.boxes[-1] / progress.boxes[0])))
    axes.set_xlabel("boxes looked at")
    axes.set_ylabel("height error [m]")
    axes.set_title("(c) the bound closes in", fontsize="medium", loc="left")


def main() -> None:
    """Write every figure."""
    (IMAGES / "certificate.svg").write_bytes(certificate_figure())


if __name__ == "__main__":
    main()
