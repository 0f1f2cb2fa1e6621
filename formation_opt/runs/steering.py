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
from insar.observe import Outcome as SolutionOutcome
from insar.observe.studies.cautions import cautions

from .outcome import Options, Outcome, Summary
from .shown import hertz, largest, largest_degrees


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
        warnings=cautions(cases),
    )
    return Outcome(result=result, summary=_summary(cases))


def _summary(cases: tuple[CaseResult, ...]) -> Summary:
    """Largest angles and Doppler of every law in every case, where it has a solution."""
    return Summary(
        headings=("solved", "yaw", "pitch", "roll", "Doppler", "over swath"),
        rows=tuple(
            (f"{case.name}: {curves.law.value.replace('_', ' ')}", _largest(curves))
            for case in cases
            for curves in case.curves
        ),
    )


def _largest(curves: LawCurves) -> tuple[str, ...]:
    solved = f"{100.0 * np.mean(curves.outcome == SolutionOutcome.SOLVED):.3g} %"
    angles = (f"{largest_degrees(a)}°" for a in (curves.yaw, curves.pitch, curves.roll))
    doppler = (hertz(largest(f)) for f in (curves.residual_doppler, curves.swath_doppler))
    return (solved, *angles, *doppler)
