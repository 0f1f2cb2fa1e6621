"""Decorrelation of the ambiguities: integer combinations that are known better than pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammainc, gammaln

from ..phase_model import PhaseModel
from .float_covariance import float_covariance
from .ladder import UnwrappingLadder, bootstrap_failure, unwrapping_ladder

Array = NDArray[np.float64]

_MAX_SWEEPS = 500
"""Sweeps after which the reduction stops as it is: each swap has made it better already."""

_GAIN = 1e-9
"""Part by which a swap must lower a conditional variance: less is rounding."""


class Decorrelation(NamedTuple):
    """Integer bootstrapping of combinations of images.

    Attributes
    ----------
    probability : (..., S) — that every combination is unwrapped rightly.
    failure : (..., S) — 1 − probability, accurate where it is tiny.
    ceiling : (..., S) — upper bound of what any integer estimator reaches.
    combinations : (..., S, M − 1, M) — integer weights of the images' phases; rows sum to zero,
        and without the first column the matrix has determinant ±1.
    cycle_std : (..., S, M − 1) — deviation of each, given those before [cycles].
    gain : (..., S, M − 1, M − 1) — unit lower triangle L of the combinations' covariance L D Lᵀ:
        what the error of one tells of those after it.
    """

    probability: Array
    failure: Array
    ceiling: Array
    combinations: NDArray[np.int64]
    cycle_std: Array
    gain: Array


def decorrelated_unwrapping(
    model: PhaseModel, *, prior_height_std: float, ladder: UnwrappingLadder | None = None
) -> Decorrelation:
    """Success of integer bootstrapping after decorrelation of the ambiguities (LAMBDA).

    Parameters
    ----------
    model : the phase model of the designs.
    prior_height_std : scalar — standard deviation of the prior height [m].
    ladder : what `unwrapping_ladder` gives for both, if it is known already.

    Returns
    -------
    Decorrelation

    Notes
    -----
    Begins with the rungs of the ladder, which are integer combinations too. Integer multiples of
    the combinations before are subtracted (|l| ≤ ½) and neighbors are swapped where the second,
    given those before both, is known better than the first. A swap leaves the product of the two
    conditional variances and brings them closer to each other; ln(2Φ(1/(2σ)) − 1) is concave in
    ln σ, so each swap raises the probability, which is never below the ladder's. It is a lower
    bound of integer least squares, and the `ceiling` an upper one.

    References
    ----------
    Teunissen 1995, doi:10.1007/BF00863419 (decorrelation); Hassibi and Boyd 1998,
    doi:10.1109/78.726808, and Teunissen 2000, doi:10.1007/s001900000119 (the ceiling).
    """
    if ladder is None:
        ladder = unwrapping_ladder(model, prior_height_std=prior_height_std)
    covariance = float_covariance(model, prior_height_std)
    lead, images = covariance.shape[:-2], covariance.shape[-1]
    rungs = ladder.pairs.reshape(-1, images - 1, 2)
    start = np.zeros((len(rungs), images - 1, images), dtype=np.int64)
    case, row = np.ogrid[: len(rungs), : images - 1]
    start[case, row, rungs[..., 0]] -= 1
    start[case, row, rungs[..., 1]] += 1
    combinations, gain, variance = decorrelate(covariance.reshape(-1, images, images), start)
    deviation = np.sqrt(variance)
    failure = bootstrap_failure(deviation)
    return Decorrelation(
        probability=(1.0 - failure).reshape(lead),
        failure=failure.reshape(lead),
        ceiling=success_ceiling(deviation).reshape(lead),
        combinations=combinations.reshape(*lead, images - 1, images),
        cycle_std=deviation.reshape(*lead, images - 1),
        gain=gain.reshape(*lead, images - 1, images - 1),
    )


def decorrelate(
    covariance: Array, start: NDArray[np.int64]
) -> tuple[NDArray[np.int64], Array, Array]:
    """Reduce integer combinations of correlated ambiguities.

    Parameters
    ----------
    covariance : (B, M, M) — of the ambiguities [cycles²].
    start : (B, n, M) — integer combinations to begin with.

    Returns
    -------
    combinations : (B, n, M) — reduced; a unimodular transformation of those at the start.
    gain : (B, n, n) — unit lower triangle L of their covariance L D Lᵀ.
    variance : (B, n) — D, the conditional variances [cycles²].
    """
    combinations = start.copy()
    correlated = combinations @ covariance @ np.swapaxes(combinations, -1, -2)
    gain, variance = _factors(correlated)
    count = variance.shape[-1]
    for _ in range(_MAX_SWEEPS):
        swapped = False
        for upper in range(count - 1):
            _subtract_multiples(combinations, gain, row=upper + 1, other=upper)
            part = gain[:, upper + 1, upper]
            alone = variance[:, upper + 1] + part**2 * variance[:, upper]
            better = np.flatnonzero(alone < (1.0 - _GAIN) * variance[:, upper])
            if better.size:
                swapped = True
                _swap(combinations, gain, variance, better, upper)
        if not swapped:
            break
    for row in range(1, count):
        for other in range(row - 1, -1, -1):
            _subtract_multiples(combinations, gain, row=row, other=other)
    return combinations, gain, variance


def success_ceiling(cycle_std: Array) -> Array:
    """Upper bound of the success of any integer estimator.

    Parameters
    ----------
    cycle_std : (..., n) — conditional standard deviations; only their product counts [cycles].

    Returns
    -------
    (...) — P(χ²_n ≤ c_n/ADOP²), ADOP = (Πσ_i)^{1/n} and c_n = Γ(n/2 + 1)^{2/n}/π: no region
    with the volume of a cell of the integers holds more than the ellipsoid of that volume.

    References
    ----------
    Hassibi and Boyd 1998, doi:10.1109/78.726808; Teunissen 2000, doi:10.1007/s001900000119.
    """
    count = cycle_std.shape[-1]
    with np.errstate(divide="ignore"):
        log_adop = np.mean(np.log(cycle_std), axis=-1)
    # Squared radius of the n-ball of unit volume: (Γ(n/2 + 1))^{2/n}/π.
    log_radius2 = 2.0 / count * gammaln(0.5 * count + 1.0) - np.log(np.pi)
    return np.asarray(gammainc(0.5 * count, 0.5 * np.exp(log_radius2 - 2.0 * log_adop)))


def _factors(covariance: Array) -> tuple[Array, Array]:
    """Unit lower triangle and diagonal of L D Lᵀ, also where rounding spoils the definiteness."""
    count = covariance.shape[-1]
    rest = covariance.copy()
    index = np.arange(count)
    smallest = 1e-15 * np.max(covariance[:, index, index], axis=-1)
    gain = np.zeros_like(covariance)
    variance = np.empty(covariance.shape[:-1])
    for i in range(count):
        variance[:, i] = np.maximum(rest[:, i, i], smallest)
        column = rest[:, :, i] / variance[:, i, None]
        column[:, : i + 1] = index[: i + 1] == i
        gain[:, :, i] = column
        rest = rest - variance[:, i, None, None] * column[:, :, None] * column[:, None, :]
    return gain, variance


def _subtract_multiples(
    combinations: NDArray[np.int64], gain: Array, *, row: int, other: int
) -> None:
    multiple = np.rint(gain[:, row, other])
    gain[:, row, : other + 1] -= multiple[:, None] * gain[:, other, : other + 1]
    combinations[:, row] -= multiple.astype(np.int64)[:, None] * combinations[:, other]


def _swap(
    combinations: NDArray[np.int64], gain: Array, variance: Array, cases: NDArray[np.intp], i: int
) -> None:
    """Swap combinations i and i + 1 of some cases, and update their factors."""
    both = np.array([i, i + 1])
    combinations[cases[:, None], both] = combinations[cases[:, None], both[::-1]]
    gain[cases[:, None], both, :i] = gain[cases[:, None], both[::-1], :i]
    part = gain[cases, i + 1, i]
    first, second = variance[cases, i], variance[cases, i + 1]
    alone = second + part**2 * first
    back = part * first / alone
    variance[cases, i], variance[cases, i + 1] = alone, first * second / alone
    gain[cases, i + 1, i] = back
    below = gain[cases, i + 2 :, i].copy()
    beside = gain[cases, i + 2 :, i + 1].copy()
    gain[cases, i + 2 :, i] = back[:, None] * below + (second / alone)[:, None] * beside
    gain[cases, i + 2 :, i + 1] = below - part[:, None] * beside
