"""The block that says what elevation model is wanted, and by which classes it is judged."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Label, Number, wrong
from .blocks import RadarBlock


class SpecificationBlock(Block):
    """A class of elevation models of one's own; what is left out is not asked."""

    name: Label = Field(description="What the report calls it.")
    posting_m: Number | None = Field(
        default=None, ge=0.1, le=10_000, description="Largest distance of the posts."
    )
    relative_90_m: Number | None = Field(
        default=None,
        ge=0.001,
        le=1000,
        description="Largest point-to-point error of 90 % within a cell.",
    )
    relative_90_steep_m: Number | None = Field(
        default=None,
        ge=0.001,
        le=1000,
        description="The same on steep slopes; by default no other.",
    )
    steep_slope_percent: Number = Field(
        default=20.0, gt=0, le=1000, description="Slope above which terrain is steep."
    )
    absolute_90_m: Number | None = Field(
        default=None, ge=0.001, le=1000, description="Largest absolute error of 90 %."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.posting_m, self.relative_90_m, self.absolute_90_m) == (None, None, None):
            raise wrong((), "asks nothing", "add relative_90_m, absolute_90_m or posting_m")
        if self.relative_90_steep_m is not None and self.relative_90_m is None:
            raise wrong(
                ("relative_90_steep_m",),
                "needs relative_90_m, the limit on other slopes",
                "add relative_90_m",
            )
        return self


def _form(value: Any) -> str:
    return "word" if isinstance(value, str) else "block"


ClassWord = Literal["hrti3", "hrti4", "dted2"]
SpecificationItem = Annotated[
    Annotated[ClassWord, Tag("word")] | Annotated[SpecificationBlock, Tag("block")],
    Discriminator(_form),
]


class DemBlock(Block):
    """The elevation model that the heights become."""

    posting_m: Number | None = Field(
        default=None,
        ge=0.1,
        le=10_000,
        description="Distance of the posts. With radar.azimuth_resolution_m (or "
        "doppler_bandwidth_hz) it gives the looks; without it radar.looks counts.",
    )
    resolution_over_posting: Number = Field(
        default=1.0,
        ge=0.5,
        le=10,
        description="Extent that is averaged for a post, in postings; 1: posts are independent.",
    )
    cell_km: Number = Field(
        default=100.0,
        ge=1,
        le=2000,
        description="Extent of the cell within which points are compared for the relative error.",
    )
    swath_km: Number | None = Field(
        default=None,
        ge=1,
        le=1000,
        description="Extent across track of a scene; by default that of errors.calibration, "
        "else of the radar's beams, else 30.",
    )
    specifications: Annotated[tuple[SpecificationItem, ...], Field(max_length=10)] = Field(
        default=("hrti3",),
        description="Classes to judge by: hrti3, hrti4, dted2, or a block of your own limits.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = [one if isinstance(one, str) else one.name for one in self.specifications]
        for position, name in enumerate(names):
            if name in names[:position]:
                raise wrong(("specifications", position), "is listed twice", "list each class once")
        return self


def check_looks(dem: DemBlock, radar: RadarBlock) -> None:
    """The looks are given, or follow from posting and resolution."""
    if dem.posting_m is None or "looks" in radar.model_fields_set:
        return
    if (radar.azimuth_resolution_m, radar.doppler_bandwidth_hz) == (None, None):
        raise wrong(
            ("dem", "posting_m"),
            "gives the looks only together with radar.azimuth_resolution_m",
            "add radar.azimuth_resolution_m: 3, or radar.looks",
        )
