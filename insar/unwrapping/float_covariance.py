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
    relative = noise_covariance(model.information)
    for factor in model.nuisance.values():
        relative += factor @ np.swapaxes(factor, -1, -2)
    relative += prior_height_std**2 * kz[..., :, None] * kz[..., None, :]
    return np.asarray(relative / (2.0 * np.pi) ** 2)


def noise_covariance(information: Array) -> Array:
    """Covariance of the noise of the phases, relative to the first image.

    Parameters
    ----------
    information : (..., M, M) — of the noise, rows summing to zero [1/rad²].

    Returns
    -------
    (..., M, M) — finite, with an image that shares no band with others all but unknown; the first
    row and column are zero [rad²].
    """
    covariance = np.zeros_like(information)
    index = np.arange(information.shape[-1] - 1)
    noise = information[..., 1:, 1:].copy()
    noise[..., index, index] += _UNMEASURED_PHASE_STD**-2
    try:
        covariance[..., 1:, 1:] = np.linalg.inv(noise)
    except np.linalg.LinAlgError:
        # Of images that share much with one another and nothing with the first, rounding swallows
        # so little information: a few roundings of the largest are enough.
        largest = noise[..., index, index].max(axis=-1)
        noise[..., index, index] += 1e-15 * largest[..., None]
        covariance[..., 1:, 1:] = np.linalg.inv(noise)
    return covariance
