"""The footprints of a film, moving: a plotly figure in plain JSON."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from insar.observe.agile.video_results import VideoResult

from ..reading_agile import Passage
from ..wording import fixed
from .footprints import COMMON, Plane, closed, plane_of, projection_of, shown
from .style import BROKEN, GRID, INK, color

Array = NDArray[np.float64]

_SECONDS = 10.0
"""Length of the moving figure."""


def moving_footprints(result: VideoResult, passage: Passage) -> dict[str, Any]:
    """The film as a plotly figure with frames: the satellite's way, and the footprint.

    Parameters
    ----------
    result : whose footprints move.
    passage : the flight past the aim point.
    """
    plane, projection = plane_of(result), projection_of(result)
    track = projection(passage.track_longitude, passage.track_latitude)
    during = passage.imaging
    here = np.stack(
        [np.interp(plane.times, passage.times[during], track[during, axis]) for axis in range(2)],
        axis=-1,
    )
    angles = {
        name: np.interp(plane.times, result.times, np.rad2deg(getattr(result.profile, name)))
        for name in ("roll", "pitch", "yaw")
    }
    labels = [
        f"{fixed(float(time), 1)} s · "
        + " · ".join(
            f"{name} {fixed(float(values[index]), 2)}{'°' if np.isfinite(values[index]) else ''}"
            for name, values in angles.items()
        )
        for index, time in enumerate(plane.times)
    ]
    steady = [
        _line(track[during], {"color": color(5), "width": 2}, "xy"),
        _line(
            closed(plane.common) if len(plane.common) else np.empty((0, 2)),
            {"color": COMMON, "width": 1},
            "x2y2",
        )
        | {"fill": "toself", "fillcolor": "rgba(230,159,0,0.25)"},
        *(
            _line(closed(plane.outlines[index]), {"color": GRID, "width": 1.5}, "x2y2")
            for index in shown(plane)
        ),
    ]
    moving = [_moving(plane, here, index) for index in range(len(plane.times))]
    middle = shown(plane)[1]
    numbers = [len(steady), len(steady) + 1]
    reach = 1.15 * float(np.abs(track[during]).max())
    return {
        "data": [*steady, *moving[middle]],
        "frames": [
            {
                "name": str(index),
                "data": traces,
                "traces": numbers,
            }
            for index, traces in enumerate(moving)
        ],
        "layout": _layout(reach, plane.window, labels, middle),
    }


def _moving(plane: Plane, here: Array, index: int) -> list[dict[str, Any]]:
    """What one frame shows: the line of sight, and the footprint."""
    sight = np.stack([here[index], np.zeros(2)])
    return [
        _line(sight, {"color": color(1), "width": 1.5}, "xy")
        | {"mode": "lines+markers", "marker": {"color": [color(1), BROKEN], "size": [9, 7]}},
        _line(closed(plane.outlines[index]), {"color": color(1), "width": 3}, "x2y2"),
    ]


def _line(points: Array, line: dict[str, Any], axes: str) -> dict[str, Any]:
    second = axes == "x2y2"
    return {
        "type": "scatter",
        "mode": "lines",
        "x": _numbers(points[:, 0]),
        "y": _numbers(points[:, 1]),
        "line": line,
        "xaxis": "x2" if second else "x",
        "yaxis": "y2" if second else "y",
        "hovertemplate": "east %{x:.2f} km<br>north %{y:.2f} km<extra></extra>",
        "showlegend": False,
    }


def _numbers(values: Array) -> list[float | None]:
    return [round(value, 4) if math.isfinite(value) else None for value in values.tolist()]


def _layout(reach: float, window: float, labels: list[str], middle: int) -> dict[str, Any]:
    pause = 1000.0 * _SECONDS / len(labels)
    step = {"frame": {"duration": pause, "redraw": False}, "transition": {"duration": 0}}
    at_once = {"mode": "immediate", "frame": {"duration": 0, "redraw": False}}
    at_once["transition"] = {"duration": 0}
    axis = {
        "zeroline": False,
        "gridcolor": GRID,
        "linecolor": INK,
        "mirror": True,
        "ticks": "inside",
    }
    east, north = "east of the aim point [km]", "north [km]"
    buttons = [
        {"label": "▶ play", "method": "animate", "args": [None, step | {"fromcurrent": True}]},
        {"label": "❚❚ pause", "method": "animate", "args": [[None], at_once]},
    ]
    return {
        "height": 560,
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "margin": {"l": 60, "r": 20, "t": 40, "b": 20},
        "xaxis": axis | {"domain": [0.0, 0.45], "range": [-reach, reach], "title": {"text": east}},
        "yaxis": axis
        | {"range": [-reach, reach], "scaleanchor": "x", "title": {"text": north}, "anchor": "x"},
        "xaxis2": axis
        | {"domain": [0.55, 1.0], "range": [-window, window], "title": {"text": east}},
        "yaxis2": axis | {"range": [-window, window], "scaleanchor": "x2", "anchor": "x2"},
        "updatemenus": [
            {
                "type": "buttons",
                "direction": "right",
                "buttons": buttons,
                "x": 0.0,
                "y": -0.2,
                "xanchor": "left",
                "yanchor": "top",
                "showactive": False,
            }
        ],
        "sliders": [
            {
                "active": middle,
                "x": 0.22,
                "len": 0.78,
                "y": -0.17,
                "pad": {"t": 10, "b": 10},
                "currentvalue": {"xanchor": "center", "font": {"size": 15, "color": INK}},
                "ticklen": 0,
                "minorticklen": 0,
                "font": {"color": "rgba(0,0,0,0)"},
                "steps": [
                    {"label": label, "method": "animate", "args": [[str(index)], at_once]}
                    for index, label in enumerate(labels)
                ],
            }
        ],
    }
