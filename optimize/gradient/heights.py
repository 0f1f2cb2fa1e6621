"""Derivatives of the height information and of the unwrapping failure of each segment.

Both are functions of the phase model (kz, X, F) alone. By the envelope theorem neither needs the
derivative of its own optimum:

    J = kzᵀ(X⁻¹ + FFᵀ)⁻¹kz:   dJ = 2wᵀdkz + gᵀdX g − 2 wᵀdF a,
    w = Xg the optimal weights, g = kz − Fa what the shared errors leave, a = Fᵀw;

    σ_k² = vᵀQv, v the innovation of rung k:   dσ_k² = vᵀdQ v,
    dQ = (−X⁻¹dX X⁻¹ + dF Fᵀ + F dFᵀ + σ_0²(dkz kzᵀ + kz dkzᵀ))/(2π)²,

and gᵀdX g = Σ_{i<j} dx_ij (g_i − g_j)² since X is a graph Laplacian with edges x_ij.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfc

from insar import PhaseModel, unwrapping_ladder
from insar.unwrapping import noise_covariance

Array = NDArray[np.float64]


class Slopes(NamedTuple):
    """Derivatives of one quantity of each segment by the parts of the phase model.

    Attributes
    ----------
    wavenumber : (S, M) — by kz of each image.
    edge : (S, M, M) — by the edge x_ij, symmetric.
    azimuth : (S, M) — by the azimuth factor F of each image; zero without an azimuth error.
    """

    wavenumber: Array
    edge: Array
    azimuth: Array


def height_slopes(model: PhaseModel) -> tuple[Array, Slopes]:
    """Height information of each segment and its derivatives.

    Parameters
    ----------
    model : of one formation, with the joint weighting.

    Returns
    -------
    (S,) — J [1/m²], and its derivatives.
    """
    kz, information = model.vertical_wavenumber, model.information
    factor = _factor(model)
    normal = np.swapaxes(factor, -1, -2) @ information @ factor
    normal = normal + np.eye(factor.shape[-1])
    shared = np.swapaxes(factor, -1, -2) @ (information @ kz[..., None])
    amplitude = np.linalg.solve(normal, shared)
    left = kz - (factor @ amplitude)[..., 0]
    weights = (information @ left[..., None])[..., 0]
    fisher = np.sum(left * weights, axis=-1) + np.sum(amplitude[..., 0] ** 2, axis=-1)
    azimuth = np.zeros_like(kz)
    if "azimuth" in model.nuisance:
        along = np.sum(model.nuisance["azimuth"][..., 0] * weights, axis=-1, keepdims=True)
        azimuth = -2.0 * weights * along
    return fisher, Slopes(2.0 * weights, _squared_differences(left), azimuth)


def failure_slopes(model: PhaseModel, *, prior_height_std: float) -> tuple[Array, Slopes]:
    """Logarithm of each segment's unwrapping failure and its derivatives, in the ladder's order.

    Parameters
    ----------
    model : of one formation, with the joint weighting.
    prior_height_std : scalar — standard deviation of the prior height [m].

    Returns
    -------
    (S,) — ln of the probability of failure, and its derivatives.
    """
    ladder = unwrapping_ladder(model, prior_height_std=prior_height_std)
    kz, factor = model.vertical_wavenumber, _factor(model)
    segments, count = kz.shape
    inverse = noise_covariance(model.information)
    covariance = inverse + factor @ np.swapaxes(factor, -1, -2)
    covariance = covariance + prior_height_std**2 * kz[:, :, None] * kz[:, None, :]
    innovation = _innovations(ladder.pairs, covariance)

    std = np.maximum(ladder.cycle_std, 1e-30)
    wrong = erfc(1.0 / (2.0 * math.sqrt(2.0) * std))
    by_std = np.exp(-1.0 / (8.0 * std**2)) / (math.sqrt(2.0 * math.pi) * std**2)
    success = 1.0 - ladder.failure
    failure = np.maximum(ladder.failure, 1e-300)
    by_rung = (success / failure)[:, None] * by_std / (1.0 - wrong)  # d ln P_f / dσ_k
    scale = by_rung / (2.0 * std) / (2.0 * math.pi) ** 2  # σ_k → the variance in rad²

    told = innovation @ inverse  # X⁻¹v of every rung
    edge = np.zeros((segments, count, count))
    for rung in range(count - 1):
        edge -= scale[:, rung, None, None] * _squared_differences(told[:, rung])
    along = 2.0 * scale * (innovation @ kz[..., None])[..., 0] * prior_height_std**2
    wavenumber = np.sum(along[..., None] * innovation, axis=-2)
    azimuth = np.zeros_like(kz)
    if "azimuth" in model.nuisance:
        across = 2.0 * scale * (innovation @ model.nuisance["azimuth"])[..., 0]
        azimuth = np.sum(across[..., None] * innovation, axis=-2)
    return np.log(failure), Slopes(wavenumber, edge, azimuth)


def _innovations(pairs: NDArray[np.intp], covariance: Array) -> Array:
    """What each rung (S, M − 1, M) measures beyond the rungs below it: L⁻¹D, D Q Dᵀ = L Δ Lᵀ."""
    segments, rungs, _ = pairs.shape
    difference = np.zeros((segments, rungs, rungs + 1))
    segment, rung = np.arange(segments)[:, None], np.arange(rungs)[None, :]
    difference[segment, rung, pairs[..., 0]] -= 1.0
    difference[segment, rung, pairs[..., 1]] += 1.0
    innovation = difference.copy()
    for index in range(rungs - 1):
        row = innovation[:, index]
        seen = (covariance @ row[..., None])[..., 0]
        variance = np.maximum(np.sum(row * seen, axis=-1), 1e-300)
        gain = (innovation[:, index + 1 :] @ seen[..., None]) / variance[:, None, None]
        innovation[:, index + 1 :] -= gain * row[:, None, :]
    return innovation


def _factor(model: PhaseModel) -> Array:
    parts = list(model.nuisance.values())
    kz = model.vertical_wavenumber
    return np.concatenate(parts, axis=-1) if parts else np.zeros((*kz.shape, 0))


def _squared_differences(values: Array) -> Array:
    squares: Array = (values[..., :, None] - values[..., None, :]) ** 2
    return squares
