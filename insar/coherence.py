"""Coherence of image pairs, factor by factor.

Each factor is a function of its own, so that a budget multiplies the ones that it counts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def snr_coherence(first_snr: ArrayLike, second_snr: ArrayLike) -> Array:
    """Coherence that thermal noise leaves.

    Parameters
    ----------
    first_snr, second_snr : (...) — signal-to-noise ratios of the images, as power ratios.

    Returns
    -------
    (...) — 1/√((1 + 1/SNR₁)(1 + 1/SNR₂)).

    References
    ----------
    Zebker and Villasenor 1992, doi:10.1109/36.175330.

    Examples
    --------
    10 dB in both images:

    >>> float(snr_coherence(10.0, 10.0).round(4))
    0.9091
    """
    product = (1.0 + 1.0 / np.asarray(first_snr, dtype=np.float64)) * (
        1.0 + 1.0 / np.asarray(second_snr, dtype=np.float64)
    )
    return np.asarray(1.0 / np.sqrt(product))


def common_band(first_offset: ArrayLike, second_offset: ArrayLike) -> Array:
    """Share of the range band that two images have in common on the ground.

    A perpendicular baseline B⊥ shifts the ground spectrum by B⊥/B_crit bandwidths. This is the
    coherence of a surface without range spectral filtering; with filtering the coherence stays
    and this share of the looks remains.

    Parameters
    ----------
    first_offset, second_offset : (...) — shifts of the images' ground bands, in bandwidths.

    Returns
    -------
    (...) — max(0, 1 − |o₁ − o₂|).

    References
    ----------
    Gatelli et al. 1994, doi:10.1109/36.298013.
    """
    first = np.asarray(first_offset, dtype=np.float64)
    shift = np.abs(first - np.asarray(second_offset, dtype=np.float64))
    return np.maximum(0.0, 1.0 - shift)
