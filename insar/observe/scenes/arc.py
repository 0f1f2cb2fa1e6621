"""Scenes along an orbit: what the boresight sweeps over a band of latitudes or of the orbit."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import States, Trajectory

from ...scene import LookSide
from ..boresight import Boresight
from ..earth import intersect, to_geodetic
from ..frames import orbit_geometry
from ..steering import Law
from .assembly import Recording, record
from .crossings import refine_root, sample_blocks, sign_changes
from .observation import Observation, Reference
from .passes import FAR_INCIDENCE, NEAR_INCIDENCE, Direction, Strip
from .targets import Targets
from .windows import Window, search_window, utc

Array = NDArray[np.float64]
Quantity = Callable[[States], Array]

STEPS_PER_REVOLUTION: Final = 240
_ROUNDING = 1e-9
"""Forgiven in a whole turn of the argument of latitude [rad]."""
_AT_THE_START = 1e-5
"""Argument of latitude by which polar motion and rounding displace a satellite at its epoch, with a
margin of six [rad]; 70 m in low orbit."""
_SHORTEST = 1e-3
"""Duration below which a stretch of the orbit is rounding [s]."""


def observe_arc(
    trajectory: Trajectory,
    *,
    wavelength: float,
    side: LookSide,
    boresight: Boresight,
    stop: float,
    start: float = 0.0,
    latitude: tuple[float, float] | None = None,
    argument_of_latitude: tuple[float, float] | None = None,
    segments: int = 10,
    law: Law = Law.YAW_PITCH,
    near_incidence: float = NEAR_INCIDENCE,
    far_incidence: float = FAR_INCIDENCE,
    reference: Reference = Reference.ZERO_DOPPLER,
    direction: Direction = Direction.EITHER,
    slope: float = 0.0,
) -> Observation:
    """Observe what the boresight sweeps along a stretch of the orbit.

    Parameters
    ----------
    trajectory, wavelength, side, start, stop, law, reference, slope : as in `observe`.
    boresight : what is held; its points on the ellipsoid are the segments.
    latitude : (one, other) — geodetic, of the boresight's points, in either order [rad]; or
    argument_of_latitude : (from, to) — of the satellite, from its ascending node, in order and at
        most one turn apart [rad].
    segments : how many, evenly in time; the first and last are the ends of the stretch, a single
        one is its middle.
    near_incidence, far_incidence : scalars — edges of the strip, for the map [rad].
    direction : in which the satellite flies over a band of latitudes.

    Returns
    -------
    Observation — of the first such stretch that the search holds whole; its `passes` counts all.

    Raises
    ------
    ValueError
        If not exactly one of `latitude` and `argument_of_latitude` is given, they are out of
        order, the search holds no whole stretch (the message says what is reached), or the
        boresight does not meet the Earth on it.
    """
    window = search_window(trajectory, start, stop)
    strip = Strip(
        law=law,
        boresight=boresight,
        side=side,
        near_incidence=near_incidence,
        far_incidence=far_incidence,
    )
    if segments < 1:
        raise ValueError(f"segments = {segments!r} must be at least 1")
    if latitude is not None and argument_of_latitude is None:
        arcs = _latitude_arcs(trajectory, strip, window, latitude, direction)
    elif argument_of_latitude is not None and latitude is None:
        _check_arguments(argument_of_latitude, direction)
        arcs = _orbit_arcs(trajectory, window, argument_of_latitude)
    else:
        raise ValueError("give exactly one of latitude and argument_of_latitude")
    times = _spread(arcs[0], segments)
    return record(
        Recording(
            trajectory=trajectory,
            strip=strip,
            wavelength=wavelength,
            slope=slope,
            reference=reference,
            window=window,
        ),
        _swept(trajectory, strip, times),
        times,
        passes=len(arcs),
        number=1,
    )


class _Arc(NamedTuple):
    """Stretch of the orbit between two times [s]."""

    start: float
    stop: float


def _spread(arc: _Arc, segments: int) -> Array:
    if segments == 1:
        return np.array([0.5 * (arc.start + arc.stop)])
    return np.linspace(arc.start, arc.stop, segments)


def _swept(trajectory: Trajectory, strip: Strip, times: Array) -> Targets:
    """Points of the boresight on the ellipsoid."""
    states = trajectory.earth_fixed(times)
    point = to_geodetic(intersect(states.position, strip.steer(states).boresight))
    lost = np.isnan(point.latitude)
    if np.any(lost):
        first = utc(trajectory, times[int(np.argmax(lost))])
        raise ValueError(
            f"the boresight has no point on the Earth in {np.count_nonzero(lost)} of {len(times)} "
            f"segments, the first at {first}; choose a smaller look angle or incidence, or another "
            "steering law"
        )
    # On the ellipsoid by construction; the height found is rounding.
    return Targets.from_points(latitude=point.latitude, longitude=point.longitude)


def _latitude_arcs(
    trajectory: Trajectory,
    strip: Strip,
    window: Window,
    latitude: tuple[float, float],
    direction: Direction,
) -> list[_Arc]:
    """Stretches on which the boresight sweeps a band of latitudes from edge to edge."""
    low, high = sorted(latitude)
    if not -math.pi / 2 <= low < high <= math.pi / 2:
        raise ValueError(
            f"latitude = {latitude!r} rad must be two different values from −π/2 to π/2; "
            "give radians"
        )

    def swept(states: States) -> Array:
        return to_geodetic(intersect(states.position, strip.steer(states).boresight)).latitude

    lower, upper = (_passages(trajectory, swept, edge, window) for edge in (low, high))
    time = np.concatenate([lower, upper])
    edge = np.repeat([0, 1], [len(lower), len(upper)])
    order = np.argsort(time, kind="stable")
    time, edge = time[order], edge[order]
    # From one edge straight to the other: between them the boresight does not leave the band.
    whole = np.flatnonzero(edge[:-1] != edge[1:])
    northward = trajectory.earth_fixed(0.5 * (time[whole] + time[whole + 1])).velocity[..., 2] > 0.0
    arcs = [_Arc(time[i], time[i + 1]) for i in whole[direction.accepts(northward)]]
    if not arcs:
        reached = _reached(trajectory, swept, window)
        raise ValueError(
            f"the boresight does not sweep latitudes {math.degrees(low):.2f}° to "
            f"{math.degrees(high):.2f}° from edge to edge (direction: {direction.value}) from "
            f"{utc(trajectory, window.start)} to {utc(trajectory, window.stop)}; {reached}: "
            f"{window.longer}, or choose a band within"
        )
    return arcs


def _passages(trajectory: Trajectory, quantity: Quantity, value: float, window: Window) -> Array:
    """Times at which a quantity of the states passes a value [s]."""

    def excess(times: Array) -> Array:
        return quantity(trajectory.earth_fixed(times)) - value

    low, high = [], []
    for times in sample_blocks(window, STEPS_PER_REVOLUTION):
        step = np.flatnonzero(sign_changes(excess(times)))
        low.append(times[step])
        high.append(times[step + 1])
    return refine_root(excess, np.concatenate(low), np.concatenate(high))


def _reached(trajectory: Trajectory, swept: Quantity, window: Window) -> str:
    values = np.concatenate(
        [
            swept(trajectory.earth_fixed(times))
            for times in sample_blocks(window, STEPS_PER_REVOLUTION)
        ]
    )
    if np.all(np.isnan(values)):
        return "it never meets the Earth"
    south, north = np.degrees([np.nanmin(values), np.nanmax(values)])
    return f"it reaches {south:.2f}° to {north:.2f}°"


def _check_arguments(argument: tuple[float, float], direction: Direction) -> None:
    if not 0.0 < argument[1] - argument[0] <= math.tau + _ROUNDING:
        raise ValueError(
            f"argument_of_latitude = {argument!r} rad must be in order and at most 2π apart; add "
            "2π to the second to pass the ascending node"
        )
    if direction is not Direction.EITHER:
        raise ValueError(
            f"direction = {direction.value!r}: an argument of latitude already says where the "
            "satellite ascends; leave the direction out"
        )


def _orbit_arcs(
    trajectory: Trajectory, window: Window, argument: tuple[float, float]
) -> list[_Arc]:
    """Stretches of the orbit between two arguments of latitude."""
    first, last = (_upward_passages(trajectory, window, value) for value in argument)
    first = _with_start(trajectory, window, argument[0], first)
    # A whole turn begins and ends at the same argument, found twice to within rounding.
    following = np.searchsorted(last, first + _SHORTEST)
    arcs = [
        _Arc(start, last[index])
        for start, index in zip(first, following, strict=True)
        if index < len(last)
    ]
    if not arcs:
        degrees = [math.degrees(value) for value in argument]
        raise ValueError(
            f"the satellite does not fly from argument of latitude {degrees[0]:.2f}° to "
            f"{degrees[1]:.2f}° between {utc(trajectory, window.start)} and "
            f"{utc(trajectory, window.stop)}; {window.longer}: a revolution takes "
            f"{window.period / 60.0:.1f} min"
        )
    return arcs


def _with_start(trajectory: Trajectory, window: Window, value: float, times: Array) -> Array:
    """Times of an argument of latitude (C,), and the start of the window if that is one of them.

    A satellite that is put there at the epoch is there but for rounding and polar motion, before
    or after the first sample of the search.
    """
    states = trajectory.earth_fixed(window.start)
    past = float(orbit_geometry(states).argument_of_latitude) - value
    if abs(math.remainder(past, math.tau)) > _AT_THE_START or np.any(
        times - window.start < window.period / 2.0
    ):
        return times
    return np.concatenate([[window.start], times])


def _upward_passages(trajectory: Trajectory, window: Window, value: float) -> Array:
    """Times at which the argument of latitude is a value, whatever the turn [s]."""

    def past(states: States) -> Array:
        return orbit_geometry(states).argument_of_latitude - value

    times = _passages(trajectory, lambda states: np.sin(past(states)), 0.0, window)
    upward = np.cos(past(trajectory.earth_fixed(times))) > 0.0
    return times[upward]
