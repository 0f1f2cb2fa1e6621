"""Video mode of an agile satellite: stare at a point and cut the data into frames.

Liang J. et al., "Attitude maneuver strategy of video mode based on agile SAR satellite", Journal of
University of Chinese Academy of Sciences, 2018. The orbit frame is X forward, Y = −N, Z geocentric
nadir; the beam is along the body's Z. docs/video.md has the derivations.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States

from .plans import PassPlan
from .profiles import Profile
from .smooth_orbit import SmoothOrbit, smooth_orbit
from .spotlight_plan import aim_point, plan_pass
from .staring import StaringScene, staring_scene
from .video_attitude import hold, staring_profile
from .video_footprint import distortion, footprint_map, footprints, pointing_effect
from .video_frames import LONGEST, cut_frames, effective_speed, frame_length
from .video_request import VideoRequest, YawLaw
from .video_results import (
    Distortion,
    Footprints,
    LawSummary,
    Staring,
    VideoResult,
)
from .video_warnings import warnings_of
from .video_yaw import Beam, Held

Array = NDArray[np.float64]


def video(request: VideoRequest, samples: int = 1001, outlines: int = 101) -> VideoResult:
    """Attitude of an agile satellite that films a point, its frames and footprints.

    Parameters
    ----------
    request : aim point, orbit, frames and beam.
    samples : of attitude over the film, both ends included; an odd number has zero Doppler among
        them.
    outlines : of footprints, likewise.

    Returns
    -------
    VideoResult — NaN, with the reason, where the beam can't be pointed.

    Raises
    ------
    ValueError
        If the aim point is not seen in the searched time, or the orbit is not known for all of the
        film: the message says why, and the remedy.
    """
    for name, value in (("samples", samples), ("outlines", outlines)):
        if value < 2:
            raise ValueError(f"{name} = {value!r} must be at least 2")
    plan = plan_pass(request.as_spotlight())
    half = 0.5 * request.duration
    film = _Film(request, _orbit(request, plan), plan, np.linspace(-half, half, samples))
    few = film._replace(times=np.linspace(-half, half, outlines))
    profile = film.profile(request.yaw_law)
    result = VideoResult(
        request=request,
        plan=plan,
        frames=cut_frames(request, film.orbit, plan),
        times=film.times,
        profile=profile,
        distortion=film.distortion(request.yaw_law, profile),
        pointing=pointing_effect(
            film.states, profile.attitude, film.target, request.pointing_error
        ),
        footprints=few.outlines(request.yaw_law),
        laws=tuple(_summary(law, film, few) for law in YawLaw),
        orbit_misfit=film.orbit.misfit,
        warnings=(),
    )
    return warnings_of(result)


def video_scene(result: VideoResult, segments: int = 11) -> StaringScene:
    """Scene of a formation that watches the aim point over the film.

    Parameters
    ----------
    result : of `video`.
    segments : moments, equally spaced over the film, both ends included.

    Returns
    -------
    StaringScene — every segment is the aim point, seen from ahead to behind.

    Raises
    ------
    ValueError
        If the aim point does not see the satellite during all of it.
    """
    request = result.request
    return staring_scene(
        request.as_spotlight(),
        result.plan,
        duration=request.duration,
        segments=segments,
    )


class _Film(NamedTuple):
    """A film at some of its moments, times (S,) since zero Doppler [s]."""

    request: VideoRequest
    orbit: SmoothOrbit
    plan: PassPlan
    times: Array

    @property
    def target(self) -> Array:
        """Aim point, (3,) [m]."""
        return aim_point(self.request.as_spotlight())

    @property
    def beam(self) -> Beam:
        """Half widths."""
        return Beam(0.5 * self.request.azimuth_beamwidth, 0.5 * self.request.elevation_beamwidth)

    @property
    def states(self) -> States:
        """Earth-fixed."""
        return self.orbit.states(self.plan.time + self.times)

    def held(self, law: YawLaw) -> Held:
        """What a law holds."""
        reference = self.plan.time + self.request.reference_time
        return hold(law, self.orbit, reference, self.target, self.beam)

    def profile(self, law: YawLaw) -> Profile:
        """Attitude under a law."""
        moments = self.plan.time + self.times
        return staring_profile(self.orbit, moments, self.held(law), agility=self.request.agility)

    def distortion(self, law: YawLaw, profile: Profile) -> Distortion:
        """Of the footprint, under the law of the profile."""
        reference = self._replace(times=np.array([self.request.reference_time]))
        first = reference.profile(law)
        return distortion(
            footprint_map(self.states, profile.attitude, self.target),
            footprint_map(reference.states, first.attitude, self.target)[0],
            self.beam,
        )

    def outlines(self, law: YawLaw) -> Footprints:
        """Footprints under a law."""
        attitude = self.profile(law).attitude
        return footprints(self.times, self.states, attitude, self.target, beam=self.beam)


def _orbit(request: VideoRequest, plan: PassPlan) -> SmoothOrbit:
    """The orbit over the film and half a frame more at either end."""
    half = 0.5 * request.duration
    speed = effective_speed(
        slant_range=plan.slant_range,
        doppler_rate=plan.doppler_rate,
        wavelength=request.wavelength,
    )
    longest = frame_length(
        half + 1.0 / request.frame_rate,
        closest_range=plan.slant_range,
        effective_speed=speed,
        ground_speed=plan.ground_speed,
        wavelength=request.wavelength,
        resolution=request.resolution,
    )
    margin = 0.5 * min(float(longest) / speed, LONGEST * request.duration)
    first, last = request.trajectory.span
    return smooth_orbit(
        request.trajectory,
        min(max(plan.time - half - margin, first), plan.time - half),
        max(min(plan.time + half + margin, last), plan.time + half),
    )


def _summary(law: YawLaw, film: _Film, few: _Film) -> LawSummary:
    """What a law leaves, the outlines taken at few moments."""
    profile = film.profile(law)
    left = film.distortion(law, profile)
    seen = few.outlines(law)
    at_reference = few._replace(times=np.array([few.request.reference_time])).outlines(law)
    return LawSummary(
        law=law,
        azimuth_trace=_largest(left.azimuth_trace),
        range_trace=_largest(left.range_trace),
        major_axis=_largest(left.major_axis),
        shear=_largest(left.shear),
        yaw=_largest(profile.yaw),
        rate_orbit=_largest(np.linalg.norm(profile.rate_orbit, axis=-1)),
        rate_inertial=_largest(np.linalg.norm(profile.rate_inertial, axis=-1)),
        common_area=float(seen.common_area / at_reference.area[0]),
        solved=float(np.mean(profile.outcome == Staring.SOLVED)),
    )


def _largest(values: Array) -> float:
    """Largest magnitude; NaN if there are none."""
    magnitudes = np.abs(values[np.isfinite(values)])
    return float(np.max(magnitudes)) if len(magnitudes) else np.nan
