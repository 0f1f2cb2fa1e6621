"""The kind of study that measures a terrain end to end."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from formation import Orbit

from .base import Block
from .blocks import ErrorsBlock, RadarBlock
from .checks import check_drift, check_images, check_members, check_names
from .formations import Family, Satellites, Sign
from .orbits import OrbitBlock, build_reference
from .study import Study
from .terrain import SimulationBlock, TerrainBlock


class FlownFormation(Block):
    """The formation that flies over the terrain, satellite by satellite."""

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


class SimulateStudy(Study):
    """Measure the heights of a terrain, end to end: true paths, speckle, wrapped phases."""

    kind: Literal["simulate"] = Field(description="What the study does.")
    orbit: OrbitBlock = Field(description="The reference orbit.")
    radar: RadarBlock = Field(description="The radar and its images.")
    terrain: TerrainBlock = Field(description="The terrain, and how it is seen.")
    errors: ErrorsBlock = Field(description="The error budget; scale pixel is not drawn here.")
    formation: FlownFormation = Field(description="The formation that flies over it.")
    simulation: SimulationBlock = Field(
        default=SimulationBlock(), description="How often it is flown over."
    )

    @property
    def reference_orbit(self) -> Orbit:
        """The circular reference orbit, in SI units."""
        return build_reference(self.orbit)

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = self.formation.names
        check_names(names)
        check_images(self.radar, names)
        check_members(self.formation.satellites, names, ("formation", "satellites"))
        check_drift(self.formation.satellites, self.reference_orbit, ("formation", "satellites"))
        return self
