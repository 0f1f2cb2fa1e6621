"""The most that the phases of a box of formations can tell.

An information matrix of filtered images, or of independent pairs, is a graph Laplacian with weights
that are not negative: it grows, in the Loewner order, with each weight. So it is bounded by
bounding each weight over the box.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, ErrorBudget, PhaseStatistics, Radar, Weighting
from insar.phase_information import pair_phase_variance
from insar.phase_noise import pair_efficiency
from insar.statistics import efficiency_curves

from .filtered import FilteredWeights
from .parted import BoxInformation, partitions
from .shared import TABLE, pair_variance

Array = NDArray[np.float64]

_SPREADS = (0.0, 0.5, np.inf)
"""Ends of the intervals of the azimuth spread that are bounded on their own [bandwidths]."""

_REMNANT = 0.02
"""Part of the azimuth band below which nothing is said of the efficiency of a pair."""

_MAX_PARTED = 5
"""Images up to which every way to part them by their azimuth bands is looked at: 30 ways."""


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

    def upper(self, lower: Array, upper: Array) -> tuple[BoxInformation, ...]:
        """Information that no formation of a box exceeds.

        Parameters
        ----------
        lower, upper : (n, N − 1) — the boxes of gaps.

        Returns
        -------
        One for each interval of the azimuth spread; every formation falls into one of them.
        """
        low, high = self._differences(lower, upper)
        least, most = np.maximum(0.0, np.maximum(low, -high)), np.maximum(high, -low)
        decorrelation = self.errors.baseline_decorrelation
        if self.errors.weighting is Weighting.PAIRS:
            return self._alone(self._laplacian(self._pair_weights(least)))
        shifted = self.radar.azimuth_resolution is not None and not self.radar.pursuit
        unfiltered = decorrelation is BaselineDecorrelation.UNFILTERED
        if not self.errors.coherence.spectral or (unfiltered and shifted):
            return self._alone(self._of_signal(len(least)))
        if unfiltered:
            return self._alone(self._unfiltered(least, most))
        if decorrelation is BaselineDecorrelation.NONE:
            low = high = least = most = np.zeros_like(least)
            shifted = False
        weights = self._filtered.upper(low, high)
        if not shifted or not self._lessened:
            return self._alone(self._laplacian(weights * self._efficiency(least, most)))
        if len(self.radar.images) > _MAX_PARTED:
            # Where a third image is missing, the weight of a pair rises: only the Cramér-Rao
            # bound is sure.
            return self._alone(self._laplacian(weights))
        groups = {group for groups in partitions(len(self.radar.images)) for group in groups}
        of_group = {group: self._filtered.upper(low, high, group) for group in groups}
        return self._parted(least, most, weights, of_group)

    def _parted(
        self, least: Array, most: Array, weights: Array, of_group: dict[tuple[int, ...], Array]
    ) -> tuple[BoxInformation, ...]:
        """By the spread D = max d − min d of the azimuth bands d.

        Frequencies a whole bandwidth apart taken together, each image sees each of them once. The
        images that see one and the same are then all of them, for 1 − D of the frequencies, or
        they are parted in two groups (at D ≥ 1 in two or more). So Fisher's information is
        (1 − D)X + ∫ΣX_S over D, S the groups; and exact statistics lessen each pair by a part
        that its looks, at least 1 − D of those that it has in range, bound. Of a pair that shares
        next to nothing in azimuth, less than `_REMNANT`, any part of next to nothing may be left.
        """
        ways = partitions(len(self.radar.images))
        parted = [sum(of_group[group] for group in groups) for groups in ways]
        largest = np.max([weights, *of_group.values()], axis=0)
        cases = []
        for start, end in pairwise(_SPREADS):
            part = self._efficiency(least, most, left=max(1.0 - end, _REMNANT))
            rest = _REMNANT * (1.0 - part) * largest if 1.0 - end < _REMNANT else 0.0
            split = [self._laplacian(group * part + rest) for group in parted]
            cases.append(
                BoxInformation(
                    self._laplacian(weights * part + rest),
                    np.stack(split, axis=1),
                    (start, min(end, 1.0)),
                )
            )
        return tuple(cases)

    def _alone(self, matrix: Array) -> tuple[BoxInformation, ...]:
        return (BoxInformation(matrix, matrix[:, None][:, :0], (0.0, 0.0)),)

    @property
    def _lessened(self) -> bool:
        """Whether exact statistics lessen the information, by a part that is known."""
        return self.errors.phase_statistics is PhaseStatistics.EXACT and self.alike

    def _efficiency(self, least: Array, most: Array, *, left: float = 1.0) -> Array:
        """Largest part of the Cramér-Rao information that each pair can have, (n, K).

        With the looks, of which at least `left` remain in azimuth, it first falls and then rises,
        so it is largest at an end of a box; where amplitudes differ it counts as 1.
        """
        if not self._lessened:
            return np.ones_like(least)
        curves = efficiency_curves(self._pair_coherence)
        ends = [
            curves(self.radar.looks * np.maximum(0.0, band))
            for band in (1.0 - least, (1.0 - most) * left)
        ]
        return np.asarray(np.minimum(1.0, np.maximum(*ends) * (1.0 + TABLE)))

    def _differences(self, lower: Array, upper: Array) -> tuple[Array, Array]:
        """Least and largest o_j − o_i of each pair over the boxes, (n, K) each."""
        positive = np.maximum(self._pair_offsets, 0.0).T
        negative = np.minimum(self._pair_offsets, 0.0).T
        return lower @ positive + upper @ negative, upper @ positive + lower @ negative

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
            exact = variance / pair_efficiency(coherence, looks) * (1.0 - TABLE)
        return np.where(np.isfinite(variance), exact, np.inf)

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
    def _filtered(self) -> FilteredWeights:
        return FilteredWeights(radar=self.radar, strength=self._phase_weight)

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
