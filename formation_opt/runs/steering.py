"""Runs a study of kind `steering`: what each law does, what it costs, and what the papers claim."""

from __future__ import annotations

import numpy as np

from configs import SteeringStudy
from configs.steered import SteeringSetup
from insar.observe import (
    CaseResult,
    LawCurves,
    SteeringResult,
    assess_case,
    compensate,
    judge,
    select,
)

from .outcome import Options, Outcome, Summary


def run(study: SteeringStudy, setup: SteeringSetup, options: Options) -> Outcome:
    """Assess the cases, selections and claims of a study.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line; nothing here is random.
    """
    cases = tuple(assess_case(case) for case in setup.cases)
    selections = tuple(select(request) for request in setup.selections)
    compensation = None if setup.compensation is None else compensate(setup.compensation)
    result = SteeringResult(
        cases=cases,
        selections=selections,
        compensation=compensation,
        claims=tuple(
            judge(claim, cases=cases, selections=selections, compensation=compensation)
            for claim in setup.claims
        ),
        warnings=(),
    )
    return Outcome(result=result, summary=_summary(cases))


def _summary(cases: tuple[CaseResult, ...]) -> Summary:
    """Largest angles and residual Doppler of every law in every case."""
    return Summary(
        headings=("yaw", "pitch", "roll", "Doppler at the boresight", "over the swath"),
        rows=tuple(
            (f"{case.name}: {curves.law.value.replace('_', ' ')}", _largest(curves))
            for case in cases
            for curves in case.curves
        ),
    )


def _largest(curves: LawCurves) -> tuple[str, ...]:
    angles = (f"{np.rad2deg(_peak(a)):.3g}°" for a in (curves.yaw, curves.pitch, curves.roll))
    doppler = (f"{_peak(f):.3g} Hz" for f in (curves.residual_doppler, curves.swath_doppler))
    return (*angles, *doppler)


def _peak(values: np.ndarray) -> float:
    """Largest magnitude; NaN where a law has no solution anywhere."""
    finite = np.abs(values[np.isfinite(values)])
    return float(finite.max()) if finite.size else float("nan")
