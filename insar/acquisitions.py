"""Several acquisitions of one scene, combined into one measurement of its height."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .phase_model import PhaseModel

Array = NDArray[np.float64]


def combine_acquisitions(models: Sequence[PhaseModel]) -> PhaseModel:
    """Phase model of several acquisitions whose errors are independent of each other.

    Parameters
    ----------
    models : one for each acquisition, of M_a images of the same designs and segments.

    Returns
    -------
    PhaseModel — of 1 + Σ(M_a − 1) images: one reference for all acquisitions, then the other
    images of each in turn. Sources of one name become one source with independent parts.

    Raises
    ------
    ValueError
        If there is no model, the designs or segments differ, the scales of a source differ, or a
        model weighs pairs instead of images.

    Notes
    -----
    Only phase differences within an acquisition are observed, so the first image of each may be
    taken for the same node of phase zero: the information matrices, which have zero row sums, add
    up there and stand apart everywhere else. The result has the zero row sums again and one
    common reference, so that `height_error_of` and `unwrapping_ladder` take it as it is. A rung
    that joins images of two acquisitions is the difference of two interferograms, whose height of
    ambiguity is 1/|1/HoA_a − 1/HoA_b|: the long one by which two coverages with different
    baselines unwrap each other. The range error stays one and the same in `height_error_of`.
    """
    if not models:
        raise ValueError("models is empty; give the phase model of one acquisition at least")
    if any(model.pair_variance for model in models):
        raise ValueError(
            "acquisitions are combined by their images: the models need the weighting 'joint'"
        )
    lead = models[0].vertical_wavenumber.shape[:-1]
    if any(model.vertical_wavenumber.shape[:-1] != lead for model in models):
        shapes = [model.vertical_wavenumber.shape for model in models]
        raise ValueError(f"the models have shapes {shapes}; all but the last axis must agree")
    counts = [model.vertical_wavenumber.shape[-1] - 1 for model in models]
    starts = np.concatenate([[1], 1 + np.cumsum(counts)]).astype(int)
    count = int(starts[-1])

    wavenumber = np.zeros((*lead, count))
    information = np.zeros((*lead, count, count))
    parts: dict[str, list[Array]] = {}
    scale = dict(models[0].scale)
    for model, start, size in zip(models, starts[:-1], counts, strict=True):
        if any(scale.setdefault(name, value) is not value for name, value in model.scale.items()):
            raise ValueError("a source has another scale in another acquisition; give it one")
        own = slice(start, start + size)
        wavenumber[..., own] = model.vertical_wavenumber[..., 1:]
        wavenumber[..., own] -= model.vertical_wavenumber[..., :1]
        information[..., own, own] = model.information[..., 1:, 1:]
        information[..., 0, own] = model.information[..., 0, 1:]
        information[..., own, 0] = model.information[..., 1:, 0]
        information[..., 0, 0] += model.information[..., 0, 0]
        for name, factor in model.nuisance.items():
            embedded = np.zeros((*lead, count, factor.shape[-1]))
            embedded[..., own, :] = factor[..., 1:, :] - factor[..., :1, :]
            parts.setdefault(name, []).append(embedded)
    return PhaseModel(
        vertical_wavenumber=wavenumber,
        information=information,
        nuisance={name: np.concatenate(found, axis=-1) for name, found in parts.items()},
        pair_variance={},
        scale=scale,
    )
