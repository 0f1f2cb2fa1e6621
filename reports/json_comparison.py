"""A predicted and a simulated figure, in the machine-readable result."""

from __future__ import annotations

from insar.simulation import Comparison

from .json_numbers import Json, finite


def height_comparison(comparison: Comparison) -> Json:
    """A height error, predicted and simulated."""
    return _block(comparison, unit="_m")


def share_comparison(comparison: Comparison) -> Json:
    """A share of wrong cycles, predicted and simulated."""
    return _block(comparison, unit="")


def _block(comparison: Comparison, *, unit: str) -> Json:
    return {
        f"predicted{unit}": finite(comparison.predicted),
        f"simulated{unit}": finite(comparison.simulated.value),
        f"sampling_error{unit}": finite(comparison.simulated.sampling_error),
        "deviation": finite(comparison.deviation),
    }
