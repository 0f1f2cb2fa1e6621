"""The blocks of a study of coverage by Walker constellations."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .base import Block, Number, Whole, wrong
from .observation import Latitude

MAX_PATTERNS = 100_000
"""Patterns of a search: some minutes."""

Altitude = Annotated[Number, Field(ge=150, le=6_000)]
Inclination = Annotated[Number, Field(ge=0, le=180)]
Satellites = Annotated[Whole, Field(ge=1, le=2_000)]
Phasing = Annotated[Whole, Field(ge=0, le=1_999)]


class VisibilityBlock(Block):
    """From where a satellite can image a target: an annulus around it, or one half of it."""

    min_incidence_deg: Annotated[Number, Field(ge=0, le=85)] = Field(
        default=20.0,
        description="Smallest zenith angle of the satellite at the target: at the nadir, range "
        "does not resolve the ground.",
    )
    max_incidence_deg: Annotated[Number, Field(ge=10, le=85)] = Field(
        description="Largest zenith angle of the satellite at the target."
    )
    side: Literal["either", "left", "right"] = Field(
        default="either",
        description="Side of the orbit plane that can be seen; either for a satellite that turns "
        "to both.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.min_incidence_deg >= self.max_incidence_deg:
            raise wrong(
                ("min_incidence_deg",),
                f"must be below max_incidence_deg, {self.max_incidence_deg:g}",
                "check that the two are not swapped",
            )
        return self


class SizingBlock(Block):
    """The sizing of Liang 2018: satellites that follow each other, and planes side by side."""

    altitude_km: Altitude = Field(
        description="Height of the circular orbits above the equatorial radius, 6378.137 km."
    )
    inclination_deg: Inclination = Field(
        description="Angle between the orbits and the equator; does not enter the sizing."
    )
    phasing: Phasing = Field(
        default=0, description="F of the sized pattern, which the paper leaves open."
    )
    latitude_deg: Latitude = Field(
        description="Geodetic latitude of the place for which the shortfall is explained."
    )


class WalkerBlock(Block):
    """A Walker constellation T/P/F of circular orbits."""

    altitude_km: Altitude = Field(
        description="Height of the orbits above the equatorial radius, 6378.137 km."
    )
    inclination_deg: Inclination = Field(description="Angle between the orbits and the equator.")
    satellites: Satellites = Field(description="T: of the whole constellation.")
    planes: Satellites = Field(description="P: orbital planes; divides the satellites.")
    phasing: Phasing = Field(
        default=0,
        description="F: how far the satellites of a plane lead those of the plane to its west, in "
        "units of 1/T of a revolution; 0 to planes - 1.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.satellites % self.planes:
            raise wrong(
                ("planes",),
                f"must divide the satellites, {self.satellites}",
                "give every plane as many satellites",
            )
        if self.phasing >= self.planes:
            raise wrong(
                ("phasing",),
                f"must be less than the planes, {self.planes}",
                f"the same pattern has {self.phasing % self.planes}",
            )
        return self


class SimulationBlock(Block):
    """Where, and for how long, constellations are simulated."""

    latitudes_deg: tuple[Latitude, Latitude] = Field(
        default=(0, 80), description="Geodetic latitudes of the places: from, to."
    )
    latitude_samples: Annotated[Whole, Field(ge=2, le=361)] = Field(
        default=17, description="Latitudes between the two, equally spaced."
    )
    longitudes: Annotated[Whole, Field(ge=1, le=360)] = Field(
        default=8,
        description="Places at each latitude, from one orbital plane to the next; the others "
        "see the same, some time later.",
    )
    duration_days: Annotated[Number, Field(gt=0, le=60)] = Field(
        default=1.0, description="How long they are watched."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check_order(self.latitudes_deg)
        return self


class WalkerSearchBlock(Block):
    """Search of the smallest Walker constellation that sees every place of a band at all times."""

    altitude_km: Altitude = Field(
        description="Height of the orbits above the equatorial radius, 6378.137 km."
    )
    inclinations_deg: Annotated[tuple[Inclination, ...], Field(min_length=1, max_length=12)] = (
        Field(description="Inclinations to try.")
    )
    satellites: tuple[Satellites, Satellites] = Field(
        description="Numbers of satellites to try: from, to."
    )
    satellite_step: Annotated[Whole, Field(ge=1, le=100)] = Field(
        default=1, description="Of the numbers of satellites; above 1 a smaller one may be missed."
    )
    max_planes: Satellites | None = Field(
        default=None, description="Patterns with more planes are left out; none if absent."
    )
    latitudes_deg: tuple[Latitude, Latitude] = Field(
        description="Geodetic latitudes of the band: from, to; the same twice for one."
    )
    latitude_samples: Annotated[Whole, Field(ge=2, le=91)] = Field(
        default=5, description="Latitudes of the band at which cover and gaps are counted."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        first, last = self.satellites
        if first > last:
            raise wrong(
                ("satellites",), "must not shrink: from, to", "check that the two are not swapped"
            )
        _check_order(self.latitudes_deg, strict=False)
        patterns = len(self.inclinations_deg) * sum(map(self._patterns, self.totals))
        if patterns > MAX_PATTERNS:
            raise wrong(
                ("satellites",),
                f"makes {patterns} patterns of planes and phasing, and {MAX_PATTERNS} is the limit",
                "narrow it, add max_planes: 40, or a larger satellite_step",
            )
        return self

    @property
    def totals(self) -> range:
        """Numbers of satellites to try."""
        first, last = self.satellites
        return range(first, last + 1, self.satellite_step)

    def _patterns(self, total: int) -> int:
        """How many patterns of that many satellites there are: P for each P."""
        most = total if self.max_planes is None else min(total, self.max_planes)
        return sum(planes for planes in range(1, most + 1) if total % planes == 0)


def _check_order(latitudes: tuple[float, float], *, strict: bool = True) -> None:
    first, last = latitudes
    if first > last or (strict and first == last):
        raise wrong(
            ("latitudes_deg",),
            "must go from south to north",
            "check that the two are not swapped",
        )
