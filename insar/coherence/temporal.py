"""Coherence that a scene keeps between the times of two images."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class TemporalDecorrelation:
    """Exponential loss of coherence with the time between two images.

    Parameters
    ----------
    time_constant : scalar — τ, after which a share 1/e of what can be lost is left [s].
    lasting : scalar — share γ_∞ that is never lost, 0 to 1.
    image_times : when each of the M images is taken [s]; empty where all are taken in one pass.
    speed : scalar — along the orbit, which turns the along-track position of a transmitter into the
        time at which it passes the target; only of images that are all monostatic. None: such a
        lag is not counted [m/s].

    Raises
    ------
    ValueError
        If a number is outside its range.

    Notes
    -----
    γ = γ_∞ + (1 − γ_∞)e^{−|t_i − t_j|/τ}: the coherence of scatterers that a random walk moves,
    and of a share that rests. It is positive definite over any set of times.

    References
    ----------
    Rocca 2007, "Modeling interferogram stacks", IEEE Trans. Geosci. Remote Sens. 45(10), has the
    exponential law.
    """

    time_constant: float
    lasting: float = 0.0
    image_times: tuple[float, ...] = ()
    speed: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.time_constant) and self.time_constant > 0.0):
            raise ValueError(f"time_constant = {self.time_constant!r} must be finite and positive")
        if not 0.0 <= self.lasting <= 1.0:
            raise ValueError(f"lasting = {self.lasting!r} must lie between 0 and 1")
        if not all(math.isfinite(time) for time in self.image_times):
            raise ValueError(f"image_times = {self.image_times!r} must be finite")
        if self.speed is not None and not (math.isfinite(self.speed) and self.speed > 0.0):
            raise ValueError(f"speed = {self.speed!r} must be finite and positive")

    def coherence(self, lag: ArrayLike) -> Array:
        """Coherence after a lag (...) of either sign [s]."""
        decay = np.exp(-np.abs(np.asarray(lag, dtype=np.float64)) / self.time_constant)
        return np.asarray(self.lasting + (1.0 - self.lasting) * decay)
