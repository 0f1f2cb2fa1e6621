"""Builds what studies of agile satellites compute with, and scenes of one place, in SI."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

from formation import Orbit
from insar import LookSide, Relation
from insar.observe.agile.agility import Agility
from insar.observe.agile.plans import PassPlan
from insar.observe.agile.spotlight import spotlight
from insar.observe.agile.spotlight_claims import SpotlightClaim, SpotlightQuantity
from insar.observe.agile.spotlight_plan import plan_pass, plan_spotlight
from insar.observe.agile.spotlight_results import SpotlightRequest
from insar.observe.agile.staring import StaringScene, staring_scene
from insar.observe.agile.video import video
from insar.observe.agile.video_claims import VideoClaim, VideoQuantity
from insar.observe.agile.video_request import VideoRequest, YawLaw
from insar.observe.scenes.passes import Direction

from .agile import (
    AgilityBlock,
    PassBlock,
    SpotlightBlock,
    SpotlightSceneBlock,
    VideoSceneBlock,
)
from .agile_claims import SPOTLIGHT_UNITS, VIDEO_UNITS
from .agile_studies import SpotlightStudy, VideoStudy
from .messages import BuildError, KeyPath
from .orbits import build_reference
from .placed import DAY, PlacedTrajectory, placed_trajectory, refusal

_SIDES = {"either": None, "left": LookSide.LEFT, "right": LookSide.RIGHT}

_ANY_RESOLUTION = 1.0
"""Of what only needs the moment of zero Doppler, which does not depend on it [m]."""

_BLAMED = {"number = ": "pass_number", "resolution = ": "resolution_m", "slope = ": "slope_deg"}
"""Keys to blame, by how the message begins."""

_FEW = 3
"""Samples that show whether a study can be computed at all."""


class SpotlightSetup(NamedTuple):
    """Everything that a study of kind `spotlight` computes with.

    Attributes
    ----------
    request : place, orbit, antenna and limits.
    samples : of the attitude.
    claims : printed figures; may be empty.
    orbit : circular reference of the orbit.
    """

    request: SpotlightRequest
    samples: int
    claims: tuple[SpotlightClaim, ...]
    orbit: Orbit


class VideoSetup(NamedTuple):
    """Everything that a study of kind `video` computes with.

    Attributes
    ----------
    request : place, orbit, frames and beam.
    samples : of the attitude.
    footprints : outlines of the beam on the ground.
    claims : printed figures; may be empty.
    orbit : circular reference of the orbit.
    """

    request: VideoRequest
    samples: int
    footprints: int
    claims: tuple[VideoClaim, ...]
    orbit: Orbit


def build_spotlight(study: SpotlightStudy) -> SpotlightSetup:
    """Build what a study of kind `spotlight` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If the place is never seen, or the orbit is not known when it is.
    """
    block, at = study.spotlight, ("spotlight",)
    trajectory = placed_trajectory(study.orbit, ("orbit",))
    try:
        request = dataclasses.replace(
            _image(block, trajectory, study.radar.wavelength_m),
            off_axis=math.radians(study.antenna.off_axis_deg),
            phase_center=study.antenna.phase_center_m,
            duration=study.duration_s,
            agility=_agility(study.agility),
        )
        spotlight(request, _FEW)  # what is refused is better said now than during the run
    except ValueError as error:
        raise _unseen(at, error) from None
    return SpotlightSetup(
        request=request,
        samples=study.samples,
        claims=tuple(
            SpotlightClaim(
                quantity=SpotlightQuantity(claim.quantity),
                relation=Relation(claim.relation),
                **claim.figure(SPOTLIGHT_UNITS[claim.quantity]),
            )
            for claim in study.claims
        ),
        orbit=build_reference(study.orbit),
    )


def build_video(study: VideoStudy) -> VideoSetup:
    """Build what a study of kind `video` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If the place is never seen, or the orbit is not known when it is.
    """
    block, at = study.video, ("video",)
    trajectory = placed_trajectory(study.orbit, ("orbit",))
    x, y, z = (math.radians(error) for error in study.pointing_error_deg)
    try:
        aim = _aim(block, trajectory, study.radar.wavelength_m, block.resolution_m)
        request = VideoRequest(
            trajectory=trajectory,
            latitude=aim.latitude,
            longitude=aim.longitude,
            height=aim.height,
            wavelength=aim.wavelength,
            resolution=aim.resolution,
            frame_rate=block.frame_rate_hz,
            duration=block.duration_s,
            start=aim.start,
            stop=aim.stop,
            azimuth_beamwidth=math.radians(study.beam.azimuth_beamwidth_deg),
            elevation_beamwidth=math.radians(study.beam.elevation_beamwidth_deg),
            yaw_law=YawLaw(study.yaw.law),
            reference_time=study.yaw.reference_time_s,
            max_overlap=block.max_overlap,
            pointing_error=(x, y, z),
            side=aim.side,
            direction=aim.direction,
            number=aim.number,
            near_incidence=aim.near_incidence,
            far_incidence=aim.far_incidence,
            agility=_agility(study.agility),
        )
        video(request, _FEW, _FEW)  # what is refused is better said now than during the run
    except ValueError as error:
        raise _unseen(at, error) from None
    return VideoSetup(
        request=request,
        samples=study.samples,
        footprints=study.footprints,
        claims=tuple(
            VideoClaim(
                quantity=VideoQuantity(claim.quantity),
                relation=Relation(claim.relation),
                **claim.figure(VIDEO_UNITS[claim.quantity]),
            )
            for claim in study.claims
        ),
        orbit=build_reference(study.orbit),
    )


def build_staring_scene(
    block: SpotlightSceneBlock | VideoSceneBlock, trajectory: PlacedTrajectory, wavelength: float
) -> StaringScene:
    """Build the scene of a formation that watches one place.

    Parameters
    ----------
    block : the place, and how long it is watched.
    trajectory : of the formation.
    wavelength : scalar — of the radar [m].

    Raises
    ------
    BuildError
        If the place is never seen, or not for all of the time, or lies in layover or shadow.
    """
    at: KeyPath = ("scene", "spotlight" if isinstance(block, SpotlightBlock) else "video")
    try:
        return _staring(block, trajectory, wavelength)
    except ValueError as error:
        raise _unseen(at, error) from None


def _staring(
    block: SpotlightSceneBlock | VideoSceneBlock, trajectory: PlacedTrajectory, wavelength: float
) -> StaringScene:
    """The scene, for as long as the image or the film takes."""
    if isinstance(block, SpotlightBlock):
        request = _image(block, trajectory, wavelength)
        image = plan_spotlight(request)
        plan: PassPlan = image
        duration = image.imaging_time
    else:
        request = _aim(block, trajectory, wavelength, _ANY_RESOLUTION)
        plan, duration = plan_pass(request), block.duration_s
    return staring_scene(
        request,
        plan,
        duration=duration,
        segments=block.segments,
        slope=math.radians(block.slope_deg),
    )


def _aim(
    block: PassBlock, trajectory: PlacedTrajectory, wavelength: float, resolution: float
) -> SpotlightRequest:
    """The place and the pass."""
    start = trajectory.since(block.start)
    return SpotlightRequest(
        trajectory=trajectory,
        latitude=math.radians(block.target.latitude_deg),
        longitude=math.radians(block.target.longitude_deg),
        height=block.target.height_m,
        wavelength=wavelength,
        resolution=resolution,
        start=start,
        stop=start + DAY * block.search_days,
        side=_SIDES[block.side],
        direction=Direction(block.direction),
        number=block.pass_number,
        near_incidence=math.radians(block.near_incidence_deg),
        far_incidence=math.radians(block.far_incidence_deg),
    )


def _image(
    block: SpotlightBlock, trajectory: PlacedTrajectory, wavelength: float
) -> SpotlightRequest:
    """The place, the pass and the image."""
    return dataclasses.replace(
        _aim(block, trajectory, wavelength, block.resolution_m),
        weighting=block.weighting_factor,
        sliding_factor=block.sliding_factor,
        scene_length=block.scene_length_m,
    )


def _agility(block: AgilityBlock) -> Agility:
    return Agility(
        max_rate=_limit(block.max_rate_deg_s),
        max_acceleration=_limit(block.max_acceleration_deg_s2),
    )


def _limit(
    degrees: float | tuple[float, float, float] | None,
) -> float | tuple[float, float, float]:
    if degrees is None:
        return math.inf
    if isinstance(degrees, tuple):
        x, y, z = (math.radians(limit) for limit in degrees)
        return x, y, z
    return math.radians(degrees)


def _unseen(at: KeyPath, error: ValueError) -> BuildError:
    """Error of a pass that is not there, at the key to blame."""
    name, _, text = str(error).partition(": ")
    for start, key in _BLAMED.items():
        if name.startswith(start):
            return refusal((*at, key), ValueError(text))
    return refusal(at, error)
