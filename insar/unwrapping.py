"""Can the phase be unwrapped? Integer bootstrapping along the ladder of baselines."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfc

from .errors import ErrorBudget
from .phase_model import PhaseModel, phase_model
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]

_UNMEASURED_PHASE_STD = 1e6
"""Phase deviation given to an image that shares no band with another [rad]: as good as infinite
(its rung succeeds with probability 1e-6), yet an invertible matrix."""


class UnwrappingLadder(NamedTuple):
    """The order in which the images are joined by unwrapping one pair after the other.

    Attributes
    ----------
    probability : (..., S) — probability that every rung is unwrapped rightly.
    failure : (..., S) — 1 − probability, accurate where it is tiny.
    pairs : (..., S, M − 1, 2) — images joined at each rung.
    cycle_std : (..., S, M − 1) — deviation of each rung's phase, given the rungs below [cycles].
    """

    probability: Array
    failure: Array
    pairs: NDArray[np.intp]
    cycle_std: Array


def unwrapping_probability(
    positions: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    errors: ErrorBudget,
    prior_height_std: float,
) -> Array:
    """Probability that all integer ambiguities are found, given a prior height.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar and its images.
    errors : the error budget.
    prior_height_std : scalar — standard deviation of the prior height, an existing DEM [m].

    Returns
    -------
    (..., S) — between 0 and 1.

    Notes
    -----
    See `unwrapping_ladder`. A height error is meaningful only where this is close to 1: a wrong
    cycle is a wrong height, and the Cramér-Rao bound knows nothing of it.
    """
    model = phase_model(positions, scene, radar=radar, errors=errors)
    return unwrapping_ladder(model, prior_height_std=prior_height_std).probability


def unwrapping_ladder(model: PhaseModel, *, prior_height_std: float) -> UnwrappingLadder:
    """Success of integer bootstrapping, the surest pair first.

    Each rung fixes the cycle of the pair of images, not yet joined, whose phase is known best
    from the prior height and the rungs below. All errors count: noise and the shared ones.

    Parameters
    ----------
    model : the phase model of the designs.
    prior_height_std : scalar — standard deviation of the prior height [m].

    Returns
    -------
    UnwrappingLadder

    References
    ----------
    Teunissen 1998, doi:10.1007/s001900050199: P = Π(2Φ(1/(2σ_i)) − 1) over the conditional
    deviations σ_i [cycles]. The greedy order minimizes the worst rung.
    """
    float_covariance = _float_covariance(model, prior_height_std)
    lead, count = float_covariance.shape[:-2], float_covariance.shape[-1]
    group = np.broadcast_to(np.arange(count), (*lead, count)).copy()
    pairs = np.empty((*lead, count - 1, 2), dtype=np.intp)
    cycle_std = np.empty((*lead, count - 1))
    for rung in range(count - 1):
        diagonal = np.einsum("...ii->...i", float_covariance)
        variance = diagonal[..., :, None] + diagonal[..., None, :] - 2.0 * float_covariance
        joined = group[..., :, None] == group[..., None, :]
        variance = np.where(joined, np.inf, np.maximum(variance, 0.0)).reshape(*lead, -1)
        best = np.argmin(variance, axis=-1)
        first, second = np.divmod(best, count)
        smallest = np.take_along_axis(variance, best[..., None], axis=-1)
        pairs[..., rung, 0], pairs[..., rung, 1] = first, second
        cycle_std[..., rung] = np.sqrt(smallest[..., 0])
        # Knowing the cycle of this pair conditions all others; one known already, up to rounding,
        # tells nothing new.
        gain = _column(float_covariance, second) - _column(float_covariance, first)
        rounding = 1e-14 * np.max(diagonal, axis=-1, keepdims=True)
        known = np.where(smallest > rounding, smallest, np.inf)[..., None]
        float_covariance = float_covariance - gain[..., :, None] * gain[..., None, :] / known
        first_group = np.take_along_axis(group, first[..., None], axis=-1)
        second_group = np.take_along_axis(group, second[..., None], axis=-1)
        group = np.where(group == second_group, first_group, group)
    failure = bootstrap_failure(cycle_std)
    return UnwrappingLadder(1.0 - failure, failure, pairs, cycle_std)


def bootstrap_failure(cycle_std: ArrayLike) -> Array:
    """Probability that bootstrapping picks a wrong integer at any rung.

    Parameters
    ----------
    cycle_std : (..., rungs) — conditional standard deviations [cycles].

    Returns
    -------
    (...) — 1 − Π(2Φ(1/(2σ_i)) − 1), accurate down to 1e-300.
    """
    deviation = np.asarray(cycle_std, dtype=np.float64)
    with np.errstate(divide="ignore"):
        wrong = erfc(1.0 / (2.0 * np.sqrt(2.0) * deviation))
        return np.asarray(-np.expm1(np.sum(np.log1p(-wrong), axis=-1)))


def two_baseline_probability(
    *, short_std: ArrayLike, long_std: ArrayLike, covariance: ArrayLike, ratio: ArrayLike
) -> Array:
    """Probability that a long baseline is unwrapped by a short one that is already unwrapped.

    Parameters
    ----------
    short_std, long_std : (...) — phase deviations of the two pairs [rad].
    covariance : (...) — covariance of the two phases [rad²].
    ratio : (...) — long over short baseline ρ.

    Returns
    -------
    (...) — erf(π/(√2 σ_e)), σ_e² = σ_long² + ρ²σ_short² − 2ρ cov.

    Examples
    --------
    >>> two_baseline_probability(
    ...     short_std=0.3, long_std=0.3, covariance=0.0, ratio=[4.0, 6.0]
    ... ).round(4)
    array([0.9889, 0.9149])
    """
    rho = np.asarray(ratio, dtype=np.float64)
    variance = (
        np.asarray(long_std, dtype=np.float64) ** 2
        + (rho * np.asarray(short_std, dtype=np.float64)) ** 2
        - 2.0 * rho * np.asarray(covariance, dtype=np.float64)
    )
    return np.asarray(erf(np.pi / np.sqrt(2.0 * variance)))


def _float_covariance(model: PhaseModel, prior_height_std: float) -> Array:
    """Covariance (..., M, M) of the image phases relative to the first [cycles²]."""
    kz = model.vertical_wavenumber
    relative = np.zeros_like(model.information)
    index = np.arange(kz.shape[-1] - 1)
    noise = model.information[..., 1:, 1:].copy()
    noise[..., index, index] += _UNMEASURED_PHASE_STD**-2
    relative[..., 1:, 1:] = np.linalg.inv(noise)
    for factor in model.nuisance.values():
        relative += factor @ np.swapaxes(factor, -1, -2)
    relative += prior_height_std**2 * kz[..., :, None] * kz[..., None, :]
    return relative / (2.0 * np.pi) ** 2


def _column(matrix: Array, index: NDArray[np.intp]) -> Array:
    """Column of each matrix of a batch: (..., M)."""
    picked = np.take_along_axis(matrix, index[..., None, None], axis=-1)
    column: Array = picked[..., 0]
    return column
