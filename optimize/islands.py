"""Populations that search side by side: generations, migration and new beginnings.

An algorithm (genetic, differential evolution, CMA-ES) is a population that proposes designs and
learns from their scores. Several of them are islands: they are scored together, in one batch, and
now and then the best design of one reaches the next.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import StrEnum
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .problem import Evaluation

Array = NDArray[np.float64]


COLLAPSED = 1e-3
"""Extent of a population, in parts of the box, at which it finds nothing new."""


class SearchMethod(StrEnum):
    """Which algorithm improves the populations."""

    GENETIC = "genetic"
    DIFFERENTIAL_EVOLUTION = "differential_evolution"
    CMA_ES = "cma_es"


class Population(Protocol):
    """Designs that one algorithm improves; all its randomness is its own."""

    def propose(self) -> Array:
        """Designs to score next, (P, D)."""
        ...

    def learn(self, evaluation: Evaluation) -> None:
        """Take the scores of the designs proposed last.

        Parameters
        ----------
        evaluation : of them, in their order.
        """
        ...

    @property
    def collapsed(self) -> bool:
        """Whether its designs are so much alike that nothing new is to be expected."""
        ...

    @property
    def champion(self) -> tuple[Array, Array]:
        """Its best design (D,) and that design's (violation, objective)."""
        ...

    def welcome(self, design: Array, scores: Array) -> None:
        """Take in a design from another island, where the algorithm can.

        Parameters
        ----------
        design : (D,)
        scores : its (violation, objective).
        """
        ...

    def plain(self) -> dict[str, Any]:
        """All that the designs to come follow from, as plain data."""
        ...


class Algorithm(Protocol):
    """Settings of an algorithm, and how its populations begin."""

    @property
    def method(self) -> SearchMethod:
        """Which one it is."""
        ...

    @property
    def population(self) -> int:
        """Designs of a generation."""
        ...

    @property
    def generations(self) -> int:
        """Generations after the first."""
        ...

    def begin(
        self, *, lower: Array, upper: Array, rng: np.random.Generator, start: Array | None
    ) -> Population:
        """Begin a population anywhere in the box.

        Parameters
        ----------
        lower, upper : (D,) — the box.
        rng : draws the first designs and seeds the population's own stream; not kept.
        start : (P0, D) — designs that it should know from the first.
        """
        ...

    def restore(self, data: dict[str, Any], *, lower: Array, upper: Array) -> Population:
        """Restore a population from its `Population.plain`.

        Parameters
        ----------
        data : from `Population.plain`.
        lower, upper : (D,) — the box.
        """
        ...


def first_designs(
    rng: np.random.Generator, count: int, *, lower: Array, upper: Array, start: Array | None
) -> Array:
    """Designs of a population that begins anywhere in the box.

    Parameters
    ----------
    rng : draws them.
    count : how many.
    lower, upper : (D,) — the box.
    start : (P0, D) — designs that take the places of the first ones, moved into the box.

    Returns
    -------
    (count, D)
    """
    designs = rng.uniform(lower, upper, size=(count, lower.size))
    if start is not None:
        known = np.clip(start[:count], lower, upper)
        designs[: len(known)] = known
    return designs


def own_seed(rng: np.random.Generator) -> int:
    """Seed of the stream that a population keeps for itself.

    Parameters
    ----------
    rng : draws it.
    """
    return int(rng.integers(2**63))


class IslandSettings(NamedTuple):
    """How many populations search, and what they have to do with each other.

    Attributes
    ----------
    number : of islands, each with a population of its own.
    migration_interval : generations from one migration to the next.
    restart : whether a population that has collapsed begins anew, with fresh designs.
    """

    number: int = 1
    migration_interval: int = 10
    restart: bool = True


class Generation(NamedTuple):
    """One evaluated generation of all islands.

    Attributes
    ----------
    number : 0 for the first.
    designs : (P, D) — its designs, island by island.
    evaluation : their scores.
    state : from which the search can go on, as plain data.
    """

    number: int
    designs: Array
    evaluation: Evaluation
    state: dict[str, Any]


def generations(
    evaluate: Callable[[Array], Evaluation],
    *,
    lower: Array,
    upper: Array,
    algorithm: Algorithm,
    rng: np.random.Generator,
    islands: IslandSettings | None = None,
    start: Array | None = None,
    state: dict[str, Any] | None = None,
) -> Iterator[Generation]:
    """Run an algorithm on its islands, yielding each generation as it is evaluated.

    Parameters
    ----------
    evaluate : scores (P, D) designs in one call.
    lower, upper : (D,) — the box of the designs.
    algorithm : its settings.
    rng : the only source of randomness.
    islands : how many populations, and how they exchange designs; one by default.
    start : (P0, D) — designs that join the first island's first generation, within the box.
    state : of an earlier run with the same arguments, which goes on after that generation; the
        state of `rng` is then taken from it, and `start` is not used.

    Yields
    ------
    Generation — `algorithm.generations` + 1 of them, less those that `state` has behind it.
    """
    islands = islands or IslandSettings()
    box = {"lower": lower, "upper": upper}
    if state is None:
        populations = [
            algorithm.begin(**box, rng=rng, start=None if index else start)
            for index in range(islands.number)
        ]
        first = 0
    else:
        rng.bit_generator.state = state["random"]
        populations = [algorithm.restore(data, **box) for data in state["populations"]]
        first = state["number"] + 1
    for number in range(first, algorithm.generations + 1):
        proposed = [population.propose() for population in populations]
        designs = np.concatenate(proposed)
        evaluation = evaluate(designs)
        ends = np.cumsum([len(part) for part in proposed])[:-1]
        for population, objectives, violations in zip(
            populations,
            np.split(evaluation.objectives, ends),
            np.split(evaluation.violations, ends),
            strict=True,
        ):
            population.learn(Evaluation(objectives, violations))
        if number and number % islands.migration_interval == 0:
            _migrate(populations)
        if islands.restart:
            populations = [
                algorithm.begin(**box, rng=rng, start=None) if population.collapsed else population
                for population in populations
            ]
        yield Generation(number, designs, evaluation, _state(number, populations, rng))


def _migrate(populations: list[Population]) -> None:
    """Let the best design of each island reach the next one, around a ring."""
    if len(populations) == 1:
        return
    champions = [population.champion for population in populations]
    for population, (design, scores) in zip(
        populations, [champions[-1], *champions[:-1]], strict=True
    ):
        population.welcome(design, scores)


def _state(number: int, populations: list[Population], rng: np.random.Generator) -> dict[str, Any]:
    return {
        "number": number,
        "random": rng.bit_generator.state,
        "populations": [population.plain() for population in populations],
    }
