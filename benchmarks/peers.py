"""The searches that `search.py` compares: each runs until its budget of evaluations is spent."""

from __future__ import annotations

import random
import warnings
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from typing import NamedTuple

import numpy as np
from deap import base, creator, tools
from metering import MeteredEvaluator
from numpy.typing import NDArray
from scipy.optimize import NonlinearConstraint, differential_evolution, dual_annealing

from optimize import (
    CovarianceSettings,
    DesignSpace,
    DifferentialSettings,
    Problem,
    SearchSettings,
    search,
)
from optimize.constraints import FEASIBILITY_TOLERANCE
from optimize.refinement import refine

Array = NDArray[np.float64]


class Task(NamedTuple):
    """What a peer is given: problem, space, a metered evaluator, our settings, and the seed."""

    problem: Problem
    space: DesignSpace
    evaluator: MeteredEvaluator
    settings: SearchSettings
    seed: int


# -- ours ----------------------------------------------------------------------------------------


def our_search(task: Task) -> None:
    """`optimize.search`: genetic algorithm, then refinement of its best designs."""
    rng = np.random.default_rng(task.seed)
    search(task.problem, task.space, settings=task.settings, rng=rng, evaluator=task.evaluator)


def with_algorithm(task: Task, *, algorithm: DifferentialSettings | CovarianceSettings) -> None:
    """The same with another algorithm of the populations, of as many designs."""
    ours = task.settings.algorithm
    sized = algorithm._replace(population=ours.population, generations=ours.generations)
    our_search(task._replace(settings=task.settings._replace(algorithm=sized)))


def without_structure(task: Task) -> None:
    """The same without the refinement of structured designs."""
    our_search(task._replace(settings=task.settings._replace(structured=0)))


def our_genetic_algorithm(task: Task) -> None:
    """The genetic algorithm alone, with generations as long as the budget lasts."""
    genetic = task.settings.algorithm._replace(generations=10**9)
    our_search(task._replace(settings=SearchSettings(genetic, refinements=0, structured=0)))


# -- plain DEAP ----------------------------------------------------------------------------------

creator.create("Lexicographic", base.Fitness, weights=(-1.0, -1.0))
creator.create("Formation", list, fitness=creator.Lexicographic)


def plain_deap(task: Task) -> None:
    """The same genetic algorithm as the DEAP manual writes it: one individual at a time."""
    settings = task.settings.algorithm
    random.seed(task.seed)
    upper = task.space.upper.tolist()
    lower = [-bound for bound in upper]

    def score(individual: list[float]) -> tuple[float, float]:
        evaluation = task.evaluator.evaluate(np.array([individual]))
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
        evaluation = task.evaluator.evaluate(np.ascontiguousarray(columns.T))
        infeasible = 1e3 + evaluation.total_violation  # no height error of use reaches 1 km
        return np.where(evaluation.feasible, evaluation.objectives, infeasible)

    evolve(task, score)


def de_penalty(task: Task, *, weight: float = 3.0) -> None:
    """The error, raised in proportion to the violation; of weights 3 and 10 the best."""

    def score(columns: Array) -> Array:
        evaluation = task.evaluator.evaluate(np.ascontiguousarray(columns.T))
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
            objectives, margins = task.evaluator.objectives_and_margins(designs[new])
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
        score = task.evaluator.objectives_and_margins
        refine(score, best, upper=upper, free=2 * task.space.satellites)


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


# -- libraries that take one number per design -----------------------------------------------------


def scalar(task: Task) -> Callable[[Array], float]:
    """Deb's rules in one number, of one design in the box scaled to ±1."""

    def score(point: Array) -> float:
        return float(scores(task, np.asarray(point, dtype=np.float64)[None])[0])

    return score


def scores(task: Task, points: Array) -> Array:
    """Deb's rules in one number, of (P, D) designs in the box scaled to ±1."""
    designs = np.clip(points, -1.0, 1.0) * task.space.upper
    evaluation = task.evaluator.evaluate(designs)
    return np.where(evaluation.feasible, evaluation.objectives, 1e3 + evaluation.total_violation)


def annealing(task: Task) -> None:
    """scipy's dual annealing, its local searches included, one formation at a time."""
    dual_annealing(
        scalar(task),
        bounds=[(-1.0, 1.0)] * task.space.dimension,
        maxiter=UNTIL_SPENT,
        rng=np.random.default_rng(task.seed),
    )


def pycma(task: Task) -> None:
    """pycma with restarts of doubling population, a generation in one batch."""
    import cma

    score = partial(scores, task)
    dimension, population, run = task.space.dimension, 4 + int(3 * np.log(task.space.dimension)), 0
    rng = np.random.default_rng(task.seed)
    while True:  # until the budget is spent
        options = {
            "bounds": [-1.0, 1.0],
            "seed": task.seed * 1000 + run + 1,
            "popsize": population * 2**run,
            "verbose": -9,
        }
        strategy = cma.CMAEvolutionStrategy(rng.uniform(-0.6, 0.6, dimension), 0.4, options)
        while not strategy.stop():
            points = strategy.ask()
            strategy.tell(points, score(np.array(points)).tolist())
        run = min(run + 1, 6)


def pymoo(task: Task, *, algorithm: str) -> None:
    """pymoo's GA, DE or CMA-ES with its own rules for the limits, a generation in one batch."""
    from pymoo.algorithms.soo.nonconvex.cmaes import CMAES
    from pymoo.algorithms.soo.nonconvex.de import DE
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.core.problem import Problem as PymooProblem
    from pymoo.optimize import minimize

    dimension = task.space.dimension
    constrained = algorithm != "CMA-ES"  # pymoo's takes no constraints: Deb's rules in one number

    class Formation(PymooProblem):
        def __init__(self) -> None:
            limits = len(task.problem.limits) if constrained else 0
            super().__init__(n_var=dimension, n_obj=1, n_ieq_constr=limits, xl=-1.0, xu=1.0)

        def _evaluate(self, points, out, *_args, **_kwargs):  # type: ignore[no-untyped-def]
            if not constrained:
                out["F"] = scores(task, np.atleast_2d(points))
                return
            evaluation = task.evaluator.evaluate(points * task.space.upper)
            out["F"] = np.minimum(evaluation.objectives, 1e3)
            out["G"] = evaluation.violations

    chosen = {
        "GA": lambda: GA(pop_size=60),
        "DE": lambda: DE(pop_size=MEMBERS * dimension),
        "CMA-ES": lambda: CMAES(restarts=9, bipop=True),
    }[algorithm]()
    run = 0
    while True:  # until the budget is spent: a run that ends early begins anew
        minimize(Formation(), chosen, ("n_gen", UNTIL_SPENT), seed=task.seed * 1000 + run)
        run += 1


def pygmo(task: Task, *, algorithm: str) -> None:
    """pygmo's self-adaptive DE or CMA-ES; it asks for one formation at a time."""
    import pygmo as pg

    score, dimension = scalar(task), task.space.dimension

    class Formation:
        def fitness(self, point: Array) -> list[float]:
            return [score(point)]

        def get_bounds(self) -> tuple[list[float], list[float]]:
            return [-1.0] * dimension, [1.0] * dimension

    method = {"sade": pg.sade, "CMA-ES": partial(pg.cmaes, force_bounds=True)}[algorithm]
    run = 0
    while True:  # until the budget is spent: the last call raises in the middle
        evolution = pg.algorithm(method(gen=100, seed=task.seed * 1000 + run))
        population = pg.population(
            pg.problem(Formation()), size=MEMBERS * dimension, seed=task.seed
        )
        for _ in range(20):
            population = evolution.evolve(population)
        run += 1


# `search.py` runs `our_search` first: it sets the budget.
PEERS: dict[str, Callable[[Task], None]] = {
    "ours, differential evolution": partial(with_algorithm, algorithm=DifferentialSettings()),
    "ours, CMA-ES": partial(with_algorithm, algorithm=CovarianceSettings()),
    "ours, no structured designs": without_structure,
    "our genetic algorithm alone": our_genetic_algorithm,
    "scipy DE, constraints=": de_constraints,
    "scipy DE, Deb's rules": de_deb,
    "scipy dual annealing": annealing,
}
OTHERS: dict[str, Callable[[Task], None]] = {
    "DEAP, one at a time": plain_deap,
    "scipy DE, penalty": de_penalty,
    "scipy DE, constraints=, polish": partial(de_constraints, polish=True),
    "scipy DE, constraints=, our refine": partial(de_constraints, refined=True),
}
"""Those that are left out where time is short."""
if find_spec("pymoo"):
    PEERS |= {f"pymoo {name}": partial(pymoo, algorithm=name) for name in ("GA", "DE", "CMA-ES")}
if find_spec("pygmo"):
    PEERS |= {f"pygmo {name}": partial(pygmo, algorithm=name) for name in ("sade", "CMA-ES")}
if find_spec("cma"):
    PEERS["pycma, restarts"] = pycma
SLOW = ("scipy dual annealing", "pymoo GA", "pymoo DE", "pygmo sade")
"""Peers that take 0.1 ms and more for each design, and hardly ever come near the optimum."""
