"""Figures that missions print, computed from a formation that was assessed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import Cell, HeightAccuracy, PrintedFigure, height_accuracy
from insar.atmosphere import tropospheric_height_error

from .assessment import Assessment, ImagePair
from .problem import Problem

Array = NDArray[np.float64]

ZENITH_DELAY = 2.4
"""One-way delay of a vertical ray by the whole troposphere, at sea level [m]."""


class FormationQuantity(StrEnum):
    """What a printed figure of a mission is about."""

    HEIGHT_OF_AMBIGUITY = "height_of_ambiguity"
    PERPENDICULAR_BASELINE = "perpendicular_baseline"
    """Its magnitude."""
    CRITICAL_BASELINE = "critical_baseline"
    """Of the pair: what its perpendicular baseline is a part of."""
    BASELINE_FRACTION = "baseline_fraction"
    """Perpendicular over critical baseline."""
    COHERENCE = "coherence"
    """Of the pair."""
    HEIGHT_PER_BASELINE_ERROR = "height_per_baseline_error"
    """Height error for each meter of baseline error along the line of sight: HoA/λ."""
    TILT_PER_BASELINE_ERROR = "tilt_per_baseline_error"
    """Slope of the height error in range for each meter of baseline error: 1/B⊥ [rad/m]."""
    HEIGHT_ERROR = "height_error"
    """Total, one standard deviation."""
    RELATIVE_ERROR = "relative_error"
    """From pixel to pixel, one standard deviation."""
    ABSOLUTE_ERROR_90 = "absolute_error_90"
    """Absolute height error at 90 %, after the calibration of the budget (`insar.accuracy`)."""
    RELATIVE_ERROR_90 = "relative_error_90"
    """Of the difference of two points in a cell, at 90 %: noise, and what tilts over the cell."""
    RANDOM_ERROR_90 = "random_error_90"
    """The same of noise alone."""
    UNCORRECTED_TROPOSPHERE = "uncorrected_troposphere"
    """Height bias by a zenith delay of 2.4 m that nobody corrects, whatever the baseline."""
    UNWRAPPING_PROBABILITY = "unwrapping_probability"
    BASELINE_STEADINESS = "baseline_steadiness"
    """Of the longest perpendicular baseline over the segments: half the difference of its largest
    and smallest over their mean."""

    @property
    def of_pair(self) -> bool:
        """Whether a pair has it, not the formation."""
        return self in _OF_PAIR


class OpenNumber(NamedTuple):
    """A number that the source of printed figures leaves open.

    Attributes
    ----------
    name : key of the study, with its unit.
    least, most : between which it may lie, in the unit of the key.
    why : where these come from, in words.
    """

    name: str
    least: float
    most: float
    why: str


class Over(StrEnum):
    """How the segments of the scene become one figure."""

    MEAN = "mean"
    RMS = "rms"
    SMALLEST = "smallest"
    LARGEST = "largest"
    RANGE = "range"
    """Their mean, and what is possible from the smallest to the largest: where the source does not
    say which segment it means."""


_REDUCE: dict[Over, Callable[[Array], float]] = {
    Over.MEAN: lambda values: float(np.mean(values)),
    Over.RMS: lambda values: float(np.sqrt(np.mean(values**2))),
    Over.SMALLEST: lambda values: float(np.min(values)),
    Over.LARGEST: lambda values: float(np.max(values)),
    Over.RANGE: lambda values: float(np.mean(values)),
}

_OF_PAIR: dict[FormationQuantity, Callable[[Problem, ImagePair], Array]] = {
    FormationQuantity.HEIGHT_OF_AMBIGUITY: lambda _, pair: pair.height_of_ambiguity,
    FormationQuantity.PERPENDICULAR_BASELINE: lambda _, pair: np.abs(pair.perpendicular_baseline),
    FormationQuantity.CRITICAL_BASELINE: lambda _, pair: (
        np.abs(pair.perpendicular_baseline) / pair.baseline_over_critical
    ),
    FormationQuantity.BASELINE_FRACTION: lambda _, pair: pair.baseline_over_critical,
    FormationQuantity.COHERENCE: lambda _, pair: pair.coherence,
    FormationQuantity.HEIGHT_PER_BASELINE_ERROR: lambda problem, pair: (
        pair.height_of_ambiguity / problem.radar.wavelength
    ),
    FormationQuantity.TILT_PER_BASELINE_ERROR: lambda _, pair: (
        1.0 / np.abs(pair.perpendicular_baseline)
    ),
}


@dataclass(frozen=True, kw_only=True)
class FormationClaim(PrintedFigure):
    """A printed figure of a mission, and what to compute for it.

    Parameters
    ----------
    quantity : what to compute.
    formation : label of the formation or acquisition; the formation of the study if None.
    pair : names of the two satellites whose images make the pair, for a quantity of a pair; the
        first pair if None.
    segment : 0-based; all segments if None.
    over : how all segments become one figure.
    """

    quantity: FormationQuantity
    formation: str | None = None
    pair: tuple[str, str] | None = None
    segment: int | None = None
    over: Over = Over.MEAN


def measure(
    claim: FormationClaim, problem: Problem, assessments: Sequence[Assessment], *, cell: Cell
) -> float:
    """Compute what a printed figure is about; the first of `possible`.

    Parameters
    ----------
    claim : the printed figure.
    problem : scene, radar, errors and limits.
    assessments : the formation of the study first, then all others that a claim may name.
    cell : what a relative error refers to.

    Returns
    -------
    Scalar, SI — NaN where nothing is measured, or the unwrapping was not assessed.

    Raises
    ------
    ValueError
        If the claim is about a formation or a pair that is not there.
    """
    return possible(claim, problem, assessments, cell=cell)[0]


def possible(
    claim: FormationClaim, problem: Problem, assessments: Sequence[Assessment], *, cell: Cell
) -> tuple[float, ...]:
    """All that a printed figure may be about: one value, and the ends of a range over the segments.

    Parameters
    ----------
    claim, problem, assessments, cell : as for `measure`.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        values = _values(claim, problem, _named(claim, assessments), cell)
    if claim.segment is not None:
        found = [float(values[claim.segment])]
    else:
        found = [_REDUCE[claim.over](values)]
        if claim.over is Over.RANGE:
            found += [float(values.min()), float(values.max())]
    return tuple(value if math.isfinite(value) else math.nan for value in found)


def _named(claim: FormationClaim, assessments: Sequence[Assessment]) -> Assessment:
    if claim.formation is None:
        return assessments[0]
    for one in assessments:
        if one.label == claim.formation:
            return one
    raise ValueError(
        f"the claim {claim.text!r} is about the formation {claim.formation!r}, which is not one of "
        f"{', '.join(repr(one.label) for one in assessments)}; correct the name"
    )


def _values(claim: FormationClaim, problem: Problem, one: Assessment, cell: Cell) -> Array:
    """The quantity in every segment, (S,)."""
    error = one.height_error
    if claim.quantity.of_pair:
        return _OF_PAIR[claim.quantity](problem, _pair(claim, problem, one))
    if claim.quantity is FormationQuantity.UNWRAPPING_PROBABILITY:
        unwrapping = one.unwrapping
        return np.full(len(problem.scene), np.nan) if unwrapping is None else unwrapping.probability
    if claim.quantity is FormationQuantity.BASELINE_STEADINESS:
        return np.full(len(problem.scene), _steadiness(one))
    if claim.quantity is FormationQuantity.UNCORRECTED_TROPOSPHERE:
        return tropospheric_height_error(ZENITH_DELAY, incidence=problem.scene.incidence)
    if claim.quantity is FormationQuantity.HEIGHT_ERROR:
        return error.total
    if claim.quantity is FormationQuantity.RELATIVE_ERROR:
        return error.relative
    accuracy = accuracy_of(problem, one, cell)
    return {
        FormationQuantity.ABSOLUTE_ERROR_90: accuracy.absolute_90,
        FormationQuantity.RELATIVE_ERROR_90: accuracy.relative_90,
        FormationQuantity.RANDOM_ERROR_90: accuracy.random_pair_90,
    }[claim.quantity]


def accuracy_of(problem: Problem, one: Assessment, cell: Cell) -> HeightAccuracy:
    """Relative and absolute height error of a formation, or of its acquisitions combined.

    Parameters
    ----------
    problem : scene, radar, errors and limits.
    one : the formation.
    cell : what a relative error refers to.
    """
    return height_accuracy(
        one.scene_positions,
        problem.scene,
        radar=problem.radar,
        errors=problem.errors,
        cell=cell,
        combined=bool(one.acquisitions),
    )


def _steadiness(one: Assessment) -> float:
    longest = np.max([np.abs(pair.perpendicular_baseline) for pair in one.pairs], axis=0)
    return float((longest.max() - longest.min()) / (longest.max() + longest.min()))


def _pair(claim: FormationClaim, problem: Problem, one: Assessment) -> ImagePair:
    if claim.pair is None:
        return one.pairs[0]
    wanted = {one.names.index(name) for name in claim.pair if name in one.names}
    matrix = problem.radar.incidence_matrix
    for pair, (first, second) in zip(one.pairs, problem.radar.image_pairs, strict=False):
        if set(np.flatnonzero(matrix[first] != matrix[second]).tolist()) == wanted:
            return pair
    raise ValueError(
        f"the claim {claim.text!r} is about the pair {' and '.join(claim.pair)}, between which no "
        "two images lie; correct the names"
    )
