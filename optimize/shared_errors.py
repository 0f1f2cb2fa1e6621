"""Errors that images share and no design changes: those of positions and synchronization."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import ErrorBudget, Radar, SharedBy

Array = NDArray[np.float64]


class SharedErrors(NamedTuple):
    """What no design changes of the errors that images share.

    Attributes
    ----------
    shared : (M, M) — FFᵀ relative to the first image [rad²].
    factor : (M, R) — lower triangular F with R = M − 1, or no column where there is no error [rad].
    own_variance : p² where the errors act on all images alike, FFᵀ = p²(I + 11ᵀ) relative to the
        first, which is p²I but for what all have in common; −1 where they don't [rad²].
    pair_variance : (K,) — what pairs have apart from their phase noise [rad²].
    """

    shared: Array
    factor: Array
    own_variance: float
    pair_variance: Array


def shared_errors(*, radar: Radar, errors: ErrorBudget) -> SharedErrors:
    """Collect the errors of position and synchronization.

    Parameters
    ----------
    radar : the radar and its M images.
    errors : the error budget.
    """
    first, second = radar.image_pairs.T
    wavenumber = 2.0 * math.pi / radar.wavelength
    bistatic = np.diag([float(tx != rx) for tx, rx in radar.images])
    sources = (
        (errors.position, wavenumber * errors.position.std * radar.relative_incidence),
        (errors.synchronization, errors.synchronization.std * bistatic),
    )
    columns, variance = [np.zeros((len(radar.images), 0))], np.zeros(len(first))
    for source, factor in sources:
        if source.std == 0.0:
            continue
        if source.shared_by is SharedBy.PAIR:
            variance += np.sum((factor[second] - factor[first]) ** 2, axis=-1)
        else:
            columns.append(factor - factor[:1])
    every = np.concatenate(columns, axis=-1)
    shared = every @ every.T
    return SharedErrors(shared, _triangular(every), _own_variance(shared), variance)


def _triangular(factor: Array) -> Array:
    """Return a factor of the same FFᵀ with no more columns than it has rows that count."""
    if factor.shape[1] == 0:
        return factor
    upper = np.linalg.qr(factor[1:].T).R
    return np.concatenate([np.zeros((1, len(upper))), upper.T])


def _own_variance(shared: Array) -> float:
    covariance = shared[1:, 1:]
    own = float(covariance[0, 0]) / 2.0
    pattern = own * (np.eye(len(covariance)) + 1.0)
    same = np.allclose(covariance, pattern, rtol=1e-12, atol=1e-14 * own)
    return own if same else -1.0
