"""Builds where a formation is and what it sees: the reference orbit, and the scene."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from formation import Orbit
from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar import LookSide, Scene
from insar.observe import Boresight, FixedIncidence, FixedLook, Law, Observation, Reference
from insar.observe.agile.staring import StaringScene
from insar.observe.scenes.observing import observe, observe_arc
from insar.observe.scenes.passes import Direction
from insar.observe.scenes.targets import Targets

from .messages import BuildError, KeyPath, show_path
from .observation import ObservationBlock, SideName
from .placed import DAY, PlacedTrajectory, placed_trajectory, refusal
from .scenes import StripBlock, TableBlock
from .staring import build_staring_scene
from .studies import FormationStudy

SIDES: dict[SideName, LookSide] = {"left": LookSide.LEFT, "right": LookSide.RIGHT}

_AT: KeyPath = ("scene", "observation")


class View(NamedTuple):
    """Where a formation is and what it sees.

    Attributes
    ----------
    scene : the segments.
    orbit : the circular reference orbit.
    observation : where the scene comes from: a pass over targets, or one place that the beam stays
        on; None if the study gives it.
    """

    scene: Scene
    orbit: Orbit
    observation: Observation | StaringScene | None


def build_view(study: FormationStudy) -> View:
    """Build the reference orbit and the scene of a study.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If the targets are never seen, or their file or the orbit's does not serve.
    """
    given, orbit = study.scene.given, study.reference_orbit
    if isinstance(given, TableBlock):
        return View(_table(given), orbit, None)
    if isinstance(given, StripBlock):
        return View(_strip(given, orbit), orbit, None)
    trajectory, wavelength = placed_trajectory(study.orbit, ("orbit",)), study.radar.wavelength_m
    if isinstance(given, ObservationBlock):
        observation = _observation(given, trajectory, wavelength)
        return View(observation.scene, observation.orbit, observation)
    staring = build_staring_scene(given, trajectory, wavelength)
    return View(staring.scene, staring.orbit, staring)


def _strip(strip: StripBlock, orbit: Orbit) -> Scene:
    middle = (np.arange(strip.segments) + 0.5) / strip.segments
    return Scene.broadside_strip(
        times=strip.start_s + strip.duration_s * middle,
        look_angle=math.radians(strip.look_deg),
        altitude=orbit.altitude,
        earth_radius=EARTH_EQUATORIAL_RADIUS,
        side=SIDES[strip.side],
        slope=math.radians(strip.slope_deg),
    )


def _table(table: TableBlock) -> Scene:
    incidence = table.look_deg if table.incidence_deg is None else table.incidence_deg
    return Scene(
        times=np.array(table.times_s),
        slant_range=1e3 * np.array(table.slant_range_km),
        look_angle=np.radians(table.look_deg),
        azimuth=np.radians(table.azimuth_deg),
        incidence=np.radians(incidence),
        slope=np.radians(table.slope_deg),
    )


def _observation(
    block: ObservationBlock, trajectory: PlacedTrajectory, wavelength: float
) -> Observation:
    start = trajectory.since(block.start)
    targets = _targets(block)
    try:
        if targets is None:
            return _arc(block, trajectory, start, wavelength)
        return _pass(block, trajectory, targets, start, wavelength)
    except BuildError as error:
        remedy = f"search another time, by start and search_days of {show_path(_AT)}"
        raise BuildError(error.at, f"{error.text}, or {remedy}") from None
    except ValueError as error:
        name, _, text = str(error).partition(": ")
        if name.startswith("number = "):
            raise refusal((*_AT, "pass_number"), ValueError(text)) from None
        raise refusal(_AT, error) from None


def _pass(
    block: ObservationBlock,
    trajectory: PlacedTrajectory,
    targets: Targets,
    start: float,
    wavelength: float,
) -> Observation:
    return observe(
        trajectory,
        targets,
        wavelength=wavelength,
        side=SIDES[block.side],
        start=start,
        stop=start + DAY * block.search_days,
        law=Law(block.steering),
        boresight=_boresight(block),
        near_incidence=math.radians(block.near_incidence_deg),
        far_incidence=math.radians(block.far_incidence_deg),
        reference=Reference(block.reference),
        direction=Direction(block.direction),
        number=block.pass_number,
        slope=math.radians(block.slope_deg),
    )


def _arc(
    block: ObservationBlock, trajectory: PlacedTrajectory, start: float, wavelength: float
) -> Observation:
    boresight = _boresight(block)
    if boresight is None:
        raise ValueError("a band needs a boresight; add incidence_deg: 35")
    return observe_arc(
        trajectory,
        wavelength=wavelength,
        side=SIDES[block.side],
        boresight=boresight,
        start=start,
        stop=start + DAY * block.search_days,
        latitude=_radians(block.latitude_deg),
        argument_of_latitude=_radians(block.argument_of_latitude_deg),
        segments=block.count,
        law=Law(block.steering),
        near_incidence=math.radians(block.near_incidence_deg),
        far_incidence=math.radians(block.far_incidence_deg),
        reference=Reference(block.reference),
        direction=Direction(block.direction),
        slope=math.radians(block.slope_deg),
    )


def _targets(block: ObservationBlock) -> Targets | None:
    """Targets one by one or of an area; None for what the boresight sweeps."""
    if block.points is not None:
        return Targets.from_points(
            latitude=np.radians([point.latitude_deg for point in block.points]),
            longitude=np.radians([point.longitude_deg for point in block.points]),
            height=[point.height_m for point in block.points],
        )
    if block.geojson_file is None:
        return None
    try:
        return Targets.from_geojson(
            block.geojson_file.text, count=block.count, height=block.height_m or 0.0
        )
    except ValueError as error:
        raise refusal((*_AT, "geojson_file"), error) from None


def _boresight(block: ObservationBlock) -> Boresight | None:
    if block.look_deg is not None:
        return FixedLook(math.radians(block.look_deg))
    if block.incidence_deg is not None:
        return FixedIncidence(math.radians(block.incidence_deg))
    return None


def _radians(band: tuple[float, float] | None) -> tuple[float, float] | None:
    return None if band is None else (math.radians(band[0]), math.radians(band[1]))
