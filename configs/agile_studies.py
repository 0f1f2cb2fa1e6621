"""The kinds of study in which satellites turn to places, or are counted that see them."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .agile import (
    AgilityBlock,
    AntennaBlock,
    BeamBlock,
    Duration,
    PointingError,
    Samples,
    SpotlightBlock,
    VideoBlock,
    YawBlock,
)
from .agile_claims import CoverageClaimBlock, SpotlightClaimBlock, VideoClaimBlock
from .base import Whole, wrong
from .checks import check_placed
from .coverage import (
    SimulationBlock,
    SizingBlock,
    VisibilityBlock,
    WalkerBlock,
    WalkerSearchBlock,
)
from .orbits import OrbitBlock
from .steering import SteeredRadarBlock
from .study import SourcedStudy


class AgileStudy(SourcedStudy):
    """What the studies of a satellite that turns as a whole have in common."""

    orbit: OrbitBlock = Field(description="The orbit.")
    radar: SteeredRadarBlock = Field(description="The radar.")
    agility: AgilityBlock = Field(
        default=AgilityBlock(), description="How fast the satellite can turn; no limits if absent."
    )
    samples: Samples = Field(
        default=1001,
        description="Samples of the attitude, both ends included; an odd number has zero Doppler "
        "among them.",
    )

    @model_validator(mode="after")
    def _check_orbit(self) -> Self:
        check_placed(self.orbit)
        return self


class SpotlightStudy(AgileStudy):
    """Turn a satellite so that its beam stays on a place, for an image of high resolution."""

    kind: Literal["spotlight"] = Field(description="What the study does.")
    spotlight: SpotlightBlock = Field(description="The place, the pass and the image.")
    antenna: AntennaBlock = Field(
        default=AntennaBlock(), description="Where the beam leaves the body."
    )
    duration_s: Duration | None = Field(
        default=None,
        description="Of the attitude that is computed, centered on zero Doppler; the imaging time "
        "if absent.",
    )
    claims: tuple[SpotlightClaimBlock, ...] = Field(
        default=(), max_length=100, description="Printed figures to compare with."
    )


class VideoStudy(AgileStudy):
    """Turn a satellite so that its beam stays on a place, for a film of it."""

    kind: Literal["video"] = Field(description="What the study does.")
    video: VideoBlock = Field(description="The place, the pass and the film.")
    beam: BeamBlock = Field(description="The beam, for the footprints.")
    yaw: YawBlock = Field(
        default=YawBlock(), description="What the turn about the line of sight does."
    )
    pointing_error_deg: tuple[PointingError, PointingError, PointingError] = Field(
        default=(0, 0, 0),
        description="Standard deviations of small turns of the body about X, Y and Z.",
    )
    footprints: Annotated[Whole, Field(ge=2, le=1001)] = Field(
        default=101, description="Outlines of the beam on the ground, equally spaced over the film."
    )
    claims: tuple[VideoClaimBlock, ...] = Field(
        default=(), max_length=100, description="Printed figures to compare with."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        half = 0.5 * self.video.duration_s
        if abs(self.yaw.reference_time_s) > half:
            raise wrong(
                ("yaw", "reference_time_s"),
                f"lies outside the film, which is from -{half:g} to {half:g} s about zero Doppler",
                "choose a moment of the film",
            )
        return self


class CoverageStudy(SourcedStudy):
    """How well constellations keep places in view, and how many satellites that takes."""

    kind: Literal["coverage"] = Field(description="What the study does.")
    visibility: VisibilityBlock = Field(description="From where a satellite images a place.")
    sizing: SizingBlock | None = Field(
        default=None, description="The sizing of Liang 2018, and why it falls short."
    )
    constellations: tuple[WalkerBlock, ...] = Field(
        default=(), max_length=12, description="Constellations to simulate."
    )
    search: WalkerSearchBlock | None = Field(
        default=None, description="The smallest constellation with continuous cover."
    )
    simulation: SimulationBlock = Field(
        default=SimulationBlock(),
        description="Where and for how long constellations are simulated: the sized one, those "
        "given, and the one that is found.",
    )
    claims: tuple[CoverageClaimBlock, ...] = Field(
        default=(), max_length=100, description="Printed figures to compare with."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.sizing is None and self.search is None and not self.constellations:
            raise wrong(
                (), "asks for nothing", "add at least one of sizing, constellations and search"
            )
        return self
