"""Runs a study of kind `optimize`: search, then assess what was found."""

from __future__ import annotations

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
    dem_verdict,
    findings,
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
    found = search(
        setup.problem,
        setup.space,
        settings=setup.settings,
        rng=np.random.default_rng(seed),
        start=None if setup.initial_design is None else setup.initial_design[None],
        on_generation=options.on_generation,
        should_stop=options.should_stop,
        keeper=None if options.keeper is None else options.keeper(seed),
    )
    names = setup.space.names
    initial = assess(setup.problem, setup.initial_states, label="initial", names=names)
    best = assess(setup.problem, setup.space.states(found.design), label="best", names=names)
    compare = [
        assess(setup.problem, states, label=label, names=members)
        for label, members, states in setup.compare
    ]
    best, initial, *compare = refuted(
        setup.problem,
        [best, initial, *compare],
        settings=setup.refutation,
        seed=refutation_seed(study, options, seed),
    )
    certificate, unproved = _certificate(setup, found)
    notices = []
    blocked = None if best.feasible else _blocking(best)
    if blocked is not None and certificate is not None:
        blocked = f"{blocked}{_proof(certificate)}"
    if blocked is not None:
        notices.append(f"No feasible formation was found: {blocked}")
    if found.interrupted:
        notices.append(
            f"The search was interrupted after {found.evaluations} formations: this is the best so "
            "far, not the best there is.",
        )
    dem = dem_verdict(setup.problem, best.scene_positions, label=best.label, request=setup.dem)
    cautions = scene_cautions(setup.observation)
    result = OptimizeResult(
        problem=setup.problem,
        critical_baseline=setup.critical_baseline,
        initial=initial,
        best=best,
        compare=tuple(compare),
        search=found,
        notices=tuple(notices),
        warnings=(*cautions, *findings(setup.problem, best)),
        dem=dem,
        certificate=certificate,
        certificate_reason=unproved,
    )
    return Outcome(
        result=result,
        summary=formation_summary((initial, best), cautions, dem=dem, certificate=certificate),
        evaluations=found.evaluations,
        seed=seed,
        orbit=setup.orbit,
        observation=setup.observation,
        blocked=blocked,
        interrupted=found.interrupted,
    )


def _certificate(setup: OptimizeSetup, found: SearchResult) -> tuple[Certificate | None, str]:
    """What can be proved of the design found, or why nothing was tried."""
    if setup.certificate is None:
        return None, "the study asks for no proof"
    if found.interrupted:
        return None, "the search was interrupted before its end"
    certificate = certify(
        setup.problem, setup.space, design=found.design, settings=setup.certificate
    )
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
    text = f" Proved: {blocked.statement}"
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
