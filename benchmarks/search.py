"""Our search against scipy's differential evolution and plain DEAP, at equal evaluations.

    python benchmarks/search.py [--seeds 20] [--quick]

For each seed our `search` (genetic algorithm and SLSQP refinement) runs first; every peer then gets
exactly as many evaluations as it used with that seed, differences for gradients included, of the
same evaluator, in the same process. The peers:

- the genetic algorithm alone, with more generations instead of a refinement;
- plain DEAP: the same operators and settings, formations scored one at a time by `toolbox.map`;
- scipy's differential evolution, vectorized, with three ways to keep the limits, and with two ways
  to end with a local search on the evaluations that our refinement used.

The table gives, over the seeds: the median and the worst region height error (`inf`: nothing
feasible), the share of runs within 0.1 % of the best known and the share that ends feasible; the
median time per run, and the time outside the evaluator (from design vectors to scores) per
evaluation. Times are for this machine: compare the ratios, `/ ours`.
"""

from __future__ import annotations

import os

# Before NumPy is imported: the matrices are small, and threads would only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import random
from collections.abc import Callable
from functools import partial
from time import perf_counter
from typing import NamedTuple

import numpy as np
from deap import base, creator, tools
from metering import BudgetSpentError, Meter, MeteredProblem, MeteredSpace, metered
from numpy.typing import NDArray
from problems import Landscape, landscapes
from scipy.optimize import NonlinearConstraint, differential_evolution

from optimize import GeneticSettings, SearchSettings, search
from optimize.refinement import refine

Array = NDArray[np.float64]


class Task(NamedTuple):
    """What a peer is given: metered problem and space, our settings, and the seed."""

    problem: MeteredProblem
    space: MeteredSpace
    genetic: GeneticSettings
    seed: int


class Run(NamedTuple):
    """One run: best feasible error [m], evaluations, time in all and in the evaluator [s]."""

    best: float
    evaluations: int
    seconds: float
    evaluator_seconds: float


# -- ours ----------------------------------------------------------------------------------------


def ours(task: Task, *, refinements: int = 8, generations: int | None = None) -> None:
    """`optimize.search`."""
    genetic = task.genetic._replace(generations=generations or task.genetic.generations)
    search(
        task.problem,
        task.space,
        settings=SearchSettings(genetic, refinements),
        rng=np.random.default_rng(task.seed),
    )


# -- plain DEAP ----------------------------------------------------------------------------------

creator.create("Lexicographic", base.Fitness, weights=(-1.0, -1.0))
creator.create("Formation", list, fitness=creator.Lexicographic)


def plain_deap(task: Task) -> None:
    """The same genetic algorithm as the DEAP manual writes it: one individual at a time."""
    problem, space, settings, _ = task
    random.seed(task.seed)
    upper = space.upper.tolist()
    lower = [-bound for bound in upper]

    def score(individual: list[float]) -> tuple[float, float]:
        evaluation = problem.evaluate(space.states(np.array([individual])))
        return float(evaluation.total_violation[0]), float(evaluation.objectives[0])

    box = {"low": lower, "up": upper}
    toolbox = base.Toolbox()
    toolbox.register("evaluate", score)
    toolbox.register("mate", tools.cxSimulatedBinaryBounded, eta=settings.crossover_eta, **box)
    toolbox.register(
        "mutate",
        tools.mutPolynomialBounded,
        eta=settings.mutation_eta,
        indpb=settings.mutation_probability,
        **box,
    )
    toolbox.register("select", tools.selTournament, tournsize=settings.tournament)
    population = [
        creator.Formation(random.uniform(-bound, bound) for bound in upper)
        for _ in range(settings.population)
    ]
    children = population
    elite: list[list[float]] = []
    while True:  # until the budget is spent
        for child, fitness in zip(children, toolbox.map(toolbox.evaluate, children), strict=True):
            child.fitness.values = fitness
        population = [*elite, *tools.selBest(children, len(children) - len(elite))]
        elite = tools.selBest(population, settings.elite)
        children = [toolbox.clone(parent) for parent in toolbox.select(population, len(population))]
        for one, two in zip(children[::2], children[1::2], strict=False):
            if random.random() < settings.crossover_probability:
                toolbox.mate(one, two)
        for child in children:
            toolbox.mutate(child)


# -- scipy's differential evolution --------------------------------------------------------------

Score = Callable[[Array], Array]


def deb_rules(task: Task) -> Score:
    """Deb's rules in one number: every feasible formation below every infeasible one."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(np.atleast_2d(columns.T)))
        infeasible = 1e3 + evaluation.total_violation  # errors of use are below 1 km
        return np.where(evaluation.feasible, evaluation.objectives, infeasible)

    return score


def penalty(task: Task, *, weight: float = 10.0) -> Score:
    """The error, raised by a factor that grows with the violation."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(np.atleast_2d(columns.T)))
        objectives = np.minimum(evaluation.objectives, 1e3)
        return objectives * (1.0 + weight * evaluation.total_violation)

    return score


def evolve(
    task: Task,
    score: Score,
    *,
    popsize: int = 15,
    mutation: float | tuple[float, float] = 0.5,
    recombination: float = 0.9,
    generations: int = 10**9,
    polish: bool = False,
    constraints: tuple[NonlinearConstraint, ...] = (),
) -> Array:
    upper = task.space.upper
    return differential_evolution(
        score,
        bounds=list(zip(-upper, upper, strict=True)),
        popsize=popsize,
        mutation=mutation,
        recombination=recombination,
        maxiter=generations,
        tol=0.0,
        polish=polish,
        vectorized=True,
        updating="deferred",
        constraints=constraints,
        rng=np.random.default_rng(task.seed),
    ).x
