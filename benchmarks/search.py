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
import warnings
from collections.abc import Callable
from contextlib import suppress
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

Objective = Callable[[Array], Array]


def de_deb(task: Task) -> None:
    """Deb's rules in one number: every feasible formation lies below every infeasible one."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(columns.T))
        infeasible = 1e3 + evaluation.total_violation  # no height error of use reaches 1 km
        return np.where(evaluation.feasible, evaluation.objectives, infeasible)

    evolve(task, score)


def de_penalty(task: Task, *, weight: float = 3.0) -> None:
    """The error, raised in proportion to the violation; of weights 1, 3 and 10 the best."""

    def score(columns: Array) -> Array:
        evaluation = task.problem.evaluate(task.space.states(columns.T))
        objectives = np.minimum(evaluation.objectives, 1e3)
        return objectives * (1.0 + weight * evaluation.total_violation)

    evolve(task, score)


def de_constraints(task: Task, *, finish: str = "") -> None:
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

    limits = NonlinearConstraint(margins, -1e-9, np.inf)
    best = evolve(task, objective, limits=(limits,), finish=finish)
    if finish == "slsqp":
        free = 2 * task.space.satellites
        refine(partial(score_all, task), best, upper=task.space.upper, free=free)


def score_all(task: Task, designs: Array) -> tuple[Array, Array]:
    objectives, margins = task.problem.objectives_and_margins(task.space.states(designs))
    return objectives, np.concatenate(margins, axis=-1)


def evolve(
    task: Task,
    objective: Objective,
    *,
    limits: tuple[NonlinearConstraint, ...] = (),
    finish: str = "",
) -> Array:
    """Run scipy's differential evolution until the budget is spent, or leave some for a finish.

    scipy's own mutation and recombination with 4 members a variable did best over the landscapes;
    others tried: 3, 11 and 15 (scipy's) members; best1bin with mutation 0.5 and recombination 0.9;
    rand1bin. `constraints=` (Lampinen: no margin may get worse) did best with every margin given.
    """
    upper = task.space.upper
    share = task.genetic.population * (task.genetic.generations + 1)
    rounds = share // (4 * upper.size) - 1 if finish else 10**9
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # trust-constr, on a gradient that does not change
        return differential_evolution(
            objective,
            bounds=list(zip(-upper, upper, strict=True)),
            popsize=4,
            maxiter=rounds,
            tol=0.0,
            polish=finish == "polish",
            vectorized=True,
            updating="deferred",
            constraints=limits,
            seed=np.random.default_rng(task.seed),
        ).x


# -- the comparison ------------------------------------------------------------------------------

PEERS: dict[str, Callable[[Task], None]] = {
    "our search": ours,
    "our genetic algorithm alone": partial(ours, refinements=0, generations=10**6),
    "DEAP, one at a time": plain_deap,
    "scipy DE, constraints=": de_constraints,
    "scipy DE, Deb's rules": de_deb,
    "scipy DE, penalty": de_penalty,
    "scipy DE, constraints=, polish": partial(de_constraints, finish="polish"),
    "scipy DE, constraints=, our refine": partial(de_constraints, finish="slsqp"),
}


def run(peer: Callable[[Task], None], landscape: Landscape, *, seed: int, budget: float) -> Run:
    meter = Meter(budget=budget)
    problem, space = metered(landscape.problem, landscape.space, meter)
    start = perf_counter()
    with suppress(BudgetSpentError):
        peer(Task(problem, space, landscape.genetic, seed))
    return Run(meter.best, meter.evaluations, perf_counter() - start, meter.seconds)


def compare(landscape: Landscape, *, seeds: int) -> None:
    runs: dict[str, list[Run]] = {name: [] for name in PEERS}
    for seed in range(seeds):
        budget = np.inf  # ours runs first and sets the budget of the seed
        for name, peer in PEERS.items():
            runs[name].append(run(peer, landscape, seed=seed, budget=budget))
            budget = runs["our search"][-1].evaluations
    results = {name: np.array(rows) for name, rows in runs.items()}
    known = min(landscape.best_known, *(table[:, 0].min() for table in results.values()))
    used = results["our search"][:, 1]
    print(f"\n{landscape.name}: best known {known:.6f} m, {seeds} seeds")
    print(f"{used.min():.0f} to {used.max():.0f} evaluations a run, the same for all with a seed")
    print(
        f"{'':34} {'median m':>9} {'worst m':>9} {'≤ 0.1 %':>8} {'feasible':>8}"
        f" {'time s':>7} {'/ ours':>6} {'overhead µs':>11} {'/ ours':>6}"
    )
    reference = None
    for name, table in results.items():
        best, evaluations, seconds, inside = table.T
        time = np.median(seconds)
        overhead = np.median((seconds - inside) / evaluations)
        reference = reference or (time, overhead)
        print(
            f"{name:34} {np.median(best):9.5f} {best.max():9.5f}"
            f" {np.mean(best <= 1.001 * known):8.0%} {np.mean(np.isfinite(best)):8.0%}"
            f" {time:7.3f} {time / reference[0]:6.2f}"
            f" {overhead * 1e6:11.1f} {overhead / reference[1]:6.2f}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20, help="runs of each (default 20)")
    parser.add_argument("--quick", action="store_true", help="2 seeds, 10 generations; 20 s")
    options = parser.parse_args()
    for landscape in landscapes(generations=10 if options.quick else None):
        compare(landscape, seeds=min(options.seeds, 2) if options.quick else options.seeds)


if __name__ == "__main__":
    main()
