"""Printed figures beside what a model computes: whether the one follows from the other."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple


class Verdict(StrEnum):
    """Whether a printed figure follows from the stated inputs."""

    HOLDS = "holds"
    FAILS = "does not hold"
    UNKNOWN = "not computable"
    OPEN = "not determined"
    """What is not published decides: it holds for some of the values that are possible."""


class Relation(StrEnum):
    """How a printed figure limits the computed one."""

    EQUALS = "equals"
    AT_MOST = "at_most"
    AT_LEAST = "at_least"


@dataclass(frozen=True, kw_only=True)
class PrintedFigure:
    """A figure that a source prints.

    Parameters
    ----------
    text : what is claimed.
    printed : how the source prints it, with its unit.
    value : printed figure, SI.
    tolerance : by which the computed figure may miss it, SI.
    relation : how the figure limits the quantity.
    unit : of the claim, as the report shows it; empty for none.
    scale : one such unit, SI.
    note : why, in words.
    fitted : inputs were chosen so that it holds.
    """

    text: str
    printed: str
    value: float
    tolerance: float = 0.0
    relation: Relation = Relation.EQUALS
    unit: str = ""
    scale: float = 1.0
    note: str = ""
    fitted: bool = False


class Claim(NamedTuple):
    """A printed figure and what the stated inputs give.

    Attributes
    ----------
    text : what is claimed.
    printed : how the source prints it, with its unit.
    computed : what the stated inputs give, in the unit of the claim; NaN if not computable.
    unit : its unit; empty for none.
    verdict : by the tolerance that the study states.
    note : why, in words; may be empty.
    least, most : between which the computed figure agrees, by the tolerance, in the unit of the
        claim; infinite where there is no limit.
    lowest, highest : between which the computed figure lies for what the source leaves open, in the
        unit of the claim; NaN where nothing is open.
    fitted : inputs were chosen so that it holds: then its holding confirms nothing.
    """

    text: str
    printed: str
    computed: float
    unit: str
    verdict: Verdict
    note: str
    least: float = -math.inf
    most: float = math.inf
    lowest: float = math.nan
    highest: float = math.nan
    fitted: bool = False


def judged(figure: PrintedFigure, computed: float, *, note: str | None = None) -> Claim:
    """Compare a printed figure with the computed one.

    Parameters
    ----------
    figure : the printed figure.
    computed : scalar — what the inputs give, SI; NaN if it cannot be computed.
    note : why, in words; that of the figure if None.
    """
    least, most = agreeing(figure.value, relation=figure.relation, tolerance=figure.tolerance)
    return Claim(
        text=figure.text,
        printed=figure.printed,
        computed=computed / figure.scale,
        unit=figure.unit,
        verdict=verdict(
            computed, figure.value, relation=figure.relation, tolerance=figure.tolerance
        ),
        note=figure.note if note is None else note,
        least=least / figure.scale,
        most=most / figure.scale,
        fitted=figure.fitted,
    )


def judged_range(figure: PrintedFigure, computed: float, possible: list[float]) -> Claim:
    """Compare a printed figure with the range that the published inputs allow.

    Parameters
    ----------
    figure : the printed figure.
    computed : scalar — what the inputs give as the study assumes them, SI.
    possible : what they give at the ends of what is not published, SI; empty if nothing is open.

    Returns
    -------
    Claim — open where the figure holds in a part of the range only.
    """
    claim = judged(figure, computed)
    known = [value for value in (computed, *possible) if not math.isnan(value)]
    if not possible or not known:
        return claim
    low, high = min(known), max(known)
    least, most = agreeing(figure.value, relation=figure.relation, tolerance=figure.tolerance)
    if least <= low and high <= most:
        found = Verdict.HOLDS
    elif high < least or low > most:
        found = Verdict.FAILS
    else:
        found = Verdict.OPEN
    return claim._replace(verdict=found, lowest=low / figure.scale, highest=high / figure.scale)


def verdict(computed: float, printed: float, *, relation: Relation, tolerance: float) -> Verdict:
    """Whether a computed figure agrees with a printed one, all in one unit.

    Parameters
    ----------
    computed : scalar; NaN if it cannot be computed.
    printed : scalar.
    relation : how the printed figure limits the computed one.
    tolerance : by which the computed one may miss it.
    """
    if math.isnan(computed):
        return Verdict.UNKNOWN
    above = computed - printed
    miss = {Relation.EQUALS: abs(above), Relation.AT_MOST: above, Relation.AT_LEAST: -above}
    return Verdict.HOLDS if miss[relation] <= tolerance else Verdict.FAILS


def agreeing(printed: float, *, relation: Relation, tolerance: float) -> tuple[float, float]:
    """Between which a computed figure agrees with a printed one, all in one unit.

    Parameters
    ----------
    printed : scalar.
    relation : how the printed figure limits the computed one.
    tolerance : by which the computed one may miss it.
    """
    least = -math.inf if relation is Relation.AT_MOST else printed - tolerance
    most = math.inf if relation is Relation.AT_LEAST else printed + tolerance
    return least, most
