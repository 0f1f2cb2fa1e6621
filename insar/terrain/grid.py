"""An elevation model on a grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LIMITS = (-12_000.0, 9_500.0)
"""Heights on Earth, with some room: the deepest sea floor and the highest peak [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Terrain:
    """Heights on a regular grid, rows from north to south and columns from west to east.

    Parameters
    ----------
    heights : (rows, columns) — above the sphere; NaN where there are none [m].
    posting_north, posting_east : scalar — distance of rows, and of columns [m].

    Raises
    ------
    ValueError
        If there are fewer than 3 rows or columns, no height at all, a height that the Earth has
        not, or a posting that is not positive.
    """

    heights: Array
    posting_north: float
    posting_east: float

    def __post_init__(self) -> None:
        heights = np.array(self.heights, dtype=np.float64)
        if heights.ndim != 2 or min(heights.shape) < 3:
            raise ValueError(
                f"heights has shape {heights.shape}: a terrain needs 3 rows and columns or more"
            )
        if np.isinf(heights).any() or np.isnan(heights).all():
            raise ValueError("heights has no finite value, or an infinite one; NaN marks gaps")
        low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
        if low < _LIMITS[0] or high > _LIMITS[1]:
            raise ValueError(
                f"heights reach from {low:g} to {high:g} m, which the Earth has not; mark gaps as "
                "NaN, and check the unit"
            )
        for name in ("posting_north", "posting_east"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} m must be finite and positive")
        heights.setflags(write=False)
        object.__setattr__(self, "heights", heights)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        rows, columns = self.heights.shape
        return int(rows), int(columns)

    @property
    def east(self) -> Array:
        """Distance of each column from the middle of the grid, (columns,) [m]."""
        columns = self.heights.shape[1]
        return np.asarray(self.posting_east * (np.arange(columns) - 0.5 * (columns - 1)))

    @property
    def north(self) -> Array:
        """Distance of each row from the middle of the grid, (rows,), falling [m]."""
        rows = self.heights.shape[0]
        return np.asarray(self.posting_north * (0.5 * (rows - 1) - np.arange(rows)))

    def gradient(self) -> tuple[Array, Array]:
        """Rise per meter eastward and northward, each (rows, columns).

        Central differences, one-sided at the edges; NaN beside gaps.
        """
        south, east = np.gradient(self.heights, self.posting_north, self.posting_east)
        return np.asarray(east), -np.asarray(south)
