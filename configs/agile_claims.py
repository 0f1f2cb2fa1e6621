"""The blocks of printed figures that studies of spotlight, video and coverage check."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import Field, Strict

from .printed import PrintedBlock


class Unit(NamedTuple):
    """What a quantity is counted in.

    Attributes
    ----------
    unit : of `value` and `tolerance`.
    scale : factor from this unit to SI.
    """

    unit: str
    scale: float = 1.0


_DEGREE = math.radians(1.0)


class InferredClaimBlock(PrintedBlock):
    """A printed figure of a study whose inputs may be inferred from it."""

    fitted: Annotated[bool, Strict()] = Field(
        default=False,
        description="Whether inputs of the study were chosen so that it holds: then it confirms "
        "nothing, and the report says so.",
    )

    def figure(self, counted: Unit) -> dict[str, Any]:
        """The figure in SI, as arguments of what judges it, but for its relation."""
        return {
            "text": self.text,
            "printed": self.printed,
            "value": self.value * counted.scale,
            "tolerance": self.tolerance * counted.scale,
            "unit": counted.unit,
            "scale": counted.scale,
            "note": self.note,
            "fitted": self.fitted,
        }


SpotlightQuantityName = Literal[
    "yaw_range",
    "pitch_range",
    "roll_range",
    "largest_rate",
    "largest_acceleration",
    "imaging_time",
    "first_order_time",
    "ground_speed",
    "bandwidth",
    "resolution",
    "aim_error",
]

SPOTLIGHT_UNITS: dict[SpotlightQuantityName, Unit] = {
    "yaw_range": Unit("°", _DEGREE),
    "pitch_range": Unit("°", _DEGREE),
    "roll_range": Unit("°", _DEGREE),
    "largest_rate": Unit("°/s", _DEGREE),
    "largest_acceleration": Unit("°/s²", _DEGREE),
    "imaging_time": Unit("s"),
    "first_order_time": Unit("s"),
    "ground_speed": Unit("m/s"),
    "bandwidth": Unit("Hz"),
    "resolution": Unit("m"),
    "aim_error": Unit("m"),
}
"""Unit of each quantity of a claim on spotlight."""


class SpotlightClaimBlock(InferredClaimBlock):
    """A printed figure of a spotlight image, and what it is compared with."""

    quantity: SpotlightQuantityName = Field(
        description="What is computed: yaw_, pitch_ and roll_range (largest less smallest angle) "
        "in degrees, largest_rate in degrees per second and largest_acceleration in degrees per "
        "second squared against inertial space, imaging_time and first_order_time (of the "
        "aperture, by the rate at zero Doppler) in seconds, ground_speed in m/s, "
        "bandwidth in Hz, resolution and aim_error (the largest) in meters."
    )


VideoQuantityName = Literal[
    "zero_doppler",
    "duration",
    "largest_pitch",
    "largest_roll",
    "largest_yaw",
    "pitch_to_roll",
    "largest_rate_orbit",
    "largest_rate",
    "azimuth_trace",
    "range_trace",
    "major_axis",
    "shear",
    "printed_length",
    "hyperbola",
    "independent_rate",
    "yaw_moves",
    "roll_pitch_rotate",
    "common_area",
]

VIDEO_UNITS: dict[VideoQuantityName, Unit] = {
    "zero_doppler": Unit("s"),
    "duration": Unit("s"),
    "largest_pitch": Unit("°", _DEGREE),
    "largest_roll": Unit("°", _DEGREE),
    "largest_yaw": Unit("°", _DEGREE),
    "pitch_to_roll": Unit(""),
    "largest_rate_orbit": Unit("°/s", _DEGREE),
    "largest_rate": Unit("°/s", _DEGREE),
    "azimuth_trace": Unit("°", _DEGREE),
    "range_trace": Unit("°", _DEGREE),
    "major_axis": Unit("°", _DEGREE),
    "shear": Unit("°", _DEGREE),
    "printed_length": Unit(""),
    "hyperbola": Unit("%", 0.01),
    "independent_rate": Unit("Hz"),
    "yaw_moves": Unit("m/mrad", 1e3),
    "roll_pitch_rotate": Unit("mrad/mrad"),
    "common_area": Unit("%", 0.01),
}
"""Unit of each quantity of a claim on video."""


class VideoClaimBlock(InferredClaimBlock):
    """A printed figure of a film, and what it is compared with."""

    quantity: VideoQuantityName = Field(
        description="What is computed: zero_doppler in seconds of the UTC day, duration in "
        "seconds, largest_pitch, _roll and _yaw in degrees, pitch_to_roll (range of the one by "
        "that of the other), largest_rate_orbit and largest_rate (inertial) in degrees per second, "
        "largest rotation of the azimuth_trace, range_trace and major_axis and the largest shear "
        "in degrees, printed_length (of a frame, eq. 3 by exact, at zero Doppler), hyperbola (its "
        "largest departure) in percent, independent_rate in Hz, yaw_moves (the center, by an "
        "error) in m per mrad, roll_pitch_rotate (the azimuth trace, by an error) in mrad per "
        "mrad, common_area in percent."
    )


CoverageQuantityName = Literal[
    "planes",
    "satellites_per_plane",
    "satellites",
    "sized_cover",
    "sized_cover_all",
    "smallest",
]

COVERAGE_UNITS: dict[CoverageQuantityName, Unit] = {
    "planes": Unit(""),
    "satellites_per_plane": Unit(""),
    "satellites": Unit(""),
    "sized_cover": Unit("%", 0.01),
    "sized_cover_all": Unit("%", 0.01),
    "smallest": Unit(""),
}
"""Unit of each quantity of a claim on coverage."""


class CoverageClaimBlock(InferredClaimBlock):
    """A printed figure of a constellation, and what it is compared with."""

    quantity: CoverageQuantityName = Field(
        description="What is computed: planes, satellites_per_plane and satellites of the sizing, "
        "sized_cover (with its largest incidence alone) and sized_cover_all (with all reasons) in "
        "percent of the time, smallest (satellites of the constellation that the search finds)."
    )
