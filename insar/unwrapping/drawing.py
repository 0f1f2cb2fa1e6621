"""Unwrapping tried out: errors drawn, phases wrapped, cycles found or not."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..phase_model import PhaseModel
from .decorrelation import Decorrelation
from .float_covariance import float_covariance

Array = NDArray[np.float64]


class UnwrappingTrial(NamedTuple):
    """Outcome of unwrapping drawn phases.

    Attributes
    ----------
    failure : (..., S) — share of the draws in which some cycle is wrong.
    sampling_error : (..., S) — standard deviation of that share, from the predicted failure.
    """

    failure: Array
    sampling_error: Array


def try_unwrapping(
    model: PhaseModel,
    decorrelation: Decorrelation,
    *,
    prior_height_std: float,
    samples: int,
    rng: np.random.Generator,
) -> UnwrappingTrial:
    """Unwrap drawn phases along the combinations, and count the failures.

    Each draw has a height (against the prior), errors that images share and noise; its phases are
    wrapped into a cycle, and the cycles are found again by sequential rounding.

    Parameters
    ----------
    model : the phase model of the designs.
    decorrelation : their combinations, from `decorrelated_unwrapping` with the same prior.
    prior_height_std : scalar — standard deviation of the prior height [m].
    samples : number of draws of each design and segment.
    rng : source of randomness.

    Returns
    -------
    UnwrappingTrial

    Raises
    ------
    ValueError
        If the number of samples is not positive.

    Notes
    -----
    Noise is drawn with the normal distribution that the prediction assumes; what the exact phase
    distribution of few looks does beyond it is not in here.
    """
    if samples < 1:
        raise ValueError(f"samples = {samples!r} must be positive")
    covariance = float_covariance(model, prior_height_std)
    lead, images = covariance.shape[:-2], covariance.shape[-1]
    covariance = covariance.reshape(-1, images, images)[:, 1:, 1:]
    combinations = decorrelation.combinations.reshape(-1, images - 1, images)[..., 1:]
    gain = decorrelation.gain.reshape(-1, images - 1, images - 1)
    wrong = np.zeros(len(covariance))
    root = np.linalg.cholesky(covariance)
    for case in range(len(covariance)):
        cycles = rng.standard_normal((samples, images - 1)) @ root[case].T
        wrong[case] = np.mean(_wrongly_unwrapped(cycles, combinations[case], gain[case]))
    predicted = decorrelation.failure
    spread = np.sqrt(predicted * (1.0 - predicted) / samples)
    return UnwrappingTrial(wrong.reshape(lead), spread)


def _wrongly_unwrapped(
    cycles: Array, combinations: NDArray[np.int64], gain: Array
) -> NDArray[np.bool_]:
    """Whether wrapped phases, given in cycles against the prior, get a wrong cycle."""
    whole = np.rint(cycles)
    wrapped = cycles - whole
    # The cycles that the phases lack are `whole`; their estimate from the prior is −wrapped.
    estimate, truth = -wrapped @ combinations.T, whole @ combinations.T
    wrong = np.zeros(len(cycles), dtype=np.bool_)
    innovations = np.empty_like(estimate)
    for rung in range(estimate.shape[-1]):
        expected = estimate[:, rung] - innovations[:, :rung] @ gain[rung, :rung]
        fixed = np.rint(expected)
        innovations[:, rung] = expected - fixed
        wrong |= fixed != truth[:, rung]
    return wrong
