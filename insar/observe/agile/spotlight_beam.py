"""What the beam of a spotlight imaging does: where it falls, and what the radar sees."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..earth import intersect, to_geodetic
from ..frames import EARTH_ROTATION, orbit_axes
from ..vectors import dot, rotate
from .smooth_orbit import SmoothOrbit
from .spotlight_attitude import Antenna, point
from .spotlight_plan import aim_point
from .spotlight_results import (
    AimError,
    AttitudeProfile,
    EchoHistory,
    Iteration,
    Pointing,
    SpotlightPlan,
    SpotlightRequest,
)

Array = NDArray[np.float64]

Z_AXIS: Final = np.array([0.0, 0.0, 1.0])
ORIGIN: Final = np.zeros(3)


def aim_error(
    request: SpotlightRequest,
    orbit: SmoothOrbit,
    plan: SpotlightPlan,
    times: Array,
    profile: AttitudeProfile,
    iteration: Iteration,
) -> AimError:
    """Aim errors of four attitudes, with the real beam and phase center."""
    moments, antenna = plan.time + times, Antenna.of(request)
    states = orbit.states(moments)
    axes = orbit_axes(states)
    off_axis_only = antenna._replace(phase_center=ORIGIN)
    neither = Antenna(Z_AXIS, ORIGIN)

    def fall(attitude: Array) -> Array:
        return _footprint(states.position, attitude @ axes, antenna, request.height)

    if request.sliding_factor == 0.0:
        wanted = np.broadcast_to(plan.rotation_center, (len(times), 3))
    else:
        body = profile.attitude @ axes
        start = states.position + rotate(np.swapaxes(body, -1, -2), antenna.phase_center)
        wanted = intersect(start, plan.rotation_center - start, height=request.height)
    attitudes = (
        profile.attitude,
        iteration.attitude,
        point(orbit, moments, plan.rotation_center, off_axis_only).attitude,
        point(orbit, moments, plan.rotation_center, neither).attitude,
    )
    valid = np.where(profile.pointing == Pointing.SOLVED, 0.0, np.nan)
    gaps = (fall(attitude) - wanted for attitude in attitudes)
    return AimError(*(np.sqrt(dot(gap, gap)) + valid for gap in gaps))


def _footprint(position: Array, body: Array, antenna: Antenna, height: float) -> Array:
    """Where the beam's center falls on the ground, (S, 3), from Earth-fixed body axes."""
    to_earth = np.swapaxes(body, -1, -2)
    start = position + rotate(to_earth, antenna.phase_center)
    return intersect(start, rotate(to_earth, antenna.beam), height=height)


def echo_history(
    request: SpotlightRequest,
    orbit: SmoothOrbit,
    plan: SpotlightPlan,
    times: Array,
    profile: AttitudeProfile,
) -> EchoHistory:
    """Echo of the aim point, from the phase center."""
    antenna = Antenna.of(request)
    states = orbit.states(plan.time + times)
    slant_range, doppler = _echo(request, orbit, plan, plan.time + times)
    half = 0.5 * plan.aperture_time
    ends, end_doppler = _echo(request, orbit, plan, plan.time + np.array([-half, 0.0, half]))
    bandwidth = abs(end_doppler[0] - end_doppler[-1])
    body = profile.attitude @ orbit_axes(states)
    fallen = to_geodetic(_footprint(states.position, body, antenna, request.height))
    valid = np.where(profile.pointing == Pointing.SOLVED, 0.0, np.nan)
    return EchoHistory(
        slant_range=slant_range + valid,
        doppler=doppler + valid,
        bandwidth=float(bandwidth),
        resolution=float(request.weighting * plan.ground_speed / bandwidth),
        range_migration=float(np.ptp(ends)),
        latitude=fallen.latitude,
        longitude=fallen.longitude,
    )


def _echo(
    request: SpotlightRequest, orbit: SmoothOrbit, plan: SpotlightPlan, times: Array
) -> tuple[Array, Array]:
    """Slant range [m] and Doppler frequency [Hz] of the aim point, (S,) each.

    The Doppler is that of the phase center, which the turning body carries along.
    """
    states, antenna = orbit.states(times), Antenna.of(request)
    turning = point(orbit, times, plan.rotation_center, antenna)
    body = turning.attitude @ orbit_axes(states)
    to_earth = np.swapaxes(body, -1, -2)
    against_earth = turning.rate_inertial - rotate(body, EARTH_ROTATION)
    carried = rotate(to_earth, np.cross(against_earth, antenna.phase_center))
    path = aim_point(request) - states.position - rotate(to_earth, antenna.phase_center)
    slant_range = np.sqrt(dot(path, path))
    approach = dot(path, states.velocity + carried) / slant_range
    return slant_range, 2.0 / request.wavelength * approach
