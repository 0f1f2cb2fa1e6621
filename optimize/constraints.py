"""The limits that a formation must keep, and how far it is from each.

A limit knows how to read its quantity off a population of formations; adding one is a function
that reads it and an entry in `Constraints.limits`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import min_separation, orbit_radius
from insar import pair_critical_baseline, pair_geometry, unwrapping_ladder

from .population import Population

Array = NDArray[np.float64]

FEASIBILITY_TOLERANCE = 1e-9
"""Overshoot of a limit, in the units of `Limit.margins`, that counts as rounding."""


class Bound(IntEnum):
    """Side of the limit on which a value must stay."""

    AT_MOST = -1
    AT_LEAST = 1


@dataclass(frozen=True, kw_only=True)
class Limit:
    """A limit on a quantity that a formation has several of.

    Parameters
    ----------
    name : what is limited, in words.
    unit : unit of the value, empty for a ratio.
    bound : side on which the value must stay.
    value : the limit.
    remedy : what a designer may change where it blocks.
    quantity : reads the values off a population: (P, items), an item a satellite, pair or segment.
    """

    name: str
    unit: str
    bound: Bound
    value: float
    remedy: str
    quantity: Callable[[Population], Array]

    def margins(self, population: Population) -> Array:
        """Margin of every item in parts of the limit, positive when kept: (P, items)."""
        return self.bound * (self.quantity(population) / self.value - 1.0)

    def worst(self, population: Population) -> Array:
        """Value of the worst item, (P,), in the limit's unit."""
        values = self.quantity(population)
        worst: Array = values.max(-1) if self.bound is Bound.AT_MOST else values.min(-1)
        return worst


@dataclass(frozen=True, kw_only=True)
class FailureLimit(Limit):
    """A lower limit on a probability, read as the probability of failure.

    Its margin is in decades of the failure: probabilities near 1 differ by less than rounding.
    """

    def margins(self, population: Population) -> Array:
        """Margin of every item in decades of the failure probability: (P, items)."""
        failure = np.maximum(self.quantity(population), 1e-16)
        return math.log10(1.0 - self.value) - np.log10(failure)

    def worst(self, population: Population) -> Array:
        """Smallest probability of success, (P,)."""
        worst: Array = 1.0 - self.quantity(population).max(-1)
        return worst


class ConstraintReport(NamedTuple):
    """How one formation stands to one limit.

    Attributes
    ----------
    limit : the limit.
    value : the worst value of the formation, in the limit's unit.
    satisfied : whether it keeps the limit.
    """

    limit: Limit
    value: float
    satisfied: bool

    @property
    def margin(self) -> float:
        """Distance to the limit, positive when kept, in the limit's unit."""
        return self.limit.bound * (self.value - self.limit.value)


@dataclass(frozen=True, kw_only=True)
class Constraints:
    """The limits of a study; each that is None is off.

    Parameters
    ----------
    max_radius : scalar — largest radius of a relative orbit, twice its radial amplitude [m].
    min_separation : scalar — smallest distance of any pair at any time [m].
    min_unwrapping_probability : scalar — smallest probability, in every segment, that the phase
        is unwrapped rightly; needs `prior_height_std`.
    prior_height_std : scalar — standard deviation of the height known beforehand [m]; no limit
        itself.
    max_baseline_fraction : scalar — largest |B⊥| of a pair, in parts of its critical baseline.
    max_offset, max_rate : scalar — largest |z0| [m] and |ż0| [m/s]. The search never leaves
        the box of its `DesignSpace`; as limits they are checked in other formations too.

    Raises
    ------
    ValueError
        If a limit is not a finite positive number, or the prior of the unwrapping is missing.
    """

    max_radius: float | None = None
    min_separation: float | None = None
    min_unwrapping_probability: float | None = None
    prior_height_std: float | None = None
    max_baseline_fraction: float | None = None
    max_offset: float | None = None
    max_rate: float | None = None

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be a finite positive number, or None")
        probability = self.min_unwrapping_probability
        if probability is not None and probability >= 1.0:
            raise ValueError(f"min_unwrapping_probability = {probability!r} must be below 1")
        if probability is not None and self.prior_height_std is None:
            raise ValueError(
                "min_unwrapping_probability needs prior_height_std: without a prior height no "
                "phase can be unwrapped"
            )

    @property
    def of_orbits(self) -> tuple[str, ...]:
        """Names of those that are on and need orbits: a table of positions cannot keep them."""
        names = ("max_radius", "min_separation", "max_offset", "max_rate")
        return tuple(name for name in names if getattr(self, name) is not None)

    @property
    def limits(self) -> tuple[Limit, ...]:
        """The limits that are on."""
        candidates = (
            _limit(
                Bound.AT_MOST,
                self.max_radius,
                "m",
                name="radius of each relative orbit",
                remedy="allow a larger radius",
                quantity=_radius,
            ),
            _limit(
                Bound.AT_LEAST,
                self.min_separation,
                "m",
                name="separation of each pair at all times",
                remedy="allow a smaller separation, a larger radius or fewer satellites",
                quantity=_separation,
            ),
            self._unwrapping_limit(),
            _limit(
                Bound.AT_MOST,
                self.max_baseline_fraction,
                "",
                name="perpendicular over critical baseline",
                remedy="allow a larger fraction or a smaller separation",
                quantity=_baseline_fraction,
            ),
            _limit(
                Bound.AT_MOST,
                self.max_offset,
                "m",
                name="radial offset |z0|",
                remedy="allow a larger offset",
                quantity=lambda population: np.abs(_states(population)[..., 0]),
            ),
            _limit(
                Bound.AT_MOST,
                self.max_rate,
                "m/s",
                name="radial rate |ż0|",
                remedy="allow a larger rate",
                quantity=lambda population: np.abs(_states(population)[..., 3]),
            ),
        )
        return tuple(limit for limit in candidates if limit is not None)

    def _unwrapping_limit(self) -> FailureLimit | None:
        probability, prior = self.min_unwrapping_probability, self.prior_height_std
        if probability is None or prior is None:
            return None
        return FailureLimit(
            name="unwrapping probability",
            unit="",
            bound=Bound.AT_LEAST,
            value=probability,
            remedy="use a better prior DEM, more looks, a smaller position error, more satellites "
            "or a lower probability",
            quantity=_unwrapping_failure(prior),
        )


def _limit(
    bound: Bound,
    value: float | None,
    unit: str,
    *,
    name: str,
    remedy: str,
    quantity: Callable[[Population], Array],
) -> Limit | None:
    if value is None:
        return None
    return Limit(name=name, unit=unit, bound=bound, value=value, remedy=remedy, quantity=quantity)


def _states(population: Population) -> Array:
    if population.states is None:
        raise ValueError("a limit on the orbits needs states; placed satellites have none")
    return population.states


def _radius(population: Population) -> Array:
    states = _states(population)
    return orbit_radius(states[..., 0], states[..., 3], mean_motion=population.mean_motion)


def _separation(population: Population) -> Array:
    return min_separation(_states(population), mean_motion=population.mean_motion)


def _unwrapping_failure(prior_height_std: float) -> Callable[[Population], Array]:
    def failure(population: Population) -> Array:
        return unwrapping_ladder(population.model, prior_height_std=prior_height_std).failure

    return failure


def _baseline_fraction(population: Population) -> Array:
    pairs = pair_geometry(
        population.positions,
        population.scene,
        radar=population.radar,
        held_constant=population.errors.held_constant,
    )
    critical = pair_critical_baseline(population.scene, population.radar)
    fraction = np.abs(pairs.perpendicular_baseline) / critical
    return fraction.reshape(*fraction.shape[:-2], -1)
