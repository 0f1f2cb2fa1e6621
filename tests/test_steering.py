"""Attitude, steering laws on random orbits, rates, and the curves of a case."""

from __future__ import annotations

import dataclasses
from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation, RotationSpline

from formation import KeplerianOrbit, States
from formation.constants import EARTH_ROTATION_RATE
from formation.elements import Elements
from insar import LookSide
from insar.observe import (
    FixedIncidence,
    FixedLook,
    Law,
    Outcome,
    SteeringCase,
    angular_rates,
    antenna_plane,
    assess_case,
    attitude_matrix,
    doppler_centroid,
    doppler_of_direction,
    euler_angles,
    fiedler,
    intersect,
    look_at,
    off_boresight,
    orbit_axes,
    orbit_geometry,
    raney,
    steer,
    swath,
    swath_doppler,
    total_zero_doppler,
    zhao,
)

WAVELENGTH = 0.03
TARGET_FORM = 1e-7  # Hz: rounding of 4e7 m and 1e4 m/s is 1e-9 Hz
FINITE_DIFFERENCE = 1e-3  # Hz: 1.5e-5 m/s of range rate
BORESIGHTS = [FixedLook(np.deg2rad(7.5)), FixedLook(0.5), FixedIncidence(np.deg2rad(45.0))]
EXACT = [Law.YAW_PITCH, Law.PITCH_ROLL]
SIDES = list(LookSide)

every_boresight = pytest.mark.parametrize("boresight", BORESIGHTS, ids=str)
every_side = pytest.mark.parametrize("side", SIDES)
every_law = pytest.mark.parametrize("law", list(Law))


def solved(steering, least):
    """Mask of the solved samples, which must be many enough for the test to mean something."""
    mask = steering.outcome == Outcome.SOLVED
    assert np.count_nonzero(mask) >= least
    return mask


# -- attitude ------------------------------------------------------------------------------------

turns = st.floats(-3.1, 3.1)


@given(turns, st.floats(-1.5, 1.5), turns)
def test_attitude_is_yaw_then_pitch_then_roll(yaw, pitch, roll):
    """Against SciPy's intrinsic ZYX, whose matrix takes the body's components to the frame's."""
    attitude = attitude_matrix(yaw=yaw, pitch=pitch, roll=roll)
    expected = Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix().T
    assert_allclose(attitude, expected, atol=1e-15)
    assert_allclose(euler_angles(attitude), [yaw, pitch, roll], atol=1e-12)


def test_signs_of_the_attitude_angles():
    """Yaw turns the nose right (Y), pitch lifts it (−Z), roll lowers the right side."""
    small = 0.1
    assert attitude_matrix(yaw=small, pitch=0.0, roll=0.0)[0, 1] == np.sin(small)
    assert attitude_matrix(yaw=0.0, pitch=small, roll=0.0)[0, 2] == -np.sin(small)
    assert attitude_matrix(yaw=0.0, pitch=0.0, roll=small)[1, 2] == np.sin(small)


# -- the laws on random orbits -------------------------------------------------------------------


@every_side
@every_boresight
@pytest.mark.parametrize("law", EXACT)
def test_exact_laws_leave_no_doppler(law, boresight, side, random_orbits):
    """By the target form on the intersected target, and by differences of its range.

    The target turns with the Earth, in inertial axes; differences of fourth order over ±0.1 s.
    """
    states = random_orbits.earth_fixed(0.0)
    steering = steer(law, states, boresight=boresight, side=side)
    mask = solved(steering, 190)
    target = intersect(states.position, steering.boresight)
    doppler = doppler_centroid(states, target, wavelength=WAVELENGTH)
    assert np.max(np.abs(doppler[mask])) < TARGET_FORM
    assert np.all(np.isnan(doppler[~mask]))
    step = 0.05
    r = [
        np.linalg.norm(
            random_orbits.inertial(time).position - random_orbits.turned(target, -time), axis=-1
        )
        for time in step * np.array([-2, -1, 1, 2])
    ]
    rate = (r[0] - 8.0 * r[1] + 8.0 * r[2] - r[3]) / (12.0 * step)
    assert np.max(np.abs(2.0 / WAVELENGTH * rate[mask])) < FINITE_DIFFERENCE


@every_side
@every_boresight
@every_law
def test_every_law_keeps_its_boresight_and_its_frames(law, boresight, side, random_orbits):
    states = random_orbits.earth_fixed(0.0)
    steering = steer(law, states, boresight=boresight, side=side)
    mask = solved(steering, 190)
    look = look_at(states, intersect(states.position, steering.boresight))
    held = look.look_angle if isinstance(boresight, FixedLook) else look.incidence
    assert_allclose(held[mask], boresight.angle, atol=1e-11)
    assert_allclose(steering.off_nadir[mask], look.look_angle[mask], atol=1e-12)
    assert_allclose(
        steering.attitude,
        attitude_matrix(yaw=steering.yaw, pitch=steering.pitch, roll=steering.roll),
        atol=1e-15,
    )
    # Right-handed antenna axes; the azimuth axis is the body's, the boresight in its y-z plane.
    body = steering.attitude @ orbit_axes(states)
    identity = steering.antenna @ np.swapaxes(steering.antenna, -1, -2)
    assert_allclose(identity[mask], np.broadcast_to(np.eye(3), identity[mask].shape), atol=1e-14)
    assert_allclose(np.linalg.det(steering.antenna[mask]), 1.0, rtol=1e-14)
    assert_allclose(steering.antenna[:, 0], body[:, 0], atol=1e-15)
    # The side is that of the flight over the ground for the exact laws, of the body for the others.
    forward = states.velocity if law in EXACT else body[:, 0]
    left = np.cross(states.position, forward)
    assert np.all(np.sign(np.sum(steering.boresight * left, axis=-1))[mask] == side)
    assert np.all(np.isnan(steering.yaw[~mask]))
    assert np.all(np.isnan(steering.antenna[~mask]))


@every_side
@every_boresight
def test_both_exact_laws_point_the_same_beam(boresight, side, random_orbits):
    """Two independent roads: Zhao's trigonometry, and a mount angle about the ground velocity."""
    states = random_orbits.earth_fixed(0.0)
    yaw_pitch, pitch_roll = (
        steer(law, states, boresight=boresight, side=side)
        for law in (Law.YAW_PITCH, Law.PITCH_ROLL)
    )
    assert np.all(yaw_pitch.outcome == pitch_roll.outcome)
    # Where |θ_p| → γ the elevation in the plane goes as the root of the rounding error.
    assert_allclose(yaw_pitch.boresight, pitch_roll.boresight, atol=1e-11)


@every_boresight
@every_law
def test_left_is_right_in_the_mirror(law, boresight, random_orbits):
    """The mirror image in the equator's plane turns yaw and roll, and keeps pitch.

    The Earth's rotation is its own image. With the printed sign of Zhao's ground squint the left
    side fails.
    """
    states = random_orbits.earth_fixed(0.0)
    mirror = np.array([1.0, 1.0, -1.0])
    left = steer(law, states, boresight=boresight, side=LookSide.LEFT)
    mirrored = States(states.position * mirror, states.velocity * mirror)
    right = steer(law, mirrored, boresight=boresight, side=LookSide.RIGHT)
    assert_allclose(left.pitch, right.pitch, atol=1e-11)
    assert_allclose(left.yaw, -right.yaw, atol=1e-11)
    assert_allclose(left.roll, -right.roll, atol=1e-11)
    assert_allclose(left.boresight, right.boresight * mirror, atol=1e-11)


def test_angles_that_each_law_steers(random_orbits):
    states = random_orbits.earth_fixed(0.0)
    found = {law: steer(law, states, boresight=BORESIGHTS[2], side=LookSide.RIGHT) for law in Law}
    assert np.nanmax(np.abs(found[Law.NONE][1:4])) == 0.0
    assert np.nanmax(np.abs(found[Law.YAW].pitch)) == 0.0
    assert np.nanmax(np.abs(found[Law.PITCH_ROLL].yaw)) == 0.0
    for law in (Law.YAW, Law.YAW_PITCH_APPROXIMATE, Law.YAW_PITCH):
        assert np.nanmax(np.abs(found[law].roll)) == 0.0


@every_side
def test_unsteered_beam_is_broadside_of_the_orbit(side, random_orbits):
    states = random_orbits.earth_fixed(0.0)
    steering = steer(Law.NONE, states, boresight=FixedIncidence(0.6), side=side)
    look = look_at(states, intersect(states.position, steering.boresight))
    assert_allclose(look.azimuth, side * np.pi / 2, atol=1e-12)


# -- closed forms --------------------------------------------------------------------------------


def true_anomaly(elements, geometry):
    """Argument of latitude minus that of perigee."""
    return geometry.argument_of_latitude - elements.argument_of_perigee


def test_closed_forms_in_terms_of_the_elements(random_orbits):
    """The laws come from state vectors; here they are written with i, u, e and f."""
    e = random_orbits.elements.eccentricity
    i, a = random_orbits.elements.inclination, random_orbits.elements.semi_major_axis
    geometry = orbit_geometry(random_orbits.earth_fixed(0.0))
    u, f = geometry.argument_of_latitude, true_anomaly(random_orbits.elements, geometry)
    mean_motion = np.sqrt(3.986004418e14 / a**3)
    assert_allclose(geometry.mean_motion, mean_motion, rtol=1e-12)
    across = -np.sin(i) * np.cos(u)

    def yaw(rate):
        return np.arctan2(across, rate / EARTH_ROTATION_RATE - np.cos(i))

    assert_allclose(raney(geometry).yaw, yaw(mean_motion), atol=1e-11)
    flight_path = np.arctan2(e * np.sin(f), 1.0 + e * np.cos(f))
    assert_allclose(fiedler(geometry).pitch, flight_path, atol=1e-11)
    parameter = a * (1.0 - e**2)
    rate = np.sqrt(3.986004418e14 * parameter) / geometry.radius**2
    radial = np.sqrt(3.986004418e14 / parameter) * e * np.sin(f)
    ground = geometry.radius * np.hypot(
        rate - EARTH_ROTATION_RATE * np.cos(i), EARTH_ROTATION_RATE * across
    )
    exact = total_zero_doppler(geometry)
    assert_allclose(exact.yaw, yaw(rate), atol=1e-10)
    assert_allclose(exact.pitch, np.arctan2(radial, ground), atol=1e-10)


@pytest.mark.parametrize("law", [raney, fiedler])
def test_approximate_laws_are_exact_on_a_circle(law, random_orbits):
    geometry = orbit_geometry(random_orbits.earth_fixed(0.0))
    circular = random_orbits.elements.eccentricity == 0.0
    exact, other = total_zero_doppler(geometry), law(geometry)
    assert np.count_nonzero(circular) == 20
    assert_allclose(other.yaw[circular], exact.yaw[circular], atol=1e-12)
    assert_allclose(other.pitch[circular], 0.0, atol=1e-12)


def test_steering_of_terrasar_x(two_body):
    """Yaw within ±3.7°, pitch within ±0.07°, and below 50 Hz with the approximate law.

    514.8 km, 97.44°, the eccentricity of 0.00118 of its frozen orbit, perigee at 90°; 35° of
    incidence at X band. Raney's yaw alone leaves several times more.
    """
    anomaly = np.linspace(0.0, 2.0 * np.pi, 721)
    orbit = two_body(Elements(6_892.9e3, 0.00118, np.deg2rad(97.44), 0.0, np.pi / 2, anomaly))
    states = orbit.earth_fixed(0.0)
    residual = {}
    for law in Law:
        steering = steer(
            law, states, boresight=FixedIncidence(np.deg2rad(35.0)), side=LookSide.RIGHT
        )
        target = intersect(states.position, steering.boresight)
        residual[law] = np.max(np.abs(doppler_centroid(states, target, wavelength=0.031066)))
        if law is Law.YAW_PITCH_APPROXIMATE:
            assert_allclose(np.max(np.abs(steering.yaw)), np.deg2rad(3.7), atol=np.deg2rad(0.05))
            assert_allclose(
                np.max(np.abs(steering.pitch)), np.deg2rad(0.068), atol=np.deg2rad(0.001)
            )
    assert residual[Law.YAW_PITCH_APPROXIMATE] < 50.0
    assert residual[Law.YAW] > 8.0 * residual[Law.YAW_PITCH_APPROXIMATE]
    assert residual[Law.NONE] > 15e3


@pytest.mark.parametrize("side", SIDES)
def test_printed_ground_squint_is_right_on_the_right_side_only(side, random_orbits):
    """Zhao 2019 eq. (5) as printed: θ_d = k(θ_yd + θ_pd), with θ_yd = −ψ in our signs."""
    geometry = orbit_geometry(random_orbits.earth_fixed(0.0))
    look_angle, k = 0.5, -int(side)
    yaw, pitch = total_zero_doppler(geometry)
    with np.errstate(invalid="ignore"):
        printed = k * (-yaw + np.arcsin(np.tan(pitch) / np.tan(look_angle)))
    ours = zhao(geometry, look_angle=look_angle, side=side).pitch
    difference = np.abs(np.arctan(np.tan(look_angle) * np.sin(printed)) - ours)
    assert (np.nanmax(difference) < 1e-15) == (side is LookSide.RIGHT)


# -- where there is no solution ------------------------------------------------------------------


def climbing(*, radius, climb):
    """Over the equator, eastward at the circular speed, climbing at a part of it [rad]."""
    speed = np.sqrt(3.986004418e14 / radius)
    inertial = speed * np.array([np.sin(climb), 0.0, np.cos(climb)])
    return States(
        np.array([radius, 0.0, 0.0]), inertial - np.array([0.0, EARTH_ROTATION_RATE * radius, 0.0])
    )


@pytest.mark.parametrize("law", EXACT)
@pytest.mark.parametrize(
    ("radius", "climb", "boresight", "outcome"),
    [
        (7e6, 0.0, FixedLook(0.5), Outcome.SOLVED),
        (7e6, 0.0, FixedLook(1.3), Outcome.MISSES_EARTH),
        (7e6, 0.2, FixedLook(0.19), Outcome.TOO_NEAR_NADIR),
        (7e6, 0.2, FixedIncidence(0.19), Outcome.INCIDENCE_UNREACHED),
        (42e6, 0.4, FixedIncidence(0.7), Outcome.MISSES_EARTH),
        (6.3e6, 0.0, FixedLook(0.5), Outcome.MISSES_EARTH),
        (6.3e6, 0.0, FixedIncidence(0.5), Outcome.MISSES_EARTH),
    ],
)
def test_what_has_no_solution_says_why(law, radius, climb, boresight, outcome):
    steering = steer(
        law, climbing(radius=radius, climb=climb), boresight=boresight, side=LookSide.LEFT
    )
    assert steering.outcome == outcome
    assert np.isnan(steering.off_nadir) == (outcome != Outcome.SOLVED)


def test_a_boresight_at_nadir_of_the_needed_pitch_is_the_limit():
    """|θ_p| = γ is solvable, anything less is not; asin gives NaN, never a wrong angle."""
    states = climbing(radius=7e6, climb=0.2)
    pitch = float(total_zero_doppler(orbit_geometry(states)).pitch)
    for law in EXACT:
        for margin, outcome in ((1e-9, Outcome.SOLVED), (-1e-9, Outcome.TOO_NEAR_NADIR)):
            held = FixedLook(pitch + margin)
            assert steer(law, states, boresight=held, side=LookSide.LEFT).outcome == outcome


# -- over the swath ------------------------------------------------------------------------------


@every_side
def test_only_yaw_pitch_keeps_the_swath_at_zero_doppler(side, random_orbits):
    states = random_orbits.earth_fixed(0.0)
    offsets = np.deg2rad([-0.5, 0.0, 0.5])
    doppler = {
        law: swath_doppler(
            states,
            steer(law, states, boresight=BORESIGHTS[2], side=side),
            offsets,
            wavelength=WAVELENGTH,
        )
        for law in EXACT
    }
    assert doppler[Law.YAW_PITCH].shape == (500, 3)
    assert np.nanmax(np.abs(doppler[Law.YAW_PITCH])) < TARGET_FORM
    assert np.nanmax(np.abs(doppler[Law.PITCH_ROLL][:, 1])) < TARGET_FORM
    edges = np.abs(doppler[Law.PITCH_ROLL][:, [0, 2]])
    assert np.nanmedian(edges) > 100.0
    assert_allclose(edges[:, 0], edges[:, 1], atol=1e-6)


@every_side
@every_law
def test_elevations_off_the_boresight_stay_in_the_antenna_plane(law, side, random_orbits):
    states = random_orbits.earth_fixed(0.0)
    steering = steer(law, states, boresight=BORESIGHTS[2], side=side)
    mask = solved(steering, 400)
    offsets = np.array([-0.02, 0.0, 0.03])
    lines = off_boresight(steering, offsets)
    assert lines.shape == (500, 3, 3)
    assert_allclose(off_boresight(steering, 0.03), lines[:, 2], atol=1e-15)
    along = np.einsum("sek,sk->se", lines, steering.antenna[:, 0])
    assert_allclose(along[mask], 0.0, atol=1e-14)
    nadir = -states.position / np.linalg.norm(states.position, axis=-1, keepdims=True)
    off_nadir = np.arccos(np.einsum("sek,sk->se", lines, nadir))[mask]
    inner, outer = np.diff(off_nadir, axis=-1).T
    assert np.all(outer > 0.0)
    # A pitched beam may be nearer than 0.02 rad to the nearest approach of its plane to nadir.
    slope = np.abs(np.sum(steering.antenna[:, 1] * nadir, axis=-1))[mask]
    assert np.all(inner[slope > 0.021] > 0.0)
    # The same plane by another road: the edges of the strip.
    low, high = np.median(off_nadir[:, 0]), np.median(off_nadir[:, 2])
    edges = swath(
        states.position,
        antenna_plane(steering, states),
        near=FixedLook(low),
        far=FixedLook(high),
    )
    assert np.nanmax(np.abs(np.sum((edges.far - edges.near) * steering.antenna[:, 0], -1))) < 1e-6
    aside = antenna_plane(steering, states).aside
    assert np.all(np.sum(aside * steering.boresight, axis=-1)[mask] > 0.0)


# -- rates ---------------------------------------------------------------------------------------


def revolution(two_body, *, samples, eccentricity=0.01, altitude=700e3):
    axis = 6_378_137.0 + altitude
    period = 2.0 * np.pi * np.sqrt(axis**3 / 3.986004418e14)
    orbit = two_body(Elements(axis, eccentricity, np.deg2rad(98.0), 0.3, 1.0, -1.4))
    return orbit, np.linspace(0.0, period, samples)


def test_unsteered_body_turns_once_a_revolution(two_body):
    """Against inertial space −h/r² about Y, exactly; against the orbit frame not at all."""
    orbit, times = revolution(two_body, samples=361, eccentricity=0.1)
    states = orbit.earth_fixed(times)
    identity = np.tile(np.eye(3), (361, 1, 1))
    rates = angular_rates(times, identity, orbit_axes=orbit_axes(states))
    expected = np.zeros((361, 3))
    expected[:, 1] = -orbit_geometry(states).angular_rate
    # Fourth order: (2π/360)⁴/30 of the rate inside and six times that at the ends.
    assert_allclose(rates.inertial[2:-2], expected[2:-2], atol=2e-11)
    assert_allclose(rates.inertial, expected, atol=2e-10)
    assert_allclose(rates.orbit, 0.0, atol=1e-16)


@every_law
def test_rates_are_those_of_a_spline_through_the_attitudes(law, two_body):
    """Against SciPy's rotation spline, at uneven samples."""
    orbit, times = revolution(two_body, samples=721)
    times = times + 2.0 * np.sin(times)
    states = orbit.earth_fixed(times)
    steering = steer(law, states, boresight=FixedIncidence(0.6), side=LookSide.LEFT)
    rates = angular_rates(times, steering.attitude, orbit_axes=orbit_axes(states))
    spline = RotationSpline(times, Rotation.from_matrix(np.swapaxes(steering.attitude, -1, -2)))
    assert_allclose(rates.orbit[10:-10], spline(times, 1)[10:-10], atol=1e-8)
    # What is between them is the orbit frame's own rate, seen in the body.
    unsteered = angular_rates(
        times, np.tile(np.eye(3), (721, 1, 1)), orbit_axes=orbit_axes(states)
    ).inertial
    difference = rates.inertial - rates.orbit
    assert_allclose(difference, np.einsum("sij,sj->si", steering.attitude, unsteered), atol=1e-8)


def test_rate_of_yaw_steering_is_the_derivative_of_its_closed_form(two_body):
    """ψ̇ about Z on a circle: differentiate tanψ = −sin i cos u/(N − cos i)."""
    orbit, times = revolution(two_body, samples=361, eccentricity=0.0)
    states = orbit.earth_fixed(times)
    geometry = orbit_geometry(states)
    steering = steer(Law.YAW, states, boresight=FixedIncidence(0.6), side=LookSide.RIGHT)
    rates = angular_rates(times, steering.attitude, orbit_axes=orbit_axes(states)).orbit
    i, u = geometry.inclination, geometry.argument_of_latitude
    forward = geometry.angular_rate / EARTH_ROTATION_RATE - np.cos(i)
    slope = np.sin(i) * np.sin(u) / forward * geometry.angular_rate
    assert_allclose(rates[:, 2], slope * np.cos(steering.yaw) ** 2, atol=1e-11)
    assert_allclose(rates[:, :2], 0.0, atol=1e-16)


def test_rates_are_those_of_the_kinematics_of_euler_angles():
    """Yaw, pitch and roll all move: ω = φ̇ X + R_x(φ)[θ̇ Y + R_y(θ) ψ̇ Z] in body axes."""
    t = np.linspace(0.0, 10.0, 1001)
    yaw, pitch, roll = 0.5 * np.sin(t), 0.4 * np.cos(0.7 * t), 0.3 * np.sin(0.3 * t)
    yaw_rate, pitch_rate = 0.5 * np.cos(t), -0.28 * np.sin(0.7 * t)
    roll_rate = 0.09 * np.cos(0.3 * t)
    expected = np.stack(
        [
            roll_rate - yaw_rate * np.sin(pitch),
            pitch_rate * np.cos(roll) + yaw_rate * np.sin(roll) * np.cos(pitch),
            -pitch_rate * np.sin(roll) + yaw_rate * np.cos(roll) * np.cos(pitch),
        ],
        axis=-1,
    )
    attitude = attitude_matrix(yaw=yaw, pitch=pitch, roll=roll)
    rates = angular_rates(t, attitude, orbit_axes=np.tile(np.eye(3), (1001, 1, 1)))
    # (0.01 s)⁴/5 of the fifth derivatives at the ends.
    assert_allclose(rates.orbit, expected, atol=5e-9)


def test_rates_from_three_samples():
    """A parabola through the cosines of a steady turn of 0.01 rad a sample."""
    attitude = attitude_matrix(yaw=0.01 * np.arange(3), pitch=0.0, roll=0.0)
    rates = angular_rates([0.0, 1.0, 2.0], attitude, orbit_axes=np.tile(np.eye(3), (3, 1, 1)))
    # (0.01)²/6 inside, twice that at the ends.
    assert_allclose(rates.orbit[:, 2], 0.01, rtol=4e-5)


def test_missing_attitudes_leave_only_their_neighbors_without_rates():
    attitude = attitude_matrix(yaw=0.01 * np.arange(20), pitch=0.0, roll=0.0)
    attitude[10] = np.nan
    rates = angular_rates(np.arange(20.0), attitude, orbit_axes=np.tile(np.eye(3), (20, 1, 1)))
    assert np.flatnonzero(np.isnan(rates.orbit[:, 2])).tolist() == [8, 9, 10, 11, 12]


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([0.0, 1.0], r"shape \(2,\); angular rates need three or more samples"),
        ([0.0, 2.0, 2.0], r"times\[2\] = 2.0 s must come after the one before it"),
    ],
)
def test_impossible_times_are_refused(times, message):
    axes = np.tile(np.eye(3), (len(times), 1, 1))
    with pytest.raises(ValueError, match=message):
        angular_rates(times, axes, orbit_axes=axes)


# -- a case --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def case(two_body):
    orbit, times = revolution(two_body, samples=200)
    return SteeringCase(
        name="low",
        trajectory=orbit,
        times=2.0 * times,
        wavelength=WAVELENGTH,
        side=LookSide.RIGHT,
        boresight=FixedIncidence(0.6),
        laws=tuple(Law),
        swath_offsets=np.deg2rad([-1.0, 0.0, 1.0]),
    )


def test_a_case_holds_every_law_over_two_revolutions(case):
    result = assess_case(case)
    assert [curves.law for curves in result.curves] == list(Law)
    assert result.name == "low"
    growth = np.diff(result.argument_of_latitude)
    assert np.all(growth > 0.0)
    assert_allclose(np.sum(growth), 4.0 * np.pi, atol=1e-9)
    assert 0.0 <= result.argument_of_latitude[0] < 2.0 * np.pi
    assert np.max(np.abs(result.latitude)) < np.deg2rad(82.3)  # geodetic: up to 0.2° beyond 82°
    assert np.all(np.abs(result.altitude - 700e3) < 100e3)
    for curves in result.curves:
        assert np.all(curves.outcome == Outcome.SOLVED)
        assert_allclose(curves.incidence, 0.6, atol=1e-11)
        assert_allclose(curves.swath_doppler[:, 1], curves.residual_doppler, atol=1e-8)
        assert curves.rate_inertial.shape == (200, 3)
    exact = result.of(Law.YAW_PITCH)
    assert np.max(np.abs(exact.residual_doppler)) < TARGET_FORM
    assert_allclose(exact.steering_angle, np.abs(exact.yaw) + np.abs(exact.pitch))
    tilted = result.of(Law.PITCH_ROLL)
    assert_allclose(tilted.steering_angle, np.abs(tilted.pitch) + np.abs(tilted.roll))
    speed = np.linalg.norm(case.trajectory.earth_fixed(case.times).velocity, axis=-1)
    assert_allclose(exact.pointing_sensitivity, 2.0 / WAVELENGTH * speed, rtol=1e-12)


@pytest.mark.parametrize("law", EXACT)
def test_a_perturbed_orbit_in_the_real_frames_is_steered_as_exactly(law):
    """Osculating states with J2, Earth orientation from the tables; differences of range in ITRS.

    Steered by its mean elements, this orbit would be left with 0.026° of pitch and 200 Hz.
    """
    orbit = KeplerianOrbit(
        elements=Elements(6_892.9e3, 0.00118, np.deg2rad(97.44), 0.7, np.pi / 2, 0.2),
        epoch=datetime(2021, 3, 4, tzinfo=UTC),
    )
    times = np.linspace(0.0, 6e3, 61)
    case = SteeringCase(
        name="real",
        trajectory=orbit,
        times=times,
        wavelength=WAVELENGTH,
        side=LookSide.RIGHT,
        boresight=FixedIncidence(np.deg2rad(35.0)),
        laws=(law,),
        swath_offsets=np.zeros(1),
    )
    result = assess_case(case)
    assert np.max(np.abs(result.of(law).residual_doppler)) < TARGET_FORM
    # First order in J2: meters in a, 1e-6 in e.
    assert_allclose(result.semi_major_axis, 6_892.9e3, atol=20.0)
    assert_allclose(result.eccentricity, 0.00118, atol=5e-6)
    assert_allclose(result.inclination, np.deg2rad(97.44), atol=1e-5)
    states = orbit.earth_fixed(times)
    steering = steer(law, states, boresight=case.boresight, side=case.side)
    target = intersect(states.position, steering.boresight)
    step = 0.05
    r = [
        np.linalg.norm(orbit.earth_fixed(times + lag).position - target, axis=-1)
        for lag in step * np.array([-2, -1, 1, 2])
    ]
    rate = (r[0] - 8.0 * r[1] + 8.0 * r[2] - r[3]) / (12.0 * step)
    assert np.max(np.abs(2.0 / WAVELENGTH * rate)) < FINITE_DIFFERENCE


def test_lines_of_sight_that_miss_leave_holes_in_the_swath(case):
    """From 630–770 km the horizon is 63–65.5° from nadir: 60° is on the Earth, 67° is not."""
    low = dataclasses.replace(
        case, boresight=FixedLook(np.deg2rad(62.0)), swath_offsets=np.deg2rad([-2.0, 5.0])
    )
    curves = assess_case(low).of(Law.YAW_PITCH)
    assert np.all(np.isnan(curves.swath_doppler), axis=0).tolist() == [False, True]
    lost = assess_case(dataclasses.replace(case, boresight=FixedLook(1.2))).of(Law.YAW_PITCH)
    assert np.all(lost.outcome == Outcome.MISSES_EARTH)
    for values in (lost.yaw, lost.rate_orbit, lost.residual_doppler, lost.swath_doppler):
        assert np.all(np.isnan(values))


def test_doppler_of_the_boresight_is_that_of_its_target(case):
    states = case.trajectory.earth_fixed(case.times)
    for law in Law:
        steering = steer(law, states, boresight=case.boresight, side=case.side)
        assert_allclose(
            assess_case(case).of(law).residual_doppler,
            doppler_of_direction(states, steering.boresight, wavelength=WAVELENGTH),
            atol=TARGET_FORM,
        )
