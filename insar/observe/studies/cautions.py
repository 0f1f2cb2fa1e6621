"""What a user must know of the cases of a steering study before relying on them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..scenes.cautions import dated_cautions
from ..scenes.windows import moment
from ..steering import Outcome
from .results import CaseResult, LawCurves

SLOW = 50.0
"""Speed over the Earth below which the direction of zero Doppler is ill-defined [m/s]."""

_REASONS = {
    Outcome.MISSES_EARTH: "the beam misses the Earth",
    Outcome.TOO_NEAR_NADIR: "the beam would have to be nearer to nadir than the pitch that is "
    "needed",
    Outcome.INCIDENCE_UNREACHED: "the incidence is not reached in the plane of the beam",
}


def cautions(cases: Sequence[CaseResult]) -> tuple[str, ...]:
    """Warnings of the cases of a study, one sentence or two each.

    Parameters
    ----------
    cases : of the study.
    """
    return tuple(text for case in cases for text in _cautions(case))


def _cautions(case: CaseResult) -> Iterator[str]:
    trajectory, times = case.case.trajectory, case.case.times
    for text in dated_cautions(
        trajectory.source,
        trajectory.epoch,
        first=moment(trajectory, float(times[0])),
        last=moment(trajectory, float(times[-1])),
        what="The time that is studied",
    ):
        yield f"{case.name}: {text[:1].lower()}{text[1:]}"
    for curves in case.curves:
        solved = float(np.mean(curves.outcome == Outcome.SOLVED))
        if solved < 1.0:
            yield (
                f"{case.name}: {curves.law.value.replace('_', ' ')} has a solution on "
                f"{100.0 * solved:.3g} % of the orbit only; elsewhere {_reason(curves)}."
            )
    speed = _least_speed(case)
    if speed < SLOW:
        yield (
            f"{case.name}: the satellite moves over the Earth at down to {speed:.2g} m/s. Below "
            f"{SLOW:g} m/s the direction of zero Doppler, and with it every angle here, depends on "
            "the last digits of the orbit."
        )


def _reason(curves: LawCurves) -> str:
    """The reason that most of the unsolved samples have."""
    unsolved = curves.outcome[curves.outcome != Outcome.SOLVED]
    return _REASONS[Outcome(int(np.bincount(unsolved).argmax()))]


def _least_speed(case: CaseResult) -> float:
    """Least speed of the satellite over the Earth, seen across the beam [m/s]."""
    across = [
        0.5 * case.case.wavelength * curves.pointing_sensitivity[np.isfinite(curves.incidence)]
        for curves in case.curves
    ]
    return min((float(np.min(speed)) for speed in across if speed.size), default=np.inf)
