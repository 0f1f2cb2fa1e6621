"""Why a printed figure cannot be computed, in words for its reader."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..steering import Outcome
from .results import Compensation, LawCurves, Selection

_OUTCOMES: Final = {
    Outcome.MISSES_EARTH: "the beam misses the Earth",
    Outcome.TOO_NEAR_NADIR: "the pitch that it needs exceeds the boresight's angle from nadir",
    Outcome.INCIDENCE_UNREACHED: "the incidence is not reached",
}


def why_unsolved(curves: LawCurves) -> str:
    """Why a law gives no largest value around an orbit."""
    unsolved = curves.outcome != Outcome.SOLVED
    count, total = np.count_nonzero(unsolved), unsolved.size
    if count == 0:
        return "The beam misses the Earth at an offset of the swath."
    first = Outcome(int(curves.outcome[np.argmax(unsolved)]))
    law = curves.law.value.replace("_", "-")
    return (
        f"The law {law} has no solution in {count} of {total} samples of the orbit: "
        f"{_OUTCOMES[first]}."
    )


def why_no_crossover(selection: Selection, row: int) -> str:
    """Why the two laws of a selection cross at no altitude, for the inclination of a row."""
    angle = selection.steering_angle[:, row]
    solved = np.all(np.isfinite(angle), axis=0)
    reach = f"{selection.altitudes[0] / 1e3:.0f} to {selection.altitudes[-1] / 1e3:.0f} km"
    if not np.any(solved):
        return f"No altitude from {reach} has a solution of both laws all around the orbit."
    part = "" if np.all(solved) else ", as far as both have a solution"
    one, other = angle[:, solved]
    names = [law.value.replace("_", "-") for law in selection.laws]
    if np.all(one > other):
        names.reverse()
    return f"The steering angles do not cross from {reach}{part}: {names[0]} has the smaller one."


def why_outside(eccentricity: float, found: Compensation) -> str:
    """Why the sweep of a compensation has no value at an eccentricity."""
    first, last = found.eccentricities[0], found.eccentricities[-1]
    return f"The eccentricity {eccentricity:g} lies outside the sweep, {first:g} to {last:g}."
