"""Coherence of images, factor by factor: γ = γ_SNR γ_quant γ_amb γ_coreg γ_geo γ_az γ_vol γ_temp.

Each factor is a function, complex where it is complex. What noise does to single images makes their
amplitude (`image_amplitude`); spectra and scene make what depends on the pair.
"""

from .budget import AnyVolume, CoherenceBudget
from .images import image_amplitude, image_snr, largest_amplitude
from .noise import (
    ambiguity_coherence,
    quantization_coherence,
    quantization_distortion,
    snr_coherence,
)
from .spectra import (
    azimuth_resolution,
    common_band,
    coregistration_coherence,
    doppler_offset,
    doppler_shift,
)
from .tables import at_incidence
from .temporal import TemporalDecorrelation
from .volume import (
    AttenuatedVolume,
    PenetratedVolume,
    ProfileVolume,
    UniformVolume,
    Volume,
    volume_bias,
)

__all__ = [
    "AnyVolume",
    "AttenuatedVolume",
    "CoherenceBudget",
    "PenetratedVolume",
    "ProfileVolume",
    "TemporalDecorrelation",
    "UniformVolume",
    "Volume",
    "ambiguity_coherence",
    "at_incidence",
    "azimuth_resolution",
    "common_band",
    "coregistration_coherence",
    "doppler_offset",
    "doppler_shift",
    "image_amplitude",
    "image_snr",
    "largest_amplitude",
    "quantization_coherence",
    "quantization_distortion",
    "snr_coherence",
    "volume_bias",
]
