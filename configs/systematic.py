"""The blocks of errors that shift and tilt whole scenes: atmosphere and calibration."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from .base import Block, Number, wrong

ScaleWord = Literal["pixel", "scene", "data_take", "orbit", "mission"]
SystematicScale = Literal["scene", "data_take", "orbit", "mission"]


class TroposphereBlock(Block):
    """The delay by the troposphere, of which a pair keeps the part that its two rays differ by."""

    zenith_delay_m: Number | None = Field(
        default=None,
        ge=0,
        le=3,
        description="One-way zenith delay that nobody corrects; 2.4 at sea level.",
    )
    residual_zenith_delay_m: Number | None = Field(
        default=None,
        ge=0,
        le=3,
        description="Standard deviation of the zenith delay left after a correction: 0.01 to 0.05 "
        "with a weather model; instead of zenith_delay_m.",
    )
    scale: SystematicScale = Field(
        default="data_take", description="How far the error stays the same on the ground."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.zenith_delay_m is None) == (self.residual_zenith_delay_m is None):
            raise wrong(
                (),
                "needs exactly one of zenith_delay_m and residual_zenith_delay_m",
                "add residual_zenith_delay_m: 0.03 for a corrected delay"
                if self.zenith_delay_m is None
                else "remove zenith_delay_m if the delay is corrected",
            )
        return self

    @property
    def std(self) -> float:
        """What is not known of the zenith delay, or all of it where nothing is corrected [m]."""
        given = (self.zenith_delay_m, self.residual_zenith_delay_m)
        return next(value for value in given if value is not None)


class IonosphereBlock(Block):
    """The ionosphere, of which a single-pass pair keeps the part that its two rays differ by."""

    electrons_tecu: Number = Field(
        ge=0,
        le=300,
        description="Vertical electron content below the satellites that is not corrected, in TEC "
        "units of 1e16/m2; 5 to 100 in all.",
    )
    gradient_tecu_100km: Number = Field(
        default=0.0,
        ge=0,
        le=100,
        description="Standard deviation of its horizontal gradient across track, in TEC units for "
        "each 100 km; about 1, near the magnetic equator 10.",
    )
    shell_height_km: Number = Field(
        default=350.0,
        ge=60,
        le=1500,
        description="Height of the thin shell that stands for the ionosphere.",
    )
    scale: SystematicScale = Field(
        default="data_take", description="How far the error stays the same on the ground."
    )


class CalibrationBlock(Block):
    """An adjustment of offset and tilts to control points or altimeter tracks."""

    over: SystematicScale = Field(
        default="scene",
        description="What one adjustment covers: errors that stay the same over all of it are "
        "removed as well as the points allow; those of a shorter scale stay.",
    )
    swath_km: Number | None = Field(
        default=None,
        ge=1,
        le=1000,
        description="Extent across track of what one adjustment covers; by default the swath of "
        "the radar's beams.",
    )
    length_km: Number = Field(
        ge=1, le=40_000, description="Extent along track of what one adjustment covers."
    )
    spacing_across_km: Number = Field(
        ge=0.01,
        le=1000,
        description="Distance of control points across track; of altimeter tracks that run along "
        "the orbit, the distance between tracks.",
    )
    spacing_along_km: Number = Field(
        ge=0.01,
        le=40_000,
        description="Distance of independent control points along track.",
    )
    accuracy_m: Number = Field(
        ge=0.001,
        le=100,
        description="Standard deviation of a control height, with what the comparison adds; "
        "independent from point to point.",
    )
    bias_m: Number = Field(
        default=0.0,
        ge=0,
        le=100,
        description="Standard deviation of an error that all control heights share.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, extent in (("spacing_across_km", "swath_km"), ("spacing_along_km", "length_km")):
            known = getattr(self, extent)
            if known is not None and getattr(self, key) > known:
                raise wrong(
                    (key,),
                    f"exceeds {extent} = {known:g}, so that no control point need "
                    "fall into what is adjusted",
                    f"take at most {known:g}, or adjust a larger area with over: data_take",
                )
        return self
