"""Whether heights of a given accuracy and posting are an elevation model of a class."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..accuracy import HeightAccuracy
from .specifications import Specification


class Quantity(StrEnum):
    """What a criterion is about."""

    POSTING = "posting"
    RELATIVE = "relative_90"
    ABSOLUTE = "absolute_90"


class Criterion(NamedTuple):
    """One demand of a class, and how the model stands to it.

    Attributes
    ----------
    quantity : what is demanded.
    value : what the model has, in the worst segment; `inf` where no height is measured [m].
    limit : the most that is allowed there [m].
    segment : 0-based index of the worst segment; None for the posting.
    """

    quantity: Quantity
    value: float
    limit: float
    segment: int | None

    @property
    def passed(self) -> bool:
        """Whether the demand is met."""
        return self.value <= self.limit

    @property
    def ratio(self) -> float:
        """The value in parts of the limit; above 1 it fails."""
        return self.value / self.limit


class Judgment(NamedTuple):
    """A model against a class.

    Attributes
    ----------
    specification : the class.
    criteria : its demands; the posting is left out where it is not known.
    """

    specification: Specification
    criteria: tuple[Criterion, ...]

    @property
    def passed(self) -> bool:
        """Whether every demand that could be checked is met."""
        return all(criterion.passed for criterion in self.criteria)


def judge(
    accuracy: HeightAccuracy,
    specification: Specification,
    *,
    slope: ArrayLike,
    posting: float | None = None,
) -> Judgment:
    """Hold an accuracy against a class, in the segment where it is worst.

    Parameters
    ----------
    accuracy : of one formation, of (S,) arrays.
    specification : the class.
    slope : (S,) — of the terrain in each segment [rad].
    posting : scalar — of the model; None leaves its demand unchecked [m].

    Returns
    -------
    Judgment
    """
    criteria = []
    if posting is not None and specification.posting is not None:
        criteria.append(Criterion(Quantity.POSTING, posting, specification.posting, None))
    relative = specification.relative_limit(slope)
    absolute = specification.absolute_90
    demands = (
        (Quantity.RELATIVE, accuracy.relative_90, relative),
        (Quantity.ABSOLUTE, accuracy.absolute_90, absolute),
    )
    for quantity, value, allowed in demands:
        if allowed is None:
            continue
        limit = np.broadcast_to(allowed, value.shape)
        worst = int(np.argmax(value / limit))
        criteria.append(Criterion(quantity, float(value[worst]), float(limit[worst]), worst))
    return Judgment(specification, tuple(criteria))
