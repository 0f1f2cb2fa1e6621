"""What a report reads out of an assessment before it words or draws it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from insar import BaselineDecorrelation, HeightStatus
from optimize import Assessment, ConstraintReport, FailureLimit, Problem
from optimize.acquisitions import image_of

ACTIVE_MARGIN = 1e-3
"""Margin, in parts of the limit, below which a limit that is kept counts as active."""

ACTIVE_FAILURE_MARGIN = 1e-2
"""The same for a probability, in parts of the failure that its limit allows."""

_MOST_SATELLITES_JOINED = 10
"""Satellites of a figure that draws the baseline of every two."""


class Shown(NamedTuple):
    """A formation as a figure shows it.

    Attributes
    ----------
    assessment : the formation.
    style : index of its color and marker.
    """

    assessment: Assessment
    style: int

    @property
    def name(self) -> str:
        """Its label, with a remark where it must not be taken for a solution."""
        assessment = self.assessment
        if not measured(assessment):
            return f"{assessment.label} (measures no height)"
        return assessment.label if assessment.feasible else f"{assessment.label} (breaks a limit)"


class Share(NamedTuple):
    """The contribution of one source: RMS over the segments [m], and its part of the variance."""

    source: str
    contribution: float
    variance_share: float


def shares(assessment: Assessment) -> tuple[Share, ...]:
    """Contributions to the region error, the largest first."""
    terms = {name: float(value) for name, value in assessment.height_error.region_terms.items()}
    total = float(assessment.height_error.region) ** 2
    found = [
        Share(name, value, value**2 / total if math.isfinite(total) and total > 0.0 else math.nan)
        for name, value in terms.items()
    ]
    return tuple(sorted(found, key=lambda share: (-share.contribution, share.source)))


def measured(assessment: Assessment) -> bool:
    """Whether the height is measured in every segment."""
    return bool(np.all(assessment.height_error.status == HeightStatus.MEASURED))


def unmeasured_reason(assessment: Assessment) -> str | None:
    """Why no height is measured, and in how many segments; None where it is."""
    status = assessment.height_error.status
    missing = status[status != HeightStatus.MEASURED]
    if missing.size == 0:
        return None
    reasons = [HeightStatus(value).reason for value in np.unique(missing)]
    return f"{' or '.join(reasons)} in {missing.size} of {status.size} segments"


def active(report: ConstraintReport) -> bool:
    """Whether a limit is kept with next to no margin, so that it holds the design back."""
    # A probability is limited through its failure: 0.99009 is close to 0.99, 0.9905 is not.
    limit = report.limit
    if isinstance(limit, FailureLimit):
        near = ACTIVE_FAILURE_MARGIN * (1.0 - limit.value)
    else:
        near = ACTIVE_MARGIN * limit.value
    return report.satisfied and report.margin < near


def broken(assessment: Assessment) -> tuple[ConstraintReport, ...]:
    """The limits that a formation breaks."""
    return tuple(report for report in assessment.constraints if not report.satisfied)


def image_name(problem: Problem, assessment: Assessment, image: int) -> str:
    """Image as transmitter→receiver; of several acquisitions, with which it is of."""
    acquisition, own = _origin(problem, assessment, image)
    transmitter, receiver = problem.radar.images[own]
    name = f"{assessment.names[transmitter]}→{assessment.names[receiver]}"
    if not assessment.acquisitions:
        return name
    return f"{assessment.acquisitions[acquisition]}: {name}" if image else f"reference: {name}"


def _origin(problem: Problem, assessment: Assessment, image: int) -> tuple[int, int]:
    """Acquisition, and image of the radar, of an image."""
    return image_of(problem, image) if assessment.acquisitions else (0, image)


def sole_transmitter(problem: Problem) -> int | None:
    """Index of the satellite that transmits for all images; None where several do."""
    transmitters = {transmitter for transmitter, _ in problem.radar.images}
    return transmitters.pop() if len(transmitters) == 1 else None


def pair_name(problem: Problem, assessment: Assessment, images: tuple[int, int]) -> str:
    """Pair of images by their names; by the receivers alone where one satellite transmits.

    Of several acquisitions, with the one that the pair is of; two images of different acquisitions
    stand for the difference of two interferograms.
    """
    (first, one), (second, other) = (_origin(problem, assessment, image) for image in images)
    if not assessment.acquisitions:
        return _own_pair_name(problem, assessment, (one, other))

    def named(acquisition: int, own: tuple[int, int]) -> str:
        label = assessment.acquisitions[acquisition]
        if len(problem.radar.images) == 2:  # its only pair
            return label
        return f"{label}: {_own_pair_name(problem, assessment, own)}"

    if images[0] == 0 or first == second:
        return named(second, (one, other))
    return f"{named(second, (0, other))} − {named(first, (0, one))}"


def _own_pair_name(problem: Problem, assessment: Assessment, images: tuple[int, int]) -> str:
    """Pair of images of the radar by their names."""
    names = assessment.names
    if sole_transmitter(problem) is not None:
        return " · ".join(names[problem.radar.images[image][1]] for image in images)
    ends = ((names[t], names[r]) for t, r in (problem.radar.images[image] for image in images))
    return " · ".join(f"{transmitter}→{receiver}" for transmitter, receiver in ends)


def pair_satellites(
    problem: Problem, assessment: Assessment, images: tuple[int, int]
) -> tuple[int, ...]:
    """Satellites between whose phase centers the baseline of a pair lies."""
    own = [_origin(problem, assessment, image)[1] for image in images]
    first, second = problem.radar.incidence_matrix[own]
    return tuple(int(index) for index in np.flatnonzero(first != second))


class Baselines(NamedTuple):
    """The baselines that an orbit figure draws.

    Attributes
    ----------
    ends : the two satellites of each.
    words : what they are, for a caption; empty where none is drawn.
    """

    ends: tuple[tuple[int, int], ...]
    words: str


def drawn_baselines(problem: Problem, assessment: Assessment) -> Baselines:
    """Baselines of all satellites; of many, those of the unwrapping ladder only."""
    if len(assessment.names) <= _MOST_SATELLITES_JOINED:
        every = [(int(first), int(second)) for first, second in assessment.separation_pairs]
        return Baselines(tuple(every), "the baselines between them")
    ends = dict.fromkeys(
        pair_satellites(problem, assessment, images) for images in rung_numbers(assessment)
    )
    two = tuple((pair[0], pair[1]) for pair in ends if len(pair) == 2)
    return Baselines(two, "the baselines of the unwrapping ladder" if two else "")


def incoherent_pairs(assessment: Assessment) -> int:
    """How many pairs reach their critical baseline in some segment."""
    return sum(bool(np.any(pair.baseline_over_critical >= 1.0)) for pair in assessment.pairs)


def decorrelation_neglected(problem: Problem) -> bool:
    """Whether the error model counts pairs beyond their critical baseline as if coherent."""
    return problem.errors.baseline_decorrelation is BaselineDecorrelation.NONE


_MOST_PAIRS = 21
"""Pairs that a table lists in full: those of seven images."""

_PAIRS_LISTED, _LONGEST_LISTED = 20, 3
"""Of more pairs so many are listed, or the rungs and so many of the longest others."""


def listed_pairs(assessment: Assessment) -> tuple[int, ...]:
    """Indices of the pairs that a table lists: all; of many the rungs, then the longest others."""
    pairs = assessment.pairs
    if len(pairs) <= _MOST_PAIRS:
        return tuple(range(len(pairs)))
    rungs = rung_numbers(assessment)
    in_ladder = [index for index, pair in enumerate(pairs) if pair.images in rungs]
    others = [index for index, pair in enumerate(pairs) if pair.images not in rungs]
    in_ladder.sort(key=lambda index: rungs[pairs[index].images])
    others.sort(key=lambda index: -float(np.abs(pairs[index].perpendicular_baseline).max()))
    room = max(_PAIRS_LISTED - len(in_ladder), _LONGEST_LISTED)
    return (*in_ladder, *others[:room])


def rungs_beyond_critical(problem: Problem, assessment: Assessment) -> tuple[int, ...]:
    """Rungs whose two images have no common band with each other in the ladder's segment."""
    unwrapping = assessment.unwrapping
    if unwrapping is None or decorrelation_neglected(problem):
        return ()
    beyond = {
        pair.images
        for pair in assessment.pairs
        if pair.baseline_over_critical[unwrapping.worst_segment] >= 1.0
    }
    return tuple(n for images, n in rung_numbers(assessment).items() if images in beyond)


def rung_numbers(assessment: Assessment) -> dict[tuple[int, int], int]:
    """Pair of images → its rung of the unwrapping ladder, from 1."""
    if assessment.unwrapping is None:
        return {}
    return {rung.images: number for number, rung in enumerate(assessment.unwrapping.rungs, 1)}
