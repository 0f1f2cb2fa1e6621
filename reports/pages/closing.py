"""The end of a report: the study as run, and how to run it again."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from insar import Calibration, ErrorBudget, ErrorSource, Ionosphere, Scene
from insar.atmosphere import TEC_UNIT
from optimize import Problem

from ..document import Block, CodeListing, Column, Section, Table
from ..study import Provenance, StudyInfo
from ..wording import counted, fixed, meters, plain, quantity, source_name


def closing_sections(
    setting: Table, study: StudyInfo, provenance: Provenance
) -> tuple[Section, ...]:
    """The study and its provenance.

    Parameters
    ----------
    setting : what was computed, of `formation_setting` or a page's own.
    study : the study that was run.
    provenance : how it was run.
    """
    blocks: list[Block] = [setting, CodeListing(study.source_text, "The study file as run.")]
    if study.effective is not None:
        blocks.append(
            CodeListing(
                study.effective,
                "The study as validated, with every default filled in.",
                printed=False,
            )
        )
    caption = "Provenance. The same study, seed and version give the same result."
    return (
        Section("study", "The study as run", tuple(blocks)),
        Section("provenance", "Provenance", (facts(_origin(study, provenance), caption),)),
    )


def facts(rows: Sequence[tuple[str, str]], caption: str) -> Table:
    """Table of things and their values."""
    frame = pd.DataFrame(rows, columns=["what", "value"])
    return Table(frame, (Column("what", "Item"), Column("value", "Value")), caption)


def formation_setting(problem: Problem, critical_baseline: float, study: StudyInfo) -> Table:
    """The setting of a formation study."""
    setting = _setting(problem, critical_baseline, study)
    return facts(setting, "The setting: orbit, radar, scene and errors.")


def _setting(problem: Problem, critical_baseline: float, study: StudyInfo) -> list[tuple[str, str]]:
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    prior = problem.constraints.prior_height_std
    sloping = bool(np.any(scene.slope != 0.0))
    transmitters = len({transmitter for transmitter, _ in radar.images})
    return [
        *_orbit(study),
        ("wavelength", f"{plain(radar.wavelength * 1e2)} cm"),
        ("slant-range resolution", f"{plain(radar.slant_range_resolution)} m"),
        ("signal-to-noise ratio", f"{fixed(10.0 * math.log10(radar.snr), 1)} dB"),
        ("looks", f"{radar.looks:g}"),
        ("satellites", str(radar.satellite_count)),
        ("images", f"{len(radar.images)}, of {counted(transmitters, 'transmitter')}"),
        ("scene", counted(len(scene), "segment")),
        ("times of the segments", _times(scene.times)),
        ("look angle", _degrees(scene.look_angle)),
        ("incidence", _incidence(scene)),
        ("azimuth of the line of sight", _degrees(scene.azimuth)),
        ("slant range", _span(scene.slant_range / 1e3, "km", 1)),
        *([("terrain slope, towards the radar", _degrees(scene.slope))] if sloping else []),
        ("critical baseline", f"{meters(critical_baseline, 4)}, the smallest over the scene"),
        (
            "prior height, standard deviation",
            "none" if prior is None else quantity(plain(prior), "m"),
        ),
        *(
            (f"error of {source_name(name)}", _error(source, unit))
            for name, source, unit in (
                ("position", errors.position, "m"),
                ("range", errors.range, "m"),
                ("azimuth", errors.azimuth, "rad"),
                ("synchronization", errors.synchronization, "rad"),
                ("troposphere", errors.troposphere, "m of zenith delay"),
            )
        ),
        ("ionosphere left", _ionosphere(errors.ionosphere)),
        ("calibration", _calibration(errors.calibration)),
        ("weighting", str(errors.weighting)),
        ("baseline decorrelation", str(errors.baseline_decorrelation)),
        *_noise(errors),
        ("held constant while the height changes", str(errors.held_constant)),
    ]


def _noise(errors: ErrorBudget) -> list[tuple[str, str]]:
    if errors.phase_std is not None:
        return [("phase noise of every pair", quantity(plain(errors.phase_std), "rad"))]
    return [("phase statistics", str(errors.phase_statistics))]


def _orbit(study: StudyInfo) -> list[tuple[str, str]]:
    rows = []
    if study.orbit_altitude is not None:
        rows.append(("orbit altitude", f"{fixed(study.orbit_altitude / 1e3, 1)} km"))
    if study.inclination is not None:
        rows.append(("inclination", f"{fixed(math.degrees(study.inclination), 2)}°"))
    if study.observation is not None:
        rows.append(("scene from", "a pass of a real orbit: see Where the geometry lies"))
    return rows


def _times(times: NDArray[np.float64]) -> str:
    low, high = float(times.min()), float(times.max())
    if low == high:
        return f"{plain(low)} s"
    return f"{plain(low)} … {plain(high)} s, a span of {plain(high - low)} s"


def _incidence(scene: Scene) -> str:
    text = _degrees(scene.incidence)
    if np.array_equal(scene.incidence, scene.look_angle):
        text += ", flat Earth (incidence equals look)"
    return text


def _error(source: ErrorSource, unit: str) -> str:
    if source.std == 0.0:
        return "none"
    return (
        f"{quantity(plain(source.std), unit)}, shared by {source.shared_by}, "
        f"constant over the {str(source.scale).replace('_', ' ')}"
    )


def _ionosphere(ionosphere: Ionosphere | None) -> str:
    if ionosphere is None:
        return "none"
    content = quantity(plain(ionosphere.electrons / TEC_UNIT), "TEC units")
    return f"{content}, constant over the {str(ionosphere.scale).replace('_', ' ')}"


def _calibration(calibration: Calibration | None) -> str:
    if calibration is None:
        return "none"
    spacing = (
        f"{plain(calibration.spacing_across / 1e3)} by {plain(calibration.spacing_along / 1e3)}"
    )
    return (
        f"each {str(calibration.over).replace('_', ' ')}, control every {spacing} km, accurate to "
        f"{quantity(plain(calibration.accuracy), 'm')}"
    )


def _degrees(angles: NDArray[np.float64]) -> str:
    return _span(np.rad2deg(angles), "°", 2)


def _span(values: NDArray[np.float64], unit: str, decimals: int) -> str:
    low, high = fixed(float(values.min()), decimals), fixed(float(values.max()), decimals)
    text = low if low == high else f"{low} … {high}"
    return f"{text}{unit}" if unit == "°" else quantity(text, unit)


def _scored(provenance: Provenance) -> str:
    how = {None: "", True: ", in compiled loops", False: ", in arrays"}[provenance.compiled]
    return f"{provenance.evaluations}{how}"


def _origin(study: StudyInfo, provenance: Provenance) -> list[tuple[str, str]]:
    return [
        ("formation-opt", provenance.version),
        ("command", provenance.command),
        ("seed", "none" if provenance.seed is None else str(provenance.seed)),
        ("study file, SHA-256", study.config_sha256),
        *((f"{name}, SHA-256", digest) for name, digest in study.inputs),
        *([("formations scored", _scored(provenance))] if provenance.evaluations else []),
        ("started", provenance.started),
        ("duration", f"{provenance.wall_s:.1f} s"),
        ("Python", provenance.python),
        ("platform", provenance.platform),
        *provenance.packages.items(),
    ]
