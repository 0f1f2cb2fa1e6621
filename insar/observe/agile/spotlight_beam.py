"""What the beam of a spotlight imaging does: where it falls, and what the radar sees."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..earth import intersect, to_geodetic
from ..frames import orbit_axes
from ..vectors import dot, rotate
from .plans import SpotlightPlan
from .profiles import Profile
from .smooth_orbit import SmoothOrbit
from .spotlight_attitude import Antenna, point
from .spotlight_echo import Echo, echo
from .spotlight_plan import aim_point
from .spotlight_results import (
    AimError,
    EchoHistory,
    Iteration,
    Pointing,
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
    profile: Profile,
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
    valid = np.where(profile.outcome == Pointing.SOLVED, 0.0, np.nan)
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
    profile: Profile,
) -> EchoHistory:
    """Echo of the aim point, from the phase center."""
    antenna = Antenna.of(request)

    def seen(moments: Array) -> Echo:
        return echo(
            orbit,
            plan.time + moments,
            aim_point(request),
            rotation_center=plan.rotation_center,
            antenna=antenna,
            wavelength=request.wavelength,
        )

    over, ends = seen(times), seen(0.5 * plan.aperture_time * np.array([-1.0, 0.0, 1.0]))
    early = seen(0.5 * plan.first_order_time * np.array([-1.0, 1.0]))
    swept = request.weighting * plan.ground_speed
    bandwidth, first_order = (float(e.doppler[0] - e.doppler[-1]) for e in (ends, early))
    states = orbit.states(plan.time + times)
    body = profile.attitude @ orbit_axes(states)
    fallen = to_geodetic(_footprint(states.position, body, antenna, request.height))
    valid = np.where(profile.outcome == Pointing.SOLVED, 0.0, np.nan)
    return EchoHistory(
        slant_range=over.slant_range + valid,
        doppler=over.doppler + valid,
        bandwidth=bandwidth,
        resolution=swept / bandwidth,
        first_order_bandwidth=first_order,
        first_order_resolution=swept / first_order,
        range_migration=float(np.ptp(ends.slant_range)),
        latitude=fallen.latitude,
        longitude=fallen.longitude,
    )
