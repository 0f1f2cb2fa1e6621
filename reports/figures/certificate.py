"""How the proof closes in on the best possible height error."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from optimize.certificate import Certificate

from ..wording import significant
from .style import MUTED, color, draw, plain_log_ticks


def certificate_figure(certificate: Certificate) -> bytes:
    """Lower bound and best formation met, against the boxes that were looked at.

    Parameters
    ----------
    certificate : with a branch and bound that took some steps.
    """
    progress = certificate.convergence
    if progress is None:
        raise ValueError("there is no branch and bound to draw")

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        bound = np.where(np.isfinite(progress.lower_bound), progress.lower_bound, np.nan)
        best = np.where(np.isfinite(progress.best), progress.best, np.nan)
        single = len(progress.boxes) == 1
        axes.fill_between(
            progress.boxes, bound, best, color=color(5), alpha=0.3, linewidth=0.0, step="post"
        )
        axes.plot(
            progress.boxes,
            best,
            color=color(0),
            drawstyle="steps-post",
            marker="o" if single else "",
            label="best met or known",
        )
        axes.plot(
            progress.boxes,
            bound,
            color=color(1),
            drawstyle="steps-post",
            marker="o" if single else "",
            label="lower bound: no formation is below",
        )
        if np.isfinite(certificate.objective):
            axes.axhline(
                certificate.objective,
                color=MUTED,
                linewidth=0.9,
                linestyle=(0, (4, 2)),
                label=f"the formation found: {significant(certificate.objective, 4)} m",
            )
        axes.set_xscale("log")
        decades = np.log10(progress.boxes[-1] / progress.boxes[0])
        plain_log_ticks(axes.xaxis, decades=float(decades))
        axes.set_xlabel("boxes of projected baselines looked at")
        axes.set_ylabel("height error [m]")
        if np.nanmin(bound) < 0.5 * np.nanmax(best):
            axes.set_ylim(bottom=0.0)
        else:  # close from the start: from zero, nothing of the closing in would be seen
            axes.set_ylim(
                bottom=float(np.nanmin(bound) - 0.6 * np.ptp([np.nanmin(bound), np.nanmax(best)]))
            )
        axes.legend(loc="lower right")

    return draw(paint, height=2.6)
