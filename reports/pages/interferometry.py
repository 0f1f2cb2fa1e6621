"""Sections on the pairs of images, and on unwrapping their phase."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from optimize import Assessment, Problem

from ..document import Block, Column, Figure, Paragraph, Section, Status, Symbol, Table
from ..figures.unwrapping import unwrapping_figure
from ..reading import (
    Shown,
    decorrelation_neglected,
    listed_pairs,
    pair_name,
    rungs_beyond_critical,
    sole_transmitter,
)
from ..tables import pairs_frame, rungs_frame
from ..wording import (
    ambiguity,
    fixed,
    formation_name,
    joined,
    meters,
    plain,
    probability,
    to_decimals,
    to_probabilities,
    to_span,
)

OVER_CRITICAL = ("|", Symbol("B_⊥"), "|/", Symbol("B_crit"))
"""Heading of a perpendicular baseline in parts of the critical one."""

_tenths, _thousandths = partial(fixed, decimals=1), partial(fixed, decimals=3)

_BEYOND = (
    " Not coherent: a pair that reaches its critical baseline has no common range band left and "
    "carries no information of its own."
)
_BEYOND_COUNTED = (
    " Counted all the same: such a pair reaches its critical baseline, where nothing is coherent, "
    "but the study neglects that."
)


def pairs_section(
    problem: Problem, critical_baseline: float, assessments: Sequence[Assessment]
) -> Section:
    """Baselines, coherence and looks of the pairs.

    Parameters
    ----------
    problem : scene, radar and errors.
    critical_baseline : the smallest over the scene [m].
    assessments : the formations, a table each.
    """
    transmitter = sole_transmitter(problem)
    if transmitter is None:
        text = "An image is named transmitter→receiver."
    else:
        text = (
            f"{assessments[0].names[transmitter]} transmits, and an image is named by its receiver."
        )
    text += (
        " Values are those of the middle segment; of one that changes by more than 1 % over the "
        "scene, the smallest and the largest are given. A height of ambiguity above 10⁵ m is that "
        "of next to no baseline."
    )
    if assessments[0].unwrapping is not None:
        text += " The rung is the pair's step of the unwrapping ladder."
    if decorrelation_neglected(problem):
        text += (
            " The study neglects baseline decorrelation: coherence and looks are those at zero "
            "baseline."
        )
    critical = (
        " The critical baseline ",
        Symbol("B_crit"),
        f" is {meters(critical_baseline, 4)}, the smallest over the scene.",
    )
    blocks: list[Block] = [Paragraph((text, *critical))]
    blocks += [_pairs_table(problem, one) for one in assessments]
    return Section("pairs", "Interferometric pairs", tuple(blocks))


def _pairs_table(problem: Problem, assessment: Assessment) -> Table:
    frame = pairs_frame(problem, assessment)
    caption = f"Pairs of the {formation_name(assessment.label)}."
    listed = listed_pairs(assessment)
    if len(listed) < len(frame):
        chosen = "The longest" if assessment.unwrapping is None else "The rungs and the longest"
        left_out = len(frame) - len(listed)
        caption += f" {chosen} of {len(frame)}; result.json has the {left_out} left out."
        frame = frame.iloc[list(listed)]
    columns = [
        Column("pair", "Pair"),
        Column("perpendicular_baseline_m", (Symbol("B_⊥"),), "m", to_span(_tenths)),
        Column("azimuth_baseline_m", (Symbol("B_az"),), "m", to_span(_tenths)),
        Column("baseline_over_critical", OVER_CRITICAL, "", to_span(_thousandths)),
        Column("height_of_ambiguity_m", "Height of ambiguity", "m", to_span(ambiguity)),
        Column("coherence", "Coherence", "", to_span(_thousandths)),
        Column("looks", "Looks", "", to_span(_tenths)),
        Column("rung", "Rung"),
    ]
    if assessment.unwrapping is None:
        columns.pop()
    if frame["remark"].any():
        columns.append(Column("remark", "Remark"))
        caption += _BEYOND_COUNTED if decorrelation_neglected(problem) else _BEYOND
    marks = tuple(Status.BAD if remark else Status.NOTE for remark in frame["remark"])
    return Table(frame, tuple(columns), caption, marks)


def unwrapping_section(
    problem: Problem, formations: Sequence[Shown], *, ladder: Assessment
) -> Section | None:
    """Whether the phase can be unwrapped; None where the study gives no prior height."""
    if ladder.unwrapping is None:
        return None
    rungs = rungs_frame(problem, ladder)
    names = [pair_name(problem, ladder, rung.images) for rung in ladder.unwrapping.rungs]
    worst = ladder.unwrapping.worst_segment + 1
    return Section(
        "unwrapping",
        "Phase unwrapping",
        (
            Paragraph(_ladder_text(problem, ladder, ladder.unwrapping.prior_height_std)),
            Table(
                rungs,
                (
                    Column("rung", "Rung"),
                    Column("pair", "Pair"),
                    Column("height_of_ambiguity_m", "Height of ambiguity", "m", _ambiguities),
                    Column("phase_std_rad", "Phase deviation", "rad", to_decimals(3)),
                    Column("probability", "Probability", "", to_probabilities),
                ),
                f"Unwrapping ladder of the {formation_name(ladder.label)} in segment {worst}, its "
                "worst.",
            ),
            Figure(
                unwrapping_figure(
                    formations,
                    problem.scene,
                    required=problem.constraints.min_unwrapping_probability,
                    ladder=ladder.unwrapping,
                    pairs=names,
                ),
                "(a) Probability that some cycle is wrong, in each segment. (b) Deviation of the "
                "phase at each rung, given the rungs below it, with the probability that its cycle "
                "is found; a cycle is lost beyond half of one (dashed).",
                "Left, probability of a wrong cycle against scene time; right, bars of the phase "
                "deviation at each rung of the ladder.",
            ),
        ),
    )


def _ladder_text(problem: Problem, ladder: Assessment, prior_height_std: float) -> str:
    text = (
        "Cycles are found one pair after the other, the surest first; each rung starts from the "
        f"prior height, known to {plain(prior_height_std)}\u00a0m, and the rungs below it. Noise "
        "and systematic errors both count."
    )
    unwrapping = ladder.unwrapping
    if unwrapping is not None and unwrapping.probability.size and len(unwrapping.rungs) > 1:
        before = probability(float(unwrapping.probability.min()))
        after = probability(float(unwrapping.decorrelated.min()))
        gain = f"leaves the probability in the worst segment at {after}"
        if after != before:
            gain = f"raises the probability in the worst segment from {before} to {after}"
        text += (
            f" Decorrelating the ambiguities first (LAMBDA) {gain}; no integer estimator exceeds "
            f"{probability(float(unwrapping.ceiling.min()))}."
        )
    beyond = [str(number) for number in rungs_beyond_critical(problem, ladder)]
    if not beyond:
        return text
    who = f"Rung {beyond[0]} joins" if len(beyond) == 1 else f"Rungs {joined(beyond)} each join"
    return (
        f"{text} {who} two images that have no common band with each other: the phase between "
        "them is known through third images."
    )


def _ambiguities(values: Sequence[float]) -> list[str]:
    return [ambiguity(float(value)) for value in values]
