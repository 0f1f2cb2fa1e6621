"""A simulated figure with its sampling error, against a prediction: one rule for all of them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_HEIGHT_TOLERANCE = 0.05
"""Relative difference of a height error that no user of it would notice."""

_SHARE_TOLERANCE = 0.01
"""Difference of a share of wrong cycles that no user of it would notice."""

_SIGNIFICANT = 3.0
"""Sampling errors from which on a difference is not chance: 1 in 370."""


class Simulated(NamedTuple):
    """A figure with its sampling error.

    Attributes
    ----------
    value : as simulated.
    sampling_error : its standard deviation, one run against another.
    """

    value: float
    sampling_error: float


class Comparison(NamedTuple):
    """A predicted and a simulated figure.

    Attributes
    ----------
    predicted : by the error model of the study; RMS, or mean of a probability.
    simulated : with its sampling error.
    """

    predicted: float
    simulated: Simulated

    @property
    def deviation(self) -> float:
        """Simulated less predicted, in sampling errors; NaN where nothing finite is predicted."""
        if not math.isfinite(self.predicted):
            return math.nan
        return (self.simulated.value - self.predicted) / self.simulated.sampling_error

    @property
    def height_differs(self) -> bool:
        """Whether a height error is missed by more than chance and more than 5 %."""
        return self._differs(_HEIGHT_TOLERANCE * self.predicted)

    @property
    def share_differs(self) -> bool:
        """Whether a share of wrong cycles is missed by more than chance and more than 1 %."""
        return self._differs(_SHARE_TOLERANCE)

    def _differs(self, tolerance: float) -> bool:
        if not math.isfinite(self.predicted):
            return True
        difference = abs(self.simulated.value - self.predicted)
        return difference > max(_SIGNIFICANT * self.simulated.sampling_error, tolerance)


def simulated_rms(squares: Array) -> Simulated:
    """RMS error from the mean squares of independent draws.

    Parameters
    ----------
    squares : (draws,) — mean square error of each [m²].

    Returns
    -------
    Simulated — the RMS [m]; its sampling error from the spread between draws.
    """
    value = math.sqrt(float(squares.mean()))
    spread = float(squares.std(ddof=1)) / math.sqrt(squares.size)
    return Simulated(value, spread / (2.0 * value) if value > 0.0 else 0.0)
