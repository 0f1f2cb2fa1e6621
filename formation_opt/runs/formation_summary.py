"""What the runs that score formations have in common."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from configs import EvaluateStudy, OptimizeStudy
from insar.dem import Judgment
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from insar.observe.scenes.cautions import cautions, orbit_cautions
from insar.simulation import Refutation, Verdict
from optimize import Assessment, Certificate, DemVerdict
from optimize.certificate import TargetVerdict

from .outcome import Options, Summary

_VERDICTS = {
    Verdict.AGREES: "agrees",
    Verdict.DISAGREES: "disagrees",
    Verdict.OFTEN_WRONG: "cycles often wrong",
    Verdict.MEASURES_NOTHING: "measures nothing",
}


def formation_summary(
    shown: Sequence[Assessment],
    warnings: tuple[str, ...] = (),
    *,
    dem: DemVerdict | None = None,
    certificate: Certificate | None = None,
) -> Summary:
    """Height error, unwrapping and limits of each formation.

    Parameters
    ----------
    shown : the formations, the one that matters last.
    warnings : of the scene.
    dem : the elevation model of the last formation; its judgment is shown where there is one.
    certificate : what is proved of the last formation.
    """
    rows = [
        (
            "height error, total (RMS)",
            tuple(meters(float(a.height_error.region)) for a in shown),
        ),
        (
            "height error, relative",
            tuple(meters(float(a.height_error.relative_region)) for a in shown),
        ),
    ]
    unwrapping = [a.unwrapping for a in shown if a.unwrapping is not None]
    if len(unwrapping) == len(shown):
        rows.append(
            ("unwrapping probability", tuple(f"{u.probability.min():.4f}" for u in unwrapping))
        )
    refutations = [a.refutation for a in shown]
    if any(refutations):
        rows += _simulated(refutations)
        warnings = (*warnings, *_useless(shown))
    rows.append(("limits", tuple(_limits(a) for a in shown)))
    if dem is not None and dem.judgments:
        elsewhere = ("",) * (len(shown) - 1)
        rows += [
            (f"{judgment.specification.name} at 90 %", (*elsewhere, _judged(judgment)))
            for judgment in dem.judgments
        ]
    if certificate is not None and _says_something(certificate):
        elsewhere = ("",) * (len(shown) - 1)
        rows.append((_proven_of(certificate), (*elsewhere, _proven(certificate))))
    if certificate is not None and certificate.target is not None:
        elsewhere = ("",) * (len(shown) - 1)
        wanted = certificate.target
        label = f"target {meters(wanted.height_error)}"
        rows.append((label, (*elsewhere, _reachable(wanted))))
    return Summary(tuple(a.label for a in shown), tuple(rows), warnings)


def refutation_seed(study: OptimizeStudy | EvaluateStudy, options: Options, otherwise: int) -> int:
    """Seed of the simulation: of the command line, of its block, or that of the search.

    Parameters
    ----------
    study : the study.
    options : of the command line.
    otherwise : where neither names one.
    """
    if options.seed is not None:
        return options.seed
    own = None if study.refutation is None else study.refutation.seed
    return otherwise if own is None else own


def _simulated(refutations: Sequence[Refutation | None]) -> list[tuple[str, tuple[str, ...]]]:
    """What a simulation found in the worst segment of each formation that was simulated."""

    def shown(say: Callable[[Refutation], str]) -> tuple[str, ...]:
        return tuple("" if one is None else say(one) for one in refutations)

    return [
        ("  simulated, right cycles", shown(lambda r: meters(r.segments[0].right_cycles.value))),
        ("  simulated wrong cycles", shown(lambda r: _share(r.segments[0].wrong.value))),
        ("  gained over the prior", shown(lambda r: f"{r.segments[0].bits:.1f} bits")),
        ("simulation", shown(lambda r: _VERDICTS[r.verdict])),
    ]


def _useless(shown: Sequence[Assessment]) -> tuple[str, ...]:
    """A warning if the formation that matters measures nothing."""
    refutation = shown[-1].refutation
    if refutation is None or refutation.verdict is not Verdict.MEASURES_NOTHING:
        return ()
    worst = max(refutation.segments, key=lambda s: s.best.value)
    return (
        f"the {shown[-1].label} formation measures nothing: simulated heights are wrong by "
        f"{meters(worst.best.value)}, the prior was by {meters(worst.prior_height_std)}.",
    )


def _says_something(certificate: Certificate) -> bool:
    return certificate.strongest is not None or certificate.infeasibility is not None


def _proven_of(certificate: Certificate) -> str:
    if certificate.infeasibility is not None:
        return "formations within the limits"
    return "no formation is below, proven"


def _proven(certificate: Certificate) -> str:
    if certificate.infeasibility is not None:
        return "none, proven"
    bound = f"{certificate.lower_bound:.4f} m"
    if not np.isfinite(certificate.gap):
        return f"{bound} (best: not feasible)"
    return f"{bound} (best: {100.0 * certificate.gap:.2g} % above)"


def _reachable(target: TargetVerdict) -> str:
    if target.reached:
        return "reached"
    return "not reached" if target.impossible is None else "out of reach, proven"


def scene_cautions(observation: Observation | StaringScene | None) -> tuple[str, ...]:
    """Warnings of the scene; none for a scene that was given."""
    if observation is None:
        return ()
    if isinstance(observation, Observation):
        return cautions(observation)
    return orbit_cautions(observation)


def meters(value: float) -> str:
    """A length as the terminal shows it; none if it is not finite."""
    return f"{value:.3f} m" if np.isfinite(value) else "none"


def _judged(judgment: Judgment) -> str:
    """Pass or fail, with the demand that is missed by most."""
    if judgment.passed:
        return "pass"
    worst = max(judgment.criteria, key=lambda criterion: criterion.ratio)
    what = {"posting": "posting", "relative_90": "relative", "absolute_90": "absolute"}
    return f"fail: {what[worst.quantity.value]} {worst.value:.3g} m > {worst.limit:g} m"


def _limits(assessment: Assessment) -> str:
    broken = sum(not report.satisfied for report in assessment.constraints)
    if broken:
        return f"{broken} of {len(assessment.constraints)} broken"
    return "all kept" if assessment.constraints else "none set"


def _share(value: float) -> str:
    return f"{100.0 * value:.{1 if value < 0.1 else 0}f} %"
