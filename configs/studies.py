"""The kinds of study. A new kind is a class here and a line in `STUDIES`."""

from __future__ import annotations

import math
from typing import Any, Literal, Self, Union

from pydantic import Field, TypeAdapter, model_validator

from formation import Orbit

from .base import Block, Prose, StudyName
from .blocks import ErrorsBlock, OrbitBlock, RadarBlock
from .checks import (
    check_drift,
    check_images,
    check_labels,
    check_members,
    check_names,
    check_size,
    check_strip,
    check_table,
)
from .formations import ComparedFormation, EvaluatedFormation, SearchedFormation
from .limits import LimitsBlock, SearchBlock, SearchLimitsBlock
from .scenes import SceneBlock


class Study(Block):
    """What every study says."""

    kind: str = Field(description="What the study does.")
    name: StudyName = Field(
        default="study",
        description="Name in the report and of the output folder: letters, digits, '.', '-' and "
        "'_'; the name of the file if absent.",
    )
    description: Prose = Field(default="", description="What the study is for, in words.")


class FormationStudy(Study):
    """What the studies that score formations have in common."""

    orbit: OrbitBlock = Field(description="The reference orbit.")
    radar: RadarBlock = Field(description="The radar and its images.")
    scene: SceneBlock = Field(description="What is observed.")
    errors: ErrorsBlock = Field(description="The error budget.")
    compare: tuple[ComparedFormation, ...] = Field(
        default=(),
        max_length=20,
        description="Formations evaluated and shown beside the result; they may break limits.",
    )

    @property
    def reference_orbit(self) -> Orbit:
        """The reference orbit, in SI units."""
        return Orbit.circular(
            altitude=1e3 * self.orbit.altitude_km,
            inclination=math.radians(self.orbit.inclination_deg),
        )

    def _check_common(self, names: tuple[str, ...]) -> None:
        orbit = self.reference_orbit
        if self.scene.strip is not None:
            check_strip(self.scene.strip, orbit)
        if self.scene.table is not None:
            check_table(self.scene.table, orbit)
        check_names(names)
        check_images(self.radar, names)
        check_labels(self.compare)
        for index, compared in enumerate(self.compare):
            check_members(compared.satellites, names, ("compare", index, "satellites"))
            check_drift(compared.satellites, orbit, ("compare", index, "satellites"))


class OptimizeStudy(FormationStudy):
    """Search the formation with the smallest height error within limits."""

    kind: Literal["optimize"] = Field(default="optimize", description="What the study does.")
    formation: SearchedFormation = Field(description="The satellites and their relative orbits.")
    constraints: SearchLimitsBlock = Field(
        default=SearchLimitsBlock(), description="Limits that the search keeps."
    )
    search: SearchBlock = Field(default=SearchBlock(), description="How it is searched.")

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = self.formation.names
        self._check_common(names)
        check_size(self.radar, self.scene, len(names), self.search.population)
        if self.formation.initial is not None:
            check_members(self.formation.initial, names, ("formation", "initial"))
        return self


class EvaluateStudy(FormationStudy):
    """Score a given formation, without any search."""

    kind: Literal["evaluate"] = Field(description="What the study does.")
    formation: EvaluatedFormation = Field(description="The formation that is scored.")
    constraints: LimitsBlock = Field(
        default=LimitsBlock(), description="Limits to report against; none is enforced."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = self.formation.names
        self._check_common(names)
        check_size(self.radar, self.scene, len(names), 1)
        check_members(self.formation.satellites, names, ("formation", "satellites"))
        check_drift(self.formation.satellites, self.reference_orbit, ("formation", "satellites"))
        return self


DEFAULT_KIND = "optimize"
STUDIES: dict[str, type[Study]] = {"optimize": OptimizeStudy, "evaluate": EvaluateStudy}


def json_schema() -> dict[str, Any]:
    """JSON schema of a study of any kind, for editors and for documentation."""
    kinds: Any = Union[tuple(STUDIES.values())]  # noqa: UP007 — of a run-time list
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A study of formation-opt",
        **TypeAdapter(kinds).json_schema(),
    }
