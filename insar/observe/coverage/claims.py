"""Printed figures of coverage against what the stated inputs give."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from ...claims import Claim, PrintedFigure, judged
from .results import CoverageResult


class CoverageQuantity(StrEnum):
    """What a printed figure is about; those of the sizing and its long-run cover of one latitude.

    The cover is a share of time, with the largest incidence alone or with all reasons.
    """

    PLANES = "planes"
    SATELLITES_PER_PLANE = "satellites_per_plane"
    SATELLITES = "satellites"
    SIZED_COVER = "sized_cover"
    SIZED_COVER_ALL = "sized_cover_all"
    SMALLEST = "smallest"
    """Satellites of the smallest constellation with continuous cover that was found."""


@dataclass(frozen=True, kw_only=True)
class CoverageClaim(PrintedFigure):
    """A printed figure, and what to compute for it.

    Parameters
    ----------
    quantity : what to compute.
    """

    quantity: CoverageQuantity


def judge_coverage(claim: CoverageClaim, result: CoverageResult) -> Claim:
    """Compute what a claim is about, and say whether it holds.

    Parameters
    ----------
    claim : the printed figure.
    result : of the study.

    Returns
    -------
    Claim — not computable if the study sizes nothing, or finds nothing.
    """
    return judged(claim, _MEASURES[claim.quantity](result))


def _of_sizing(name: str) -> Callable[[CoverageResult], float]:
    def measure(result: CoverageResult) -> float:
        return (
            math.nan if result.shortfall is None else float(getattr(result.shortfall.sizing, name))
        )

    return measure


def _of_shortfall(name: str) -> Callable[[CoverageResult], float]:
    def measure(result: CoverageResult) -> float:
        return math.nan if result.shortfall is None else float(getattr(result.shortfall, name))

    return measure


def _smallest(result: CoverageResult) -> float:
    search = result.search
    return math.nan if search is None or search.best is None else float(search.best.total)


_MEASURES: dict[CoverageQuantity, Callable[[CoverageResult], float]] = {
    CoverageQuantity.PLANES: _of_sizing("planes"),
    CoverageQuantity.SATELLITES_PER_PLANE: _of_sizing("satellites_per_plane"),
    CoverageQuantity.SATELLITES: _of_sizing("total"),
    CoverageQuantity.SIZED_COVER: _of_shortfall("spacing"),
    CoverageQuantity.SIZED_COVER_ALL: _of_shortfall("all_reasons"),
    CoverageQuantity.SMALLEST: _smallest,
}
