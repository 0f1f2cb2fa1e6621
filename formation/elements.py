"""Keplerian elements and states of an unperturbed orbit; which axes is the caller's affair."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .constants import EARTH_GRAVITATIONAL_PARAMETER
from .trajectory import States

Array = NDArray[np.float64]
Values = float | Array


class Elements(NamedTuple):
    """Keplerian elements of an ellipse.

    Attributes
    ----------
    semi_major_axis : (...) [m].
    eccentricity : (...) — 0 to below 1.
    inclination : (...) — to the plane of the x and y axes, 0 to π [rad].
    raan : (...) — right ascension of the ascending node, from the x axis [rad].
    argument_of_perigee : (...) — from the ascending node [rad].
    mean_anomaly : (...) — from perigee [rad].
    """

    semi_major_axis: Values
    eccentricity: Values
    inclination: Values
    raan: Values
    argument_of_perigee: Values
    mean_anomaly: Values


class PolarState(NamedTuple):
    """Polar coordinates in the orbit plane, and the direction of that plane (Hill's variables).

    Attributes
    ----------
    radius : (...) [m].
    radial_rate : (...) [m/s].
    argument_of_latitude : (...) — from the ascending node [rad].
    momentum : (...) — angular momentum per mass [m²/s].
    inclination : (...) [rad].
    raan : (...) — right ascension of the ascending node [rad].
    """

    radius: Array
    radial_rate: Array
    argument_of_latitude: Array
    momentum: Array
    inclination: Array
    raan: Array


class Ellipse(NamedTuple):
    """Shape of the orbit through a polar state, and the place on it.

    Attributes
    ----------
    parameter : (...) — semi-latus rectum [m].
    e_cos_f, e_sin_f : (...) — eccentricity by cosine and sine of the true anomaly.
    eta : (...) — √(1 − e²); NaN for a parabola or hyperbola.
    equation_of_center : (...) — true minus mean anomaly [rad].
    """

    parameter: Array
    e_cos_f: Array
    e_sin_f: Array
    eta: Array
    equation_of_center: Array


def mean_motion(semi_major_axis: ArrayLike) -> Array:
    """Mean angular rate √(μ/a³) [rad/s] for semi-major axes (...) [m]."""
    axis = np.asarray(semi_major_axis, dtype=np.float64)
    rate: Array = np.sqrt(EARTH_GRAVITATIONAL_PARAMETER / axis**3)
    return rate


def eccentric_anomaly(mean_anomaly: ArrayLike, eccentricity: ArrayLike) -> Array:
    """Solve Kepler's equation E − e sin E = M, to rounding.

    Parameters
    ----------
    mean_anomaly : (...) — any number of turns [rad].
    eccentricity : (...) — 0 to below 1.

    Returns
    -------
    (...) — in the same turn as the mean anomaly [rad].
    """
    mean = np.asarray(mean_anomaly, dtype=np.float64)
    e = np.asarray(eccentricity, dtype=np.float64)
    turns = 2.0 * np.pi * np.round(mean / (2.0 * np.pi))
    reduced = mean - turns
    # Exact to third order in e; with the clip, Newton's steps converge for any e below 1.
    angle = reduced + e * np.sin(reduced) / np.sqrt(1.0 - 2.0 * e * np.cos(reduced) + e * e)
    for _ in range(50):
        residual = angle - e * np.sin(angle) - reduced
        step = residual / (1.0 - e * np.cos(angle))
        angle = np.clip(angle - step, -np.pi, np.pi)
        if np.all(np.abs(step) < 1e-9):  # the next error is its square
            break
    return angle + turns


def states_from_elements(elements: Elements) -> States:
    """Positions and velocities.

    Parameters
    ----------
    elements : each (...).

    Returns
    -------
    States (..., 3) in the axes of the elements [m, m/s].
    """
    return states_from_polar(polar_from_elements(elements))


def elements_from_states(states: States) -> Elements:
    """Osculating elements: those of the ellipse that an unperturbed satellite would follow.

    Parameters
    ----------
    states : (..., 3) in inertial axes [m, m/s].

    Returns
    -------
    Elements, each (...); angles from 0 to 2π. Where they lose their meaning, the node of an
    equatorial orbit lies on the x axis, on one side or the other, and the perigee of a circle at
    the node. NaN for a state that is not on an ellipse.
    """
    return elements_from_polar(polar_from_states(states))


def polar_from_elements(elements: Elements) -> PolarState:
    """Polar coordinates of elements, each (...)."""
    a, e, i, raan, perigee, mean = np.broadcast_arrays(
        *(np.asarray(value, dtype=np.float64) for value in elements)
    )
    eccentric = eccentric_anomaly(mean, e)
    eta = np.sqrt(1.0 - e * e)
    e_cos, e_sin = e * np.cos(eccentric), e * np.sin(eccentric)
    # f − E = 2 atan(β sin E/(1 − β cos E)), β = e/(1 + η): no difference of large angles.
    center = 2.0 * np.arctan2(e_sin, 1.0 + eta - e_cos) + e_sin
    radius = a * (1.0 - e_cos)
    return PolarState(
        radius=radius,
        radial_rate=np.sqrt(EARTH_GRAVITATIONAL_PARAMETER * a) * e_sin / radius,
        argument_of_latitude=perigee + mean + center,
        momentum=np.sqrt(EARTH_GRAVITATIONAL_PARAMETER * a) * eta,
        inclination=i,
        raan=raan,
    )


def elements_from_polar(polar: PolarState) -> Elements:
    """Elements, each (...), of polar coordinates; angles from 0 to 2π."""
    shape = ellipse(polar)
    true = np.arctan2(shape.e_sin_f, shape.e_cos_f)
    turn = 2.0 * np.pi
    return Elements(
        semi_major_axis=shape.parameter / shape.eta**2,
        eccentricity=np.where(np.isnan(shape.eta), np.nan, np.hypot(shape.e_cos_f, shape.e_sin_f)),
        inclination=polar.inclination,
        raan=polar.raan % turn,
        argument_of_perigee=(polar.argument_of_latitude - true) % turn,
        mean_anomaly=(true - shape.equation_of_center) % turn,
    )


def ellipse(polar: PolarState) -> Ellipse:
    """Shape of the orbit through polar states (...)."""
    parameter = polar.momentum**2 / EARTH_GRAVITATIONAL_PARAMETER
    e_cos_f = parameter / polar.radius - 1.0
    e_sin_f = polar.momentum * polar.radial_rate / EARTH_GRAVITATIONAL_PARAMETER
    square = 1.0 - e_cos_f**2 - e_sin_f**2
    eta = np.sqrt(np.where(square > 0.0, square, np.nan))
    # f − E = 2 atan(e sin f/(1 + η + e cos f)), and E − M = e sin E.
    center = 2.0 * np.arctan2(e_sin_f, 1.0 + eta + e_cos_f) + eta * e_sin_f / (1.0 + e_cos_f)
    return Ellipse(parameter, e_cos_f, e_sin_f, eta, center)


def states_from_polar(polar: PolarState) -> States:
    """States (..., 3) of polar coordinates."""
    outward = _in_plane(polar, polar.argument_of_latitude)
    forward = _in_plane(polar, polar.argument_of_latitude + np.pi / 2.0)
    transverse = polar.momentum / polar.radius
    return States(
        polar.radius[..., None] * outward,
        polar.radial_rate[..., None] * outward + transverse[..., None] * forward,
    )


def polar_from_states(states: States) -> PolarState:
    """Polar coordinates of states (..., 3)."""
    position = np.asarray(states.position, dtype=np.float64)
    velocity = np.asarray(states.velocity, dtype=np.float64)
    radius = np.linalg.norm(position, axis=-1)
    normal = np.cross(position, velocity)
    momentum = np.linalg.norm(normal, axis=-1)
    raan = np.arctan2(normal[..., 0], -normal[..., 1])
    node = np.stack([np.cos(raan), np.sin(raan), np.zeros_like(raan)], axis=-1)
    across = np.cross(normal, node) / momentum[..., None]
    return PolarState(
        radius=radius,
        radial_rate=np.sum(position * velocity, axis=-1) / radius,
        argument_of_latitude=np.arctan2(
            np.sum(position * across, axis=-1), np.sum(position * node, axis=-1)
        ),
        momentum=momentum,
        inclination=np.arctan2(np.hypot(normal[..., 0], normal[..., 1]), normal[..., 2]),
        raan=raan,
    )


def _in_plane(polar: PolarState, angle: Array) -> Array:
    """Unit vectors (..., 3) at an angle from the ascending node."""
    cosine, sine = np.cos(angle), np.sin(angle)
    cos_node, sin_node = np.cos(polar.raan), np.sin(polar.raan)
    tilted = sine * np.cos(polar.inclination)
    return np.stack(
        [
            cos_node * cosine - sin_node * tilted,
            sin_node * cosine + cos_node * tilted,
            sine * np.sin(polar.inclination),
        ],
        axis=-1,
    )
