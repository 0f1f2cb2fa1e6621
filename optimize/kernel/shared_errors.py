"""Errors that images share, and the variance of phases that are all alike."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, SharedBy, Weighting
from insar.height import common_height_errors
from insar.statistics import efficiency_curves

from ..problem import Problem
from .efficiency import exact

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


def shared_errors(problem: Problem) -> SharedErrors:
    """Collect the errors of position and synchronization.

    Parameters
    ----------
    problem : what is minimized.
    """
    radar, errors = problem.radar, problem.errors
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


def alike_variance(problem: Problem, amplitude: Array, shared: SharedErrors) -> Array:
    """Variance of each segment's phases where all images are alike, noise and shared errors.

    With a Laplacian of equal edges x, and shared errors that act on centered phases as p² times the
    identity, both are multiples of it: 1/(Mx) + p².

    Parameters
    ----------
    problem : what is minimized.
    amplitude : (S, M) — γ_i.
    shared : from `shared_errors`.

    Returns
    -------
    (S,) — [rad²]; 0 where images differ, or something but the azimuth error depends on the design.
    """
    radar, errors = problem.radar, problem.errors
    segments, count = amplitude.shape
    same = shared.own_variance >= 0.0
    same = same and np.ptp(amplitude) == 0.0 and np.ptp(shared.pair_variance) == 0.0
    same = same and errors.azimuth.shared_by is not SharedBy.PAIR
    if not same or errors.baseline_decorrelation is not BaselineDecorrelation.NONE:
        return np.zeros(segments)
    gamma = amplitude[:, 0] ** 2
    efficiency = np.ones(segments)
    if exact(errors):
        looks = np.full((segments, 1), radar.looks)
        efficiency = efficiency_curves(gamma[:, None])(looks)[:, 0]
    if errors.weighting is Weighting.JOINT:
        weight = gamma / (1.0 - gamma)
        edge = 2.0 * radar.looks * weight**2 / (1.0 + count * weight)
        return np.asarray(1.0 / (count * edge * efficiency) + shared.own_variance)
    variance = (1.0 - gamma**2) / (2.0 * radar.looks * gamma**2) / efficiency
    if errors.phase_std is not None:
        variance = np.full(segments, errors.phase_std**2)
    return np.asarray((variance + shared.pair_variance[0]) / count + shared.own_variance)


def height_shift(problem: Problem) -> Array:
    """Squares of the errors that move the height directly, (S,) [m²].

    Parameters
    ----------
    problem : what is minimized.
    """
    scene = problem.scene
    common = common_height_errors(scene, radar=problem.radar, errors=problem.errors)
    return np.asarray(sum((error**2 for error in common.values()), start=np.zeros(len(scene))))
