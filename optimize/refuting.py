"""Has a simulation try to refute what the error model says of a formation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from insar.simulation import MAX_IMAGES, refute

from .assessment import Assessment
from .problem import Problem


@dataclass(frozen=True, kw_only=True)
class RefutationSettings:
    """How formations are simulated.

    Parameters
    ----------
    samples : pixels drawn in each segment that is simulated.
    prior_height_std : scalar — of the height known beforehand [m].
    """

    samples: int
    prior_height_std: float


def refuted(
    problem: Problem,
    assessments: Sequence[Assessment],
    *,
    settings: RefutationSettings | None,
    seed: int,
) -> tuple[Assessment, ...]:
    """The same assessments with what a simulation says of each.

    Parameters
    ----------
    problem : scene, radar and errors.
    assessments : the formations.
    settings : None to leave them as they are.
    seed : of the random numbers; each formation has its own.

    Returns
    -------
    The assessments in the same order; unchanged where there are too many images to simulate.
    """
    if settings is None or len(problem.radar.images) > MAX_IMAGES:
        return tuple(assessments)
    others = len(problem.radar.images) - 1
    return tuple(
        assessment
        if 1 + others * len(assessment.acquisitions) > MAX_IMAGES
        else replace(
            assessment,
            refutation=refute(
                assessment.scene_positions,
                problem.scene,
                radar=problem.radar,
                errors=problem.errors,
                prior_height_std=settings.prior_height_std,
                samples=settings.samples,
                rng=np.random.default_rng((seed, index)),
                combined=bool(assessment.acquisitions),
            ),
        )
        for index, assessment in enumerate(assessments)
    )
