"""Builds what is asked of the elevation model, and the looks that its posting gives."""

from __future__ import annotations

import numpy as np

from insar import Calibration, Cell, Scene
from insar.dem import CLASSES, Resolution, Specification
from insar.swath import across_swath
from optimize import DemRequest, looks_for

from .blocks import RadarBlock
from .coherent import beam_swath
from .dem import DemBlock, SpecificationBlock
from .messages import BuildError, KeyPath

_DEFAULT_SWATH = 30e3


def build_dem(
    block: DemBlock | None,
    radar: RadarBlock,
    scene: Scene,
    calibration: Calibration | None,
    *,
    azimuth: float | None,
) -> DemRequest:
    """Build what is asked of the elevation model, in SI units.

    Parameters
    ----------
    block : of the study; None judges by no class.
    radar : for its range resolution, and its beams.
    scene : for the room between it and nadir.
    calibration : whose swath is that of a scene where the block gives none.
    azimuth : resolution along track [m]; None if it is not known.

    Raises
    ------
    BuildError
        If the swath reaches nadir or the horizon.
    """
    resolution = None
    if azimuth is not None:
        resolution = Resolution(slant_range=radar.slant_range_resolution_m, azimuth=azimuth)
    swath = _swath(block, radar, scene, calibration)
    if block is None:
        return DemRequest(resolution=resolution, cell=Cell(swath=swath))
    return DemRequest(
        posting=block.posting_m,
        independence=block.resolution_over_posting,
        resolution=resolution,
        cell=Cell(size=1e3 * block.cell_km, swath=swath),
        specifications=tuple(
            CLASSES[one] if isinstance(one, str) else _specification(one)
            for one in block.specifications
        ),
    )


def looks_of(radar: RadarBlock, request: DemRequest, scene: Scene) -> float:
    """Looks of an interferogram: as given, or those of the posting.

    Parameters
    ----------
    radar : of the study.
    request : its elevation model.
    scene : the scene; of its segments, the one with the fewest looks counts.

    Raises
    ------
    BuildError
        If the posting is finer than the radar resolves.
    """
    if request.posting is None or "looks" in radar.model_fields_set:
        return radar.looks
    try:
        return looks_for(request, incidence=scene.incidence, slope=scene.slope)
    except ValueError as error:
        raise BuildError(("dem", "posting_m"), f"cannot be used: {error}") from None


def _specification(block: SpecificationBlock) -> Specification:
    return Specification(
        name=block.name,
        posting=block.posting_m,
        relative_90=block.relative_90_m,
        relative_90_steep=block.relative_90_steep_m,
        absolute_90=block.absolute_90_m,
        steep=block.steep_slope_percent / 100.0,
        source="the study",
    )


def _swath(
    block: DemBlock | None, radar: RadarBlock, scene: Scene, calibration: Calibration | None
) -> float:
    at: KeyPath
    of_beams = beam_swath(radar, scene)
    if block is not None and block.swath_km is not None:
        at, swath = ("dem", "swath_km"), 1e3 * block.swath_km
    elif calibration is not None:
        at, swath = ("errors", "calibration", "swath_km"), calibration.swath
    elif of_beams is not None:
        at, swath = ("radar", "beams"), of_beams
    else:
        # Nobody says how wide it is: what the usual one leaves room for beside nadir.
        room = float((scene.slant_range * np.sin(scene.look_angle)).min())
        return min(_DEFAULT_SWATH, room)
    try:
        for side in (-0.5, 0.5):
            across_swath(scene, side * swath)
    except ValueError:
        raise BuildError(
            at,
            "is so wide that an edge of the swath lies at nadir, beyond the horizon or in layover; "
            "take a narrower swath",
        ) from None
    return swath
