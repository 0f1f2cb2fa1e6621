"""Our search against scipy's differential evolution and plain DEAP, at equal evaluations.

    python benchmarks/search.py [--seeds 20] [--quick]

For each seed our `search` (genetic algorithm and SLSQP refinement) runs first; each peer then gets
as many evaluations as it used with that seed, differences for gradients included, of the same
evaluator, in the same process. The peers (`peers.py`):

- our genetic algorithm alone, with more generations instead of a refinement;
- plain DEAP: the same operators and settings, formations scored one at a time by `toolbox.map`;
- scipy's differential evolution, vectorized, with three ways to keep the limits; and with two ways
  to finish: scipy's polish (trust-constr) and one run of our refinement.

The table gives, over the seeds, the median and the worst region height error (`inf` where nothing
feasible was found), the share of runs within 0.1 % of the best known, the share that ends feasible,
and medians of the evaluations used, the time of a run, and the time outside the evaluator (which
takes design vectors to scores) per evaluation. Times are CPU times of one thread, so that other
processes matter little, and of one machine: compare the ratios.
"""

from __future__ import annotations

import os

# Before NumPy is imported: BLAS reads it once, and threads only slow such small matrices down.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
from collections.abc import Callable
from contextlib import suppress
from time import process_time
from typing import NamedTuple

import numpy as np
from metering import BudgetSpentError, Meter, metered
from peers import PEERS, Task, our_search
from problems import Landscape, landscapes


class Run(NamedTuple):
    """One run: best feasible error [m], evaluations, time in all and outside the evaluator [s]."""

    best: float
    evaluations: int
    seconds: float
    overhead: float


class Summary(NamedTuple):
    """Median time of a run [s], and median overhead of an evaluation [s]."""

    seconds: float
    overhead: float


def run(peer: Callable[[Task], None], landscape: Landscape, *, seed: int, budget: float) -> Run:
    """One search, until it ends or its budget is spent."""
    meter = Meter(budget=budget)
    problem, space = metered(landscape.problem, landscape.space, meter)
    start = process_time()
    with suppress(BudgetSpentError):
        peer(Task(problem, space, landscape.settings, seed))
    seconds = process_time() - start
    return Run(meter.best, meter.evaluations, seconds, seconds - meter.seconds)


def compare(landscape: Landscape, *, seeds: int) -> None:
    """All peers on one landscape, seed by seed, so that a busy machine slows them alike."""
    runs: dict[str, list[Run]] = {name: [] for name in ("our search", *PEERS)}
    for seed in range(seeds):
        ours = run(our_search, landscape, seed=seed, budget=np.inf)
        runs["our search"].append(ours)
        for name, peer in PEERS.items():
            runs[name].append(run(peer, landscape, seed=seed, budget=ours.evaluations))
    best_known = min(landscape.best_known, *(one.best for many in runs.values() for one in many))
    print(f"\n{landscape.name}: best known {best_known:.6f} m, {seeds} seeds")
    print(
        f"{'':34} {'median m':>9} {'worst m':>9} {'≤ 0.1 %':>8} {'feasible':>8} {'evals':>7}"
        f" {'time s':>7} {'/ ours':>6} {'overhead µs':>11} {'/ ours':>6}"
    )
    reference = _summary(runs["our search"])
    for name, many in runs.items():
        print(f"{name:34} {_row(many, best_known, reference)}", flush=True)


def _summary(many: list[Run]) -> Summary:
    return Summary(
        float(np.median([one.seconds for one in many])),
        float(np.median([one.overhead / one.evaluations for one in many])),
    )


def _row(many: list[Run], best_known: float, reference: Summary) -> str:
    best = np.array([one.best for one in many])
    evaluations = np.median([one.evaluations for one in many])
    seconds, overhead = _summary(many)
    return (
        f"{np.median(best):9.5f} {best.max():9.5f} {np.mean(best <= 1.001 * best_known):8.0%}"
        f" {np.mean(np.isfinite(best)):8.0%} {evaluations:7.0f}"
        f" {seconds:7.3f} {seconds / reference.seconds:6.2f}"
        f" {overhead * 1e6:11.1f} {overhead / reference.overhead:6.2f}"
    )


def main() -> None:
    """Run the comparison: about 12 minutes for 20 seeds."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20, help="runs of each peer (default 20)")
    parser.add_argument("--quick", action="store_true", help="three short runs each, in 20 s")
    options = parser.parse_args()
    for landscape in landscapes(quick=options.quick):
        compare(landscape, seeds=3 if options.quick else options.seeds)


if __name__ == "__main__":
    main()
