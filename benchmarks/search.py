"""Our search against its peers at equal evaluations, on three landscapes of 3, 5 and 8 satellites.

    python benchmarks/search.py [--seeds 50] [--satellites 3,5,8] [--only WORD]
        [--compiled] [--prove] [--all] [--quick]

Our `search` runs from all seeds first. With each seed, each peer then gets as many evaluations as
it used, differences for gradients included, of the same evaluator, in the same process, and ends
sooner where it is within 1e-4 of the best known. The peers (`peers.py`):

- our search with another algorithm or without structured designs, and our genetic algorithm alone;
- scipy's differential evolution, vectorized, with its own rules for the limits and with Deb's;
  scipy's dual annealing;
- pymoo (GA, DE, CMA-ES), pygmo (sade, CMA-ES) and pycma, where they are installed
  (`pip install -e '.[bench]'`); those that take 0.1 ms and more for each design get three seeds;
- with `--all` also plain DEAP (the same operators, one formation at a time) and scipy's
  differential evolution with penalties and with two ways to finish.

The best known is that of long searches of ours, with other seeds, and of all runs; with `--prove`,
what the certificate proves of it is printed above each table. Tables are printed every ten seeds.
They give the share of runs that come within 1e-4, the CPU time that a success costs (time of all
runs until they are there or give up, over the number of successes), the share that ends feasible,
the median and the worst region height error (`inf` where nothing feasible was found), the
evaluations, and the time outside the evaluator (which takes design vectors to scores) per
evaluation. CPU times, and of one machine: compare the ratios.
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
from metering import ArrayEvaluator, EndOfRunError, Meter, MeteredEvaluator
from peers import OTHERS, PEERS, SLOW, Task, our_search
from problems import Landscape, landscapes

from optimize import GeneticSettings, SearchResult, SearchSettings, search
from optimize.certificate import certify
from optimize.kernel import compiled_evaluator
from optimize.scoring import Evaluator

Peer = Callable[[Task], None]

SLOW_SEEDS = 3
"""Runs of the peers that spend 0.1 ms and more on each design."""

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
    """The CPU time of a success, and the share of successes.

    Attributes
    ----------
    overhead : median time outside the evaluator per evaluation [s].
    success : time of all runs until they are there or give up, over the successes [s].
    share : of the runs that come within `TOLERANCE`.
    """

    overhead: float
    success: float
    share: float


def run(
    peer: Peer,
    landscape: Landscape,
    evaluator: Evaluator,
    *,
    seed: int,
    budget: float = np.inf,
    target: float = -np.inf,
) -> Run:
    """One search, until it ends, its budget is spent, or it is where it was to come to."""
    problem, space = landscape.problem, landscape.space
    meter = Meter(budget=budget, target=target)
    start = process_time()
    with suppress(EndOfRunError):
        metered = MeteredEvaluator(evaluator, meter)
        peer(Task(problem, space, metered, landscape.settings, seed))
    seconds = process_time() - start
    return Run(meter, seconds, seconds - meter.seconds)


class Comparison:
    """All peers on one landscape, seed by seed, so that a busy machine slows them alike."""

    def __init__(
        self, landscape: Landscape, peers: dict[str, Peer], *, compiled: bool, prove: bool
    ) -> None:
        loops = compiled_evaluator(landscape.problem, landscape.space) if compiled else None
        arrays = ArrayEvaluator(landscape.problem, landscape.space)
        self.form = "arrays" if loops is None else "compiled loops"
        self.landscape, self.peers = landscape, peers
        self.evaluator: Evaluator = arrays if loops is None else loops
        self.known = best_known(landscape, self.evaluator)
        self.proved = _proved(landscape, self.known) if prove else "no proof asked for"
        self.runs: dict[str, list[Run]] = {name: [] for name in ("our search", *peers)}

    def ours(self, seeds: int) -> None:
        """Our search from all seeds."""
        for seed in range(seeds):
            self.runs["our search"].append(
                run(our_search, self.landscape, self.evaluator, seed=seed)
            )

    def seed(self, seed: int) -> None:
        """All peers from one seed."""
        within = (1.0 + TOLERANCE) * self.known.objective
        budget = self.runs["our search"][seed].evaluations
        for name, peer in self.peers.items():
            if name not in SLOW or seed < SLOW_SEEDS:
                one = run(
                    peer,
                    self.landscape,
                    self.evaluator,
                    seed=seed,
                    budget=budget,
                    target=within,
                )
                self.runs[name].append(one)

    def show(self) -> None:
        """Print what is known so far."""
        best = min(self.known.objective, *(one.best for many in self.runs.values() for one in many))
        print(f"\n{self.landscape.name}: best known {best:.6f} m ({self.proved}), {self.form}")
        print(
            f"{'':34} {'runs':>4} {'≤ 1e-4':>7} {'s/success':>9} {'/ ours':>7}"
            f" {'feasible':>8} {'median m':>9}"
            f" {'worst m':>9} {'evals':>7} {'overhead µs':>11}"
        )
        reference = _summary(self.runs["our search"], best)
        for name, many in self.runs.items():
            if many:
                print(f"{name:34} {_row(many, best, reference)}", flush=True)


def best_known(landscape: Landscape, evaluator: Evaluator) -> SearchResult:
    """The best of three long searches."""
    settings = SearchSettings(
        GeneticSettings(population=60, generations=40), refinements=16, structured=16
    )
    found = [
        search(
            landscape.problem,
            landscape.space,
            settings=settings,
            rng=np.random.default_rng([7, seed]),
            evaluator=evaluator,
        )
        for seed in range(3)
    ]
    return min(found, key=lambda one: one.objective if one.feasible else np.inf)


def _proved(landscape: Landscape, known: SearchResult) -> str:
    """How far the best known is from the best possible at most."""
    bound = certify(landscape.problem, landscape.space, design=known.design).lower_bound
    if not np.isfinite(bound):
        return "no certificate"
    gap = known.objective / bound - 1.0
    word = "certified" if gap <= TOLERANCE else "not certified"
    return f"{word}: no formation below {bound:.6f} m (gap {gap:.1e})"


def _summary(many: list[Run], optimum: float) -> Summary:
    times = np.array([one.meter.reached((1.0 + TOLERANCE) * optimum) for one in many])
    spent = np.where(np.isfinite(times), times, [one.seconds for one in many])
    successes = int(np.isfinite(times).sum())
    return Summary(
        float(np.median([one.overhead / one.evaluations for one in many])),
        float(spent.sum() / successes) if successes else np.inf,
        successes / len(many),
    )


def _row(many: list[Run], optimum: float, reference: Summary) -> str:
    best = np.array([one.best for one in many])
    evaluations = np.median([one.evaluations for one in many])
    own = _summary(many, optimum)
    return (
        f"{len(many):4} {own.share:7.0%} {own.success:9.3f} {own.success / reference.success:7.1f}"
        f" {np.mean(np.isfinite(best)):8.0%} {np.median(best):9.5f} {best.max():9.5f}"
        f" {evaluations:7.0f} {own.overhead * 1e6:11.1f}"
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
    parser.add_argument("--prove", action="store_true", help="certificates of the best known")
    parser.add_argument("--all", action="store_true", help="the slower peers too")
    parser.add_argument("--quick", action="store_true", help="one short run each, 3 satellites")
    options = parser.parse_args()
    peers = PEERS | OTHERS if options.all else PEERS
    counts = (3,) if options.quick else tuple(map(int, options.satellites.split(",")))
    seeds = 1 if options.quick else options.seeds
    comparisons = [
        Comparison(landscape, peers, compiled=options.compiled, prove=options.prove)
        for landscape in landscapes(counts=counts, quick=options.quick)
        if options.only in landscape.name
    ]
    for comparison in comparisons:
        comparison.ours(seeds)
    for seed in range(seeds):
        for comparison in comparisons:
            comparison.seed(seed)
        if seed in (0, 4) or (seed + 1) % 10 == 0 or seed + 1 == seeds:
            print(f"\n--- after {seed + 1} seeds of the peers")
            for comparison in comparisons:
                comparison.show()


if __name__ == "__main__":
    main()
