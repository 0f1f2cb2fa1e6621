"""Checks across the blocks of a study of steering; each raises the error of `base.wrong`."""

from __future__ import annotations

from collections.abc import Sequence

from .base import wrong
from .checks import check_beam
from .claims import ClaimBlock
from .messages import KeyPath, did_you_mean, show
from .observation import LawName
from .steering import BoresightBlock, CaseBlock, CompensationBlock, SelectionBlock

MAX_VALUES = 20_000_000
"""Doppler values of a study: samples x offsets, of all laws and cases."""

_OF_COMPENSATION = ("ellipsoid_effect", "compensation", "deviation_slope")


def check_cases(cases: Sequence[CaseBlock], boresight: BoresightBlock) -> None:
    """No two cases have one name, and no beam misses the Earth."""
    names = [case.name for case in cases]
    for index, case in enumerate(cases):
        if case.name in names[:index]:
            raise wrong(("cases", index, "name"), "is used twice", "choose another name")
        look = (case.boresight or boresight).look_deg
        if look is not None:
            shared = case.boresight is None
            at: KeyPath = () if shared else ("cases", index)
            named = case.name if shared else ""
            check_beam(look, case.orbit, (*at, "boresight", "look_deg"), case=named)


def check_samples(
    cases: Sequence[CaseBlock], laws: Sequence[LawName], *, samples: int, offsets: int
) -> None:
    """The curves of all cases fit into the memory of an ordinary computer."""
    count = samples * (offsets + 1) * sum(len(case.laws or laws) for case in cases)
    if count > MAX_VALUES:
        raise wrong(
            ("samples",),
            f"times revolutions, swath_offsets_deg, laws and cases makes {count:.1e} values, and "
            f"{MAX_VALUES:.0e} is the limit",
            "take fewer of one of them",
        )


def check_claims(
    claims: Sequence[ClaimBlock],
    *,
    cases: Sequence[CaseBlock],
    laws: Sequence[LawName],
    selections: Sequence[SelectionBlock],
    compensation: CompensationBlock | None,
) -> None:
    """Every claim refers to what the study computes."""
    of_case = {case.name: case.laws or tuple(laws) for case in cases}
    for index, claim in enumerate(claims):
        at: KeyPath = ("claims", index)
        if claim.case is not None:
            _check_case(claim, of_case, at)
        if claim.quantity == "crossover_altitude":
            _check_selection(claim, selections, at)
        if claim.quantity in _OF_COMPENSATION:
            _check_compensation(claim, compensation, at)


def _check_case(claim: ClaimBlock, of_case: dict[str, tuple[LawName, ...]], at: KeyPath) -> None:
    name = claim.case or ""
    if name not in of_case:
        raise wrong(
            (*at, "case"),
            "is no case of this study",
            f"{did_you_mean(name, of_case)}the cases are {', '.join(of_case)}",
        )
    for key in ("law", "other_law"):
        law = getattr(claim, key)
        if law is not None and law not in of_case[name]:
            raise wrong(
                (*at, key),
                f"is not compared in the case {show(name)}",
                f"add it to the laws of the case, which are {', '.join(of_case[name])}",
            )


def _check_selection(claim: ClaimBlock, selections: Sequence[SelectionBlock], at: KeyPath) -> None:
    held = [selection for selection in selections if selection.held == claim.held]
    if not held:
        raise wrong((*at, "held"), "is held by no selection", "add the selection that is meant")
    known = [inclination for selection in held for inclination in selection.inclinations_deg]
    if claim.inclination_deg not in known:
        raise wrong(
            (*at, "inclination_deg"),
            f"is in no selection that holds the {claim.held}",
            f"add it to its inclinations_deg, which are {', '.join(f'{i:g}' for i in known)}",
        )


def _check_compensation(
    claim: ClaimBlock, compensation: CompensationBlock | None, at: KeyPath
) -> None:
    if compensation is None:
        raise wrong(
            (*at, "quantity"), "needs the block compensation", "add it, or remove the claim"
        )
    first, last = compensation.eccentricities
    if claim.eccentricity is not None and not first <= claim.eccentricity <= last:
        raise wrong(
            (*at, "eccentricity"),
            f"lies outside compensation.eccentricities, {first:g} to {last:g}",
            "widen the sweep",
        )
    perigees = compensation.arguments_of_perigee_deg
    if claim.argument_of_perigee_deg not in (None, *perigees):
        raise wrong(
            (*at, "argument_of_perigee_deg"),
            "is none of compensation.arguments_of_perigee_deg",
            f"add it there, or choose of {', '.join(f'{p:g}' for p in perigees)}",
        )
