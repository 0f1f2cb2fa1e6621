"""Printed figures against what the stated inputs give."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from ...claims import Claim, PrintedFigure, judged
from ..steering import Law, Outcome
from .claim_reasons import why_no_crossover, why_outside, why_unsolved
from .compensation import deviation
from .results import (
    CaseResult,
    Compensation,
    Effect,
    Held,
    LawCurves,
    Selection,
)

Array = NDArray[np.float64]


class Quantity(StrEnum):
    """What a printed figure is about; largest values are over all samples of a case."""

    LARGEST_YAW = "largest_yaw"
    LARGEST_PITCH = "largest_pitch"
    LARGEST_ROLL = "largest_roll"
    LARGEST_ANGLE = "largest_angle"
    """The larger of the two angles that a law steers."""
    LARGEST_RESIDUAL_DOPPLER = "largest_residual_doppler"
    """At the boresight; of the law `none`, the Doppler centroid of the unsteered radar."""
    LARGEST_SWATH_DOPPLER = "largest_swath_doppler"
    SLEW_TIME = "slew_time"
    """To turn by the largest angle at `rate`."""
    SLEW_RATIO = "slew_ratio"
    """Largest angle of `law` over that of `other_law`: the ratio of their slew times too."""
    RATE_RATIO = "rate_ratio"
    """Largest rate of a steered angle, of `law` over `other_law`."""
    CROSSOVER_ALTITUDE = "crossover_altitude"
    """Where yaw-pitch and pitch-roll steer the same total angle, at `held` and `inclination`."""
    ELLIPSOID_EFFECT = "ellipsoid_effect"
    """Largest change of the range rate by the Earth's figure alone."""
    COMPENSATION = "compensation"
    """Part of the Doppler that the simplified yaw takes away, in the maximum norm."""
    DEVIATION_SLOPE = "deviation_slope"
    """Largest deviation of the simplified range rate per unit of eccentricity."""


@dataclass(frozen=True, kw_only=True)
class ClaimSpec(PrintedFigure):
    """A printed figure of steering, and what to compute for it.

    Parameters
    ----------
    quantity : what to compute.
    case : name of the case, for the quantities of a case.
    law, other_law : steering laws, for the quantities that need them.
    rate : slew rate, for `SLEW_TIME` [rad/s].
    held, inclination : of the selection, for `CROSSOVER_ALTITUDE` [-, rad].
    effect, argument_of_perigee : for `COMPENSATION`; the worst of all arguments if None [-, rad].
    eccentricity : for `COMPENSATION`, instead of the effect: where to read the sweep.

    Raises
    ------
    ValueError
        If something that the quantity needs is missing.
    """

    quantity: Quantity
    case: str | None = None
    law: Law | None = None
    other_law: Law | None = None
    rate: float | None = None
    held: Held | None = None
    inclination: float | None = None
    effect: Effect | None = None
    eccentricity: float | None = None
    argument_of_perigee: float | None = None

    def __post_init__(self) -> None:
        if self.quantity is Quantity.COMPENSATION:
            given = (self.effect is not None) + (self.eccentricity is not None)
            if given != 1:
                raise ValueError("a claim of compensation needs either effect or eccentricity")
        for name in NEEDS[self.quantity]:
            if getattr(self, name) is None:
                raise ValueError(f"a claim of {self.quantity.value} needs {name}; give it")


_LAW = ("case", "law")
NEEDS: dict[Quantity, tuple[str, ...]] = {
    Quantity.LARGEST_YAW: _LAW,
    Quantity.LARGEST_PITCH: _LAW,
    Quantity.LARGEST_ROLL: _LAW,
    Quantity.LARGEST_ANGLE: _LAW,
    Quantity.LARGEST_RESIDUAL_DOPPLER: _LAW,
    Quantity.LARGEST_SWATH_DOPPLER: _LAW,
    Quantity.SLEW_TIME: (*_LAW, "rate"),
    Quantity.SLEW_RATIO: (*_LAW, "other_law"),
    Quantity.RATE_RATIO: (*_LAW, "other_law"),
    Quantity.CROSSOVER_ALTITUDE: ("held", "inclination"),
    Quantity.ELLIPSOID_EFFECT: (),
    Quantity.COMPENSATION: (),
    Quantity.DEVIATION_SLOPE: (),
}
"""What a claim must say besides its value; `COMPENSATION` needs one of effect and eccentricity."""


def judge(
    claim: ClaimSpec,
    *,
    cases: Sequence[CaseResult] = (),
    selections: Sequence[Selection] = (),
    compensation: Compensation | None = None,
) -> Claim:
    """Compute what a claim is about, and say whether it holds.

    Parameters
    ----------
    claim : the printed figure.
    cases, selections, compensation : what the study has computed.

    Returns
    -------
    Claim — not computable if a law has no solution somewhere on the orbit, or if the steering
    angles do not cross in the selection's range; its note then says why.

    Raises
    ------
    ValueError
        If the claim is about a case, law, selection or compensation that is not there.
    """
    if claim.quantity in _OF_LAW:
        value = _of_case(claim, cases)
    elif claim.quantity is Quantity.CROSSOVER_ALTITUDE:
        value = _crossover(claim, selections)
    elif compensation is None:
        raise ValueError(f"the claim {claim.text!r} needs a compensation; add one to the study")
    else:
        value = _of_compensation(claim, compensation)
    note = claim.note
    if math.isnan(value):
        reason = _reason(claim, cases, selections, compensation)
        note = f"{reason} {note}".strip()
    return judged(claim, value, note=note)


def _reason(
    claim: ClaimSpec,
    cases: Sequence[CaseResult],
    selections: Sequence[Selection],
    compensation: Compensation | None,
) -> str:
    """Why a claim cannot be computed."""
    if claim.quantity in _OF_LAW:
        used = [_curves(claim, cases, law) for law in (claim.law, claim.other_law) if law]
        unsolved = [curves for curves in used if np.any(curves.outcome != Outcome.SOLVED)]
        return why_unsolved((unsolved or used)[0])
    if claim.quantity is Quantity.CROSSOVER_ALTITUDE:
        return why_no_crossover(*_selected(claim, selections))
    if compensation is None or claim.eccentricity is None:
        return ""
    return why_outside(claim.eccentricity, compensation)


# -- of a case -----------------------------------------------------------------------------------


def largest_angle(curves: LawCurves) -> float:
    """Larger of the steered angles over the samples [rad]; NaN if a sample has no solution."""
    return _largest(np.stack([curves.yaw, curves.pitch, curves.roll]))


def angle_rates(curves: LawCurves) -> Array:
    """Rates of yaw, pitch and roll themselves, (3, S) [rad/s].

    From the angular velocity (p, q, r) of the body against the orbit frame.
    """
    p, q, r = np.moveaxis(curves.rate_orbit, -1, 0)
    sine, cosine = np.sin(curves.roll), np.cos(curves.roll)
    yaw = (q * sine + r * cosine) / np.cos(curves.pitch)
    pitch = q * cosine - r * sine
    return np.stack([yaw, pitch, p + yaw * np.sin(curves.pitch)])


def largest_rate(curves: LawCurves) -> float:
    """Largest rate of a steered angle [rad/s]; NaN if a sample has no solution."""
    return _largest(angle_rates(curves))


def _largest(values: Array) -> float:
    """Largest magnitude; NaN if there is a NaN."""
    return float(np.abs(values).max())


_OF_LAW: dict[Quantity, Callable[[LawCurves], float]] = {
    Quantity.LARGEST_YAW: lambda curves: _largest(curves.yaw),
    Quantity.LARGEST_PITCH: lambda curves: _largest(curves.pitch),
    Quantity.LARGEST_ROLL: lambda curves: _largest(curves.roll),
    Quantity.LARGEST_ANGLE: largest_angle,
    Quantity.LARGEST_RESIDUAL_DOPPLER: lambda curves: _largest(curves.residual_doppler),
    Quantity.LARGEST_SWATH_DOPPLER: lambda curves: _largest(curves.swath_doppler),
    Quantity.SLEW_TIME: largest_angle,
    Quantity.SLEW_RATIO: largest_angle,
    Quantity.RATE_RATIO: largest_rate,
}
"""What is measured on the curves of a law; times and ratios divide it."""


def _of_case(claim: ClaimSpec, cases: Sequence[CaseResult]) -> float:
    measure = _OF_LAW[claim.quantity]
    value = measure(_curves(claim, cases, claim.law))
    if claim.quantity is Quantity.SLEW_TIME and claim.rate is not None:
        return value / claim.rate
    if claim.quantity in (Quantity.SLEW_RATIO, Quantity.RATE_RATIO):
        return value / measure(_curves(claim, cases, claim.other_law))
    return value


def _curves(claim: ClaimSpec, cases: Sequence[CaseResult], law: Law | None) -> LawCurves:
    for case in cases:
        for curves in case.curves:
            if case.name == claim.case and curves.law is law:
                return curves
    raise ValueError(
        f"the claim {claim.text!r} is about the law {law!r} in the case {claim.case!r}, which was "
        "not assessed; correct the names, or add the law to the case"
    )


# -- of a selection ------------------------------------------------------------------------------


def _crossover(claim: ClaimSpec, selections: Sequence[Selection]) -> float:
    """Crossover nearest to the printed one; NaN if there is none."""
    selection, row = _selected(claim, selections)
    found = selection.crossovers[row]
    return min(found, key=lambda altitude: abs(altitude - claim.value), default=math.nan)


def _selected(claim: ClaimSpec, selections: Sequence[Selection]) -> tuple[Selection, int]:
    """Selection that a claim is about, and the row of its inclination."""
    for selection in selections:
        for row, inclination in enumerate(selection.inclinations):
            if selection.held is claim.held and _same(inclination, claim.inclination):
                return selection, row
    raise ValueError(
        f"no selection has what the claim {claim.text!r} is about: held = {claim.held!r}, "
        f"inclination = {claim.inclination!r} rad; add it to the study"
    )


# -- of a compensation ---------------------------------------------------------------------------


def _of_compensation(claim: ClaimSpec, found: Compensation) -> float:
    if claim.quantity is Quantity.DEVIATION_SLOPE:
        e = found.eccentricities
        return float(e @ found.sweep_deviation / (e @ e))  # the least-squares line through 0
    if claim.quantity is Quantity.ELLIPSOID_EFFECT:
        return max(deviation(each) for each in found.curves if each.effect is Effect.EARTH_SHAPE)
    if claim.eccentricity is not None:
        return _swept(claim.eccentricity, found)
    return _under_effect(claim, found)


def _swept(eccentricity: float, found: Compensation) -> float:
    """Compensation at an eccentricity of the sweep; NaN outside it."""
    e = found.eccentricities
    return float(np.interp(eccentricity, e, found.sweep, left=np.nan, right=np.nan))


def _under_effect(claim: ClaimSpec, found: Compensation) -> float:
    """Compensation under an effect, the worst of the arguments of perigee if none is named."""
    perigee = claim.argument_of_perigee
    values = [
        curve.compensation
        for curve in found.curves
        if curve.effect is claim.effect
        and (perigee is None or _same(curve.argument_of_perigee, perigee))
    ]
    if not values:
        raise ValueError(
            f"the compensation has no curve for the claim {claim.text!r}: effect = "
            f"{claim.effect!r}, argument_of_perigee = {perigee!r} rad; add the argument"
        )
    return min(values)


def _same(angle: float, other: float | None) -> bool:
    """Whether two angles were meant to be the same, but for rounding."""
    return other is not None and abs(angle - other) < 1e-9
