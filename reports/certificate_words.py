"""What is proved of a result, in words."""

from __future__ import annotations

import math

from optimize.certificate import Certificate, Method, Relief, TargetVerdict

from .document import Strong, Text
from .wording import fixed, meters, significant

METHODS = {
    Method.CLOSED_FORM: "largest scatter, closed form",
    Method.SEMIDEFINITE: "semidefinite program",
    Method.ONE_SHOT: "tangent at the design and the farthest scatter",
    Method.SEPARABLE: "sum over single satellites along the line of the baselines",
    Method.BRANCH_AND_BOUND: "branch and bound over projected baselines",
}

_CLOSE = 0.01
"""Gap up to which a result is called the best there is, within it."""


def gap_text(gap: float) -> str:
    """A gap as a share, with the digits that it has: 0.05 %, 3.4 %, below 0.001 %."""
    share = 100.0 * gap
    if share < 1e-3:
        return "0.001 %"
    return f"{significant(share, 2)} %" if share < 10.0 else f"{fixed(share, 0)} %"


def is_close(certificate: Certificate) -> bool:
    """Whether the proof says that hardly anything is left to gain."""
    return math.isfinite(certificate.gap) and certificate.gap <= _CLOSE


def verdict_text(certificate: Certificate | None, reason: str) -> Text:
    """How far from the best possible the result is, in one sentence."""
    if certificate is None:
        return f"How far it is from the best possible is not proven: {reason}."
    if certificate.strongest is None:
        return "How far it is from the best possible is not known: no bound applies."
    bound = meters(certificate.lower_bound, 4)
    if not math.isfinite(certificate.gap):
        return (
            f"No formation within these limits has an error below {bound}, proven; "
            "whether there is one is not known."
        )
    if is_close(certificate):
        return (
            Strong(f"Within {gap_text(certificate.gap)} of the best possible, proven: "),
            f"no formation of these satellites within these limits has an error below {bound}.",
        )
    return (
        Strong(f"No formation within these limits has an error below {bound}, proven. "),
        f"This one is {gap_text(certificate.gap)} above that; how much of the difference can be "
        "gained is not known.",
    )


def target_text(target: TargetVerdict) -> Text:
    """Whether the height error that is wanted is reached, or can be."""
    wanted = f"The target of {meters(target.height_error, 4)}"
    if target.reached:
        return (Strong(f"{wanted} is reached."),)
    if target.impossible is None:
        return (
            Strong(f"{wanted} is not reached; "),
            "whether another formation reaches it is not known.",
        )
    helps = [
        f"{relief.name} {relief_value(relief, relief.passes_at)}"
        for relief in target.impossible.reliefs
        if math.isfinite(relief.passes_at)
    ]
    enough = f" Enough alone: {', or '.join(helps)}." if helps else ""
    return (Strong(f"{wanted} can't be reached, proven. "), target.impossible.statement, enough)


def relief_value(relief: Relief, value: float) -> str:
    """A value of a limit or an error, with its unit."""
    return meters(value, 3) if relief.unit == "m" else f"{value:.4g} {relief.unit}".rstrip()
