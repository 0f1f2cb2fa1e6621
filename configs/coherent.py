"""Builds the coherence budget of a study: decibels and degrees end here."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from insar import CoherenceBudget, Radar, Scene
from insar.coherence import (
    AnyVolume,
    AttenuatedVolume,
    PenetratedVolume,
    ProfileVolume,
    TemporalDecorrelation,
    UniformVolume,
    at_incidence,
    azimuth_resolution,
)

from .blocks import RadarBlock
from .coherence import BackscatterBlock, CoherenceBlock, TemporalBlock, VolumeBlock
from .messages import BuildError, KeyPath

Array = NDArray[np.float64]


def segment_snr(radar: RadarBlock, backscatter: BackscatterBlock | None, scene: Scene) -> Array:
    """Signal-to-noise ratio in each segment.

    Parameters
    ----------
    radar : with snr_db, or nesz_db or beams.
    backscatter : of the scene, where the radar gives none.
    scene : the S segments.

    Returns
    -------
    (S,) — power ratios. The beam counts at the incidence on flat ground, the backscatter at the
    local one.

    Raises
    ------
    BuildError
        If the ratio is given twice or not at all, or a segment lies outside a table.
    """
    flat, local = scene.incidence, scene.incidence - scene.slope
    if radar.snr_db is not None:
        if backscatter is not None:
            raise BuildError(
                ("radar", "snr_db"),
                "excludes scene.backscatter, which gives the signal; give radar.nesz_db or "
                "radar.beams instead, or remove scene.backscatter",
            )
        return np.full(len(scene), _ratio(radar.snr_db))
    noise = np.full(len(scene), _ratio(radar.nesz_db or 0.0))
    if radar.beams is not None:
        noise = _beam(radar, flat, [beam.nesz_db for beam in radar.beams])
    if (radar.backscatter_db is None) == (backscatter is None):
        raise BuildError(
            ("radar",),
            "needs the backscatter of the ground, once: add backscatter_db here or a table in "
            "scene.backscatter"
            if backscatter is None
            else "gives backscatter_db, and scene.backscatter gives it too; keep one",
        )
    if backscatter is None:
        return _ratio(radar.backscatter_db or 0.0) / noise
    signal = _looked_up(
        local, backscatter.incidence_deg, backscatter.chosen_db, ("scene", "backscatter")
    )
    return np.asarray(signal / noise)


def azimuth_resolution_of(radar: RadarBlock, scene: Scene, *, speed: float) -> float | None:
    """Resolution along track: as given, or that of the Doppler bandwidth.

    Parameters
    ----------
    radar : of the study.
    scene : whose segments are seen under different angles; their mean counts.
    speed : along the orbit [m/s].
    """
    bandwidth = radar.doppler_bandwidth_hz
    if bandwidth is None:
        return radar.azimuth_resolution_m
    found = azimuth_resolution(
        bandwidth, speed=speed, look_angle=scene.look_angle, incidence=scene.incidence
    )
    return float(found.mean())


def beam_swath(radar: RadarBlock, scene: Scene) -> float | None:
    """Swath of the beams, the narrowest of the segments [m]; None where they give none.

    Parameters
    ----------
    radar : of the study.
    scene : the segments.

    Raises
    ------
    BuildError
        If some beams give a swath and others don't.
    """
    beams = radar.beams or ()
    known = [beam.swath_km for beam in beams if beam.swath_km is not None]
    if not known:
        return None
    if len(known) < len(beams):
        raise BuildError(
            ("radar", "beams"), "gives swath_km at some incidences only; give it at all, or at none"
        )
    table = np.radians([beam.incidence_deg for beam in beams])
    return 1e3 * float(np.interp(scene.incidence, table, known).min())


def build_coherence(
    block: CoherenceBlock | None,
    radar: RadarBlock,
    scene: Scene,
    *,
    snr: Array,
    built: Radar,
    speed: float | None,
) -> CoherenceBudget:
    """Build the coherence budget.

    Parameters
    ----------
    block : of the study; None neglects all that the radar's beams do not give.
    radar : the radar of the study.
    scene : the S segments.
    snr : (S,) — from `segment_snr`.
    built : the radar as built, whose `snr` that of each segment is given over.
    speed : along the orbit [m/s]; None without one.

    Raises
    ------
    BuildError
        If numbers of images or ambiguities do not fit the radar.
    """
    given = CoherenceBlock() if block is None else block
    at: KeyPath = ("errors", "coherence")
    lists = {
        "image_snr_db": given.image_snr_db,
        "temporal": None if given.temporal is None else given.temporal.image_times_s,
    }
    for key, values in lists.items():
        if values is not None and len(values) != len(built.images):
            raise BuildError(
                (*at, key),
                f"holds {len(values)} numbers for {len(built.images)} images; give each image one",
            )
    return CoherenceBudget(
        relative_snr=_per_segment(snr / built.snr),
        image_snr=tuple(_ratio(value) for value in given.image_snr_db or ()),
        quantization_bits=given.quantization_bits,
        rasr=_ambiguities("rasr_db", given, radar, scene),
        aasr=_ambiguities("aasr_db", given, radar, scene),
        range_shift=given.coregistration_range_cells,
        azimuth_shift=given.coregistration_azimuth_cells,
        processing=given.processing,
        volume=_volume(given.volume),
        temporal=_temporal(given.temporal, speed),
    )


def _ambiguities(
    key: str, block: CoherenceBlock, radar: RadarBlock, scene: Scene
) -> float | tuple[float, ...]:
    level: float | None = getattr(block, key)
    beams: list[float | None] = [getattr(beam, key) for beam in radar.beams or ()]
    known = [value for value in beams if value is not None]
    if not known:
        return 0.0 if level is None else _ratio(level)
    if level is not None:
        raise BuildError(
            ("errors", "coherence", key), "is given by radar.beams too; keep one of them"
        )
    if len(known) < len(beams):
        raise BuildError(
            ("radar", "beams"), f"gives {key} at some incidences only; give it at all, or at none"
        )
    return _per_segment(_beam(radar, scene.incidence, known))


def _beam(radar: RadarBlock, incidence: Array, values_db: list[float]) -> Array:
    table = tuple(beam.incidence_deg for beam in radar.beams or ())
    return _looked_up(incidence, table, tuple(values_db), ("radar", "beams"))


def _looked_up(
    incidence: Array, table_deg: tuple[float, ...], values_db: tuple[float, ...], at: KeyPath
) -> Array:
    values = [_ratio(value) for value in values_db]
    try:
        return at_incidence(incidence, table=np.radians(table_deg), values=values)
    except ValueError as error:
        raise BuildError(at, f"cannot be used: {error}") from None


def _volume(block: VolumeBlock | None) -> AnyVolume | None:
    if block is None:
        return None
    if block.profile is not None:
        return ProfileVolume(heights=block.profile.heights_m, powers=block.profile.powers)
    if block.height_m is None:
        return PenetratedVolume(depth=block.penetration_m or 0.0)
    if block.extinction_db_m == 0.0:
        return UniformVolume(height=block.height_m)
    return AttenuatedVolume(
        height=block.height_m, extinction=block.extinction_db_m * math.log(10.0) / 10.0
    )


def _temporal(block: TemporalBlock | None, speed: float | None) -> TemporalDecorrelation | None:
    if block is None:
        return None
    return TemporalDecorrelation(
        time_constant=block.time_constant_s,
        lasting=block.lasting,
        image_times=block.image_times_s or (),
        speed=speed,
    )


def _per_segment(values: Array) -> float | tuple[float, ...]:
    """One number where all segments are alike."""
    if np.all(values == values[0]):
        return float(values[0])
    return tuple(values.tolist())


def _ratio(decibels: float) -> float:
    return float(10.0 ** (decibels / 10.0))
