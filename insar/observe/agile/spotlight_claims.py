"""Printed figures of a spotlight imaging against what the stated inputs give."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from ...claims import Claim, PrintedFigure, judged
from .spotlight_results import SpotlightResult

Array = NDArray[np.float64]


class SpotlightQuantity(StrEnum):
    """What a printed figure is about; ranges and largest values are over all samples."""

    YAW_RANGE = "yaw_range"
    """Largest less smallest angle."""
    PITCH_RANGE = "pitch_range"
    ROLL_RANGE = "roll_range"
    LARGEST_RATE = "largest_rate"
    """Magnitude, against inertial space."""
    LARGEST_ACCELERATION = "largest_acceleration"
    """Magnitude, against inertial space."""
    IMAGING_TIME = "imaging_time"
    FIRST_ORDER_TIME = "first_order_time"
    """Aperture time by the rate at zero Doppler."""
    GROUND_SPEED = "ground_speed"
    BANDWIDTH = "bandwidth"
    RESOLUTION = "resolution"
    """That the Doppler bandwidth gives."""
    AIM_ERROR = "aim_error"
    """With off-axis angle and phase center considered."""


@dataclass(frozen=True, kw_only=True)
class SpotlightClaim(PrintedFigure):
    """A printed figure of spotlight, and what to compute for it.

    Parameters
    ----------
    quantity : what to compute.
    """

    quantity: SpotlightQuantity


def judge_spotlight(claim: SpotlightClaim, result: SpotlightResult) -> Claim:
    """Compute what a claim is about, and say whether it holds.

    Parameters
    ----------
    claim : the printed figure.
    result : the imaging.

    Returns
    -------
    Claim — not computable if the beam cannot be pointed at some sample.
    """
    return judged(claim, _MEASURES[claim.quantity](result))


def _range(angles: Array) -> float:
    """Largest less smallest angle, over its jumps [rad]; NaN if there is a NaN."""
    return float(np.ptp(np.unwrap(angles))) if np.all(np.isfinite(angles)) else math.nan


def _largest(vectors: Array) -> float:
    """Largest magnitude; NaN if there is a NaN."""
    return float(np.linalg.norm(vectors, axis=-1).max())


_MEASURES: dict[SpotlightQuantity, Callable[[SpotlightResult], float]] = {
    SpotlightQuantity.YAW_RANGE: lambda result: _range(result.profile.yaw),
    SpotlightQuantity.PITCH_RANGE: lambda result: _range(result.profile.pitch),
    SpotlightQuantity.ROLL_RANGE: lambda result: _range(result.profile.roll),
    SpotlightQuantity.LARGEST_RATE: lambda result: _largest(result.profile.rate_inertial),
    SpotlightQuantity.LARGEST_ACCELERATION: lambda result: _largest(
        result.profile.acceleration_inertial
    ),
    SpotlightQuantity.IMAGING_TIME: lambda result: result.plan.imaging_time,
    SpotlightQuantity.FIRST_ORDER_TIME: lambda result: result.plan.first_order_time,
    SpotlightQuantity.GROUND_SPEED: lambda result: result.plan.ground_speed,
    SpotlightQuantity.BANDWIDTH: lambda result: result.history.bandwidth,
    SpotlightQuantity.RESOLUTION: lambda result: result.history.resolution,
    SpotlightQuantity.AIM_ERROR: lambda result: float(result.aim_error.closed_form.max()),
}
