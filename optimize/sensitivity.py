"""How a formation's errors answer to each item of the budget, and the value at which one passes.

Nothing is linearized but the elasticities themselves: every value comes from the model, evaluated
for the formation with one item changed and everything else as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from insar import (
    Cell,
    combine_acquisitions,
    height_accuracy,
    height_error_of,
    phase_model,
    unwrapping_ladder,
)

from .budget import BudgetItem, budget_items
from .problem import Problem

Array = NDArray[np.float64]

_STEP = 1e-3
"""Of ln p in the central difference: its error is of order 1e-6."""

REACH = 1e3
"""Factor by which an item is changed at most in search of a value that passes."""

_SCAN = 16
"""Values scanned on each side: a factor of 1.54 apart."""

_NEVER = 1e300
"""Stands for an error where no height is measured; finite, so that a bracket can end there."""


class Quantity(StrEnum):
    """An error of a formation that an item may change."""

    TOTAL = "total"
    """Region height error, the objective [m]."""
    RELATIVE = "relative_90"
    """Largest point-to-point error of 90 % [m]."""
    ABSOLUTE = "absolute_90"
    """Largest absolute error of 90 % [m]."""
    FAILURE = "failure"
    """Largest probability that a cycle is not found; absent without a prior height."""


class Sensitivity(NamedTuple):
    """What a change of one item does.

    Attributes
    ----------
    item : name of the item.
    unit : of its value.
    value : as it is.
    elasticities : quantity → d ln(quantity)/d ln(item): 0.5 is half a percent for each percent. NaN
        where the quantity or the item can't be changed by a little.
    """

    item: str
    unit: str
    value: float
    elasticities: dict[Quantity, float]


class Remedy(NamedTuple):
    """The value of one item, nearest to what it is, at which a demand is met.

    Attributes
    ----------
    item : name of the item.
    unit : of its value.
    value : as it is.
    needed : the value that suffices; None if none within a factor of `REACH` does.
    probability : of right unwrapping in the worst segment there; None without a prior height.
    """

    item: str
    unit: str
    value: float
    needed: float | None
    probability: float | None


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """A formation whose budget is varied.

    Attributes
    ----------
    problem : scene, radar, errors and limits.
    positions : (S, N, 3) — of the formation, RTN at the scene's times [m]; (A, S, N, 3) of
        acquisitions that are combined.
    cell : what the relative error refers to.
    combined : whether the positions are of several acquisitions.
    known : quantities that were computed already, by item and factor; several demands ask for the
        same ones.
    """

    problem: Problem
    positions: Array
    cell: Cell
    combined: bool = False
    known: dict[tuple[str, float], dict[Quantity, Array]] = field(default_factory=dict, repr=False)

    @property
    def items(self) -> tuple[BudgetItem, ...]:
        """What can be changed."""
        return budget_items(self.problem, self.positions)

    def changed(self, item: BudgetItem, factor: float) -> dict[Quantity, Array]:
        """Quantities with an item multiplied by a factor; empty where it can't be.

        Parameters
        ----------
        item : of `items`.
        factor : multiplies it.
        """
        key = (item.name, factor)
        if key not in self.known:
            try:
                problem, positions = item.changed(factor)
                self.known[key] = quantities(problem, positions, self.cell, combined=self.combined)
            except ValueError:  # such a radar or calibration can't be
                self.known[key] = {}
        return self.known[key]


def quantities(
    problem: Problem, positions: ArrayLike, cell: Cell, *, combined: bool = False
) -> dict[Quantity, Array]:
    """Errors of a formation: those of the segments, and the total of the region.

    Parameters
    ----------
    problem : scene, radar, errors and limits.
    positions : (S, N, 3) — RTN positions at the scene's times [m]; (A, S, N, 3) of acquisitions.
    cell : what the relative error refers to.
    combined : whether the positions are of several acquisitions that are combined.

    Returns
    -------
    quantity → (S,), or (1,) for the total.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    accuracy = height_accuracy(
        positions, scene, radar=radar, errors=errors, cell=cell, combined=combined
    )
    each = np.asarray(positions) if combined else [positions]
    models = [phase_model(one, scene, radar=radar, errors=errors) for one in each]
    model = combine_acquisitions(models) if combined else models[0]
    region = height_error_of(model, scene=scene, radar=radar, errors=errors).region
    found = {
        Quantity.TOTAL: np.atleast_1d(region),
        Quantity.RELATIVE: accuracy.relative_90,
        Quantity.ABSOLUTE: accuracy.absolute_90,
    }
    prior = problem.constraints.prior_height_std
    if prior is not None:
        found[Quantity.FAILURE] = unwrapping_ladder(model, prior_height_std=prior).failure
    return found


def sensitivities(study: Study) -> tuple[Sensitivity, ...]:
    """Elasticities of a formation's errors, item by item.

    Parameters
    ----------
    study : the formation and its budget.

    Returns
    -------
    One for each item, the one that the total answers to most first.
    """
    found = []
    for item in study.items:
        if not item.continuous:
            unknown = dict.fromkeys(Quantity, math.nan)
            found.append(Sensitivity(item.name, item.unit, item.value, unknown))
            continue
        low, high = (_worst(study, item, math.exp(step)) for step in (-_STEP, _STEP))
        span = 2.0 * _STEP
        if not low or not high:  # at the edge of what can be, such as a single look
            middle = _worst(study, item, 1.0)
            low, high, span = low or middle, high or middle, _STEP
        elasticities = {quantity: _slope(low[quantity], high[quantity], span) for quantity in high}
        found.append(Sensitivity(item.name, item.unit, item.value, elasticities))
    return tuple(sorted(found, key=lambda one: -abs(_finite(one.elasticities[Quantity.TOTAL]))))


def remedies(study: Study, quantity: Quantity, limit: ArrayLike) -> tuple[Remedy, ...]:
    """For every item the value, all else as it is, at which a quantity keeps its limit.

    Parameters
    ----------
    study : the formation and its budget.
    quantity : what is limited.
    limit : (S,) or scalar — the most that is allowed [m].

    Returns
    -------
    One for each item that changes the quantity at all; those that suffice first, the smallest
    change first.
    """
    allowed = np.asarray(limit, dtype=np.float64)
    start = float(
        np.max(
            quantities(study.problem, study.positions, study.cell, combined=study.combined)[
                quantity
            ]
            / allowed
        )
    )
    found: list[tuple[float, Remedy]] = []
    for item in study.items:
        factor, changes = _nearest(_ratio(study, item, quantity, allowed), start, item.better)
        if not changes:
            continue
        probability = None if factor is None else _probability(study, item, factor)
        needed = None if factor is None else factor * item.value
        distance = math.inf if factor is None else abs(math.log(factor))
        found.append((distance, Remedy(item.name, item.unit, item.value, needed, probability)))
    return tuple(remedy for _, remedy in sorted(found, key=lambda pair: pair[0]))


def _ratio(
    study: Study, item: BudgetItem, quantity: Quantity, limit: Array
) -> Callable[[float], float]:
    """Largest quantity over limit, against the logarithm of the factor of an item."""

    def ratio(logarithm: float) -> float:
        value = study.changed(item, math.exp(logarithm)).get(quantity)
        worst = math.inf if value is None else float(np.max(value / limit))
        return worst if math.isfinite(worst) else _NEVER

    return ratio


def _nearest(
    ratio: Callable[[float], float], start: float, better: int
) -> tuple[float | None, bool]:
    """Factor nearest to 1 at which a ratio is 1, and whether the ratio changes at all."""
    end = math.log(REACH)
    if better != 0:  # the more of it the better, or the less: the far end tells
        farthest = ratio(better * end)
        changes = farthest != _NEVER and abs(farthest - start) > 1e-9 * start
        if farthest > 1.0:
            return None, changes
        return math.exp(_crossing(ratio, 0.0, better * end)), changes
    edges = [_first_pass(ratio, side) for side in (-1.0, 1.0)]
    found = [edge for edge in edges if edge is not None]
    return (math.exp(min(found, key=abs)) if found else None), True


def _first_pass(ratio: Callable[[float], float], side: float) -> float | None:
    """Logarithm of the first factor on one side at which a ratio is 1; None if it never is."""
    before = 0.0
    for step in np.linspace(0.0, math.log(REACH), _SCAN + 1)[1:]:
        here = side * float(step)
        if ratio(here) <= 1.0:
            return _crossing(ratio, before, here)
        before = here
    return None


def _crossing(ratio: Callable[[float], float], outside: float, inside: float) -> float:
    """Where a ratio falls to 1 between two logarithms."""

    def excess(logarithm: float) -> float:
        return math.log(ratio(logarithm))

    root = float(brentq(excess, outside, inside, xtol=1e-10, rtol=1e-12))
    # The root may lie a rounding outside; what is reported should pass.
    return root if ratio(root) <= 1.0 else root + 1e-9 * math.copysign(1.0, inside - outside)


def _probability(study: Study, item: BudgetItem, factor: float) -> float | None:
    failure = study.changed(item, factor).get(Quantity.FAILURE)
    return None if failure is None else float(1.0 - np.max(failure))


def _worst(study: Study, item: BudgetItem, factor: float) -> dict[Quantity, float]:
    found = study.changed(item, factor)
    return {quantity: float(np.max(values)) for quantity, values in found.items()}


def _slope(low: float, high: float, span: float) -> float:
    usable = all(math.isfinite(value) and value > 0.0 for value in (low, high))
    return math.log(high / low) / span if usable else math.nan


def _finite(value: float) -> float:
    return value if math.isfinite(value) else 0.0
