"""The verdict on steering laws: what is left at the boresight, and what it costs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from insar import Verdict
from insar.observe import CaseResult, Law, SteeringResult

from ..document import Block, Callout, Metric, Metrics, Status, Strong, Text
from ..reading_steering import ROUNDING, LawRecord, curves_of, exact_laws, records
from ..steering_words import law_name, unsolved_reason
from ..wording import MISSING, fixed, frequency, joined, percent, plain
from .claims import claims_text


def steering_verdict(result: SteeringResult) -> tuple[Block, ...]:
    """Verdict on a study of steering."""
    found = records(result.cases)
    exact = exact_laws(result.cases)
    paragraphs: list[Text] = [
        _at_boresight(found, exact, len(result.cases)),
        *_price(found, exact, result.cases),
        *_unsolved(result.cases),
        *claims_text(result.claims, "stated inputs"),
    ]
    doubtful = any(claim.verdict is not Verdict.HOLDS for claim in result.claims) or any(
        record.solved < 1.0 for record in found
    )
    status = Status.WARNING if doubtful else Status.GOOD if exact else Status.NOTE
    return Callout(status, _title(found, exact), tuple(paragraphs)), _metrics(result, found)


def _title(found: Sequence[LawRecord], exact: Sequence[Law]) -> str:
    solvable = [record for record in found if math.isfinite(record.residual)]
    if not solvable:
        return "No law has a solution"
    if not exact:
        least = min(solvable, key=lambda record: record.residual)
        return f"Up to {frequency(least.residual)} is left {_with(least.law)}"
    names = [_named(record) for record in found if record.law in exact]
    return f"Zero Doppler at the boresight with {joined(names)}"


def _named(record: LawRecord) -> str:
    """A law, and on how much of the orbit it has a solution where that is not all."""
    if record.solved == 1.0:
        return law_name(record.law)
    return f"{law_name(record.law)} (on {share_solved(record.solved)} of the orbit only)"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _at_boresight(found: Sequence[LawRecord], exact: Sequence[Law], cases: int) -> Text:
    """What each law leaves at the boresight."""
    where = "" if cases == 1 else f" in all {cases} cases"
    worst = max((record.residual for record in found if record.law in exact), default=0.0)
    text: tuple[str, ...] = ()
    if exact:
        text = (
            "The Doppler centroid at the boresight stays ",
            Strong(f"below {_rounding(worst)}"),
            f" with {joined([law_name(law) for law in exact])} steering{where}, wherever these "
            "have a solution: zero, but for the rounding of the arithmetic. ",
        )
    others = [
        f"{_with(record.law)} {frequency(record.residual)}"
        for record in sorted(found, key=lambda record: -record.residual)
        if record.law not in exact and math.isfinite(record.residual)
    ]
    if others:
        return (*text, f"Up to the following is left there: {joined(others)}.")
    return text


def _rounding(worst: float) -> str:
    """A bound for a residual that is nothing but rounding: the next power of ten."""
    bound = 10.0 ** math.ceil(math.log10(max(worst, 1e-12)) + 1e-9)
    return f"{plain(min(bound, ROUNDING))}\u00a0Hz"


def _with(law: Law) -> str:
    return "without steering" if law is Law.NONE else f"with {law_name(law)} steering"


def _price(
    found: Sequence[LawRecord], exact: Sequence[Law], cases: Sequence[CaseResult]
) -> tuple[Text, ...]:
    """What an exact law leaves off the boresight, and the angles it takes."""
    records_ = [record for record in found if record.law in exact and math.isfinite(record.swath)]
    if not records_:
        return ()
    offsets = [abs(offset) for case in cases for offset in case.case.swath_offsets]
    edge = f"{plain(math.degrees(max(offsets)))}°"
    if all(record.swath < ROUNDING for record in records_):
        return (f"Over the swath, to {edge} off the boresight, it stays zero.",)
    return (
        (
            Strong("The price over the swath: "),
            f"at {edge} off the boresight "
            + joined(
                [
                    f"{law_name(record.law)} "
                    + (
                        "stays at zero"
                        if record.swath < ROUNDING
                        else f"has up to {frequency(record.swath)}"
                        + (f" ({record.swath_case})" if len(cases) > 1 else "")
                    )
                    for record in records_
                ]
            )
            + "; the steered angles add up to at most "
            + joined(
                [
                    f"{fixed(math.degrees(record.steering), 2)}° ({law_name(record.law)}"
                    + (f", {record.steering_case})" if len(cases) > 1 else ")")
                    for record in records_
                ]
            )
            + ".",
        ),
    )


def _unsolved(cases: Sequence[CaseResult]) -> tuple[Text, ...]:
    """Where a law has no solution, and why."""
    missing = [
        f"{law_name(law)}" + (f" in {case.name}" if len(cases) > 1 else "") + f": {reason}"
        for law in Law
        for case, curves in curves_of(cases, law)
        if (reason := unsolved_reason(curves)) is not None
    ]
    if not missing:
        return ()
    return ((Strong("No solution over part of the orbit: "), f"{'; '.join(missing)}."),)


def _metrics(result: SteeringResult, found: Sequence[LawRecord]) -> Metrics:
    exact = exact_laws(result.cases)
    items = [
        Metric(
            "No steering" if record.law is Law.NONE else _capital(law_name(record.law)),
            _residual(record.residual),
            "at the boresight"
            + (
                f"; {_residual(record.swath)} at the swath's edge"
                if math.isfinite(record.swath)
                else ""
            ),
            Status.GOOD if record.law in exact else Status.NOTE,
        )
        for record in found
    ]
    return Metrics(tuple(items))


def _residual(value: float) -> str:
    if not math.isfinite(value):
        return MISSING
    return "0\u00a0Hz" if value < ROUNDING else frequency(value)


def share_solved(share: float) -> str:
    """Share of an orbit that has a solution, never rounded up to all of it."""
    if share == 1.0:
        return "all"
    return percent(min(share, 0.999))
