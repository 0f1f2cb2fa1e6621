"""Our search against its peers at equal evaluations, on three landscapes of 3, 5 and 8 satellites.

    python benchmarks/search.py [--seeds 50] [--satellites 3,5,8] [--only WORD]
        [--compiled] [--quick]

For each seed our `search` runs first; each peer then gets as many evaluations as it used with that
seed, differences for gradients included, of the same evaluator, in the same process. The peers
(`peers.py`):

- our search with another algorithm or without structured designs, and our genetic algorithm alone;
- plain DEAP: the same operators and settings, formations scored one at a time by `toolbox.map`;
- scipy's differential evolution, vectorized, with three ways to keep the limits, and with two ways
  to finish; scipy's dual annealing;
- pymoo (GA, DE, CMA-ES), pygmo (sade, CMA-ES) and pycma, where they are installed
  (`pip install -e '.[bench]'`).

The optimum is the certified one where the certificate's gap at the best known design is below 1e-4,
else the best known of all runs, which is said. The table gives, over the seeds, the median and the
worst region height error (`inf` where nothing feasible was found), the share of runs within 1e-4 of
the optimum, the CPU time that a success costs (time of all runs until they are there or give up,
over the number of successes), the share that ends feasible, the evaluations, the time of a run, and
the time outside the evaluator (which takes design vectors to scores) per evaluation. CPU times of
one thread, so that other processes matter little, and of one machine: compare the ratios.
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
from metering import ArrayEvaluator, BudgetSpentError, Meter, MeteredEvaluator
from peers import PEERS, Task, our_search
from problems import Landscape, landscapes

from optimize import search
from optimize.certificate import certify
from optimize.kernel import compiled_evaluator
from optimize.search import Evaluator

TOLERANCE = 1e-4
"""Distance from the optimum, in parts of it, that counts as reached."""


class Run(NamedTuple):
    """One run: its meter, time in all and outside the evaluator [s]."""

    meter: Meter
    seconds: float
    overhead: float

    @property
    def best(self) -> float:
        """Best feasible region height error [m]."""
        return self.meter.best

    @property
    def evaluations(self) -> int:
        """Formations scored."""
        return self.meter.evaluations


class Summary(NamedTuple):
    """Medians over the runs, the CPU time of a success, and the share of successes.

    Attributes
    ----------
    seconds, overhead : median time of a run, and outside the evaluator per evaluation [s].
    success : time of all runs until they are there or give up, over the successes [s].
    share : of the runs that come within `TOLERANCE`.
    """

    seconds: float
    overhead: float
    success: float
    share: float


def run(
    peer: Callable[[Task], None],
    landscape: Landscape,
    evaluator: Evaluator,
    *,
    seed: int,
    budget: float = np.inf,
) -> Run:
    """One search, until it ends or its budget is spent."""
    problem, space = landscape.problem, landscape.space
    meter = Meter(budget=budget)
    start = process_time()
    with suppress(BudgetSpentError):
        metered = MeteredEvaluator(evaluator, meter)
        peer(Task(problem, space, metered, landscape.settings, seed))
    seconds = process_time() - start
    return Run(meter, seconds, seconds - meter.seconds)


def compare(landscape: Landscape, *, seeds: int, compiled: bool) -> None:
    """All peers on one landscape, seed by seed, so that a busy machine slows them alike."""
    arrays = ArrayEvaluator(landscape.problem, landscape.space)
    loops = compiled_evaluator(landscape.problem, landscape.space) if compiled else None
    evaluator = arrays if loops is None else loops
    runs: dict[str, list[Run]] = {name: [] for name in ("our search", *PEERS)}
    for seed in range(seeds):
        ours = run(our_search, landscape, evaluator, seed=seed)
        runs["our search"].append(ours)
        for name, peer in PEERS.items():
            one = run(peer, landscape, evaluator, seed=seed, budget=ours.evaluations)
            runs[name].append(one)
    best_known = min(one.best for many in runs.values() for one in many)
    form = "arrays" if loops is None else "compiled loops"
    print(f"\n{landscape.name}: best known {best_known:.6f} m, {seeds} seeds, {form}")
    print(
        f"{'':34} {'median m':>9} {'worst m':>9} {'≤ 1e-4':>7} {'s/success':>9} {'/ ours':>7}"
        f" {'feasible':>8} {'evals':>7} {'time s':>7} {'/ ours':>6}"
        f" {'overhead µs':>11} {'/ ours':>6}"
    )
    reference = _summary(runs["our search"], best_known)
    for name, many in runs.items():
        print(f"{name:34} {_row(many, best_known, reference)}", flush=True)
    print(_optimum(landscape, best_known), flush=True)


def _optimum(landscape: Landscape, best_known: float) -> str:
    """How far the best known is from the best possible at most."""
    found = search(
        landscape.problem,
        landscape.space,
        settings=landscape.settings,
        rng=np.random.default_rng(0),
    )
    bound = certify(landscape.problem, landscape.space, design=found.design).lower_bound
    if not np.isfinite(bound):
        return "no certificate"
    gap = best_known / bound - 1.0
    word = "certified" if gap <= TOLERANCE else "not certified"
    return f"{word}: no formation below {bound:.6f} m (gap {gap:.1e})"


def _summary(many: list[Run], optimum: float) -> Summary:
    times = np.array([one.meter.reached((1.0 + TOLERANCE) * optimum) for one in many])
    spent = np.where(np.isfinite(times), times, [one.seconds for one in many])
    successes = int(np.isfinite(times).sum())
    return Summary(
        float(np.median([one.seconds for one in many])),
        float(np.median([one.overhead / one.evaluations for one in many])),
        float(spent.sum() / successes) if successes else np.inf,
        successes / len(many),
    )


def _row(many: list[Run], optimum: float, reference: Summary) -> str:
    best = np.array([one.best for one in many])
    evaluations = np.median([one.evaluations for one in many])
    own = _summary(many, optimum)
    return (
        f"{np.median(best):9.5f} {best.max():9.5f} {own.share:7.0%} {own.success:9.3f}"
        f" {own.success / reference.success:7.2f} {np.mean(np.isfinite(best)):8.0%}"
        f" {evaluations:7.0f} {own.seconds:7.3f} {own.seconds / reference.seconds:6.2f}"
        f" {own.overhead * 1e6:11.1f} {own.overhead / reference.overhead:6.2f}"
    )


def main() -> None:
    """Run the comparison: hours for 50 seeds of all, minutes for a few of three satellites."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=50, help="runs of each peer (default 50)")
    parser.add_argument("--satellites", default="3,5,8", help="numbers of satellites, by commas")
    parser.add_argument("--only", default="", help="landscapes whose name holds this word")
    parser.add_argument(
        "--compiled", action="store_true", help="compiled loops score, where they know the problem"
    )
    parser.add_argument("--quick", action="store_true", help="one short run each, 3 satellites")
    options = parser.parse_args()
    counts = (3,) if options.quick else tuple(map(int, options.satellites.split(",")))
    for landscape in landscapes(counts=counts, quick=options.quick):
        if options.only in landscape.name:
            seeds = 1 if options.quick else options.seeds
            compare(landscape, seeds=seeds, compiled=options.compiled)


if __name__ == "__main__":
    main()
