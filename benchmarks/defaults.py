"""Candidate default settings of the search over many problems, as studies describe them.

    python benchmarks/defaults.py [--problems 42] [--seeds 2] [--first 0]

The problems are drawn from a seed: 2 to 8 satellites, both families, X, C and L band at 400 to
800 km, 6 to 48 looks, joint and pairwise weighting, filtered, unfiltered and no decorrelation, with
and without an elevation model to unwrap by. Each candidate runs from every seed; the best known is
the best of all runs on a problem. The table gives the share of runs within 1e-4 and 1e-2 of it, the
share that ends feasible where a feasible design is known, the worst, the formations scored and the
CPU time, means over the runs. Compiled loops score what they know, where numba is installed.
"""

from __future__ import annotations

import os

# Before NumPy is imported: BLAS reads it once, and threads only slow such small matrices down.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
from collections import defaultdict
from time import process_time

import numpy as np
from problems import Landscape, random_study

from optimize import (
    CovarianceSettings,
    DifferentialSettings,
    GeneticSettings,
    IslandSettings,
    SearchSettings,
    search,
)
from optimize.kernel import compiled_evaluator
from optimize.scoring import Evaluator


def genetic(
    population: int, generations: int, refinements: int, structured: int, islands: int = 1
) -> SearchSettings:
    """Settings with a genetic algorithm."""
    return SearchSettings(
        GeneticSettings(population=population, generations=generations),
        refinements,
        IslandSettings(islands),
        structured,
    )


STRONGEST = "genetic 60 × 40, 24 + 12"
CANDIDATES = {
    STRONGEST: genetic(60, 40, 24, 12),
    "genetic 60 × 40, 24 + 0": genetic(60, 40, 24, 0),
    "genetic 60 × 40, 6 + 0": genetic(60, 40, 6, 0),
    "genetic 60 × 160, 6 + 0": genetic(60, 160, 6, 0),
    "genetic 60 × 40, 0 + 4": genetic(60, 40, 0, 4),
    "genetic 60 × 40, 6 + 4": genetic(60, 40, 6, 4),
    "genetic 60 × 40, 12 + 4": genetic(60, 40, 12, 4),
    "genetic 60 × 40, 6 + 8": genetic(60, 40, 6, 8),
    "genetic 40 × 25, 6 + 4": genetic(40, 25, 6, 4),
    "genetic 40 × 25, 4 + 6": genetic(40, 25, 4, 6),
    "genetic 20 × 10, 6 + 4": genetic(20, 10, 6, 4),
    "genetic 4 islands of 15 × 40, 6 + 4": genetic(15, 40, 6, 4, islands=4),
    "differential evolution 60 × 40, 6 + 4": SearchSettings(
        DifferentialSettings(population=60, generations=40), 6, structured=4
    ),
    "CMA-ES 20 × 120, 6 + 4": SearchSettings(CovarianceSettings(), 6, structured=4),
}
"""Populations, then designs refined: of theirs + structured ones."""


def run(
    study: Landscape, evaluator: Evaluator | None, settings: SearchSettings, *, seed: int
) -> tuple[float, int, float]:
    """Height error found, `inf` where nothing is feasible [m], formations scored, CPU time [s]."""
    start = process_time()
    result = search(
        study.problem,
        study.space,
        settings=settings,
        rng=np.random.default_rng(seed),
        evaluator=evaluator,
    )
    objective = result.objective if result.feasible else np.inf
    return objective, result.evaluations, process_time() - start


def main() -> None:
    """Run the comparison: some minutes for each ten problems."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--problems", type=int, default=42)
    parser.add_argument("--first", type=int, default=0, help="number of the first problem")
    parser.add_argument("--seeds", type=int, default=2)
    options = parser.parse_args()
    found: dict[str, list[tuple[float, float, int, float]]] = defaultdict(list)
    numbers = range(options.first, options.first + options.problems)
    for done, number in enumerate(numbers, 1):
        study = random_study(number)
        evaluator = compiled_evaluator(study.problem, study.space)
        runs: dict[str, list[tuple[float, int, float]]] = defaultdict(list)
        for seed in range(options.seeds):
            for name, settings in CANDIDATES.items():
                runs[name].append(run(study, evaluator, settings, seed=seed))
                if seed == 0 and name == STRONGEST and not np.isfinite(runs[name][0][0]):
                    break  # nothing feasible, as good as surely: nothing to compare
            if len(runs) < len(CANDIDATES):
                break
        best = min(one[0] for many in runs.values() for one in many)
        reached = sum(one[0] <= best * (1 + 1e-4) for many in runs.values() for one in many)
        form = "compiled" if evaluator is not None else "arrays"
        print(
            f"{number:3} {study.name}, {form}: best {best:.6f} m, "
            f"{reached} of {sum(map(len, runs.values()))} runs",
            flush=True,
        )
        if np.isfinite(best):
            for name, many in runs.items():
                found[name] += [(best, *one) for one in many]
        if done % 7 == 0 or done == len(numbers):
            table(found)


def table(found: dict[str, list[tuple[float, float, int, float]]]) -> None:
    """Print what is known so far."""
    print(
        f"\n{'populations, refined + structured':40} {'≤ 1e-4':>7} {'≤ 1e-2':>7} {'feasible':>9}"
        f" {'worst':>8} {'evals':>7} {'CPU s':>6}"
    )
    for name, runs in found.items():
        best, objective, evaluations, seconds = np.array(runs, dtype=np.float64).T
        excess = objective / best - 1.0
        finite = excess[np.isfinite(excess)]
        print(
            f"{name:40} {np.mean(excess <= 1e-4):7.1%} {np.mean(excess <= 1e-2):7.1%}"
            f" {np.mean(np.isfinite(excess)):9.1%} {finite.max(initial=0.0):8.2%}"
            f" {evaluations.mean():7.0f} {seconds.mean():6.2f}",
            flush=True,
        )
    print(flush=True)


if __name__ == "__main__":
    main()
