"""The look of every figure, and the one way to draw it."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from ..reading import Shown
from ..wording import plain

WIDTH = 6.7
"""Width of a figure: the text width of an A4 page [inch]."""

INK = "#222222"
MUTED = "#6b6b6b"
GRID = "#dddddd"
BROKEN = "#b3261e"

# Okabe and Ito: told apart by the color-blind. Their yellow is too pale for lines on white.
_OKABE_ITO = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
    "#000000",
    "#7A7A7A",
)
_MARKERS = "osDPXv<^"
"""The first five as in the interactive figures, whose marks in space are few."""

_RC: Any = {
    "font.family": ["STIXGeneral", "DejaVu Sans"],
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "axes.grid": True,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
    "text.parse_math": False,  # names are data; no $ is mathematics
    "svg.fonttype": "path",
    "svg.hashsalt": "formation-opt",  # the same figure has the same bytes
    "axes.unicode_minus": True,
    "axes.formatter.useoffset": False,  # each label is the number itself
}


def color(index: int) -> str:
    """Color of a satellite or series."""
    return _OKABE_ITO[index % len(_OKABE_ITO)]


def marker(index: int) -> str:
    """Marker of a satellite or series, distinct also in gray."""
    return _MARKERS[mark_index(index)]


def mark_index(index: int) -> int:
    """Which of eight marks a satellite has: when the colors start over, each gets another one."""
    return (index + index // len(_OKABE_ITO)) % 8


def series_marker(index: int, points: int) -> str:
    """Marker of a series; none where the points are too many to mark."""
    return marker(index) if points <= 40 else ""


def draw(
    paint: Callable[[Figure], None],
    *,
    height: float,
    width: float = WIDTH,
    layout: str | None = "constrained",
) -> bytes:
    """Draw a figure as SVG, leaving matplotlib's settings as they were.

    Parameters
    ----------
    paint : puts the content on the figure.
    height, width : of the figure [inch].
    layout : layout engine of matplotlib; None where `paint` places the axes itself.
    """
    buffer = io.BytesIO()
    with mpl.rc_context(_RC), warnings.catch_warnings():
        # A name in a script without glyphs here is drawn as boxes; the tables still have it.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure = Figure(figsize=(width, height), layout=layout)  # type: ignore[arg-type]
        paint(figure)
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


def name_series(
    axes_or_figure: Any, handles: Sequence[Any], names: Sequence[str], **place: Any
) -> None:
    """Legend whose names are data: a leading ``_`` does not hide one."""
    legend = axes_or_figure.legend(handles, [f"series {i}" for i in range(len(names))], **place)
    for text, name in zip(legend.get_texts(), names, strict=True):
        text.set_text(name)


def shortened(name: str, length: int = 28) -> str:
    """Name that fits beside a mark; its end, where names differ, is kept."""
    if len(name) <= length:
        return name
    tail = length // 3
    return f"{name[: length - tail - 1]}…{name[-tail:]}"


def name_formations(
    figure: Figure, formations: Sequence[Shown], *, extra: Sequence[Line2D] = ()
) -> None:
    """Legend of the formations below the panels, with further entries that name themselves."""
    handles = [Line2D([], [], color=color(f.style), marker=marker(f.style)) for f in formations]
    names = [*_legend_names(formations), *(str(entry.get_label()) for entry in extra)]
    columns = min(_legend_columns(names), len(names))
    name_series(figure, [*handles, *extra], names, loc="outside lower center", ncols=columns)


def legend_rows(formations: Sequence[Shown], *, extra: int = 0) -> int:
    """Rows of `name_formations`, for the height of the figure."""
    return -(-(len(formations) + extra) // _legend_columns(_legend_names(formations)))


def _legend_names(formations: Sequence[Shown]) -> list[str]:
    return [shortened(formation.name, 50) for formation in formations]


def _legend_columns(names: Sequence[str]) -> int:
    return max(1, min(4, 120 // (8 + max(map(len, names)))))


def error_axis(axes: Axes, values: Sequence[NDArray[np.float64]], *, spread: float = 8.0) -> None:
    """Scale a vertical axis of errors so that the largest and the smallest can both be read.

    A logarithmic axis where they differ more than `spread` times; otherwise a linear one that is
    never so narrow that rounding looks like a trend.
    """
    finite = np.concatenate([np.ravel(v)[np.isfinite(np.ravel(v))] for v in values])
    positive = finite[finite > 0.0]
    if positive.size == 0:
        return
    low, high = float(positive.min()), float(positive.max())
    if high > spread * low:
        axes.set_yscale("log")
        axes.set_ylim(low / 1.5, high * 1.5)
        plain_log_ticks(axes.yaxis, decades=np.log10(high / low))
        return
    pad = max(0.12 * (high - low), 0.04 * high)
    axes.set_ylim(max(low - pad, 0.0), high + pad)


def plain_log_ticks(axis: Any, *, decades: float) -> None:
    """Label a logarithmic axis with plain numbers."""
    subs = (1.0, 2.0, 5.0) if decades < 2.5 else (1.0,)
    axis.set_major_locator(LogLocator(subs=subs))
    axis.set_minor_formatter(NullFormatter())
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
