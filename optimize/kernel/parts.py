"""Constants of the parts of the spectrum that sets of images see: what `spectrum.by_sets` needs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

MOST_IMAGES = 8
"""Images up to which sums over the 2^M sets of them take less time than sorted ends."""


class Parts(NamedTuple):
    """Sets of images, as bits of an integer, and what their rectangles weigh.

    Attributes
    ----------
    lowest : (2^M,) — lowest image of each set.
    members : (K, 2^(M−2)) — the sets that hold both images of a pair.
    weight : (S, K, 2^(M−2)), or (1, ...) where all segments have the same — c_ij(T).
    """

    lowest: Indices
    members: Indices
    weight: Array


def parts(strength: Array, *, looks: float, pairs: NDArray[np.intp]) -> Parts:
    """Weights of the rectangles that sets of images see in common.

    Parameters
    ----------
    strength : (S, M) — u_i.
    looks : L.
    pairs : (K, 2) — the images of each pair.

    Returns
    -------
    Parts

    Notes
    -----
    Exactly the images S see an area of Σ_{T⊇S} (−1)^{|T∖S|} |R_T|, there with the information
    2L u_i u_j/(1 + u_S). Collected by T: c_ij(T) = 2L u_i u_j Σ_{ij⊆S⊆T} (−1)^{|T∖S|}/(1 + u_S).
    """
    if np.all(strength == strength[:1]):
        strength = strength[:1]
    count = strength.shape[1]
    sets = np.arange(1 << count)
    holds = (sets[:, None] >> np.arange(count)) & 1
    density = 1.0 / (1.0 + strength @ holds.T)  # (S, 2^M)
    lowest = np.where(sets > 0, np.argmax(holds, axis=-1), 0)
    members, weight = [], []
    for i, j in pairs:
        both = np.flatnonzero((holds[:, i] == 1) & (holds[:, j] == 1))
        value = density[:, both]
        # The alternating sum over subsets, one image after the other (a Möbius transform).
        for image in set(range(count)) - {int(i), int(j)}:
            held = holds[both, image] == 1
            without = np.searchsorted(both, both[held] ^ (1 << image))
            value[:, held] -= value[:, without]
        members.append(both)
        weight.append(2.0 * looks * (strength[:, i] * strength[:, j])[:, None] * value)
    return Parts(
        lowest.astype(np.int64),
        np.ascontiguousarray(members, dtype=np.int64),
        np.ascontiguousarray(np.stack(weight, axis=1)),
    )


NO_PARTS = Parts(np.zeros(1, dtype=np.int64), np.zeros((1, 1), dtype=np.int64), np.zeros((1, 1, 1)))
