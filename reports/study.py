"""What a report says of the study behind a result, and of how it was run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a report of a study without one does not pay for its import
    from insar.observe import Observation
    from insar.observe.agile.staring import StaringScene


@dataclass(frozen=True, kw_only=True)
class StudyInfo:
    """The study that was run.

    Attributes
    ----------
    name : title of the report.
    kind : what was run, such as ``optimize``.
    description : the study's own words; may be empty.
    source_text : the study file as run (YAML).
    config_sha256 : digest of that file.
    effective : the study as validated, with every default filled in (YAML); None to leave it out.
    orbit_altitude : scalar — height of the reference orbit above the equatorial radius [m]; None
        where the study has several orbits, or none.
    inclination : scalar — of the reference orbit [rad]; None likewise.
    observation : where the scene comes from, a pass over targets or one place that is watched; None
        if the study gives it.
    inputs : the files that the study reads, each with its SHA-256.
    inferred : inputs that are not the source's but inferred, key and value.
    """

    name: str
    kind: str
    description: str
    source_text: str
    config_sha256: str
    effective: str | None = None
    orbit_altitude: float | None = None
    inclination: float | None = None
    observation: Observation | StaringScene | None = None
    inputs: tuple[tuple[str, str], ...] = ()
    inferred: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """How the result came about, so that anyone can repeat it.

    Attributes
    ----------
    version : of formation-opt.
    seed : of the random generator; None where nothing is random.
    python, platform : of the machine.
    packages : package → version, those that the numbers depend on.
    started : date and time, ISO 8601.
    wall_s : duration of the run [s].
    evaluations : formations scored.
    compiled : whether compiled loops scored them instead of arrays; None where nothing is searched.
    command : the command as given.
    """

    version: str
    seed: int | None
    python: str
    platform: str
    packages: Mapping[str, str]
    started: str
    wall_s: float
    evaluations: int
    command: str
    compiled: bool | None = None
