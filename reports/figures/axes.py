"""Axes that several figures share: around an orbit, and down to what is rounding."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, MultipleLocator, NullFormatter
from numpy.typing import NDArray

from ..wording import power_of_ten
from .style import GRID, MUTED

Array = NDArray[np.float64]

_MOST_POINTS = 721
"""Points of a line that are drawn: a vector figure shows no more."""

_AT_THE_NODE = 1e-6
"""Part of a revolution by which rounding may put a start at the node before it."""


def thinned(count: int) -> NDArray[np.int_]:
    """Indices of the samples that are drawn."""
    return np.unique(np.linspace(0, count - 1, min(count, _MOST_POINTS)).round().astype(int))


def along_orbit(argument_of_latitude: Array) -> Array:
    """Argument of latitude [rad → °] that begins in the first revolution, not at 360°."""
    degrees = np.rad2deg(argument_of_latitude)
    return np.asarray(degrees - 360.0 * np.floor(degrees.min() / 360.0 + _AT_THE_NODE))


def mark_orbit(axes: Axes, argument_of_latitude: Array, *, most: int = 6) -> None:
    """Limits and ticks of an axis of the argument of latitude [rad → °], `most` intervals."""
    degrees = along_orbit(argument_of_latitude)
    low, high = float(degrees.min()), float(degrees.max())
    axes.set_xlim(low, high)
    quarters = max(np.ceil((high - low) / 90.0 / most), 1.0)
    axes.xaxis.set_major_locator(MultipleLocator(90.0 * quarters))
    axes.locator_params(axis="y", nbins=5)


def drawn_values(axes: Axes) -> Array:
    """Finite values of all lines of an axis."""
    values = np.concatenate([np.asarray(line.get_ydata(), dtype=float) for line in axes.lines])
    return np.asarray(values[np.isfinite(values)])


def rounding_axis(axes: Axes, *, low: float, high: float, rounding: float, ticks: int) -> None:
    """Logarithmic vertical axis; what is mere rounding is shaded, where a line comes so low.

    Parameters
    ----------
    axes : with its lines.
    low, high : limits of the axis.
    rounding : value below which a result is zero.
    ticks : about how many decades are named.
    """
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    axes.yaxis.set_major_locator(LogLocator(numticks=ticks))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(value)))
    if drawn_values(axes).min(initial=np.inf) >= rounding:
        return
    axes.axhspan(0.1 * low, rounding, color=GRID, alpha=0.55, linewidth=0.0, zorder=0.4)
    axes.annotate(
        "zero, within rounding",
        (0.985, rounding),
        xycoords=("axes fraction", "data"),
        xytext=(0, -2),
        textcoords="offset points",
        ha="right",
        va="top",
        fontsize=7.0,
        color=MUTED,
    )
