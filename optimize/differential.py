"""Differential evolution with Deb's feasibility rules, a whole generation in one batch.

The algorithm is a few lines of array arithmetic. scipy's `differential_evolution` is not used: it
can neither be stopped and resumed from plain data nor share a batch with other populations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .islands import COLLAPSED, SearchMethod, first_designs, own_seed
from .problem import Evaluation

Array = NDArray[np.float64]


class DifferentialSettings(NamedTuple):
    """Settings of differential evolution (rand-to-best/1/bin).

    Attributes
    ----------
    population : members, at least 5.
    generations : generations after the first.
    scale : smallest and largest scale F of a difference, drawn anew for each child.
    crossover : probability that a variable comes from the mutant.
    """

    population: int = 40
    generations: int = 60
    scale: tuple[float, float] = (0.5, 1.0)
    crossover: float = 0.9

    @property
    def method(self) -> SearchMethod:
        """Which algorithm these are the settings of."""
        return SearchMethod.DIFFERENTIAL_EVOLUTION

    def begin(
        self, *, lower: Array, upper: Array, rng: np.random.Generator, start: Array | None
    ) -> DifferentialPopulation:
        """Begin a population anywhere in the box.

        Parameters
        ----------
        lower, upper : (D,) — the box.
        rng : draws the first designs and seeds the population's own stream; not kept.
        start : (P0, D) — designs that join the first ones, within the box.
        """
        first = first_designs(rng, self.population, lower=lower, upper=upper, start=start)
        stream = np.random.default_rng(own_seed(rng))
        return DifferentialPopulation(self, lower, upper, first, None, stream)

    def restore(
        self, data: dict[str, Any], *, lower: Array, upper: Array
    ) -> DifferentialPopulation:
        """Restore a population from `DifferentialPopulation.plain`.

        Parameters
        ----------
        data : the plain data.
        lower, upper : (D,) — the box.
        """
        stream = np.random.default_rng()
        stream.bit_generator.state = data["random"]
        scores = None if data["scores"] is None else np.array(data["scores"])
        return DifferentialPopulation(self, lower, upper, np.array(data["designs"]), scores, stream)


@dataclass
class DifferentialPopulation:
    """A population of differential evolution.

    Attributes
    ----------
    settings : of the algorithm.
    lower, upper : (D,) — the box.
    members : (P, D) — the population.
    scores : (P, 2) — violation and objective of each; None before they are known.
    rng : its own stream.

    References
    ----------
    Storn and Price 1997, doi:10.1023/A:1008202821328; Deb 2000,
    doi:10.1016/S0045-7825(99)00389-8 (feasibility rules).
    """

    settings: DifferentialSettings
    lower: Array
    upper: Array
    members: Array
    scores: Array | None
    rng: np.random.Generator
    _children: Array | None = None

    def propose(self) -> Array:
        """Children of the population; the first designs themselves at the beginning."""
        if self.scores is None:
            self._children = self.members
            return self.members
        members, (count, size) = self.members, self.members.shape
        best = members[self._order()[0]]
        # Two other members for each: the next places of a random order, one order each.
        others = np.argsort(self.rng.random((count, count - 1)), axis=-1)[:, :2]
        others += others >= np.arange(count)[:, None]
        low, high = self.settings.scale
        scale = self.rng.uniform(low, high, size=(count, 1))
        mutants = members + scale * (best - members + members[others[:, 0]] - members[others[:, 1]])
        crossed = self.rng.random((count, size)) < self.settings.crossover
        crossed[np.arange(count), self.rng.integers(size, size=count)] = True
        children = np.where(crossed, mutants, members)
        # Outside the box: half way back to the bound, which neither piles up there nor forgets.
        children = np.where(children < self.lower, 0.5 * (members + self.lower), children)
        self._children = np.where(children > self.upper, 0.5 * (members + self.upper), children)
        return self._children

    def learn(self, evaluation: Evaluation) -> None:
        """Let each child that is no worse take the place of its parent.

        Parameters
        ----------
        evaluation : of the children.
        """
        if self._children is None:
            raise ValueError("learn() before propose(): nothing was proposed")
        scores = np.stack([evaluation.total_violation, evaluation.objectives], axis=-1)
        if self.scores is None:
            self.scores = scores
            return
        old = self.scores
        better = (scores[:, 0] < old[:, 0]) | (
            (scores[:, 0] == old[:, 0]) & (scores[:, 1] <= old[:, 1])
        )
        self.members = np.where(better[:, None], self._children, self.members)
        self.scores = np.where(better[:, None], scores, old)

    @property
    def collapsed(self) -> bool:
        """Whether all designs agree to a thousandth of the box in every variable."""
        spread = np.ptp(self.members, axis=0)
        return bool(np.all(spread < COLLAPSED * (self.upper - self.lower)))

    @property
    def champion(self) -> tuple[Array, Array]:
        """The best design and its scores."""
        best = self._order()[0]
        return self.members[best].copy(), self._known()[best].copy()

    def welcome(self, design: Array, scores: Array) -> None:
        """Let a design take the place of the worst one.

        Parameters
        ----------
        design : (D,)
        scores : its (violation, objective).
        """
        worst = self._order()[-1]
        if tuple(scores) < tuple(self._known()[worst]):
            self.members[worst], self._known()[worst] = design, scores

    def plain(self) -> dict[str, Any]:
        """Designs, scores and random state, as plain data."""
        return {
            "designs": self.members.tolist(),
            "scores": None if self.scores is None else self.scores.tolist(),
            "random": self.rng.bit_generator.state,
        }

    def _known(self) -> Array:
        if self.scores is None:
            raise ValueError("the population has not been scored yet")
        return self.scores

    def _order(self) -> NDArray[np.intp]:
        scores = self._known()
        return np.lexsort((scores[:, 1], scores[:, 0]))
