"""Runs a study of kind `optimize`: search, then assess what was found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from configs import OptimizeStudy
from configs.build import OptimizeSetup
from optimize import (
    Assessment,
    Certificate,
    OptimizeResult,
    SearchResult,
    assess,
    certify,
    compiled_loops,
    dem_verdict,
    findings,
    judge_target,
    refuted,
    search,
)

from .formation_summary import formation_summary, refutation_seed, scene_cautions
from .outcome import Options, Outcome


def run(study: OptimizeStudy, setup: OptimizeSetup, options: Options) -> Outcome:
    """Search for the best formation of a study.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line.
    """
    seed = study.search.seed if options.seed is None else options.seed
    options.on_start(setup.settings.algorithm.generations)
    # As the search would choose, but known before: its results depend on it in the last digits.
    loops = compiled_loops(setup.problem, setup.space, setup.settings)
    found = search(
        setup.problem,
        setup.space,
        settings=setup.settings,
        rng=np.random.default_rng(seed),
        start=None if setup.initial_design is None else setup.initial_design[None],
        on_generation=options.on_generation,
        should_stop=options.should_stop,
        keeper=None if options.keeper is None else options.keeper(seed, loops is not None),
        evaluator=loops,
    )
    best, initial, *compare = refuted(
        setup.problem,
        _assessed(setup, found),
        settings=setup.refutation,
        seed=refutation_seed(study, options, seed),
    )
    certificate, unproved = _certificate(setup, found)
    blocked = _blocked(best, certificate)
    dem = dem_verdict(setup.problem, best.scene_positions, label=best.label, request=setup.dem)
    cautions = scene_cautions(setup.observation)
    result = OptimizeResult(
        problem=setup.problem,
        critical_baseline=setup.critical_baseline,
        initial=initial,
        best=best,
        compare=tuple(compare),
        search=found,
        notices=_notices(found, blocked),
        warnings=(*cautions, *findings(setup.problem, best)),
        dem=dem,
        certificate=certificate,
        certificate_reason=unproved,
    )
    return Outcome(
        result=result,
        summary=formation_summary((initial, best), cautions, dem=dem, certificate=certificate),
        evaluations=found.evaluations,
        compiled=found.compiled,
        seed=seed,
        orbit=setup.orbit,
        observation=setup.observation,
        blocked=blocked,
        interrupted=found.interrupted,
    )


def _assessed(setup: OptimizeSetup, found: SearchResult) -> list[Assessment]:
    """The best formation, the initial one, and those to compare with."""
    named = (
        ("best", setup.space.names, setup.space.states(found.design)),
        ("initial", setup.space.names, setup.initial_states),
        *setup.compare,
    )
    return [
        assess(setup.problem, states, label=label, names=names) for label, names, states in named
    ]


def _notices(found: SearchResult, blocked: str | None) -> tuple[str, ...]:
    """What stands before everything else in a report."""
    notices = []
    if blocked is not None:
        notices.append(f"No feasible formation was found: {blocked}")
    if found.interrupted:
        notices.append(
            f"The search was interrupted after {found.evaluations} formations: this is the best so "
            "far, not the best there is.",
        )
    return tuple(notices)


def _blocked(best: Assessment, certificate: Certificate | None) -> str | None:
    """Why nothing feasible was found, with the proof where there is one; None if it was."""
    if best.feasible:
        return None
    return _blocking(best) + ("" if certificate is None else _proof(certificate))


def _certificate(setup: OptimizeSetup, found: SearchResult) -> tuple[Certificate | None, str]:
    """What can be proved of the design found, or why nothing was tried."""
    if setup.certificate is None:
        return None, "the study asks for no proof"
    if found.interrupted:
        return None, "the search was interrupted before its end"
    problem, space, settings = setup.problem, setup.space, setup.certificate
    certificate = certify(problem, space, design=found.design, settings=settings)
    if settings.target is not None:
        target = judge_target(
            problem,
            space,
            target=settings.target,
            design=found.design,
            certificate=certificate,
            settings=settings,
        )
        certificate = replace(certificate, target=target)
    return certificate, ""


def _proof(certificate: Certificate) -> str:
    """That nothing is feasible, and what would help, where it is proved."""
    blocked = certificate.infeasibility
    if blocked is None:
        return ""
    helps = [
        f"{relief.name} {relief.passes_at:.4g} {relief.unit}".rstrip()
        for relief in blocked.reliefs
        if np.isfinite(relief.passes_at)
    ]
    text = f" Proven: {blocked.statement}"
    return f"{text} It would pass with: {', or '.join(helps)}." if helps else text


def _blocking(best: Assessment) -> str:
    """Which limits the least bad formation breaks, by how much, and what may help."""
    broken = [
        f"{report.limit.name}: {report.value:.4g} {report.limit.unit}".rstrip()
        + f" against a limit of {report.limit.value:.4g} {report.limit.unit}".rstrip()
        + f", missed by {-report.margin:.4g} {report.limit.unit}".rstrip()
        + f"; {report.limit.remedy}."
        for report in best.constraints
        if not report.satisfied
    ]
    return " ".join(broken) or "No design measures a height at all."
