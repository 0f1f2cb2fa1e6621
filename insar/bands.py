"""The parts of the ground's spectrum, and which images see each.

Image i sees the rectangle [o_i, o_i + 1] × [d_i, d_i + 1] in range and azimuth, in bandwidths. The
edges of all rectangles cut the spectrum into cells; a cell is seen by one and the same images
throughout.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class BandCell(NamedTuple):
    """A part of the spectrum of the ground that one and the same images see.

    Attributes
    ----------
    share : its area, in parts of what one image sees.
    images : (n,) — indices of the images that see it, ascending.
    """

    share: float
    images: NDArray[np.intp]


class BandIntervals(NamedTuple):
    """The intervals into which the ends of M bands cut an axis.

    Attributes
    ----------
    width : (..., n) — n = 2M − 1, some of them zero [bandwidths].
    seen : (..., M, n) — 1 where an image sees an interval, else 0.
    """

    width: Array
    seen: Array


def band_intervals(band_offset: ArrayLike) -> BandIntervals:
    """Cut an axis of the spectrum where an image begins or ceases to see it.

    Parameters
    ----------
    band_offset : (..., M) — lower ends of the images' bands, in bandwidths.
    """
    offset = np.asarray(band_offset, dtype=np.float64)
    edges = np.sort(np.concatenate([offset, offset + 1.0], axis=-1), axis=-1)
    middle = 0.5 * (edges[..., 1:] + edges[..., :-1])[..., None, :]
    start = offset[..., :, None]
    seen = ((start <= middle) & (middle < start + 1.0)).astype(np.float64)
    return BandIntervals(np.diff(edges, axis=-1), seen)


def band_cells(
    band_offset: ArrayLike, doppler_offset: ArrayLike | None = None
) -> tuple[BandCell, ...]:
    """Parts of the spectrum that two or more images see, one for each set of images.

    Parameters
    ----------
    band_offset : (M,) — lower ends of the images' range bands, in bandwidths.
    doppler_offset : (M,) — of their azimuth bands, likewise; None: all the same.

    Returns
    -------
    Cells in order of their first image, then of the others.
    """
    across = band_intervals(band_offset)
    count = across.seen.shape[0]
    along = band_intervals(np.zeros(count) if doppler_offset is None else doppler_offset)
    area = across.width[:, None] * along.width
    seen = across.seen[:, :, None] * along.seen[:, None, :]
    shares: dict[tuple[int, ...], float] = {}
    for row, column in np.argwhere(area > 0.0):
        images = tuple(np.flatnonzero(seen[:, row, column]).tolist())
        if len(images) > 1:
            shares[images] = shares.get(images, 0.0) + float(area[row, column])
    return tuple(
        BandCell(share, np.array(images, dtype=np.intp)) for images, share in sorted(shares.items())
    )
