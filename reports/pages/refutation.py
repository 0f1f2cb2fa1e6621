"""The section that tells whether a simulation agrees with the error model."""

from __future__ import annotations

from collections.abc import Sequence

from insar.simulation import MAX_IMAGES, Refutation, Verdict
from optimize import Assessment, Problem

from ..document import Block, Callout, Column, Figure, Paragraph, Section, Status, Table
from ..figures.refutation import refutation_figure
from ..refutation_words import VERDICTS, finding, worst_of
from ..tables_refutation import gain_frame, refutation_frame
from ..wording import (
    counted,
    formation_name,
    joined,
    plain,
    quantity,
    to_decimals,
    to_digits,
)

STATUS = {
    Verdict.AGREES: Status.GOOD,
    Verdict.DISAGREES: Status.WARNING,
    Verdict.OFTEN_WRONG: Status.WARNING,
    Verdict.MEASURES_NOTHING: Status.BAD,
}

_TITLES = {
    Verdict.AGREES: "The simulation agrees",
    Verdict.DISAGREES: "The simulation disagrees with the error model",
    Verdict.OFTEN_WRONG: "The error model holds where cycles are right, and they often are not",
    Verdict.MEASURES_NOTHING: "This formation measures nothing",
}


def refutation_section(
    problem: Problem, subject: Assessment, others: Sequence[Assessment] = ()
) -> Section | None:
    """Simulation beside prediction; None where nothing was simulated.

    Parameters
    ----------
    problem : scene, radar and errors.
    subject : the formation that the report is about.
    others : formations beside it.
    """
    refutation = subject.refutation
    if refutation is None:
        if len(problem.radar.images) <= MAX_IMAGES:
            return None
        text = f"Not simulated: {len(problem.radar.images)} images are too many to take seconds."
        return Section("simulation", "Does a simulation agree?", (Paragraph(text),))
    telling = worst_of(refutation.segments)
    blocks: list[Block] = [
        Callout(
            STATUS[refutation.verdict],
            _TITLES[refutation.verdict],
            tuple(finding(segment) for segment in refutation.segments),
        ),
        Paragraph(_how(problem, refutation)),
    ]
    if refutation.departures:
        blocks.append(Paragraph(_departures(refutation)))
    blocks += [
        _comparison([subject, *others]),
        _gain([subject, *others]),
        Figure(
            refutation_figure(telling),
            f"Height errors of the {formation_name(subject.label)} in segment "
            f"{telling.segment + 1}: simulated, with the cycles that bootstrapping finds, against "
            "the Gaussian that the error model predicts for right cycles, and that of the height "
            "known beforehand. Wrong cycles stand apart by the heights of ambiguity.",
            "Histogram of simulated height errors with two Gaussian curves, near zero and over "
            "all heights on a logarithmic scale.",
        ),
    ]
    return Section("simulation", "Does a simulation agree?", tuple(blocks))


def _how(problem: Problem, refutation: Refutation) -> str:
    prior = quantity(plain(refutation.segments[0].prior_height_std), "m")
    given = problem.constraints.prior_height_std is not None
    known = f"{prior}, as the study has it" if given else f"{prior}, since the study gives none"
    return (
        f"{counted(refutation.samples, 'pixel')} of each segment were drawn: complex speckle and "
        "noise look by look from the coherence matrix, each image in its own part of the "
        f"spectrum; errors at their scales ({counted(refutation.draws, 'draw')} of those that stay "
        "the same over a scene); true heights from the prior ("
        f"{known}). Heights were then estimated from "
        "wrapped phases, twice: along the unwrapping ladder by weighted least squares, as the "
        "error model has it, and by maximum likelihood with the prior over all cycles. The "
        "segments are the one with the least probability of right cycles and the median. A "
        "difference counts where it exceeds both three sampling errors and what matters: 5 % of a "
        "height error, 1 % of the pixels."
    )


def _departures(refutation: Refutation) -> str:
    return (
        "The error model of the study takes more for granted than nature gives. In the simulation "
        f"{joined(list(refutation.departures))}."
    )


def _comparison(assessments: Sequence[Assessment]) -> Table:
    frame = refutation_frame(assessments)
    marks = tuple(
        Status.NOTE if verdict is Verdict.AGREES else STATUS[verdict]
        for verdict in frame["verdict"]
    )
    frame["verdict"] = [VERDICTS[verdict] for verdict in frame["verdict"]]
    frame["segment"] = [str(number) for number in frame["segment"]]
    return Table(
        frame,
        (
            Column("label", "Formation"),
            Column("segment", "Segment"),
            Column("quantity", "Quantity"),
            Column("predicted", "Predicted", "", list),
            Column("simulated", "Simulated", "", list),
            Column("deviation", "z", "", to_decimals(1)),
            Column("verdict", "Simulation"),
        ),
        "Prediction and simulation, with its sampling error; z is their difference in sampling "
        "errors. Wrong cycles are those of bootstrapping.",
        marks,
    )


def _gain(assessments: Sequence[Assessment]) -> Table:
    frame = gain_frame(assessments)
    frame["segment"] = [str(number) for number in frame["segment"]]
    numbers = to_digits(3)
    return Table(
        frame,
        (
            Column("label", "Formation"),
            Column("segment", "Segment"),
            Column("prior_height_std_m", "Prior", "m", numbers),
            Column("unwrapped_m", "Least squares, RMS", "m", numbers),
            Column("most_likely_m", "Maximum likelihood, RMS", "m", numbers),
            Column("two_thirds_m", "68 % within", "m", numbers),
            Column("best_m", "Posterior mean, RMS", "m", numbers),
            Column("gain_m", "Gained", "m", numbers),
            Column("bits", "Gained", "bits", to_decimals(1)),
        ),
        "Errors of all pixels, wrong cycles included, against the height known beforehand. The "
        "gain is of the posterior mean, which has the smallest RMS error; in bits, log₂ of the "
        "prior's deviation over it: the least information that an estimate with this error can "
        "rest on. A few wrong cycles rule an RMS; within what 68 % of the maximum-likelihood "
        "heights stay, they do not show.",
    )
