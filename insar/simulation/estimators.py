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
_MAX_STEPS = 600


@dataclass(frozen=True, kw_only=True, eq=False)
class Processor:
    """What a processor knows of one segment before it sees the data.

    Attributes
    ----------
    vertical_wavenumber : (M,) — kz, relative to the first image [rad/m].
    information : (M, M) — of the image phases [1/rad²].
    factor : (M, R) — of the errors that images share, relative to the first image [rad].
    prior_height_std : scalar — of the height known beforehand [m].
    """

    vertical_wavenumber: Array
    information: Array
    factor: Array
    prior_height_std: float

    @cached_property
    def covariance(self) -> Array:
        """Of the phases of all images but the first, at a known height, (M − 1, M − 1) [rad²]."""
        noise = self.information[1:, 1:].copy()
        noise[np.diag_indices_from(noise)] += _UNMEASURED_PHASE_STD**-2
        return np.asarray(np.linalg.inv(noise) + self.factor[1:] @ self.factor[1:].T)

    @cached_property
    def weights(self) -> Array:
        """Of the phases in the estimated height, (M,), summing to zero [m/rad]."""
        kz = self.vertical_wavenumber[1:]
        weighted = np.linalg.solve(self.covariance, kz)
        inner = weighted / max(float(kz @ weighted), np.finfo(np.float64).tiny)
        return np.concatenate([[-inner.sum()], inner])


class Unwrapped(NamedTuple):
    """Phases whose cycles were found one rung after the other.

    Attributes
    ----------
    phase : (samples, M) — relative to the first image [rad].
    right : (samples,) — whether every cycle is the true one.
    """

    phase: Array
    right: NDArray[np.bool_]


def bootstrapped(
    processor: Processor, wrapped: Array, *, pairs: NDArray[np.intp], truth: Array, noise: Array
) -> Unwrapped:
    """Unwrap along a ladder of pairs: each is predicted by the prior height and the rungs below.

    Parameters
    ----------
    processor : what is known beforehand.
    wrapped : (samples, M) — phases, relative to the first image, modulo 2π [rad].
    pairs : (M − 1, 2) — images joined at each rung.
    truth : (samples, M) — phases without noise, to tell right cycles from wrong ones [rad].
    noise : (samples, M) — from `along_ladder` [rad].
    """
    count = wrapped.shape[-1]
    kz = processor.vertical_wavenumber
    covariance = np.zeros((count, count))
    covariance[1:, 1:] = processor.covariance
    covariance += processor.prior_height_std**2 * np.outer(kz, kz)
    mean = np.zeros_like(wrapped)
    for first, second in pairs:
        measured = wrapped[:, second] - wrapped[:, first]
        expected = mean[:, second] - mean[:, first]
        innovation = _wrap(measured - expected)
        cross = covariance[:, second] - covariance[:, first]
        variance = float(cross[second] - cross[first])
        if variance <= 0.0:
            continue
        gain = cross / variance
        mean += innovation[:, None] * gain
        covariance -= np.outer(gain, cross)
    wrong = np.abs(mean - truth - noise).max(axis=-1) > np.pi
    return Unwrapped(mean, ~wrong)


def along_ladder(noise: Array, *, pairs: NDArray[np.intp]) -> Array:
    """Phase noise as it adds up along a ladder, each rung's own between −π and π.

    Parameters
    ----------
    noise : (samples, M) — modulo 2π [rad].
    pairs : (M − 1, 2) — images joined at each rung.

    Returns
    -------
    (samples, M) — relative to the first image [rad].
    """
    rungs = np.zeros((len(pairs), noise.shape[-1]))
    index = np.arange(len(pairs))
    rungs[index, pairs[:, 1]] = 1.0
    rungs[index, pairs[:, 0]] = -1.0
    relative = np.linalg.solve(rungs[:, 1:], _wrap(noise @ rungs.T).T).T
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
    processor : what is known beforehand; its prior has mean zero.
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
    order = 1 + np.argsort(np.diag(processor.covariance), kind="stable")
    root = np.linalg.cholesky(processor.covariance[np.ix_(order - 1, order - 1)])
    inverse = np.linalg.inv(root)
    sensitivity = inverse @ kz[order]
    information = float(sensitivity @ sensitivity) + sigma**-2
    fastest = float(np.ptp(kz))
    steps = int(np.clip(2 * _PRIOR_SPAN * sigma * fastest * _STEPS_PER_CYCLE / 7.0, 24, _MAX_STEPS))
    grid = np.linspace(-_PRIOR_SPAN * sigma, _PRIOR_SPAN * sigma, steps + 1)

    whitened = np.empty((len(order), len(wrapped), len(grid)))
    misfit, projection = 0.0, -grid / sigma**2
    for row, image in enumerate(order):
        residual = wrapped[:, image, None] - kz[image] * grid
        carried = np.einsum("r,rsg->sg", root[row, :row], whitened[:row])
        unwrapped = carried + _wrap(residual - carried)
        whitened[row] = (unwrapped - carried) / root[row, row]
        misfit = misfit + whitened[row] ** 2
        projection = projection + sensitivity[row] * whitened[row]
    height = grid + projection / information
    cost = misfit + (grid / sigma) ** 2 - projection**2 / information

    case = np.arange(len(wrapped))
    best = np.argmin(cost, axis=-1)
    mean = _mixture_mean(height, cost - cost[case, best][:, None])

    # Shared errors that go with the best height: F'C⁻¹ of what it leaves unexplained.
    left = (kz[order] * (grid[best] - height[case, best])[:, None]) @ inverse.T
    left += whitened[:, case, best].T
    start = np.concatenate(
        [height[case, best][:, None] / sigma, left @ inverse @ processor.factor[order]], axis=-1
    )
    factor = np.concatenate([sigma * kz[:, None], processor.factor], axis=-1)
    refined = sigma * most_likely_height(data, true_phase, start=start, factor=factor)
    return Estimates(refined, mean)


def _mixture_mean(height: Array, excess: Array) -> Array:
    """Mean over distinct sets of cycles; neighbors on the grid that share theirs count once."""
    weight = np.exp(-0.5 * excess)
    change = np.abs(np.diff(height, axis=-1)) + np.abs(np.diff(excess, axis=-1))
    weight[:, 1:] *= change > 1e-7 * (1.0 + np.abs(height[:, 1:]) + np.abs(excess[:, 1:]))
    return np.asarray((weight * height).sum(axis=-1) / weight.sum(axis=-1))


def _wrap(phase: Array) -> Array:
    return np.asarray(phase - 2.0 * np.pi * np.round(phase / (2.0 * np.pi)))
