"""Angles and moments as the terminal shows them."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
from numpy.typing import NDArray


def largest(values: NDArray[np.float64]) -> float:
    """Largest magnitude; NaN where there is none."""
    magnitudes = np.abs(values[np.isfinite(values)])
    return float(magnitudes.max()) if magnitudes.size else float("nan")


def largest_degrees(values: NDArray[np.float64]) -> str:
    """Largest magnitude of angles (S,) or of vectors (S, 3) [rad], in degrees."""
    magnitudes = np.linalg.norm(values, axis=-1) if values.ndim > 1 else values
    return f"{np.degrees(largest(magnitudes)):.4g}"


def moment(time: datetime) -> str:
    """A moment in UTC, to the nearest second."""
    return f"{time + timedelta(milliseconds=500):%Y-%m-%d %H:%M:%S} UTC"
