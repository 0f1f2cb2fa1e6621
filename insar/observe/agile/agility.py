"""How fast a satellite can turn, and where that does not do."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..vectors import dot

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Limit = float | tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Agility:
    """How fast a satellite can turn.

    Parameters
    ----------
    max_rate : scalar or three — of the angular velocity against inertial space: its magnitude, or
        about each body axis [rad/s].
    max_acceleration : the same of the angular acceleration [rad/s²].

    Raises
    ------
    ValueError
        If a limit is not positive.
    """

    max_rate: Limit = math.inf
    max_acceleration: Limit = math.inf

    def __post_init__(self) -> None:
        for name in ("max_rate", "max_acceleration"):
            limit = np.asarray(getattr(self, name), dtype=np.float64)
            if limit.shape not in ((), (3,)) or not np.all(limit > 0.0):
                raise ValueError(
                    f"{name} = {getattr(self, name)!r} must be one positive number, or three, "
                    "about X, Y and Z; give radians"
                )

    @property
    def limited(self) -> bool:
        """Whether there is any limit at all."""
        return not (np.all(np.isinf(self.max_rate)) and np.all(np.isinf(self.max_acceleration)))


def exceeds(vector: Array, limit: Limit) -> Mask:
    """Whether a magnitude, or any component, is above its limit; not where it is NaN.

    Parameters
    ----------
    vector : (S, 3) — angular velocity or acceleration, in body axes.
    limit : of the magnitude, or of each component.
    """
    bound = np.asarray(limit, dtype=np.float64)
    above: Mask
    if bound.ndim == 0:
        above = np.sqrt(dot(vector, vector)) > bound
    else:
        above = np.any(np.abs(vector) > bound, axis=-1)
    return above
