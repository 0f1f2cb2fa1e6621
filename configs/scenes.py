"""The blocks that describe what is observed."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .agile import SpotlightSceneBlock, VideoSceneBlock
from .base import Block, Number, Whole, wrong
from .coherence import BackscatterBlock
from .messages import KeyPath
from .observation import ObservationBlock

_GRAZING_DEG = 89.0
"""Largest local incidence: beyond, the critical baseline and the slant range lose their meaning."""

Look = Annotated[Number, Field(ge=2, le=80)]
Slope = Annotated[Number, Field(ge=-60, le=60)]


class StripBlock(Block):
    """A strip seen at broadside (zero squint) on a sphere of the Earth's equatorial radius."""

    look_deg: Look = Field(description="Angle of the line of sight from nadir, at the satellite.")
    side: Literal["left", "right"] = Field(
        default="left", description="Side of the flight direction that is observed."
    )
    start_s: Number = Field(
        default=0.0,
        ge=-1e6,
        le=1e6,
        description="Start of the observation, counted from the epoch of the formation's states.",
    )
    duration_s: Number = Field(
        default=10.0, gt=0, le=100_000, description="Length of the observation."
    )
    segments: Whole = Field(
        default=10,
        ge=1,
        le=1000,
        description="Parts of equal length; the height error is computed in the middle of each.",
    )
    slope_deg: Slope = Field(
        default=0.0, description="Slope of the terrain in range, positive towards the radar."
    )

    @property
    def count(self) -> int:
        """Number of segments."""
        return self.segments


class TableBlock(Block):
    """A scene given segment by segment: lists of equal length."""

    times_s: tuple[Annotated[Number, Field(ge=-1e6, le=1e6)], ...] = Field(
        min_length=1,
        max_length=1000,
        description="Time of each segment, counted from the epoch of the formation's states.",
    )
    slant_range_km: tuple[Annotated[Number, Field(ge=100, le=50_000)], ...] = Field(
        min_length=1, max_length=1000, description="Distance from the formation to the target."
    )
    look_deg: tuple[Look, ...] = Field(
        min_length=1, max_length=1000, description="Angle of the line of sight from nadir."
    )
    azimuth_deg: tuple[Annotated[Number, Field(ge=-180, le=360)], ...] = Field(
        min_length=1,
        max_length=1000,
        description="Direction of the line of sight about nadir, from the flight direction (0) to "
        "its left (90).",
    )
    incidence_deg: tuple[Annotated[Number, Field(ge=2, le=89)], ...] | None = Field(
        default=None,
        min_length=1,
        max_length=1000,
        description="Angle between the line of sight and the vertical at the target; equal to "
        "look_deg (a flat Earth) if absent.",
    )
    slope_deg: Slope = Field(
        default=0.0, description="Slope of the terrain in range, positive towards the radar."
    )

    @property
    def count(self) -> int:
        """Number of segments."""
        return len(self.times_s)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in ("slant_range_km", "look_deg", "azimuth_deg", "incidence_deg"):
            column = getattr(self, key)
            if column is not None and len(column) != self.count:
                raise wrong(
                    (key,),
                    f"has {len(column)} entries and times_s has {self.count}",
                    "give every column one entry a segment",
                )
        for segment, azimuth in enumerate(self.azimuth_deg):
            if abs(math.sin(math.radians(azimuth))) < math.sin(math.radians(1.0)):
                raise wrong(
                    ("azimuth_deg", segment),
                    "looks along the flight direction, where no baseline senses height",
                    "stay 1 degree or more away from 0 and 180; 90 is broadside left",
                )
        if self.incidence_deg is not None:
            for segment, (look, incidence) in enumerate(
                zip(self.look_deg, self.incidence_deg, strict=True)
            ):
                if incidence < look:
                    raise wrong(
                        ("incidence_deg", segment),
                        f"is below the look angle, {look:g}, which no Earth allows",
                        "check that the two columns are not swapped",
                    )
        check_slope(self.slope_deg, self.incidence_deg or self.look_deg, ())
        return self


def check_slope(slope_deg: float, incidence_deg: tuple[float, ...], at: KeyPath) -> None:
    """Refuse a slope in layover or shadow.

    Parameters
    ----------
    slope_deg : the slope, positive towards the radar [deg].
    incidence_deg : incidence in each segment on flat terrain [deg].
    at : path of the scene that the slope belongs to.
    """
    low, high = max(incidence_deg) - _GRAZING_DEG, min(incidence_deg) - 1.0
    if not low <= slope_deg <= high:
        raise wrong(
            (*at, "slope_deg"),
            "lies in layover or shadow, where no phase is measured: at this incidence it must be "
            f"from {low:.1f} to {high:.1f}",
            "choose a gentler slope",
        )


class SceneBlock(Block):
    """What is observed: a strip, a table of segments, or places on the real Earth."""

    strip: StripBlock | None = Field(
        default=None, description="A broadside strip at one look angle; or give another."
    )
    table: TableBlock | None = Field(
        default=None, description="Segments of your own, column by column; or give another."
    )
    observation: ObservationBlock | None = Field(
        default=None,
        description="Targets on the real Earth, seen from the study's orbit; or give another.",
    )
    spotlight: SpotlightSceneBlock | None = Field(
        default=None,
        description="One target, over the aperture of a spotlight image; or give another.",
    )
    video: VideoSceneBlock | None = Field(
        default=None, description="One target, over a film of it; or give another."
    )
    backscatter: BackscatterBlock | None = Field(
        default=None,
        description="Backscatter over the incidence, with radar.nesz_db or radar.beams; beside "
        "one of the others.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        shapes = ("strip", "table", "observation", "spotlight", "video")
        given = [key for key in shapes if getattr(self, key) is not None]
        if len(given) != 1:
            raise wrong(
                (),
                "needs exactly one of strip, table, observation, spotlight and video",
                "keep one of them" if given else "add 'strip: {look_deg: 23}'",
            )
        return self

    @property
    def staring(self) -> SpotlightSceneBlock | VideoSceneBlock | None:
        """The one target that the beam stays on, if the scene is such a one."""
        return self.spotlight or self.video

    @property
    def given(
        self,
    ) -> StripBlock | TableBlock | ObservationBlock | SpotlightSceneBlock | VideoSceneBlock:
        """What the scene consists of."""
        shapes = (self.strip, self.table, self.observation, self.staring)
        return next(shape for shape in shapes if shape is not None)
