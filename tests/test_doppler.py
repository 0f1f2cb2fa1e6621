"""Doppler centroid and rate against the change of range, and Meng's simplified model."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from formation import States
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
    EARTH_J2,
    EARTH_ROTATION_RATE,
)
from insar import LookSide, line_of_sight
from insar.observe import (
    doppler_centroid,
    doppler_of_direction,
    doppler_rate,
    earth_fixed_acceleration,
    from_geodetic,
    inertial_velocity,
    intersect,
    look_at,
    orbit_geometry,
    pointing_sensitivity,
    raney,
    rtn_axes,
    simplified_azimuth,
    simplified_broadside_doppler,
    simplified_doppler,
    simplified_yaw,
    sphere,
)

WAVELENGTH = 0.03
# A change of range of 1.5e-5 m/s, far below what a SAR processor notices.
FINITE_DIFFERENCE = 1e-3  # Hz


@pytest.fixture(scope="module")
def targets(random_orbits):
    """A point in view of each satellite, in a random direction, at up to 9 km of height."""
    rng = np.random.default_rng(1)
    states = random_orbits.earth_fixed(0.0)
    disc = np.arcsin(EARTH_EQUATORIAL_RADIUS / np.linalg.norm(states.position, axis=-1))
    line = line_of_sight(
        look_angle=disc * rng.uniform(0.05, 0.95, len(disc)), azimuth=rng.uniform(-3, 3, len(disc))
    )
    beam = np.einsum("sji,sj->si", rtn_axes(states), line)
    return intersect(states.position, beam, height=rng.uniform(0, 9e3, len(disc)))


def ranges(orbits, targets, times):
    """Distances in inertial axes, where the targets turn with the Earth; (T, S)."""
    turned = np.stack([orbits.turned(targets, -time) for time in times])
    satellites = np.stack([orbits.inertial(time).position for time in times])
    return np.linalg.norm(satellites - turned, axis=-1)


def test_centroid_is_the_rate_of_the_range(random_orbits, targets):
    """f = −(2/λ) dr/dt, by differences of fourth order over ±0.1 s; the whole of it is 1e5 Hz."""
    step = 0.05
    r = ranges(random_orbits, targets, step * np.array([-2, -1, 1, 2]))
    rate = (r[0] - 8.0 * r[1] + 8.0 * r[2] - r[3]) / (12.0 * step)
    doppler = doppler_centroid(random_orbits.earth_fixed(0.0), targets, wavelength=WAVELENGTH)
    assert np.ptp(doppler) > 1e5
    assert_allclose(doppler, -2.0 / WAVELENGTH * rate, atol=FINITE_DIFFERENCE)


def test_centroid_is_that_of_the_direction(random_orbits, targets):
    """(R_s − R_t)·(ω×(R_s − R_t)) = 0: the identity behind every steering law."""
    states = random_orbits.earth_fixed(0.0)
    line = look_at(states, targets).line_of_sight
    assert_allclose(
        doppler_of_direction(states, line, wavelength=WAVELENGTH),
        doppler_centroid(states, targets, wavelength=WAVELENGTH),
        atol=1e-7,  # rounding of 1e7 m and 1e4 m/s
    )


def test_doppler_is_positive_where_the_satellite_approaches():
    states = States(np.array([7e6, 0.0, 0.0]), np.array([0.0, 0.0, 7.5e3]))
    ahead = from_geodetic(latitude=0.05, longitude=0.0)
    assert doppler_centroid(states, ahead, wavelength=0.03) > 0.0
    assert doppler_of_direction(states, [0.0, 0.0, 1.0], wavelength=0.03) == 2.0 / 0.03 * 7.5e3


@pytest.mark.parametrize("wavelength", [0.0, -0.03, np.nan])
def test_impossible_wavelengths_are_refused(wavelength):
    states = States(np.array([7e6, 0.0, 0.0]), np.array([0.0, 0.0, 7.5e3]))
    with pytest.raises(ValueError, match=r"wavelength = .* m must be positive; give meters"):
        doppler_of_direction(states, [0.0, 0.0, 1.0], wavelength=wavelength)


def test_rate_is_the_derivative_of_the_centroid(random_orbits, targets):
    """By differences of fourth order; without J2, as the orbits."""
    step = 0.05
    f = [
        doppler_centroid(random_orbits.earth_fixed(time), targets, wavelength=WAVELENGTH)
        for time in step * np.array([-2, -1, 1, 2])
    ]
    expected = (f[0] - 8.0 * f[1] + 8.0 * f[2] - f[3]) / (12.0 * step)
    states = random_orbits.earth_fixed(0.0)
    rate = doppler_rate(
        states,
        targets,
        wavelength=WAVELENGTH,
        acceleration=earth_fixed_acceleration(states, j2=0.0),
    )
    # Rounding of 1e-9 Hz in the centroid over 0.1 s; the rates go up to 1e4 Hz/s.
    assert_allclose(rate, expected, atol=1e-5)
    assert np.min(rate) < -5e3
    # J2 pulls by 1e-3 of gravity at most: 0.01 m/s².
    with_j2 = doppler_rate(states, targets, wavelength=WAVELENGTH)
    assert 1e-3 < np.max(np.abs(with_j2 - rate)) < 2.0 / WAVELENGTH * 0.02


def potential(position):
    """Of a point mass with J2, positive."""
    r = np.linalg.norm(position, axis=-1)
    sine = position[..., 2] / r
    oblate = EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / r) ** 2 * (3.0 * sine**2 - 1.0) / 2.0
    return EARTH_GRAVITATIONAL_PARAMETER / r * (1.0 - oblate)


def test_acceleration_at_rest_is_the_gradient_of_gravity_and_centrifugal_force(random_orbits):
    position = random_orbits.earth_fixed(0.0).position
    step = 100.0 * np.eye(3)[:, None]

    def total(point):
        return potential(point) + 0.5 * EARTH_ROTATION_RATE**2 * np.sum(point[..., :2] ** 2, -1)

    gradient = (total(position + step) - total(position - step)) / 200.0
    rest = States(position, np.zeros_like(position))
    # Rounding of 6e7 m²/s² over 200 m, and (100 m/r)² of gravity.
    assert_allclose(earth_fixed_acceleration(rest), gradient.T, atol=1e-8)


def test_coriolis_acceleration_is_perpendicular_to_velocity_and_axis(random_orbits):
    states = random_orbits.earth_fixed(0.0)
    rest = States(states.position, np.zeros_like(states.velocity))
    coriolis = earth_fixed_acceleration(states) - earth_fixed_acceleration(rest)
    expected = -2.0 * np.cross([0.0, 0.0, EARTH_ROTATION_RATE], states.velocity)
    assert_allclose(coriolis, expected, atol=1e-14)


def test_pointing_sensitivity_is_the_steepest_slope(random_orbits, targets):
    """Largest change over a ring of directions around the beam, 1e-5 rad away."""
    states = random_orbits.earth_fixed(0.0)
    line = look_at(states, targets).line_of_sight
    one = np.cross(line, states.position)
    one /= np.linalg.norm(one, axis=-1, keepdims=True)
    around = np.linspace(0.0, 2.0 * np.pi, 721)[:, None, None]
    ring = line + 1e-5 * (np.cos(around) * one + np.sin(around) * np.cross(line, one))
    change = doppler_of_direction(states, ring - line, wavelength=WAVELENGTH).max(axis=0) / 1e-5
    # Directions are 0.5° apart: cos 0.25° is 1 − 9.5e-6.
    assert_allclose(pointing_sensitivity(states, line, wavelength=WAVELENGTH), change, rtol=1.2e-5)


# -- the simplified model ------------------------------------------------------------------------

angles = st.floats(-np.pi, np.pi)


def circular_state(argument_of_latitude, inclination, *, radius=6.878e6):
    c, s = np.cos(argument_of_latitude), np.sin(argument_of_latitude)
    plane = np.array([0.0, np.cos(inclination), np.sin(inclination)])
    position = radius * (c * np.array([1.0, 0.0, 0.0]) + s * plane)
    speed = np.sqrt(EARTH_GRAVITATIONAL_PARAMETER / radius)
    velocity = speed * (c * plane - s * np.array([1.0, 0.0, 0.0]))
    states = States(position, velocity - np.cross([0, 0, EARTH_ROTATION_RATE], position))
    assert_allclose(inertial_velocity(states), velocity, atol=1e-11)
    return states, speed / radius


@given(angles, st.floats(0.05, 3.1), st.floats(0.05, 1.1), st.floats(0.0, np.pi))
@pytest.mark.parametrize("side", list(LookSide))
def test_simplified_model_is_exact_on_its_own_ground(
    side, argument_of_latitude, inclination, look_angle, azimuth
):
    """Circular orbit, sphere: equal to the exact centroid in any direction, on both sides."""
    states, rate = circular_state(argument_of_latitude, inclination)
    line = line_of_sight(look_angle=look_angle, azimuth=int(side) * azimuth) @ rtn_axes(states)
    target = intersect(states.position, line, ellipsoid=sphere(6.371e6))
    place = {
        "radius": 6.878e6,
        "inclination": inclination,
        "argument_of_latitude": argument_of_latitude,
        "look_angle": look_angle,
        "side": side,
        "wavelength": WAVELENGTH,
    }
    simplified = simplified_doppler(orbital_rate=rate, azimuth=azimuth, **place)
    exact = doppler_centroid(states, target, wavelength=WAVELENGTH)
    assert_allclose(simplified, exact, atol=1e-7)
    assert_allclose(
        simplified_broadside_doppler(**place),
        simplified_doppler(orbital_rate=rate, azimuth=np.pi / 2, **place),
        atol=1e-8,
    )


@given(angles, st.floats(0.05, 3.1))
@pytest.mark.parametrize("side", list(LookSide))
def test_simplified_yaw_is_that_of_raney(side, argument_of_latitude, inclination):
    """Meng (4) takes (3) to zero and is Raney's yaw, whichever side the radar looks to."""
    states, rate = circular_state(argument_of_latitude, inclination)
    place = {"inclination": inclination, "argument_of_latitude": argument_of_latitude, "side": side}
    chi = simplified_azimuth(orbital_rate=rate, **place)
    zero = simplified_doppler(
        radius=6.878e6,
        orbital_rate=rate,
        look_angle=0.6,
        azimuth=chi,
        wavelength=WAVELENGTH,
        **place,
    )
    assert_allclose(zero, 0.0, atol=1e-9)
    k = -int(side)
    assert_allclose(
        -k * simplified_yaw(orbital_rate=rate, **place),
        raney(orbit_geometry(states)).yaw,
        atol=1e-12,
    )


def test_signs_of_the_simplified_model():
    """At the ascending node the ground moves east; on an orbit to the north that is to the right.

    The right-looking radar sees it recede (negative), the left-looking one sees it approach.
    """
    for side, sign in ((LookSide.RIGHT, -1.0), (LookSide.LEFT, 1.0)):
        doppler = simplified_broadside_doppler(
            radius=6.878e6,
            inclination=np.pi / 2,
            argument_of_latitude=0.0,
            look_angle=np.pi / 6,
            side=side,
            wavelength=2.0,
        )
        # R_s ω_e sin 30° = 250.8 m/s
        assert_allclose(doppler, sign * 6.878e6 * EARTH_ROTATION_RATE / 2.0, rtol=1e-12)
