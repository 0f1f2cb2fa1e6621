"""Runs a study of kind `evaluate`: the height error of a given formation, without a search."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from configs import EvaluateStudy
from configs.build import EvaluateSetup
from configs.flying import NamedStates
from configs.placing import NamedPositions
from configs.table_checks import COMBINED
from insar import Claim, judged_range
from optimize import (
    Assessment,
    EvaluateResult,
    Problem,
    assess,
    assess_acquisitions,
    assess_placed,
    dem_verdict,
    findings,
    possible,
    refuted,
)

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
    formation, acquisitions, compare = _assessments(setup)
    seed = refutation_seed(study, options, 1)
    formation, *others = refuted(
        setup.problem,
        [formation, *acquisitions, *compare],
        settings=setup.refutation,
        seed=seed,
    )
    count = len(acquisitions)
    acquisitions, compare = tuple(others[:count]), tuple(others[count:])
    dem = dem_verdict(
        setup.problem,
        formation.scene_positions,
        label=formation.label,
        request=setup.dem,
        combined=bool(acquisitions),
    )
    cautions = scene_cautions(setup.observation)
    result = EvaluateResult(
        problem=setup.problem,
        critical_baseline=setup.critical_baseline,
        formation=formation,
        acquisitions=acquisitions,
        compare=compare,
        opened=setup.opened,
        claims=_claims(setup, (formation, *acquisitions, *compare)),
        warnings=(*cautions, *findings(setup.problem, formation)),
        dem=dem,
    )
    return Outcome(
        result=result,
        summary=formation_summary((*compare, *acquisitions, formation), cautions, dem=dem),
        evaluations=1 + len(acquisitions) + len(compare),
        seed=None if setup.refutation is None else seed,
        orbit=setup.orbit,
        observation=setup.observation,
    )


def _assessments(
    setup: EvaluateSetup,
) -> tuple[Assessment, tuple[Assessment, ...], tuple[Assessment, ...]]:
    """The formation, its acquisitions, and those to compare with."""
    formation, acquisitions = _formation(setup)
    return formation, acquisitions, tuple(_assess(setup.problem, one) for one in setup.compare)


def _claims(setup: EvaluateSetup, shown: Sequence[Assessment]) -> tuple[Claim, ...]:
    """Printed figures, judged over the range that the source leaves open."""
    if not setup.claims:
        return ()
    ends = []
    for corner in setup.corners:
        formation, acquisitions, compare = _assessments(corner)
        ends.append((corner.problem, corner.dem.cell, (formation, *acquisitions, *compare)))
    judged = []
    for claim in setup.claims:
        value, *range_ = possible(claim, setup.problem, shown, cell=setup.dem.cell)
        for problem, cell, found in ends:
            range_ += possible(claim, problem, found, cell=cell)
        judged.append(judged_range(claim, value, range_))
    return tuple(judged)


def _formation(setup: EvaluateSetup) -> tuple[Assessment, tuple[Assessment, ...]]:
    """The formation, and its acquisitions where there are several."""
    given = setup.formation
    if isinstance(given, NamedStates):
        return _assess(setup.problem, given), ()
    if len(given) == 1:
        return _assess(setup.problem, given[0]), ()
    return assess_acquisitions(
        setup.problem,
        np.stack([one.positions for one in given]),
        labels=[one.label for one in given],
        names=setup.names,
        label=COMBINED,
    )


def _assess(problem: Problem, one: NamedStates | NamedPositions) -> Assessment:
    if isinstance(one, NamedStates):
        return assess(problem, one.states, label=one.label, names=one.names)
    return assess_placed(problem, one.positions, label=one.label, names=one.names)
