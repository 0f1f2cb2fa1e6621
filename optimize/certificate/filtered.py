"""The most that pairs of filtered images can tell: bounds of the edges of their information."""

from __future__ import annotations

from dataclasses import dataclass

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
    """

    radar: Radar
    strength: Array

    def upper(self, low: Array, high: Array, among: tuple[int, ...] | None = None) -> Array:
        """2L u_i u_j ∫ df/(1 + U) over the common band, U the sum of u over who sees it.

        An image k that lies between i and j sees their whole common band; one that lies R above
        both leaves R of it at the one end, one that lies below at the other. The integral grows
        with the common band, and with all that others leave of it.

        Parameters
        ----------
        low, high : (n, K) — bounds of o_j − o_i of each pair [bandwidths].
        among : images that see a part of the azimuth band; the weight of others is zero.

        Returns
        -------
        (n, K) — [1/rad²].
        """
        weight, pairs = self.strength, self.radar.image_pairs
        some = range(len(weight)) if among is None else among
        # o_j − o_i of any two images is at most:
        above = np.zeros((len(weight), len(weight), len(low)))
        above[pairs[:, 0], pairs[:, 1]], above[pairs[:, 1], pairs[:, 0]] = high.T, -low.T
        result = np.zeros_like(low)
        for column, (i, j) in enumerate(pairs):
            if i not in some or j not in some:
                continue
            start = np.clip(np.maximum(low[:, column], -high[:, column]), 0.0, 1.0)
            level, steps = 1.0 + weight[i] + weight[j], []
            for k in some:
                if k in (i, j):
                    continue
                begin = start + np.maximum(0.0, np.minimum(above[i, k], above[j, k]))
                begin = np.minimum(begin, 1.0)
                end = 1.0 - np.maximum(0.0, np.minimum(above[k, i], above[k, j]))
                if np.all(begin == start):
                    level += weight[k]
                else:
                    steps.append((begin, weight[k]))
                if np.any(end < 1.0):
                    steps.append((np.maximum(end, begin), -weight[k]))
            integral = _staircase(start, level, steps)
            result[:, column] = 2.0 * self.radar.looks * weight[i] * weight[j] * integral
        return result


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
