"""Exact Doppler centroid and rate of targets at rest on the Earth.

Positive where satellite and target approach each other. States are Earth-fixed: a target does not
move there, so that f = (2/λ) û·v in any frame.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import States
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
    EARTH_J2,
)

from .frames import inertial_velocity, rotation_velocity
from .vectors import dot, unit

Array = NDArray[np.float64]


def doppler_per_speed(wavelength: float) -> float:
    """Doppler frequency per speed of approach, 2/λ [Hz per m/s].

    Raises
    ------
    ValueError
        If the wavelength is not positive.
    """
    if not wavelength > 0.0:
        raise ValueError(f"wavelength = {wavelength!r} m must be positive; give meters")
    return 2.0 / wavelength


def doppler_centroid(states: States, target: ArrayLike, *, wavelength: float) -> Array:
    """Doppler frequency of targets, from positions and inertial velocities.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    target : (..., 3) — at rest on the Earth, Earth-fixed [m]; broadcasts with the states.
    wavelength : scalar — of the carrier [m].

    Returns
    -------
    (...) — f = −(2/λ) (R_s − R_t)·(V_s − V_t)/r with V_t = ω×R_t [Hz].

    References
    ----------
    Zhao 2019 eq. (1); Meng 2003 eq. (1).
    """
    point = np.asarray(target, dtype=np.float64)
    relative_position = states.position - point
    relative_velocity = inertial_velocity(states) - rotation_velocity(point)
    return -doppler_per_speed(wavelength) * dot(unit(relative_position), relative_velocity)


def doppler_of_direction(states: States, line_of_sight: ArrayLike, *, wavelength: float) -> Array:
    """Doppler frequency of whatever rests on the Earth along a line of sight.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    line_of_sight : (..., 3) — unit vectors from the satellite, Earth-fixed.
    wavelength : scalar — of the carrier [m].

    Returns
    -------
    (...) — f = (2/λ) û·v [Hz]: the same as `doppler_centroid` for any target along û, since
    (ω×(R_s − R_t))·û = 0.
    """
    return doppler_per_speed(wavelength) * dot(
        np.asarray(line_of_sight, dtype=np.float64), states.velocity
    )


def pointing_sensitivity(states: States, line_of_sight: ArrayLike, *, wavelength: float) -> Array:
    """Largest change of the Doppler centroid for a small turn of the beam in any direction.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    line_of_sight : (..., 3) — unit vectors from the satellite, Earth-fixed.
    wavelength : scalar — of the carrier [m].

    Returns
    -------
    (...) — (2/λ)|v − (v·û)û| [Hz/rad].
    """
    across = np.cross(np.asarray(line_of_sight, dtype=np.float64), states.velocity)
    return doppler_per_speed(wavelength) * np.sqrt(dot(across, across))


def doppler_rate(
    states: States,
    target: ArrayLike,
    *,
    wavelength: float,
    acceleration: ArrayLike | None = None,
) -> Array:
    """Rate of change of the Doppler frequency of targets.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    target : (..., 3) — at rest on the Earth, Earth-fixed [m]; broadcasts with the states.
    wavelength : scalar — of the carrier [m].
    acceleration : (..., 3) — of the satellite, of its Earth-fixed coordinates [m/s²];
        `earth_fixed_acceleration` when not given.

    Returns
    -------
    (...) — ḟ = (2/λ)[û·a − (|v|² − (û·v)²)/r] [Hz/s]; negative for a target in view.

    Notes
    -----
    The default leaves out gravity beyond J2 (1e-4 m/s², in low orbit), drag, the Sun and the Moon:
    0.01 Hz/s at λ = 0.03 m, 2e-6 of the rate of a low orbit.
    """
    if acceleration is None:
        acceleration = earth_fixed_acceleration(states)
    path = np.asarray(target, dtype=np.float64) - states.position
    slant_range = np.sqrt(dot(path, path))
    line = path / slant_range[..., None]
    across = np.cross(line, states.velocity)
    curvature = dot(across, across) / slant_range
    return doppler_per_speed(wavelength) * (
        dot(line, np.asarray(acceleration, np.float64)) - curvature
    )


def earth_fixed_acceleration(states: States, *, j2: float = EARTH_J2) -> Array:
    """Acceleration of a satellite's Earth-fixed coordinates under gravity with J2.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    j2 : scalar — second zonal harmonic; 0 for a point mass.

    Returns
    -------
    (..., 3) — gravity − 2ω×v − ω×(ω×r) [m/s²].
    """
    coriolis = 2.0 * rotation_velocity(states.velocity)
    centrifugal = rotation_velocity(rotation_velocity(states.position))
    return _gravity(states.position, j2) - coriolis - centrifugal


def _gravity(position: Array, j2: float) -> Array:
    """Gradient of (μ/r)[1 − J2 (R/r)² (3 sin²φ − 1)/2], (..., 3) [m/s²]."""
    squared = dot(position, position)[..., None]
    oblate = 1.5 * j2 * EARTH_EQUATORIAL_RADIUS**2 / squared
    sine_squared = position[..., 2:] ** 2 / squared
    factor = 1.0 + oblate * (np.array([1.0, 1.0, 3.0]) - 5.0 * sine_squared)
    gravity: Array = -EARTH_GRAVITATIONAL_PARAMETER / squared**1.5 * factor * position
    return gravity
