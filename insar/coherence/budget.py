"""The coherence budget: what lowers the coherence of images beside noise and baselines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .noise import ambiguity_coherence, quantization_coherence
from .spectra import coregistration_coherence
from .temporal import TemporalDecorrelation
from .volume import (
    AttenuatedVolume,
    PenetratedVolume,
    ProfileVolume,
    UniformVolume,
)

Array = NDArray[np.float64]

PerSegment = float | tuple[float, ...]
"""One number for all segments, or one for each."""

AnyVolume = UniformVolume | AttenuatedVolume | PenetratedVolume | ProfileVolume


@dataclass(frozen=True, kw_only=True)
class CoherenceBudget:
    """Factors of the coherence of a pair, each of them neglected unless it is given.

    Thermal noise (`Radar.snr`), the baselines (`ErrorBudget.baseline_decorrelation`) and
    `Radar.other_coherence` are beside it.

    Parameters
    ----------
    relative_snr : SNR of each segment over `Radar.snr`: what a beam and the backscatter at its
        incidence make of it.
    image_snr : SNR of each image over that of the segment; empty where all are alike.
    quantization_bits : of the raw data; None neglects the quantization.
    rasr, aasr : range and azimuth ambiguity-to-signal ratios, as power ratios.
    range_shift, azimuth_shift : what is left of the co-registration error [resolution cells].
    processing : coherence that the processing leaves (interpolation, focusing).
    volume : how the backscatter is spread in height.
    temporal : how the scene changes between images.

    Raises
    ------
    ValueError
        If a number is outside its range.
    """

    relative_snr: PerSegment = 1.0
    image_snr: tuple[float, ...] = ()
    quantization_bits: int | None = None
    rasr: PerSegment = 0.0
    aasr: PerSegment = 0.0
    range_shift: float = 0.0
    azimuth_shift: float = 0.0
    processing: float = 1.0
    volume: AnyVolume | None = None
    temporal: TemporalDecorrelation | None = None

    def __post_init__(self) -> None:
        for name in ("relative_snr", "image_snr"):
            if not all(math.isfinite(value) and value > 0.0 for value in _each(self, name)):
                raise ValueError(f"{name} = {getattr(self, name)!r} must be finite and positive")
        for name in ("rasr", "aasr"):
            if not all(math.isfinite(value) and value >= 0.0 for value in _each(self, name)):
                raise ValueError(
                    f"{name} = {getattr(self, name)!r} must be finite and not negative"
                )
        for name in ("range_shift", "azimuth_shift"):
            if not 0.0 <= getattr(self, name) < 1.0:
                raise ValueError(
                    f"{name} = {getattr(self, name)!r} must lie between 0 and below 1 cell"
                )
        if not 0.0 < self.processing <= 1.0:
            raise ValueError(f"processing = {self.processing!r} must lie above 0 and at most 1")
        if self.quantization_bits is not None:
            quantization_coherence(self.quantization_bits)  # raises

    @property
    def spectral(self) -> bool:
        """Whether every factor is that of single images, so that the closed form holds."""
        return self.volume is None and self.temporal is None

    def single_image_factors(self) -> dict[str, Array]:
        """Factors of a pair of like images that each image contributes the root of.

        Returns
        -------
        name → (S,) or () — quantization, ambiguities, co-registration and processing.
        """
        bits = self.quantization_bits
        return {
            "quantization": np.asarray(1.0 if bits is None else quantization_coherence(bits)),
            "ambiguities": ambiguity_coherence(rasr=self.rasr, aasr=self.aasr),
            "coregistration": coregistration_coherence(self.range_shift)
            * coregistration_coherence(self.azimuth_shift),
            "processing": np.asarray(self.processing),
        }


def _each(budget: CoherenceBudget, name: str) -> tuple[float, ...]:
    value = getattr(budget, name)
    return value if isinstance(value, tuple) else (value,)
