"""The most that pairs of filtered images can tell: bounds of the edges of their information."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from insar import Radar

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class FilteredWeights:
    """Bounds the weights of the pairs over boxes of their band shifts.

    Parameters
    ----------
    radar : for its images and looks.
    strength : (M,) — u_i = γ_i²/(1 − γ_i²) of each image.
    offsets : (M, N − 1) — band offsets of the images relative to the first, per gap [bandwidths].
    """

    radar: Radar
    strength: Array
    offsets: Array

    def weights(self, least: Array, most: Array, among: tuple[int, ...] | None = None) -> Array:
        """2L u_i u_j ∫ df/(1 + U) over the common band, U the sum of u over who sees it.

        With images sorted by offset, all that lie between i and j see their whole common band. The
        integral falls with o_j − o_i, and grows as the others move away: so it is largest at
        corners of the box that are known. `among` names images that see a part of the azimuth
        band; the weight of others is zero.
        """
        first, second = self.radar.image_pairs.T
        weight = self.strength
        common = np.maximum(0.0, 1.0 - least)
        sequence = self.sequence
        if sequence is None:  # no common order: count on nobody else
            seen = 1.0 + weight[first] + weight[second]
            alone = 2.0 * self.radar.looks * weight[first] * weight[second] / seen * common
            if among is None:
                return np.asarray(alone)
            return np.where(np.isin(first, among) & np.isin(second, among), alone, 0.0)
        if among is not None:
            sequence = tuple(k for k in sequence if k in among)
        pair = self.pair_index
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

    @cached_property
    def pair_index(self) -> NDArray[np.intp]:
        """Index of the pair of each two images, (M, M)."""
        count = len(self.radar.images)
        index = np.zeros((count, count), dtype=np.intp)
        first, second = self.radar.image_pairs.T
        index[first, second] = index[second, first] = np.arange(len(first))
        return index

    @cached_property
    def sequence(self) -> tuple[int, ...] | None:
        """Images by increasing offset, where that order is the same in every box."""
        order = np.argsort(self.offsets.sum(axis=-1), kind="stable")
        steps = np.diff(self.offsets[order], axis=0)
        return tuple(order.tolist()) if np.all(steps >= 0.0) else None


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
