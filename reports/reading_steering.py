"""What a report reads out of a study of steering before it words or draws it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from insar.observe import CaseResult, Law, LawCurves

from .steering_words import solved
from .tables_steering import largest

ROUNDING = 1e-6
"""Doppler below which a residual is the rounding of the arithmetic [Hz].

Positions of 4·10⁷ m carry 10⁻⁸ m of rounding in 64 bits, velocities 10⁻¹² m/s: some 10⁻¹⁰ Hz at
centimeter wavelengths, which the intersection with the ellipsoid may raise by orders.
"""


class LawRecord(NamedTuple):
    """The worst of one law over all cases that compare it.

    Attributes
    ----------
    law : which.
    residual : largest Doppler at the boresight [Hz].
    swath, swath_case : largest Doppler at the largest elevation off it [Hz], and where.
    steering, steering_case : largest sum of the steered angles [rad], and where.
    solved : least share of an orbit that has a solution.
    """

    law: Law
    residual: float
    swath: float
    swath_case: str
    steering: float
    steering_case: str
    solved: float


def laws_of(cases: Sequence[CaseResult]) -> tuple[Law, ...]:
    """Laws that any case compares, in the order in which they are defined."""
    found = {curves.law for case in cases for curves in case.curves}
    return tuple(law for law in Law if law in found)


def curves_of(cases: Sequence[CaseResult], law: Law) -> list[tuple[CaseResult, LawCurves]]:
    """Curves of a law in each case that compares it."""
    return [(case, curves) for case in cases for curves in case.curves if curves.law is law]


def steers(curves: LawCurves) -> bool:
    """Whether a law turns the body at all."""
    angles = (curves.yaw, curves.pitch, curves.roll)
    return any(largest(angle) > 0.0 for angle in angles)


def is_exact(curves: LawCurves) -> bool:
    """Whether the Doppler at the boresight is zero wherever the law has a solution."""
    return largest(curves.residual_doppler) < ROUNDING


def exact_laws(cases: Sequence[CaseResult]) -> tuple[Law, ...]:
    """Laws that are exact in every case that compares them."""
    return tuple(
        law
        for law in laws_of(cases)
        if all(is_exact(curves) for _, curves in curves_of(cases, law))
    )


def records(cases: Sequence[CaseResult]) -> tuple[LawRecord, ...]:
    """The worst of each law."""
    return tuple(_record(law, curves_of(cases, law)) for law in laws_of(cases))


def _record(law: Law, found: list[tuple[CaseResult, LawCurves]]) -> LawRecord:
    curves = [one for _, one in found]
    widest = max(found, key=lambda one: _or_zero(_at_edge(*one)))
    steepest = max(found, key=lambda one: _or_zero(largest(one[1].steering_angle)))
    return LawRecord(
        law=law,
        residual=_largest_of(largest(one.residual_doppler) for one in curves),
        swath=_at_edge(*widest),
        swath_case=widest[0].name,
        steering=largest(steepest[1].steering_angle),
        steering_case=steepest[0].name,
        solved=min(solved(one) for one in curves),
    )


def _largest_of(values: Iterable[float]) -> float:
    """Largest of those that are known; NaN if none is."""
    return largest(np.fromiter(values, dtype=np.float64))


def _or_zero(value: float) -> float:
    return value if np.isfinite(value) else 0.0


def _at_edge(case: CaseResult, curves: LawCurves) -> float:
    offsets = np.abs(case.case.swath_offsets)
    if offsets.size == 0:
        return float("nan")
    return largest(curves.swath_doppler[:, np.isclose(offsets, offsets.max())])
