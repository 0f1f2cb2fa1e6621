"""A target that no formation reaches, and what would make it possible."""

import dataclasses

import numpy as np
import pytest

from configs import example_path, load_study
from configs.build import build_optimize
from insar import ErrorSource, SharedBy
from optimize import CertificateSettings, SearchSettings, certify, judge_target, search
from optimize.certificate import reliefs as reliefs_of
from optimize.genetic import GeneticSettings


@pytest.fixture(scope="module")
def solved():
    """`three_sat` with its best design, and what is proven of it."""
    setup = build_optimize(load_study(example_path("three_sat")).study)
    problem, space = setup.problem, setup.space
    found = search(
        problem,
        space,
        settings=SearchSettings(GeneticSettings(population=8, generations=2), refinements=0),
        rng=np.random.default_rng(1),
    )
    return problem, space, found.design, certify(problem, space, design=found.design)


def judged(solved, factor):
    problem, space, design, proof = solved
    target = factor * proof.lower_bound
    return judge_target(problem, space, target=target, design=design, certificate=proof)


def test_a_target_is_reached_open_or_out_of_reach(solved):
    proof = solved[-1]
    assert proof.gap < 1e-3
    assert judged(solved, 1.0 + 2.0 * proof.gap).reached
    between = judged(solved, 1.0 + 0.5 * proof.gap)
    assert not between.reached
    assert between.impossible is None


def test_what_would_help_blocks_on_one_side_and_passes_on_the_other(solved, monkeypatch):
    monkeypatch.setattr(reliefs_of, "_STEPS", 5)  # as coarse as the test can be
    problem, space, design, _ = solved
    verdict = judged(solved, 0.8)
    assert not verdict.reached
    assert verdict.impossible is not None
    assert "0.99" in verdict.impossible.statement
    found_reliefs = {one.name: one for one in verdict.impossible.reliefs}
    # A larger radius is of no use: the baselines that cohere are within reach.
    assert set(found_reliefs) == {
        "standard deviation of the prior height",
        "probability of unwrapping",
        "position error",
    }
    position = found_reliefs["position error"]
    assert position.passes_at < position.blocks_to < position.limit == pytest.approx(1e-3)

    def eased(std):
        source = ErrorSource(std, SharedBy.SATELLITE)
        errors = dataclasses.replace(problem.errors, position=source)
        return dataclasses.replace(problem, errors=errors)

    # The full proof, which the bisection does not use, agrees on the side that blocks; a search
    # for itself finds a formation on the other.
    few = CertificateSettings(max_boxes=20_000)
    blocked = certify(eased(position.blocks_to), space, design=design, settings=few)
    assert blocked.lower_bound > verdict.height_error
    found = search(
        eased(position.passes_at),
        space,
        settings=SearchSettings(GeneticSettings(population=8, generations=2), refinements=0),
        rng=np.random.default_rng(2),
    )
    assert found.feasible
    assert found.objective <= verdict.height_error


def test_where_nothing_is_feasible_the_target_has_the_same_proof(solved):
    problem, space, design, _ = solved
    source = ErrorSource(0.0045, SharedBy.SATELLITE)
    noisy = dataclasses.replace(
        problem, errors=dataclasses.replace(problem.errors, position=source)
    )
    proof = certify(noisy, space, design=design)
    verdict = judge_target(noisy, space, target=0.2, design=design, certificate=proof)
    assert verdict.impossible is proof.infeasibility
    assert verdict.impossible is not None
