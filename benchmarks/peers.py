"""The searches that `search.py` compares: each runs until its budget of evaluations is spent."""

from __future__ import annotations

import random
import warnings
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from deap import base, creator, tools
from metering import MeteredProblem, MeteredSpace
from numpy.typing import NDArray
from scipy.optimize import NonlinearConstraint, differential_evolution

from optimize import SearchSettings, search
from optimize.constraints import FEASIBILITY_TOLERANCE
from optimize.refinement import refine

Array = NDArray[np.float64]


class Task(NamedTuple):
    """What a peer is given: metered problem and space, our settings, and the seed."""

    problem: MeteredProblem
    space: MeteredSpace
    settings: SearchSettings
    seed: int


# -- ours ----------------------------------------------------------------------------------------


def our_search(task: Task) -> None:
    """`optimize.search`: genetic algorithm, then refinement of its best designs."""
    rng = np.random.default_rng(task.seed)
    search(task.problem, task.space, settings=task.settings, rng=rng)


def our_genetic_algorithm(task: Task) -> None:
    """The genetic algorithm alone, with generations as long as the budget lasts."""
    genetic = task.settings.algorithm._replace(generations=10**9)
    our_search(task._replace(settings=SearchSettings(genetic, refinements=0)))


# -- plain DEAP ----------------------------------------------------------------------------------

creator.create("Lexicographic", base.Fitness, weights=(-1.0, -1.0))
creator.create("Formation", list, fitness=creator.Lexicographic)


def plain_deap(task: Task) -> None:
    """The same genetic algorithm as the DEAP manual writes it: one individual at a time."""
    problem, space, settings = task.problem, task.space, task.settings.algorithm
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

# scipy's settings, but for the population: of 3, 4, 11 and 15 (scipy's) members a variable, 4 did
# best over the landscapes, and better than mutation 0.5 with recombination 0.9 or than rand1bin.
# Of the three ways to keep the limits, `constraints=` (Lampinen's rules: no margin may get worse)
# is the strongest at four satellites, and better with every margin than with each limit's worst.
MEMBERS = 4
UNTIL_SPENT = 10**9
Objective = Callable[[Array], Array]


def de_deb(task: Task) -> None:
    """Deb's rules in one number: every feasible formation lies below every infeasible one."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(columns.T))
        infeasible = 1e3 + evaluation.total_violation  # no height error of use reaches 1 km
        return np.where(evaluation.feasible, evaluation.objectives, infeasible)

    evolve(task, score)


def de_penalty(task: Task, *, weight: float = 3.0) -> None:
    """The error, raised in proportion to the violation; of weights 3 and 10 the best."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(columns.T))
        objectives = np.minimum(evaluation.objectives, 1e3)
        return objectives * (1.0 + weight * evaluation.total_violation)

    evolve(task, score)


def de_constraints(task: Task, *, polish: bool = False, refined: bool = False) -> None:
    """scipy's own `constraints=`, given every margin, as our refinement is.

    One evaluation gives the error and the margins; scipy asks for them one after the other, so
    they are remembered in between and count once.
    """
    known: dict[bytes, tuple[float, Array]] = {}

    def scores(columns: Array) -> list[tuple[float, Array]]:
        designs = np.ascontiguousarray(np.atleast_2d(columns.T))
        keys = [design.tobytes() for design in designs]
        new = [index for index, key in enumerate(keys) if key not in known]
        if new:
            objectives, margins = score_all(task, designs[new])
            found = zip(objectives.tolist(), margins, strict=True)
            known.update(zip((keys[index] for index in new), found, strict=True))
        return [known[key] for key in keys]

    def objective(columns: Array) -> Array:
        values = np.array([value for value, _ in scores(columns)])
        return values if columns.ndim > 1 else values[0]

    def margins(columns: Array) -> Array:
        values = np.array([value for _, value in scores(columns)])
        return values.T if columns.ndim > 1 else values[0]

    upper = task.space.upper
    limits = NonlinearConstraint(margins, -FEASIBILITY_TOLERANCE, np.inf)
    # A finish gets the evaluations that our refinement used: those beyond our generations'.
    ours = task.settings.algorithm
    rounds = ours.population * (ours.generations + 1) // (MEMBERS * upper.size) - 1
    if not (polish or refined):
        rounds = UNTIL_SPENT
    best = evolve(task, objective, limits=(limits,), rounds=rounds, polish=polish)
    if refined:
        refine(partial(score_all, task), best, upper=upper, free=2 * task.space.satellites)


def score_all(task: Task, designs: Array) -> tuple[Array, Array]:
    objectives, margins = task.problem.objectives_and_margins(task.space.states(designs))
    return objectives, np.concatenate(margins, axis=-1)


def evolve(
    task: Task,
    objective: Objective,
    *,
    limits: tuple[NonlinearConstraint, ...] = (),
    rounds: int = UNTIL_SPENT,
    polish: bool = False,
) -> Array:
    upper = task.space.upper
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # trust-constr, on a gradient that does not change
        best: Array = differential_evolution(
            objective,
            bounds=list(zip(-upper, upper, strict=True)),
            popsize=MEMBERS,
            maxiter=rounds,
            tol=0.0,
            polish=polish,
            vectorized=True,
            updating="deferred",  # all that a vectorized run can do
            constraints=limits,
            seed=np.random.default_rng(task.seed),
        ).x
    return best


# `search.py` runs `our_search` first: it sets the budget.
PEERS: dict[str, Callable[[Task], None]] = {
    "our genetic algorithm alone": our_genetic_algorithm,
    "DEAP, one at a time": plain_deap,
    "scipy DE, constraints=": de_constraints,
    "scipy DE, Deb's rules": de_deb,
    "scipy DE, penalty": de_penalty,
    "scipy DE, constraints=, polish": partial(de_constraints, polish=True),
    "scipy DE, constraints=, our refine": partial(de_constraints, refined=True),
}
