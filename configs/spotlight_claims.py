"""The block of a printed figure that a study of spotlight checks."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from pydantic import Field

from .printed import PrintedBlock

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


class SpotlightClaimBlock(PrintedBlock):
    """A printed figure of spotlight, and what it is compared with."""

    quantity: QuantityName = Field(
        description="What is computed: yaw_, pitch_ and roll_range (largest less smallest angle) "
        "in degrees, largest_rate in degrees per second and largest_acceleration in degrees per "
        "second squared against inertial space, imaging_time in seconds, ground_speed in m/s, "
        "bandwidth in Hz, resolution and aim_error (the largest) in meters."
    )
