"""The blocks of printed figures that a study of a mission checks, and of what is not published."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal, NamedTuple, Self

from pydantic import Field, ValidationError, model_validator

from .base import Block, Label, Name, Number, Prose, Whole, wrong
from .messages import KeyPath, did_you_mean, show
from .printed import PrintedBlock

QuantityName = Literal[
    "height_of_ambiguity",
    "perpendicular_baseline",
    "critical_baseline",
    "baseline_fraction",
    "coherence",
    "height_per_baseline_error",
    "tilt_per_baseline_error",
    "height_error",
    "relative_error",
    "absolute_error_90",
    "relative_error_90",
    "random_error_90",
    "uncorrected_troposphere",
    "unwrapping_probability",
    "baseline_steadiness",
]


class MissionUnit(NamedTuple):
    """What a quantity is counted in.

    Attributes
    ----------
    unit : of `value` and `tolerance`; empty for a pure number.
    scale : factor from this unit to SI.
    of_pair : whether a pair of images has it.
    error : whether it is an error, which is RMS over the segments unless said otherwise.
    """

    unit: str
    scale: float = 1.0
    of_pair: bool = False
    error: bool = False


UNITS: dict[QuantityName, MissionUnit] = {
    "height_of_ambiguity": MissionUnit("m", of_pair=True),
    "perpendicular_baseline": MissionUnit("m", of_pair=True),
    "critical_baseline": MissionUnit("m", of_pair=True),
    "baseline_fraction": MissionUnit("", of_pair=True),
    "coherence": MissionUnit("", of_pair=True),
    "height_per_baseline_error": MissionUnit("m/mm", 1e3, of_pair=True),
    "tilt_per_baseline_error": MissionUnit("mm/km per mm", 1e-3, of_pair=True),
    "height_error": MissionUnit("m", error=True),
    "relative_error": MissionUnit("m", error=True),
    "absolute_error_90": MissionUnit("m", error=True),
    "relative_error_90": MissionUnit("m", error=True),
    "random_error_90": MissionUnit("m", error=True),
    "uncorrected_troposphere": MissionUnit("m"),
    "unwrapping_probability": MissionUnit(""),
    "baseline_steadiness": MissionUnit("%", 0.01),
}
"""Unit of each quantity of a claim."""


class MissionClaimBlock(PrintedBlock):
    """A figure that a mission prints, and what it is compared with."""

    quantity: QuantityName = Field(
        description="What is computed: height_of_ambiguity, perpendicular_ and critical_baseline "
        "(m), baseline_fraction (of the critical one), coherence, height_per_baseline_error "
        "(meters for each millimeter along the line of sight) and tilt_per_baseline_error (mm/km "
        "for each millimeter) of a pair; height_error, relative_error (one standard deviation), "
        "absolute_error_90, relative_error_90 and random_error_90 (of two points, with 90 %, the "
        "last by noise alone) and uncorrected_troposphere (bias by 2.4 m of delay) in meters, "
        "unwrapping_probability and baseline_steadiness (how much the longest perpendicular "
        "baseline changes over the segments, from its middle, in percent) of a formation."
    )
    formation: Label | None = Field(
        default=None,
        description="Label of an acquisition or of a formation to compare with; that of the study "
        "if absent.",
    )
    pair: tuple[Name, Name] | None = Field(
        default=None, description="The two satellites of the pair; its first pair if absent."
    )
    segment: Annotated[Whole, Field(ge=1, le=1000)] | None = Field(
        default=None, description="Which segment, from 1; all of them if absent."
    )
    over: Literal["mean", "rms", "smallest", "largest", "range"] | None = Field(
        default=None,
        description="How all segments become one figure: rms of an error and mean of anything else "
        "if absent. range: the source does not say which segment; any may be meant.",
    )

    @property
    def meaning(self) -> MissionUnit:
        """Unit of the quantity."""
        return UNITS[self.quantity]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.pair is not None and not self.meaning.of_pair:
            raise wrong(("pair",), f"has no meaning for {self.quantity}", "remove it")
        if self.segment is not None and self.over is not None:
            raise wrong(("over",), "has no meaning for one segment", "remove it, or segment")
        return self


OPEN_BLOCKS = ("radar", "errors", "constraints")
"""Blocks of a study whose numbers a source may leave open."""


class OpenBlock(Block):
    """A number that the source does not publish, with the values that are possible."""

    key: Label = Field(
        description="Which number of radar, errors or constraints, such as radar.looks."
    )
    least: Number = Field(ge=-1e6, le=1e6, description="Least value that is possible.")
    most: Number = Field(ge=-1e6, le=1e6, description="Largest value that is possible.")
    why: Prose = Field(default="", description="Where these values come from.")

    @property
    def path(self) -> tuple[str, ...]:
        """Keys that lead to the number."""
        return tuple(self.key.split("."))

    @property
    def ends(self) -> tuple[float, float]:
        """Both values."""
        return self.least, self.most

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.most <= self.least:
            raise wrong(("most",), f"is not above least = {self.least:g}", "give the larger value")
        return self


def with_value(block: Block, path: Sequence[str], value: float) -> Block:
    """A block with another value of one number in it.

    Parameters
    ----------
    block : of a study.
    path : keys that lead to the number, from this block.
    value : the new one.

    Raises
    ------
    KeyError
        If there is no such number in the study.
    pydantic.ValidationError
        If the value is not allowed.
    """
    key, *rest = path
    if key not in type(block).model_fields:
        raise KeyError(key)
    inner = getattr(block, key)
    if rest:
        if not isinstance(inner, Block):
            raise KeyError(key)
        return block.model_copy(update={key: with_value(inner, rest, value)})
    if isinstance(inner, bool | str | tuple | Block):
        raise KeyError(key)
    # What the study says and no default: a default that is written out would count as said.
    said: dict[str, Any] = {name: getattr(block, name) for name in block.model_fields_set}
    return type(block).model_validate(said | {key: value})


def corners(opened: Sequence[OpenBlock]) -> Iterator[tuple[float, ...]]:
    """Every combination of the ends of what is open; none where nothing is."""
    if opened:
        yield from itertools.product(*(one.ends for one in opened))


def check_open(opened: Sequence[OpenBlock], study: Block) -> None:
    """Every open number is one of the study, and may have both its values."""
    seen: list[str] = []
    for index, one in enumerate(opened):
        at: KeyPath = ("open", index)
        if one.key in seen:
            raise wrong((*at, "key"), "is listed twice", "list each number once")
        seen.append(one.key)
        if one.path[0] not in OPEN_BLOCKS or one.key in ("radar.wavelength_m",):
            raise wrong(
                (*at, "key"), "may not be left open", f"name a number of {', '.join(OPEN_BLOCKS)}"
            )
        for value, end in zip(one.ends, ("least", "most"), strict=True):
            try:
                with_value(study, one.path, value)
            except KeyError as error:
                missing = str(error.args[0])
                known = type(getattr(study, one.path[0])).model_fields
                hint = "" if missing in known else did_you_mean(missing, known)
                raise wrong(
                    (*at, "key"),
                    f"is no number of this study: {show(missing)} is unknown, absent or no number",
                    f"{hint}name a number that the study gives, as block.key",
                ) from None
            except ValidationError as error:
                text = str(error.errors(include_url=False)[0]["msg"])
                raise wrong((*at, end), f"is not possible there: {text}", "correct it") from None


def check_mission_claims(
    claims: Sequence[MissionClaimBlock],
    *,
    labels: Sequence[str],
    names: Sequence[str],
    segments: int,
) -> None:
    """Every claim is about a formation, satellites and a segment of the study."""
    for index, claim in enumerate(claims):
        at: KeyPath = ("claims", index)
        if claim.formation is not None and claim.formation not in labels:
            raise wrong(
                (*at, "formation"),
                "is no formation of this study",
                f"{did_you_mean(claim.formation, labels)}they are {', '.join(labels)}",
            )
        for end, name in enumerate(claim.pair or ()):
            if name not in names:
                raise wrong(
                    (*at, "pair", end),
                    "is no satellite of this study",
                    f"{did_you_mean(name, names)}the satellites are {', '.join(names)}",
                )
        if claim.segment is not None and claim.segment > segments:
            raise wrong(
                (*at, "segment"), f"is above the scene's {segments}", "choose one of the scene's"
            )
