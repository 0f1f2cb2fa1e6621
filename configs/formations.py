"""The blocks that describe formations: searched, given, and compared with."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Label, Name, Number, Whole, wrong
from .tables import MAX_SATELLITES, Acquisitions, Placed, PlacedSatellite

Family = Literal["ground_track_circular", "space_circular"]
Sign = Literal["positive", "negative"]

Offset = Annotated[Number, Field(ge=-20_000, le=20_000)]
Rate = Annotated[Number, Field(ge=-30, le=30)]
Position = tuple[
    Annotated[Number, Field(ge=-40_000, le=40_000)],
    Annotated[Number, Field(ge=-40_000, le=40_000)],
    Annotated[Number, Field(ge=-40_000, le=40_000)],
]
Velocity = tuple[
    Annotated[Number, Field(ge=-60, le=60)],
    Annotated[Number, Field(ge=-60, le=60)],
    Annotated[Number, Field(ge=-60, le=60)],
]


class RadialStart(Block):
    """A satellite of a circular family: its radial offset and rate at t = 0."""

    name: Name | None = Field(
        default=None, description="Which satellite this is; in the order of the study if absent."
    )
    z0_m: Offset = Field(description="Radial offset from the reference orbit, positive outward.")
    zdot0_m_s: Rate = Field(description="Radial rate.")


class Satellite(Block):
    """A satellite of a given formation: z0_m and zdot0_m_s of a family, or a whole state."""

    name: Name | None = Field(
        default=None, description="Which satellite this is; in the order of the study if absent."
    )
    z0_m: Offset | None = Field(
        default=None, description="Radial offset from the reference orbit, positive outward."
    )
    zdot0_m_s: Rate | None = Field(default=None, description="Radial rate.")
    position_rtn_m: Position | None = Field(
        default=None,
        description="Position at t = 0: radial outward, along track, along the orbit normal.",
    )
    velocity_rtn_m_s: Velocity | None = Field(
        default=None,
        description="Velocity in the rotating RTN frame at t = 0; drift-free where its T "
        "component is -2 n R.",
    )

    @property
    def radial_start(self) -> tuple[float, float]:
        """Radial offset and rate [m, m/s]."""
        return self.z0_m or 0.0, self.zdot0_m_s or 0.0

    @property
    def state(self) -> tuple[float, ...] | None:
        """RTN state at t = 0, if it is given whole [m, m/s]."""
        if self.position_rtn_m is None or self.velocity_rtn_m_s is None:
            return None
        return *self.position_rtn_m, *self.velocity_rtn_m_s

    @model_validator(mode="after")
    def _check(self) -> Self:
        radial = [self.z0_m is not None, self.zdot0_m_s is not None]
        state = [self.position_rtn_m is not None, self.velocity_rtn_m_s is not None]
        if not (all(radial) and not any(state)) and not (all(state) and not any(radial)):
            raise wrong(
                (),
                "needs either z0_m and zdot0_m_s, or position_rtn_m and velocity_rtn_m_s",
                "give both keys of one pair and none of the other",
            )
        return self


Satellites = Annotated[tuple[Satellite, ...], Field(min_length=2, max_length=MAX_SATELLITES)]


class EvaluatedFormation(Block):
    """The formation that is evaluated, satellite by satellite."""

    family: Family = Field(
        default="ground_track_circular",
        description="Relative orbit of satellites given by z0_m and zdot0_m_s: a circle seen from "
        "above, or a circle in space.",
    )
    cross_track_sign: Sign = Field(
        default="positive",
        description="Sign of the orbit-normal motion against the radial one, in the family.",
    )
    satellites: Satellites | None = Field(
        default=None, description="The satellites at t = 0, on orbits; or give table."
    )
    table: Placed | None = Field(
        default=None,
        description="The satellites by positions or baselines in the scene's segments, on whatever "
        "orbits; the first is the one that baselines start from.",
    )
    acquisitions: Acquisitions | None = Field(
        default=None,
        description="Several acquisitions of the scene, each with a table of its own; their errors "
        "are independent, and they are assessed apart and combined.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        shapes = ("satellites", "table", "acquisitions")
        _one_of(self, shapes)
        if self.satellites is None:
            _no_orbits(self, ("family", "cross_track_sign"))
        return self

    @property
    def members(self) -> Sequence[Satellite | PlacedSatellite]:
        """The satellites; of several acquisitions, those of the first."""
        if self.acquisitions is not None:
            return self.acquisitions[0].table
        return self.satellites or self.table or ()

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each satellite."""
        return tuple(s.name or f"S{i}" for i, s in enumerate(self.members, start=1))


class ComparedFormation(Block):
    """A formation that is evaluated and shown beside the result."""

    label: Label = Field(description="What the report calls it.")
    family: Family | None = Field(
        default=None, description="Relative orbit of its satellites; that of the study if absent."
    )
    cross_track_sign: Sign | None = Field(
        default=None,
        description="Sign of the orbit-normal motion against the radial one; that of the study "
        "(positive for either) if absent.",
    )
    satellites: Satellites | None = Field(
        default=None, description="The satellites at t = 0, on orbits; or give table."
    )
    table: Placed | None = Field(
        default=None,
        description="The satellites by positions or baselines in the scene's segments.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        _one_of(self, ("satellites", "table"))
        if self.satellites is None:
            _no_orbits(self, ("family", "cross_track_sign"))
        return self


def _one_of(block: Block, keys: tuple[str, ...]) -> None:
    given = [key for key in keys if getattr(block, key) is not None]
    if len(given) != 1:
        raise wrong(
            (),
            f"needs exactly one of {', '.join(keys[:-1])} and {keys[-1]}",
            "keep one of them" if given else "add one of them",
        )


def _no_orbits(block: Block, keys: tuple[str, ...]) -> None:
    """Keys that make orbits say nothing of satellites that are placed."""
    for key in keys:
        if getattr(block, key) != type(block).model_fields[key].default:
            raise wrong(
                (key,),
                "makes orbits of z0_m and zdot0_m_s, and this formation is given by positions",
                "remove it",
            )


def _form_of_satellites(value: Any) -> str:
    return "list" if isinstance(value, list | tuple) else "count"


class SearchedFormation(Block):
    """The formation that is searched."""

    satellites: Annotated[
        Annotated[Annotated[Whole, Field(ge=2, le=MAX_SATELLITES)], Tag("count")]
        | Annotated[
            Annotated[tuple[Name, ...], Field(min_length=2, max_length=MAX_SATELLITES)],
            Tag("list"),
        ],
        Discriminator(_form_of_satellites),
    ] = Field(description="How many satellites (then called S1, S2, ...), or their names.")
    family: Family = Field(
        default="ground_track_circular",
        description="Relative orbit: a circle seen from above, or a circle in space.",
    )
    cross_track_sign: Literal["positive", "negative", "either"] = Field(
        default="either",
        description="Sign of the orbit-normal motion against the radial one; either: the search "
        "chooses.",
    )
    initial: tuple[RadialStart, ...] | None = Field(
        default=None,
        max_length=MAX_SATELLITES,
        description="Formation to start from and to compare with; equally spaced on the largest "
        "allowed orbit if absent.",
    )

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each satellite."""
        if isinstance(self.satellites, int):
            return tuple(f"S{i}" for i in range(1, self.satellites + 1))
        return self.satellites
