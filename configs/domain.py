"""Builds radar, errors and limits from a study: degrees and dB end here."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar import (
    BaselineDecorrelation,
    Calibration,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    Ionosphere,
    PhaseStatistics,
    Radar,
    Scale,
    Scene,
    SharedBy,
    Weighting,
    monostatic,
    one_transmitter,
    ping_pong,
    scene_critical_baseline,
)
from insar.atmosphere import TEC_UNIT
from optimize import Constraints, DemRequest, Problem, RefutationSettings

from .blocks import ErrorsBlock, RadarBlock
from .coherent import azimuth_resolution_of, beam_swath, build_coherence, segment_snr
from .dem_request import build_dem, looks_of
from .limits import LimitsBlock
from .messages import BuildError
from .observing import View
from .studies import FormationStudy
from .systematic import CalibrationBlock, IonosphereBlock

_PRIOR_HEIGHT_STD = 4.0
"""Standard deviation of an existing DEM, where a study names none [m]."""


def build_problem(
    study: FormationStudy, names: Sequence[str], limits: LimitsBlock, view: View
) -> tuple[Problem, float, DemRequest]:
    """Build what formations are scored by.

    Parameters
    ----------
    study : the study.
    names : name of each satellite.
    limits : its limits.
    view : its reference orbit and scene.

    Returns
    -------
    problem : in SI units and radians.
    critical_baseline : the smallest over the segments, for the radar's multiplicity [m].
    dem : what is asked of the elevation model.

    Raises
    ------
    BuildError
        If posting or swath of the elevation model do not fit radar and scene.
    """
    scene = view.scene
    speed = view.orbit.mean_motion * (EARTH_EQUATORIAL_RADIUS + view.orbit.altitude)
    azimuth = azimuth_resolution_of(study.radar, scene, speed=speed)
    calibration = _calibration(study.errors.calibration, beam_swath(study.radar, scene))
    dem = build_dem(study.dem, study.radar, scene, calibration, azimuth=azimuth)
    snr = segment_snr(study.radar, study.scene.backscatter, scene)
    looks = looks_of(study.radar, dem, scene)
    radar = _radar(
        study.radar, names, looks=looks, snr=float(np.median(snr)), azimuth_resolution=azimuth
    )
    critical = float(scene_critical_baseline(scene, radar, multiplicity=radar.multiplicity).min())
    coherence = build_coherence(
        study.errors.coherence, study.radar, scene, snr=snr, built=radar, speed=speed
    )
    errors = _errors(study.errors, radar, scene)
    problem = Problem(
        mean_motion=view.orbit.mean_motion,
        scene=scene,
        radar=radar,
        errors=replace(errors, calibration=calibration, coherence=coherence),
        constraints=_constraints(limits, critical),
    )
    return problem, critical, dem


def build_refutation(study: FormationStudy, problem: Problem) -> RefutationSettings | None:
    """How the formations of a study are simulated; None if they are not.

    Parameters
    ----------
    study : the study.
    problem : what was built from it.
    """
    block = study.refutation
    if block is None:
        return None
    prior = block.prior_height_std_m
    if prior is None:
        prior = problem.constraints.prior_height_std
    return RefutationSettings(
        samples=block.samples,
        prior_height_std=_PRIOR_HEIGHT_STD if prior is None else prior,
    )


def build_instrument(
    radar: RadarBlock,
    errors: ErrorsBlock,
    names: Sequence[str],
    scene: Scene,
    *,
    speed: float,
) -> tuple[Radar, ErrorBudget]:
    """Build the radar and the error budget of a study without segments of its own.

    Parameters
    ----------
    radar, errors : of the study.
    names : name of each satellite.
    scene : where an azimuth error on the ground becomes an angle.
    speed : along the orbit [m/s].
    """
    snr = segment_snr(radar, None, scene)
    built = _radar(
        radar,
        names,
        looks=radar.looks,
        snr=float(np.median(snr)),
        azimuth_resolution=azimuth_resolution_of(radar, scene, speed=speed),
    )
    coherence = build_coherence(errors.coherence, radar, scene, snr=snr, built=built, speed=None)
    return built, replace(_errors(errors, built, scene), coherence=coherence)


def _radar(
    block: RadarBlock,
    names: Sequence[str],
    *,
    looks: float,
    snr: float,
    azimuth_resolution: float | None,
) -> Radar:
    if isinstance(block.images, tuple):
        images = tuple((names.index(tx), names.index(rx)) for tx, rx in block.images)
    elif block.images == "one_transmitter":
        transmitter = 0 if block.transmitter is None else names.index(block.transmitter)
        images = one_transmitter(len(names), transmitter=transmitter)
    else:
        images = {"monostatic": monostatic, "ping_pong": ping_pong}[block.images](len(names))
    return Radar(
        wavelength=block.wavelength_m,
        slant_range_resolution=block.slant_range_resolution_m,
        snr=snr,
        looks=looks,
        images=images,
        other_coherence=block.other_coherence,
        azimuth_resolution=azimuth_resolution,
    )


def _errors(block: ErrorsBlock, radar: Radar, scene: Scene) -> ErrorBudget:
    base = ErrorBudget.li2009(snr=radar.snr) if block.preset == "li2009" else ErrorBudget()
    held = base.held_constant if block.held_constant is None else HeldConstant(block.held_constant)
    azimuth = None if block.azimuth_deg is None else math.radians(block.azimuth_deg)
    if block.azimuth_on_ground_m is not None:
        azimuth = block.azimuth_on_ground_m / _azimuth_lever(scene, held)
    synchronization = (
        None if block.synchronization_deg is None else math.radians(block.synchronization_deg)
    )
    lost, weighting = block.baseline_decorrelation, block.weighting
    phase_std = block.phase_std_deg
    return replace(
        base,
        position=_source(
            base.position, block.position_m, block.position_shared_by, block.position_scale
        ),
        azimuth=_source(base.azimuth, azimuth, block.azimuth_shared_by, block.azimuth_scale),
        range=_source(base.range, block.range_m, None, block.range_scale),
        synchronization=_source(
            base.synchronization,
            synchronization,
            block.synchronization_shared_by,
            block.synchronization_scale,
        ),
        troposphere=base.troposphere
        if block.troposphere is None
        else ErrorSource(block.troposphere.std, SharedBy.ALL, Scale(block.troposphere.scale)),
        ionosphere=_ionosphere(block.ionosphere),
        weighting=base.weighting if weighting is None else Weighting(weighting),
        baseline_decorrelation=(
            base.baseline_decorrelation if lost is None else BaselineDecorrelation(lost)
        ),
        held_constant=held,
        phase_statistics=(
            base.phase_statistics
            if block.phase_statistics is None
            else PhaseStatistics(block.phase_statistics)
        ),
        phase_std=base.phase_std if phase_std is None else math.radians(phase_std),
    )


def _ionosphere(block: IonosphereBlock | None) -> Ionosphere | None:
    if block is None:
        return None
    return Ionosphere(
        electrons=block.electrons_tecu * TEC_UNIT,
        gradient=block.gradient_tecu_100km * TEC_UNIT / 100e3,
        shell_height=1e3 * block.shell_height_km,
        scale=Scale(block.scale),
    )


def _calibration(block: CalibrationBlock | None, of_beams: float | None) -> Calibration | None:
    if block is None:
        return None
    swath = of_beams if block.swath_km is None else 1e3 * block.swath_km
    if swath is None:
        raise BuildError(
            ("errors", "calibration"),
            "lacks swath_km, the extent across track of what one adjustment covers; add it, or "
            "swath_km of radar.beams",
        )
    if 1e3 * block.spacing_across_km > swath:
        raise BuildError(
            ("errors", "calibration", "spacing_across_km"),
            f"exceeds the swath of the beams, {swath / 1e3:.4g} km, so that no control point need "
            f"fall into it; take at most {swath / 1e3:.4g}",
        )
    return Calibration(
        swath=swath,
        length=1e3 * block.length_km,
        spacing_across=1e3 * block.spacing_across_km,
        spacing_along=1e3 * block.spacing_along_km,
        accuracy=block.accuracy_m,
        bias=block.bias_m,
        over=Scale(block.over),
    )


def _azimuth_lever(scene: Scene, held: HeldConstant) -> float:
    """Meters along track on the ground for each radian of azimuth error, mean over the scene.

    The angle is of the line of sight itself; in Li 2009's form it turns about nadir.
    """
    if held is HeldConstant.AZIMUTH:
        return float(np.mean(scene.slant_range * np.sin(scene.look_angle)))
    return float(np.mean(scene.slant_range))


def _source(
    base: ErrorSource, std: float | None, shared_by: str | None, scale: str | None
) -> ErrorSource:
    return ErrorSource(
        std=base.std if std is None else std,
        shared_by=base.shared_by if shared_by is None else SharedBy(shared_by),
        scale=base.scale if scale is None else Scale(scale),
    )


def _constraints(block: LimitsBlock, critical_baseline: float) -> Constraints:
    radii = [] if block.max_radius_m is None else [block.max_radius_m]
    if block.max_radius_over_critical_baseline is not None:
        radii.append(block.max_radius_over_critical_baseline * critical_baseline)
    unwrapping = block.unwrapping
    return Constraints(
        max_radius=min(radii, default=None),
        min_separation=block.min_separation_m,
        min_unwrapping_probability=None if unwrapping is None else unwrapping.min_probability,
        prior_height_std=None if unwrapping is None else unwrapping.prior_height_std_m,
        max_baseline_fraction=block.max_baseline_over_critical_baseline,
        max_offset=block.max_z0_m,
        max_rate=block.max_zdot0_m_s,
    )
