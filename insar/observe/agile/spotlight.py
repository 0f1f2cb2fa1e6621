"""Spotlight mode of an agile satellite: turn the whole body so that the beam stays on a point.

Han X. et al., "Attitude maneuver strategy of spotlight mode of agile SAR satellite", Spacecraft
Engineering 25(4), 2016. The orbit frame is X forward, Y = −N, Z geocentric nadir; the beam leaves
the antenna's phase center p along b, both constant in body axes.
"""

from __future__ import annotations

import numpy as np

from .smooth_orbit import smooth_orbit
from .spotlight_attitude import Antenna, attitude_profile, iterate
from .spotlight_beam import aim_error, echo_history
from .spotlight_plan import aim_point, plan_spotlight
from .spotlight_results import SpotlightRequest, SpotlightResult
from .spotlight_warnings import warnings_of
from .staring import StaringScene, staring_scene


def spotlight(request: SpotlightRequest, samples: int = 1001) -> SpotlightResult:
    """Attitude of an agile satellite that keeps its beam on a point, and what the radar sees.

    Parameters
    ----------
    request : aim point, orbit, antenna and limits.
    samples : over the duration, both ends included; an odd number has zero Doppler among them.

    Returns
    -------
    SpotlightResult — NaN, with the reason, where the beam can't be pointed.

    Raises
    ------
    ValueError
        If the aim point is not imaged in the searched time, or the orbit is not known for all of
        the imaging: the message says why, and the remedy.
    """
    if samples < 2:
        raise ValueError(f"samples = {samples!r} must be at least 2")
    plan = plan_spotlight(request)
    duration = plan.imaging_time if request.duration is None else request.duration
    half = 0.5 * max(duration, plan.aperture_time)
    orbit = smooth_orbit(request.trajectory, plan.time - half, plan.time + half)
    times = np.linspace(-0.5 * duration, 0.5 * duration, samples)
    antenna = Antenna.of(request)
    profile = attitude_profile(
        orbit,
        plan.time + times,
        plan.rotation_center,
        antenna,
        place=aim_point(request),
        agility=request.agility,
    )
    iteration = iterate(
        orbit,
        plan.time + times,
        plan.rotation_center,
        antenna,
        closed_form=profile.attitude,
    )
    result = SpotlightResult(
        request=request,
        plan=plan,
        times=times,
        profile=profile,
        iteration=iteration,
        aim_error=aim_error(request, orbit, plan, times, profile, iteration),
        history=echo_history(request, orbit, plan, times, profile),
        orbit_misfit=orbit.misfit,
        warnings=(),
    )
    return warnings_of(result)


def spotlight_scene(result: SpotlightResult, segments: int = 11) -> StaringScene:
    """Scene of a formation that watches the aim point over the imaging time.

    Parameters
    ----------
    result : of `spotlight`.
    segments : moments, equally spaced over the imaging time, both ends included.

    Returns
    -------
    StaringScene — every segment is the aim point; the line of sight turns from ahead to behind.

    Raises
    ------
    ValueError
        If the aim point does not see the satellite during all of it.
    """
    plan, request = result.plan, result.request
    return staring_scene(
        request,
        plan,
        duration=plan.imaging_time,
        segments=segments,
    )
