"""Count and time the evaluations of a search, and stop it when its budget is spent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import process_time
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from optimize import DesignSpace, Evaluation, Problem
from optimize.constraints import FEASIBILITY_TOLERANCE
from optimize.scoring import Evaluator

Array = NDArray[np.float64]
Result = TypeVar("Result")


class EndOfRunError(Exception):
    """A search asked for more evaluations than it was given, or is where it was to come to."""


@dataclass
class Meter:
    """What a search has used and reached.

    Attributes
    ----------
    budget : evaluations that it may use.
    target : height error at which it may stop [m].
    evaluations : formations scored.
    seconds : CPU time inside the evaluator, from design vectors to scores [s].
    best : smallest region height error of all feasible formations that it scored [m].
    start : CPU time at which the search began [s].
    improvements : CPU time since the start [s], and the best from then on [m].
    """

    budget: float = np.inf
    target: float = -np.inf
    evaluations: int = 0
    seconds: float = 0.0
    best: float = np.inf
    start: float = field(default_factory=process_time)
    improvements: list[tuple[float, float]] = field(default_factory=list)

    def timed(self, function: Callable[[Array], Result], designs: Array) -> Result:
        """Score designs on the evaluator's clock."""
        start = process_time()
        try:
            return function(designs)
        finally:
            self.seconds += process_time() - start

    def admit(self, designs: Array) -> Array:
        """The designs that the budget still allows."""
        admitted = designs[: int(min(self.budget - self.evaluations, len(designs)))]
        if len(admitted) == 0:
            raise EndOfRunError
        self.evaluations += len(admitted)
        return admitted

    def note(self, objectives: Array, feasible: NDArray[np.bool_]) -> None:
        """Remember the best feasible formation; end the run at the target."""
        best = float(np.min(objectives, where=feasible, initial=np.inf))
        if best < self.best:
            self.best = best
            self.improvements.append((process_time() - self.start, best))
        if self.best <= self.target:
            raise EndOfRunError

    def reached(self, target: float) -> float:
        """CPU time at which the best came to a target; `inf` if it never did [s]."""
        return next((time for time, best in self.improvements if best <= target), np.inf)


class ArrayEvaluator(NamedTuple):
    """The array form, design vectors to scores."""

    problem: Problem
    space: DesignSpace

    def evaluate(self, designs: Array) -> Evaluation:
        """Scores of designs."""
        return self.problem.evaluate(self.space.states(designs))

    def objectives_and_margins(self, designs: Array) -> tuple[Array, Array]:
        """Height errors and all margins of designs."""
        objectives, margins = self.problem.objectives_and_margins(self.space.states(designs))
        return objectives, np.concatenate(margins, axis=-1)


class MeteredEvaluator(NamedTuple):
    """An evaluator on a meter.

    The last batch within the budget is cut to it, scored, and then ends the search.
    """

    inner: Evaluator
    meter: Meter

    def evaluate(self, designs: Array) -> Evaluation:
        """Scores of designs."""
        admitted = self.meter.admit(designs)
        result = self.meter.timed(self.inner.evaluate, admitted)
        self.meter.note(result.objectives, result.feasible)
        if len(admitted) < len(designs):
            raise EndOfRunError
        return result

    def objectives_and_margins(self, designs: Array) -> tuple[Array, Array]:
        """Height errors and all margins of designs."""
        admitted = self.meter.admit(designs)
        objectives, margins = self.meter.timed(self.inner.objectives_and_margins, admitted)
        self.meter.note(objectives, margins.min(axis=-1) >= -FEASIBILITY_TOLERANCE)
        if len(admitted) < len(designs):
            raise EndOfRunError
        return objectives, margins
