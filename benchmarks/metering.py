"""Count and time the evaluations of a search, and stop it when its budget is spent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from time import process_time
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from optimize import DesignSpace, Evaluation, Problem
from optimize.constraints import FEASIBILITY_TOLERANCE

Array = NDArray[np.float64]
Result = TypeVar("Result")


class BudgetSpentError(Exception):
    """A search asked for more evaluations than it was given."""


@dataclass
class Meter:
    """What a search has used and reached.

    Attributes
    ----------
    budget : evaluations that it may use.
    evaluations : formations scored.
    seconds : CPU time inside the evaluator, from design vectors to scores [s].
    best : smallest region height error of all feasible formations that it scored [m].
    start : CPU time at which the search began [s].
    improvements : CPU time since the start [s], and the best from then on [m].
    """

    budget: float = np.inf
    evaluations: int = 0
    seconds: float = 0.0
    best: float = np.inf
    running: bool = False
    start: float = field(default_factory=process_time)
    improvements: list[tuple[float, float]] = field(default_factory=list)

    def timed(self, function: Callable[[], Result]) -> Result:
        """Call a function on the evaluator's clock; nested calls count once."""
        if self.running:
            return function()
        self.running, start = True, process_time()
        try:
            return function()
        finally:
            self.seconds += process_time() - start
            self.running = False

    def admit(self, states: Array) -> Array:
        """The states that the budget still allows."""
        admitted = states[: int(min(self.budget - self.evaluations, len(states)))]
        if len(admitted) == 0:
            raise BudgetSpentError
        self.evaluations += len(admitted)
        return admitted

    def note(self, objectives: Array, feasible: NDArray[np.bool_]) -> None:
        """Remember the best feasible formation."""
        best = float(np.min(objectives, where=feasible, initial=np.inf))
        if best < self.best:
            self.best = best
            self.improvements.append((process_time() - self.start, best))

    def reached(self, target: float) -> float:
        """CPU time at which the best came to a target; `inf` if it never did [s]."""
        return next((time for time, best in self.improvements if best <= target), np.inf)


@dataclass(frozen=True, kw_only=True)
class MeteredProblem(Problem):
    """A problem whose evaluations are metered.

    The last batch within the budget is cut to it, scored, and then ends the search.
    """

    meter: Meter

    def evaluate(self, states: ArrayLike) -> Evaluation:
        asked = np.asarray(states, dtype=np.float64)
        admitted = self.meter.admit(asked)
        result = self.meter.timed(lambda: super(MeteredProblem, self).evaluate(admitted))
        self.meter.note(result.objectives, result.feasible)
        if len(admitted) < len(asked):
            raise BudgetSpentError
        return result

    def objectives_and_margins(self, states: ArrayLike) -> tuple[Array, list[Array]]:
        score = super().objectives_and_margins
        if self.meter.running:  # from `evaluate`, which has counted it
            return score(states)
        asked = np.asarray(states, dtype=np.float64)
        admitted = self.meter.admit(asked)
        objectives, margins = self.meter.timed(lambda: score(admitted))
        worst = np.min([margin.min(axis=-1) for margin in margins], axis=0)
        self.meter.note(objectives, worst >= -FEASIBILITY_TOLERANCE)
        if len(admitted) < len(asked):
            raise BudgetSpentError
        return objectives, margins


@dataclass(frozen=True, kw_only=True)
class MeteredSpace(DesignSpace):
    """A design space whose decoding is on the evaluator's clock."""

    meter: Meter

    def states(self, designs: ArrayLike) -> Array:
        return self.meter.timed(lambda: super(MeteredSpace, self).states(designs))


def metered(
    problem: Problem, space: DesignSpace, meter: Meter
) -> tuple[MeteredProblem, MeteredSpace]:
    """The same problem and space with a meter in them."""
    return (
        MeteredProblem(**_parameters(problem), meter=meter),
        MeteredSpace(**_parameters(space), meter=meter),
    )


def _parameters(thing: Problem | DesignSpace) -> dict[str, Any]:
    return {field.name: getattr(thing, field.name) for field in fields(thing)}
