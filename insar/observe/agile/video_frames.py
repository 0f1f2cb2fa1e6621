"""How the data of a film are cut into frames: the paper's hyperbola, and the real orbit.

Liang J. et al., "Attitude maneuver strategy of video mode based on agile SAR satellite", Journal of
University of Chinese Academy of Sciences, 2018, eqs (1)-(5). Lengths are along the path, in the
direction of flight; divided by the effective velocity V_r they are durations.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..doppler import doppler_of_direction, doppler_rate
from ..earth import vertical
from ..look import look_at
from ..vectors import dot, safe_arcsin, unit
from .plans import PassPlan
from .smooth_orbit import SmoothOrbit
from .spotlight_plan import aim_point
from .video_request import VideoRequest
from .video_results import FrameModel, Frames

Array = NDArray[np.float64]

_NEWTON_STEPS: Final = 12
_CONVERGED: Final = 1e-9
"""Relative error of the bandwidth at which a frame's duration is exact; rounding is below."""
_SPACING_STEPS: Final = 30
_SPACING_CONVERGED: Final = 1e-11
_SPACING_FOUND: Final = 1e-8
"""Changes of the interval between frames, in durations, at which to stop, and to take it for
found."""
_FARTHEST: Final = 4.0
"""Interval between frames, in durations of one, beyond which none is looked for: frames that
change so fast are no film."""
LONGEST: Final = 2.0
"""Frames that need more data than this many films are out of reach."""


def effective_speed(*, slant_range: float, doppler_rate: float, wavelength: float) -> float:
    """Speed V_r of the hyperbola R² = R_c² + V_r² t² with the range history's curvature.

    Parameters
    ----------
    slant_range : scalar — R_c, at zero Doppler [m].
    doppler_rate : scalar — at zero Doppler; either sign [Hz/s].
    wavelength : scalar [m].

    Returns
    -------
    scalar — √(λ R_c |f_a|/2) [m/s]: between the speeds of the satellite and of its ground track.
    """
    return math.sqrt(0.5 * wavelength * slant_range * abs(doppler_rate))


def frame_length(
    times: ArrayLike,
    *,
    closest_range: float,
    effective_speed: float,
    ground_speed: float,
    wavelength: float,
    resolution: float,
) -> Array:
    """Length of the synthetic aperture of a frame, by the hyperbola.

    Parameters
    ----------
    times : (...) — of the frame's center, since zero Doppler [s].
    closest_range : scalar — R_c [m].
    effective_speed : scalar — V_r [m/s].
    ground_speed : scalar — V_g of the zero-Doppler line over the ground [m/s].
    wavelength, resolution : scalars [m].

    Returns
    -------
    (...) — L = (V_g/V_r) λ (R_c² + V_r²t²)^{3/2}/(2ρR_c²) [m].

    Notes
    -----
    The printed eq. (3) takes ρ = V_r/B. A bandwidth B resolves 1/B in time, in which the
    zero-Doppler line goes V_g/B over the ground: the paper's frames are longer than they need to
    be by V_r/V_g. `ground_speed` = `effective_speed` gives its form. The bandwidth is that of
    eq. (2), for apertures of small angle.

    References
    ----------
    Liang 2018 eqs (2), (3).
    """
    moved = effective_speed * np.asarray(times, dtype=np.float64)
    cubed = (closest_range**2 + moved**2) ** 1.5
    printed = wavelength * cubed / (2.0 * resolution * closest_range**2)
    length: Array = ground_speed / effective_speed * printed
    return length


def overlap(length: ArrayLike, previous: ArrayLike, *, spacing: ArrayLike) -> Array:
    """Share of its data that a frame has in common with the one before.

    Parameters
    ----------
    length, previous : (...) — of the frame and of the one before, about their centers [m] or [s].
    spacing : (...) — between the centers, in the same unit.

    Returns
    -------
    (...) — 0 for none, 1 for a frame within the one before; NaN for NaN.

    Notes
    -----
    Eq. (5) is α = [(L_i + L_{i−1})/2 − T_f V_r]/L_i, with the lengths of eq. (3) put in. It counts
    frames that do not meet as less than none, and where one frame lies within the other it exceeds
    what is common, which is the shorter one: both are bounded here.

    References
    ----------
    Liang 2018 eqs (4), (5).
    """
    now, before, apart = (np.asarray(v, np.float64) for v in (length, previous, spacing))
    common = np.minimum(0.5 * (now + before) - apart, np.minimum(now, before))
    return np.maximum(common, 0.0) / now


def rate_limit(
    times: ArrayLike, *, duration: Callable[[Array], Array], max_overlap: float
) -> Array:
    """Frame rate at which a frame and the one before have a given share of data in common.

    Parameters
    ----------
    times : (...) — of the frame's center [s].
    duration : of the data of a frame, by its center [s].
    max_overlap : scalar — share of the frame's data, 0 to below 1.

    Returns
    -------
    (...) — 1/T_f with T_f = (D(t) + D(t − T_f))/2 − α D(t) [1/s]: the overlap (5) solved for the
    interval between frames. Faster frames share more. NaN where there is no such rate.
    """
    time = np.asarray(times, dtype=np.float64)
    own = duration(time)
    interval, change = (1.0 - max_overlap) * own, np.full_like(own, np.inf)
    for _ in range(_SPACING_STEPS):  # contracts by half the slope of D: a few percent
        if not np.any(change > _SPACING_CONVERGED * own):
            break
        improved = 0.5 * (own + duration(time - interval)) - max_overlap * own
        improved = np.clip(improved, 0.0, _FARTHEST * own)
        change, interval = np.abs(improved - interval), improved
    found = (change <= _SPACING_FOUND * own) & (interval > 0.0)
    rate: Array = 1.0 / np.where(found, interval, np.nan)
    return rate


def cut_frames(request: VideoRequest, orbit: SmoothOrbit, plan: PassPlan) -> Frames:
    """Frames of a film, one at zero Doppler and the others at the frame rate to both sides.

    Parameters
    ----------
    request : resolution, frame rate and duration.
    orbit : over the film and half a frame more at either end.
    plan : of zero Doppler.
    """
    count = math.floor(0.5 * request.duration * request.frame_rate * (1.0 + 1e-12))
    times = np.arange(-count, count + 1) / request.frame_rate
    speed = effective_speed(
        slant_range=plan.slant_range,
        doppler_rate=plan.doppler_rate,
        wavelength=request.wavelength,
    )
    bandwidth = plan.ground_speed / request.resolution

    def hyperbolic(time: Array, ground_speed: float = plan.ground_speed) -> Array:
        return frame_length(
            time,
            closest_range=plan.slant_range,
            effective_speed=speed,
            ground_speed=ground_speed,
            wavelength=request.wavelength,
            resolution=request.resolution,
        )

    def exact(time: Array) -> Array:
        return _exact_duration(request, orbit, plan, time, hyperbolic(time) / speed)

    exactly = _model(times, request, exact, speed)
    return Frames(
        times=times,
        squint=_squint(request, orbit, plan.time + times),
        hyperbolic=_model(times, request, lambda time: hyperbolic(time) / speed, speed),
        exact=exactly,
        printed_length=hyperbolic(times, speed),
        effective_speed=speed,
        bandwidth=bandwidth,
        ground_resolution=_ground_resolution(request, orbit, plan.time + times, exactly.duration),
        complete=np.abs(times) + 0.5 * exactly.duration <= 0.5 * request.duration,
    )


def _model(
    times: Array, request: VideoRequest, duration: Callable[[Array], Array], speed: float
) -> FrameModel:
    """Lengths, overlaps and limits that follow from the duration of frames."""
    interval = 1.0 / request.frame_rate
    own = duration(times)
    return FrameModel(
        duration=own,
        length=own * speed,
        overlap=overlap(own, duration(times - interval), spacing=interval),
        independent_rate=rate_limit(times, duration=duration, max_overlap=0.0),
        rate_limit=rate_limit(times, duration=duration, max_overlap=request.max_overlap),
    )


def _exact_duration(
    request: VideoRequest, orbit: SmoothOrbit, plan: PassPlan, times: Array, guess: Array
) -> Array:
    """Time around each moment in which the aim point's Doppler runs through the bandwidth, (...).

    Newton's method on f(t − D/2) − f(t + D/2) = V_g/ρ (Liang 2018 eq. 1) with the real f.
    """
    target, wavelength = aim_point(request.as_spotlight()), request.wavelength
    bandwidth = plan.ground_speed / request.resolution
    longest = LONGEST * request.duration
    duration = np.minimum(guess, longest)
    error = np.full_like(duration, np.inf)
    for _ in range(_NEWTON_STEPS):
        ends = plan.time + times + np.multiply.outer([-0.5, 0.5], duration)
        states, acceleration = orbit.states(ends), orbit.acceleration(ends)
        line = unit(target - states.position)
        before, after = doppler_of_direction(states, line, wavelength=wavelength)
        slope = doppler_rate(states, target, wavelength=wavelength, acceleration=acceleration)
        error = before - after - bandwidth
        if not np.any(np.abs(error) > _CONVERGED * bandwidth):
            break
        improved = duration + error / (0.5 * (slope[0] + slope[1]))
        duration = np.clip(improved, 0.0, longest)
    visible = look_at(orbit.states(plan.time + times), target).visible
    return np.where(visible & (np.abs(error) <= _CONVERGED * bandwidth), duration, np.nan)


def _squint(request: VideoRequest, orbit: SmoothOrbit, times: Array) -> Array:
    """Angle of the line of sight from the plane of zero Doppler, positive ahead, (F,)."""
    states = orbit.states(times)
    look = look_at(states, aim_point(request.as_spotlight()))
    squint = safe_arcsin(dot(look.line_of_sight, unit(states.velocity)))
    return np.where(look.visible, squint, np.nan)


def _ground_resolution(
    request: VideoRequest, orbit: SmoothOrbit, times: Array, duration: Array
) -> Array:
    """Resolution across the lines of equal Doppler on the ground, (F,).

    A frame measures the ground's spatial frequencies 2û/λ, horizontal part, over its aperture:
    the inverse of how far they move is the resolution in the direction of the move.
    """
    target = aim_point(request.as_spotlight())
    up = vertical(target)
    ends = times + np.multiply.outer([-0.5, 0.5], np.where(np.isfinite(duration), duration, 0.0))
    line = unit(target - orbit.states(ends).position)
    moved = line[1] - line[0]
    level = moved - dot(moved, up)[..., None] * up
    with np.errstate(divide="ignore"):
        resolution = 0.5 * request.wavelength / np.sqrt(dot(level, level))
    return np.where(np.isfinite(duration), resolution, np.nan)
