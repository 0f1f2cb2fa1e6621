"""Printed figures of a film against what the stated inputs give."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from ...claims import Claim, PrintedFigure, judged
from .video_results import VideoResult

Array = NDArray[np.float64]


class VideoQuantity(StrEnum):
    """What a printed figure is about; largest values are over the whole film."""

    ZERO_DOPPLER = "zero_doppler"
    """Its moment, in seconds of the UTC day."""
    DURATION = "duration"
    LARGEST_PITCH = "largest_pitch"
    LARGEST_ROLL = "largest_roll"
    LARGEST_YAW = "largest_yaw"
    PITCH_TO_ROLL = "pitch_to_roll"
    """Range of the pitch by that of the roll."""
    LARGEST_RATE_ORBIT = "largest_rate_orbit"
    LARGEST_RATE = "largest_rate"
    """Magnitude, against inertial space."""
    AZIMUTH_TRACE = "azimuth_trace"
    """Largest rotation of the trace of the antenna's azimuth plane on the ground."""
    RANGE_TRACE = "range_trace"
    MAJOR_AXIS = "major_axis"
    SHEAR = "shear"
    PRINTED_LENGTH = "printed_length"
    """Frame length of Liang 2018 eq. 3 by the exact one, at zero Doppler."""
    HYPERBOLA = "hyperbola"
    """Largest departure of the hyperbola's frames, with the ground speed, from the exact ones."""
    INDEPENDENT_RATE = "independent_rate"
    """Frame rate up to which no frames have data in common."""
    YAW_MOVES = "yaw_moves"
    """Largest displacement of the footprint's center by an error of the yaw [m/rad]."""
    ROLL_PITCH_ROTATE = "roll_pitch_rotate"
    """Largest rotation of the azimuth trace by an error of roll or pitch, by that error."""
    COMMON_AREA = "common_area"
    """Seen all the time, by the area at the reference time."""


@dataclass(frozen=True, kw_only=True)
class VideoClaim(PrintedFigure):
    """A printed figure, and what to compute for it.

    Parameters
    ----------
    quantity : what to compute.
    """

    quantity: VideoQuantity


def judge_video(claim: VideoClaim, result: VideoResult) -> Claim:
    """Compute what a claim is about, and say whether it holds.

    Parameters
    ----------
    claim : the printed figure.
    result : the film.

    Returns
    -------
    Claim — not computable if the beam cannot be held at some sample.
    """
    return judged(claim, _MEASURES[claim.quantity](result))


def _largest(values: Array) -> float:
    """Largest magnitude; NaN if there is a NaN."""
    return float(np.abs(values).max())


def _swing(angles: Array) -> float:
    return float(np.ptp(angles)) if np.all(np.isfinite(angles)) else math.nan


def _zero_doppler(result: VideoResult) -> float:
    epoch = result.plan.epoch
    midnight = epoch.replace(hour=0, minute=0, second=0, microsecond=0)
    return (epoch - midnight).total_seconds()


def _printed_length(result: VideoResult) -> float:
    frames = result.frames
    middle = int(np.argmin(np.abs(frames.times)))
    return float(frames.printed_length[middle] / frames.exact.length[middle])


def _pitch_to_roll(result: VideoResult) -> float:
    roll = _swing(result.profile.roll)
    return _swing(result.profile.pitch) / roll if roll > 0.0 else math.nan


def _common_area(result: VideoResult) -> float:
    law = next(law for law in result.laws if law.law is result.request.yaw_law)
    return law.common_area


def _yaw_moves(result: VideoResult) -> float:
    moved = np.linalg.norm(result.pointing.center_per_turn[..., 2], axis=-1)
    return _largest(moved)


_MEASURES: dict[VideoQuantity, Callable[[VideoResult], float]] = {
    VideoQuantity.ZERO_DOPPLER: _zero_doppler,
    VideoQuantity.DURATION: lambda result: result.request.duration,
    VideoQuantity.LARGEST_PITCH: lambda result: _largest(result.profile.pitch),
    VideoQuantity.LARGEST_ROLL: lambda result: _largest(result.profile.roll),
    VideoQuantity.LARGEST_YAW: lambda result: _largest(result.profile.yaw),
    VideoQuantity.PITCH_TO_ROLL: _pitch_to_roll,
    VideoQuantity.LARGEST_RATE_ORBIT: lambda result: _largest(
        np.linalg.norm(result.profile.rate_orbit, axis=-1)
    ),
    VideoQuantity.LARGEST_RATE: lambda result: _largest(
        np.linalg.norm(result.profile.rate_inertial, axis=-1)
    ),
    VideoQuantity.AZIMUTH_TRACE: lambda result: _largest(result.distortion.azimuth_trace),
    VideoQuantity.RANGE_TRACE: lambda result: _largest(result.distortion.range_trace),
    VideoQuantity.MAJOR_AXIS: lambda result: _largest(result.distortion.major_axis),
    VideoQuantity.SHEAR: lambda result: _largest(result.distortion.shear),
    VideoQuantity.PRINTED_LENGTH: _printed_length,
    VideoQuantity.HYPERBOLA: lambda result: _largest(
        result.frames.hyperbolic.length / result.frames.exact.length - 1.0
    ),
    VideoQuantity.INDEPENDENT_RATE: lambda result: float(
        np.min(result.frames.exact.independent_rate)
    ),
    VideoQuantity.YAW_MOVES: _yaw_moves,
    VideoQuantity.ROLL_PITCH_ROTATE: lambda result: _largest(
        result.pointing.rotation_per_turn[:, :2]
    ),
    VideoQuantity.COMMON_AREA: _common_area,
}
