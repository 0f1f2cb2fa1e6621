"""The blocks that describe formations: searched, given, and compared with."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Label, Name, Number, Whole, wrong

Family = Literal["ground_track_circular", "space_circular"]
Sign = Literal["positive", "negative"]
MAX_SATELLITES = 20

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
    satellites: Satellites = Field(description="The satellites at t = 0.")

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each satellite."""
        return tuple(s.name or f"S{i}" for i, s in enumerate(self.satellites, start=1))


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
    satellites: Satellites = Field(description="The satellites at t = 0.")


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
