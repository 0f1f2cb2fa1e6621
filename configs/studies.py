"""The kinds of study. A new kind is a class here or in `agile_studies`, and a line in `STUDIES`."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self, Union

from pydantic import Field, TypeAdapter, model_validator

from formation import Orbit

from .agile_studies import CoverageStudy, SpotlightStudy, VideoStudy
from .base import Whole
from .blocks import ErrorsBlock, RadarBlock
from .certificate import CertificateBlock
from .checks import (
    check_images,
    check_labels,
    check_members,
    check_names,
    check_observation,
    check_placed,
    check_shell,
    check_size,
    check_strip,
    check_table,
)
from .claims import ClaimBlock
from .dem import DemBlock, check_looks
from .formations import ComparedFormation, EvaluatedFormation, SearchedFormation
from .limits import LimitsBlock, SearchBlock, SearchLimitsBlock
from .mission_claims import (
    MissionClaimBlock,
    OpenBlock,
    check_mission_claims,
    check_open,
)
from .observation import SideName
from .orbits import OrbitBlock, build_reference
from .refutation import RefutationBlock
from .scenes import SceneBlock
from .simulate_study import SimulateStudy
from .steering import (
    LAWS,
    BoresightBlock,
    CaseBlock,
    CompensationBlock,
    Laws,
    SelectionBlock,
    SteeredRadarBlock,
    SwathOffset,
    check_laws,
)
from .steering_checks import check_cases, check_claims, check_samples
from .study import Study
from .table_checks import (
    COMBINED,
    check_compared,
    check_evaluated,
    check_flown,
    check_joint,
    check_no_orbit_limits,
)


class FormationStudy(Study):
    """What the studies that score formations have in common."""

    orbit: OrbitBlock = Field(description="The reference orbit.")
    radar: RadarBlock = Field(description="The radar and its images.")
    scene: SceneBlock = Field(description="What is observed.")
    errors: ErrorsBlock = Field(description="The error budget.")
    dem: DemBlock | None = Field(
        default=None, description="The elevation model that is wanted; null judges none."
    )
    compare: tuple[ComparedFormation, ...] = Field(
        default=(),
        max_length=20,
        description="Formations evaluated and shown beside the result; they may break limits.",
    )
    refutation: RefutationBlock | None = Field(
        default=RefutationBlock(),
        description="Simulation that tries to refute the predicted errors; null: none.",
    )

    @property
    def reference_orbit(self) -> Orbit:
        """The circular reference orbit, in SI units."""
        return build_reference(self.orbit)

    def _check_common(self, names: tuple[str, ...]) -> None:
        orbit = self.reference_orbit
        if self.scene.strip is not None:
            check_strip(self.scene.strip, orbit)
        if self.scene.table is not None:
            check_table(self.scene.table, orbit)
        if self.scene.observation is not None:
            check_observation(self.scene.observation, self.orbit)
        if self.scene.staring is not None:
            check_placed(self.orbit)
        check_names(names)
        check_images(self.radar, names)
        check_shell(self.errors, orbit)
        if self.dem is not None:
            check_looks(self.dem, self.radar)
        check_labels(self.compare)
        for index, compared in enumerate(self.compare):
            check_compared(compared, names, orbit, ("compare", index))


class OptimizeStudy(FormationStudy):
    """Search the formation with the smallest height error within limits."""

    kind: Literal["optimize"] = Field(default="optimize", description="What the study does.")
    formation: SearchedFormation = Field(description="The satellites and their relative orbits.")
    constraints: SearchLimitsBlock = Field(
        default=SearchLimitsBlock(), description="Limits that the search keeps."
    )
    search: SearchBlock = Field(default=SearchBlock(), description="How it is searched.")
    certificate: CertificateBlock | None = Field(
        default=CertificateBlock(),
        description="Proof of how far from the best possible the result is; null: none.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = self.formation.names
        self._check_common(names)
        check_size(self.radar, self.scene, len(names), self.search.population * self.search.islands)
        check_flown(self.compare)
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
    claims: tuple[MissionClaimBlock, ...] = Field(
        default=(), max_length=100, description="Printed figures to compare with."
    )
    open: tuple[OpenBlock, ...] = Field(
        default=(),
        max_length=5,
        description="Numbers that the source of the claims does not publish; each claim is also "
        "computed at all combinations of their ends.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = self.formation.names
        self._check_common(names)
        check_evaluated(self.formation, self.reference_orbit)
        acquisitions = self.formation.acquisitions
        if acquisitions is not None:
            check_joint(self.errors)
        check_size(self.radar, self.scene, len(names), len(acquisitions or (1,)) ** 2)
        check_open(self.open, self)
        check_mission_claims(
            self.claims, labels=self.labels, names=names, segments=self.scene.given.count
        )
        if self.formation.satellites is None or any(one.table for one in self.compare):
            check_no_orbit_limits(self.constraints)
        return self

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of all its formations, that of the study first."""
        acquisitions = self.formation.acquisitions
        own = (
            ("formation",) if acquisitions is None else (COMBINED, *(a.label for a in acquisitions))
        )
        return (*own, *(one.label for one in self.compare))


class SteeringStudy(Study):
    """Compare attitude steering laws around orbits, and check printed figures."""

    kind: Literal["steering"] = Field(description="What the study does.")
    radar: SteeredRadarBlock = Field(description="The radar.")
    side: SideName = Field(
        default="right", description="Side of the flight direction that the radar looks to."
    )
    boresight: BoresightBlock = Field(description="What the center of the beam holds constant.")
    laws: Laws = Field(default=LAWS, description="Steering laws to compare.")
    samples: Whole = Field(
        default=721, ge=9, le=100_001, description="Samples of a revolution, both ends included."
    )
    revolutions: Whole = Field(
        default=1, ge=1, le=100, description="Revolutions that are computed, from the epoch on."
    )
    swath_offsets_deg: Annotated[tuple[SwathOffset, ...], Field(min_length=1, max_length=21)] = (
        Field(
            default=(-0.5, -0.25, 0, 0.25, 0.5),
            description="Elevations off the boresight, positive away from nadir, at which the "
            "Doppler is computed.",
        )
    )
    cases: Annotated[tuple[CaseBlock, ...], Field(min_length=1, max_length=12)] = Field(
        description="Orbits on which the laws are compared."
    )
    selections: tuple[SelectionBlock, ...] = Field(
        default=(),
        max_length=6,
        description="Where which of two laws is the better one: over altitude and inclination.",
    )
    compensation: CompensationBlock | None = Field(
        default=None, description="How much the simplified yaw law of Meng 2003 compensates."
    )
    claims: tuple[ClaimBlock, ...] = Field(
        default=(), max_length=100, description="Printed figures to compare with."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_laws(self.laws)
        check_cases(self.cases, self.boresight)
        check_samples(
            self.cases,
            self.laws,
            samples=self.samples * self.revolutions,
            offsets=len(self.swath_offsets_deg),
        )
        check_claims(
            self.claims,
            cases=self.cases,
            laws=self.laws,
            selections=self.selections,
            compensation=self.compensation,
        )
        return self


DEFAULT_KIND = "optimize"
STUDIES: dict[str, type[Study]] = {
    "optimize": OptimizeStudy,
    "evaluate": EvaluateStudy,
    "steering": SteeringStudy,
    "spotlight": SpotlightStudy,
    "video": VideoStudy,
    "coverage": CoverageStudy,
    "simulate": SimulateStudy,
}


def json_schema() -> dict[str, Any]:
    """JSON schema of a study of any kind, for editors and for documentation."""
    kinds: Any = Union[tuple(STUDIES.values())]  # noqa: UP007 — of a run-time list
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A study of formation-opt",
        **TypeAdapter(kinds).json_schema(),
    }
