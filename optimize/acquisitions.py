"""Several acquisitions of one scene with different baselines, assessed apart and combined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from insar import PhaseModel, combine_acquisitions, height_error_of

from .assessment import (
    Assessment,
    ImagePair,
    assess_placed,
    first_height_error,
    unwrapping_of,
)
from .constraints import Bound, ConstraintReport, FailureLimit
from .population import Population
from .problem import Problem


def assess_acquisitions(
    problem: Problem,
    positions: ArrayLike,
    *,
    labels: Sequence[str],
    names: tuple[str, ...],
    label: str,
) -> tuple[Assessment, tuple[Assessment, ...]]:
    """Assess acquisitions of one scene, together and each by itself.

    Parameters
    ----------
    problem : what they observe, and the limits.
    positions : (A, S, N, 3) — RTN positions at the scene's times, for each acquisition [m].
    labels : what each is called.
    names : name of each satellite.
    label : what the combination is called.

    Returns
    -------
    combined : all acquisitions together; their errors are independent, but for the range error.
        It keeps a limit on baselines if each acquisition does, and one on unwrapping if their
        common ladder does.
    apart : each by itself, in order.

    Raises
    ------
    ValueError
        If a limit is on that needs orbits, or the weighting is of pairs.
    """
    placed = problem.placed(positions)
    apart = tuple(
        assess_placed(problem, one, label=name, names=names)
        for one, name in zip(placed.positions, labels, strict=True)
    )
    models = [
        _single(placed.model, slice(index, index + 1)) for index in range(len(placed.positions))
    ]
    model = combine_acquisitions(models)
    error = height_error_of(model, scene=problem.scene, radar=problem.radar, errors=problem.errors)
    combined = Assessment(
        label=label,
        names=names,
        motion=None,
        scene_positions=placed.positions,
        height_error=first_height_error(error),
        pairs=_pairs(problem, apart),
        unwrapping=unwrapping_of(problem, model),
        constraints=_constraints(problem, placed, model),
        acquisitions=tuple(labels),
    )
    return combined, apart


def image_of(problem: Problem, image: int) -> tuple[int, int]:
    """Acquisition and image of the radar that an image of a combination is.

    The common reference, number 0, is given as image 0 of the first acquisition.

    Parameters
    ----------
    problem : of the combination.
    image : its number, as `insar.combine_acquisitions` orders them.
    """
    others = len(problem.radar.images) - 1
    return ((image - 1) // others, 1 + (image - 1) % others) if image else (0, 0)


def _single(model: PhaseModel, design: slice) -> PhaseModel:
    return PhaseModel(
        vertical_wavenumber=model.vertical_wavenumber[design],
        information=model.information[design],
        nuisance={name: factor[design] for name, factor in model.nuisance.items()},
        pair_variance={name: value[design] for name, value in model.pair_variance.items()},
        scale=model.scale,
    )


def _pairs(problem: Problem, apart: Sequence[Assessment]) -> tuple[ImagePair, ...]:
    """Pairs of all acquisitions, their images numbered through."""
    others = len(problem.radar.images) - 1

    def number(acquisition: int, image: int) -> int:
        return acquisition * others + image if image else 0

    return tuple(
        pair._replace(images=(number(index, pair.images[0]), number(index, pair.images[1])))
        for index, one in enumerate(apart)
        for pair in one.pairs
    )


def _constraints(
    problem: Problem, placed: Population, model: PhaseModel
) -> tuple[ConstraintReport, ...]:
    together = replace(placed, given_model=model)
    reports = []
    for limit in problem.limits:
        population = together if isinstance(limit, FailureLimit) else placed
        values = limit.worst(population)
        worst = values.max() if limit.bound is Bound.AT_MOST else values.min()
        kept = problem.keeps(limit, population)
        reports.append(ConstraintReport(limit, value=float(worst), satisfied=bool(np.all(kept))))
    return tuple(reports)
