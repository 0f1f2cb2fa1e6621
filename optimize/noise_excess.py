"""How far the exact phase noise exceeds its Cramér-Rao bound where it matters for the height."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from insar import PhaseStatistics, pair_efficiency

from .assessment import Assessment
from .problem import Problem

_MATTERS = 0.1
"""Share of the information on the height from which on a pair matters."""

_NOTABLE = 0.95
"""Efficiency below which the difference is worth a word."""


class NoiseExcess(NamedTuple):
    """The pair that matters and whose phase noise exceeds the bound the most.

    Attributes
    ----------
    images : of the pair, as indices into `Radar.images`.
    coherence, looks : of that pair in that segment.
    excess : exact deviation over the Cramér-Rao bound, less 1.
    counted : whether the height error counts it.
    """

    images: tuple[int, int]
    coherence: float
    looks: float
    excess: float
    counted: bool


def noise_excess(problem: Problem, assessment: Assessment) -> NoiseExcess | None:
    """Find where the Cramér-Rao bound is too small by more than 2.6 % in deviation.

    Parameters
    ----------
    problem : the study, with its phase statistics.
    assessment : the formation.

    Returns
    -------
    NoiseExcess — None if no pair that matters has an efficiency below 0.95, or the study states the
    phase noise.
    """
    if problem.errors.phase_std is not None:
        return None
    coherence = np.array([pair.coherence for pair in assessment.pairs])
    looks = np.array([pair.looks for pair in assessment.pairs])
    ambiguity = np.array([pair.height_of_ambiguity for pair in assessment.pairs])
    efficiency = pair_efficiency(coherence, looks)
    contrast = coherence**2 / (1.0 - coherence**2)
    information = efficiency * looks * contrast / ambiguity**2
    total = np.sum(information, axis=0)
    share = information / np.where(total > 0.0, total, 1.0)
    lowest = np.where(share >= _MATTERS, efficiency, 1.0)
    pair, segment = np.unravel_index(np.argmin(lowest), lowest.shape)
    if lowest[pair, segment] >= _NOTABLE:
        return None
    return NoiseExcess(
        images=assessment.pairs[pair].images,
        coherence=float(coherence[pair, segment]),
        looks=float(looks[pair, segment]),
        excess=float(1.0 / np.sqrt(lowest[pair, segment]) - 1.0),
        counted=problem.errors.phase_statistics is PhaseStatistics.EXACT,
    )
