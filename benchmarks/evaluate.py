"""Formations scored per second: against the batch, against N, by stage, and against a plain loop.

    python benchmarks/evaluate.py [--quick]

1. `Problem.evaluate` (10 segments, every limit of the realistic study) against the size of the
   batch, for three satellites.
2. The same against the number N of satellites at a fixed batch, for four error models, with the
   growth exponent: the slope of log time over log N for the larger half of the N.
3. The stages of one evaluation, each timed on the ready results of the one before.
4. The compiled loops, where numba is installed: on one thread against the array form and against
   straight-line code by hand for three satellites (`straight_line.py`), an upper bound of what the
   machine can do; and against N.
5. The peer: Li 2009 eqs (5)-(9) as a reader of the paper would write them with NumPy, one formation
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
MODELS: dict[str, tuple[ErrorBudget, Constraints]] = {
    "joint, filtered, unwrapping": (realistic_errors(), REALISTIC_LIMITS),
    "joint, filtered": (realistic_errors(), NO_UNWRAPPING),
    "joint, unfiltered": (UNFILTERED, NO_UNWRAPPING),
    "pairs, filtered": (PAIRS, NO_UNWRAPPING),
}


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


def against_batch(sizes: Sequence[int], *, seconds: float) -> None:
    print("\nBatch size, 3 satellites (joint, filtered, unwrapping)")
    print(f"{'batch':>7} {'µs/formation':>13} {'formations/s':>13} {'× one by one':>13}")
    problem, space = realistic_problem(3)
    alone = np.nan
    for size in sizes:
        states = random_states(space, size)
        each = best_time(lambda: problem.evaluate(states), seconds=seconds) / size  # noqa: B023
        alone = each if size == sizes[0] else alone
        print(f"{size:7} {each * 1e6:13.1f} {1.0 / each:13,.0f} {alone / each:13.1f}")


def against_satellites(counts: Sequence[int], *, batch: int, seconds: float) -> None:
    print(f"\nNumber of satellites, batch of {batch}: µs per formation")
    print(f"{'N':>30}", *(f"{count:>8}" for count in counts), " exponent")
    for label, (errors, limits) in MODELS.items():
        each = []
        for count in counts:
            problem, space = realistic_problem(count, errors=errors, constraints=limits)
            states = random_states(space, batch)
            one = best_time(lambda: problem.evaluate(states), seconds=seconds)  # noqa: B023
            each.append(one / batch)
        half = len(counts) // 2
        slope = np.polyfit(np.log(counts[half:]), np.log(each[half:]), 1)[0]
        print(f"{label:>30}", *(f"{time * 1e6:8.1f}" for time in each), f" N^{slope:.1f}")
    print(f"{'':>30} exponent from N = {counts[half]} to {counts[-1]}")


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


def compiled_and_bound(*, batch: int, seconds: float) -> None:
    """Array form, compiled loops and the straight line by hand, on both models, N = 3."""
    try:
        from straight_line import hand_written
    except ImportError:
        print("\nnumba is not installed: no compiled form (pip install 'formation-opt[fast]')")
        return
    from optimize.kernel import compiled_evaluator

    print(f"\nCompiled, 3 satellites, batch of {batch}, one thread: µs per formation")
    print(f"{'':>30} {'arrays':>9} {'compiled':>9} {'by hand':>9} {'of bound':>9}")
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
        part = 256  # keeps one thread
        arrays, loops, line = (
            best_time(lambda c=call: c(), seconds=seconds) / size  # type: ignore[misc]
            for call, size in (
                (lambda: problem.evaluate(states[:1024]), 1024),  # noqa: B023
                (lambda: [evaluator.evaluate(d) for d in np.split(designs, batch // part)], batch),  # noqa: B023
                (lambda: straight(designs), batch),  # noqa: B023
            )
        )
        print(
            f"{label:>30} {arrays * 1e6:9.2f} {loops * 1e6:9.3f} {line * 1e6:9.3f} "
            f"{line / loops:9.0%}"
        )


def compiled_against_satellites(counts: Sequence[int], *, batch: int, seconds: float) -> None:
    from optimize.kernel import compiled_evaluator

    print(f"\nCompiled against N, batch of {batch}, one thread: µs per formation")
    print(f"{'N':>30}", *(f"{count:>8}" for count in counts), " exponent")
    models = {"plain: pairs, no limits": (PLAIN, Constraints()), **MODELS}
    for label, (errors, limits) in models.items():
        each = []
        for count in counts:
            problem, space = realistic_problem(count, errors=errors, constraints=limits)
            evaluator = compiled_evaluator(problem, space)
            if evaluator is None:
                break
            rng = np.random.default_rng(0)
            designs = rng.uniform(-space.upper, space.upper, size=(batch, space.dimension))
            each.append(best_time(lambda: evaluator.evaluate(designs), seconds=seconds) / batch)  # noqa: B023
        if len(each) < len(counts):
            print(f"{label:>30} {'not known to the compiled loops':>40}")
            continue
        half = len(counts) // 2
        slope = np.polyfit(np.log(counts[half:]), np.log(each[half:]), 1)[0]
        print(f"{label:>30}", *(f"{time * 1e6:8.2f}" for time in each), f" N^{slope:.1f}")


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
    powers = [1, 4, 16, 60, 256, 1024, 4096]
    against_batch(powers, seconds=seconds)
    against_satellites(
        [2, 3, 4, 8, 16, 32] if quick else [2, 3, 4, 8, 16, 32, 64], batch=20, seconds=seconds
    )
    compiled_and_bound(batch=4096, seconds=seconds)
    compiled_against_satellites([2, 3, 4, 8, 16, 32, 64], batch=20, seconds=seconds)
    by_stage([(3, 60), (3, 1024), (16, 60)], seconds=seconds)
    against_plain_loop([3, 4, 8], batch=256, seconds=seconds)


if __name__ == "__main__":
    main()
