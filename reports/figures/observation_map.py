"""Maps of where a scene lies: the pass, its segments, and the globe for orientation."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from insar.observe import Observation

from ..wording import fixed
from .lines import name_lines
from .maps import paint_globe, paint_ground, paint_scale
from .projection import Azimuthal, center_of
from .style import BROKEN, INK, color, draw

Array = NDArray[np.float64]

_STRIP, _TRACK = color(5), color(0)

_INCIDENCE_COLORS = LinearSegmentedColormap.from_list(
    "incidence", ["#fee391", "#ec7014", "#993404", "#4d1a02"]
)
"""From light to dark, so that it also reads in gray and by the color-blind."""

_CONSTANT = 0.01
"""Range of incidences that is one value: a bar of colors would show the rounding of it [°]."""

_NARROWEST = 5.0
"""Least half width of a map [km]: the outline of the land shows nothing finer."""


def observation_map(observation: Observation) -> bytes:
    """Map of the pass with a globe beside it, and map of the segments.

    Parameters
    ----------
    observation : the pass and what it sees.
    """

    def paint(figure: Figure) -> None:
        targets = _targets(observation)
        projection = Azimuthal(*center_of(*targets.T))
        spread = _spread(projection(*targets.T))
        _paint_pass(figure.add_axes((0.07, 0.075, 0.41, 0.79)), observation, projection, spread)
        _paint_segments(
            figure.add_axes((0.575, 0.075, 0.41, 0.79)), observation, projection, spread
        )
        paint_globe(figure.add_axes((0.395, 0.765, 0.118, 0.22)), projection)

    return draw(paint, height=3.48, layout=None)


def _targets(observation: Observation) -> Array:
    """All targets, seen and missed, and the corners of the area: (K, 2) of lon, lat [rad]."""
    seen = np.stack([observation.longitude, observation.latitude], axis=-1)
    missed = np.stack([observation.missed_longitude, observation.missed_latitude], axis=-1)
    return np.concatenate([seen, missed, *observation.outlines])


def _spread(points: Array) -> float:
    """Half width of a map that shows all points [km]."""
    return max(1.12 * float(np.abs(points).max()), _NARROWEST)


def _paint_pass(axes: Axes, observation: Observation, projection: Azimuthal, spread: float) -> None:
    track = projection(observation.track_longitude, observation.track_latitude)
    near = projection(observation.near_longitude, observation.near_latitude)
    far = projection(observation.far_longitude, observation.far_latitude)
    # The map reaches to the track and across the strip where they pass the targets.
    closest = max(float(np.hypot(*line.T).min()) for line in (track, near, far))
    window = max(1.25 * closest, 1.6 * spread)
    paint_ground(axes, projection, window)
    axes.add_patch(Polygon(np.concatenate([near, far[::-1]]), fc=_STRIP, alpha=0.3, lw=0.0))
    for edge in (near, far):
        axes.plot(*edge.T, color=_STRIP, linewidth=0.8)
    axes.plot(*track.T, color=_TRACK)
    _paint_flight(axes, track, window)
    axes.add_patch(
        Rectangle((-spread, -spread), 2 * spread, 2 * spread, fill=False, ec=BROKEN, lw=0.9)
    )
    name_lines(
        axes,
        (
            (track, "ground track", _TRACK),
            (near, f"near edge, {np.degrees(observation.near_incidence):.0f}°", INK),
            (far, f"far edge, {np.degrees(observation.far_incidence):.0f}°", INK),
        ),
        window,
    )
    paint_scale(axes, window)
    axes.set_title("(a) the pass", loc="left")


def _paint_flight(axes: Axes, track: Array, window: float) -> None:
    """An arrow on the track, where it passes the targets."""
    index = min(int(np.argmin(np.hypot(*track.T))), len(track) - 2)
    step = track[index + 1] - track[index]
    tip = track[index] + 0.15 * window * step / max(float(np.hypot(*step)), 1e-9)
    arrow = FancyArrowPatch(
        (float(track[index, 0]), float(track[index, 1])),
        (float(tip[0]), float(tip[1])),
        arrowstyle="-|>",
        mutation_scale=13,
        color=_TRACK,
        shrinkA=0.0,
        shrinkB=0.0,
        zorder=4,
    )
    axes.add_patch(arrow)


def _paint_segments(
    axes: Axes, observation: Observation, projection: Azimuthal, window: float
) -> None:
    paint_ground(axes, projection, window)
    for outline in observation.outlines:
        closed = np.concatenate([outline, outline[:1]])
        axes.plot(*projection(*closed.T).T, color=INK, linewidth=0.9)
    incidence = np.degrees(observation.scene.incidence)
    constant = float(np.ptp(incidence)) < _CONSTANT
    margin = 1.0 if constant else 0.0
    places = projection(observation.longitude, observation.latitude)
    dots = axes.scatter(
        places[:, 0],
        places[:, 1],
        c=incidence,
        cmap=_INCIDENCE_COLORS,
        vmin=incidence.min() - margin,
        vmax=incidence.max() + margin,
        s=float(np.clip(2500.0 / len(incidence), 6.0, 38.0)),
        edgecolors=INK,
        linewidths=0.4,
        zorder=4,
    )
    missed = projection(observation.missed_longitude, observation.missed_latitude)
    axes.plot(*missed.T, "x", color=BROKEN, markersize=4.5, zorder=4)
    paint_scale(axes, window)
    axes.set_title("(b) the segments", loc="left", y=1.0)
    if constant:
        middle = fixed(float(incidence.mean()), 2)
        axes.set_title(f"incidence {middle}°", loc="right", fontsize=7.5, y=1.0)
    else:
        _paint_colors(axes, dots)


def _paint_colors(axes: Axes, dots: PathCollection) -> None:
    bar = axes.figure.colorbar(
        dots, cax=axes.inset_axes((0.53, 1.03, 0.47, 0.03)), orientation="horizontal"
    )
    bar.locator = MaxNLocator(3)
    bar.ax.xaxis.set_ticks_position("top")
    bar.ax.tick_params(labelsize=7.0, length=2.0, pad=1.0)
    bar.ax.set_title("incidence [°]", fontsize=7.5, pad=2.0)
