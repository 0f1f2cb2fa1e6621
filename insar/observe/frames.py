"""Axes and orbit quantities of a satellite, all from its Earth-fixed state.

The inertial velocity is V = v + ω×r, written in the Earth-fixed axes of the instant, with the
Earth's rotation ω along the z axis. Every quantity here is that of the instant, so that the
closed forms of attitude steering hold exactly for perturbed orbits too.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States
from formation.constants import EARTH_GRAVITATIONAL_PARAMETER, EARTH_ROTATION_RATE

from .vectors import dot, unit

Array = NDArray[np.float64]

EARTH_ROTATION = np.array([0.0, 0.0, EARTH_ROTATION_RATE])
EARTH_ROTATION.setflags(write=False)


def rotation_velocity(position: Array) -> Array:
    """Velocity ω×r of the rotating Earth at a point, (..., 3) to (..., 3) [m/s]."""
    x, y = position[..., 0], position[..., 1]
    return EARTH_ROTATION_RATE * np.stack([-y, x, np.zeros_like(x)], axis=-1)


def inertial_velocity(states: States) -> Array:
    """Velocity against inertial space, in the Earth-fixed axes of the instant.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].

    Returns
    -------
    (..., 3) — V = v + ω×r [m/s].

    Notes
    -----
    The axis of rotation is the ITRS z axis, its rate nominal: polar motion (0.3″) and the length
    of day change V by less than 1 mm/s in low orbit. The Doppler needs v only.
    """
    return states.velocity + rotation_velocity(states.position)


def rtn_axes(states: States) -> Array:
    """Axes R (radial outward), T (along-track, horizontal) and N (orbit normal).

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].

    Returns
    -------
    (..., 3, 3) — rows R, T, N: the matrix takes Earth-fixed components to RTN.
    """
    radial = unit(states.position)
    normal = unit(np.cross(states.position, inertial_velocity(states)))
    return np.stack([radial, np.cross(normal, radial), normal], axis=-2)


def orbit_axes(states: States) -> Array:
    """Orbit frame of the attitude: X forward and horizontal, Y = −N, Z geocentric nadir.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].

    Returns
    -------
    (..., 3, 3) — rows X, Y, Z: the matrix takes Earth-fixed components to the orbit frame.
    """
    axes = rtn_axes(states)
    return np.stack([axes[..., 1, :], -axes[..., 2, :], -axes[..., 0, :]], axis=-2)


class OrbitGeometry(NamedTuple):
    """Where a satellite is on its osculating orbit, without the singularities of elements.

    Attributes
    ----------
    radius : (...) — distance from the Earth's center [m].
    radial_velocity : (...) — V·R [m/s].
    angular_rate : (...) — h/r², of the position about the center [rad/s].
    axis_radial, axis_along, axis_normal : (...) — components of the Earth's axis along R, T, N:
        sin i sin u, sin i cos u, cos i, of the instantaneous inclination i and argument of
        latitude u.
    """

    radius: Array
    radial_velocity: Array
    angular_rate: Array
    axis_radial: Array
    axis_along: Array
    axis_normal: Array

    @property
    def inclination(self) -> Array:
        """Angle between the Earth's axis and the orbit normal, (...) [rad]."""
        return np.arctan2(np.hypot(self.axis_radial, self.axis_along), self.axis_normal)

    @property
    def argument_of_latitude(self) -> Array:
        """From the ascending node, −π to π, (...) [rad]; 0 for an equatorial orbit."""
        return np.arctan2(self.axis_radial, self.axis_along)

    @property
    def mean_motion(self) -> Array:
        """Of the osculating semi-major axis, (...) [rad/s]; NaN unless the orbit is bound."""
        speed_squared = self.radial_velocity**2 + (self.angular_rate * self.radius) ** 2
        inverse_axis = 2.0 / self.radius - speed_squared / EARTH_GRAVITATIONAL_PARAMETER
        with np.errstate(invalid="ignore"):
            rate: Array = np.sqrt(EARTH_GRAVITATIONAL_PARAMETER * inverse_axis**3)
        return rate


def orbit_geometry(states: States) -> OrbitGeometry:
    """Where a satellite is on its osculating orbit.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].

    Returns
    -------
    OrbitGeometry — of the instant.
    """
    axes = rtn_axes(states)
    velocity = inertial_velocity(states)
    radius = np.sqrt(dot(states.position, states.position))
    return OrbitGeometry(
        radius=radius,
        radial_velocity=dot(velocity, axes[..., 0, :]),
        angular_rate=dot(velocity, axes[..., 1, :]) / radius,
        axis_radial=axes[..., 0, 2],
        axis_along=axes[..., 1, 2],
        axis_normal=axes[..., 2, 2],
    )
