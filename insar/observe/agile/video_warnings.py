"""What a user of a film should know, in words."""

from __future__ import annotations

import dataclasses

import numpy as np

from .video_results import Staring, VideoResult
from .warning_texts import orbit_warnings, part, steep_warning, turning_warnings

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
        steep_warning(result.plan.incidence),
        part(
            result.times,
            profile.outcome == Staring.BELOW_HORIZON,
            "the aim point does not see the satellite above its horizon",
            "take a shorter duration",
        ),
        part(
            result.times,
            profile.outcome == Staring.AXIS_LOST,
            "no turn of the antenna keeps the footprint's major axis where it was",
            "hold the azimuth or the range trace, take beamwidths that differ more, or a shorter "
            "duration",
        ),
        part(
            result.times,
            profile.outcome == Staring.UNDEFINED,
            "the yaw law leaves the turn about the line of sight open",
            "take another yaw law",
        ),
        *turning_warnings(
            result.times,
            profile,
            angles="the pitch is ±90°, where roll and yaw are not told apart",
            easier="take a larger incidence, or another yaw law",
        ),
        *_of_frames(result),
        *orbit_warnings(
            result.request.trajectory,
            result.plan.epoch,
            0.5 * result.request.duration,
            misfit=result.orbit_misfit,
        ),
    ]
    return dataclasses.replace(result, warnings=tuple(text for text in found if text))


def _of_frames(result: VideoResult) -> list[str]:
    """Warnings on how the data are cut."""
    frames, limit = result.frames, result.request.max_overlap
    unreached = ~np.isfinite(frames.exact.duration)
    found = [
        part(
            frames.times,
            unreached,
            f"the Doppler does not run through the {frames.bandwidth:.0f} Hz of a frame",
            "take a coarser resolution or a shorter duration",
            "frames",
        ),
        part(
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
            part(
                frames.times,
                frames.exact.overlap > limit * (1.0 + _ROUNDING),
                f"frames have more than {100.0 * limit:.3g} % of their data in common",
                f"take a frame rate of at most {lowest:.3g}/s, or a coarser resolution",
                "frames",
            )
        )
    return found
