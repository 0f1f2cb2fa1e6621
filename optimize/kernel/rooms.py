"""Where the numbers of the eight formations at hand stand: some kilobytes in the inner cache."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .constants import Constants

WIDTH = 8
"""Formations side by side."""


class Room(NamedTuple):
    """Addresses of arrays of lanes; each element is written before it is read.

    Attributes
    ----------
    radial, rate : (N,) — z0 [m] and ż0 [m/s] of the satellites.
    side : (1,) — sign of the cross-track motion.
    center_radial, center_rate : (M,) — the same of the images' phase centers, relative to the
        first.
    kz, along : (M,) — wavenumbers [rad/m] and azimuth projections [m] in the segment.
    offset, doppler : (M,) — lower ends of the bands.
    edges : (K,) — information between each two images [1/rad²].
    matrix, inverse : (M, M) — systems, and their inverse.
    column : (M,) — of a system.
    height, azimuth, product : (M,) — what shared errors leave of kz and of the azimuth.
    variance : (K,) — of the ladder's pairs [cycles²].
    gain, joined : (M,) — of a rung; `inf` where an image is joined to another.
    parts : (5, 2^M) — the parts of the spectrum that sets of images see, and their extremes.
    cells : (2M, 2M) — integrals over the cells of the spectrum, where sets are too many.
    ends : (2, 2M) — of the bands in range and azimuth, sorted.
    order, low, high : integers (M,), (2, M), (2, M) — ranks of the ends.
    failure : (S,) — of the unwrapping.
    worst : (C,) — smallest margin of each limit.
    items : margins of all items.
    end : address after the last.
    """

    radial: int
    rate: int
    side: int
    center_radial: int
    center_rate: int
    kz: int
    along: int
    offset: int
    doppler: int
    edges: int
    matrix: int
    inverse: int
    column: int
    height: int
    azimuth: int
    product: int
    variance: int
    gain: int
    joined: int
    parts: int
    cells: int
    ends: int
    order: int
    low: int
    high: int
    failure: int
    worst: int
    items: int
    end: int


def rooms(k: Constants, *, items: int) -> Room:
    """Lay the arrays out one after the other; return how many bytes each is from the first.

    Parameters
    ----------
    k : the constants of the problem.
    items : margins of all items, or 0 where none are asked for.
    """
    square, pairs = k.images**2, k.pairs
    sets = 1 << k.images if k.sets else 0
    ends = 0 if k.sets else 2 * k.images
    sizes = Room(
        radial=k.satellites,
        rate=k.satellites,
        side=1,
        center_radial=k.images,
        center_rate=k.images,
        kz=k.images,
        along=k.images,
        offset=k.images,
        doppler=k.images,
        edges=pairs,
        matrix=square,
        inverse=square,
        column=k.images,
        height=k.images,
        azimuth=k.images,
        product=k.images,
        variance=pairs,
        gain=k.images,
        joined=k.images,
        parts=5 * sets,
        cells=ends**2,
        ends=2 * ends,
        order=k.images,
        low=ends,
        high=ends,
        failure=k.segments,
        worst=k.limits,
        items=items,
        end=0,
    )
    places = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    return Room(*(8 * WIDTH * places).tolist())


RECORD = np.dtype([(name, "i8") for name in Room._fields])
"""The places of a room in memory."""


class Space:
    """Memory for eight formations at a time.

    Parameters
    ----------
    room : where each array stands in it.
    """

    def __init__(self, room: Room) -> None:
        # Vectors begin on a border of the cache's lines.
        self._memory = np.empty(room.end // 8 + WIDTH)
        start = self._memory.ctypes.data
        start += -start % (8 * WIDTH)
        self._places = (np.array(room) + start).view(RECORD)
        self.address = self._places.ctypes.data
