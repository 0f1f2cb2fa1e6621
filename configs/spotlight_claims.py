"""The block of a printed figure that a study of spotlight checks."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from pydantic import Field

from .base import Block, Label, Number, Prose

QuantityName = Literal[
    "yaw_range",
    "pitch_range",
    "roll_range",
    "largest_rate",
    "largest_acceleration",
    "imaging_time",
    "ground_speed",
    "bandwidth",
    "resolution",
    "aim_error",
]


class SpotlightUnit(NamedTuple):
    """What a quantity is counted in.

    Attributes
    ----------
    unit : of `value` and `tolerance`.
    scale : factor from this unit to SI.
    """

    unit: str
    scale: float = 1.0


_DEGREE = math.radians(1.0)

UNITS: dict[QuantityName, SpotlightUnit] = {
    "yaw_range": SpotlightUnit("°", _DEGREE),
    "pitch_range": SpotlightUnit("°", _DEGREE),
    "roll_range": SpotlightUnit("°", _DEGREE),
    "largest_rate": SpotlightUnit("°/s", _DEGREE),
    "largest_acceleration": SpotlightUnit("°/s²", _DEGREE),
    "imaging_time": SpotlightUnit("s"),
    "ground_speed": SpotlightUnit("m/s"),
    "bandwidth": SpotlightUnit("Hz"),
    "resolution": SpotlightUnit("m"),
    "aim_error": SpotlightUnit("m"),
}
"""Unit of each quantity of a claim."""


class SpotlightClaimBlock(Block):
    """A printed figure, and what it is compared with."""

    text: Label = Field(description="What is claimed, in words.")
    printed: Label = Field(description="How the source prints it, with its unit.")
    quantity: QuantityName = Field(
        description="What is computed: yaw_, pitch_ and roll_range (largest less smallest angle) "
        "in degrees, largest_rate in degrees per second and largest_acceleration in degrees per "
        "second squared against inertial space, imaging_time in seconds, ground_speed in m/s, "
        "bandwidth in Hz, resolution and aim_error (the largest) in meters."
    )
    value: Number = Field(
        ge=0, le=1e6, description="The printed number, in the unit of the quantity."
    )
    relation: Literal["equals", "at_most", "at_least"] = Field(
        default="equals", description="How what is computed must compare with the value."
    )
    tolerance: Number = Field(
        default=0.0,
        ge=0,
        le=1e6,
        description="In the unit of the quantity; half of the last printed digit, at least.",
    )
    note: Prose = Field(default="", description="Why it holds or not, in words.")
