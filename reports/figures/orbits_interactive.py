"""Relative orbits that can be turned, as a plotly figure in plain JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from optimize import Assessment

from .orbits import open_side
from .style import color, mark_index

Array = NDArray[np.float64]

# Plotly's for marks in space; the first five are those of the other figures.
_SYMBOLS = (
    *("circle", "square", "diamond", "cross", "x"),
    *("circle-open", "square-open", "diamond-open"),
)
_AXES = (("x", "along-track T [m]", 1), ("y", "orbit normal N [m]", 2), ("z", "radial R [m]", 0))


def interactive_orbits(
    assessments: Sequence[Assessment],
    baselines: Sequence[Sequence[tuple[int, int]]],
    line_of_sight: Array,
) -> dict[str, Any]:
    """Orbits, satellites, baselines, flight and look direction; one formation at a time.

    Parameters
    ----------
    assessments : the formations to choose from, the first shown at the start.
    baselines : those that are drawn in each formation, two satellites each.
    line_of_sight : (3,) — direction of view in the middle of the scene, RTN.
    """
    reach = max(float(np.abs(one.flown.orbits).max()) for one in assessments) or 1.0
    groups = [_traces(one, ends) for one, ends in zip(assessments, baselines, strict=True)]
    arrows = [
        _arrow("flight direction", np.array([0.0, 1.0, 0.0]), reach, "#444444"),
        _arrow("look direction", line_of_sight, reach, "#b3261e"),
    ]
    for index, group in enumerate(groups):
        for trace in group:
            trace["visible"] = index == 0
    buttons = [
        {
            "label": _in_markup(one.label),
            "method": "restyle",
            "args": [
                {
                    "visible": [
                        number == index for number, group in enumerate(groups) for _ in group
                    ]
                    + [True] * len(arrows)
                }
            ],
        }
        for index, one in enumerate(assessments)
    ]
    return {
        "data": [trace for group in groups for trace in group] + arrows,
        "layout": _layout(reach, open_side(assessments[0]), buttons if len(buttons) > 1 else []),
    }


def _layout(reach: float, side: float, buttons: list[dict[str, Any]]) -> dict[str, Any]:
    scene: dict[str, Any] = {
        f"{letter}axis": {"title": {"text": title}, "range": [-1.15 * reach, 1.15 * reach]}
        for letter, title, _ in _AXES
    }
    camera = {"eye": {"x": 1.3, "y": side * 1.75, "z": 0.9}, "center": {"x": 0, "y": 0, "z": -0.15}}
    scene |= {"aspectmode": "cube", "camera": camera}
    menu = {
        "buttons": buttons,
        "type": "buttons",
        "direction": "right",
        "x": 0.0,
        "xanchor": "left",
        "y": 1.0,
        "yanchor": "bottom",
        "showactive": True,
    }
    return {
        "scene": scene,
        "height": 560,
        "margin": {"l": 10, "r": 10, "t": 50, "b": 10},
        "paper_bgcolor": "white",
        "legend": {"orientation": "h", "x": 0.0, "y": 0.0, "yanchor": "top"},
        "updatemenus": [menu] if buttons else [],
    }


def _traces(assessment: Assessment, baselines: Sequence[tuple[int, int]]) -> list[dict[str, Any]]:
    traces = []
    for index, name in enumerate(assessment.names):
        shade, shown = color(index), _in_markup(name)
        traces.append(
            _line(assessment.flown.orbits[:, index], shade, 4)
            | {"name": shown, "legendgroup": str(index), "hovertemplate": _hover(shown)}
        )
        traces.append(
            _points(assessment.flown.states[index : index + 1, :3])
            | {
                "mode": "markers+text",
                "marker": {"color": shade, "size": 7, "symbol": _SYMBOLS[mark_index(index)]},
                "text": [_in_space(name)],
                "textposition": "top center",
                "showlegend": False,
                "legendgroup": str(index),
                "hovertemplate": _hover(f"{shown} at t = 0"),
            }
        )
    if baselines:
        ends = assessment.flown.states[np.array(baselines), :3]
        gaps = np.full((len(ends), 1, 3), np.nan)
        lines = np.concatenate([ends, gaps], axis=1).reshape(-1, 3)
        traces.append(
            _line(lines, "#aaaaaa", 2) | {"name": "baselines at t = 0", "hoverinfo": "skip"}
        )
    return traces


def _arrow(name: str, direction: Array, reach: float, shade: str) -> dict[str, Any]:
    ends = np.stack([np.zeros(3), 0.8 * reach * direction])
    return _line(ends, shade, 5) | {
        "name": name,
        "mode": "lines+text",
        "text": ["", name],
        "textposition": "bottom center",
        "textfont": {"color": shade},
        "showlegend": False,
        "hoverinfo": "skip",
    }


def _line(points: Array, shade: str, width: int) -> dict[str, Any]:
    return _points(points) | {"mode": "lines", "line": {"color": shade, "width": width}}


def _points(points: Array) -> dict[str, Any]:
    axes = {
        letter: [round(v, 3) if np.isfinite(v) else None for v in points[:, index].tolist()]
        for letter, _, index in _AXES
    }
    return {"type": "scatter3d"} | axes


def _in_markup(name: str) -> str:
    """Name for legends, buttons and hovers, whose text plotly takes for HTML and a template."""
    for character in "&<>%":  # & first: it begins what the others become
        name = name.replace(character, f"&#{ord(character)};")
    return name


def _in_space(name: str) -> str:
    """Name for a mark in space: plotly knows a few tags there but no entities, so break the tags.

    A word joiner is not drawn; behind it ``<b>`` is no tag.
    """
    return name.replace("<", "<\N{WORD JOINER}")


def _hover(name: str) -> str:
    return f"{name}<br>T %{{x:.1f}} m<br>N %{{y:.1f}} m<br>R %{{z:.1f}} m<extra></extra>"
