"""Classes of elevation models: what they ask of posting, relative and absolute height error."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Specification:
    """What a class of elevation models asks; None asks nothing.

    Parameters
    ----------
    name : of the class.
    posting : scalar — largest distance of the posts [m].
    relative_90 : scalar — largest point-to-point error of 90 % within a cell, on slopes up to
        `steep` [m].
    relative_90_steep : scalar — the same on steeper slopes; None: the same value [m].
    absolute_90 : scalar — largest absolute error of 90 % [m].
    steep : scalar — tangent of the slope from which the terrain counts as steep; 0.2 is 20 %.
    source : where the values are from.
    confirmed : whether the class was seen in its own document; a reader must know if not.

    Raises
    ------
    ValueError
        If a number is not positive, or nothing is asked at all.
    """

    name: str
    posting: float | None = None
    relative_90: float | None = None
    relative_90_steep: float | None = None
    absolute_90: float | None = None
    steep: float = 0.2
    source: str = ""
    confirmed: bool = True

    def __post_init__(self) -> None:
        numbers = {
            name: getattr(self, name)
            for name in ("posting", "relative_90", "relative_90_steep", "absolute_90", "steep")
        }
        for name, value in numbers.items():
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and positive")
        if (self.posting, self.relative_90, self.absolute_90) == (None, None, None):
            raise ValueError(
                f"the specification {self.name!r} asks nothing; give it a posting, a relative or "
                "an absolute error"
            )

    def relative_limit(self, slope: ArrayLike) -> Array | None:
        """Limit of the relative error on terrain of a slope, (...) [m]; None if it has none.

        Parameters
        ----------
        slope : (...) — angle of the terrain, of either sign [rad].
        """
        if self.relative_90 is None:
            return None
        steep = self.relative_90 if self.relative_90_steep is None else self.relative_90_steep
        return np.where(np.abs(np.tan(slope)) > self.steep, steep, self.relative_90)


_KRIEGER = "Krieger et al. 2007, doi:10.1109/TGRS.2007.900693, Table I"

HRTI3 = Specification(
    name="HRTI-3",
    posting=12.0,
    relative_90=2.0,
    relative_90_steep=4.0,
    absolute_90=10.0,
    source=_KRIEGER,
)
"""The aim of TanDEM-X."""

HRTI4 = Specification(
    name="HRTI-4",
    posting=6.0,
    relative_90=0.8,
    absolute_90=5.0,
    source="values in circulation, as quoted with TanDEM-X; the class never became a standard",
    confirmed=False,
)

DTED2 = Specification(
    name="DTED-2",
    posting=30.0,
    relative_90=12.0,
    relative_90_steep=15.0,
    absolute_90=18.0,
    source=f"absolute: MIL-PRF-89020B (2000); relative: {_KRIEGER}",
)
"""Posts one arc second apart, 30 m at the equator."""

CLASSES = {"hrti3": HRTI3, "hrti4": HRTI4, "dted2": DTED2}
"""The classes by the name that studies use."""
