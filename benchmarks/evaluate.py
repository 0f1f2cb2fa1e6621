"""Formations scored per second: against batch, N and segments, in arrays and compiled.

    python benchmarks/evaluate.py [--quick]

1. The shipped model (10 segments, every limit of the realistic study) against the size of the
   batch, for three satellites: `Problem.evaluate`, and the compiled loops where numba is installed.
2. The same against the number of segments.
3. Against the number N of satellites at a fixed batch, for five error models, with the growth
   exponent: the slope of log time over log N for the larger half of the N.
4. Beside a bound of what the machine can do, straight-line code by hand for three satellites
   (`straight_line.py`), on one thread. All forms give the same numbers, which is checked.
5. Formations per second and core of the plain model.
6. The stages of one evaluation in arrays, each timed on the ready results of the one before.
7. The peer: Li 2009 eqs (5)-(9) as a reader of the paper would write them with NumPy, one formation
   at a time with an explicit R⁻¹, on the paper's problem. Both give the same errors to 1e-9, which
   is checked.

Times are CPU times, the best of several repetitions, so that other processes matter little; they
are of one machine: compare the ratios. The script sets OPENBLAS_NUM_THREADS=1 unless it is set:
more threads make such small matrices slower, and CPU time would count them all.
"""

from __future__ import annotations

import os

# Before NumPy is imported: BLAS reads it once, when it is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import dataclasses
from collections.abc import Callable, Sequence
from time import process_time

import numpy as np
from numpy.typing import NDArray
from problems import (
    REALISTIC_LIMITS,
    paper_problem,
    realistic_errors,
    realistic_problem,
    shipped_problem,
)

from formation import min_separation, relative_positions
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    SharedBy,
    Weighting,
    height_error_of,
    phase_model,
    unwrapping_ladder,
)
from optimize import Constraints, DesignSpace, Problem
from optimize.kernel import compiled_evaluator

Array = NDArray[np.float64]

NO_UNWRAPPING = dataclasses.replace(
    REALISTIC_LIMITS, min_unwrapping_probability=None, prior_height_std=None
)
UNFILTERED = dataclasses.replace(
    realistic_errors(), baseline_decorrelation=BaselineDecorrelation.UNFILTERED
)
PAIRS = dataclasses.replace(realistic_errors(), weighting=Weighting.PAIRS)
PLAIN = dataclasses.replace(
    ErrorBudget.li2009(),
    azimuth=ErrorSource(1e-4, SharedBy.ALL),  # one angle for all
)
Model = tuple[ErrorBudget, Constraints]
MODELS: dict[str, Model] = {
    "plain: pairs, no limits": (PLAIN, Constraints()),
    "pairs, filtered": (PAIRS, NO_UNWRAPPING),
    "joint, filtered": (realistic_errors(), NO_UNWRAPPING),
    "joint, unfiltered": (UNFILTERED, NO_UNWRAPPING),
    "joint, filtered, unwrapping": (realistic_errors(), REALISTIC_LIMITS),
}


ONE_THREAD = 504
"""Formations that the compiled loops leave to one thread."""


def random_states(space: DesignSpace, count: int) -> Array:
    """States of designs drawn evenly from the box."""
    rng = np.random.default_rng(0)
    return space.states(rng.uniform(-space.upper, space.upper, size=(count, space.dimension)))


def best_time(function: Callable[[], object], *, seconds: float) -> float:
    """Shortest CPU time of one call among those that fit into `seconds`, three at least [s]."""
    function()  # fills caches
    times: list[float] = []
    while len(times) < 3 or sum(times) < seconds:
        start = process_time()
        function()
        times.append(process_time() - start)
    return min(times)


def forms(problem: Problem, space: DesignSpace) -> dict[str, Callable[[Array], object]]:
    """What scores designs: arrays, and compiled loops where numba is installed."""
    found: dict[str, Callable[[Array], object]] = {
        "arrays": lambda designs: problem.evaluate(space.states(designs))
    }
    evaluator = compiled_evaluator(problem, space)
    if evaluator is not None:
        found["compiled"] = evaluator.evaluate
    return found


def random_designs(space: DesignSpace, count: int) -> Array:
    """Designs drawn evenly from the box."""
    rng = np.random.default_rng(0)
    return rng.uniform(-space.upper, space.upper, size=(count, space.dimension))


def each(form: Callable[[Array], object], designs: Array, *, seconds: float) -> float:
    """CPU time of a formation [µs]."""
    return 1e6 * best_time(lambda: form(designs), seconds=seconds) / len(designs)


def _table(title: str, head: Sequence[int], rows: dict[str, list[float]]) -> None:
    print(f"\n{title}: µs per formation")
    print(f"{'':>40}", *(f"{count:>9}" for count in head))
    for label, times in rows.items():
        print(
            f"{label:>40}",
            *(f"{time:9.{3 if time < 1 else 2 if time < 10 else 1}f}" for time in times),
        )


def against_batch(sizes: Sequence[int], *, seconds: float) -> None:
    problem, space = realistic_problem(3)
    rows = {
        name: [each(form, random_designs(space, size), seconds=seconds) for size in sizes]
        for name, form in forms(problem, space).items()
    }
    _table("Batch, 3 satellites (joint, filtered, unwrapping)", sizes, rows)


def against_segments(counts: Sequence[int], *, batch: int, seconds: float) -> None:
    rows: dict[str, list[float]] = {}
    for count in counts:
        problem, space = realistic_problem(3, segments=count)
        for name, form in forms(problem, space).items():
            rows.setdefault(name, []).append(
                each(form, random_designs(space, batch), seconds=seconds)
            )
    _table(f"Segments, 3 satellites, batch of {batch}", counts, rows)


def against_satellites(counts: Sequence[int], *, seconds: float) -> None:
    rows: dict[str, list[float]] = {}
    batch = {"arrays": 16, "compiled": 256}
    for label, (errors, limits) in MODELS.items():
        for count in counts:
            problem, space = realistic_problem(count, errors=errors, constraints=limits)
            for name, form in forms(problem, space).items():
                time = each(form, random_designs(space, batch[name]), seconds=seconds)
                rows.setdefault(f"{label}, {name}", []).append(time)
    _table("Satellites, batch of 16 in arrays and 256 compiled", counts, rows)
    half = len(counts) // 2
    print(f"growth from N = {counts[half]} to {counts[-1]}")
    for label, times in rows.items():
        slope = np.polyfit(np.log(counts[half:]), np.log(times[half:]), 1)[0]
        print(f"{label:>40} N^{slope:.1f}")


def per_core(*, seconds: float) -> None:
    """Formations of the plain model in a second of CPU time, in batches that keep one thread."""
    problem, space = paper_problem(3, errors=PLAIN, constraints=Constraints())
    print("\nPlain model, 3 satellites: million formations per second and core")
    for name, form in forms(problem, space).items():
        time = each(form, random_designs(space, ONE_THREAD), seconds=seconds)
        print(f"{name:>40} {1.0 / time:9.2f}")


def stages(problem: Problem, states: Array) -> dict[str, Callable[[], object]]:
    """The stages of one evaluation, each on the ready results of the one before."""
    scene, radar, errors, n = problem.scene, problem.radar, problem.errors, problem.mean_motion
    prior = problem.constraints.prior_height_std
    assert prior is not None
    positions = relative_positions(states, scene.times, mean_motion=n)
    model = phase_model(positions, scene, radar=radar, errors=errors)
    return {
        "positions": lambda: relative_positions(states, scene.times, mean_motion=n),
        "phase model": lambda: phase_model(positions, scene, radar=radar, errors=errors),
        "height error": lambda: height_error_of(model, scene=scene, radar=radar, errors=errors),
        "unwrapping": lambda: unwrapping_ladder(model, prior_height_std=prior),
        "separation": lambda: min_separation(states, mean_motion=n),
        "all": lambda: problem.evaluate(states),
    }


def by_stage(cases: Sequence[tuple[int, int]], *, seconds: float) -> None:
    print("\nStages (joint, filtered, unwrapping): µs per formation, and share of the whole")
    print(f"{'':>14}", *(f"{f'N = {n}, batch {batch}':>20}" for n, batch in cases))
    columns: list[dict[str, float]] = []
    for count, batch in cases:
        problem, space = realistic_problem(count)
        calls = stages(problem, random_states(space, batch))
        columns.append(
            {name: best_time(call, seconds=seconds) / batch for name, call in calls.items()}
        )
    for column in columns:
        column["rest"] = 2.0 * column["all"] - sum(column.values())
    for name in columns[0]:
        cells = (f"{c[name] * 1e6:12.1f} ({c[name] / c['all']:4.0%})" for c in columns)
        print(f"{name:>14}", *(f"{cell:>20}" for cell in cells))


# -- compiled ------------------------------------------------------------------------------------


def compiled_and_bound(*, seconds: float) -> None:
    """Array form, compiled loops and the straight line by hand, on both models, N = 3."""
    try:
        from straight_line import hand_written
    except ImportError:
        print("\nnumba is not installed: no compiled form (pip install 'formation-opt[fast]')")
        return
    batch = ONE_THREAD
    print(f"\nCompiled, 3 satellites, batch of {batch}, one thread: µs per formation")
    print(f"{'':>30} {'arrays':>9} {'compiled':>9} {'by hand':>9} {'speed':>9}")
    cases = {
        "plain: pairs, no limits": paper_problem(3, errors=PLAIN, constraints=Constraints()),
        "joint, filtered, unwrapping": realistic_problem(3),
        "three_sat as shipped": shipped_problem("three_sat"),
    }
    for label, (problem, space) in cases.items():
        evaluator, straight = compiled_evaluator(problem, space), hand_written(problem, space)
        assert evaluator is not None
        rng = np.random.default_rng(0)
        # Half of the box: all images share a band, without which the straight line cancels.
        designs = 0.5 * rng.uniform(-space.upper, space.upper, size=(batch, space.dimension))
        states = space.states(designs)
        known = problem.evaluate(states).objectives
        np.testing.assert_allclose(evaluator.evaluate(designs).objectives, known, rtol=1e-12)
        np.testing.assert_allclose(straight(designs), known, rtol=1e-9)
        arrays, loops, line = (
            best_time(call, seconds=seconds) / batch
            for call in (
                lambda: problem.evaluate(states),  # noqa: B023
                lambda: evaluator.evaluate(designs),  # noqa: B023
                lambda: straight(designs),  # noqa: B023
            )
        )
        print(
            f"{label:>30} {arrays * 1e6:9.2f} {loops * 1e6:9.3f} {line * 1e6:9.3f} "
            f"{line / loops:9.0%}"
        )


# -- the peer ------------------------------------------------------------------------------------


def plain_region_error(problem: Problem, state: Array) -> float:
    """Region height error of one formation, Li 2009 eqs (5)-(9) with the covariance it implies.

    `state` is (N, 6). Segments are stacked and pairs are not looped over where NumPy does it
    without a second thought; formations come one at a time.
    """
    scene, radar, errors, n = problem.scene, problem.radar, problem.errors, problem.mean_motion
    theta, gamma, time = scene.look_angle, scene.azimuth, scene.times
    cosine, sine = np.cos(n * time)[:, None], np.sin(n * time)[:, None]
    radial, rate = state[:, 0], state[:, 3] / n
    z = radial * cosine + rate * sine  # eqs (10)-(12), (S, N)
    x = 2.0 * (rate * cosine - radial * sine)
    y = state[:, 2] * cosine + state[:, 5] / n * sine
    first, second = np.triu_indices(len(state), k=1)
    bx, by, bz = (axis[:, second] - axis[:, first] for axis in (x, y, z))
    g, t = gamma[:, None], theta[:, None]
    b_theta = bx * np.cos(g) * np.cos(t) + by * np.sin(g) * np.cos(t) + bz * np.sin(t)
    b_gamma = (by * np.cos(g) - bx * np.sin(g)) * np.sin(t)
    per_path = (scene.slant_range * np.sin(theta))[:, None] / b_theta  # dh per meter of path
    pairs = np.arange(len(first))
    incidence = np.zeros((len(pairs), len(state)))
    incidence[pairs, first], incidence[pairs, second] = -1.0, 1.0
    assert errors.phase_std is not None
    phase = (radar.wavelength * errors.phase_std / (2.0 * np.pi)) ** 2 * np.eye(len(pairs))
    path = phase + errors.position.std**2 * incidence @ incidence.T
    azimuth = (errors.azimuth.std * b_gamma)[:, :, None] ** 2 * np.eye(len(pairs))
    r = per_path[:, :, None] * (path + azimuth) * per_path[:, None, :]  # eq. (9), (S, K, K)
    h = np.ones(len(pairs))
    variance = 1.0 / (h @ np.linalg.inv(r) @ h)  # eqs (5)-(7)
    variance = variance + (np.cos(theta) * errors.range.std) ** 2  # common to all pairs
    return float(np.sqrt(np.mean(variance)))  # eq. (8)


def against_plain_loop(counts: Sequence[int], *, batch: int, seconds: float) -> None:
    print(f"\nLi 2009's errors, no limits, batch of {batch}: µs per formation")
    print(f"{'N':>4} {'plain loop':>12} {'ours':>10} {'ratio':>8}")
    for count in counts:
        problem, space = paper_problem(
            count, errors=ErrorBudget.li2009(), constraints=Constraints()
        )
        states = random_states(space, batch)

        def plain() -> Array:
            return np.array([plain_region_error(problem, state) for state in states])  # noqa: B023

        np.testing.assert_allclose(plain(), problem.evaluate(states).objectives, rtol=1e-9)
        loop = best_time(plain, seconds=seconds) / batch
        ours = best_time(lambda: problem.evaluate(states), seconds=seconds) / batch  # noqa: B023
        print(f"{count:4} {loop * 1e6:12.1f} {ours * 1e6:10.2f} {loop / ours:8.1f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few and short repetitions, in 20 s")
    quick = parser.parse_args().quick
    seconds = 0.05 if quick else 0.5
    against_batch([1, 4, 16, 60, 256, 1024, 4096], seconds=seconds)
    against_segments([1, 3, 10, 30, 100], batch=256, seconds=seconds)
    counts = [2, 3, 4, 8, 16, 32] if quick else [2, 3, 4, 8, 16, 32, 64]
    against_satellites(counts, seconds=seconds / 2.0)
    compiled_and_bound(seconds=seconds)
    per_core(seconds=seconds)
    by_stage([(3, 60), (3, 1024), (16, 60)], seconds=seconds)
    against_plain_loop([3, 4, 8], batch=256, seconds=seconds)


if __name__ == "__main__":
    main()
