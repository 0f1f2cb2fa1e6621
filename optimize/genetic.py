"""The genetic algorithm (DEAP): real-coded, feasibility first, one batched call a generation."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from deap import base, tools
from numpy.typing import NDArray

from .problem import Evaluation

Array = NDArray[np.float64]


class GeneticSettings(NamedTuple):
    """Settings of the genetic algorithm.

    Attributes
    ----------
    population : individuals of a generation.
    generations : generations after the first.
    crossover_probability, mutation_probability : of a pair, and of a gene.
    crossover_eta, mutation_eta : crowding of simulated binary crossover and polynomial mutation;
        the larger, the closer children stay to their parents.
    tournament : individuals that compete to become a parent.
    elite : best individuals that survive unchanged.
    """

    population: int = 20
    generations: int = 100
    crossover_probability: float = 0.9
    mutation_probability: float = 0.2
    crossover_eta: float = 10.0
    mutation_eta: float = 20.0
    tournament: int = 2
    elite: int = 1


class GeneticState(NamedTuple):
    """All that the generations to come follow from.

    Attributes
    ----------
    number : of the generation that was evaluated last.
    designs : (P, D) — the population after selection, in its order.
    scores : (P, 2) — total violation and objective of each.
    random : state of the generator that DEAP draws from, as `random.getstate` has it.
    """

    number: int
    designs: Array
    scores: Array
    random: tuple[Any, ...]

    def plain(self) -> dict[str, Any]:
        """As lists of numbers, which JSON can hold; `from_plain` reverses it exactly."""
        version, words, gauss = self.random
        return {
            "number": self.number,
            "designs": self.designs.tolist(),
            "scores": self.scores.tolist(),
            "random": [version, list(words), gauss],
        }

    @classmethod
    def from_plain(cls, data: dict[str, Any]) -> GeneticState:
        """Restore a state from what `plain` gave.

        Parameters
        ----------
        data : from `plain`.
        """
        version, words, gauss = data["random"]
        return cls(
            number=int(data["number"]),
            designs=np.array(data["designs"], dtype=np.float64),
            scores=np.array(data["scores"], dtype=np.float64),
            random=(version, tuple(words), gauss),
        )


class Generation(NamedTuple):
    """One evaluated generation.

    Attributes
    ----------
    number : 0 for the first.
    designs : (P, D) — its individuals.
    evaluation : their scores.
    state : from which the search can go on.
    """

    number: int
    designs: Array
    evaluation: Evaluation
    state: GeneticState


class _Fitness(base.Fitness):  # type: ignore[misc]  # DEAP is untyped
    """(total violation, objective), compared in this order: Deb's feasibility rules.

    A feasible individual has violation 0, so it beats every infeasible one; two feasible ones
    compare by objective, two infeasible ones by violation. No penalty weight is needed.
    """

    weights = (-1.0, -1.0)


class _Individual(list[float]):
    def __init__(self, genes: list[float]) -> None:
        super().__init__(genes)
        self.fitness = _Fitness()


def generations(
    evaluate: Callable[[Array], Evaluation],
    *,
    lower: Array,
    upper: Array,
    settings: GeneticSettings,
    rng: np.random.Generator,
    start: Array | None = None,
    state: GeneticState | None = None,
) -> Iterator[Generation]:
    """Run the genetic algorithm, yielding each generation as it is evaluated.

    Parameters
    ----------
    evaluate : scores (P, D) designs in one call.
    lower, upper : (D,) — the box of the designs.
    settings : of the algorithm.
    rng : the only source of randomness.
    start : (P0, D) — designs that join the first generation, within the box.
    state : of an earlier run with the same arguments, which goes on after that generation; `rng`
        and `start` are then not used.

    Yields
    ------
    Generation — `settings.generations` + 1 of them, less those that `state` has behind it.

    References
    ----------
    Deb 2000, doi:10.1016/S0045-7825(99)00389-8 (feasibility rules); Deb and Agrawal 1995
    (simulated binary crossover); Fortin et al. 2012 (DEAP).
    """
    source = random.Random()  # noqa: S311 - DEAP draws from `random`
    if state is None:
        first = rng.uniform(lower, upper, size=(settings.population, lower.size))
        if start is not None:
            known = np.clip(start[: settings.population], lower, upper)
            first[: len(known)] = known
        population = [_Individual(genes) for genes in first.tolist()]
        source.seed(int(rng.integers(2**63)))
        designs, evaluation = _score(population, evaluate)
        state = _state(0, population, source)
        yield Generation(0, designs, evaluation, state)
    else:
        population = _population(state)
        source.setstate(state.random)
    low, up = lower.tolist(), upper.tolist()
    for number in range(state.number + 1, settings.generations + 1):
        with _deap_draws_from(source):
            children = _children(population, low, up, settings)
        elite = tools.selBest(population, settings.elite)
        designs, evaluation = _score(children, evaluate)
        survivors = tools.selBest(children, len(children) - len(elite))
        population = [*elite, *survivors]
        yield Generation(number, designs, evaluation, _state(number, population, source))


def _state(number: int, population: list[_Individual], source: random.Random) -> GeneticState:
    scores = np.array([individual.fitness.values for individual in population])
    return GeneticState(number, np.array(population), scores, source.getstate())


def _population(state: GeneticState) -> list[_Individual]:
    population = [_Individual(genes) for genes in state.designs.tolist()]
    for individual, scores in zip(population, state.scores.tolist(), strict=True):
        individual.fitness.values = tuple(scores)
    return population


def _score(
    population: list[_Individual], evaluate: Callable[[Array], Evaluation]
) -> tuple[Array, Evaluation]:
    designs = np.array(population)
    evaluation = evaluate(designs)
    for individual, violation, objective in zip(
        population, evaluation.total_violation, evaluation.objectives, strict=True
    ):
        individual.fitness.values = (float(violation), float(objective))
    return designs, evaluation


def _children(
    population: list[_Individual], low: list[float], up: list[float], settings: GeneticSettings
) -> list[_Individual]:
    parents = tools.selTournament(population, len(population), tournsize=settings.tournament)
    children = [_Individual(list(parent)) for parent in parents]
    for one, two in zip(children[::2], children[1::2], strict=False):
        if random.random() < settings.crossover_probability:  # noqa: S311
            tools.cxSimulatedBinaryBounded(one, two, eta=settings.crossover_eta, low=low, up=up)
    for child in children:
        tools.mutPolynomialBounded(
            child,
            eta=settings.mutation_eta,
            low=low,
            up=up,
            indpb=settings.mutation_probability,
        )
    return children


@contextmanager
def _deap_draws_from(source: random.Random) -> Iterator[None]:
    """Let DEAP's operators draw from our stream, and leave the global one as it was found."""
    found = random.getstate()
    random.setstate(source.getstate())
    try:
        yield
    finally:
        source.setstate(random.getstate())
        random.setstate(found)
