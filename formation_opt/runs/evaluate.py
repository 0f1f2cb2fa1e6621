"""Runs a study of kind `evaluate`: the height error of a given formation, without a search."""

from __future__ import annotations

from configs import EvaluateStudy
from configs.build import EvaluateSetup
from optimize import EvaluateResult, assess, dem_verdict, findings, refuted

from .formation_summary import formation_summary, refutation_seed, scene_cautions
from .outcome import Options, Outcome


def run(study: EvaluateStudy, setup: EvaluateSetup, options: Options) -> Outcome:
    """Assess the formation of a study.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line.
    """
    formation = assess(setup.problem, setup.states, label="formation", names=setup.names)
    seed = refutation_seed(study, options, 1)
    formation, *compare = refuted(
        setup.problem,
        [
            formation,
            *(
                assess(setup.problem, states, label=label, names=names)
                for label, names, states in setup.compare
            ),
        ],
        settings=setup.refutation,
        seed=seed,
    )
    dem = dem_verdict(setup.problem, formation.states, label=formation.label, request=setup.dem)
    cautions = scene_cautions(setup.observation)
    result = EvaluateResult(
        problem=setup.problem,
        critical_baseline=setup.critical_baseline,
        formation=formation,
        compare=tuple(compare),
        warnings=(*cautions, *findings(setup.problem, formation)),
        dem=dem,
    )
    return Outcome(
        result=result,
        summary=formation_summary((*compare, formation), cautions, dem=dem),
        evaluations=1 + len(compare),
        seed=None if setup.refutation is None else seed,
        orbit=setup.orbit,
        observation=setup.observation,
    )
