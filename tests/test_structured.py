"""Dumbbells and ladders: the shapes that optimal formations take."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from configs import example_path, load_study
from configs.build import build_optimize
from formation import ground_track_circular, min_separation, orbit_radius, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    SharedBy,
    Weighting,
    one_transmitter,
)
from optimize import Constraints, DesignSpace, Problem
from optimize.projection import plane_radius, projection
from optimize.refinement import refine
from optimize.structured import dumbbells, ladders, structured_designs

N_LI = 1.10341e-3


def li_problem(scene, radar, *, family, satellites, decorrelation=BaselineDecorrelation.NONE):
    """The paper's radar, geometry and limits, with every shared error treated as shared."""
    errors = ErrorBudget(
        position=ErrorSource(0.01, SharedBy.SATELLITE),
        azimuth=ErrorSource(np.deg2rad(0.01), SharedBy.ALL),
        range=ErrorSource(0.01, SharedBy.ALL),
        weighting=Weighting.PAIRS,
        baseline_decorrelation=decorrelation,
        held_constant=HeldConstant.AZIMUTH,
        phase_std=0.316,
    )
    problem = Problem(
        mean_motion=N_LI,
        scene=scene,
        radar=dataclasses.replace(radar, images=one_transmitter(satellites)),
        errors=errors,
        constraints=Constraints(max_radius=1211.2, min_separation=100.0),
    )
    space = DesignSpace(
        names=tuple(f"S{i}" for i in range(satellites)),
        family=family,
        mean_motion=N_LI,
        max_offset=605.6,
        max_rate=605.6 * N_LI,
    )
    return problem, space


def polished(problem, space, design):
    """Its height error after refinement."""

    def score(designs):
        objectives, margins = problem.objectives_and_margins(space.states(designs))
        return objectives, np.concatenate(margins, axis=-1)

    best = refine(score, design, upper=space.upper, free=2 * space.satellites).design
    evaluation = problem.evaluate(space.states(best[None]))
    assert evaluation.feasible[0]
    return evaluation.objectives[0]


@pytest.mark.parametrize(
    ("satellites", "family", "expected"),
    [
        (3, space_circular, 1.117366),
        (3, ground_track_circular, 0.996068),
        (4, space_circular, 0.912008),
        (4, ground_track_circular, 0.813011),
        (5, space_circular, 0.832479),
        (8, ground_track_circular, 0.575715),
    ],
)
def test_the_best_dumbbell_is_the_known_optimum(
    li2009_scene, li2009_radar, satellites, family, expected
):
    problem, space = li_problem(li2009_scene, li2009_radar, family=family, satellites=satellites)
    start = structured_designs(problem, space, count=1)[0]
    # Six digits were recorded, of an optimum computed by another program.
    assert_allclose(polished(problem, space, start), expected, rtol=2e-6)


def test_every_dumbbell_and_ladder_keeps_radius_and_separation():
    # On a circle of 300 m, seven satellites 100 m apart in the plane leave little room.
    for shape in dumbbells(7, radius=300.0, separation=100.0):
        states = space_circular(shape[..., 0], shape[..., 1] * N_LI, mean_motion=N_LI)
        assert np.all(orbit_radius(shape[..., 0], shape[..., 1] * N_LI, mean_motion=N_LI) <= 600.0)
        assert np.all(min_separation(states, mean_motion=N_LI) >= 200.0)
    # Long enough ladders of three keep the distance whatever their gaps; all keep the radius.
    direction = np.array([0.6, 0.8])
    points = ladders(3, direction=direction, radius=600.0, separation=50.0)
    assert np.all(np.hypot(points[..., 0], points[..., 1]) <= 600.0)
    states = space_circular(points[..., 0], points[..., 1] * N_LI, mean_motion=N_LI)
    long_enough = np.ptp(points @ direction, axis=-1) > 200.0
    assert np.all(min_separation(states, mean_motion=N_LI)[long_enough] >= 100.0)


@pytest.mark.parametrize("name", ["three_sat", "four_sat"])
def test_the_starts_lie_in_the_box_and_are_feasible_and_different(name):
    setup = build_optimize(load_study(example_path(name)).study)
    designs = structured_designs(setup.problem, setup.space, count=6)
    assert len(designs) == 6
    assert np.all(np.abs(designs) <= setup.space.upper)
    evaluation = setup.problem.evaluate(setup.space.states(designs))
    assert np.all(evaluation.feasible)
    assert np.all(np.diff(evaluation.objectives) > 1e-9)


def test_projection_is_what_the_error_model_projects(li2009_scene, li2009_radar, mean_motion):
    problem, space = li_problem(
        li2009_scene, li2009_radar, family=ground_track_circular, satellites=3
    )
    seen = projection(space, problem.scene, held_constant=HeldConstant.AZIMUTH, sign=-1)
    plane = np.random.default_rng(3).normal(size=(3, 2)) * 300.0
    states = ground_track_circular(plane[:, 0], plane[:, 1] * N_LI, mean_motion=N_LI, sign=-1)
    model = problem.population(states[None]).model
    along = plane @ seen.height.T
    kz = 2.0 * np.pi / problem.radar.wavelength * (along - along[0]).T / seen.lever[:, None]
    assert_allclose(model.vertical_wavenumber[0], kz, rtol=1e-12, atol=1e-16)
    across = plane @ seen.azimuth.T
    phase = 2.0 * np.pi / problem.radar.wavelength * np.deg2rad(0.01) * (across - across[0]).T
    assert_allclose(model.nuisance["azimuth"][0, ..., 0], phase, rtol=1e-12, atol=1e-12)


def test_discs_about_a_box():
    space = DesignSpace(
        names=("A", "B"),
        family=space_circular,
        mean_motion=1e-3,
        max_offset=300.0,
        max_rate=0.4,
    )
    assert plane_radius(space, max_radius=None) == pytest.approx(500.0)
    assert plane_radius(space, max_radius=None, inscribed=True) == pytest.approx(300.0)
    assert plane_radius(space, max_radius=800.0) == pytest.approx(400.0)
