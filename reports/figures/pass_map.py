"""Where a satellite flies past a place, and where it stands in the sky of that place."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from numpy.typing import NDArray

from ..reading_agile import Passage
from .maps import paint_globe, paint_ground, paint_scale
from .projection import EARTH_RADIUS_KM, Azimuthal
from .style import BROKEN, INK, MUTED, color, draw

Array = NDArray[np.float64]

_TRACK = color(0)
_IMAGING = color(1)
_MARKED = ("start", "zero Doppler", "end")

_APART = 0.16
"""Distance between marks, in half widths of the map, from which each is named."""

_WIDEST = 0.45 * np.pi * EARTH_RADIUS_KM
"""Largest half width of a map: not quite a hemisphere [km]."""


def pass_map(passage: Passage) -> bytes:
    """Map of the ground track with a globe beside it, and the sky of the place.

    Parameters
    ----------
    passage : the flight past the place.
    """

    def paint(figure: Figure) -> None:
        projection = Azimuthal(passage.longitude, passage.latitude)
        _paint_track(figure.add_axes((0.07, 0.075, 0.41, 0.83)), passage, projection)
        paint_globe(figure.add_axes((0.487, 0.045, 0.11, 0.217)), projection)
        _paint_sky(figure.add_axes((0.575, 0.1, 0.4, 0.74), projection="polar"), passage)

    return draw(paint, height=3.4, layout=None)


def _moments(passage: Passage) -> list[int]:
    """Start, zero Doppler and end of the imaging."""
    wanted = (passage.start, min(max(0.0, passage.start), passage.stop), passage.stop)
    return [int(np.argmin(np.abs(passage.times - moment))) for moment in wanted]


def _paint_track(axes: Axes, passage: Passage, projection: Azimuthal) -> None:
    track = projection(passage.track_longitude, passage.track_latitude)
    marks = track[_moments(passage)]
    window = min(1.3 * float(np.abs(marks).max()), _WIDEST)
    paint_ground(axes, projection, window)
    axes.plot(*track.T, color=_TRACK, linewidth=1.0)
    axes.plot(*track[passage.imaging].T, color=_IMAGING, linewidth=2.6, solid_capstyle="butt")
    for mark in marks:
        axes.plot([mark[0], 0.0], [mark[1], 0.0], color=_IMAGING, linewidth=0.7, alpha=0.8)
    _paint_flight(axes, track, passage, window)
    axes.plot(0.0, 0.0, "s", color=BROKEN, markersize=4.5, zorder=5)
    spread = float(np.hypot(*(marks[0] - marks[1])))
    _name_marks(axes, marks, all_of_them=spread > _APART * window)
    paint_scale(axes, window)
    axes.set_title("(a) the pass", loc="left")


def _paint_flight(axes: Axes, track: Array, passage: Passage, window: float) -> None:
    """An arrow ahead of the imaging, on the track."""
    last = _moments(passage)[2]
    inside = np.flatnonzero(np.all(np.abs(track) < 0.93 * window, axis=-1))
    ahead = inside[inside >= last]
    at = int(ahead[-1]) if ahead.size else last
    if at == 0:
        return
    step = track[at] - track[at - 1]
    tail = track[at] - 0.1 * window * step / max(float(np.hypot(*step)), 1e-9)
    axes.add_patch(
        FancyArrowPatch(
            (float(tail[0]), float(tail[1])),
            (float(track[at, 0]), float(track[at, 1])),
            arrowstyle="-|>",
            mutation_scale=13,
            color=_TRACK,
            shrinkA=0.0,
            shrinkB=0.0,
            zorder=4,
        )
    )


def _name_marks(axes: Axes, marks: Array, *, all_of_them: bool) -> None:
    """Names away from the place, so that none lies on a line of sight."""
    for name, mark in zip(_MARKED, marks, strict=True):
        axes.plot(*mark, "o", color=_IMAGING, markersize=3.6, zorder=5)
        if not all_of_them and name != "zero Doppler":
            continue
        outward = mark / max(float(np.hypot(*mark)), 1e-9)
        inside = mark[0] > 0.55 * axes.get_xlim()[1] or mark[0] < 0.55 * axes.get_xlim()[0]
        axes.annotate(
            name if all_of_them else "imaging",
            (float(mark[0]), float(mark[1])),
            xytext=(-7.0 * float(np.sign(outward[0])), -11.0)
            if inside
            else (7.0 * float(outward[0]), 7.0 * float(outward[1])),
            textcoords="offset points",
            ha="left" if (outward[0] > 0.0) is not inside else "right",
            va="center",
            fontsize=7.5,
            color=INK,
            bbox={"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.8},
            zorder=6,
        )


def _paint_sky(axes: Any, passage: Passage) -> None:
    """Azimuth clockwise from north, the vertical in the middle, the horizon at the rim."""
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_ylim(0.0, 90.0)
    axes.set_xticks(np.radians([0.0, 90.0, 180.0, 270.0]), ["N", "E", "S", "W"])
    axes.set_yticks([30.0, 60.0, 90.0], ["30°", "60°", "90°"], color=MUTED, fontsize=7.0)
    axes.set_rlabel_position(_free_direction(passage))
    axes.tick_params(pad=0.0)
    zenith = np.where(passage.zenith_angle > np.pi / 2, np.nan, np.degrees(passage.zenith_angle))
    axes.plot(passage.azimuth, zenith, color=_TRACK, linewidth=1.0)
    during = passage.imaging
    axes.plot(passage.azimuth[during], zenith[during], color=_IMAGING, linewidth=2.6)
    marks = _moments(passage)
    axes.plot(passage.azimuth[marks], zenith[marks], "o", color=_IMAGING, markersize=3.6)
    axes.set_title("(b) from the aim point", loc="left", x=-0.03, y=1.08)


def _free_direction(passage: Passage) -> float:
    """Direction in which the labels of the rings meet no line: opposite to the satellite [°]."""
    return float(np.degrees(passage.azimuth[_moments(passage)[1]])) + 160.0
