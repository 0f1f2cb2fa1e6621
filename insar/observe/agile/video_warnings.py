"""What a user of a film should know, in words."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from .spotlight_warnings import LARGEST_MISFIT
from .video_results import Staring, VideoResult

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_ROUNDING = 1e-9
"""By which an overlap at its limit may exceed it unmentioned."""


def warnings_of(result: VideoResult) -> VideoResult:
    """The same result with its warnings.

    Parameters
    ----------
    result : of `video`, complete but for them.
    """
    profile = result.profile
    found = [
        _part(
            result.times,
            profile.staring == Staring.BELOW_HORIZON,
            "the aim point does not see the satellite above its horizon",
            "take a shorter duration",
        ),
        _part(
            result.times,
            profile.staring == Staring.AXIS_LOST,
            "no turn of the antenna keeps the footprint's major axis where it was",
            "hold the azimuth or the range trace, take beamwidths that differ more, or a shorter "
            "duration",
        ),
        _part(
            result.times,
            profile.staring == Staring.UNDEFINED,
            "the yaw law leaves the turn about the line of sight open",
            "take another yaw law",
        ),
        _part(
            result.times,
            profile.singular,
            "the pitch is ±90°, where roll and yaw are not told apart",
            "use the quaternions there",
        ),
        _part(
            result.times,
            profile.rate_exceeded,
            f"the body would have to turn faster (up to {_peak(profile.rate_inertial)}°/s) than "
            "its agility allows",
            "take a larger incidence",
        ),
        _part(
            result.times,
            profile.acceleration_exceeded,
            "the body would have to accelerate more (up to "
            f"{_peak(profile.acceleration_inertial)}°/s²) than its agility allows",
            "take a larger incidence, or another yaw law",
        ),
        *_of_frames(result),
    ]
    if result.orbit_misfit > LARGEST_MISFIT:
        found.append(
            f"the orbit is smooth to {result.orbit_misfit:.1e} m only over the film: attitude and "
            "rates are those of a smooth curve through it"
        )
    return dataclasses.replace(result, warnings=tuple(text for text in found if text))


def _of_frames(result: VideoResult) -> list[str]:
    """Warnings on how the data are cut."""
    frames, limit = result.frames, result.request.max_overlap
    unreached = ~np.isfinite(frames.exact.duration)
    found = [
        _part(
            frames.times,
            unreached,
            f"the Doppler does not run through the {frames.bandwidth:.0f} Hz of a frame",
            "take a coarser resolution or a shorter duration",
            "frames",
        ),
        _part(
            frames.times,
            ~frames.complete & ~unreached,
            "the data of a frame reach beyond the film",
            "film longer, or leave these frames out",
            "frames",
        ),
    ]
    if limit > 0.0:
        lowest = np.nanmin(frames.exact.rate_limit, initial=np.inf)
        found.append(
            _part(
                frames.times,
                frames.exact.overlap > limit * (1.0 + _ROUNDING),
                f"frames have more than {100.0 * limit:.3g} % of their data in common",
                f"take a frame rate of at most {lowest:.3g}/s, or a coarser resolution",
                "frames",
            )
        )
    return found


def _part(times: Array, where: Mask, what: str, remedy: str, unit: str = "samples") -> str:
    """One warning for the samples where something holds; empty if there are none."""
    if not np.any(where):
        return ""
    there = times[where]
    return (
        f"{what}: {np.count_nonzero(where)} of {len(where)} {unit}, the first {there[0]:.2f} s and "
        f"the last {there[-1]:.2f} s from zero Doppler; {remedy}"
    )


def _peak(vector: Array) -> str:
    """Largest magnitude, in degrees."""
    magnitudes = np.linalg.norm(vector, axis=-1)
    if not np.any(np.isfinite(magnitudes)):
        return "?"
    return f"{math.degrees(float(np.nanmax(magnitudes))):.4g}"
