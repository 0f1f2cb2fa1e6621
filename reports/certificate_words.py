"""What is proved of a result, in words."""

from __future__ import annotations

import math

from optimize.certificate import Certificate, Method

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
