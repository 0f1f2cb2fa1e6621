"""Printed figures beside what the inputs of a study give."""

from __future__ import annotations

import math
from collections.abc import Sequence

from insar import Claim, Verdict

from ..document import Column, Section, Status, Strong, Table, Text
from ..reading_steering import ROUNDING
from ..tables_steering import claims_frame
from ..wording import MISSING, counted, plain, quantity, significant

_MARKS = {
    Verdict.HOLDS: Status.NOTE,
    Verdict.FAILS: Status.BAD,
    Verdict.UNKNOWN: Status.WARNING,
    Verdict.OPEN: Status.WARNING,
}
_SYMBOLS = {Verdict.HOLDS: "✓", Verdict.FAILS: "✗", Verdict.UNKNOWN: "?", Verdict.OPEN: "~"}


def claims_section(claims: Sequence[Claim], inputs: str, *, digits: int = 3) -> Section | None:
    """Table of printed figures; None without any.

    Parameters
    ----------
    claims : judged.
    inputs : which the figures are computed from, such as "stated inputs".
    digits : significant, of what is computed.
    """
    if not claims:
        return None
    frame = claims_frame(claims)
    frame["computed"] = [_with_unit(claim.computed, claim.unit, digits) for claim in claims]
    frame["possible"] = [_possible(claim, digits) for claim in claims]
    frame["agrees"] = [_agreeing(claim) for claim in claims]
    frame["verdict"] = [f"{_mark(claim)} {claim.verdict.value}" for claim in claims]
    return Section(
        "claims",
        f"Printed figures and what the {inputs} give",
        (
            Table(
                frame,
                (
                    Column("text", "Figure"),
                    Column("printed", "Printed"),
                    Column("agrees", "Agrees if"),
                    Column("computed", f"From the {inputs}", "", list),
                    *_possible_column(claims),
                    Column("verdict", "Verdict"),
                ),
                "Each printed figure, the same quantity computed from the "
                f"{inputs}, and whether the one follows from the other: whether the computed "
                "figure lies within what the study grants the printed one.",
                tuple(_MARKS[claim.verdict] for claim in claims),
                tuple(_why(claim) for claim in claims),
            ),
        ),
    )


def _mark(claim: Claim) -> str:
    """Symbol of the verdict; a figure that holds by construction gets no tick."""
    return "∘" if claim.fitted and claim.verdict is Verdict.HOLDS else _SYMBOLS[claim.verdict]


def _agreeing(claim: Claim) -> str:
    """What the computed figure must be, by the tolerance."""
    least, most = (_with(plain(bound), claim.unit) for bound in (claim.least, claim.most))
    if math.isinf(claim.least):
        return MISSING if math.isinf(claim.most) else f"≤ {most}"
    if math.isinf(claim.most):
        return f"≥ {least}"
    return f"{plain(claim.least)} … {most}"


def _possible_column(claims: Sequence[Claim]) -> tuple[Column, ...]:
    """The range for what the source leaves open, where there is any."""
    if all(math.isnan(claim.lowest) for claim in claims):
        return ()
    return (Column("possible", "Possible", "", list),)


def _possible(claim: Claim, digits: int) -> str:
    """Between which the computed figure lies for what is not published."""
    if math.isnan(claim.lowest):
        return MISSING
    if claim.lowest == claim.highest:
        return "no other"
    low, high = significant(claim.lowest, digits), significant(claim.highest, digits)
    return f"{low} … {_with(high, claim.unit)}"


def _why(claim: Claim) -> str:
    """The note of the study; that there is none where one is missed."""
    fitted = "By construction: inputs were inferred from it." if claim.fitted else ""
    if claim.note or claim.verdict is Verdict.HOLDS:
        return " ".join(part for part in (fitted, claim.note) if part)
    if claim.verdict is Verdict.OPEN:
        return "What is not published decides."
    return "The study gives no reason."


def _with_unit(value: float, unit: str, digits: int) -> str:
    if not math.isfinite(value):
        return MISSING
    rounding = unit == "Hz" and abs(value) < ROUNDING
    return _with("0" if rounding else significant(value, digits), unit)


def _with(text: str, unit: str) -> str:
    """Number and unit; degrees without a space."""
    return f"{text}{unit}" if unit.startswith("°") else quantity(text, unit)


def claims_text(claims: Sequence[Claim], inputs: str) -> tuple[Text, ...]:
    """How many of the printed figures follow from the inputs, for the verdict."""
    if not claims:
        return ()
    counts = {v: sum(claim.verdict is v for claim in claims) for v in Verdict}
    text = f"{counts[Verdict.HOLDS]} of {counted(len(claims), 'printed figure')}"
    tail = f" follow from the {inputs}"
    if counts[Verdict.FAILS]:
        tail += f", {counts[Verdict.FAILS]} do not"
    if counts[Verdict.OPEN]:
        verb = "depends" if counts[Verdict.OPEN] == 1 else "depend"
        tail += f", {counts[Verdict.OPEN]} {verb} on what is not published"
    if counts[Verdict.UNKNOWN]:
        tail += f", {counts[Verdict.UNKNOWN]} cannot be computed from them"
    return (
        (Strong(text), f"{tail}: the next section gives each with its reason.{_circular(claims)}"),
    )


def _circular(claims: Sequence[Claim]) -> str:
    """That figures from which the inputs were taken confirm nothing."""
    fitted = sum(claim.fitted and claim.verdict is Verdict.HOLDS for claim in claims)
    if not fitted:
        return ""
    which = "All of those hold" if fitted == len(claims) else f"{fitted} of them hold"
    if fitted == 1:
        which = "One of them holds"
    return (
        f" {which} by construction: inputs were inferred from what is printed. That it can be "
        "met is all that this shows, not that the inputs are the source's."
    )
