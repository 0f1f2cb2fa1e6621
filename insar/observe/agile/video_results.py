"""What a video study asks for, and what it finds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ...claims import Claim
from ...scene import LookSide
from ..scenes.passes import Direction
from .agility import Agility
from .plans import PassPlan
from .profiles import Profile
from .spotlight_results import FAR_INCIDENCE, NEAR_INCIDENCE, SpotlightRequest

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class YawLaw(StrEnum):
    """What the turn about the line of sight holds, once roll and pitch point the beam.

    NONE keeps the yaw at zero: roll and pitch only. SHORTEST_ROTATION takes the shortest turn from
    the orbit frame. The others keep one direction of the footprint fixed on the ground: the trace
    of the antenna's azimuth plane (X and Z), that of its range plane (Y and Z), or the major axis
    of the footprint's ellipse.
    """

    NONE = "none"
    SHORTEST_ROTATION = "shortest_rotation"
    AZIMUTH_TRACE = "azimuth_trace"
    RANGE_TRACE = "range_trace"
    MAJOR_AXIS = "major_axis"


class Staring(IntEnum):
    """Whether the beam can be pointed at a sample, and why not."""

    SOLVED = 0
    BELOW_HORIZON = 1
    """The aim point does not see the satellite."""
    UNDEFINED = 2
    """The law leaves the turn about the line of sight open: the direction that it holds lies along
    the line of sight, or the shortest turn would be by 180°."""
    AXIS_LOST = 3
    """No turn of the antenna lays the footprint's major axis there: the slant of the beam
    stretches the footprint more than the two beamwidths differ."""


@dataclass(frozen=True, kw_only=True, eq=False)
class VideoRequest:
    """A point on the Earth that an agile satellite shall film.

    Parameters
    ----------
    trajectory : of the satellite.
    latitude, longitude : scalars — of the scene's center, geodetic, WGS84 [rad].
    height : scalar — of the center above the ellipsoid [m].
    wavelength : scalar — of the carrier [m].
    resolution : scalar — in azimuth on the ground, of each frame, ρ_a [m].
    frame_rate : scalar — frames per second, 1/T_f [1/s].
    duration : scalar — of the film, centered on zero Doppler [s].
    start, stop : scalars — the time that is searched for a pass, since the trajectory's epoch [s].
    azimuth_beamwidth, elevation_beamwidth : scalars — full width of the beam, about the antenna's
        Y and X axes [rad].
    yaw_law : what the turn about the line of sight holds.
    reference_time : scalar — at which the yaw is zero and the footprint as it shall stay, since
        zero Doppler [s].
    max_overlap : scalar — share of its data that a frame may have in common with the one before;
        sets the limit of the frame rate. With 0 it is that of frames without common data.
    pointing_error : (3,) — standard deviations of small turns about the body's X, Y and Z [rad].
    side : where the radar looks; None for a satellite that can turn to either.
    direction : which passes count.
    number : of the pass to take, from 1 in order of time.
    near_incidence, far_incidence : scalars — of the center at zero Doppler [rad].
    agility : limits; None for none.

    Raises
    ------
    ValueError
        If a value is out of bounds.
    """

    trajectory: Trajectory
    latitude: float
    longitude: float
    height: float = 0.0
    wavelength: float
    resolution: float
    frame_rate: float
    duration: float
    start: float = 0.0
    stop: float
    azimuth_beamwidth: float
    elevation_beamwidth: float
    yaw_law: YawLaw = YawLaw.AZIMUTH_TRACE
    reference_time: float = 0.0
    max_overlap: float = 0.0
    pointing_error: tuple[float, float, float] = (0.0, 0.0, 0.0)
    side: LookSide | None = None
    direction: Direction = Direction.EITHER
    number: int = 1
    near_incidence: float = NEAR_INCIDENCE
    far_incidence: float = FAR_INCIDENCE
    agility: Agility | None = None

    def __post_init__(self) -> None:
        self.as_spotlight()  # checks what both have in common
        for name, unit in (("frame_rate", "1/s"), ("duration", "s")):
            self._check(name, 0.0 < getattr(self, name) < math.inf, f"{unit}: positive")
        for name in ("azimuth_beamwidth", "elevation_beamwidth"):
            value = getattr(self, name)
            self._check(name, 0.0 < value < math.pi / 2, "rad, 0 to π/2; give radians")
        self._check("max_overlap", 0.0 <= self.max_overlap < 1.0, "0 to below 1")
        self._check(
            "reference_time",
            abs(self.reference_time) <= 0.5 * self.duration,
            "s from zero Doppler, within the film: at most half its duration",
        )
        self._check(
            "pointing_error",
            len(self.pointing_error) == 3
            and all(0.0 <= error < 0.1 for error in self.pointing_error),
            "rad: standard deviations about X, Y and Z, 0 to 0.1; give radians",
        )

    def as_spotlight(self) -> SpotlightRequest:
        """The same point, orbit and resolution as one spotlight image."""
        return SpotlightRequest(
            trajectory=self.trajectory,
            latitude=self.latitude,
            longitude=self.longitude,
            height=self.height,
            wavelength=self.wavelength,
            resolution=self.resolution,
            start=self.start,
            stop=self.stop,
            side=self.side,
            direction=self.direction,
            number=self.number,
            near_incidence=self.near_incidence,
            far_incidence=self.far_incidence,
        )

    def _check(self, name: str, valid: bool, requirement: str) -> None:
        if not valid:  # NaN is not valid either
            raise ValueError(f"{name} = {getattr(self, name)!r} must be {requirement}")


class FrameModel(NamedTuple):
    """How much data a frame needs, in one model of the range history; F frames.

    Attributes
    ----------
    duration : (F,) — of the data of a frame [s].
    length : (F,) — of the synthetic aperture, duration times effective velocity [m].
    overlap : (F,) — share of its data that a frame has in common with the one before, 0 to 1.
    independent_rate : (F,) — frame rate above which frames have data in common [1/s].
    rate_limit : (F,) — frame rate above which they have more in common than the largest overlap
        allowed [1/s].
    """

    duration: Array
    length: Array
    overlap: Array
    independent_rate: Array
    rate_limit: Array


class Frames(NamedTuple):
    """The frames of a film, F of them; each centered on its time.

    Attributes
    ----------
    times : (F,) — since zero Doppler [s].
    squint : (F,) — of the line of sight ahead of zero Doppler [rad].
    hyperbolic : by the paper's range history, R² = R_c² + V_r² t², and its small apertures.
    exact : by the Doppler history of the real orbit; NaN where the resolution is out of reach.
    printed_length : (F,) — hyperbolic, with ρ = V_r/B as the paper has it [m].
    effective_speed : scalar — V_r of the range history [m/s].
    bandwidth : scalar — of the Doppler, of every frame, V_g/ρ [Hz].
    ground_resolution : (F,) — across the lines of equal Doppler: ρ at zero Doppler, finer at a
        squint, where these lines turn [m].
    complete : (F,) — the data of the frame lie within the film.
    """

    times: Array
    squint: Array
    hyperbolic: FrameModel
    exact: FrameModel
    printed_length: Array
    effective_speed: float
    bandwidth: float
    ground_resolution: Array
    complete: Mask


class Distortion(NamedTuple):
    """How the footprint differs from that at the reference time, to first order of the beamwidths.

    Rotations are about the vertical at the aim point, counterclockwise seen from above.

    Attributes
    ----------
    azimuth_trace, range_trace, major_axis : (S,) — rotation of these directions [rad].
    shear : (S,) — change of the angle between the traces [rad].
    azimuth_stretch, range_stretch : (S,) — length of the footprint along the traces, by that at
        the reference time.
    area : (S,) — of the footprint, by that at the reference time.
    """

    azimuth_trace: Array
    range_trace: Array
    major_axis: Array
    shear: Array
    azimuth_stretch: Array
    range_stretch: Array
    area: Array


class Footprints(NamedTuple):
    """Outlines of the beam on the ground at K moments.

    Attributes
    ----------
    times : (K,) — since zero Doppler; equally spaced, start and end of the film included [s].
    latitude, longitude : (K, V) — corners of the outlines, open, counterclockwise in the antenna
        from its X axis [rad]; NaN beyond the horizon.
    area : (K,) — about the aim point's vertical, seen from above [m²].
    common_latitude, common_longitude : (W,) — outline of what all of them see; empty for nothing,
        and where it is not known.
    common_area : scalar — of it; NaN where it is not known: an outline reaches past the horizon, or
        there is none at all [m²].
    """

    times: Array
    latitude: Array
    longitude: Array
    area: Array
    common_latitude: Array
    common_longitude: Array
    common_area: float


class PointingEffect(NamedTuple):
    """What small turns of the body about its axes do to the footprint, to first order.

    Attributes
    ----------
    center_per_turn : (S, 2, 3) — displacement of the center to the east and to the north, by a
        turn about X, Y, Z [m/rad].
    rotation_per_turn : (S, 3) — rotation of the azimuth trace, by the same.
    center : (S,) — root mean square displacement, for the standard deviations asked for [m].
    rotation : (S,) — standard deviation of the rotation [rad].
    """

    center_per_turn: Array
    rotation_per_turn: Array
    center: Array
    rotation: Array


class LawSummary(NamedTuple):
    """What a yaw law leaves over the whole film.

    Attributes
    ----------
    law : which.
    azimuth_trace, range_trace, major_axis, shear : scalars — largest magnitudes [rad].
    yaw : scalar — largest magnitude [rad].
    rate_orbit, rate_inertial : scalars — largest magnitudes [rad/s].
    common_area : scalar — that all footprints see, by the area of the one at the reference time;
        NaN where it is not known.
    solved : scalar — share of the samples with a solution.
    """

    law: YawLaw
    azimuth_trace: float
    range_trace: float
    major_axis: float
    shear: float
    yaw: float
    rate_orbit: float
    rate_inertial: float
    common_area: float
    solved: float


@dataclass(frozen=True, kw_only=True, eq=False)
class VideoResult:
    """One film: S samples of its attitude, F frames, K footprints.

    Attributes
    ----------
    request : what was asked for.
    plan : moment and geometry of zero Doppler.
    frames : how the data are cut.
    times : (S,) — since zero Doppler [s].
    profile, distortion, pointing : over these times.
    footprints : under the law asked for.
    laws : what every yaw law leaves, in the order of `YawLaw`.
    orbit_misfit : scalar — of the smooth orbit from which all is computed [m].
    warnings : what a user should know.
    claims : printed figures and their verdicts; empty unless a study adds them.
    """

    request: VideoRequest
    plan: PassPlan
    frames: Frames
    times: Array
    profile: Profile
    distortion: Distortion
    pointing: PointingEffect
    footprints: Footprints
    laws: tuple[LawSummary, ...]
    orbit_misfit: float
    warnings: tuple[str, ...]
    claims: tuple[Claim, ...] = ()
