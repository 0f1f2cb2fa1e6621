"""Names along the lines of a map, none over another."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SIZE = 7.0
"""Of the letters [pt]; one is some half as wide."""

_HEIGHTS = (-0.4, 0.35, -0.05, 0.6, -0.65)
"""Where a name may stand, in half widths of the map above the middle; the first that is free."""


class _Place(NamedTuple):
    """Middle of a name and its direction, and what it covers: points along it [pt]."""

    anchor: Array
    slope: float
    covered: Array


def name_lines(axes: Axes, lines: Sequence[tuple[Array, str, str]], window: float) -> None:
    """Name lines where there is room; a line without any stays unnamed.

    Parameters
    ----------
    axes : a map, square, from −window to window.
    lines : points (N, 2), name and color of each.
    window : half the width of the map.
    """
    scale = _half_width(axes) / window
    taken: list[Array] = []
    for line, name, shade in lines:
        places = (_place(line, name, window, height, scale) for height in _HEIGHTS)
        free = [place for place in places if place is not None and _is_free(place, taken, axes)]
        if free:
            taken.append(free[0].covered)
            _write(axes, free[0], name, shade)


def _half_width(axes: Axes) -> float:
    """Half the width of the axes [pt]."""
    return 36.0 * axes.bbox.width / axes.figure.dpi


def _place(line: Array, name: str, window: float, height: float, scale: float) -> _Place | None:
    """A place for a name on a line near a height; None where the line is not."""
    inside = np.flatnonzero(np.all(np.abs(line) < 0.85 * window, axis=-1))
    if inside.size < 2:
        return None
    low = int(inside[np.argmin(np.abs(line[inside, 1] - height * window))])
    first, last = (low, low + 1) if low + 1 < len(line) else (low - 1, low)
    step = line[last] - line[first]
    slope = float(np.arctan2(step[1], step[0]))
    slope = (slope + np.pi / 2) % np.pi - np.pi / 2  # never upside down
    half = 0.26 * _SIZE * len(name)
    along = np.linspace(-half, half, 2 * len(name))[:, None]
    direction = np.array([np.cos(slope), np.sin(slope)])
    above = 0.6 * _SIZE * np.array([-np.sin(slope), np.cos(slope)])
    return _Place(line[low], slope, scale * line[low] + above + along * direction)


def _is_free(place: _Place, taken: Sequence[Array], axes: Axes) -> bool:
    """Whether a name lies within the map, and apart from those that are there."""
    if np.abs(place.covered).max() > 0.97 * _half_width(axes):
        return False
    apart = [np.hypot(*(place.covered[:, None] - other).T).min() for other in taken]
    return min(apart, default=np.inf) > 1.3 * _SIZE


def _write(axes: Axes, place: _Place, name: str, shade: str) -> None:
    sine, cosine = float(np.sin(place.slope)), float(np.cos(place.slope))
    axes.annotate(
        name,
        (float(place.anchor[0]), float(place.anchor[1])),
        rotation=float(np.degrees(place.slope)),
        rotation_mode="anchor",
        xytext=(-2.0 * sine, 2.0 * cosine),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=_SIZE,
        color=shade,
        clip_on=True,
    )
