"""The blocks of studies in which a satellite turns as a whole to keep its beam on a place."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Moment, Number, Whole, wrong
from .observation import Incidence, TargetPoint

SEGMENTS = 11
MAX_FRAMES = 20_000

YawLawName = Literal["none", "shortest_rotation", "azimuth_trace", "range_trace", "major_axis"]

Segments = Annotated[Whole, Field(ge=1, le=1000)]
Slope = Annotated[Number, Field(ge=-60, le=60)]
Duration = Annotated[Number, Field(gt=0, le=3_600)]
Samples = Annotated[Whole, Field(ge=3, le=200_001)]
PointingError = Annotated[Number, Field(ge=0, le=5)]
_Offset = Annotated[Number, Field(ge=-100, le=100)]
_NEAR = "Smallest incidence at zero Doppler at which a pass counts"
_NearIncidence = Annotated[Number, Field(ge=0, le=85)]
Beamwidth = Annotated[Number, Field(gt=0, le=30)]


def _form(value: Any) -> str:
    return "list" if isinstance(value, list | tuple) else "number"


_Rate = Annotated[Number, Field(gt=0, le=90)]
"""Of an angular velocity or acceleration: of its magnitude, or about X, Y and Z of the body."""
_OneOrThree = Annotated[
    Annotated[_Rate, Tag("number")] | Annotated[tuple[_Rate, _Rate, _Rate], Tag("list")],
    Discriminator(_form),
]


class PassBlock(Block):
    """A place on the Earth, and the pass on which it is seen."""

    target: TargetPoint = Field(description="The place that the beam stays on.")
    side: Literal["either", "left", "right"] = Field(
        default="either",
        description="Side of the flight direction that the radar can look to; either for a "
        "satellite that turns to both.",
    )
    start: Moment | None = Field(
        default=None,
        description="From when a pass is searched (UTC); the epoch of the orbit if absent.",
    )
    search_days: Number = Field(
        default=11.0, gt=0, le=60, description="How long a pass is searched, in days."
    )
    direction: Literal["either", "ascending", "descending"] = Field(
        default="either", description="Whether the satellite flies northward or southward."
    )
    pass_number: Whole = Field(
        default=1,
        ge=1,
        le=10_000,
        description="Which of the passes that reach the place is taken, counted from 1.",
    )
    near_incidence_deg: _NearIncidence = Field(
        default=20.0,
        description=f"{_NEAR}; 0 counts one right overhead too, where range does not resolve the "
        "ground.",
    )
    far_incidence_deg: Incidence = Field(
        default=55.0, description="Largest incidence at zero Doppler at which a pass counts."
    )

    @model_validator(mode="after")
    def _check_incidences(self) -> Self:
        if self.near_incidence_deg >= self.far_incidence_deg:
            raise wrong(
                ("near_incidence_deg",),
                f"must be below far_incidence_deg, {self.far_incidence_deg:g}",
                "check that the two are not swapped",
            )
        return self


class SpotlightBlock(PassBlock):
    """A spotlight image: the beam stays on the target for as long as its resolution needs."""

    resolution_m: Number = Field(
        ge=0.02, le=100, description="Resolution in azimuth, on the ground."
    )
    weighting_factor: Number = Field(
        default=1.0,
        ge=0.5,
        le=3,
        description="How much the weighting of the Doppler spectrum coarsens the resolution.",
    )
    sliding_factor: Number = Field(
        default=0.0,
        ge=0,
        le=0.95,
        description="Speed of the beam over the ground, by that of a strip: 0 (default) stares at "
        "the target, values towards 1 slide.",
    )
    scene_length_m: Number = Field(
        default=0.0,
        ge=0,
        le=1e6,
        description="Length in azimuth that a sliding beam images at full resolution.",
    )

    @model_validator(mode="after")
    def _check_sliding(self) -> Self:
        if self.scene_length_m > 0 and self.sliding_factor == 0:
            raise wrong(
                ("scene_length_m",),
                "needs a beam that slides: without it the scene is as long as the beam is wide",
                "add sliding_factor: 0.5, or remove it",
            )
        return self


class SpotlightSceneBlock(SpotlightBlock):
    """A spotlight image as the scene of a formation: the target, seen from the whole aperture."""

    segments: Segments = Field(
        default=SEGMENTS,
        description="Moments of the imaging time at which the height error is computed, equally "
        "spaced, both ends included.",
    )
    near_incidence_deg: Incidence = Field(default=20.0, description=f"{_NEAR}.")
    slope_deg: Slope = Field(
        default=0.0, description="Slope of the terrain in range, positive towards the radar."
    )

    @property
    def count(self) -> int:
        """Number of segments."""
        return self.segments


class VideoSceneBlock(PassBlock):
    """A film as the scene of a formation: the target, from the first frame to the last."""

    duration_s: Duration = Field(description="Of the film, centered on zero Doppler.")
    segments: Segments = Field(
        default=SEGMENTS,
        description="Moments of the film at which the height error is computed, equally spaced, "
        "both ends included.",
    )
    near_incidence_deg: Incidence = Field(default=20.0, description=f"{_NEAR}.")
    slope_deg: Slope = Field(
        default=0.0, description="Slope of the terrain in range, positive towards the radar."
    )

    @property
    def count(self) -> int:
        """Number of segments."""
        return self.segments


class VideoBlock(PassBlock):
    """A film: the beam stays on the target, and the data are cut into frames."""

    resolution_m: Number = Field(
        ge=0.02, le=100, description="Resolution of every frame in azimuth, on the ground."
    )
    frame_rate_hz: Number = Field(gt=0, le=100, description="Frames per second.")
    duration_s: Duration = Field(description="Of the film, centered on zero Doppler.")
    max_overlap: Number = Field(
        default=0.0,
        ge=0,
        le=0.99,
        description="Largest share of its data that a frame may have in common with the one "
        "before; 0 (default) for frames of their own data. Limits the frame rate.",
    )

    @model_validator(mode="after")
    def _check_frames(self) -> Self:
        count = self.duration_s * self.frame_rate_hz
        if count > MAX_FRAMES:
            raise wrong(
                ("frame_rate_hz",),
                f"times duration_s makes {count:.3g} frames, and {MAX_FRAMES} is the limit",
                "take fewer frames, or a shorter film",
            )
        return self


class AntennaBlock(Block):
    """Where the beam leaves the body: X forward, Y to the right, Z downward at rest."""

    off_axis_deg: Number = Field(
        default=0.0,
        ge=-80,
        le=80,
        description="Angle of the beam from the body's Z axis, about X; positive to the left of "
        "the flight direction.",
    )
    phase_center_m: tuple[_Offset, _Offset, _Offset] = Field(
        default=(0, 0, 0),
        description="Phase center of the antenna from the center of mass: X, Y, Z.",
    )


class BeamBlock(Block):
    """Width of the beam."""

    azimuth_beamwidth_deg: Beamwidth = Field(description="Full width along the flight direction.")
    elevation_beamwidth_deg: Beamwidth = Field(description="Full width across it.")


class YawBlock(Block):
    """What the turn about the line of sight does, once roll and pitch point the beam."""

    law: YawLawName = Field(
        default="azimuth_trace",
        description="What it holds: none (no yaw), shortest_rotation, or a direction on the "
        "ground: azimuth_trace, range_trace or major_axis of the footprint.",
    )
    reference_time_s: Number = Field(
        default=0.0,
        ge=-1_800,
        le=1_800,
        description="When the yaw is zero and the footprint as it shall stay, from zero Doppler.",
    )


class AgilityBlock(Block):
    """How fast the satellite can turn: one limit for the magnitude, or three, about X, Y and Z."""

    max_rate_deg_s: _OneOrThree | None = Field(
        default=None, description="Angular velocity against inertial space."
    )
    max_acceleration_deg_s2: _OneOrThree | None = Field(
        default=None, description="Angular acceleration against inertial space."
    )
