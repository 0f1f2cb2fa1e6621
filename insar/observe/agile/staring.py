"""One place watched for a while, as the scene of a formation."""

from __future__ import annotations

from datetime import datetime
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Orbit, mean_elements_at, reference_orbit

from ...scene import Scene
from ..frames import rtn_axes
from ..look import look_at
from ..scenes.windows import moment
from ..vectors import rotate, unit
from .plans import PassPlan
from .spotlight_plan import aim_point
from .spotlight_results import SpotlightRequest

Array = NDArray[np.float64]


class StaringScene(NamedTuple):
    """One place watched for a while, as a scene for a formation.

    Attributes
    ----------
    scene : segments in order of time, the first at time 0.
    orbit : circular reference orbit of the formation.
    epoch : UTC of the first segment, the epoch of the formation's states.
    eccentricity : scalar — mean, of the orbit.
    request : place and orbit.
    plan : moment of zero Doppler, the middle of the scene; side, direction and number of the pass.
    duration : scalar — from the first segment to the last [s].
    """

    scene: Scene
    orbit: Orbit
    epoch: datetime
    eccentricity: float
    request: SpotlightRequest
    plan: PassPlan
    duration: float

    @property
    def orbit_source(self) -> str:
        """What the orbit is known from."""
        return self.request.trajectory.source

    @property
    def orbit_epoch(self) -> datetime:
        """UTC of its elements, or of the beginning of its ephemeris."""
        return self.request.trajectory.epoch


def staring_scene(
    request: SpotlightRequest,
    plan: PassPlan,
    *,
    duration: float,
    segments: int,
    slope: float = 0.0,
) -> StaringScene:
    """Scene of a formation that watches one place.

    Parameters
    ----------
    request : the place, and the orbit of the formation.
    plan : when it is seen; zero Doppler is the middle.
    duration : scalar — from the first segment to the last [s].
    segments : moments, equally spaced, both ends included; one is the middle.
    slope : scalar — of the terrain in range, positive towards the radar [rad].

    Returns
    -------
    StaringScene — every segment is the place; the line of sight turns from ahead to behind.

    Raises
    ------
    ValueError
        If the place does not see the satellite in every segment, or the slope lies in layover or
        shadow there.
    """
    if segments < 1:
        raise ValueError(f"segments = {segments!r} must be at least 1")
    half = 0.5 * duration if segments > 1 else 0.0
    trajectory, times = request.trajectory, plan.time + np.linspace(-half, half, segments)
    states = trajectory.earth_fixed(times)
    look = look_at(states, aim_point(request))
    if not np.all(look.visible):
        raise ValueError(
            f"the place sees the satellite in {np.count_nonzero(look.visible)} of {segments} "
            f"segments only, over {duration:.6g} s; take a shorter time"
        )
    _check_slope(slope, look.incidence)
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
    return StaringScene(
        scene=scene,
        orbit=reference_orbit(trajectory, first),
        epoch=moment(trajectory, first),
        eccentricity=float(mean_elements_at(trajectory, first).eccentricity),
        request=request,
        plan=plan,
        duration=2.0 * half,
    )


def _check_slope(slope: float, incidence: Array) -> None:
    """Refuse a slope [rad] that faces the radar steeper than the line of sight, or turns away."""
    least, most = float(np.min(incidence)), float(np.max(incidence))
    if not most - 0.5 * np.pi < slope < least:
        low, high = np.degrees([most - 0.5 * np.pi, least])
        raise ValueError(
            f"slope = {np.degrees(slope):g}°: lies in layover or shadow, where no phase is "
            f"measured: at incidences of {np.degrees(least):.2f}° to {np.degrees(most):.2f}° it "
            f"must be between {low:.2f}° and {high:.2f}°; choose a gentler slope, or 0"
        )
