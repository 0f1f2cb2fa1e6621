"""Attitude toolbox: conversions, turns and their rates, and a stretch of orbit as polynomials."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from formation import Elements, KeplerianOrbit, States
from insar.observe.agile.rotations import (
    EulerSequence,
    attitude_of_axis_angle,
    attitude_of_quaternion,
    attitude_of_sequence,
    axis_angle,
    continuous,
    euler_sequence,
    quaternion,
    upright,
)
from insar.observe.agile.smooth_orbit import SHORTEST, smooth_orbit
from insar.observe.agile.turning import (
    inertial_rate,
    moving_shortest_turn,
    orbit_frame,
    path_in_orbit_frame,
    shortest_turn,
    turn_between,
)
from insar.observe.attitude import angular_rates
from insar.observe.frames import orbit_axes

ROUNDING = 1e-14
"""Of products of rotation matrices and their conversions [rad]."""
X, Y, Z = np.eye(3)

outer = st.floats(-3.1, 3.1)
middle = st.floats(-1.57, 1.57)
directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array)


def about(axis: str, angle: float) -> np.ndarray:
    """Turn of axes, from the definition."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array(
        {
            "X": [[1, 0, 0], [0, c, s], [0, -s, c]],
            "Y": [[c, 0, -s], [0, 1, 0], [s, 0, c]],
            "Z": [[c, s, 0], [-s, c, 0], [0, 0, 1]],
        }[axis]
    )


def random_attitudes(count: int, seed: int = 0) -> np.ndarray:
    q = np.random.default_rng(seed).normal(size=(count, 4))
    return attitude_of_quaternion(q)


# -- Euler angles --------------------------------------------------------------------------------


@given(yaw=outer, pitch=middle, roll=middle)
def test_sequences_are_the_products_of_their_turns(yaw, pitch, roll):
    spotlight = attitude_of_sequence(
        yaw=yaw, pitch=pitch, roll=roll, sequence=EulerSequence.THREE_ONE_TWO
    )
    expected = about("Y", pitch) @ about("X", roll) @ about("Z", yaw)
    np.testing.assert_allclose(spotlight, expected, atol=ROUNDING)
    video = attitude_of_sequence(
        yaw=yaw, pitch=pitch, roll=roll, sequence=EulerSequence.ONE_TWO_THREE
    )
    expected = about("Z", yaw) @ about("Y", pitch) @ about("X", roll)
    np.testing.assert_allclose(video, expected, atol=ROUNDING)


@pytest.mark.parametrize("sequence", EulerSequence)
@given(yaw=outer, pitch=middle, roll=middle)
def test_angles_return_what_was_given(sequence, yaw, pitch, roll):
    attitude = attitude_of_sequence(yaw=yaw, pitch=pitch, roll=roll, sequence=sequence)
    found = euler_sequence(attitude, sequence)
    again = attitude_of_sequence(
        yaw=found.yaw, pitch=found.pitch, roll=found.roll, sequence=sequence
    )
    np.testing.assert_allclose(again, attitude, atol=1e-12)
    # The outer angles lose as many digits as the cosine of the middle one is small.
    small = math.cos(roll if sequence is EulerSequence.THREE_ONE_TWO else pitch)
    if small > 1e-3:
        given_angles = np.array([yaw, pitch, roll])
        np.testing.assert_allclose(
            np.array([found.yaw, found.pitch, found.roll]), given_angles, atol=1e-12 / small
        )


@pytest.mark.parametrize(
    ("sequence", "singular"),
    [(EulerSequence.THREE_ONE_TWO, "roll"), (EulerSequence.ONE_TWO_THREE, "pitch")],
)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_singularity_is_flagged_and_the_angles_still_give_the_attitude(sequence, singular, sign):
    angles = {"yaw": 0.3, "pitch": -0.2, "roll": 0.1} | {singular: sign * math.pi / 2}
    attitude = attitude_of_sequence(**angles, sequence=sequence)
    found = euler_sequence(attitude, sequence)
    assert found.singular
    again = attitude_of_sequence(
        yaw=found.yaw, pitch=found.pitch, roll=found.roll, sequence=sequence
    )
    np.testing.assert_allclose(again, attitude, atol=1e-7)
    other = next(one for one in EulerSequence if one is not sequence)
    assert not euler_sequence(attitude, other).singular


# -- quaternions, axis and angle -----------------------------------------------------------------


@pytest.mark.parametrize("sequence", EulerSequence)
@given(yaw=outer, pitch=outer, roll=outer)
def test_upright_angles_give_the_attitude_and_have_the_smaller_outer_ones(
    sequence, yaw, pitch, roll
):
    attitude = attitude_of_sequence(yaw=yaw, pitch=pitch, roll=roll, sequence=sequence)
    plain = euler_sequence(attitude, sequence)
    found = upright(plain, sequence)
    again = attitude_of_sequence(
        yaw=found.yaw, pitch=found.pitch, roll=found.roll, sequence=sequence
    )
    np.testing.assert_allclose(again, attitude, atol=4 * ROUNDING)
    outer_names = ("yaw", "pitch") if sequence is EulerSequence.THREE_ONE_TWO else ("roll", "yaw")
    cosines = sum(np.cos(getattr(found, name)) for name in outer_names)
    assert cosines >= -1e-12
    # Angles that are already small stay as they are.
    if max(abs(yaw), abs(pitch), abs(roll)) < 1.5:
        assert [found.yaw, found.pitch, found.roll] == [plain.yaw, plain.pitch, plain.roll]


def test_upright_angles_pass_a_middle_one_of_90_degrees_without_a_jump():
    """A pure roll from 60° to 120° is a pure roll all the way; NaN stays NaN."""
    roll = np.radians(np.arange(60.5, 120.0, 1.0))
    attitude = attitude_of_sequence(
        yaw=0.0, pitch=0.0, roll=roll, sequence=EulerSequence.THREE_ONE_TWO
    )
    found = upright(
        euler_sequence(attitude, EulerSequence.THREE_ONE_TWO), EulerSequence.THREE_ONE_TWO
    )
    np.testing.assert_allclose(found.roll, roll, atol=1e-12)
    np.testing.assert_allclose([found.yaw, found.pitch], 0.0, atol=1e-12)
    lost = upright(
        euler_sequence(np.full((3, 3), np.nan), EulerSequence.ONE_TWO_THREE),
        EulerSequence.ONE_TWO_THREE,
    )
    assert np.isnan([lost.yaw, lost.pitch, lost.roll]).all()


def test_quaternion_is_the_turn_of_the_axes_with_the_scalar_last():
    yawed = attitude_of_sequence(yaw=0.4, pitch=0.0, roll=0.0, sequence=EulerSequence.THREE_ONE_TWO)
    np.testing.assert_allclose(
        quaternion(yawed), [0.0, 0.0, math.sin(0.2), math.cos(0.2)], atol=ROUNDING
    )
    turn = axis_angle(yawed)
    np.testing.assert_allclose(turn.axis, Z, atol=ROUNDING)
    assert turn.angle == pytest.approx(0.4, abs=ROUNDING)


def test_quaternion_and_han_equation_3_agree():
    """q₄ of the sequence 3-1-2 and the vector part, from the half angles."""
    yaw, pitch, roll = 0.3, -0.5, 0.7
    c, s = (function(np.array([yaw, roll, pitch]) / 2) for function in (np.cos, np.sin))
    expected = [
        c[0] * s[1] * c[2] - s[0] * c[1] * s[2],
        c[0] * c[1] * s[2] + s[0] * s[1] * c[2],
        s[0] * c[1] * c[2] + c[0] * s[1] * s[2],
        c[0] * c[1] * c[2] - s[0] * s[1] * s[2],
    ]
    attitude = attitude_of_sequence(
        yaw=yaw, pitch=pitch, roll=roll, sequence=EulerSequence.THREE_ONE_TWO
    )
    np.testing.assert_allclose(quaternion(attitude), expected, atol=ROUNDING)


def test_conversions_keep_leading_axes_and_return():
    attitude = random_attitudes(24).reshape(2, 3, 4, 3, 3)
    q = quaternion(attitude)
    assert q.shape == (2, 3, 4, 4)
    assert np.all(q[..., 3] >= 0.0)
    np.testing.assert_allclose(attitude_of_quaternion(-2.0 * q), attitude, atol=ROUNDING)
    turn = axis_angle(attitude)
    assert turn.axis.shape == (2, 3, 4, 3)
    np.testing.assert_allclose(
        attitude_of_axis_angle(3.0 * turn.axis, turn.angle), attitude, atol=1e-13
    )
    # The axis keeps its components.
    np.testing.assert_allclose(
        np.einsum("...ij,...j->...i", attitude, turn.axis), turn.axis, atol=1e-13
    )


def test_what_is_no_rotation_becomes_nan():
    attitude = np.stack([np.eye(3), np.full((3, 3), np.nan), -np.eye(3), 1.1 * np.eye(3)])
    for values in (quaternion(attitude), euler_sequence(attitude, EulerSequence.THREE_ONE_TWO)[0]):
        finite = np.isfinite(values.reshape(4, -1)).all(axis=-1)
        np.testing.assert_array_equal(finite, [True, False, False, False])
    assert np.isnan(axis_angle(attitude).angle[1:]).all()
    assert np.isnan(axis_angle(attitude).axis[0]).all()  # no turn has no axis
    assert axis_angle(attitude).angle[0] == 0.0
    assert np.isnan(attitude_of_quaternion(np.zeros(4))).all()
    assert np.isnan(attitude_of_axis_angle(np.zeros(3), 1.0)).all()


def test_continuous_quaternions_do_not_jump():
    """Through 180°, where the scalar changes sign, and past a gap."""
    angle = np.linspace(2.5, 4.5, 81)
    q = quaternion(attitude_of_axis_angle(np.array([1.0, 2.0, 2.0]), angle))
    assert np.abs(np.diff(q, axis=0)).max() > 1.0
    q[40] = np.nan
    smooth = continuous(q)
    assert np.nanmax(np.abs(np.diff(smooth, axis=0))) < 0.02
    known = np.isfinite(q[:, 0])
    np.testing.assert_array_equal(np.abs(smooth[known]), np.abs(q[known]))
    assert np.linalg.norm(smooth[41] - smooth[39]) < 0.04


# -- shortest turns ------------------------------------------------------------------------------


@given(start=directions, onto=directions)
def test_shortest_turn_points_and_is_the_shortest(start, onto):
    lengths = np.linalg.norm(start), np.linalg.norm(onto)
    if min(lengths) < 1e-3:
        return
    one, other = start / lengths[0], onto / lengths[1]
    cosine = float(one @ other)
    if cosine < -0.999999:
        return
    attitude = shortest_turn(start, onto)
    np.testing.assert_allclose(attitude.T @ one, other, atol=ROUNDING)
    np.testing.assert_allclose(attitude @ attitude.T, np.eye(3), atol=ROUNDING)
    angle = 2.0 * math.atan2(np.linalg.norm(one - other), np.linalg.norm(one + other))
    assert axis_angle(attitude).angle == pytest.approx(angle, abs=1e-13)
    # The form of the literature, q = unit[b×d, 1 + b·d], which loses digits near 180°.
    q = np.append(np.cross(one, other), 1.0 + cosine)
    np.testing.assert_allclose(
        attitude_of_quaternion(q), attitude, atol=1e-15 / (1.0 + cosine) + ROUNDING
    )


def test_shortest_turn_of_opposite_directions_is_nan():
    found = shortest_turn(Z, np.stack([-Z, Z, X, np.zeros(3)]))
    np.testing.assert_array_equal(np.isfinite(found[:, 0, 0]), [False, True, True, False])
    np.testing.assert_allclose(found[1], np.eye(3), atol=ROUNDING)


def test_turn_between_keeps_the_digits_of_small_turns():
    """An angle of 1e-9 is lost in the trace: cos(1e-9) = 1."""
    attitude = random_attitudes(5)
    turned = attitude_of_axis_angle(np.array([0.3, -0.2, 0.9]), 1e-9) @ attitude
    np.testing.assert_allclose(turn_between(attitude, turned), 1e-9, rtol=1e-6)
    np.testing.assert_allclose(
        turn_between(np.eye(3), random_attitudes(50)),
        axis_angle(random_attitudes(50)).angle,
        atol=1e-7,  # the half angle's arcsine near 180°
    )


def moving(times: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Two moving vectors of changing length, and their derivatives."""
    t = times
    start = np.stack([0.1 * t, np.sin(0.3 * t), 2.0 + np.cos(0.2 * t)], axis=-1)
    start_rate = np.stack([0.1 + 0 * t, 0.3 * np.cos(0.3 * t), -0.2 * np.sin(0.2 * t)], axis=-1)
    onto = np.stack([3.0 * t, 5.0 + t**2, 4.0 + np.sin(t)], axis=-1)
    onto_rate = np.stack([3.0 + 0 * t, 2.0 * t, np.cos(t)], axis=-1)
    return start, start_rate, onto, onto_rate


def test_rate_of_the_moving_turn_is_the_derivative_of_its_attitude():
    times = np.arange(-1.0, 1.0, 2e-3)
    turn = moving_shortest_turn(*moving(times))
    np.testing.assert_allclose(turn.attitude, shortest_turn(*moving(times)[::2]), atol=ROUNDING)
    derivative = angular_rates(
        times, turn.attitude, orbit_axes=np.broadcast_to(np.eye(3), turn.attitude.shape)
    )
    # Fourth-order differences over 2 ms of motions within seconds; rounding 1e-16/2e-3.
    np.testing.assert_allclose(turn.rate[2:-2], derivative.orbit[2:-2], rtol=0, atol=1e-10)


# -- orbit frame and smooth orbit ----------------------------------------------------------------

ORBIT = KeplerianOrbit(
    elements=Elements(6_978e3, 0.01, math.radians(97.8), 1.0, 0.5, 0.3),
    epoch=datetime(2016, 11, 25, 8, 9, 43, tzinfo=UTC),
)


def test_orbit_frame_turns_as_its_axes_do():
    """J2 turns the orbit plane: the rate about nadir is not zero."""
    orbit = smooth_orbit(ORBIT, 0.0, 600.0)
    times = np.arange(0.0, 600.0, 0.5)
    states = orbit.states(times)
    frame = orbit_frame(states, orbit.acceleration(times))
    derivative = angular_rates(
        times, np.broadcast_to(np.eye(3), frame.axes.shape), orbit_axes=frame.axes
    )
    # Rounding of the Earth-fixed positions, 1e-9 m of 7e6 m, over half a second.
    np.testing.assert_allclose(frame.rate[2:-2], derivative.inertial[2:-2], rtol=0, atol=1e-12)
    assert np.abs(frame.rate[:, 2]).max() > 1e-8
    body = random_attitudes(1)
    np.testing.assert_allclose(
        inertial_rate(body, np.zeros(3), frame.rate), frame.rate @ body[0].T, atol=ROUNDING
    )


def test_path_and_its_rate_in_the_orbit_frame():
    orbit = smooth_orbit(ORBIT, 0.0, 240.0)
    target = orbit.states(120.0).position * 0.9
    times = 120.0 + 0.1 * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    states = orbit.states(times)
    path, rate = path_in_orbit_frame(states, orbit_frame(states, orbit.acceleration(times)), target)
    derivative = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) @ path / 1.2
    np.testing.assert_allclose(rate[2], derivative, atol=1e-7)  # rounding 1e-9 m in 0.1 s


@pytest.mark.parametrize("length", [0.0, 10.0, 200.0, 1500.0])
def test_smooth_orbit_is_the_orbit(length):
    orbit = smooth_orbit(ORBIT, 500.0, 500.0 + length)
    times = np.linspace(500.0, 500.0 + length, 301)
    states, exact = orbit.states(times), ORBIT.earth_fixed(times)
    # The Earth's rotation angle is rounded to 6e-14 rad: 4e-7 m.
    np.testing.assert_allclose(states.position, exact.position, rtol=0, atol=1e-6)
    np.testing.assert_allclose(states.velocity, exact.velocity, rtol=0, atol=1e-6)
    assert orbit.misfit < 1e-6
    step = 1.0
    after, before = (ORBIT.earth_fixed(times + shift).velocity for shift in (step, -step))
    # Second-order differences over 1 s: n³ v/6 = 2e-6 m/s².
    np.testing.assert_allclose(
        orbit.acceleration(times), (after - before) / (2.0 * step), rtol=0, atol=3e-6
    )


def test_smooth_orbit_turns_celestial_axes_as_the_trajectory_does():
    orbit = smooth_orbit(ORBIT, 100.0, 300.0)
    times = np.linspace(100.0, 300.0, 11)
    turned = np.einsum("sij,sj->si", orbit.from_celestial(times), ORBIT.inertial(times).position)
    np.testing.assert_allclose(turned, ORBIT.earth_fixed(times).position, rtol=0, atol=1e-6)


class Bounded:
    """An orbit known for a while only."""

    epoch = ORBIT.epoch
    span = (0.0, 300.0)
    perturbed = True

    def inertial(self, times):
        return ORBIT.inertial(times)

    def earth_fixed(self, times):
        assert np.all((np.asarray(times) >= 0.0) & (np.asarray(times) <= 300.0))
        return ORBIT.earth_fixed(times)


def test_smooth_orbit_asks_for_nothing_outside_the_span():
    """A node outside would raise in `Bounded`."""
    assert SHORTEST < 300.0
    for start, stop in ((0.0, 10.0), (290.0, 300.0), (0.0, 300.0)):
        assert smooth_orbit(Bounded(), start, stop).misfit < 1e-6
    with pytest.raises(ValueError, match=r"known from 0\.000 s to 300\.000 s.*shorter"):
        smooth_orbit(Bounded(), 250.0, 350.0)


def test_axes_of_the_frame_are_those_of_the_steering_laws():
    states = States(*(each[None] for each in ORBIT.earth_fixed(0.0)))
    frame = orbit_frame(states, np.zeros((1, 3)))
    np.testing.assert_array_equal(frame.axes, orbit_axes(states))
