"""Whether the phase can be unwrapped: over the scene, and rung by rung."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from insar import Scene
from optimize import Unwrapping

from ..reading import Shown
from ..wording import probability
from .height_error import mark_abscissa, scene_axis, series_line
from .style import (
    BROKEN,
    INK,
    color,
    draw,
    legend_rows,
    name_formations,
    plain_log_ticks,
    shortened,
)

Array = NDArray[np.float64]

_DASHED = (0, (5, 3))

_SMALLEST_FAILURE = 1e-16
"""A probability within rounding of one is drawn here."""


def unwrapping_figure(
    formations: Sequence[Shown],
    scene: Scene,
    *,
    required: float | None,
    ladder: Unwrapping,
    pairs: Sequence[str],
) -> bytes:
    """Probability of a wrong cycle in each segment, and the ladder of one formation.

    Parameters
    ----------
    formations : those that have an unwrapping ladder.
    scene : the segments.
    required : the smallest probability of success allowed; None for none.
    ladder : the ladder that is drawn.
    pairs : names of its rungs.
    """

    def paint(figure: Figure) -> None:
        left, right = figure.subplots(1, 2)
        failures = [
            (f.style, np.maximum(1.0 - f.assessment.unwrapping.probability, _SMALLEST_FAILURE))
            for f in formations
            if f.assessment.unwrapping is not None
        ]
        _paint_failure(left, failures, scene, required)
        _paint_ladder(right, ladder, pairs)
        limit = Line2D(
            [], [], color=BROKEN, linewidth=0.9, linestyle=_DASHED, label="largest allowed"
        )
        name_formations(figure, formations, extra=[] if required is None else [limit])

    height = max(2.25, 1.1 + 0.24 * len(pairs))
    return draw(paint, height=height + 0.18 * legend_rows(formations, extra=required is not None))


def _paint_failure(
    axes: Axes, failures: Sequence[tuple[int, Array]], scene: Scene, required: float | None
) -> None:
    abscissa, label = scene_axis(scene)
    for style, failure in failures:
        axes.plot(abscissa, failure, color=color(style), **series_line(style, scene))
    values = np.concatenate([failure for _, failure in failures])
    if required is not None:
        values = np.append(values, 1.0 - required)
        axes.axhline(1.0 - required, color=BROKEN, linewidth=0.9, linestyle=_DASHED, zorder=3)
    low, high = float(values.min()) / 3.0, min(3.0 * float(values.max()), 1.3)
    high = max(high, 10.0 * low)
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    plain_log_ticks(axes.yaxis, decades=float(np.log10(high / low)))
    mark_abscissa(axes, abscissa, label)
    axes.set_ylabel("probability of a wrong cycle")
    axes.set_title("(a) over the scene", loc="left")


def _paint_ladder(axes: Axes, ladder: Unwrapping, pairs: Sequence[str]) -> None:
    for row, rung in enumerate(ladder.rungs):
        axes.barh(row, rung.phase_std, height=0.5, color=color(5))
        axes.annotate(
            probability(rung.probability),
            (rung.phase_std, row),
            xytext=(3, 0),
            textcoords="offset points",
            va="center_baseline",
            fontsize=8.0,
            # The dashed line may pass where a label is.
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
            zorder=4,
        )
    largest = max(rung.phase_std for rung in ladder.rungs)
    axes.axvline(np.pi, color=INK, linewidth=0.8, linestyle=_DASHED)
    axes.set_xlim(0.0, max(1.25 * largest, 1.15 * np.pi))
    axes.set_ylim(len(pairs) - 0.4, -0.6)
    axes.set_yticks(range(len(pairs)), [shortened(name) for name in pairs])
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("deviation of the phase [rad]; half a cycle dashed")
    axes.set_title("(b) the ladder in the worst segment", loc="left")
