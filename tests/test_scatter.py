"""The direct path for images that are all alike against the general form with matrices."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formation import Orbit
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    height_error_of,
    monostatic,
    one_transmitter,
)
from insar.coherence import UniformVolume
from optimize import Constraints, Problem
from optimize.scatter import scatter_of

N = Orbit.circular(altitude=514e3, inclination=1.7).mean_motion


def problem_of(rng, count, *, images=one_transmitter, **changes):
    errors = {
        "position": ErrorSource(0.001, SharedBy.SATELLITE),
        "azimuth": ErrorSource(1e-5, SharedBy.ALL),
        "range": ErrorSource(0.01, SharedBy.ALL),
        "baseline_decorrelation": BaselineDecorrelation.NONE,
    } | changes
    return Problem(
        mean_motion=N,
        scene=Scene.broadside_strip(
            times=np.sort(rng.uniform(0.0, 3000.0, 4)),
            look_angle=rng.uniform(0.3, 0.8),
            altitude=514e3,
            earth_radius=6_378_137.0,
        ),
        radar=Radar(
            wavelength=0.031,
            slant_range_resolution=3.0,
            snr=rng.uniform(2.0, 30.0),
            looks=rng.uniform(1.0, 40.0),
            images=images(count),
        ),
        errors=ErrorBudget(**errors),
        constraints=Constraints(),
    )


def states_of(rng, count, formations=20):
    """Any states, not only those of circular relative orbits."""
    scale = [300.0, 300.0, 300.0, 300.0 * N, 300.0 * N, 300.0 * N]
    return rng.uniform(-1.0, 1.0, (formations, count, 6)) * scale


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_it_is_the_general_form_for_any_states(data):
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    count = data.draw(st.sampled_from([2, 3, 5, 9]))
    joint = data.draw(st.booleans())
    problem = problem_of(
        rng,
        count,
        images=data.draw(st.sampled_from([one_transmitter, monostatic])),
        position=ErrorSource(data.draw(st.sampled_from([0.0, 0.001, 0.1])), SharedBy.SATELLITE),
        azimuth=ErrorSource(data.draw(st.sampled_from([0.0, 1e-6, 1e-3])), SharedBy.ALL),
        weighting=Weighting.JOINT if joint else Weighting.PAIRS,
        held_constant=data.draw(st.sampled_from(HeldConstant)),
        phase_statistics=data.draw(st.sampled_from(PhaseStatistics)),
        phase_std=None if joint or data.draw(st.booleans()) else 0.3,
    )
    states = states_of(rng, count)
    population = problem.population(states)
    general = height_error_of(
        population.model, scene=problem.scene, radar=problem.radar, errors=problem.errors
    ).region
    direct = scatter_of(
        scene=problem.scene, radar=problem.radar, errors=problem.errors, mean_motion=N
    )
    assert direct is not None
    # Shared errors of 0.1 m are 20 rad: the matrices of the general form have a condition of 1e5.
    np.testing.assert_allclose(direct.region(states), general, rtol=1e-11)
    np.testing.assert_array_equal(problem.evaluate(states).objectives, direct.region(states))


def test_more_formations_than_a_chunk_are_those_of_each_alone():
    rng = np.random.default_rng(3)
    problem, states = problem_of(rng, 3), states_of(rng, 3, formations=1100)
    together = problem.evaluate(states).objectives
    alone = np.concatenate([problem.evaluate(state[None]).objectives for state in states[::100]])
    np.testing.assert_allclose(together[::100], alone, rtol=1e-13)


def test_nothing_is_measured_without_a_baseline():
    rng = np.random.default_rng(4)
    problem = problem_of(rng, 3)
    assert np.all(np.isinf(problem.evaluate(np.zeros((2, 3, 6))).objectives))


@pytest.mark.parametrize(
    "changes",
    [
        {"baseline_decorrelation": BaselineDecorrelation.FILTERED},
        {"weighting": Weighting.PAIRS, "azimuth": ErrorSource(1e-5, SharedBy.PAIR)},
        {"synchronization": ErrorSource(0.1, SharedBy.IMAGE)},  # the first image has none
        {
            "coherence": dataclasses.replace(
                ErrorBudget().coherence, volume=UniformVolume(height=5.0)
            )
        },
        {"coherence": dataclasses.replace(ErrorBudget().coherence, image_snr=(1.0, 1.0, 2.0))},
    ],
)
def test_images_that_differ_are_left_to_matrices(changes):
    problem = problem_of(np.random.default_rng(5), 3, **changes)
    given = {"scene": problem.scene, "radar": problem.radar, "errors": problem.errors}
    assert scatter_of(**given, mean_motion=N) is None
