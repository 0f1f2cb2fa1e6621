"""Runs a study of kind `evaluate`: the height error of a given formation, without a search."""

from __future__ import annotations

from configs import EvaluateStudy
from configs.build import build_evaluate
from optimize import EvaluateResult, assess, findings

from .outcome import Options, Outcome


def run(study: EvaluateStudy, options: Options) -> Outcome:
    """Assess the formation of a study.

    Parameters
    ----------
    study : the validated study.
    options : of the command line; nothing here is random.
    """
    setup = build_evaluate(study)
    formation = assess(setup.problem, setup.states, label="formation", names=setup.names)
    compare = tuple(
        assess(setup.problem, states, label=label, names=names)
        for label, names, states in setup.compare
    )
    result = EvaluateResult(
        problem=setup.problem,
        critical_baseline=setup.critical_baseline,
        formation=formation,
        compare=compare,
        warnings=findings(setup.problem, formation),
    )
    return Outcome(
        result=result,
        orbit=setup.orbit,
        seed=None,
        evaluations=1 + len(compare),
        shown=(*compare, formation),
    )
