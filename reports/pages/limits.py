"""Limits in words."""

from __future__ import annotations

import math

from optimize import Bound, ConstraintReport, FailureLimit

from ..reading import ACTIVE_MARGIN
from ..wording import MISSING, percent, plain, probability, quantity, significant

_BOUND = {Bound.AT_MOST: "at most", Bound.AT_LEAST: "at least"}


def value_text(report: ConstraintReport) -> str:
    """Value with its unit."""
    if isinstance(report.limit, FailureLimit):
        return probability(report.value)
    return quantity(plain(report.value), report.limit.unit)


def limit_text(report: ConstraintReport) -> str:
    """Limit with its side and unit."""
    limit = report.limit
    return f"{_BOUND[limit.bound]} {quantity(plain(limit.value), limit.unit)}"


def margin_text(report: ConstraintReport) -> str:
    """Margin with its unit, and in per cent of the limit."""
    if not math.isfinite(report.margin):
        return MISSING
    if report.satisfied and abs(report.margin) < 1e-6 * abs(report.limit.value):
        return "0"
    absolute = quantity(significant(report.margin, 3), report.limit.unit)
    relative = abs(report.margin / report.limit.value)
    if isinstance(report.limit, FailureLimit) or not ACTIVE_MARGIN < relative < 10.0:
        return absolute
    return f"{absolute} ({'−' if report.margin < 0.0 else ''}{percent(relative)})"


def shortfall_text(report: ConstraintReport) -> str:
    """By how much a limit is broken, as a sentence."""
    side = "over" if report.limit.bound is Bound.AT_MOST else "short"
    by = quantity(significant(abs(report.margin), 3), report.limit.unit)
    return f"It is {value_text(report)} where {limit_text(report)} is required: {by} {side}."
