"""Integer bootstrapping along the ladder of baselines, one pair of images after the other."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfc

from ..errors import ErrorBudget
from ..phase_model import PhaseModel, phase_model
from ..radar import Radar
from ..scene import Scene
from .float_covariance import float_covariance

Array = NDArray[np.float64]


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
    covariance = float_covariance(model, prior_height_std)
    lead, count = covariance.shape[:-2], covariance.shape[-1]
    covariance = covariance.reshape(-1, count, count)
    case, index = np.arange(len(covariance)), np.arange(count)
    own = covariance[:, index, index]
    variance = own[:, :, None] + own[:, None, :] - 2.0 * covariance  # of the difference of two
    variance[:, index, index] = np.inf
    rounding = 1e-14 * own.max(axis=-1)
    image = np.broadcast_to(index, own.shape).copy()
    pairs = np.empty((len(case), count - 1, 2), dtype=np.intp)
    cycle_variance = np.empty((len(case), count - 1))
    for rung in range(count - 1):
        last = count - 1 - rung
        surest = np.argmin(variance.reshape(len(case), -1), axis=-1)
        first, second = np.divmod(surest, last + 1)
        smallest = variance[case, first, second]
        pairs[:, rung, 0], pairs[:, rung, 1] = image[case, first], image[case, second]
        cycle_variance[:, rung] = smallest
        if last == 1:
            break
        # Knowing the cycle of this pair conditions all others; one known already, up to rounding,
        # tells nothing new.
        to_first, to_second = variance[case, first], variance[case, second]
        to_first[case, first] = to_second[case, second] = 0.0
        known = np.where(smallest > rounding, smallest, np.inf)[:, None]
        gain = 0.5 * (to_first - to_second) / np.sqrt(known)
        variance -= (gain[:, :, None] - gain[:, None, :]) ** 2
        # From here on the two stand alike to all others: the first goes on for both, and the last
        # image takes the place of the second.
        variance[case, second] = variance[:, last]
        variance[case, :, second] = variance[:, :, last]
        variance[case, second, second] = np.inf
        image[case, second] = image[:, last]
        variance = variance[:, :last, :last]
    pairs = pairs.reshape(*lead, count - 1, 2)
    cycle_std = np.sqrt(np.maximum(cycle_variance, 0.0)).reshape(*lead, count - 1)
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
