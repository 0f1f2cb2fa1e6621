"""Draws complex images of rough ground, and reduces them to what their phases depend on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..bands import BandCell

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_GRID_ORIGINS = 16
"""Origins of the grid of looks, spread evenly over a cell: so many numbers of looks are mixed."""


class Speckle(NamedTuple):
    """How M images of one spot hang together.

    Attributes
    ----------
    coherence : (M, M) — Hermitian, unit diagonal; of the parts of the spectrum that both see.
    cells : the parts of the spectrum that two or more images see.
    looks : scalar — independent samples of what one image sees; need not be whole.
    """

    coherence: Complex
    cells: tuple[BandCell, ...]
    looks: float


def link_matrices(speckle: Speckle, *, samples: int, rng: np.random.Generator) -> Complex:
    """Draw images whose true phases are zero, as the matrices that carry their phases.

    The images y of one look are circular Gaussian, with covariance ΦΓΦᴴ, Φ = diag e^{iφ}. Up to a
    constant their log-likelihood is vᴴAv, with v = e^{iφ} and A_ij = −conj(Γ⁻¹)_ij Σ y_i conj(y_j)
    off the diagonal: the sum over looks is all that an estimator of phases needs. Phases that
    differ from zero turn A_ij by e^{i(φ_i − φ_j)}, so that noise can be drawn once and for all.

    Parameters
    ----------
    speckle : how the images hang together.
    samples : how many.
    rng : source of random numbers.

    Returns
    -------
    (samples, M, M) — Hermitian, with a diagonal of zeros.

    Notes
    -----
    Each cell of the spectrum holds a whole number of looks. The grid of looks begins at a different
    place in each of 16 groups of samples, so that their numbers are right on average.
    """
    count = len(speckle.coherence)
    data = np.zeros((samples, count, count), dtype=np.complex128)
    ends = np.cumsum([0.0, *(cell.share for cell in speckle.cells)]) * speckle.looks
    groups = np.array_split(np.arange(samples), _GRID_ORIGINS)
    for index, group in enumerate(groups):
        if group.size == 0:
            continue
        origin = (index + 0.5) / _GRID_ORIGINS
        # Cells much thinner than a look are ends that differ by rounding.
        looks = np.diff(np.ceil(np.round(ends, 9) - origin)).astype(int)
        rows = slice(group[0], group[-1] + 1)
        for cell, number in zip(speckle.cells, looks, strict=True):
            if number == 0:
                continue
            block = speckle.coherence[np.ix_(cell.images, cell.images)]
            weight = -np.conj(np.linalg.inv(block))
            scatter = _scatter(block, looks=int(number), samples=group.size, rng=rng)
            data[rows, cell.images[:, None], cell.images] += weight * scatter
    diagonal = np.arange(count)
    data[:, diagonal, diagonal] = 0.0
    return data


def _scatter(coherence: Complex, *, looks: int, samples: int, rng: np.random.Generator) -> Complex:
    """Σ y yᴴ over the looks of images with a given coherence, (samples, n, n)."""
    count = len(coherence)
    root = np.linalg.cholesky(coherence)
    if looks <= 4 * count + 8:
        images = circular(rng, (samples, count, looks))
    else:
        # Bartlett 1933: the same distribution from a triangle instead of all looks.
        images = np.tril(circular(rng, (samples, count, count)), -1)
        index = np.arange(count)
        images[:, index, index] = np.sqrt(
            rng.standard_gamma(looks - index.astype(np.float64), (samples, count))
        )
    images = root @ images
    return np.asarray(images @ np.conj(np.swapaxes(images, -1, -2)))


def circular(rng: np.random.Generator, shape: tuple[int, ...]) -> Complex:
    """Circular Gaussian numbers of unit power.

    Parameters
    ----------
    rng : source of random numbers.
    shape : how many.
    """
    parts = rng.standard_normal((*shape, 2))
    parts *= np.sqrt(0.5)
    return np.asarray(parts.view(np.complex128)[..., 0])
