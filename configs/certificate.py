"""The block that says how hard a study tries to prove its result the best."""

from __future__ import annotations

from pydantic import Field

from .base import Block, Number, Whole


class CertificateBlock(Block):
    """A lower bound of the height error that no formation within the limits can beat."""

    max_boxes: Whole = Field(
        default=400_000,
        ge=1_000,
        le=100_000_000,
        description="Boxes of projected baselines that the branch and bound looks at, for each "
        "cross-track sign; with more, a bound that has not closed becomes tighter.",
    )
    target_height_error_m: Number | None = Field(
        default=None,
        gt=0,
        le=10_000,
        description="Height error that the mission needs (total, RMS over the scene): the report "
        "says whether it is reached, or proves that no formation reaches it and what would help. "
        "The search always minimizes the error, whatever the target.",
    )
