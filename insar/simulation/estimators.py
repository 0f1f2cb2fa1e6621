"""Heights from wrapped phases: what a processor would make of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .linking import Complex, most_likely_height

Array = NDArray[np.float64]

_UNMEASURED_PHASE_STD = 1e6
"""Phase deviation given to an image that shares no band with another [rad], as in the ladder."""

_PRIOR_SPAN = 4.5
"""Heights are searched so many prior deviations up and down: 1 in 150 000 lies beyond."""

_STEPS_PER_CYCLE = 6
_MIN_STEPS, _MAX_STEPS = 24, 600


@dataclass(frozen=True, kw_only=True, eq=False)
class Processor:
    """What a processor knows before it sees the data, of all samples alike or of each of them.

    Attributes
    ----------
    vertical_wavenumber : (B, M) — kz, relative to the first image [rad/m]; B is 1, or the number of
        samples.
    information : (B, M, M) — of the image phases [1/rad²].
    factor : (B, M, R) — of the errors that images share, relative to the first image [rad].
    pairs : (B, M − 1, 2) — images joined at each rung of the unwrapping ladder.
    prior_height_std : scalar — of the height known beforehand, whose mean is zero [m].
    """

    vertical_wavenumber: Array
    information: Array
    factor: Array
    pairs: NDArray[np.intp]
    prior_height_std: float

    @cached_property
    def covariance(self) -> Array:
        """Of all phases but the first at a known height, (B, M − 1, M − 1) [rad²]."""
        noise = self.information[:, 1:, 1:].copy()
        index = np.arange(noise.shape[-1])
        noise[:, index, index] += _UNMEASURED_PHASE_STD**-2
        shared = self.factor[:, 1:]
        return np.asarray(np.linalg.inv(noise) + shared @ np.swapaxes(shared, -1, -2))

    @cached_property
    def weights(self) -> Array:
        """Of the phases in the estimated height, (B, M), summing to zero [m/rad]."""
        kz = self.vertical_wavenumber[:, 1:]
        weighted = np.linalg.solve(self.covariance, kz[..., None])[..., 0]
        information = np.sum(kz * weighted, axis=-1, keepdims=True)
        inner = weighted / np.maximum(information, np.finfo(np.float64).tiny)
        return np.concatenate([-inner.sum(axis=-1, keepdims=True), inner], axis=-1)

    def height(self, phase: Array) -> Array:
        """Weighted sum of unwrapped phases, (samples,) [m].

        Parameters
        ----------
        phase : (samples, M) — relative to the first image [rad].
        """
        total: Array = (phase * self.weights).sum(axis=-1)
        return total


class Unwrapped(NamedTuple):
    """Phases whose cycles were found one rung after the other.

    Attributes
    ----------
    phase : (samples, M) — relative to the first image [rad].
    right : (samples,) — whether every cycle is the true one.
    """

    phase: Array
    right: NDArray[np.bool_]


def bootstrapped(processor: Processor, wrapped: Array, *, truth: Array, noise: Array) -> Unwrapped:
    """Unwrap along the ladder: each pair is predicted by the prior height and the rungs below.

    Parameters
    ----------
    processor : what is known beforehand.
    wrapped : (samples, M) — phases, relative to the first image, modulo 2π [rad].
    truth : (samples, M) — phases without noise, to tell right cycles from wrong ones [rad].
    noise : (samples, M) — from `along_ladder` [rad].
    """
    kz, count = processor.vertical_wavenumber, wrapped.shape[-1]
    batch, sample = np.arange(len(kz)), np.arange(len(wrapped))
    covariance = processor.prior_height_std**2 * kz[:, :, None] * kz[:, None, :]
    covariance[:, 1:, 1:] += processor.covariance
    mean = np.zeros_like(wrapped)
    for rung in range(count - 1):
        first, second = processor.pairs[:, rung, 0], processor.pairs[:, rung, 1]
        step = wrapped - mean
        innovation = _wrap(step[sample, second] - step[sample, first])
        cross = covariance[batch, second] - covariance[batch, first]
        variance = cross[batch, second] - cross[batch, first]
        # A pair that is known already, up to rounding, tells nothing new.
        known = np.where(variance > 0.0, variance, np.inf)
        gain = cross / known[:, None]
        mean += innovation[:, None] * gain
        covariance -= gain[:, :, None] * cross[:, None, :]
    wrong = np.abs(mean - truth - noise).max(axis=-1) > np.pi
    return Unwrapped(mean, ~wrong)


def along_ladder(noise: Array, *, pairs: NDArray[np.intp]) -> Array:
    """Phase noise as it adds up along a ladder, each rung's own between −π and π.

    Parameters
    ----------
    noise : (samples, M) — modulo 2π [rad].
    pairs : (B, M − 1, 2) — images joined at each rung.

    Returns
    -------
    (samples, M) — relative to the first image [rad].
    """
    batch, count = np.arange(len(pairs))[:, None], noise.shape[-1]
    rung = np.arange(count - 1)
    rungs = np.zeros((len(pairs), count - 1, count))
    rungs[batch, rung, pairs[..., 1]] = 1.0
    rungs[batch, rung, pairs[..., 0]] = -1.0
    measured = _wrap(np.sum(rungs * noise[:, None, :], axis=-1))
    relative = np.linalg.solve(rungs[..., 1:], measured[..., None])[..., 0]
    return np.concatenate([np.zeros((len(noise), 1)), relative], axis=-1)


class Estimates(NamedTuple):
    """Heights estimated with all that is known.

    Attributes
    ----------
    most_likely : (samples,) — of maximum likelihood with the prior, together with the errors that
        images share [m].
    mean : (samples,) — the mean of what the data leave possible, which has the smallest error of
        all [m].
    """

    most_likely: Array
    mean: Array


def likely_heights(
    processor: Processor, wrapped: Array, *, data: Complex, true_phase: Array
) -> Estimates:
    """Estimate heights over all cycles that the prior leaves possible.

    A grid of heights finds every combination of cycles that matters, at each height the nearest
    one, image after image. With Gaussian phases each has a best height and a probability in closed
    form; the best of all is then refined with the likelihood of the speckle itself.

    Parameters
    ----------
    processor : what is known beforehand.
    wrapped : (samples, M) — phases, relative to the first image, modulo 2π [rad].
    data : (samples, M, M) — A of images whose true phases are zero.
    true_phase : (samples, M) — what turns them into those observed [rad].

    Notes
    -----
    With x = (height in prior deviations, shared errors in theirs) and G = [σ₀ kz, F], the
    refinement maximizes vᴴAv − |x|²/2, v = e^{iGx}: the joint maximum, which for Gaussian phases is
    that of the height alone. The mean is over the Gaussian mixture of all cycles.
    """
    sigma, kz = processor.prior_height_std, processor.vertical_wavenumber
    order = 1 + np.argsort(
        np.diagonal(processor.covariance, axis1=-2, axis2=-1).mean(axis=0), kind="stable"
    )
    root = np.linalg.cholesky(processor.covariance[:, (order - 1)[:, None], order - 1])
    inverse = np.linalg.inv(root)
    sensitivity = (inverse @ kz[:, order, None])[..., 0]
    information = np.sum(sensitivity**2, axis=-1, keepdims=True) + sigma**-2
    grid = _grid(sigma, float(np.ptp(kz, axis=-1).max()))

    whitened = np.empty((len(order), len(wrapped), len(grid)))
    misfit, projection = 0.0, -grid / sigma**2
    for row, image in enumerate(order):
        carried = np.zeros((len(wrapped), len(grid)))
        for below in range(row):
            carried += root[:, row, below, None] * whitened[below]
        left = wrapped[:, image, None] - kz[:, image, None] * grid - carried
        whitened[row] = _wrap(left) / root[:, row, row, None]
        misfit = misfit + whitened[row] ** 2
        projection = projection + sensitivity[:, row, None] * whitened[row]
    height = grid + projection / information
    cost = misfit + (grid / sigma) ** 2 - projection**2 / information

    case = np.arange(len(wrapped))
    best = np.argmin(cost, axis=-1)
    mean = _mixture_mean(height, cost - cost[case, best][:, None])

    # Shared errors that go with the best height: FᵀC⁻¹ of what it leaves unexplained.
    left = whitened[:, case, best].T
    left = left - sensitivity * (height[case, best] - grid[best])[:, None]
    shared = np.swapaxes(inverse @ processor.factor[:, order], -1, -2) @ left[..., None]
    start = np.concatenate([height[case, best][:, None] / sigma, shared[..., 0]], axis=-1)
    factor = np.concatenate([sigma * kz[..., None], processor.factor], axis=-1)
    refined = sigma * most_likely_height(data, true_phase, start=start, factor=factor)
    return Estimates(refined, mean)


def _grid(prior_height_std: float, fastest: float) -> Array:
    """Heights over the prior, six to a cycle of the fastest pair [m]."""
    reach = _PRIOR_SPAN * prior_height_std
    cycles = 2.0 * reach * fastest / (2.0 * np.pi)
    steps = int(np.clip(_STEPS_PER_CYCLE * cycles, _MIN_STEPS, _MAX_STEPS))
    return np.linspace(-reach, reach, steps + 1)


def _mixture_mean(height: Array, excess: Array) -> Array:
    """Mean over distinct sets of cycles; neighbors on the grid that share theirs count once."""
    weight = np.exp(-0.5 * excess)
    change = np.abs(np.diff(height, axis=-1)) + np.abs(np.diff(excess, axis=-1))
    weight[:, 1:] *= change > 1e-7 * (1.0 + np.abs(height[:, 1:]) + np.abs(excess[:, 1:]))
    return np.asarray((weight * height).sum(axis=-1) / weight.sum(axis=-1))


def _wrap(phase: Array) -> Array:
    return np.asarray(phase - 2.0 * np.pi * np.round(phase / (2.0 * np.pi)))
