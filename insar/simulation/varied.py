"""Speckle of samples each of which has bands and coherence of its own: points of terrain."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .speckle import circular

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

_CHUNK = 2_000_000
"""Complex numbers of the largest array that lives at a time."""

_GOLDEN = 0.6180339887498949
"""Step of the most even sequence of places on an interval."""


def varied_link_matrices(
    band_offset: Array,
    amplitude: Array,
    *,
    looks: float,
    rng: np.random.Generator,
    doppler_offset: Array | None = None,
    pair_factor: Complex | None = None,
) -> Complex:
    """Matrices of `link_matrices` after spectral filtering, of samples that differ.

    Every sample gets its own grid of looks over the ground's spectrum, which begins anywhere; in
    azimuth, where bands differ there, looks are spread by the golden ratio.

    Parameters
    ----------
    band_offset : (samples, M) — lower ends of the images' range bands, in bandwidths.
    amplitude : (samples, M) — g, below 1.
    looks : scalar — independent samples of what one image sees.
    rng : source of random numbers.
    doppler_offset : (samples, M) — of their azimuth bands, likewise; None: all the same.
    pair_factor : (samples, M, M) — of the coherence g_i g_j of each pair, Hermitian; None for one.

    Returns
    -------
    (samples, M, M) — as `link_matrices`.
    """
    samples, count = band_offset.shape
    data = np.zeros((samples, count, count), dtype=np.complex128)
    # Bands further apart share nothing, whatever lies between them.
    across = 1.0 + min(float(np.max(np.ptp(band_offset, axis=-1), initial=0.0)), 1.0 * count)
    along = 1.0
    if doppler_offset is not None:
        along += min(float(np.max(np.ptp(doppler_offset, axis=-1), initial=0.0)), 1.0 * count)
    number = int(np.ceil(looks * across * along)) + 1
    size = max(1, _CHUNK // (count * number))
    for start in range(0, samples, size):
        rows = slice(start, start + size)
        shape = (len(band_offset[rows]), number)
        place = band_offset[rows].min(axis=-1, keepdims=True)
        place = place + (np.arange(number) + rng.random((shape[0], 1))) / (looks * along)
        seen = _inside(place, band_offset[rows])
        if doppler_offset is not None:
            spread = np.mod(_GOLDEN * np.arange(number) + rng.random((shape[0], 1)), 1.0)
            low = doppler_offset[rows].min(axis=-1, keepdims=True)
            seen &= _inside(low + along * spread, doppler_offset[rows])
        if pair_factor is None:
            data[rows] = _rank_one(amplitude[rows], seen, rng)
        else:
            gamma = amplitude[rows, :, None] * amplitude[rows, None, :] * pair_factor[rows]
            data[rows] = _general(gamma, seen, rng)
    index = np.arange(count)
    data[:, index, index] = 0.0
    return data


def _inside(place: Array, offset: Array) -> Mask:
    """Which images see a place of the spectrum, (samples, M, looks)."""
    low = offset[..., None]
    return np.asarray((low <= place[:, None]) & (place[:, None] < low + 1.0))


def _rank_one(amplitude: Array, seen: Mask, rng: np.random.Generator) -> Complex:
    """Of images whose coherence is g_i g_j.

    With u_i = g_i²/(1 − g_i²) and U the sum of u over the images that see a look, −(Γ⁻¹)_ij is
    √(u_i u_j)/√((1 − g_i²)(1 − g_j²))/(1 + U): one number for each image and look.
    """
    samples, count, number = seen.shape
    noise_power = 1.0 - amplitude**2
    weight = amplitude**2 / noise_power
    images = np.sqrt(noise_power)[..., None] * circular(rng, (samples, count, number))
    images += amplitude[..., None] * circular(rng, (samples, 1, number))
    images *= seen * (amplitude / noise_power)[..., None]
    images /= np.sqrt(1.0 + np.sum(weight[..., None] * seen, axis=1))[:, None]
    return np.asarray(images @ np.conj(np.swapaxes(images, -1, -2)))


def _general(coherence: Complex, seen: Mask, rng: np.random.Generator) -> Complex:
    """Of images of any coherence: the looks of each set of images apart."""
    samples, count, number = seen.shape
    gamma = coherence.copy()
    index = np.arange(count)
    gamma[:, index, index] = 1.0
    images = np.linalg.cholesky(gamma) @ circular(rng, (samples, count, number))
    data = np.zeros((samples, count, count), dtype=np.complex128)
    code = np.tensordot(seen, 2 ** np.arange(count, dtype=np.int64), axes=(1, 0))
    for pattern in np.unique(code):
        members = np.flatnonzero(pattern >> np.arange(count) & 1)
        if members.size < 2:
            continue
        part = images[:, members] * (code == pattern)[:, None]
        scatter = part @ np.conj(np.swapaxes(part, -1, -2))
        inverse = np.linalg.inv(gamma[:, members[:, None], members])
        data[:, members[:, None], members] -= np.conj(inverse) * scatter
    return data


def unfiltered_link_matrices(
    coherence: Array | Complex, *, looks: float, rng: np.random.Generator
) -> Complex:
    """Likewise of samples that have a coherence matrix of their own, without filtering.

    Parameters
    ----------
    coherence : (samples, M, M) — Hermitian, unit diagonal.
    looks : scalar — independent samples; where they are not whole, one more or less.
    rng : source of random numbers.
    """
    samples, count, _ = coherence.shape
    number = int(np.ceil(looks))
    images = np.linalg.cholesky(coherence) @ circular(rng, (samples, count, number))
    if number > looks:
        images[rng.random(samples) >= looks - np.floor(looks), :, -1] = 0.0
    scatter = images @ np.conj(np.swapaxes(images, -1, -2))
    data = -np.conj(np.linalg.inv(coherence)) * scatter
    index = np.arange(count)
    data[:, index, index] = 0.0
    return np.asarray(data)
