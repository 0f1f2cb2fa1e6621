"""Quantiles of phase differences by interpolation: for maps and searches that ask for many."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .noise import phase_std
from .quantiles import difference_quantile

Array = NDArray[np.float64]

_STEP = 0.3
"""Of the lattice, in ln(κ(1 + L)) and in ln L."""

_SIGNAL = (-12.0, 30.0)
_LOOKS = (-7.0, 12.0)
"""Range of the lattice in ln(κ(1 + L)) and in ln L; beyond, its edge counts."""


def quick_difference_quantile(
    coherence: ArrayLike, *, looks: ArrayLike, level: float = 0.9
) -> Array:
    """`difference_quantile`, within 1e-3 of itself and far faster where many are asked for.

    Parameters
    ----------
    coherence : (...) — magnitude γ, above 0 and below 1.
    looks : (...) — independent looks L, above 0; need not be whole.
    level : scalar — the probability, between 0 and 1.

    Returns
    -------
    (...) — d with P(|φ₁ − φ₂| ≤ d) = level [rad].

    Notes
    -----
    In parts of the exact deviation (`phase_std`, which is a table) the quantile depends but weakly
    on coherence and looks: 2.33 for normal errors at 90 %, 2.1 to 2.5 elsewhere. That ratio is
    interpolated by cubics on a lattice in ln(κ(1 + L)), κ = γ²/(1 − γ²), and ln L, whose nodes are
    computed when they are first needed and kept.
    """
    gamma, number = np.broadcast_arrays(
        np.asarray(coherence, dtype=np.float64), np.asarray(looks, dtype=np.float64)
    )
    signal = np.log(gamma**2 / ((1.0 - gamma) * (1.0 + gamma)) * (1.0 + number))
    rows, row_weights = _cubic(np.clip(signal, *_SIGNAL))
    columns, column_weights = _cubic(np.clip(np.log(number), *_LOOKS))
    offset = np.arange(4).reshape((4,) + (1,) * gamma.ndim)
    nodes = _nodes(*np.broadcast_arrays((rows + offset)[:, None], columns + offset), level=level)
    weights = np.stack(row_weights)[:, None] * np.stack(column_weights)
    ratio = np.sum(weights * nodes, axis=(0, 1))
    return np.asarray(ratio * phase_std(gamma, looks=number))


def _cubic(position: Array) -> tuple[NDArray[np.int64], list[Array]]:
    """First of four lattice nodes about a position, and their Lagrange weights."""
    scaled = position / _STEP
    first = np.floor(scaled).astype(np.int64) - 1
    t = scaled - first - 1.0
    return first, [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ]


def _nodes(row: NDArray[np.int64], column: NDArray[np.int64], *, level: float) -> Array:
    keys, inverse = np.unique(
        np.stack([row.ravel(), column.ravel()], axis=-1), axis=0, return_inverse=True
    )
    values = np.array([_node(int(i), int(j), level) for i, j in keys])
    return np.asarray(values[inverse.reshape(-1)].reshape(row.shape))


@lru_cache(maxsize=20_000)
def _node(row: int, column: int, level: float) -> float:
    looks = np.exp(_STEP * column)
    kappa = np.exp(_STEP * row) / (1.0 + looks)
    gamma = min(float(np.sqrt(kappa / (1.0 + kappa))), 1.0 - 1e-12)
    quantile = float(difference_quantile(gamma, looks=looks, level=level))
    return quantile / float(phase_std(gamma, looks=looks))
