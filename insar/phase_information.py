"""What the phases of N images tell: Fisher information by the Cramér-Rao bound.

An information matrix X (M × M, 1/rad²) is of the M image phases. Only their differences are
measured, so every row of X sums to zero; `insar.height_error` never inverts it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

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


def filtered_information(band_offset: ArrayLike, *, image_coherence: float, looks: float) -> Array:
    """Joint information of the phases after range spectral filtering to the common bands.

    Image i sees the ground band [o_i, o_i + 1]. Each interval of the band is seen by a subset of
    the images, there at full coherence γ_i γ_j = γ²; its share of the looks gives a subset S the
    information 2L w²(|S| I − 11ᵀ)/(1 + |S|w) with w = γ²/(1 − γ²), because a coherence matrix of
    rank one plus a diagonal inverts in closed form. Off the diagonal the sum over intervals is

        X_ij = −2L w² ∫ df/(1 + n(f) w)  over the common band of i and j,

    n(f) the number of images that see f: one cumulative integral serves all pairs, at a cost of
    O(M²) instead of O(M⁴).

    Parameters
    ----------
    band_offset : (..., M) — shifts o_i of the images' ground bands, in bandwidths.
    image_coherence : scalar — amplitude γ_i of each image, below 1.
    looks : scalar — independent looks L at full bandwidth.

    Returns
    -------
    (..., M, M) — X [1/rad²]; zero between images without a common band.
    """
    offset = np.asarray(band_offset, dtype=np.float64)
    count = offset.shape[-1]
    weight = image_coherence**2 / (1.0 - image_coherence**2)
    edges = np.concatenate([offset, offset + 1.0], axis=-1)
    order = np.argsort(edges, axis=-1, kind="stable")
    sorted_edges = np.take_along_axis(edges, order, axis=-1)
    seen_by = np.cumsum(np.where(order < count, 1.0, -1.0), axis=-1)
    density = 1.0 / (1.0 + weight * seen_by[..., :-1])
    cumulative = np.zeros_like(edges)
    np.cumsum(density * np.diff(sorted_edges, axis=-1), axis=-1, out=cumulative[..., 1:])
    integral = np.empty_like(edges)
    np.put_along_axis(integral, order, cumulative, axis=-1)
    lower, upper = integral[..., :count], integral[..., count:]
    common = np.minimum(upper[..., :, None], upper[..., None, :]) - np.maximum(
        lower[..., :, None], lower[..., None, :]
    )
    return _with_zero_row_sums(-2.0 * looks * weight**2 * np.maximum(common, 0.0))


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
    return _with_zero_row_sums(information)


def _with_zero_row_sums(off_diagonal: Array) -> Array:
    """Set the diagonal so that a common phase carries no information."""
    index = np.arange(off_diagonal.shape[-1])
    off_diagonal[..., index, index] = 0.0
    off_diagonal[..., index, index] = -off_diagonal.sum(axis=-1)
    return off_diagonal
