"""Figure of the coherence budget: what each factor takes from each pair."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from optimize import Assessment, ImagePair, Problem

from ..reading import pair_name
from .style import MUTED, color, draw, name_series, shortened

_MOST = 5.0
"""Largest loss drawn: a coherence of 0.7 %."""


def coherence_figure(
    problem: Problem, assessment: Assessment, pairs: Sequence[ImagePair], names: Mapping[str, str]
) -> bytes:
    """Stacked bars of −ln γ by factor, one for each pair, in the segment that loses most.

    Parameters
    ----------
    problem : scene, radar and errors.
    assessment : the formation.
    pairs : those to draw.
    names : of the factors, and what they are called.
    """
    series = [
        (label, [_loss(pair.factors[name]) for pair in pairs], "") for name, label in names.items()
    ]
    for label, hatch, shares in (
        ("Range band not shared", "////", [pair.common_range for pair in pairs]),
        ("Azimuth band not shared", "\\\\\\\\", [pair.common_azimuth for pair in pairs]),
    ):
        losses = [_loss(share) for share in shares]
        if max(losses) > 0.0:
            series.append((label, losses, hatch))
    rows = np.arange(len(pairs))

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        left = np.zeros(len(pairs))
        bars = []
        for number, (_, losses, hatch) in enumerate(series):
            look: dict[str, Any] = {"color": color(number)}
            if hatch:
                look = {"facecolor": "white", "edgecolor": MUTED, "hatch": hatch, "linewidth": 0.6}
            bars.append(axes.barh(rows, losses, left=left, height=0.62, **look))
            left = left + losses
        labels = [shortened(pair_name(problem, assessment, pair.images)) for pair in pairs]
        axes.set_yticks(rows, labels)
        axes.set_ylim(len(pairs) - 0.4, -0.6)  # the first pair above, no empty rows
        axes.set_xlabel("loss −ln γ, and −ln of the share of each band in common")
        axes.grid(visible=False, axis="y")
        axes.tick_params(axis="y", length=0)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        names_shown = [label for label, _, _ in series]
        name_series(
            figure,
            bars,
            names_shown,
            loc="outside lower center",
            ncols=min(4, max(1, len(bars))),
        )

    return draw(paint, height=1.2 + 0.27 * len(pairs))


def _loss(factor: NDArray[np.float64]) -> float:
    worst = float(factor.min())
    return float(min(-np.log(worst), _MOST)) if worst > 0.0 else _MOST
