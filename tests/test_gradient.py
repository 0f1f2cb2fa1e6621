"""Analytic derivatives against central differences of the scores that the search uses."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formation import Orbit, ground_track_circular, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    monostatic,
    one_transmitter,
    ping_pong,
)
from optimize import Constraints, DesignSpace, GeneticSettings, Problem, SearchSettings, search
from optimize.gradient import design_slopes

N = Orbit.circular(altitude=514e3, inclination=1.7).mean_motion
SCENE = Scene.broadside_strip(
    times=[1.0, 120.0, 400.0],
    look_angle=np.deg2rad(25),
    altitude=514e3,
    earth_radius=6_378_137.0,
)


def build(count, *, family=ground_track_circular, images=one_transmitter, limits=None, **changes):
    radar = {name: changes.pop(name) for name in ("azimuth_resolution", "snr") if name in changes}
    problem = Problem(
        mean_motion=N,
        scene=SCENE,
        radar=Radar(
            wavelength=0.031,
            slant_range_resolution=3.0,
            looks=16.0,
            images=images(count),
            **({"snr": 10.0} | radar),
        ),
        errors=ErrorBudget(
            **(
                {
                    "position": ErrorSource(0.001, SharedBy.SATELLITE),
                    "azimuth": ErrorSource(1e-5, SharedBy.ALL),
                    "synchronization": ErrorSource(0.02, SharedBy.IMAGE),
                    "range": ErrorSource(0.01, SharedBy.ALL),
                }
                | changes
            )
        ),
        constraints=limits
        or Constraints(
            max_radius=1350.0,
            min_separation=100.0,
            min_unwrapping_probability=0.99,
            prior_height_std=4.0,
            max_baseline_fraction=0.7,
            max_offset=500.0,
            max_rate=0.6,
        ),
    )
    space = DesignSpace(
        names=tuple(f"S{i}" for i in range(count)),
        family=family,
        mean_motion=N,
        max_offset=600.0,
        max_rate=600.0 * N,
        signs=(1, -1),
    )
    return problem, space


def differences(problem, space, design, step=1e-5):
    free = 2 * space.satellites
    points = np.repeat(design[None], 4 * free, axis=0)
    for row, factor in enumerate((1.0, -1.0, 2.0, -2.0)):
        index = np.arange(free)
        points[row * free + index, index] += factor * step * space.upper[:free]
    objectives, margins = problem.objectives_and_margins(space.states(points))
    values = np.concatenate([np.log(objectives)[:, None], *margins], axis=-1)
    near, mirror, far, far_mirror = values.reshape(4, free, -1)
    slopes = (8.0 * (near - mirror) - (far - far_mirror)) / (12.0 * step)
    return slopes.T  # of fourth order: truncation and rounding near 1e-10


def joined(margins):
    return np.concatenate([np.empty((len(margins[0]) if margins else 1, 0)), *margins], axis=-1)


def compare(problem, space, design, rtol=1e-6):
    slopes = design_slopes(problem, space)(design)
    assert slopes is not None
    objectives, margins = problem.objectives_and_margins(space.states(design[None]))
    assert slopes.objective == objectives[0]
    np.testing.assert_array_equal(slopes.margins, joined(margins)[0])
    upper = space.upper[: 2 * space.satellites]
    analytic = np.vstack([slopes.log_objective_slopes, slopes.margin_slopes]) * upper
    numeric = differences(problem, space, design)
    scale = np.abs(numeric).max(axis=-1, keepdims=True) + 1e-3
    np.testing.assert_allclose(analytic / scale, numeric / scale, atol=rtol, rtol=0.0)


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(2, 6),
    family=st.sampled_from([space_circular, ground_track_circular]),
    images=st.sampled_from([one_transmitter, monostatic]),
    azimuth_resolution=st.sampled_from([None, 3.0]),
    decorrelation=st.sampled_from([BaselineDecorrelation.FILTERED, BaselineDecorrelation.NONE]),
    size=st.floats(0.2, 0.9),
)
def test_gradients_are_those_of_the_scores(
    seed, count, family, images, azimuth_resolution, decorrelation, size
):
    problem, space = build(
        count,
        family=family,
        images=images,
        azimuth_resolution=azimuth_resolution,
        baseline_decorrelation=decorrelation,
    )
    rng = np.random.default_rng(seed)
    design = size * rng.uniform(-1.0, 1.0, space.dimension) * space.upper
    # A smooth function is compared: no two bands may end, and no two rungs be as sure, within the
    # step. Random designs stay away from that but for one in some thousands.
    compare(problem, space, design)


@pytest.mark.parametrize("source", ["position", "azimuth", "synchronization"])
def test_each_shared_error_alone(source):
    none = ErrorSource(0.0, SharedBy.SATELLITE)
    quiet = {
        "position": none,
        "azimuth": none._replace(shared_by=SharedBy.ALL),
        "synchronization": none._replace(shared_by=SharedBy.IMAGE),
    }
    quiet.pop(source)
    problem, space = build(4, **quiet)
    rng = np.random.default_rng(5)
    compare(problem, space, 0.6 * rng.uniform(-1.0, 1.0, space.dimension) * space.upper)


def test_many_satellites():
    problem, space = build(20)
    rng = np.random.default_rng(1)
    compare(problem, space, 0.5 * rng.uniform(-1.0, 1.0, space.dimension) * space.upper, rtol=1e-5)


def test_images_of_several_transmitters():
    problem, space = build(3, images=ping_pong)
    rng = np.random.default_rng(2)
    compare(problem, space, 0.3 * rng.uniform(-1.0, 1.0, space.dimension) * space.upper)


def test_no_limits_no_rows():
    problem, space = build(3, limits=Constraints(max_radius=1e9))
    problem = dataclasses.replace(problem, constraints=Constraints())
    rng = np.random.default_rng(3)
    design = rng.uniform(-0.5, 0.5, space.dimension) * space.upper
    slopes = design_slopes(problem, space)(design)
    assert slopes.margin_slopes.shape == (0, 6)
    compare(problem, space, design)


def test_what_is_not_known_in_closed_form_is_left_to_differences():
    rng = np.random.default_rng(4)
    for changes in (
        {"weighting": Weighting.PAIRS, "synchronization": ErrorSource(0.0, SharedBy.IMAGE)},
        {"baseline_decorrelation": BaselineDecorrelation.UNFILTERED},
    ):
        problem, space = build(3, **changes)
        design = rng.uniform(-0.3, 0.3, space.dimension) * space.upper
        assert design_slopes(problem, space)(design) is None
    problem, space = build(3)
    assert design_slopes(problem, space)(np.zeros(space.dimension)) is None  # measures nothing


def test_a_model_that_grew_is_noticed(monkeypatch):
    """A factor in `insar` that the derivatives don't know must not give a wrong slope."""
    problem, space = build(3)
    design = np.random.default_rng(6).uniform(-0.3, 0.3, space.dimension) * space.upper
    assert design_slopes(problem, space)(design) is not None
    original = Problem.population

    def changed(self, states):
        population = original(self, states)
        model = population.model._replace(information=population.model.information * 1.001)
        return dataclasses.replace(population, given_model=model)

    monkeypatch.setattr(Problem, "population", changed)
    assert design_slopes(problem, space)(design) is None


def test_the_refinement_ends_where_differences_lead(monkeypatch):
    import sys

    problem, space = build(6)
    genetic = GeneticSettings(population=30, generations=10)
    chosen = SearchSettings(genetic, refinements=3, structured=4)

    def found():
        return search(problem, space, settings=chosen, rng=np.random.default_rng(1))

    closed = found()
    monkeypatch.setattr(sys.modules["optimize.scoring"], "design_slopes", lambda *_: lambda _: None)
    differenced = found()
    # Where descents end on the kinks of azimuth bands is theirs: a few millionths.
    assert closed.objective == pytest.approx(differenced.objective, rel=5e-6)
    # Populations and structured designs are scored in both.
    assert closed.evaluations < 0.3 * differenced.evaluations
