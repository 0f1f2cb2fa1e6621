"""Printed figures and their verdicts, in results of any kind."""

from __future__ import annotations

from collections.abc import Sequence

from insar import Claim

from .json_numbers import Json, finite


def claims_json(claims: Sequence[Claim]) -> list[Json]:
    """Printed figures and their verdicts."""
    return [
        {
            "text": claim.text,
            "printed": claim.printed,
            "computed": finite(claim.computed),
            "agrees_from": finite(claim.least),
            "agrees_to": finite(claim.most),
            "possible_from": finite(claim.lowest),
            "possible_to": finite(claim.highest),
            "unit": claim.unit,
            "verdict": claim.verdict.value,
            "fitted": claim.fitted,
            "note": claim.note,
        }
        for claim in claims
    ]
