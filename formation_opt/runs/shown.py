"""Angles, frequencies and moments as the terminal shows them."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
from numpy.typing import NDArray

from insar.observe.agile.agility import Agility
from insar.observe.agile.profiles import Profile

ROUNDING = 1e-6
"""Degrees and hertz below this are the rounding of the arithmetic."""


def largest(values: NDArray[np.float64]) -> float:
    """Largest magnitude; NaN where there is none."""
    magnitudes = np.abs(values[np.isfinite(values)])
    return float(magnitudes.max()) if magnitudes.size else float("nan")


def largest_degrees(values: NDArray[np.float64]) -> str:
    """Largest magnitude of angles (S,) or of vectors (S, 3) [rad], in degrees."""
    magnitudes = np.linalg.norm(values, axis=-1) if values.ndim > 1 else values
    degrees = np.degrees(largest(magnitudes))
    return "0" if degrees < ROUNDING else f"{degrees:.4g}"


def hertz(value: float) -> str:
    """A frequency; zero where it is the rounding of the arithmetic."""
    return "0 Hz" if value < ROUNDING else f"{value:.3g} Hz" if value < 100.0 else f"{value:.0f} Hz"


def agility(profile: Profile, limits: Agility | None, why: str | None) -> str:
    """Whether a satellite can turn as it must; not known where the attitude is not.

    Parameters
    ----------
    profile : how it turns.
    limits : of the satellite; None for none.
    why : it cannot be pointed at some samples; None where it can at all.
    """
    if not np.any(profile.solved):
        return f"not known: {why}"
    part = "" if why is None else f", where the attitude is known; {why}"
    if limits is None or not limits.limited:
        return f"no limits given{part}"
    if np.any(profile.rate_exceeded | profile.acceleration_exceeded):
        return f"exceeded{part}"
    return f"kept{part}"


def moment(time: datetime) -> str:
    """A moment in UTC, to the nearest second."""
    return f"{time + timedelta(milliseconds=500):%Y-%m-%d %H:%M:%S} UTC"
