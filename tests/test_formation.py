"""Orbit, relative motion, families and separation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from formation import (
    Orbit,
    centered_state,
    drift_per_orbit,
    equally_spaced,
    ground_track_circular,
    min_separation,
    orbit_radius,
    propagate,
    relative_positions,
    satellite_pairs,
    space_circular,
    transition_matrix,
)

FAMILIES = {"space": space_circular, "ground": ground_track_circular}
CASES = ["space_initial", "ground_initial", "space_optimum", "ground_optimum"]


def test_mean_motion_of_li2009(mean_motion, li2009):
    # The printed ẋ of satellite 1 is 2·605.6·n = 1.3365 m/s, to four decimals.
    assert mean_motion == pytest.approx(1.10341e-3, rel=5e-6)
    printed = -li2009["space_initial"]["along_track_rate_m_s"][0]
    assert 2 * 605.6 * mean_motion == pytest.approx(printed, abs=5e-5)


def test_period_at_geostationary_radius_is_a_sidereal_day():
    orbit = Orbit(semi_major_axis=42_164_172.0, inclination=0.0)
    assert orbit.period == pytest.approx(86_164.09, abs=0.1)  # 1 m of radius is 3 ms


@pytest.mark.parametrize("case", CASES)
def test_states_of_li2009(case, li2009, mean_motion):
    printed = li2009[case]
    states = FAMILIES[printed["family"]](
        printed["z0_m"], printed["zdot0_m_s"], mean_motion=mean_motion
    )
    # Positions are printed to 0.1 m; ż0 to 5e-5 m/s, which is 0.045 m in ż0/n and doubled in T.
    assert_allclose(states[:, 1], printed["along_track_m"], atol=0.16)
    assert_allclose(states[:, 2], printed["cross_track_m"], atol=0.16)
    assert_allclose(states[:, 4], printed["along_track_rate_m_s"], atol=2e-4)
    assert_allclose(states[:, 5], printed["cross_track_rate_m_s"], atol=2e-4)


def test_initial_formation_of_li2009_is_equally_spaced(li2009, mean_motion):
    z0, zdot0 = equally_spaced(3, radius=1211.2, mean_motion=mean_motion)
    assert_allclose(z0, li2009["space_initial"]["z0_m"], atol=0.05)
    assert_allclose(zdot0, li2009["space_initial"]["zdot0_m_s"], atol=5e-5)


def test_transition_solves_the_differential_equations():
    n = 1.1e-3
    start = np.array([120.0, -340.0, 55.0, 0.21, -0.37, 0.11])

    def hill(_, state):
        r, _, cross, rdot, tdot, cross_rate = state
        return [rdot, tdot, cross_rate, 3 * n**2 * r + 2 * n * tdot, -2 * n * rdot, -(n**2) * cross]

    solution = solve_ivp(hill, (0, 9000), start, rtol=1e-12, atol=1e-9, t_eval=[1000, 9000])
    moved = propagate(start[None], [1000.0, 9000.0], mean_motion=n)[:, 0]
    assert_allclose(moved, solution.y.T, rtol=1e-8, atol=1e-6)


def test_transition_composes_and_starts_at_the_identity():
    n = 1.1e-3
    assert_allclose(transition_matrix(0.0, mean_motion=n), np.eye(6))
    whole = transition_matrix(1700.0, mean_motion=n)
    halves = transition_matrix(900.0, mean_motion=n) @ transition_matrix(800.0, mean_motion=n)
    assert_allclose(halves, whole, rtol=1e-9, atol=1e-9)


def test_linear_motion_against_two_body_orbits():
    """Two Keplerian orbits, differenced in RTN: the neglected curvature is of order d²/a."""
    orbit = Orbit.circular(altitude=514e3, inclination=1.7)
    a, n = orbit.semi_major_axis, orbit.mean_motion
    mu = n**2 * a**3
    state = space_circular(300.0, 0.2, mean_motion=n)
    position = np.array([a + state[0], state[1], state[2]])
    velocity = np.array(
        [state[3] - n * state[1], n * a + state[4] + n * state[0], state[5]]
    )  # inertial, axes of t = 0

    def gravity(_, y):
        return np.concatenate([y[3:], -mu * y[:3] / np.linalg.norm(y[:3]) ** 3])

    times = np.linspace(0, orbit.period, 9)
    solution = solve_ivp(
        gravity, (0, orbit.period), np.r_[position, velocity], rtol=1e-12, atol=1e-6, t_eval=times
    )
    c, s = np.cos(n * times), np.sin(n * times)
    x, y, z = solution.y[:3]
    truth = np.stack([c * x + s * y - a, c * y - s * x, z], axis=-1)
    linear = relative_positions(state[None], times, mean_motion=n)[:, 0]
    # d = 700 m: d²/2a = 0.036 m, which grows along track by 2π·3/2 of it times a few.
    assert_allclose(linear, truth, atol=1.5)
    assert_allclose(linear[:2], truth[:2], atol=0.15)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("family", FAMILIES.values(), ids=FAMILIES)
def test_families_are_circles_of_the_stated_radius(family, sign, mean_motion):
    state = family([300.0], [0.4], mean_motion=mean_motion, sign=sign)
    times = np.linspace(0, 2 * np.pi / mean_motion, 50)
    r, t, cross = relative_positions(state, times, mean_motion=mean_motion)[:, 0].T
    radius = orbit_radius(300.0, 0.4, mean_motion=mean_motion)
    if family is space_circular:
        assert_allclose(r**2 + t**2 + cross**2, radius**2, rtol=1e-12)
    else:
        assert_allclose(t**2 + cross**2, radius**2, rtol=1e-12)
    assert_allclose(cross, sign * (math.sqrt(3) if family is space_circular else 2) * r, atol=1e-9)
    assert_allclose(drift_per_orbit(state, mean_motion=mean_motion), 0, atol=1e-9)


def test_mirror_sign_broadcasts_over_a_population(mean_motion):
    z0, zdot0 = np.ones((4, 3)) * 100, np.ones((4, 3)) * 0.1
    signs = np.array([1, -1, 1, -1])[:, None]
    states = space_circular(z0, zdot0, mean_motion=mean_motion, sign=signs)
    assert np.array_equal(np.sign(states[..., 2]), np.broadcast_to(signs, (4, 3)))
    with pytest.raises(ValueError, match=r"\+1 or -1"):
        space_circular(1.0, 0.0, mean_motion=mean_motion, sign=2)


def test_drift_of_one_meter_of_radial_offset():
    # Closed form: a satellite at rest 1 m above drifts by −12π per orbit; with the velocity of
    # its own circular orbit (Ṫ = −1.5 n R), 3π: physics of +1 m of semi-major axis.
    n = 1.1e-3
    assert drift_per_orbit([1, 0, 0, 0, 0, 0], mean_motion=n) == pytest.approx(-12 * np.pi)
    circular = [1, 0, 0, 0, -1.5 * n, 0]
    assert drift_per_orbit(circular, mean_motion=n) == pytest.approx(-3 * np.pi)


finite = st.floats(-800, 800, allow_nan=False)


@given(st.lists(st.tuples(finite, finite), min_size=3, max_size=3), st.sampled_from([1, -1]))
def test_closest_approach_of_circular_families(plane, sign):
    """For |k| ≥ √3 the closest approach is 2|v_i − v_j| in the plane (z0, ż0/n)."""
    n = 1.1e-3
    v = np.array(plane)
    expected = [2 * np.hypot(*(v[j] - v[i])) for i, j in satellite_pairs(3)]
    for family in FAMILIES.values():
        states = family(v[:, 0], v[:, 1] * n, mean_motion=n, sign=sign)
        assert_allclose(min_separation(states, mean_motion=n), expected, rtol=1e-7, atol=1e-4)


@given(
    st.lists(
        st.tuples(finite, finite, finite, finite, st.just(0.0) | finite), min_size=2, max_size=4
    )
)
def test_closest_approach_against_samples(rows):
    """Any drift-free motion, with and without along-track offset, against a fine sampling."""
    n = 1.1e-3
    r, rate, cross, cross_rate, offset = np.array(rows).T
    states = centered_state(r, rate * n, cross, cross_rate * n, mean_motion=n)
    states[:, 1] += offset
    closest = min_separation(states, mean_motion=n)
    times = np.linspace(0, 2 * np.pi / n, 7201)
    positions = relative_positions(states, times, mean_motion=n)
    first, second = satellite_pairs(len(rows)).T
    sampled = np.linalg.norm(positions[:, second] - positions[:, first], axis=-1).min(axis=0)
    assert np.all(closest <= sampled + 1e-4)
    # Samples are 0.05° apart: at relative speeds up to 6000 m/rad a miss of 2.6 m at most.
    assert_allclose(closest, sampled, atol=2.7)


def test_closest_approach_of_a_leader_and_follower():
    states = np.zeros((2, 6))
    states[1, 1] = 250.0
    assert min_separation(states, mean_motion=1e-3) == pytest.approx(250.0)


@pytest.mark.parametrize("offset", [100.0, 600.0, 1500.0, -1500.0])
def test_closest_approach_to_a_circle_around_another_point(offset):
    """A circle of radius ρ in a plane that holds T, seen from a satellite ahead: ||T| − ρ|."""
    n = 1e-3
    states = np.stack([np.zeros(6), space_circular(250.0, 0.1, mean_motion=n)])
    states[0, 1] = offset
    radius = orbit_radius(250.0, 0.1, mean_motion=n)
    closest = min_separation(states, mean_motion=n)
    assert closest == pytest.approx(abs(abs(offset) - radius), abs=1e-6)


def test_closest_approach_needs_a_drift_free_pair():
    states = np.zeros((2, 6))
    states[1, 0] = 10.0
    with pytest.raises(ValueError, match="drifts by 377 m per orbit"):
        min_separation(states, mean_motion=1e-3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"semi_major_axis": 514e3, "inclination": 1.0}, "above the Earth's radius"),
        ({"semi_major_axis": float("nan"), "inclination": 1.0}, "finite"),
        ({"semi_major_axis": 7e6, "inclination": 97.0}, "give radians"),
    ],
)
def test_impossible_orbits_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        Orbit(**arguments)
