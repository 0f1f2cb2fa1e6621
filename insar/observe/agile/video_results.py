"""What a video study finds."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...claims import Claim
from .plans import PassPlan
from .profiles import Profile
from .video_request import VideoRequest, YawLaw

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


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
