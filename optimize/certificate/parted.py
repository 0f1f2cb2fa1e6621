"""What boxes of formations can tell at most whose azimuth bands part the images in groups."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BoxInformation(NamedTuple):
    """What the phases of n boxes can tell at most, where the azimuth bands spread by so much.

    The information X of any of their formations is at most a mean, with shares 1 − s and s, of
    `whole` and of means of `parted`, s within `shares` (Loewner order).

    Attributes
    ----------
    whole : (n, M − 1, M − 1) — relative to the first image [1/rad²].
    parted : (n, P, M − 1, M − 1) — of images that are parted in two groups; P = 0 for none.
    shares : (least, most).
    """

    whole: Array
    parted: Array
    shares: tuple[float, float]

    def ceiling(self) -> Array:
        """One matrix that is not exceeded, (n, M − 1, M − 1)."""
        if not self.parted.shape[1]:
            return self.whole
        size = self.whole.shape[-1]
        floor = 1e-9 * np.trace(self.whole, axis1=-2, axis2=-1) + 1e-300
        raised = self.whole + floor[:, None, None] * np.eye(size)
        inverse = np.linalg.inv(np.linalg.cholesky(raised))[:, None]
        ratio = np.linalg.eigvalsh(inverse @ self.parted @ np.swapaxes(inverse, -1, -2))
        excess = ratio[..., -1].max(axis=-1) - 1.0
        scale = 1.0 + np.maximum(self.shares[0] * excess, self.shares[1] * excess)
        return np.asarray(np.maximum(scale, 0.0)[:, None, None] * raised * (1.0 + 1e-9))


@lru_cache(maxsize=16)
def partitions(count: int) -> tuple[tuple[tuple[int, ...], ...], ...]:
    """Ways to part images in two or more groups, but for those that another way exceeds.

    Two single images of a way tell more as a pair.
    """
    ways: list[tuple[tuple[int, ...], ...]] = [((0,),)]
    for image in range(1, count):
        ways = [
            (*way[:place], (*way[place], image), *way[place + 1 :])
            if place < len(way)
            else (*way, (image,))
            for way in ways
            for place in range(len(way) + 1)
        ]
    return tuple(
        way
        for way in ways
        if len(way) > 1 and (count == 2 or sum(len(group) == 1 for group in way) < 2)
    )
