"""Range and Doppler of a point on the ground, from the phase center that a turning body carries."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..frames import EARTH_ROTATION, orbit_axes
from ..vectors import dot, rotate
from .smooth_orbit import SmoothOrbit
from .spotlight_attitude import Antenna, point

Array = NDArray[np.float64]


class Echo(NamedTuple):
    """Of a point on the ground, (S,) each.

    Attributes
    ----------
    slant_range : from the phase center [m].
    doppler : positive while it comes nearer [Hz].
    """

    slant_range: Array
    doppler: Array


def echo(
    orbit: SmoothOrbit,
    times: Array,
    place: Array,
    *,
    rotation_center: Array,
    antenna: Antenna,
    wavelength: float,
) -> Echo:
    """What the radar measures of a point while its beam stays on the rotation center.

    Parameters
    ----------
    orbit : of the satellite.
    times : (S,) — since the trajectory's epoch [s].
    place : (3,) — the point, Earth-fixed [m].
    rotation_center : (3,) — where the beam points, Earth-fixed [m].
    antenna : beam and phase center.
    wavelength : scalar [m].
    """
    states = orbit.states(times)
    turning = point(orbit, times, rotation_center, antenna)
    body = turning.attitude @ orbit_axes(states)
    to_earth = np.swapaxes(body, -1, -2)
    against_earth = turning.rate_inertial - rotate(body, EARTH_ROTATION)
    carried = rotate(to_earth, np.cross(against_earth, antenna.phase_center))
    path = place - states.position - rotate(to_earth, antenna.phase_center)
    slant_range = np.sqrt(dot(path, path))
    approach = dot(path, states.velocity + carried) / slant_range
    return Echo(slant_range, 2.0 / wavelength * approach)
