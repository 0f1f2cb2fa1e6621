"""Coherence that noise leaves: thermal, of quantization, of ambiguities.

Each is noise of one image: independent from image to image, so that the factor of a pair is the
product of what its two images keep.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr

Array = NDArray[np.float64]


def snr_coherence(first_snr: ArrayLike, second_snr: ArrayLike) -> Array:
    """Coherence that thermal noise leaves.

    Parameters
    ----------
    first_snr, second_snr : (...) — signal-to-noise ratios σ⁰/NESZ of the images, as power ratios.

    Returns
    -------
    (...) — 1/√((1 + 1/SNR₁)(1 + 1/SNR₂)).

    References
    ----------
    Zebker and Villasenor 1992, doi:10.1109/36.175330.

    Examples
    --------
    5 dB and 10 dB in both images:

    >>> snr_coherence([10**0.5, 10.0], [10**0.5, 10.0]).round(4)
    array([0.7597, 0.9091])
    """
    product = (1.0 + 1.0 / np.asarray(first_snr, dtype=np.float64)) * (
        1.0 + 1.0 / np.asarray(second_snr, dtype=np.float64)
    )
    return np.asarray(1.0 / np.sqrt(product))


@lru_cache(maxsize=16)
def quantization_distortion(bits: int) -> float:
    """Mean squared error of the best quantizer of Gaussian raw data, over their variance.

    Parameters
    ----------
    bits : of each of the in-phase and the quadrature sample, 1 to 8.

    Raises
    ------
    ValueError
        If the number of bits is outside 1 to 8.

    References
    ----------
    Max 1960, doi:10.1109/TIT.1960.1057548, Table I: 0.3634, 0.1175, 0.03454 and 0.009497 with 1
    to 4 bits. Computed here by his conditions: thresholds halfway between the levels, levels at
    the means of their intervals.

    Examples
    --------
    >>> [round(quantization_distortion(bits), 4) for bits in (1, 2, 3, 4)]
    [0.3634, 0.1175, 0.0345, 0.0095]
    """
    if not 1 <= bits <= 8:
        raise ValueError(f"bits = {bits!r} must lie between 1 and 8")
    count = 2 ** (bits - 1)  # of the levels above zero; the others mirror them
    levels = 1.2 * (np.arange(count) + 0.5) / np.sqrt(count)
    for _ in range(200):
        shares, moments, threshold = _intervals(levels)
        means = moments / shares
        # Newton's method on levels − means(levels): plain iteration takes 10⁴ steps at 8 bits.
        density = np.exp(-0.5 * threshold**2) / np.sqrt(2.0 * np.pi)
        slope = np.zeros((count, count))
        for edge in range(1, count):
            pull = 0.5 * density[edge] * (threshold[edge] - means) / shares
            slope[edge - 1, [edge - 1, edge]] += pull[edge - 1]
            slope[edge, [edge - 1, edge]] -= pull[edge]
        step = np.linalg.solve(np.eye(count) - slope, means - levels)
        levels = levels + step
        if np.max(np.abs(step)) < 1e-13:
            break
    shares, moments, _ = _intervals(levels)
    return float(1.0 - 2.0 * np.sum(moments**2 / shares))


def _intervals(levels: Array) -> tuple[Array, Array, Array]:
    """Probability, first moment and thresholds of the intervals above zero of a normal number."""
    threshold = np.concatenate([[0.0], 0.5 * (levels[1:] + levels[:-1]), [40.0]])
    density = np.exp(-0.5 * threshold**2) / np.sqrt(2.0 * np.pi)
    # Of the upper tail, which keeps its digits.
    return -np.diff(ndtr(-threshold)), -np.diff(density), threshold


def quantization_coherence(bits: int) -> float:
    """Coherence of a pair whose raw data are quantized with a number of bits.

    Parameters
    ----------
    bits : of each of the in-phase and the quadrature sample, 1 to 8.

    Returns
    -------
    scalar — 1 − D, with D of `quantization_distortion`.

    Raises
    ------
    ValueError
        If the number of bits is outside 1 to 8.

    Notes
    -----
    The best quantizer of a Gaussian sample x gives y = (1 − D)x + d, with d uncorrelated to x and
    of variance D(1 − D): a signal-to-noise ratio of (1 − D)/D in each image. Block-adaptive
    quantization keeps the quantizer matched to the power; where power varies within a block, or
    the raw data of a bright target clip, more is lost.

    References
    ----------
    Max 1960, doi:10.1109/TIT.1960.1057548.

    Examples
    --------
    >>> round(quantization_coherence(3), 4)
    0.9655
    """
    return 1.0 - quantization_distortion(bits)


def ambiguity_coherence(*, rasr: ArrayLike, aasr: ArrayLike) -> Array:
    """Coherence that ambiguities leave.

    Parameters
    ----------
    rasr : (...) — range ambiguity-to-signal ratio, as a power ratio.
    aasr : (...) — azimuth ambiguity-to-signal ratio, likewise.

    Returns
    -------
    (...) — 1/((1 + RASR)(1 + AASR)).

    Notes
    -----
    Takes ambiguities for noise that differs between the images. Those of a pair on a short
    baseline are partly alike and then shift the phase rather than blur it.

    References
    ----------
    Krieger et al. 2007, doi:10.1109/TGRS.2007.900693.
    """
    range_ratio = np.asarray(rasr, dtype=np.float64)
    return np.asarray(1.0 / ((1.0 + range_ratio) * (1.0 + np.asarray(aasr, dtype=np.float64))))
