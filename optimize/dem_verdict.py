"""What elevation model a formation makes: its accuracy, its class, and what would improve it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from insar import Cell, HeightAccuracy, height_accuracy
from insar.dem import (
    Criterion,
    Judgment,
    Resolution,
    Specification,
    judge,
    looks_of_posting,
    posting_of_looks,
)
from insar.dem import Quantity as Demand

from .problem import Problem
from .sensitivity import Quantity, Remedy, Sensitivity, Study, remedies, sensitivities

Array = NDArray[np.float64]

_AGREES = 0.05
"""Share by which stated looks may differ from those of the stated posting."""


@dataclass(frozen=True, kw_only=True)
class DemRequest:
    """What is asked of the elevation model.

    Parameters
    ----------
    posting : scalar — distance of its posts; None: the one that the radar's looks give [m].
    independence : scalar — extent averaged for a post, in postings.
    resolution : of the radar; None if its azimuth resolution is not known.
    cell : what the relative error refers to.
    specifications : the classes that it is judged by.
    """

    posting: float | None = None
    independence: float = 1.0
    resolution: Resolution | None = None
    cell: Cell = field(default_factory=Cell)
    specifications: tuple[Specification, ...] = ()


class FailedDemand(NamedTuple):
    """A demand that is not met, and what would meet it.

    Attributes
    ----------
    specification : name of the class.
    criterion : the demand.
    remedies : item by item; none for the posting, which is a choice.
    """

    specification: str
    criterion: Criterion
    remedies: tuple[Remedy, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class DemVerdict:
    """The elevation model of one formation.

    Attributes
    ----------
    label : of the formation.
    request : what was asked.
    accuracy : relative and absolute height error, of (S,) arrays.
    posting : scalar — asked for, or what the looks give; None if it can't be known [m].
    posting_of_looks : scalar — what the looks give in the worst segment; None if unknown [m].
    judgments : by the classes.
    failed : every demand that is not met.
    sensitivities : elasticities of the errors, item by item.
    notes : what a reader must know of posting and classes.
    """

    label: str
    request: DemRequest
    accuracy: HeightAccuracy
    posting: float | None
    posting_of_looks: float | None
    judgments: tuple[Judgment, ...]
    failed: tuple[FailedDemand, ...]
    sensitivities: tuple[Sensitivity, ...]
    notes: tuple[str, ...]


def dem_verdict(
    problem: Problem,
    positions: ArrayLike,
    *,
    label: str,
    request: DemRequest,
    combined: bool = False,
) -> DemVerdict:
    """Judge the elevation model of a formation.

    Parameters
    ----------
    problem : scene, radar, errors and limits.
    positions : (S, N, 3) — of the formation, RTN at the scene's times [m]; (A, S, N, 3) of
        acquisitions that are combined.
    label : what it is called in the report.
    request : what is asked of the model.
    combined : whether the positions are of several acquisitions.

    Returns
    -------
    DemVerdict
    """
    place, scene = np.asarray(positions, dtype=np.float64), problem.scene
    accuracy = height_accuracy(
        place,
        scene,
        radar=problem.radar,
        errors=problem.errors,
        cell=request.cell,
        combined=combined,
    )
    given = _posting_of_looks(problem, request)
    posting = given if request.posting is None else request.posting
    judgments = tuple(
        judge(accuracy, specification, slope=scene.slope, posting=posting)
        for specification in request.specifications
    )
    study = Study(problem=problem, positions=place, cell=request.cell, combined=combined)
    return DemVerdict(
        label=label,
        request=request,
        accuracy=accuracy,
        posting=posting,
        posting_of_looks=given,
        judgments=judgments,
        failed=_failed(study, judgments),
        sensitivities=sensitivities(study),
        notes=_notes(problem, request, posting),
    )


def looks_for(request: DemRequest, *, incidence: ArrayLike, slope: ArrayLike) -> float:
    """Looks of the posting that is asked for, in the segment that has the fewest.

    Parameters
    ----------
    request : with posting and resolution.
    incidence, slope : (S,) — of the scene [rad].

    Raises
    ------
    ValueError
        If posting or resolution are not given, or a post is smaller than a resolution cell.
    """
    if request.posting is None or request.resolution is None:
        raise ValueError("posting and azimuth resolution are needed to know the looks")
    looks = looks_of_posting(
        request.posting,
        resolution=request.resolution,
        local_incidence=np.asarray(incidence) - np.asarray(slope),
        independence=request.independence,
    )
    fewest = float(looks.min())
    if fewest < 1.0:
        least = request.posting / np.sqrt(fewest)
        raise ValueError(
            f"posting = {request.posting:g} m is finer than the radar resolves, {fewest:.2g} looks"
            f"; take at least {least:.3g} m, or a finer resolution"
        )
    return fewest


def _posting_of_looks(problem: Problem, request: DemRequest) -> float | None:
    if request.resolution is None:
        return None
    posting = posting_of_looks(
        problem.radar.looks,
        resolution=request.resolution,
        local_incidence=problem.scene.incidence - problem.scene.slope,
        independence=request.independence,
    )
    return float(posting.max())


def _failed(study: Study, judgments: tuple[Judgment, ...]) -> tuple[FailedDemand, ...]:
    found = []
    for judgment in judgments:
        for criterion in judgment.criteria:
            if criterion.passed:
                continue
            tried: tuple[Remedy, ...] = ()
            if np.isfinite(criterion.value):
                limit = _limits(study, judgment.specification, criterion.quantity)
                tried = (
                    ()
                    if limit is None
                    else remedies(study, Quantity(criterion.quantity.value), limit)
                )
            found.append(FailedDemand(judgment.specification.name, criterion, tried))
    return tuple(found)


def _limits(study: Study, specification: Specification, demand: Demand) -> Array | float | None:
    if demand is Demand.RELATIVE:
        return specification.relative_limit(study.problem.scene.slope)
    return specification.absolute_90 if demand is Demand.ABSOLUTE else None


def _notes(problem: Problem, request: DemRequest, posting: float | None) -> tuple[str, ...]:
    notes = []
    if posting is None and any(one.posting is not None for one in request.specifications):
        notes.append(
            "The posting is not judged: the study gives neither dem.posting_m nor "
            "radar.azimuth_resolution_m."
        )
    if request.posting is not None and request.resolution is not None:
        looks = float(
            looks_of_posting(
                request.posting,
                resolution=request.resolution,
                local_incidence=problem.scene.incidence - problem.scene.slope,
                independence=request.independence,
            ).min()
        )
        if abs(problem.radar.looks / looks - 1.0) > _AGREES:
            notes.append(
                f"The study's {problem.radar.looks:.3g} looks are not those of its posting: posts "
                f"of {request.posting:g} m average {looks:.3g} independent looks."
            )
    elif request.posting is not None:
        notes.append(
            f"Whether {problem.radar.looks:.3g} looks fit a posting of {request.posting:g} m was "
            "not checked: the study gives no radar.azimuth_resolution_m."
        )
    unconfirmed = [one.name for one in request.specifications if not one.confirmed]
    if unconfirmed:
        notes.append(
            f"The values of {' and '.join(unconfirmed)} are quoted from the literature and are not "
            "confirmed by a standard."
        )
    return tuple(notes)
