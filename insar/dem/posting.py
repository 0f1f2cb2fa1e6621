"""Posting, looks and resolution of an elevation model are one choice, not three."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Resolution cell of a radar.

    Parameters
    ----------
    slant_range : scalar — across the line of sight, c/2B [m].
    azimuth : scalar — along track [m].

    Raises
    ------
    ValueError
        If a number is not positive.
    """

    slant_range: float
    azimuth: float

    def __post_init__(self) -> None:
        for name in ("slant_range", "azimuth"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and positive")

    def ground_cell(self, local_incidence: ArrayLike) -> Array:
        """Area of the resolution cell on the ground, (...) [m²].

        Parameters
        ----------
        local_incidence : (...) — from the normal of the terrain, θ_inc − slope [rad].
        """
        return np.asarray(self.slant_range * self.azimuth / np.sin(local_incidence))


def looks_of_posting(
    posting: ArrayLike,
    *,
    resolution: Resolution,
    local_incidence: ArrayLike,
    independence: float = 1.0,
) -> Array:
    """Independent looks that a post of an elevation model averages.

    Parameters
    ----------
    posting : (...) — distance of the posts, the same in both directions [m].
    resolution : of the radar.
    local_incidence : (...) — θ_inc − slope [rad].
    independence : scalar — extent that is averaged for a post, in postings: 1 where posts are
        independent, larger where the model is posted more densely than it resolves.

    Returns
    -------
    (...) — L = (independence · posting)²/(ρ_ground ρ_az). Below 1 the posting is finer than the
    radar resolves.

    Notes
    -----
    Looks are counted in resolution cells, not in samples: the pulses and range gates of a radar
    are closer than its resolution, and samples within one cell are not independent.

    Examples
    --------
    3 m in slant range and in azimuth at 35°, posts of 12 m:

    >>> cell = Resolution(slant_range=3.0, azimuth=3.0)
    >>> print(looks_of_posting(12.0, resolution=cell, local_incidence=np.deg2rad(35.0)).round(2))
    9.18
    """
    averaged = (independence * np.asarray(posting, dtype=np.float64)) ** 2
    return np.asarray(averaged / resolution.ground_cell(local_incidence))


def posting_of_looks(
    looks: ArrayLike,
    *,
    resolution: Resolution,
    local_incidence: ArrayLike,
    independence: float = 1.0,
) -> Array:
    """Posting at which a post averages so many independent looks.

    Parameters
    ----------
    looks : (...) — independent looks.
    resolution, local_incidence, independence : as in `looks_of_posting`, whose inverse it is.

    Returns
    -------
    (...) — distance of the posts [m].
    """
    area = np.asarray(looks, dtype=np.float64) * resolution.ground_cell(local_incidence)
    return np.asarray(np.sqrt(area) / independence)
