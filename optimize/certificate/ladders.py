"""How surely the cycles can be found at best: bounds over boxes of projected baselines.

Bootstrapping fixes integer combinations z₁, z₂, … of the ambiguities, each conditioned on those
before. Its conditional variances are Schur complements of the float covariance
Q = (X⁻¹ + C + σ₀²kz kzᵀ)/(2π)², which only grow with Q in the Loewner order: with more information
than any formation of a box has, and with kz taken at its least and largest, they are bounded below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfc

Array = NDArray[np.float64]

_UNMEASURED = 1e-4
"""Information that every image is given, lest X be singular [1/rad²]: more than the unwrapping of
`insar` gives, so that the bound holds, and worth a deviation of 100 rad, which finds no cycle."""

_LARGEST_LADDER = 4
"""Differences of images up to which every ladder of pairs is tried: 180 of them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CycleBound:
    """Bounds the failure of bootstrapping over boxes.

    Parameters
    ----------
    shared : (M − 1, M − 1) — covariance of the shared errors relative to the first image [rad²].
    phase_centers : (M − 1, N − 1) — phase centers relative to the first image, per gap.
    prior_height_std : scalar — of the height known beforehand [m].
    """

    shared: Array
    phase_centers: Array
    prior_height_std: float

    def failure(self, information: Array, lower: Array, upper: Array) -> Array:
        """Smallest failure that any order of pairs could have in each box.

        Parameters
        ----------
        information : (n, M − 1, M − 1) — no less than that of any formation of the box [1/rad²].
        lower, upper : (n, N − 1) — the boxes of gaps, in vertical wavenumbers [rad/m].

        Returns
        -------
        (n,) — a probability.
        """
        try:
            return self._failure(information, lower, upper)
        except np.linalg.LinAlgError:  # rounding left a covariance that is none: nothing is said
            return np.zeros(len(information))

    def _failure(self, information: Array, lower: Array, upper: Array) -> Array:
        index = np.arange(information.shape[-1])
        noise = information.copy()
        noise[:, index, index] += _UNMEASURED
        covariance = np.linalg.inv(noise) + self.shared
        middle, half = 0.5 * (lower + upper), 0.5 * (upper - lower)
        prior = self.prior_height_std**-2
        best = np.full(len(information), np.inf)
        if len(self.shared) > _LARGEST_LADDER:
            return self._any_failure(covariance, lower, upper)
        for combination in pair_orders(len(self.shared) + 1):
            turned = combination @ covariance @ combination.T
            root = np.linalg.cholesky(turned)
            form = np.linalg.solve(root, (combination @ self.phase_centers)[None])
            center = np.abs(np.einsum("nkg,ng->nk", form, middle))
            radius = np.einsum("nkg,ng->nk", np.abs(form), half)
            least = np.maximum(center - radius, 0.0) ** 2
            known = prior + np.cumsum((center + radius) ** 2, axis=-1)
            known = np.concatenate([np.full((len(known), 1), prior), known[:, :-1]], axis=-1)
            variance = root[:, index, index] ** 2 * (1.0 + least / known)
            best = np.minimum(best, _failure_exponent(variance))
        return np.asarray(-np.expm1(-best))

    def _any_failure(self, covariance: Array, lower: Array, upper: Array) -> Array:
        """Smallest failure of any integer transformation, from the determinant of Q alone.

        Whatever is fixed first, the conditional variances multiply to det Q, and the product of
        the probabilities is largest where they are equal (Teunissen 2003: ADOP).
        """
        root = np.linalg.cholesky(covariance)
        form = np.linalg.solve(root, self.phase_centers[None])
        middle, half = 0.5 * (lower + upper), 0.5 * (upper - lower)
        center = np.abs(np.einsum("nkg,ng->nk", form, middle))
        radius = np.einsum("nkg,ng->nk", np.abs(form), half)
        least = np.sum(np.maximum(center - radius, 0.0) ** 2, axis=-1)
        index = np.arange(covariance.shape[-1])
        logarithm = 2.0 * np.log(root[:, index, index]).sum(axis=-1)
        logarithm += np.log1p(self.prior_height_std**2 * least)
        variance = np.exp(logarithm / len(index))
        exponent = _failure_exponent(np.repeat(variance[:, None], len(index), axis=-1))
        return np.asarray(-np.expm1(-exponent))


def _failure_exponent(variance: Array) -> Array:
    """−log of the product of the rungs' probabilities, from their variances [rad²]."""
    wrong = erfc(math.pi / np.sqrt(2.0 * variance))
    return np.asarray(-np.log1p(-np.minimum(wrong, 1.0 - 1e-16)).sum(axis=-1))


@lru_cache(maxsize=16)
def pair_orders(images: int) -> Array:
    """Every ladder of pairs, as integer combinations of the phases relative to the first image.

    Parameters
    ----------
    images : number M of images.

    Returns
    -------
    (orders, M − 1, M − 1) — a pair that joins two groups of images stands for all pairs between
    them: once the cycles within each group are known they are one and the same.
    """
    unit = np.concatenate([np.zeros((1, images - 1)), np.eye(images - 1)])
    orders: list[Array] = []

    def extend(groups: tuple[tuple[int, ...], ...], rows: list[Array]) -> None:
        if len(groups) == 1:
            orders.append(np.array(rows))
            return
        for one, two in combinations(range(len(groups)), 2):
            rest = tuple(g for i, g in enumerate(groups) if i not in (one, two))
            joined = groups[one] + groups[two]
            row = unit[groups[two][0]] - unit[groups[one][0]]
            extend((*rest, joined), [*rows, row])

    extend(tuple((image,) for image in range(images)), [])
    return np.array(orders)
