"""The circular orbit that stands for a real one in the linear relative motion."""

from __future__ import annotations

from datetime import timedelta

from .elements import Elements, elements_from_states
from .frames import true_of_epoch_to_gcrs
from .j2 import mean_elements
from .orbit import Orbit
from .trajectory import States, Trajectory


def mean_elements_at(trajectory: Trajectory, time: float) -> Elements:
    """Mean elements of a trajectory at one time.

    Parameters
    ----------
    trajectory : any orbit.
    time : scalar — since the trajectory's epoch [s].

    Returns
    -------
    Elements of scalars, freed from the periodic terms of J2 if the orbit has them, referred to the
    true equator and equinox of that time [m, rad].
    """
    states = trajectory.inertial(time)
    axes = true_of_epoch_to_gcrs(trajectory.epoch + timedelta(seconds=time))
    elements_of = mean_elements if trajectory.perturbed else elements_from_states
    elements = elements_of(States(states.position @ axes, states.velocity @ axes))
    return Elements(*(float(value) for value in elements))


def reference_orbit(trajectory: Trajectory, time: float) -> Orbit:
    """Circular reference orbit for the relative motion.

    Parameters
    ----------
    trajectory : any orbit.
    time : scalar — since the trajectory's epoch [s].

    Returns
    -------
    Circle with the mean semi-major axis and inclination at that time. The eccentricity e is lost:
    relative motion of size d is then wrong by about 3·e·d in an orbit.
    """
    mean = mean_elements_at(trajectory, time)
    return Orbit(semi_major_axis=float(mean.semi_major_axis), inclination=float(mean.inclination))
