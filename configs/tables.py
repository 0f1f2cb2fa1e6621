"""The blocks of formations that are given by positions or baselines, segment by segment."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Label, Name, Number, wrong

MAX_SATELLITES = 20
_SEGMENTS = 1000

Meters = Annotated[Number, Field(ge=-100_000, le=100_000)]
Place = tuple[Meters, Meters, Meters]
Ambiguity = Annotated[Number, Field(ge=0.1, le=100_000)]


def _form_of_number(value: Any) -> str:
    return "list" if isinstance(value, list | tuple) else "one"


def _form_of_place(value: Any) -> str:
    several = isinstance(value, list | tuple) and any(
        isinstance(one, list | tuple) for one in value
    )
    return "list" if several else "one"


Baselines = Annotated[
    Annotated[Meters, Tag("one")]
    | Annotated[
        Annotated[tuple[Meters, ...], Field(min_length=1, max_length=_SEGMENTS)], Tag("list")
    ],
    Discriminator(_form_of_number),
]
Ambiguities = Annotated[
    Annotated[Ambiguity, Tag("one")]
    | Annotated[
        Annotated[tuple[Ambiguity, ...], Field(min_length=1, max_length=_SEGMENTS)], Tag("list")
    ],
    Discriminator(_form_of_number),
]
Places = Annotated[
    Annotated[Place, Tag("one")]
    | Annotated[
        Annotated[tuple[Place, ...], Field(min_length=1, max_length=_SEGMENTS)], Tag("list")
    ],
    Discriminator(_form_of_place),
]


class PlacedSatellite(Block):
    """A satellite by where it is; one value for all segments, or a list of one for each."""

    name: Name | None = Field(
        default=None, description="Which satellite this is; in the order of the study if absent."
    )
    position_rtn_m: Places | None = Field(
        default=None,
        description="Position: radial outward, along track, along the orbit normal. One of three "
        "numbers, or a list of such, one a segment.",
    )
    perpendicular_baseline_m: Baselines | None = Field(
        default=None,
        description="Baseline from the first satellite across the line of sight, in the direction "
        "in which a rising target moves.",
    )
    height_of_ambiguity_m: Ambiguities | None = Field(
        default=None,
        description="Height of ambiguity with the first satellite, instead of the baseline.",
    )
    along_track_baseline_m: Baselines | None = Field(
        default=None,
        description="Baseline from the first satellite along the azimuth of the image, beside one "
        "of the other two; default 0.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        shapes = ("position_rtn_m", "perpendicular_baseline_m", "height_of_ambiguity_m")
        given = [key for key in shapes if getattr(self, key) is not None]
        if len(given) > 1:
            raise wrong((given[1],), f"contradicts {given[0]}, the same place", "keep one of them")
        if self.along_track_baseline_m is not None and given in ([], ["position_rtn_m"]):
            raise wrong(
                ("along_track_baseline_m",),
                "belongs to a satellite that is given by its baseline"
                if not given
                else "is contained in position_rtn_m already",
                "add perpendicular_baseline_m" if not given else "remove it",
            )
        return self

    @property
    def at_origin(self) -> bool:
        """Whether only its name is given, if any: the satellite that baselines start from."""
        return (
            self.position_rtn_m is None
            and self.perpendicular_baseline_m is None
            and self.height_of_ambiguity_m is None
        )


Placed = Annotated[tuple[PlacedSatellite, ...], Field(min_length=2, max_length=MAX_SATELLITES)]


class AcquisitionBlock(Block):
    """One acquisition of the scene, with baselines of its own."""

    label: Label = Field(description="What the report calls it.")
    table: Placed = Field(description="The satellites while it lasts.")


Acquisitions = Annotated[tuple[AcquisitionBlock, ...], Field(min_length=2, max_length=12)]
