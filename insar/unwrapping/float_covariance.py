"""How well the ambiguities of the images are known before any is fixed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..phase_model import PhaseModel

Array = NDArray[np.float64]

_UNMEASURED_PHASE_STD = 1e6
"""Phase deviation given to an image that shares no band with another [rad]: as good as infinite
(its rung succeeds with probability 1e-6), yet an invertible matrix."""


def float_covariance(model: PhaseModel, prior_height_std: float) -> Array:
    """Covariance of the float ambiguities of the images, relative to the first.

    Parameters
    ----------
    model : the phase model of the designs.
    prior_height_std : scalar — standard deviation of the prior height [m].

    Returns
    -------
    (..., S, M, M) — Q = (C + σ_0² kz kzᵀ)/(2π)² with C of noise and shared errors; the first row
    and column are zero [cycles²].
    """
    kz = model.vertical_wavenumber
    relative = np.zeros_like(model.information)
    index = np.arange(kz.shape[-1] - 1)
    noise = model.information[..., 1:, 1:].copy()
    noise[..., index, index] += _UNMEASURED_PHASE_STD**-2
    relative[..., 1:, 1:] = np.linalg.inv(noise)
    for factor in model.nuisance.values():
        relative += factor @ np.swapaxes(factor, -1, -2)
    relative += prior_height_std**2 * kz[..., :, None] * kz[..., None, :]
    return np.asarray(relative / (2.0 * np.pi) ** 2)
