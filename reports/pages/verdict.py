"""The verdict on a formation: the result in a few sentences, and what holds it back."""

from __future__ import annotations

from insar.simulation import Verdict
from optimize import Assessment, EvaluateResult, OptimizeResult, Problem, noise_excess

from ..certificate_words import target_text, verdict_text
from ..document import Block, Callout, Status, Strong, Text
from ..reading import (
    active,
    broken,
    decorrelation_neglected,
    incoherent_pairs,
    measured,
    shares,
    unmeasured_reason,
)
from ..refutation_words import VERDICTS, finding, worst_of
from ..wording import (
    counted,
    fixed,
    formation_name,
    joined,
    meters,
    percent,
    plain,
    probability,
    quantity,
    source_name,
)
from .claims import claims_text
from .key_figures import key_figures, seen_segments
from .limits import shortfall_text

INPUTS = "inputs of this study"
"""What printed figures of a mission are compared with."""

_DOUBTFUL_PROBABILITY = 0.9
"""Probability of unwrapping below which a verdict without a limit on it is a warning."""


def optimize_verdict(result: OptimizeResult, unseen: int = 0) -> tuple[Block, ...]:
    """Verdict on a search.

    Parameters
    ----------
    result : of the search.
    unseen : targets that the pass does not see.
    """
    best, initial = result.best, result.initial
    paragraphs: list[Text] = []
    if result.search.interrupted:
        paragraphs.append(
            (
                Strong("The search was interrupted. "),
                "This is the best formation found until then; a full run may find a better one.",
            )
        )
    if best.feasible:
        paragraphs.append((*_achieved(best, unseen), " ", _against(initial, best)))
        paragraphs.append(verdict_text(result.certificate, result.certificate_reason))
        if result.certificate is not None and result.certificate.target is not None:
            paragraphs.append(target_text(result.certificate.target))
        status, title = Status.GOOD, _title(best, unseen)
    else:
        paragraphs.append(
            "No formation that keeps every limit was found. Shown is the one that breaks them "
            "least; it is not a solution."
        )
        proof = None if result.certificate is None else result.certificate.infeasibility
        if proof is not None:
            paragraphs.append((Strong("None exists, proven: "), proof.statement))
        status, title = Status.BAD, "No feasible formation"
    paragraphs += _remarks(result.problem, best)
    doubtful = result.search.interrupted or unseen > 0 or _doubtful(result.problem, best)
    if status is Status.GOOD and doubtful:
        status = Status.WARNING
    status, title = _unless_refuted(best, status, title)
    return Callout(status, title, tuple(paragraphs)), key_figures(result.problem, best, unseen)


def evaluate_verdict(result: EvaluateResult, unseen: int = 0) -> tuple[Block, ...]:
    """Verdict on a given formation.

    Parameters
    ----------
    result : of the evaluation.
    unseen : targets that the pass does not see.
    """
    formation = result.formation
    if not measured(formation):
        status, title = Status.BAD, "No height is measured"
        paragraphs: list[Text] = []
    else:
        title = _title(formation, unseen)
        status = Status.GOOD if formation.feasible else Status.BAD
        paragraphs = [_achieved(formation, unseen)]
    paragraphs += _remarks(result.problem, formation)
    paragraphs += claims_text(result.claims, INPUTS)
    if status is Status.GOOD and (unseen > 0 or _doubtful(result.problem, formation)):
        status = Status.WARNING
    status, title = _unless_refuted(formation, status, title)
    return Callout(status, title, tuple(paragraphs)), key_figures(result.problem, formation, unseen)


def _unless_refuted(formation: Assessment, status: Status, title: str) -> tuple[Status, str]:
    """Status and title, if the simulation leaves anything of them."""
    refutation = formation.refutation
    if refutation is None or not measured(formation):
        return status, title
    if refutation.verdict is Verdict.MEASURES_NOTHING:
        error = meters(float(formation.height_error.region))
        return Status.BAD, f"Measures nothing, although {error} is predicted"
    if status is Status.GOOD and refutation.verdict is not Verdict.AGREES:
        return Status.WARNING, title
    return status, title


def _refutation(formation: Assessment) -> list[Text]:
    """What the simulation found, in the segment that says most."""
    if formation.refutation is None:
        return []
    verdict, segment = formation.refutation.verdict, worst_of(formation.refutation.segments)
    return [(Strong(f"Simulation: {VERDICTS[verdict]}. "), finding(segment))]


def _title(formation: Assessment, unseen: int) -> str:
    title = f"Height error {meters(float(formation.height_error.region))}"
    return f"{title} over {seen_segments(formation, unseen)}" if unseen else title


def _achieved(formation: Assessment, unseen: int) -> tuple[str, ...]:
    error = formation.height_error
    scene = (
        f"{seen_segments(formation, unseen)}, those that the pass sees"
        if unseen
        else f"{counted(error.total.size, 'segment')} of the scene"
    )
    return (
        f"The {formation_name(formation.label)} measures height with an error of ",
        Strong(meters(float(error.region))),
        f" (total, RMS over {scene}), of which ",
        Strong(meters(float(error.relative_region))),
        " varies from pixel to pixel (relative error).",
    )


def _against(initial: Assessment, best: Assessment) -> str:
    """The initial formation's error, and whether it may be compared at all."""
    if not measured(initial):
        return f"The {initial.label} formation measures no height: {unmeasured_reason(initial)}."
    before, after = float(initial.height_error.region), float(best.height_error.region)
    figures = f"{meters(before)} (relative {meters(float(initial.height_error.relative_region))})"
    if not initial.feasible:
        names = joined([report.limit.name for report in broken(initial)])
        return (
            f"The {initial.label} formation would have {figures}, but breaks the limit on {names}, "
            "so the two are not comparable."
        )
    if after < before:
        return f"The {initial.label} formation has {figures}, {before / after:.3g} times as much."
    return f"The {initial.label} formation has {figures}."


def _remarks(problem: Problem, formation: Assessment) -> list[Text]:
    """What limits the formation, whether it can be unwrapped, and how it stands to the limits."""
    remarks: list[Text] = []
    reason = unmeasured_reason(formation)
    if reason is not None:
        remarks.append((Strong("No height is measured: "), f"{reason}."))
    else:
        remarks.append(_limited_by(formation))
        remarks += _phase_noise(problem, formation)
        remarks.append(_unwrapping(problem, formation))
        remarks += _refutation(formation)
    remarks += [
        (
            Strong(f"Broken: {report.limit.name}. "),
            f"{shortfall_text(report)} Remedy: {report.limit.remedy}.",
        )
        for report in broken(formation)
    ]
    if formation.constraints and not broken(formation):
        count = len(formation.constraints)
        remarks.append("The only limit is kept." if count == 1 else f"All {count} limits are kept.")
    incoherent = incoherent_pairs(formation)
    if incoherent and decorrelation_neglected(problem):
        remarks.append(
            (
                Strong(
                    f"{incoherent} of {counted(len(formation.pairs), 'pair')} reach the critical "
                    "baseline, where nothing is coherent. "
                ),
                "The study neglects that, so the model counts them: the error of a real radar is "
                "larger than stated.",
            )
        )
    return remarks


def _limited_by(formation: Assessment) -> Text:
    first, *rest = shares(formation)
    text: tuple[str, ...] = (
        "The largest contribution is ",
        Strong(source_name(first.source)),
        f" ({meters(first.contribution)}, {percent(first.variance_share)} of the variance)",
    )
    if rest and rest[0].variance_share >= 0.05:
        second = rest[0]
        text += (
            f", then {source_name(second.source)} ({meters(second.contribution)}, "
            f"{percent(second.variance_share)})",
        )
    at_limit = [report.limit.name for report in formation.constraints if active(report)]
    if at_limit:
        noun = "limit" if len(at_limit) == 1 else "limits"
        return (
            *text,
            f". The design is held back by the {noun} on ",
            Strong(joined(at_limit)),
            ".",
        )
    free = formation.constraints and not broken(formation)
    return (*text, "; no limit is active." if free else ".")


def _phase_noise(problem: Problem, formation: Assessment) -> list[Text]:
    """Phase noise above the Cramér-Rao bound, which the model counts."""
    noise = noise_excess(problem, formation)
    if noise is None or not noise.counted:
        return []
    return [
        (
            "The phase noise is up to ",
            Strong(percent(noise.excess)),
            " larger than the Cramér-Rao bound (coherence ",
            fixed(noise.coherence, 2),
            f", {noise.looks:.3g} looks in a pair that matters): the exact statistics are counted.",
        )
    ]


def _unwrapping(problem: Problem, formation: Assessment) -> Text:
    unwrapping = formation.unwrapping
    if unwrapping is None:
        return (
            "Whether the phase can be unwrapped was not assessed: the study gives no prior height."
        )
    worst = probability(float(unwrapping.probability.min()))
    return (
        "With heights known beforehand to ",
        quantity(plain(unwrapping.prior_height_std), "m"),
        ", every cycle of the phase is found with probability ",
        Strong(worst),
        f" in the worst segment ({unwrapping.worst_segment + 1} of {unwrapping.probability.size})"
        + ("." if not _doubtful(problem, formation) else ": where it is not, the height is wrong."),
    )


def _doubtful(problem: Problem, formation: Assessment) -> bool:
    """Whether the figure stands on a phase that may not be unwrapped, or pairs that are noise."""
    unwrapping = formation.unwrapping
    improbable = (
        unwrapping is not None and float(unwrapping.probability.min()) < _DOUBTFUL_PROBABILITY
    )
    return improbable or (decorrelation_neglected(problem) and incoherent_pairs(formation) > 0)
