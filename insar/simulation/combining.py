"""Several acquisitions of one segment, simulated together as one estimate of its height."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from .nature import Nature
from .speckle import Speckle, link_matrices

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def combined_nature(natures: Sequence[Nature]) -> Nature:
    """One nature of several acquisitions: images and errors apart, one height, one reference.

    Parameters
    ----------
    natures : of each acquisition of the segment.

    Returns
    -------
    Nature — of the images of `insar.combine_acquisitions`: the common reference, whose phase is
    zero in every acquisition, and the other images of each in turn. Errors that move the height and
    no phase are common to all, as they are there.
    """
    first, *others = natures
    count = 1 + sum(len(nature.vertical_wavenumber) - 1 for nature in natures)
    information = np.zeros((count, count))
    for nature, own in zip(natures, _own(natures), strict=True):
        index = np.concatenate([[0], own])
        information[np.ix_(index, index)] += nature.information
    return Nature(
        vertical_wavenumber=np.concatenate(
            [[0.0], *(nature.vertical_wavenumber[1:] for nature in natures)]
        ),
        speckle=first.speckle,
        scene_factor=_apart([nature.scene_factor for nature in natures]),
        pixel_factor=_apart([nature.pixel_factor for nature in natures]),
        scene_height_std=first.scene_height_std,
        pixel_height_std=first.pixel_height_std,
        information=information,
        further=tuple(nature.speckle for nature in others),
    )


def linked_data(nature: Nature, *, samples: int, rng: np.random.Generator) -> Complex:
    """Matrices A of all acquisitions of a nature, in one: their log-likelihoods vᴴAv add.

    Parameters
    ----------
    nature : of one acquisition, or combined.
    samples : how many.
    rng : source of random numbers.

    Returns
    -------
    (samples, M, M) — as `link_matrices` gives them for one acquisition.
    """
    if not nature.further:
        return link_matrices(nature.speckle, samples=samples, rng=rng)
    count = len(nature.vertical_wavenumber)
    data = np.zeros((samples, count, count), dtype=np.complex128)
    start = 1
    for speckle in (nature.speckle, *nature.further):
        others = _images(speckle) - 1
        index = np.concatenate([[0], np.arange(start, start + others)])
        data[:, index[:, None], index] += link_matrices(speckle, samples=samples, rng=rng)
        start += others
    return data


def _images(speckle: Speckle) -> int:
    return len(speckle.coherence)


def _own(natures: Sequence[Nature]) -> list[NDArray[np.intp]]:
    """Images of each acquisition but its reference, numbered through."""
    counts = [len(nature.vertical_wavenumber) - 1 for nature in natures]
    starts = np.concatenate([[1], 1 + np.cumsum(counts)])
    return [np.arange(start, start + size) for start, size in zip(starts, counts, strict=False)]


def _apart(factors: Sequence[Array]) -> Array:
    """Factors of errors of their own, one below and beside the other, the reference on top."""
    blocks: Array = block_diag(*(factor[1:] - factor[:1] for factor in factors))
    return np.concatenate([np.zeros((1, blocks.shape[1])), blocks])
