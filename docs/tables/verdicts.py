"""Tables of printed figures and their verdicts."""

from __future__ import annotations

import math
from collections.abc import Sequence

from insar import Claim

from .markdown import digits, markdown_table


def verdict_table(claims: Sequence[Claim], computed: str) -> str:
    """Printed figures beside what is computed for them.

    Parameters
    ----------
    claims : judged.
    computed : heading of what is computed.
    """
    rows = []
    for claim in claims:
        fitted = "by construction: inputs were inferred from it. " if claim.fitted else ""
        rows.append(
            [
                claim.text,
                claim.printed,
                _agreeing(claim),
                _with_unit(_number(claim.computed), claim.unit),
                claim.verdict.value,
                f"{fitted}{claim.note}".strip(),
            ]
        )
    return markdown_table(["figure", "printed", "agrees if", computed, "verdict", "why"], rows)


def _agreeing(claim: Claim) -> str:
    least, most = (_with_unit(f"{bound:.9g}", claim.unit) for bound in (claim.least, claim.most))
    if math.isinf(claim.least):
        return f"≤ {most}"
    return f"≥ {least}" if math.isinf(claim.most) else f"{claim.least:.9g} … {most}"


def _number(value: float) -> str:
    """Five digits; what rounding leaves of zero differs between platforms."""
    if abs(value) < 1e-8:
        return "0" if abs(value) < 1e-10 else "below 1e-8"
    return f"{value:.0f}" if abs(value) >= 1e4 else digits(value, 5)


def _with_unit(number: str, unit: str) -> str:
    return f"{number}{unit}" if unit.startswith("°") else f"{number} {unit}".strip()
