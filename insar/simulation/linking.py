"""Phases of maximum likelihood from the looks of many images, and heights likewise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SWEEPS = 6
_NEWTON_STEPS = 4
_REFINEMENTS = 12


def linked_phases(data: Complex, *, rng: np.random.Generator) -> Array:
    """Phases that maximize the likelihood vᴴAv, v = e^{iφ}.

    Parameters
    ----------
    data : (samples, M, M) — A of `speckle.link_matrices`.
    rng : draws the phases of images that share nothing with any other.

    Returns
    -------
    (samples, M) — relative to the first image, modulo 2π [rad].

    Notes
    -----
    From the phases of the leading eigenvector: one image at a time, which never loses likelihood,
    then Newton's method.
    """
    samples, count, _ = data.shape
    if count == 2:
        vector = np.stack([np.ones(samples, dtype=np.complex128), data[:, 1, 0]], axis=-1)
        return _relative(_unit(vector, rng))
    vector = _unit(np.linalg.eigh(data)[1][..., -1], rng)
    for _ in range(_SWEEPS):
        for image in range(count):
            pull = np.einsum("sj,sj->s", data[:, image], vector)
            size = np.abs(pull)
            vector[:, image] = np.where(
                size > 0.0, pull / np.where(size > 0.0, size, 1.0), vector[:, image]
            )
    for _ in range(_NEWTON_STEPS):
        gradient, weight = slope_and_weights(data, vector, sharp=True)
        hessian = laplacian(np.maximum(weight, 0.0))[:, 1:, 1:]
        step = np.linalg.solve(hessian + _ridge(hessian), gradient[:, 1:, None])[..., 0]
        # Newton's step is for the end of the way; a long one is no better than the sweeps.
        vector[:, 1:] *= np.exp(1j * np.where(np.abs(step) < 0.5, step, 0.0))
    return _relative(vector)


def slope_and_weights(data: Complex, vector: Complex, *, sharp: bool) -> tuple[Array, Array]:
    """Gradient of vᴴAv to the phases, and the curvature of each pair of images.

    Parameters
    ----------
    data : (samples, M, M) — A.
    vector : (samples, M) — e^{iφ}.
    sharp : whether the curvature is the second derivative; if not, that of the closest parabola
        that lies nowhere above the cosine, which makes every step an ascent.

    Returns
    -------
    gradient : (samples, M) — [1/rad].
    weight : (samples, M, M) — of each pair; the information is their graph Laplacian [1/rad²].
    """
    turned = np.conj(vector)[:, :, None] * data * vector[:, None, :]
    gradient = 2.0 * turned.imag.sum(axis=-1)
    if sharp:
        return gradient, 2.0 * turned.real
    angle = np.angle(turned)
    return gradient, 2.0 * np.abs(turned) * np.sinc(angle / np.pi)


def laplacian(weight: Array) -> Array:
    """Matrix of −weight off the diagonal whose rows sum to zero."""
    matrix = -weight
    index = np.arange(weight.shape[-1])
    matrix[:, index, index] = 0.0
    matrix[:, index, index] = -matrix.sum(axis=-1)
    return matrix


def most_likely_height(data: Complex, phase: Array, *, start: Array, factor: Array) -> Array:
    """Height of maximum likelihood with its prior, together with the errors that images share.

    Maximizes vᴴAv − |x|²/2 over x = (height in prior deviations, shared errors in theirs), where
    the phases are φ = G x.

    Parameters
    ----------
    data : (samples, M, M) — A of images whose true phases are zero.
    phase : (samples, M) — their true phases, relative to the first [rad].
    start : (samples, 1 + R) — where the ascent begins, in the right cycle or a wrong one.
    factor : (B, M, 1 + R) — G, its first column kz times the prior deviation [rad]; B is 1, or the
        number of samples.

    Returns
    -------
    (samples,) — heights in prior deviations.
    """
    unknown = start.copy()
    transposed = np.swapaxes(factor, -1, -2)
    identity = np.eye(factor.shape[-1])
    for _ in range(_REFINEMENTS):
        vector = np.exp(1j * ((factor @ unknown[..., None])[..., 0] - phase))
        gradient, weight = slope_and_weights(data, vector, sharp=False)
        curvature = transposed @ laplacian(weight) @ factor + identity
        residual = (transposed @ gradient[..., None])[..., 0] - unknown
        unknown += np.linalg.solve(curvature, residual[..., None])[..., 0]
    return unknown[:, 0]


def _ridge(matrix: Array) -> Array:
    """What keeps an image without information from making a matrix singular."""
    scale = np.trace(matrix, axis1=-2, axis2=-1)
    ridge: Array = (1e-12 * scale + 1e-300)[:, None, None] * np.eye(matrix.shape[-1])
    return ridge


def _relative(vector: Complex) -> Array:
    return np.asarray(np.angle(vector * np.conj(vector[:, :1])))


def _unit(vector: Complex, rng: np.random.Generator) -> Complex:
    """Numbers of modulus one; of random phase where there is nothing to go by."""
    size = np.abs(vector)
    blind = size < 1e-12 * size.max(axis=-1, keepdims=True)
    blind |= size == 0.0
    random = np.exp(2j * np.pi * rng.random(vector.shape))
    return np.asarray(np.where(blind, random, vector / np.where(size > 0.0, size, 1.0)))
