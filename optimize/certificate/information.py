"""The most that the phases of a box of formations can tell.

An information matrix of filtered images, or of independent pairs, is a graph Laplacian with weights
that are not negative: it grows, in the Loewner order, with each weight. So it is bounded by
bounding each weight over the box.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, ErrorBudget, PhaseStatistics, Radar, Weighting
from insar.phase_information import pair_phase_variance
from insar.phase_noise import pair_efficiency

from .shared import pair_variance

Array = NDArray[np.float64]

_TABLE = 5e-5
"""Part by which a tabulated efficiency may be off, with room to spare."""


@dataclass(frozen=True, kw_only=True, eq=False)
class InformationBound:
    """Bounds the information of the phases over boxes of gaps.

    Parameters
    ----------
    radar, errors : what the phases tell.
    amplitude : scalar — the largest γ_i of an image.
    alike : whether all images have that amplitude.
    offsets : (M, N − 1) — band offsets of the images relative to the first, per gap [bandwidths].

    Notes
    -----
    Images with less than the largest amplitude have more noise, azimuth bands that differ leave
    fewer images to each part of the spectrum: both take data away, and so information.
    """

    radar: Radar
    errors: ErrorBudget
    amplitude: float
    alike: bool
    offsets: Array

    def upper(self, lower: Array, upper: Array) -> Array:
        """Information that no formation of a box exceeds.

        Parameters
        ----------
        lower, upper : (n, N − 1) — the boxes of gaps.

        Returns
        -------
        (n, M − 1, M − 1) — relative to the first image [1/rad²].
        """
        least, most = self._shifts(lower, upper)
        decorrelation = self.errors.baseline_decorrelation
        if self.errors.weighting is Weighting.PAIRS:
            return self._laplacian(self._pair_weights(least))
        shifted = self.radar.azimuth_resolution is not None and not self.radar.pursuit
        unfiltered = decorrelation is BaselineDecorrelation.UNFILTERED
        if not self.errors.coherence.spectral or (unfiltered and shifted):
            return self._of_signal(len(least))
        if unfiltered:
            return self._unfiltered(least, most)
        if decorrelation is BaselineDecorrelation.NONE:
            least, most = np.zeros_like(least), np.zeros_like(most)
        weights = self._filtered_weights(least, most)
        # Azimuth bands that differ may leave a pair any number of looks, and raise its weight
        # where a third image is missing: there only the Cramér-Rao bound is sure.
        free = shifted and decorrelation is not BaselineDecorrelation.NONE
        return self._laplacian(weights if free else weights * self._efficiency(least, most))

    def _efficiency(self, least: Array, most: Array) -> Array:
        """Largest part of the Cramér-Rao information that each pair can have, (n, K).

        With the looks it first falls and then rises, so it is largest at an end of a box; where
        amplitudes differ it counts as 1.
        """
        exact = self.errors.phase_statistics is PhaseStatistics.EXACT
        if not exact or not self.alike:
            return np.ones_like(least)
        ends = [
            pair_efficiency(self._pair_coherence, self.radar.looks * np.maximum(0.0, 1.0 - shift))
            for shift in (least, most)
        ]
        return np.asarray(np.minimum(1.0, np.maximum(*ends) * (1.0 + _TABLE)))

    def _shifts(self, lower: Array, upper: Array) -> tuple[Array, Array]:
        """Least and largest |o_j − o_i| of each pair over the boxes, (n, K) each."""
        positive = np.maximum(self._pair_offsets, 0.0).T
        negative = np.minimum(self._pair_offsets, 0.0).T
        low = lower @ positive + upper @ negative
        high = upper @ positive + lower @ negative
        least = np.maximum(0.0, np.maximum(low, -high))
        return least, np.maximum(np.abs(low), np.abs(high))

    def _pair_weights(self, least: Array) -> Array:
        """Of independent pairs: each falls with the shift of its bands."""
        band = np.maximum(0.0, 1.0 - least)
        decorrelation, looks = self.errors.baseline_decorrelation, self.radar.looks
        if decorrelation is BaselineDecorrelation.NONE:
            band = np.ones_like(band)
        if self.errors.phase_std is not None:
            variance = np.where(band > 0.0, self.errors.phase_std**2, np.inf)
        elif decorrelation is BaselineDecorrelation.UNFILTERED:
            variance = self._pair_noise(self._pair_coherence * band, np.full_like(band, looks))
        else:
            variance = self._pair_noise(self._pair_coherence, looks * band)
        return np.asarray(1.0 / (variance + pair_variance(self.radar, self.errors)))

    def _pair_noise(self, coherence: Array, looks: Array) -> Array:
        """Variance of pairs, which falls with coherence and looks, exactly too."""
        variance = pair_phase_variance(coherence, looks=looks)
        if self.errors.phase_statistics is not PhaseStatistics.EXACT:
            return variance
        with np.errstate(invalid="ignore"):
            exact = variance / pair_efficiency(coherence, looks) * (1.0 - _TABLE)
        return np.where(np.isfinite(variance), exact, np.inf)

    def _filtered_weights(self, least: Array, most: Array) -> Array:
        """2L u_i u_j ∫ df/(1 + U) over the common band, U the sum of u over who sees it.

        With images sorted by offset, all that lie between i and j see their whole common band. The
        integral falls with o_j − o_i, and grows as the others move away: so it is largest at
        corners of the box that are known.
        """
        first, second = self.radar.image_pairs.T
        weight = self._phase_weight
        common = np.maximum(0.0, 1.0 - least)
        sequence = self._sequence
        if sequence is None:  # no common order: count on nobody else
            seen = 1.0 + weight[first] + weight[second]
            return np.asarray(
                2.0 * self.radar.looks * weight[first] * weight[second] / seen * common
            )
        pair = self._pair_index
        result = np.zeros_like(least)
        for a, i in enumerate(sequence):
            for b, j in enumerate(sequence[a + 1 :], start=a + 1):
                column = pair[i, j]
                start = np.minimum(least[:, column], 1.0)
                right = [(np.clip(most[:, pair[i, k]], start, 1.0), k) for k in sequence[b + 1 :]]
                left = [(np.clip(1.0 - most[:, pair[i, k]], start, 1.0), k) for k in sequence[:a]]
                seen = 1.0 + weight[list(sequence[: b + 1])].sum()
                integral = _staircase(
                    start,
                    seen,
                    [(edge, weight[k]) for edge, k in right]
                    + [(edge, -weight[k]) for edge, k in left],
                )
                result[:, column] = 2.0 * self.radar.looks * weight[i] * weight[j] * integral
        return result

    def _of_signal(self, count: int) -> Array:
        """2L γ_i²/(1 − γ_i²) for each image: of whoever knew its signal without noise.

        Γ is diag(1 − γ_i²) plus a signal, whatever volume, time and bands make of that; nobody
        knows more of the phases than one who is told the signal.
        """
        images = len(self.radar.images) - 1
        known = 2.0 * self.radar.looks * self._phase_weight[0]
        if self._reweighted:
            return self._laplacian(np.full((count, len(self.radar.image_pairs)), known))
        return np.broadcast_to(known * np.eye(images), (count, images, images))

    @property
    def _reweighted(self) -> bool:
        """Whether exact statistics lessen each pair by itself.

        Of a general coherence matrix some pairs may have a negative weight; to lessen those adds
        information. No weight is above 2Lu, and those that are positive bound the rest.
        """
        exact = self.errors.phase_statistics is PhaseStatistics.EXACT
        return exact and len(self.radar.images) > 2

    def _unfiltered(self, least: Array, most: Array) -> Array:
        """2L(Γ∘Γ⁻¹ − I) is not monotone in the coherences: bounded by Γ within an interval.

        cᵀ(Γ∘Γ⁻¹)c = tr(diag(c) Γ diag(c) Γ⁻¹) grows with the first Γ and falls with the second, so
        Γ₀ − E ⪯ Γ ⪯ Γ₀ + E bounds it. And Γ is a part of rank γ plus independent noise: knowing
        that part without noise, the images' phases have the information 2L γ_i²/(1 − γ_i²) each,
        and never more.
        """
        first, second = self.radar.image_pairs.T
        high = self._pair_coherence * np.maximum(0.0, 1.0 - least)
        low = self._pair_coherence * np.maximum(0.0, 1.0 - most)
        count = len(self.radar.images)
        spread = np.zeros((len(least), count, count))
        spread[:, first, second] = spread[:, second, first] = 0.5 * (high - low)
        excess = spread.sum(axis=-1)
        coherence = np.zeros_like(spread)
        coherence[:, first, second] = coherence[:, second, first] = 0.5 * (high + low)
        index = np.arange(count)
        coherence[:, index, index] = 1.0
        bound = np.zeros_like(spread)
        bound[:, index, index] = self._phase_weight
        noise = 1.0 - self._amplitude**2
        close = excess.max(axis=-1) < 0.5 * noise.min()
        margin = excess[close][:, :, None] * np.eye(count)
        largest = np.linalg.inv(coherence[close] - margin)
        if self._reweighted:
            smallest = np.linalg.inv(coherence[close] + margin)
            room = np.sqrt(np.maximum((largest - smallest)[:, index, index], 0.0))
            inverse = 0.5 * (largest + smallest - room[:, :, None] * room[:, None, :])
            weights = np.full((len(least), len(first)), self._phase_weight[0])
            weights[close] = np.maximum(0.0, -high[close] * inverse[:, first, second])
            return self._laplacian(2.0 * self.radar.looks * weights)
        product = (coherence[close] + margin) * largest
        bound[close] = product - np.eye(count)
        return np.asarray(2.0 * self.radar.looks * bound[:, 1:, 1:])

    def _laplacian(self, weights: Array) -> Array:
        """Weights (n, K) as a matrix relative to the first image."""
        first, second = self.radar.image_pairs.T
        count = len(self.radar.images)
        matrix = np.zeros((len(weights), count, count))
        matrix[:, first, second] = matrix[:, second, first] = -weights
        index = np.arange(count)
        matrix[:, index, index] = -matrix.sum(axis=-1)
        return matrix[:, 1:, 1:]

    @cached_property
    def _pair_offsets(self) -> Array:
        first, second = self.radar.image_pairs.T
        return np.asarray(self.offsets[second] - self.offsets[first])

    @cached_property
    def _pair_index(self) -> NDArray[np.intp]:
        count = len(self.radar.images)
        index = np.zeros((count, count), dtype=np.intp)
        first, second = self.radar.image_pairs.T
        index[first, second] = index[second, first] = np.arange(len(first))
        return index

    @cached_property
    def _sequence(self) -> tuple[int, ...] | None:
        """Images by increasing offset, where that order is the same in every box."""
        order = np.argsort(self.offsets.sum(axis=-1), kind="stable")
        steps = np.diff(self.offsets[order], axis=0)
        return tuple(order.tolist()) if np.all(steps >= 0.0) else None

    @cached_property
    def _amplitude(self) -> Array:
        return np.full(len(self.radar.images), self.amplitude)

    @cached_property
    def _phase_weight(self) -> Array:
        return np.asarray(self._amplitude**2 / (1.0 - self._amplitude**2))

    @cached_property
    def _pair_coherence(self) -> Array:
        first, second = self.radar.image_pairs.T
        return np.asarray(self._amplitude[first] * self._amplitude[second])


def _staircase(start: Array, level: float, steps: list[tuple[Array, float]]) -> Array:
    """∫ df/level from `start` to 1, the level changing by a step at each edge between them."""
    if not steps:
        return np.asarray((1.0 - start) / level)
    edges = np.stack([edge for edge, _ in steps], axis=-1)
    order = np.argsort(edges, axis=-1, kind="stable")
    edges = np.take_along_axis(edges, order, axis=-1)
    change = np.array([step for _, step in steps])[order]
    levels = np.concatenate(
        [np.full((len(start), 1), level), level + np.cumsum(change, axis=-1)], axis=-1
    )
    bounds = np.concatenate([start[:, None], edges, np.ones((len(start), 1))], axis=-1)
    return np.asarray(np.sum(np.diff(bounds, axis=-1) / levels, axis=-1))
