"""The blocks that describe a terrain and its simulation."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .base import Block, Number, Whole, wrong
from .files import BinaryFile

Index = Annotated[Whole, Field(ge=0, le=100_000)]
Posting = Annotated[Number, Field(ge=0.1, le=10_000)]


class CropBlock(Block):
    """A part of the grid: first row or column, and the one after the last."""

    rows: tuple[Index, Index] | None = Field(
        default=None, description="From north to south, counted from 0; all if absent."
    )
    columns: tuple[Index, Index] | None = Field(
        default=None, description="From west to east, counted from 0; all if absent."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in ("rows", "columns"):
            ends = getattr(self, key)
            if ends is not None and ends[1] - ends[0] < 3:
                raise wrong((key,), "leaves fewer than 3 of the grid", "end it later")
        return self


class TerrainBlock(Block):
    """An elevation model, and how it is seen: broadside from a circular orbit, over a sphere."""

    sample: Literal["jacksboro"] | None = Field(
        default=None,
        description="jacksboro: the elevation model of the Jacksboro fault, Tennessee, of 3 arc "
        "seconds, that comes with Matplotlib; or give file.",
    )
    file: BinaryFile | None = Field(
        default=None,
        description="Heights in meters: a GeoTIFF (needs tifffile), or a NumPy .npy or .npz file.",
    )
    array: Annotated[str, Field(min_length=1, max_length=60)] | None = Field(
        default=None, description="Which array of an .npz file, if it has several."
    )
    posting_m: Posting | tuple[Posting, Posting] | None = Field(
        default=None,
        description="Distance of rows and of columns, or one for both; that of the GeoTIFF if "
        "absent.",
    )
    crop: CropBlock | None = Field(default=None, description="The part that is simulated.")
    look_deg: Annotated[Number, Field(ge=2, le=80)] = Field(
        description="Angle of the line of sight from nadir, at the middle of the terrain."
    )
    side: Literal["left", "right"] = Field(
        default="left", description="Side of the flight direction that is observed."
    )
    heading_deg: Annotated[Number, Field(ge=-360, le=360)] = Field(
        default=350.0,
        description="Flight direction over the terrain, clockwise from north: 350 ascending, 190 "
        "descending for a sun-synchronous orbit at middle latitudes.",
    )
    middle_s: Annotated[Number, Field(ge=-1e6, le=1e6)] = Field(
        default=0.0,
        description="When the middle of the terrain is broadside, since the epoch of the "
        "formation's states.",
    )
    prior_height_std_m: Annotated[Number, Field(ge=0.01, le=1000)] = Field(
        default=4.0,
        description="Standard deviation of the elevation model that is known beforehand: the "
        "terrain with smooth errors.",
    )
    prior_correlation_m: Annotated[Number, Field(ge=0, le=100_000)] = Field(
        default=200.0, description="Width of the Gaussian that smooths these errors; 0 for none."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.sample is None) == (self.file is None):
            raise wrong(
                (),
                "needs exactly one of sample and file",
                "keep one of them" if self.sample else "add 'sample: jacksboro', or a file",
            )
        if self.sample is not None and (self.posting_m, self.array) != (None, None):
            key = "array" if self.posting_m is None else "posting_m"
            raise wrong((key,), "is for a file; the sample brings its own", "remove it")
        return self


class SimulationBlock(Block):
    """How often the terrain is flown over."""

    acquisitions: Whole = Field(
        default=8,
        ge=1,
        le=1000,
        description="Flights, each with errors of the scene, noise and a prior of its own; the "
        "maps are of the first.",
    )
    seed: Whole = Field(
        default=1,
        ge=0,
        le=2**32 - 1,
        description="Seed of the random numbers; the same seed gives the same result.",
    )
