"""How the search approached its best formation."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from optimize import SearchResult

from ..tables import history_frame
from ..wording import significant
from .style import MUTED, color, draw, error_axis


def convergence_figure(search: SearchResult) -> bytes:
    """Best and mean feasible error, and the feasible share, against the generation.

    Parameters
    ----------
    search : what was found, with a history in which some formation is feasible.
    """

    def paint(figure: Figure) -> None:
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1.0))
        _paint_errors(upper, search)
        history = history_frame(search)
        genetic = history[:-1] if search.refined else history
        lower.fill_between(
            genetic["generation"],
            100.0 * genetic["feasible_fraction"],
            step="mid",
            color=color(5),
            alpha=0.45,
            linewidth=0.0,
        )
        lower.set_ylabel("feasible [%]")
        lower.set_ylim(0.0, 100.0)
        lower.set_xlabel("generation")
        lower.xaxis.set_major_locator(MaxNLocator(integer=True))
        lower.set_xlim(*_generations(search))
        figure.align_ylabels()

    return draw(paint, height=3.3)


def _paint_errors(axes: Axes, search: SearchResult) -> None:
    history = history_frame(search).replace([np.inf, -np.inf], np.nan)
    is_refined = search.refined
    genetic = history[:-1] if is_refined else history
    axes.plot(
        genetic["generation"],
        genetic["mean_m"],
        color=MUTED,
        linewidth=0.8,
        marker="." if len(genetic) == 1 else "",
        label="mean of the feasible in a generation",
    )
    axes.plot(
        genetic["generation"],
        genetic["best_m"],
        color=color(0),
        drawstyle="steps-post",
        marker="o" if len(genetic) == 1 else "",
        label=f"best feasible: {significant(search.population_objective, 4)} m"
        if np.isfinite(search.population_objective)
        else "best feasible",
    )
    axes.set_ylabel("height error of the region [m]")
    error_axis(axes, [history["mean_m"].to_numpy(), history["best_m"].to_numpy()], spread=6.0)
    if is_refined:
        _paint_refinement(axes, search)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)


def _paint_refinement(axes: Axes, search: SearchResult) -> None:
    """The best after the refinement, at the right edge: it has no generations."""
    before, after = search.history[-2], search.history[-1]
    if not np.isfinite(after.best):
        return
    edge = _generations(search)[1]
    start = before.best if np.isfinite(before.best) else after.best
    axes.plot(
        [before.generation, edge],
        [start, after.best],
        color=color(1),
        linestyle=(0, (4, 2)),
        marker="D",
        markersize=5.0,
        markevery=[1],
        clip_on=False,
        zorder=4,
        label=f"after local refinement: {significant(after.best, 4)} m",
    )


def _generations(search: SearchResult) -> tuple[float, float]:
    """Ends of the horizontal axis, with room for the refinement."""
    last = search.history[-2 if search.refined else -1].generation
    return 0.0, 1.04 * last if last > 0 else 1.0
