"""The key figures of a formation, beneath the verdict."""

from __future__ import annotations

import math

import numpy as np

from optimize import Assessment, Problem

from ..document import Metric, Metrics, Status
from ..reading import active, broken, unmeasured_reason
from ..refutation_words import VERDICTS, bits, worst_of
from ..wording import counted, joined, meters, probability
from .refutation import STATUS


def key_figures(problem: Problem, formation: Assessment, unseen: int) -> Metrics:
    """Height error, unwrapping, simulation, closest approach and limits, side by side.

    Parameters
    ----------
    problem : scene, radar and limits.
    formation : that the report is about.
    unseen : targets that the pass does not see.
    """
    error, unwrapping = formation.height_error, formation.unwrapping
    reason = unmeasured_reason(formation)
    over = f"over {seen_segments(formation, unseen)}" if unseen else "of the scene"
    items = [
        Metric("Height error", meters(float(error.region)), reason or f"total, RMS {over}"),
    ]
    if reason is None:
        relative = meters(float(error.relative_region))
        items.append(Metric("Relative error", relative, "from pixel to pixel"))
    if unwrapping is not None and reason is None:
        required = problem.constraints.min_unwrapping_probability
        value = float(unwrapping.probability.min())
        remark = "probability"
        if required is not None:
            remark += f", at least {required:.6g}"
        items.append(Metric("Unwrapping", probability(value), remark))
    if formation.refutation is not None:
        verdict = formation.refutation.verdict
        gained = bits(worst_of(formation.refutation.segments).bits)
        items.append(
            Metric(
                "Simulation", VERDICTS[verdict], f"gains {gained} over the prior", STATUS[verdict]
            )
        )
    separations = np.empty(0) if formation.motion is None else formation.motion.separations
    separation = float(separations.min()) if separations.size else math.nan
    if math.isfinite(separation):
        items.append(Metric("Closest approach", meters(separation), "any two, at any time"))
    count, kept = len(formation.constraints), len(formation.constraints) - len(broken(formation))
    if count:
        status = Status.GOOD if kept == count else Status.BAD
        items.append(Metric("Limits kept", f"{kept} of {count}", _closest(formation), status))
    return Metrics(tuple(items))


def _closest(formation: Assessment) -> str:
    failed = broken(formation)
    if failed:
        return f"broken: {joined([report.limit.name for report in failed])}"
    at_limit = sum(active(report) for report in formation.constraints)
    return f"{at_limit} active" if at_limit else "none active"


def seen_segments(formation: Assessment, unseen: int) -> str:
    """How many of all targets a height error is of."""
    seen = formation.height_error.total.size
    return f"{seen} of {counted(seen + unseen, 'target')}"
