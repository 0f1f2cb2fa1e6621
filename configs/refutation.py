"""The block that says how a study tries to refute itself."""

from __future__ import annotations

from pydantic import Field

from .base import Block, Number, Whole


class RefutationBlock(Block):
    """A Monte-Carlo simulation of the formations, set beside what the error model predicts."""

    samples: Whole = Field(
        default=4096,
        ge=100,
        le=1_000_000,
        description="Pixels drawn in each of two segments of each formation; fewer with more than "
        "six images.",
    )
    prior_height_std_m: Number | None = Field(
        default=None,
        ge=0.01,
        le=1000,
        description="Standard deviation of the height known beforehand; that of "
        "constraints.unwrapping if absent, and 4 m without one.",
    )
    seed: Whole | None = Field(
        default=None,
        ge=0,
        le=2**32 - 1,
        description="Seed of the simulation; that of the search if absent, and 1 without one.",
    )
