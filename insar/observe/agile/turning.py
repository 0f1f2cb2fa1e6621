"""Turns that point a body, and how fast they go.

An attitude is a matrix (..., 3, 3) whose rows are the body axes, as in `attitude`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import States

from ..frames import EARTH_ROTATION, inertial_velocity, orbit_axes, rotation_velocity
from ..vectors import dot, rotate, unit

Array = NDArray[np.float64]


def turn_between(one: ArrayLike, other: ArrayLike) -> Array:
    """Angle of the turn from one attitude to another, (..., 3, 3) each to (...) [rad]."""
    difference = np.asarray(other, np.float64) - np.asarray(one, np.float64)
    # |C₁ − C₂|² = 8 sin²(angle/2): keeps its digits for small turns, unlike the trace.
    half = np.sqrt(np.sum(difference**2, axis=(-1, -2)) / 8.0)
    angle: Array = 2.0 * np.arcsin(np.minimum(half, 1.0))
    return angle


def shortest_turn(start: ArrayLike, onto: ArrayLike) -> Array:
    """Attitude that points a body direction by the shortest turn.

    Parameters
    ----------
    start : (..., 3) — the direction in the body, where it points before the turn.
    onto : (..., 3) — where it shall point, in the frame. Neither need be normalized.

    Returns
    -------
    (..., 3, 3) — C with Cᵀ start ∥ onto; NaN if they are opposite or either is zero: then all
    half turns are equally short.

    Notes
    -----
    Two half turns, about `start` and then about h, midway between `start` and `onto`: the turn by
    twice the angle between them. The same as q = unit[b×d, 1 + b·d], accurate at any angle.

    References
    ----------
    Han 2016 eqs (9), (10).
    """
    first = unit(np.asarray(start, dtype=np.float64))
    middle = unit(_sum_of(first, unit(np.asarray(onto, dtype=np.float64))))
    return _half_turn(first) @ _half_turn(middle)


class Turn(NamedTuple):
    """An attitude and its angular velocity.

    Attributes
    ----------
    attitude : (..., 3, 3) — frame to body.
    rate : (..., 3) — of the body against the frame, in body axes [rad/s].
    """

    attitude: Array
    rate: Array


def moving_shortest_turn(
    start: ArrayLike, start_rate: ArrayLike, onto: ArrayLike, onto_rate: ArrayLike
) -> Turn:
    """`shortest_turn` while both directions move.

    Parameters
    ----------
    start, start_rate : (..., 3) — direction in the body, of any length, and its derivative.
    onto, onto_rate : (..., 3) — the same in the frame.

    Returns
    -------
    Turn — NaN where the directions are opposite or of length zero.

    Notes
    -----
    A half turn H(u) about a moving axis has the angular velocity 2u×u̇, in the frame. The attitude
    is C = H(b) H(h), and H(b) (b×ḃ) = −b×ḃ.
    """
    first, first_rate = _unit_and_rate(start, start_rate)
    last, last_rate = _unit_and_rate(onto, onto_rate)
    total = _sum_of(first, last)
    middle, middle_rate = _unit_and_rate(total, first_rate + last_rate)
    attitude = _half_turn(first) @ _half_turn(middle)
    of_middle = rotate(attitude, np.cross(middle, middle_rate))
    return Turn(attitude, 2.0 * (of_middle - np.cross(first, first_rate)))


class OrbitFrame(NamedTuple):
    """The orbit frame and how it turns.

    Attributes
    ----------
    axes : (..., 3, 3) — Earth-fixed axes to orbit frame.
    rate : (..., 3) — angular velocity against inertial space, in its own axes [rad/s].
    """

    axes: Array
    rate: Array


def orbit_frame(states: States, acceleration: Array) -> OrbitFrame:
    """Axes and angular velocity of the orbit frame.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    acceleration : (..., 3) — of the Earth-fixed coordinates [m/s²].

    Returns
    -------
    OrbitFrame — turning by −h/r² about Y and by −(r/h) A·N about Z: the turn of the orbit plane by
    the acceleration A across it. Nothing turns it about X.
    """
    axes = orbit_axes(states)
    radius = np.sqrt(dot(states.position, states.position))
    along = dot(inertial_velocity(states), axes[..., 0, :])
    coriolis = 2.0 * rotation_velocity(states.velocity)
    centrifugal = rotation_velocity(rotation_velocity(states.position))
    across = -dot(acceleration + coriolis + centrifugal, axes[..., 1, :])  # A·N
    rate = np.stack([np.zeros_like(radius), -along / radius, -across / along], axis=-1)
    return OrbitFrame(axes, rate)


def inertial_rate(attitude: Array, rate: Array, frame_rate: Array) -> Array:
    """Angular velocity of a body against inertial space.

    Parameters
    ----------
    attitude : (..., 3, 3) — orbit frame to body.
    rate : (..., 3) — of the body against the orbit frame, in body axes [rad/s].
    frame_rate : (..., 3) — of the orbit frame, in its axes; `OrbitFrame.rate` [rad/s].

    Returns
    -------
    (..., 3) — in body axes [rad/s].
    """
    return rate + rotate(attitude, frame_rate)


def path_in_orbit_frame(
    states: States, frame: OrbitFrame, target: ArrayLike
) -> tuple[Array, Array]:
    """Vector from the satellite to a point at rest on the Earth, and its derivative.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    frame : of these states.
    target : (..., 3) — Earth-fixed [m].

    Returns
    -------
    (..., 3) and (..., 3) — components along the axes of the orbit frame [m], and their rates
    [m/s].
    """
    path = rotate(frame.axes, np.asarray(target, dtype=np.float64) - states.position)
    against_earth = frame.rate - rotate(frame.axes, EARTH_ROTATION)
    return path, -rotate(frame.axes, states.velocity) - np.cross(against_earth, path)


def _sum_of(one: Array, other: Array) -> Array:
    """Sum of unit vectors, which points midway; NaN if they are opposite."""
    total = one + other
    apart = dot(total, total) > (1e-12) ** 2
    return np.where(apart[..., None], total, np.nan)


def _half_turn(axis: Array) -> Array:
    """Half turn about a unit vector, (..., 3) to (..., 3, 3); its own inverse."""
    return 2.0 * axis[..., :, None] * axis[..., None, :] - np.eye(3)


def _unit_and_rate(vector: ArrayLike, rate: ArrayLike) -> tuple[Array, Array]:
    """Direction of a vector and its derivative, from those of the vector, (..., 3) each."""
    value, change = np.asarray(vector, dtype=np.float64), np.asarray(rate, dtype=np.float64)
    direction = unit(value)
    with np.errstate(invalid="ignore", divide="ignore"):
        turning = change / np.sqrt(dot(value, value))[..., None]
    return direction, turning - dot(turning, direction)[..., None] * direction
