"""Results of the studies that score formations."""

from __future__ import annotations

from dataclasses import dataclass

from insar import Claim

from .assessment import Assessment
from .certificate import Certificate
from .claims import OpenNumber
from .dem_verdict import DemVerdict
from .problem import Problem
from .search import SearchResult


@dataclass(frozen=True, kw_only=True, eq=False)
class OptimizeResult:
    """Result of a study of kind `optimize`.

    Attributes
    ----------
    problem : what was minimized, with scene, radar, errors and limits.
    critical_baseline : scalar — the smallest over the segments [m].
    initial : the formation given, or satellites equally spaced on the largest allowed orbit.
    best : the formation found; of the least violation where none is feasible.
    compare : other formations, assessed in the same way.
    search : how it was found.
    notices : why the result is not what was asked for: nothing feasible, or interrupted.
    warnings : what a reader must know before using the result.
    dem : the elevation model of the formation, and what limits it.
    certificate : how far from the best possible it is at most; None where it was not proved.
    certificate_reason : why it was not; empty where it was.
    """

    problem: Problem
    critical_baseline: float
    initial: Assessment
    best: Assessment
    compare: tuple[Assessment, ...]
    search: SearchResult
    notices: tuple[str, ...]
    warnings: tuple[str, ...]
    dem: DemVerdict | None = None
    certificate: Certificate | None = None
    certificate_reason: str = "it was not tried"


@dataclass(frozen=True, kw_only=True, eq=False)
class EvaluateResult:
    """Result of a study of kind `evaluate`: a given formation, not searched.

    Attributes
    ----------
    problem : scene, radar, errors and limits.
    critical_baseline : scalar — the smallest over the segments [m].
    formation : the formation given; its acquisitions combined where there are several.
    acquisitions : each by itself; empty for a formation that acquires once.
    compare : other formations, assessed in the same way.
    claims : printed figures and their verdicts.
    opened : what the source of the claims does not publish.
    warnings : what a reader must know before using the result.
    dem : the elevation model of the formation, and what limits it.
    """

    problem: Problem
    critical_baseline: float
    formation: Assessment
    compare: tuple[Assessment, ...]
    warnings: tuple[str, ...]
    dem: DemVerdict | None = None
    acquisitions: tuple[Assessment, ...] = ()
    claims: tuple[Claim, ...] = ()
    opened: tuple[OpenNumber, ...] = ()
