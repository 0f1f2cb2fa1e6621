"""The genetic algorithm (DEAP): real-coded, feasibility first."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from deap import base, tools
from numpy.typing import NDArray

from .islands import COLLAPSED, SearchMethod, first_designs, own_seed
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

    population: int = 40
    generations: int = 25
    crossover_probability: float = 0.9
    mutation_probability: float = 0.2
    crossover_eta: float = 10.0
    mutation_eta: float = 20.0
    tournament: int = 2
    elite: int = 1

    @property
    def method(self) -> SearchMethod:
        """Which algorithm these are the settings of."""
        return SearchMethod.GENETIC

    def begin(
        self, *, lower: Array, upper: Array, rng: np.random.Generator, start: Array | None
    ) -> GeneticPopulation:
        """Begin a population anywhere in the box.

        Parameters
        ----------
        lower, upper : (D,) — the box.
        rng : draws the first designs and seeds the population's own stream; not kept.
        start : (P0, D) — designs that join the first ones, within the box.
        """
        first = first_designs(rng, self.population, lower=lower, upper=upper, start=start)
        source = random.Random(own_seed(rng))  # noqa: S311 - DEAP draws from it
        children = [Individual(genes) for genes in first.tolist()]
        return GeneticPopulation(self, lower, upper, [], source, children)

    def restore(self, data: dict[str, Any], *, lower: Array, upper: Array) -> GeneticPopulation:
        """Restore a population from `GeneticPopulation.plain`.

        Parameters
        ----------
        data : the plain data.
        lower, upper : (D,) — the box.
        """
        version, words, gauss = data["random"]
        source = random.Random()  # noqa: S311
        source.setstate((version, tuple(words), gauss))
        individuals = [Individual(genes) for genes in data["designs"]]
        if data["scores"] is None:  # a new beginning, not scored yet
            return GeneticPopulation(self, lower, upper, [], source, individuals)
        for individual, scores in zip(individuals, data["scores"], strict=True):
            individual.fitness.values = tuple(scores)
        return GeneticPopulation(self, lower, upper, individuals, source, [])


class Fitness(base.Fitness):  # type: ignore[misc]  # DEAP is untyped
    """(total violation, objective), compared in this order: Deb's feasibility rules.

    A feasible individual has violation 0, so it beats every infeasible one; two feasible ones
    compare by objective, two infeasible ones by violation. No penalty weight is needed.
    """

    weights = (-1.0, -1.0)


class Individual(list[float]):
    """A design as DEAP takes it: a list of genes with a fitness.

    Parameters
    ----------
    genes : the D design variables.
    """

    def __init__(self, genes: list[float]) -> None:
        super().__init__(genes)
        self.fitness = Fitness()


@dataclass
class GeneticPopulation:
    """A population of the genetic algorithm.

    Attributes
    ----------
    settings : of the algorithm.
    lower, upper : (D,) — the box.
    members : the population after selection; empty before the first is scored.
    source : what DEAP draws from.
    children : proposed and not scored yet.

    References
    ----------
    Deb 2000, doi:10.1016/S0045-7825(99)00389-8 (feasibility rules); Deb and Agrawal 1995
    (simulated binary crossover); Fortin et al. 2012 (DEAP).
    """

    settings: GeneticSettings
    lower: Array
    upper: Array
    members: list[Individual]
    source: random.Random
    children: list[Individual]

    def propose(self) -> Array:
        """Children of the population; the first designs themselves at the beginning."""
        if self.members:
            with _deap_draws_from(self.source):
                self.children = _children(
                    self.members, self.lower.tolist(), self.upper.tolist(), self.settings
                )
        return np.array(self.children)

    def learn(self, evaluation: Evaluation) -> None:
        """Let the best of the children, and the elite of their parents, survive.

        Parameters
        ----------
        evaluation : of the children.
        """
        for individual, violation, objective in zip(
            self.children, evaluation.total_violation, evaluation.objectives, strict=True
        ):
            individual.fitness.values = (float(violation), float(objective))
        if not self.members:
            self.members = self.children
            return
        elite = tools.selBest(self.members, self.settings.elite)
        survivors = tools.selBest(self.children, len(self.children) - len(elite))
        self.members = [*elite, *survivors]

    @property
    def collapsed(self) -> bool:
        """Whether all designs agree to a thousandth of the box in every variable."""
        spread = np.ptp(np.array(self.members), axis=0)
        return bool(np.all(spread < COLLAPSED * (self.upper - self.lower)))

    @property
    def champion(self) -> tuple[Array, Array]:
        """The best design and its scores."""
        best = tools.selBest(self.members, 1)[0]
        return np.array(best), np.array(best.fitness.values)

    def welcome(self, design: Array, scores: Array) -> None:
        """Let a design take the place of the worst one.

        Parameters
        ----------
        design : (D,)
        scores : its (violation, objective).
        """
        worst = tools.selWorst(self.members, 1)[0]
        guest = Individual(design.tolist())
        guest.fitness.values = tuple(scores.tolist())
        if guest.fitness > worst.fitness:
            place = next(i for i, member in enumerate(self.members) if member is worst)
            self.members[place] = guest

    def plain(self) -> dict[str, Any]:
        """Designs, scores and random state, as plain data."""
        version, words, gauss = self.source.getstate()
        scores = [list(member.fitness.values) for member in self.members]
        return {
            "designs": [list(one) for one in self.members or self.children],
            "scores": scores or None,
            "random": [version, list(words), gauss],
        }


def _children(
    population: list[Individual], low: list[float], up: list[float], settings: GeneticSettings
) -> list[Individual]:
    parents = tools.selTournament(population, len(population), tournsize=settings.tournament)
    children = [Individual(list(parent)) for parent in parents]
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
