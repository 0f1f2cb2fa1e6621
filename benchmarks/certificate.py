"""Is the certificate sound, and how tight is it?

    python benchmarks/certificate.py soundness [problems]   random problems, feasible designs
    python benchmarks/certificate.py tightness [model]       N x family x model

`soundness` draws problems (two to eight satellites, both families, random radars, scenes, budgets
and limits) until 100 000 feasible designs were compared with the bounds of their problem; none may
be better. The best design of each problem is refined too, as the worst enemy of its bound.
"""

from __future__ import annotations

import dataclasses
import os
import sys
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from random_problems import random_designs, random_problem

from configs import example_path, load_study
from configs.build import build_optimize
from formation import ground_track_circular, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    one_transmitter,
)
from optimize import Constraints, DesignSpace, Problem
from optimize.certificate import CertificateSettings, certify
from optimize.refinement import refine
from optimize.structured import structured_designs

WANTED, PROBLEMS = 100_000, 140
N_LI = 1.10341e-3


def refined(problem, space, start):
    def score(designs):
        objectives, margins = problem.objectives_and_margins(space.states(designs))
        return objectives, np.concatenate([np.empty((len(designs), 0)), *margins], axis=-1)

    return refine(
        score, start, upper=space.upper, free=2 * space.satellites, max_iterations=30
    ).design


def best_of(problem, space, designs):
    evaluation = problem.evaluate(space.states(designs))
    return designs[np.lexsort((evaluation.objectives, evaluation.total_violation))[0]]


def soundness(problems_wanted=PROBLEMS, seed=20261128):
    rng = np.random.default_rng(seed)
    compared = problems = proved = 0
    closest = np.inf
    began = time.perf_counter()
    while compared < WANTED or problems < int(problems_wanted):
        satellites = 2 + problems % 7
        problem, space = random_problem(rng, satellites)
        designs = random_designs(rng, problem, space, 4000)
        enemy = refined(problem, space, best_of(problem, space, designs))
        designs = np.concatenate([designs, enemy[None]])
        evaluation = problem.evaluate(space.states(designs))
        proof = certify(
            problem,
            space,
            design=best_of(problem, space, designs),
            settings=CertificateSettings(max_boxes=4_000, tolerance=0.01),
        )
        problems += 1
        feasible = evaluation.objectives[evaluation.feasible]
        compared += feasible.size
        if proof.infeasibility is not None:
            proved += 1
            assert not feasible.size, "a feasible design of a problem that was proved infeasible"
        for bound in proof.bounds:
            if feasible.size and np.isfinite(bound.value):
                closest = min(closest, feasible.min() / bound.value - 1.0)
                assert bound.value <= feasible.min() * (1.0 + 1e-9), (problems, bound)
        if problems % 20 == 0:
            print(
                f"{problems} problems, {compared} feasible designs, {proved} proved infeasible, "
                f"least distance {closest:.2e}, {time.perf_counter() - began:.0f} s",
                flush=True,
            )
    print(
        f"none of {compared} feasible designs of {problems} problems beats its bound; the closest "
        f"is {closest:.2e} above; {proved} problems proved infeasible"
    )


def paper(satellites, family, decorrelation):
    """The paper's radar, limits and strip, every error shared, single look."""
    r = np.array([559.11, 558.97, 558.61, 558.08, 557.64, 557.58, 557.94, 558.48, 558.89, 559.10])
    look = np.array([23.18, 23.14, 23.05, 22.93, 22.82, 22.80, 22.89, 23.02, 23.12, 23.17])
    azimuth = np.array([82.16, 82.15, 82.12, 82.07, 82.03, 82.02, 82.05, 82.10, 82.15, 82.16])
    problem = Problem(
        mean_motion=N_LI,
        scene=Scene.flat_earth(
            times=np.arange(1.0, 11.0),
            slant_range=r * 1e3,
            look_angle=np.deg2rad(look),
            azimuth=np.deg2rad(azimuth),
        ),
        radar=Radar(
            wavelength=0.031,
            slant_range_resolution=3.0,
            snr=10.0,
            looks=1.0,
            images=one_transmitter(satellites),
        ),
        errors=ErrorBudget(
            position=ErrorSource(0.01, SharedBy.SATELLITE),
            azimuth=ErrorSource(2e-6, SharedBy.ALL),
            range=ErrorSource(0.01, SharedBy.ALL),
            baseline_decorrelation=decorrelation,
            phase_statistics=PhaseStatistics.CRAMER_RAO,
            held_constant=HeldConstant.AZIMUTH,
        ),
        constraints=Constraints(max_radius=1211.2, min_separation=100.0),
    )
    space = DesignSpace(
        names=tuple(f"S{index}" for index in range(satellites)),
        family=family,
        mean_motion=N_LI,
        max_offset=605.6,
        max_rate=605.6 * N_LI,
    )
    return problem, space


def shipped(name):
    setup = build_optimize(load_study(example_path(name)).study)
    return setup.problem, setup.space


def cases():
    families = {"space": space_circular, "ground": ground_track_circular}
    for model in (BaselineDecorrelation.NONE, BaselineDecorrelation.FILTERED):
        for count in (2, 3, 4, 5, 6, 8):
            for name, family in families.items():
                yield str(model), count, name, *paper(count, family, model)
    for name, family in families.items():
        yield "unfiltered", 3, name, *paper(3, family, BaselineDecorrelation.UNFILTERED)
    for name, count in (("three_sat", 3), ("four_sat", 4), ("three_sat_real", 3)):
        yield name, count, "ground", *shipped(name)
    problem, space = shipped("three_sat")
    space = dataclasses.replace(space, family=space_circular)
    yield "three_sat", 3, "space", problem, space


def tightness(only=""):
    print("| model | N | family | design [m] | bound [m] | gap [%] | method | seconds |")
    print("| --- | ---: | --- | ---: | ---: | ---: | --- | ---: |")
    for model, count, family, problem, space in cases():
        if only not in ("", model):
            continue
        starts = structured_designs(problem, space, count=4)
        design = best_of(
            problem, space, np.array([refined(problem, space, start) for start in starts])
        )
        began = time.perf_counter()
        proof = certify(problem, space, design=design)
        wall = time.perf_counter() - began
        print(
            f"| {model} | {count} | {family} | {proof.objective:.6f} | {proof.lower_bound:.6f} | "
            f"{100 * proof.gap:.2g} | {proof.strongest.method} | {wall:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    {"soundness": soundness, "tightness": tightness}[sys.argv[1]](*sys.argv[2:])
