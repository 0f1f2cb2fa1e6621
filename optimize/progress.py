"""What a search has behind it, as plain data: enough to go on as if it had never stopped.

A search is a sequence of steps: each generation, then each refined candidate. After every step it
hands its `Keeper` the step and the state that the next one follows from, all of numbers, texts,
lists and dictionaries. Where they are kept is the keeper's affair; none of it is code.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class GenerationRecord(NamedTuple):
    """One line of the convergence history.

    Attributes
    ----------
    generation : 0 for the first; the refinement adds one line at the end.
    evaluations : formations scored so far.
    best : best region height error of a feasible formation so far [m]; `inf` before the first.
    mean : mean region height error of the generation's feasible formations [m]; NaN without any.
    feasible_fraction : share of the generation that is feasible.
    refinement : whether this is the local refinement, which is no generation: its mean and
        feasible fraction are NaN.
    """

    generation: int
    evaluations: int
    best: float
    mean: float
    feasible_fraction: float
    refinement: bool = False


class Candidate(NamedTuple):
    """A design with its scores; the smaller tuple of the first two is the better one.

    Attributes
    ----------
    violation : total violation.
    objective : region height error [m].
    design : (D,)
    """

    violation: float
    objective: float
    design: Array


class Step(NamedTuple):
    """One finished step of a search.

    Attributes
    ----------
    evaluations : formations scored so far.
    candidates : the best designs that the step brought.
    record : the line of the history, of a generation; None of a refined candidate.
    """

    evaluations: int
    candidates: tuple[Candidate, ...]
    record: GenerationRecord | None = None

    def plain(self) -> dict[str, Any]:
        """As plain data, which `from_plain` reverses exactly."""
        return {
            "evaluations": self.evaluations,
            "candidates": [
                [violation, objective, design.tolist()]
                for violation, objective, design in self.candidates
            ],
            "record": None if self.record is None else list(self.record),
        }

    @classmethod
    def from_plain(cls, data: dict[str, Any]) -> Step:
        """Restore a step from what `plain` gave.

        Parameters
        ----------
        data : from `plain`.
        """
        return cls(
            evaluations=data["evaluations"],
            candidates=tuple(
                Candidate(violation, objective, np.array(design, dtype=np.float64))
                for violation, objective, design in data["candidates"]
            ),
            record=None if data["record"] is None else GenerationRecord(*data["record"]),
        )


class Keeper(Protocol):
    """Keeps the steps of a search, so that another run of it can go on after the last one."""

    def restore(self) -> tuple[Sequence[dict[str, Any]], dict[str, Any] | None]:
        """Steps that an earlier run has behind it, oldest first, and its state; none to begin."""
        ...

    def keep(self, step: dict[str, Any], state: dict[str, Any] | None) -> None:
        """Keep a step and the state after it: when this returns, nothing can lose them.

        Parameters
        ----------
        step : from `Step.plain`.
        state : all that the search goes on from; None for the state of the step before.
        """
        ...


class Forgetful:
    """A `Keeper` that keeps nothing."""

    def restore(self) -> tuple[Sequence[dict[str, Any]], dict[str, Any] | None]:
        """Nothing to go on from."""
        return (), None

    def keep(self, step: dict[str, Any], state: dict[str, Any] | None) -> None:
        """Let it go."""
