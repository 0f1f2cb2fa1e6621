"""Phase noise of pairs of images by the exact statistics, as a part of the Fisher information."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .statistics import phase_efficiency

Array = NDArray[np.float64]


def pair_efficiency(coherence: ArrayLike, looks: ArrayLike) -> Array:
    """Efficiency of each pair's phase, where coherence or looks may be missing too.

    Parameters
    ----------
    coherence : (...) — magnitude γ, 0 to below 1. Where it is the same for all designs,
        `statistics.efficiency_curves` is ten times as fast.
    looks : (...) — independent looks L, 0 or more.

    Returns
    -------
    (...) — η = σ²(Cramér-Rao)/σ²(exact), at most 1; 1 where there is nothing to lose.
    """
    gamma = np.asarray(coherence, dtype=np.float64)
    number = np.asarray(looks, dtype=np.float64)
    told = np.broadcast_to(number > 0.0, np.broadcast_shapes(gamma.shape, number.shape))
    efficiency = phase_efficiency(gamma, looks=np.where(told, number, 1.0))
    return np.asarray(np.where(told, efficiency, 1.0))


def lessen_information(
    information: Array, efficiency: ArrayLike, *, pairs: NDArray[np.intp]
) -> Array:
    """Fisher information of images of which each pair has less than its Cramér-Rao bound.

    Parameters
    ----------
    information : (..., M, M) — X, rows summing to zero [1/rad²].
    efficiency : (..., K) — η of each pair, at most 1.
    pairs : (K, 2) — the images of each pair, every two once.

    Returns
    -------
    (..., M, M) — X with each edge −X_ij times η_ij, rows summing to zero [1/rad²].

    Notes
    -----
    X is a graph Laplacian whose edges are the pairs. For two images 1/X becomes the exact variance
    of their phase. For more it is a rule, not a theorem: simulated maximum-likelihood heights of
    three and four images agree with it within 5 % wherever cycles are rarely mistaken
    (docs/error_model.md, section 5).
    """
    first, second = pairs.T
    edge = information[..., first, second] * np.asarray(efficiency, dtype=np.float64)
    lessened = np.zeros_like(information)
    lessened[..., first, second] = edge
    lessened[..., second, first] = edge
    index = np.arange(information.shape[-1])
    lessened[..., index, index] = -lessened.sum(axis=-1)
    return lessened
