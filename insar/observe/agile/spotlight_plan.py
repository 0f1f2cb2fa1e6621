"""When an aim point is imaged in spotlight mode, and for how long."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States, Trajectory

from ...scene import LookSide
from ..doppler import doppler_rate
from ..earth import from_geodetic, to_geodetic, vertical
from ..look import look_at, zero_doppler_plane
from ..scenes.crossings import find_crossings, zero_doppler
from ..scenes.passes import Direction
from ..scenes.windows import Window, moment, search_window, utc
from ..vectors import dot
from .plans import PassPlan, SpotlightPlan
from .smooth_orbit import smooth_orbit
from .spotlight_aperture import solve_aperture
from .spotlight_results import SpotlightRequest

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def plan_pass(request: SpotlightRequest) -> PassPlan:
    """Find the moment of zero Doppler.

    Parameters
    ----------
    request : aim point and orbit; its resolution does not matter.

    Raises
    ------
    ValueError
        If the aim point is not imaged in the searched time: the message says why, and the remedy.

    References
    ----------
    Han 2016 eqs (5), (6).
    """
    trajectory, target = request.trajectory, aim_point(request)
    passages = _passages(request, target)
    time = float(passages.time[passages.wanted][request.number - 1])
    orbit = smooth_orbit(trajectory, time, time)
    states, acceleration = orbit.states(time), orbit.acceleration(time)
    look = look_at(states, target)
    rate = doppler_rate(states, target, wavelength=request.wavelength, acceleration=acceleration)
    speed = ground_speed(states, acceleration, target)
    if not (speed > 0.0 and rate < 0.0):
        raise ValueError(
            f"the line of zero Doppler moves over the aim point at {float(speed):.4g} m/s with a "
            f"Doppler rate of {float(rate):.4g} Hz/s: the satellite falls behind the Earth's "
            "rotation there, and no aperture forms as in low orbit; choose a lower orbit or "
            "another pass"
        )
    return PassPlan(
        time=time,
        epoch=moment(trajectory, time),
        passes=int(np.count_nonzero(passages.wanted)),
        number=request.number,
        side=_sides(states, look.line_of_sight),
        ascending=bool(states.velocity[2] > 0.0),
        slant_range=float(look.slant_range),
        look_angle=float(look.look_angle),
        incidence=float(look.incidence),
        azimuth=float(look.azimuth),
        doppler_rate=float(rate),
        ground_speed=float(speed),
    )


def plan_spotlight(request: SpotlightRequest) -> SpotlightPlan:
    """Find the moment of zero Doppler and the time that the resolution needs.

    Parameters
    ----------
    request : aim point, orbit, resolution.

    Returns
    -------
    SpotlightPlan.

    Raises
    ------
    ValueError
        If the aim point is not imaged in the searched time, or the resolution is out of reach:
        the message says why, and the remedy.

    References
    ----------
    Han 2016 eqs (4)-(6): its time is that of first order.
    """
    plan = plan_pass(request)
    place = aim_point(request)
    center = _rotation_center(request, plan, place)
    first_order = request.weighting * plan.ground_speed / (request.resolution * -plan.doppler_rate)
    aperture = solve_aperture(request, plan, place, rotation_center=center, first_order=first_order)
    # A point of the scene is seen for the aperture time while a beam as wide as that takes slides
    # over it; both ends of the scene are seen after this much more.
    sliding = request.sliding_factor
    extra = request.scene_length / (sliding * plan.ground_speed) if sliding > 0.0 else 0.0
    return SpotlightPlan(
        **{each.name: getattr(plan, each.name) for each in dataclasses.fields(plan)},
        aperture_time=aperture,
        first_order_time=first_order,
        imaging_time=aperture + extra,
        rotation_center=center,
    )


def _rotation_center(request: SpotlightRequest, plan: PassPlan, place: Array) -> Array:
    """Point at which the beam looks all the time, (3,)."""
    states = request.trajectory.earth_fixed(plan.time)
    path = place - states.position
    # About a center at r/(1 − q) the beam sweeps the ground, across the zero-Doppler line, at
    # q v²/v_ground, and the line itself at q = (v² − (x − r)·a)/v² = λr|f_a|/2v².
    share = 0.5 * request.wavelength * -plan.doppler_rate * plan.slant_range
    share = float(share / dot(states.velocity, states.velocity))
    center: Array = place + path * (1.0 / (1.0 - request.sliding_factor * share) - 1.0)
    return center


def aim_point(request: SpotlightRequest) -> Array:
    """Earth-fixed position of the aim point, (3,) [m]."""
    return from_geodetic(
        latitude=request.latitude, longitude=request.longitude, height=request.height
    )


def ground_speed(states: States, acceleration: Array, target: Array) -> Array:
    """Speed of the zero-Doppler line over the ground at a target on it, across the line.

    Parameters
    ----------
    states : of the satellite, Earth-fixed, (..., 3) each [m, m/s].
    acceleration : (..., 3) — of its Earth-fixed coordinates [m/s²].
    target : (..., 3) — at zero Doppler [m].

    Returns
    -------
    (...) — V_g [m/s].

    Notes
    -----
    The line is where g(x, t) = (x − r)·v vanishes on the ground. It moves by −ġ/|∇g|, with
    ġ = (x − r)·a − v² and ∇g the part of v along the ground. A target displaced by δ across the
    line is seen δ/V_g later, so that V_g/B is the resolution on the ground.
    """
    up = vertical(target)
    along_ground = states.velocity - dot(states.velocity, up)[..., None] * up
    passing = dot(states.velocity, states.velocity) - dot(target - states.position, acceleration)
    speed: Array = passing / np.sqrt(dot(along_ground, along_ground))
    return speed


class _Passages(NamedTuple):
    """Moments of zero Doppler in view of the aim point, and what hinders an image; C of them."""

    time: Array
    incidence: Array
    in_reach: Mask
    on_side: Mask
    heading: Mask

    @property
    def wanted(self) -> Mask:
        """Those that may be imaged."""
        return self.in_reach & self.on_side & self.heading

    def where(self, chosen: Mask) -> _Passages:
        """Some of them, by a mask (C,)."""
        return _Passages(
            self.time[chosen],
            self.incidence[chosen],
            self.in_reach[chosen],
            self.on_side[chosen],
            self.heading[chosen],
        )


def _passages(request: SpotlightRequest, target: Array) -> _Passages:
    """Passages of the aim point, as many as are asked for; or say why there are not."""
    window = search_window(request.trajectory, request.start, request.stop)
    time = find_crossings(request.trajectory, target[None], zero_doppler, window).time
    states = request.trajectory.earth_fixed(time)
    look = look_at(states, target)
    side = np.array([_sides(*each) for each in _each(states, look.line_of_sight)])
    found = _Passages(
        time=time,
        incidence=look.incidence,
        in_reach=(look.incidence >= request.near_incidence)
        & (look.incidence <= request.far_incidence),
        on_side=np.ones_like(look.visible) if request.side is None else side == request.side,
        heading=request.direction.accepts(states.velocity[:, 2] > 0.0),
    )
    visible = found.where(look.visible)
    count = np.count_nonzero(visible.wanted)
    if count == 0:
        raise ValueError(_never(request, visible, window))
    if request.number > count:
        raise ValueError(
            f"number = {request.number}: the aim point can be imaged on {count} "
            f"pass{'' if count == 1 else 'es'} in the searched time; take "
            f"{'it' if count == 1 else 'one of them'}, or {window.longer}"
        )
    return visible


def _each(states: States, line: Array) -> list[tuple[States, Array]]:
    return [
        (States(position, velocity), each)
        for position, velocity, each in zip(*states, line, strict=True)
    ]


def _sides(states: States, line: Array) -> LookSide:
    """Side of the Earth-fixed velocity on which a line of sight lies."""
    left = zero_doppler_plane(states, side=LookSide.LEFT).aside
    return LookSide.LEFT if dot(line, left) > 0.0 else LookSide.RIGHT


def _never(request: SpotlightRequest, found: _Passages, window: Window) -> str:
    """Message for an aim point that is not imaged: what was searched, why in vain, the remedy."""
    trajectory = request.trajectory
    start = (
        "the aim point is not imaged from "
        f"{utc(trajectory, window.start)} to {utc(trajectory, window.stop)}: "
    )
    if len(found.time) == 0:
        return start + _out_of_view(trajectory, window)
    in_reach = np.count_nonzero(found.in_reach)
    if in_reach == 0:
        middle = 0.5 * (request.near_incidence + request.far_incidence)
        nearest = int(np.argmin(np.abs(found.incidence - middle)))
        value = found.incidence[nearest]
        why = (
            "too near to the satellite's nadir, where range does not resolve the ground"
            if value < request.near_incidence
            else "too near to the horizon"
        )
        return start + (
            f"the nearest of {len(found.time)} pass{'' if len(found.time) == 1 else 'es'} sees it "
            f"at incidence {_degrees(value)}, "
            f"outside {_degrees(request.near_incidence)} to {_degrees(request.far_incidence)}, "
            f"{why}; {window.longer}, or allow other incidences"
        )
    if np.any(found.in_reach & found.on_side):
        heading = "southward" if request.direction is Direction.ASCENDING else "northward"
        return start + f"it is in reach only while the satellite flies {heading}; take either"
    wanted = LookSide(request.side or LookSide.LEFT)
    other = LookSide(-wanted).name.lower()
    times = "once" if in_reach == 1 else f"{in_reach} times"
    return start + (
        f"it is in reach {times}, but on the {other} of the flight direction; "
        f"look {other}, to either side, or {window.longer}"
    )


def _out_of_view(trajectory: Trajectory, window: Window) -> str:
    states = trajectory.earth_fixed(np.linspace(window.start, window.stop, 2000))
    reach = float(np.max(np.abs(to_geodetic(states.position).latitude)))
    return (
        "it never sees the satellite above its horizon at zero Doppler; the satellite itself "
        f"reaches latitudes of ±{_degrees(reach)}; {window.longer}, or change the orbit"
    )


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.2f}°"
