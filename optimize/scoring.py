"""Scores the designs of a search, by arrays or a faster evaluator, and counts them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .design_space import DesignSpace
from .gradient import DesignSlopes, design_slopes
from .problem import Evaluation, Problem

Array = NDArray[np.float64]

_CLOSED_FORM_FROM = 6
"""Satellites from which derivatives in closed form take less time than a batch of differences."""

_CLOSED_FORM_BEYOND_LOOPS_FROM = 32
"""The same where compiled loops score the batch."""


class Evaluator(Protocol):
    """Scores designs; the arrays of `Problem` do, and the compiled loops."""

    def evaluate(self, designs: Array) -> Evaluation:
        """Score designs.

        Parameters
        ----------
        designs : (P, D) — design vectors.
        """
        ...

    def objectives_and_margins(self, designs: Array) -> tuple[Array, Array]:
        """Height errors (P,) [m] and the margins of all limited items (P, items) of designs.

        Parameters
        ----------
        designs : (P, D) — design vectors.
        """
        ...


@dataclass
class Scorer:
    """What scores the designs of one search, and how many it has scored.

    Parameters
    ----------
    problem, space : what is minimized, and the designs.
    should_stop : asked before each step of a descent; True ends the search.
    evaluator : scores the designs; None: the arrays of the problem.
    evaluations : formations scored so far.
    """

    problem: Problem
    space: DesignSpace
    should_stop: Callable[[], bool]
    evaluator: Evaluator | None
    evaluations: int = 0

    def evaluate(self, designs: Array) -> Evaluation:
        """Scores of a generation of designs."""
        self.evaluations += len(designs)
        if self.evaluator is not None:
            return self.evaluator.evaluate(designs)
        return self.problem.evaluate(self.space.states(designs))

    def score(self, designs: Array) -> tuple[Array, Array]:
        """Height errors and the margins of all limited items of designs, for a descent."""
        if self.should_stop():
            raise KeyboardInterrupt
        self.evaluations += len(designs)
        if self.evaluator is not None:
            return self.evaluator.objectives_and_margins(designs)
        objectives, margins = self.problem.objectives_and_margins(self.space.states(designs))
        return objectives, np.concatenate([np.empty((len(designs), 0)), *margins], axis=-1)

    def differentiate(self, design: Array) -> DesignSlopes | None:
        """Scores of a design with their derivatives; None where differences take less time."""
        slopes = self._slopes(design)
        if slopes is not None:
            if self.should_stop():
                raise KeyboardInterrupt
            self.evaluations += 1
        return slopes

    @cached_property
    def _slopes(self) -> Callable[[Array], DesignSlopes | None]:
        first = _CLOSED_FORM_FROM if self.evaluator is None else _CLOSED_FORM_BEYOND_LOOPS_FROM
        if self.space.satellites < first:
            return lambda _design: None
        return design_slopes(self.problem, self.space)
