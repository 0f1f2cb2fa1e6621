"""The ground of a map: land, graticule, scale, and a globe that shows where it lies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, PathPatch
from numpy.typing import NDArray

from ..wording import latitude_text, longitude_text, plain
from .projection import EARTH_RADIUS_KM, Azimuthal, filled_path, land_outline
from .style import BROKEN, INK, MUTED

Array = NDArray[np.float64]

_SEA, _LAND, _COAST, _GRATICULE = "#eef4f8", "#ebe6d8", "#8c8676", "#c3ccd2"

_KM_PER_DEGREE = np.radians(1.0) * EARTH_RADIUS_KM

_LABEL = 7.0
"""Size of the names of meridians and parallels [pt]."""

_STEPS = np.array([0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0])
"""Spacings of a graticule [°]."""

_LENGTHS = np.array([1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0])
"""Lengths of a scale bar [km]."""


def paint_ground(axes: Axes, projection: Azimuthal, window: float) -> None:
    """Prepare axes as a square map, equal in scale, with land and graticule.

    Parameters
    ----------
    axes : to paint on.
    projection : of the map, about its middle.
    window : half the width of the map [km].
    """
    axes.set_facecolor(_SEA)
    axes.grid(visible=False)
    axes.set_aspect("equal")
    axes.set_xlim(-window, window)
    axes.set_ylim(-window, window)
    _paint_land(axes, projection, reach=1.5 * window / EARTH_RADIUS_KM, width=0.5)
    _paint_graticule(axes, projection, window)


def _paint_land(
    axes: Axes, projection: Azimuthal, *, reach: float, width: float, every: int = 1
) -> None:
    outline = land_outline()
    for rings, shade in ((outline.land, _LAND), (outline.water, _SEA)):
        thin = tuple(_thinned(ring, every) for ring in rings)
        path = filled_path(thin, projection, reach=reach)
        axes.add_patch(PathPatch(path, fc=shade, ec=_COAST, lw=width, zorder=0.5))


def _thinned(ring: Array, every: int) -> Array:
    """Every so many-th corner of a ring that is long enough to keep its shape, still closed."""
    if every == 1 or len(ring) < 8 * every:
        return ring
    return np.concatenate([ring[:-1:every], ring[-1:]])


def _paint_graticule(axes: Axes, projection: Azimuthal, window: float) -> None:
    """Meridians and parallels, named where they meet the lower and the left edge."""
    center = np.degrees([projection.longitude, projection.latitude])
    half = 1.5 * window / _KM_PER_DEGREE
    around = min(half / max(np.cos(projection.latitude), 1e-3), 180.0)
    south, north = max(center[1] - half, -90.0), min(center[1] + half, 90.0)
    along = np.linspace(0.0, 1.0, 181)
    step = _step(window / _KM_PER_DEGREE / max(np.cos(projection.latitude), 1e-3))
    meridians = _multiples(center[0] - around, center[0] + around, step)
    if around == 180.0:
        meridians = meridians[meridians > center[0] - 180.0]  # each of them once
    lines = [_line(projection, lon, south + along * (north - south)) for lon in meridians]
    _name_crossings(axes, lines, meridians, window, step, axis=1)
    step = _step(window / _KM_PER_DEGREE)
    parallels = _multiples(south, north, step)
    lines = [_line(projection, center[0] + around * (2.0 * along - 1.0), lat) for lat in parallels]
    _name_crossings(axes, lines, parallels, window, step, axis=0)


def _step(half_width: float) -> float:
    """Spacing that gives a map some four lines [°]."""
    return float(_STEPS[np.argmin(np.abs(np.log(_STEPS / (0.5 * half_width))))])


def _multiples(low: float, high: float, step: float) -> Array:
    return step * np.arange(np.ceil(low / step), np.floor(high / step) + 1.0)


def _line(projection: Azimuthal, longitude: float | Array, latitude: float | Array) -> Array:
    return projection(*np.broadcast_arrays(np.radians(longitude), np.radians(latitude)))


def _name_crossings(
    axes: Axes, lines: list[Array], degrees: Array, window: float, step: float, *, axis: int
) -> None:
    """Draw lines and tick the edge where coordinate `axis` is least."""
    decimals = max(0, int(np.ceil(-np.log10(step))))
    word = longitude_text if axis == 1 else latitude_text
    ticks: list[float] = []
    names: list[str] = []
    for line, value in zip(lines, degrees, strict=True):
        axes.plot(*line.T, color=_GRATICULE, linewidth=0.5, zorder=0.6)
        beyond = line[:, axis] + window
        crossing = np.flatnonzero(beyond[:-1] * beyond[1:] < 0.0)
        for index in crossing[:1]:
            part = beyond[index] / (beyond[index] - beyond[index + 1])
            ticks.append(float(np.interp(part, [0, 1], line[index : index + 2, 1 - axis])))
            names.append(word(float(value), decimals))
    edge = axes.xaxis if axis == 1 else axes.yaxis
    kept = _apart(axes, ticks, names, window, axis=axis)
    edge.set_ticks([ticks[index] for index in kept], [names[index] for index in kept])
    edge.set_tick_params(labelsize=_LABEL, length=2.0)


def _apart(
    axes: Axes, ticks: Sequence[float], names: Sequence[str], window: float, *, axis: int
) -> list[int]:
    """Ticks within the map whose names do not touch, those nearest to the middle first."""
    point = 2.0 * window / (72.0 * axes.bbox.width / axes.figure.dpi)
    kept: list[int] = []
    for index in sorted(range(len(ticks)), key=lambda one: abs(ticks[one])):
        letters = len(names[index]) if axis == 1 else 2
        room = point * _LABEL * (0.6 * letters + 0.6)
        if abs(ticks[index]) < window and all(
            abs(ticks[index] - ticks[other]) > room for other in kept
        ):
            kept.append(index)
    return sorted(kept)


def paint_scale(axes: Axes, window: float) -> None:
    """Scale bar in the lower right corner."""
    length = float(np.max(_LENGTHS, initial=1.0, where=0.55 * window > _LENGTHS))
    right, low = 0.94 * window, -0.93 * window
    axes.plot([right - length, right], [low, low], color=INK, linewidth=1.6, zorder=6)
    box = {"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.8}
    axes.annotate(
        f"{plain(length)}\u00a0km",
        (right - 0.5 * length, low),
        xytext=(0, 3),
        textcoords="offset points",
        ha="center",
        fontsize=7.0,
        bbox=box,
        zorder=6,
    )


def paint_globe(axes: Axes, projection: Azimuthal) -> None:
    """The whole Earth as seen from above the middle of the map, which is marked.

    Parameters
    ----------
    axes : to paint on.
    projection : of the map.
    """
    globe = projection._replace(globe=True)
    axes.set_aspect("equal")
    axes.set_axis_off()
    rim = Circle((0.0, 0.0), globe.rim, fc=_SEA, ec=MUTED, lw=0.6, zorder=0.3)
    axes.add_patch(rim)
    # At this size corners that are a degree apart look the same, and weigh a tenth.
    _paint_land(axes, globe, reach=np.pi / 2, width=0.15, every=6)
    for lat in np.radians(np.arange(-60.0, 61.0, 30.0)):
        _paint_visible(axes, globe, np.radians(np.arange(-180.0, 181.0, 2.0)), lat)
    for lon in np.radians(np.arange(-180.0, 180.0, 30.0)):
        _paint_visible(axes, globe, lon, np.radians(np.arange(-90.0, 91.0, 2.0)))
    axes.plot(0.0, 0.0, "s", color=BROKEN, markersize=3.6, zorder=5)
    axes.set_xlim(-1.03 * globe.rim, 1.03 * globe.rim)
    axes.set_ylim(-1.03 * globe.rim, 1.03 * globe.rim)


def _paint_visible(
    axes: Axes, globe: Azimuthal, longitude: float | Array, latitude: float | Array
) -> None:
    longitude, latitude = np.broadcast_arrays(longitude, latitude)
    distance, azimuth = globe.polar(longitude, latitude)
    points = globe.plane(distance, azimuth)
    points[distance > np.pi / 2] = np.nan
    axes.plot(*points.T, color=_GRATICULE, linewidth=0.35, zorder=0.6)
