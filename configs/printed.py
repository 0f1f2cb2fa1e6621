"""What every figure that a source prints says, whatever kind of study checks it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .base import Block, Label, Number, Prose

RelationName = Literal["equals", "at_most", "at_least"]


class PrintedBlock(Block):
    """A printed figure, and how what is computed must compare with it."""

    text: Label = Field(description="What is claimed, in words.")
    printed: Label = Field(description="How the source prints it, with its unit.")
    value: Number = Field(
        ge=0, le=1e6, description="The printed number, in the unit of the quantity."
    )
    relation: RelationName = Field(
        default="equals", description="How what is computed must compare with the value."
    )
    tolerance: Number = Field(
        default=0.0,
        ge=0,
        le=1e6,
        description="In the unit of the quantity; half of the last printed digit, at least.",
    )
    note: Prose = Field(default="", description="Why it holds or not, in words.")
