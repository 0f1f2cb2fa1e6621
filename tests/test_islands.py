"""The algorithms of the populations, alone: on a landscape whose optimum is known by hand."""

from __future__ import annotations

import json

import numpy as np
import pytest

from optimize import (
    CovarianceSettings,
    DifferentialSettings,
    Evaluation,
    GeneticSettings,
    IslandSettings,
    SearchMethod,
)
from optimize.islands import generations

UPPER = np.array([5.0, 5.0, 2.0])
TARGET = np.array([3.0, 0.0, 1.0])

ALGORITHMS = {
    SearchMethod.GENETIC: GeneticSettings(population=30, generations=60),
    SearchMethod.DIFFERENTIAL_EVOLUTION: DifferentialSettings(population=30, generations=60),
    SearchMethod.CMA_ES: CovarianceSettings(population=20, generations=60),
}
algorithms = pytest.mark.parametrize("algorithm", ALGORITHMS.values(), ids=ALGORITHMS)


def evaluate(designs):
    """A bowl about TARGET, with x ≤ 1: the optimum is (1, 0, 1), of value 1 + 4 = 5."""
    violation = np.maximum(designs[:, 0] - 1.0, 0.0)[:, None]
    return Evaluation(1.0 + np.sum((designs - TARGET) ** 2, axis=-1), violation)


def run(algorithm, *, seed=1, islands=None, state=None, scores=evaluate, start=None):
    return list(
        generations(
            scores,
            lower=-UPPER,
            upper=UPPER,
            algorithm=algorithm,
            rng=np.random.default_rng(seed),
            islands=islands,
            state=state,
            start=start,
        )
    )


def test_each_algorithm_says_which_it_is():
    assert {settings.method for settings in ALGORITHMS.values()} == set(SearchMethod)


@algorithms
@pytest.mark.parametrize("islands", [1, 3])
def test_finds_the_constrained_optimum(algorithm, islands):
    history = run(algorithm, islands=IslandSettings(islands, migration_interval=5))
    feasible = [
        objective
        for generation in history
        for objective in generation.evaluation.objectives[generation.evaluation.feasible]
    ]
    # 1 % of 5: a distance of 0.22 from the optimum in a box of 10 x 10 x 4. Uniform draws of as
    # many designs come within 2 %.
    assert min(feasible) == pytest.approx(5.0, rel=0.01)
    assert len(history[0].designs) == islands * algorithm.population


@algorithms
def test_stays_in_the_box(algorithm):
    history = run(algorithm)
    designs = np.concatenate([generation.designs for generation in history])
    assert np.all(np.abs(designs) <= UPPER)


@algorithms
@pytest.mark.parametrize("islands", [1, 2])
def test_goes_on_from_plain_data_as_if_nothing_had_happened(algorithm, islands):
    settings = IslandSettings(islands, migration_interval=4)
    whole = run(algorithm, islands=settings)
    for stop in (0, 4, 17):
        kept = json.loads(json.dumps(whole[stop].state))
        # Neither the seed nor the start of the second run matters: all comes from the state.
        rest = run(algorithm, islands=settings, seed=99, state=kept, start=np.ones((1, 3)))
        assert [generation.number for generation in rest] == list(range(stop + 1, 61))
        for one, other in zip(whole[stop + 1 :], rest, strict=True):
            assert np.array_equal(one.designs, other.designs)
        assert rest[-1].state == whole[-1].state


@algorithms
def test_knows_its_start_from_the_first(algorithm):
    start = np.array([[0.9, 0.1, 0.9]])
    first = run(algorithm._replace(generations=1), start=start)[0]
    assert np.min(np.abs(first.designs - start).max(axis=-1)) < 1e-12


@algorithms
def test_a_collapsed_population_begins_anew(algorithm):
    """On a needle all designs agree soon; a restart spreads them over the box again."""

    def needle(designs):
        return Evaluation(np.sum(np.abs(designs), axis=-1), np.zeros((len(designs), 1)))

    long = algorithm._replace(generations=400)
    if algorithm.method is SearchMethod.GENETIC:  # without mutation it becomes all alike
        long = long._replace(mutation_probability=0.0)
    extent = {
        restart: max(
            np.ptp(generation.designs, axis=0).max()
            for generation in run(long, scores=needle, islands=IslandSettings(restart=restart))[
                200:
            ]
        )
        for restart in (True, False)
    }
    assert extent[True] > 2.0
    assert extent[False] < 0.1


@pytest.mark.parametrize(
    "algorithm",
    [ALGORITHMS[SearchMethod.GENETIC], ALGORITHMS[SearchMethod.DIFFERENTIAL_EVOLUTION]],
    ids=["genetic", "differential_evolution"],
)
def test_the_best_of_an_island_reaches_the_next(algorithm):
    box = {"lower": -UPPER, "upper": UPPER}
    population = algorithm.begin(**box, rng=np.random.default_rng(3), start=None)
    population.learn(evaluate(population.propose()))
    population.welcome(np.array([1.0, 0.0, 1.0]), np.array([0.0, 5.0]))
    design, scores = population.champion
    assert design.tolist() == [1.0, 0.0, 1.0]
    assert scores.tolist() == [0.0, 5.0]
    # One that is worse than all of them is turned away.
    before = population.plain()["designs"]
    population.welcome(np.array([5.0, 5.0, 2.0]), np.array([100.0, 5.0]))
    assert population.plain()["designs"] == before


def test_covariance_adapts_to_a_narrow_valley():
    """A valley 1000 times as steep across as along, turned by 30°: what CMA-ES is for."""
    turn = np.deg2rad(30.0)
    along = np.array([np.cos(turn), np.sin(turn), 0.0])
    across = np.array([-np.sin(turn), np.cos(turn), 0.0])

    def valley(designs):
        moved = designs - np.array([1.0, -2.0, 0.5])
        value = (moved @ along) ** 2 + 1e6 * (moved @ across) ** 2 + moved[:, 2] ** 2
        return Evaluation(value, np.zeros((len(designs), 1)))

    reached = {
        settings.method: min(
            generation.evaluation.objectives.min()
            for generation in run(settings._replace(population=20, generations=100), scores=valley)
        )
        for settings in ALGORITHMS.values()
    }
    assert reached[SearchMethod.CMA_ES] < 1e-4
    assert reached[SearchMethod.CMA_ES] < 0.01 * reached[SearchMethod.GENETIC]
