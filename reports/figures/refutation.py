"""Height errors of a simulation, and the Gaussian that the error model predicts."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from insar.simulation import SegmentRefutation

from .style import INK, MUTED, color, draw, name_series, plain_log_ticks

Array = NDArray[np.float64]

_BINS = 61
_CORE = 4.0
"""Half width of the left panel, in predicted standard deviations."""


def refutation_figure(segment: SegmentRefutation) -> bytes:
    """Histograms near zero, and over all heights that the prior leaves possible.

    Parameters
    ----------
    segment : the simulation of one segment.
    """
    predicted = segment.predicted_total
    core = predicted if np.isfinite(predicted) else segment.prior_height_std

    def paint(figure: Figure) -> None:
        near, far = figure.subplots(1, 2)
        width = min(_CORE * core, 3.0 * segment.prior_height_std)
        _paint(near, segment, np.linspace(-width, width, _BINS))
        reach = 1.05 * max(float(np.abs(segment.errors).max()), 3.0 * segment.prior_height_std)
        _paint(far, segment, np.linspace(-reach, reach, 2 * _BINS))
        # From half a sample in a bin on: less would not show.
        least = 0.5 / (len(segment.errors) * 2.0 * reach / (2 * _BINS - 1))
        most = max(_gaussian(np.zeros(1), core)[0], 100.0 * least)
        far.set_yscale("log")
        far.set_ylim(least, 2.0 * most)
        plain_log_ticks(far.yaxis, decades=float(np.log10(2.0 * most / least)))
        near.set_title("(a) near the true height", loc="left")
        far.set_title("(b) all, logarithmic: wrong cycles", loc="left")
        name_series(
            figure,
            [
                Patch(color=color(0), alpha=0.45),
                Line2D([], [], color=INK),
                Line2D([], [], color=MUTED, linestyle="--"),
            ],
            [
                "simulated, least squares",
                "predicted (right cycles)",
                "the prior height",
            ],
            loc="outside lower center",
            ncols=3,
        )

    return draw(paint, height=2.9)


def _paint(axes: Axes, segment: SegmentRefutation, edges: Array) -> None:
    counts, _ = np.histogram(segment.errors, edges)
    step = edges[1] - edges[0]
    axes.stairs(counts / (len(segment.errors) * step), edges, fill=True, color=color(0), alpha=0.45)
    heights = np.linspace(edges[0], edges[-1], 801)
    if np.isfinite(segment.predicted_total):
        axes.plot(heights, _gaussian(heights, segment.predicted_total), color=INK)
    axes.plot(heights, _gaussian(heights, segment.prior_height_std), color=MUTED, linestyle="--")
    axes.set_xlim(edges[0], edges[-1])
    axes.set_xlabel("height error [m]")
    axes.set_ylabel("density [1/m]")


def _gaussian(values: Array, std: float) -> Array:
    return np.asarray(np.exp(-0.5 * (values / std) ** 2) / (np.sqrt(2.0 * np.pi) * std))
