"""The compiled loops against the array form, which they are held to."""

from __future__ import annotations

import dataclasses
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formation import Orbit, ground_track_circular, space_circular
from insar import (
    BaselineDecorrelation,
    CoherenceBudget,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    monostatic,
    one_transmitter,
    ping_pong,
)
from insar.coherence import UniformVolume
from optimize import (
    Constraints,
    DesignSpace,
    GeneticSettings,
    Problem,
    SearchSettings,
    search,
)
from optimize.kernel import compiled_evaluator

pytest.importorskip("numba")

N = Orbit.circular(altitude=514e3, inclination=1.7).mean_motion
ALL_LIMITS = Constraints(
    max_radius=1350.0,
    min_separation=100.0,
    min_unwrapping_probability=0.99,
    prior_height_std=4.0,
    max_baseline_fraction=0.7,
    max_offset=500.0,
    max_rate=0.6,
)


@st.composite
def problems(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    count = draw(st.sampled_from([2, 3, 4, 5, 7, 9]))  # by sets of images, and by cells
    joint = draw(st.booleans())
    decorrelation = draw(st.sampled_from(BaselineDecorrelation))
    segments = draw(st.integers(1, 5))
    pair = not joint and draw(st.booleans())
    images = draw(st.sampled_from([one_transmitter, monostatic]))(count)
    if count == 2 and draw(st.booleans()):
        images = ping_pong(count)
    errors = ErrorBudget(
        position=ErrorSource(rng.choice([0.0, 1e-3, 0.01]), SharedBy.SATELLITE),
        azimuth=ErrorSource(rng.choice([0.0, 1e-5]), SharedBy.PAIR if pair else SharedBy.ALL),
        synchronization=ErrorSource(
            rng.choice([0.0, 0.02]), SharedBy.PAIR if pair else SharedBy.IMAGE
        ),
        range=ErrorSource(0.01, SharedBy.ALL),
        weighting=Weighting.JOINT if joint else Weighting.PAIRS,
        baseline_decorrelation=decorrelation,
        held_constant=draw(st.sampled_from(HeldConstant)),
        phase_std=0.2 if not joint and draw(st.booleans()) else None,
        phase_statistics=draw(st.sampled_from(PhaseStatistics)),
        coherence=CoherenceBudget(
            relative_snr=draw(st.sampled_from([1.0, tuple(rng.uniform(0.5, 2.0, segments))])),
            image_snr=draw(st.sampled_from([(), tuple(rng.uniform(0.5, 2.0, len(images)))])),
        ),
    )
    limits = ALL_LIMITS
    for name in ("max_radius", "min_separation", "max_baseline_fraction", "max_offset"):
        if draw(st.booleans()):
            limits = dataclasses.replace(limits, **{name: None})
    if draw(st.booleans()):
        limits = dataclasses.replace(limits, min_unwrapping_probability=None)
    scene = Scene.broadside_strip(
        times=np.sort(rng.uniform(0.0, 3000.0, segments)),
        look_angle=np.deg2rad(rng.uniform(15.0, 45.0)),
        altitude=514e3,
        earth_radius=6_378_137.0,
    )
    problem = Problem(
        mean_motion=N,
        scene=scene,
        radar=Radar(
            wavelength=rng.choice([0.031, 0.24]),
            slant_range_resolution=3.0,
            snr=rng.uniform(2.0, 30.0),
            looks=rng.uniform(1.0, 40.0),
            images=images,
            azimuth_resolution=rng.choice([None, 3.0]),
        ),
        errors=errors,
        constraints=limits,
    )
    space = DesignSpace(
        names=tuple(f"S{i}" for i in range(count)),
        family=draw(st.sampled_from([space_circular, ground_track_circular])),
        mean_motion=N,
        max_offset=1500.0,
        max_rate=1500.0 * N,
        signs=draw(st.sampled_from([(1,), (-1,), (1, -1)])),
    )
    return problem, space, rng.uniform(-space.upper, space.upper, (40, space.dimension))


@settings(max_examples=120, deadline=None)
@given(problems())
def test_compiled_scores_are_those_of_the_array_form(case):
    problem, space, designs = case
    designs[:10] *= 0.05  # close formations, which keep more of the band
    compiled = compiled_evaluator(problem, space)
    assert compiled is not None
    objectives, items = compiled.objectives_and_margins(designs)
    expected, margins = problem.objectives_and_margins(space.states(designs))
    # Where two bands end within rounding of each other, their common part has no digits.
    near = dataclasses.replace(problem, constraints=Constraints(max_baseline_fraction=1.0))
    overlap = near.objectives_and_margins(space.states(designs))[1][0].min(axis=-1)
    close = (overlap > 1e-3) | (problem.errors.baseline_decorrelation is BaselineDecorrelation.NONE)
    if problem.radar.azimuth_resolution is not None:
        close &= problem.errors.baseline_decorrelation is BaselineDecorrelation.NONE
    close[:10] = True
    np.testing.assert_allclose(objectives[close], expected[close], rtol=1e-12)
    np.testing.assert_allclose(objectives, expected, rtol=1e-7)
    reference = np.concatenate([np.empty((len(designs), 0)), *margins], axis=-1)
    # The margin of the unwrapping comes of an inverse matrix. Where an image shares no band its
    # condition is 1e12 or worse, and the margin near the −2 of certain failure.
    tolerance = np.where(reference < -1.9, 1e-5, 1e-9) + 1e-12 * np.abs(reference)
    assert np.all(np.abs(items - reference) <= tolerance)
    scored, known = compiled.evaluate(designs), problem.evaluate(space.states(designs))
    np.testing.assert_array_equal(scored.objectives, objectives)
    np.testing.assert_allclose(scored.violations, known.violations, rtol=1e-5, atol=1e-9)


def example(count=3, **changes):
    errors = ErrorBudget(
        position=ErrorSource(0.001, SharedBy.SATELLITE),
        azimuth=ErrorSource(1e-5, SharedBy.ALL),
        **changes,
    )
    scene = Scene.broadside_strip(
        times=[1.0, 5.0], look_angle=0.4, altitude=514e3, earth_radius=6_378_137.0
    )
    radar = Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=16.0,
        images=one_transmitter(count),
    )
    problem = Problem(
        mean_motion=N, scene=scene, radar=radar, errors=errors, constraints=ALL_LIMITS
    )
    space = DesignSpace(
        names=tuple(map(str, range(count))),
        family=space_circular,
        mean_motion=N,
        max_offset=600.0,
        max_rate=600.0 * N,
    )
    return problem, space


def test_any_number_of_threads_and_any_batch_give_the_same_bits(monkeypatch):
    problem, space = example()
    rng = np.random.default_rng(0)
    designs = rng.uniform(-space.upper, space.upper, (1500, space.dimension))
    compiled = compiled_evaluator(problem, space)
    results = []
    for threads in (1, 2, 3):
        monkeypatch.setattr("optimize.kernel.evaluator._threads", lambda threads=threads: threads)
        results.append(compiled.evaluate(designs))
    results.append(
        type(results[0])(
            *map(
                np.concatenate,
                zip(*(compiled.evaluate(part) for part in np.split(designs, 15)), strict=True),
            )
        )
    )
    for other in results[1:]:
        np.testing.assert_array_equal(results[0].objectives, other.objectives)
        np.testing.assert_array_equal(results[0].violations, other.violations)


def test_designs_that_measure_nothing_are_infinite():
    problem, space = example()
    designs = np.zeros((2, space.dimension))
    designs[1, ::2] = 100.0  # all at one place
    assert np.all(np.isinf(compiled_evaluator(problem, space).evaluate(designs).objectives))


def test_a_problem_that_the_loops_do_not_know_is_left_to_arrays():
    problem, space = example(coherence=CoherenceBudget(volume=UniformVolume(height=10.0)))
    assert compiled_evaluator(problem, space) is None


def test_a_long_search_is_scored_by_the_loops(monkeypatch):
    problem, space = example()
    chosen = SearchSettings(GeneticSettings(population=30, generations=20), refinements=4)

    def found():
        return search(problem, space, settings=chosen, rng=np.random.default_rng(1))

    arrays = found()
    monkeypatch.setattr(sys.modules["optimize.search"], "_COMPILED_FROM", 1)
    monkeypatch.setattr(Problem, "evaluate", None)  # the arrays are asked no more
    monkeypatch.setattr(sys.modules["optimize.kernel.evaluator"], "_agree", lambda *_: True)
    compiled = found()
    assert compiled.feasible
    assert compiled.compiled
    assert not arrays.compiled  # 600 formations: too few
    assert compiled.objective == pytest.approx(arrays.objective, rel=1e-6)


@pytest.mark.parametrize("azimuth_resolution", [None, 3.0])
def test_sets_of_images_and_cells_of_the_spectrum_are_two_ways_to_one_sum(
    monkeypatch, azimuth_resolution
):
    problem, space = example(5)
    radar = dataclasses.replace(problem.radar, azimuth_resolution=azimuth_resolution)
    problem = dataclasses.replace(problem, radar=radar)
    designs = np.random.default_rng(1).uniform(-space.upper, space.upper, (50, space.dimension))
    by_sets = compiled_evaluator(problem, space).objectives_and_margins(designs)
    monkeypatch.setattr("optimize.kernel.constants.MOST_IMAGES", 0)
    by_cells = compiled_evaluator(problem, space).objectives_and_margins(designs)
    np.testing.assert_allclose(by_sets[0], by_cells[0], rtol=1e-11)
    np.testing.assert_allclose(by_sets[1], by_cells[1], rtol=1e-8, atol=1e-8)


def test_functions_of_eight_numbers():
    import numba
    from scipy.special import erfc

    from optimize.kernel.functions import complementary_error, fast_exponential
    from optimize.kernel.lanes import keep, lanes

    @numba.njit
    def both(source, target, count):
        for i in range(count):
            keep(target, 2 * i, complementary_error(lanes(source, i)))
            keep(target, 2 * i + 1, fast_exponential(lanes(source, i) * -8.0))

    x = np.concatenate([[0.0], np.linspace(1e-9, 8.5, 799)])
    found = np.empty((100, 2, 8))
    both(x.ctypes.data, found.ctypes.data, 100)
    np.testing.assert_allclose(found[:, 0].ravel(), erfc(x), rtol=5e-14)
    np.testing.assert_allclose(found[:, 1].ravel(), np.exp(-8.0 * x), rtol=2e-15)


_FORKED = """
import os, signal, sys
import optimize.kernel.evaluator as e
e._pool().submit(int).result()
child = os.fork()
if child == 0:
    signal.alarm(20)  # where it hangs, this ends it
    e._pool().submit(int).result()
    os._exit(0)
sys.exit(os.waitpid(child, 0)[1])
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_has_threads_of_its_own():
    subprocess.run([sys.executable, "-c", _FORKED], check=True)


_WITHOUT_JIT = """
import os; os.environ["NUMBA_DISABLE_JIT"] = "1"
import optimize.kernel.evaluator as e
e.supported = lambda *_: True
assert e.compiled_evaluator(None, None) is None
"""


def test_every_band_has_its_place_even_one_that_is_not_a_number():
    from optimize.kernel.spectrum import _rank_ends

    count, lane = 4, 3
    offset = np.zeros((count, 8))
    offset[:, lane] = [0.3, np.nan, 0.0, np.inf]
    order, ends = np.zeros(count, dtype=np.int64), np.zeros((2 * count, 8))
    low, high = np.full((2, count, 8), -1)
    arrays = (order, ends, low, high)
    _rank_ends(offset.ctypes.data, lane, count, *(array.ctypes.data for array in arrays))
    assert sorted([*low[:, lane], *high[:, lane]]) == list(range(2 * count))


def test_without_numba_there_is_no_compiled_form():
    code = (
        "import sys; sys.modules['numba'] = None\n"
        "import optimize.kernel.evaluator as e\n"
        "e.supported = lambda *_: True\n"
        "assert e.compiled_evaluator(None, None) is None\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    subprocess.run([sys.executable, "-c", _WITHOUT_JIT], check=True)
    code = "import sys, optimize; assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
