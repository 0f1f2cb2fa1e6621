"""One place watched for a while, as the scene of a formation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory, reference_orbit

from ...scene import Scene
from ..frames import rtn_axes
from ..look import look_at
from ..scenes.windows import moment
from ..vectors import rotate, unit
from .spotlight_results import SpotlightScene

Array = NDArray[np.float64]


def staring_scene(
    trajectory: Trajectory,
    target: Array,
    *,
    time: float,
    duration: float,
    segments: int,
    slope: float = 0.0,
) -> SpotlightScene:
    """Scene of a formation that watches one place.

    Parameters
    ----------
    trajectory : of the formation.
    target : (3,) — the place, Earth-fixed [m].
    time : scalar — of the middle, since the trajectory's epoch [s].
    duration : scalar — from the first segment to the last [s].
    segments : moments, equally spaced, both ends included; one is the middle.
    slope : scalar — of the terrain in range, positive towards the radar [rad].

    Returns
    -------
    SpotlightScene — every segment is the place; the line of sight turns from ahead to behind.

    Raises
    ------
    ValueError
        If the place does not see the satellite in every segment.
    """
    if segments < 1:
        raise ValueError(f"segments = {segments!r} must be at least 1")
    half = 0.5 * duration if segments > 1 else 0.0
    times = time + np.linspace(-half, half, segments)
    states = trajectory.earth_fixed(times)
    look = look_at(states, target)
    if not np.all(look.visible):
        raise ValueError(
            f"the place sees the satellite in {np.count_nonzero(look.visible)} of {segments} "
            f"segments only, over {duration:.6g} s; take a shorter time"
        )
    scene = Scene(
        times=times - times[0],
        slant_range=look.slant_range,
        look_angle=look.look_angle,
        azimuth=look.azimuth,
        incidence=look.incidence,
        velocity_direction=rotate(rtn_axes(states), unit(states.velocity)),
        slope=np.asarray(slope),
    )
    first = float(times[0])
    return SpotlightScene(scene, reference_orbit(trajectory, first), moment(trajectory, first))
