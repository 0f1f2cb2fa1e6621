"""What the phases of N images tell: Fisher information by the Cramér-Rao bound.

An information matrix X (M × M, 1/rad²) is of the M image phases. Only their differences are
measured, so every row of X sums to zero; `insar.height_error` never inverts it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bands import band_intervals

Array = NDArray[np.float64]


def fisher_information(coherence: ArrayLike, *, looks: float) -> Array:
    """Joint information of the phases of images with a given coherence matrix.

    Parameters
    ----------
    coherence : (..., M, M) — Hermitian positive-definite matrix Γ with unit diagonal; complex
        where a factor carries a phase.
    looks : scalar — independent looks L.

    Returns
    -------
    (..., M, M) — X = 2L(Re(Γ∘(Γ⁻¹)ᵀ) − I) [1/rad²].

    Raises
    ------
    numpy.linalg.LinAlgError
        If a matrix is singular (two images fully coherent).

    References
    ----------
    The Fisher information of a circular Gaussian vector; Guarnieri and Tebaldini 2007,
    doi:10.1109/LSP.2007.904705, for the real case X = 2L(|Γ|∘|Γ|⁻¹ − I).
    """
    gamma = np.asarray(coherence)
    inverse = np.linalg.inv(gamma)
    product = np.real(gamma * np.swapaxes(inverse, -1, -2))
    return np.asarray(2.0 * looks * (product - np.eye(gamma.shape[-1])), dtype=np.float64)


def filtered_information(
    band_offset: ArrayLike,
    *,
    image_coherence: ArrayLike,
    looks: float,
    doppler_offset: ArrayLike | None = None,
) -> Array:
    """Joint information of the phases after spectral filtering to the common bands.

    Image i sees the rectangle [o_i, o_i + 1] × [d_i, d_i + 1] of the ground's range and azimuth
    spectrum. Each part of it is seen by a subset S of the images, there at full coherence γ_i γ_j;
    with u_i = γ_i²/(1 − γ_i²) and U the sum of u over S, its share of the looks gives
    X_ij = −2L u_i u_j/(1 + U), because a coherence matrix of rank one plus a diagonal inverts in
    closed form. Off the diagonal the sum over the parts is

        X_ij = −2L u_i u_j ∫ df/(1 + U(f))  over the common band of i and j:

    in range alone one cumulative integral serves all pairs, at a cost of O(M²) instead of O(M⁴).

    Parameters
    ----------
    band_offset : (..., M) — shifts o_i of the images' range bands, in bandwidths.
    image_coherence : scalar, (..., 1) or (..., M) — amplitude γ_i of each image, below 1.
    looks : scalar — independent looks L at full bandwidth.
    doppler_offset : (..., M) — shifts d_i of their azimuth bands, in bandwidths; None: all alike.

    Returns
    -------
    (..., M, M) — X [1/rad²]; zero between images without a common band.
    """
    offset = np.asarray(band_offset, dtype=np.float64)
    squared = np.asarray(image_coherence, dtype=np.float64) ** 2
    weight = np.atleast_1d(squared / (1.0 - squared))
    if doppler_offset is None:
        common = _common_integral(offset, weight)
    else:
        common = _common_area_integral(offset, np.asarray(doppler_offset), weight)
    product = weight[..., :, None] * weight[..., None, :]
    return with_zero_row_sums(-2.0 * looks * product * common)


def _common_integral(offset: Array, weight: Array) -> Array:
    """∫ df/(1 + U(f)) over the common band of each two images, (..., M, M)."""
    count = offset.shape[-1]
    edges = np.concatenate([offset, offset + 1.0], axis=-1)
    order = np.argsort(edges, axis=-1, kind="stable")
    sorted_edges = np.take_along_axis(edges, order, axis=-1)
    if weight.shape[-1] == 1:
        change = np.where(order < count, weight, -weight)
    else:
        each = np.broadcast_to(weight, offset.shape)
        change = np.take_along_axis(np.concatenate([each, -each], axis=-1), order, axis=-1)
    density = 1.0 / (1.0 + np.cumsum(change, axis=-1)[..., :-1])
    cumulative = np.zeros_like(edges)
    np.cumsum(density * np.diff(sorted_edges, axis=-1), axis=-1, out=cumulative[..., 1:])
    integral = np.empty_like(edges)
    np.put_along_axis(integral, order, cumulative, axis=-1)
    lower, upper = integral[..., :count], integral[..., count:]
    common = np.minimum(upper[..., :, None], upper[..., None, :]) - np.maximum(
        lower[..., :, None], lower[..., None, :]
    )
    return np.asarray(np.maximum(common, 0.0))


def _common_area_integral(offset: Array, doppler: Array, weight: Array) -> Array:
    """∬ df/(1 + U(f)) over the common rectangle of each two images, (..., M, M)."""
    across, along = band_intervals(offset), band_intervals(doppler)
    strength = np.swapaxes(across.seen * weight[..., None], -1, -2) @ along.seen
    density = across.width[..., :, None] * along.width[..., None, :] / (1.0 + strength)
    first, second = np.triu_indices(offset.shape[-1], k=1)
    rows = (across.seen[..., first, :] * across.seen[..., second, :]) @ density
    both = along.seen[..., first, :] * along.seen[..., second, :]
    integral = np.sum(rows * both, axis=-1)
    common = np.zeros((*offset.shape, offset.shape[-1]))
    common[..., first, second] = integral
    common[..., second, first] = integral
    return common


def cell_information(
    coherence: ArrayLike,
    *,
    looks: float,
    band_offset: ArrayLike,
    doppler_offset: ArrayLike | None = None,
) -> Array:
    """Joint information after filtering, of images with any coherence matrix.

    Where `filtered_information` has a closed form, this inverts the matrix of the images that see
    a part of the spectrum, part after part.

    Parameters
    ----------
    coherence : (..., M, M) — Hermitian positive-definite Γ of the parts that images have in common.
    looks : scalar — independent looks L at full bandwidth.
    band_offset, doppler_offset : (..., M) — as for `filtered_information`.

    Returns
    -------
    (..., M, M) — X = Σ 2L·area·(Re(Γ_S∘(Γ_S⁻¹)ᵀ) − I) [1/rad²].

    Raises
    ------
    numpy.linalg.LinAlgError
        If a matrix is singular (two images fully coherent).
    """
    gamma = np.asarray(coherence)
    count = gamma.shape[-1]
    across = band_intervals(band_offset)
    along = None if doppler_offset is None else band_intervals(doppler_offset)
    identity = np.eye(count)
    information = np.zeros(
        np.broadcast_shapes(gamma.shape, (*across.width.shape[:-1], count, count))
    )
    for row in range(across.width.shape[-1]):
        for column in range(1 if along is None else along.width.shape[-1]):
            area, seen = across.width[..., row], across.seen[..., row]
            if along is not None:
                area = area * along.width[..., column]
                seen = seen * along.seen[..., column]
            if not np.any(area > 0.0):
                continue
            both = seen[..., :, None] * seen[..., None, :] * (1.0 - identity)
            part = fisher_information(gamma * both + identity, looks=looks)
            information += area[..., None, None] * part
    return with_zero_row_sums(information)


def pair_phase_variance(coherence: ArrayLike, *, looks: ArrayLike) -> Array:
    """Variance of the phase of one pair.

    Parameters
    ----------
    coherence : (...) — magnitude γ of the pair's coherence, 0 to below 1.
    looks : (...) — independent looks L; zero where the pair shares no band.

    Returns
    -------
    (...) — (1 − γ²)/(2Lγ²), `inf` without coherence or looks [rad²].

    References
    ----------
    Rodriguez and Martin 1992, doi:10.1049/ip-f-2.1992.0018.
    """
    gamma = np.asarray(coherence, dtype=np.float64)
    with np.errstate(divide="ignore"):
        variance: Array = (1.0 - gamma**2) / (2.0 * np.asarray(looks) * gamma**2)
    return variance


def independent_pairs_information(
    pair_variance: ArrayLike, *, pairs: NDArray[np.intp], count: int
) -> Array:
    """Information of image phases if every pair were measured independently.

    Parameters
    ----------
    pair_variance : (..., K) — variance of each pair's phase, `inf` where it has none [rad²].
    pairs : (K, 2) — image indices of each pair.
    count : number M of images.

    Returns
    -------
    (..., M, M) — the graph Laplacian Dᵀ diag(1/variance) D [1/rad²].

    Notes
    -----
    N images are not N(N−1)/2 independent pairs: for more than two images this is more than can be
    known. It is the form of Li 2009.
    """
    weight = 1.0 / np.asarray(pair_variance, dtype=np.float64)
    information = np.zeros((*weight.shape[:-1], count, count))
    first, second = pairs.T
    information[..., first, second] = -weight
    information[..., second, first] = -weight
    return with_zero_row_sums(information)


def with_zero_row_sums(off_diagonal: Array) -> Array:
    """Set the diagonal, in place, so that a common phase carries no information."""
    index = np.arange(off_diagonal.shape[-1])
    off_diagonal[..., index, index] = 0.0
    off_diagonal[..., index, index] = -off_diagonal.sum(axis=-1)
    return off_diagonal
