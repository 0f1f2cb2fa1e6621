"""How much of the Doppler the simplified yaw law compensates (Meng 2003).

Doppler is given as a range rate, λf/2, positive where satellite and target approach each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from formation import States
from formation.elements import Elements, states_from_elements
from formation.j2 import osculating_states

from ...scene import LookSide
from ..boresight import FixedLook
from ..doppler import doppler_of_direction
from ..earth import WGS84, Ellipsoid
from ..frames import orbit_geometry, rotation_velocity, rtn_axes
from ..simplified import simplified_broadside_doppler
from ..steering import Law, steer
from ..vectors import dot, unit
from .results import Compensation, CompensationCurve, Effect

Array = NDArray[np.float64]

_RANGE_RATE = 2.0
"""Wavelength at which the Doppler frequency in Hz is the range rate in m/s."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CompensationRequest:
    """Orbit and unsteered radar whose exact and simplified Doppler are compared.

    Parameters
    ----------
    semi_major_axis, inclination : scalars, mean elements [m, rad].
    look_angle : scalar — of the beam, which looks across the orbit plane [rad].
    side : where the radar looks.
    eccentricity : scalar — where the effects are shown one by one.
    arguments_of_perigee : for which they are shown; the sweep takes the first [rad].
    eccentricities : (C,) — of the sweep, two or more, increasing.
    samples : of one revolution, evenly in the argument of latitude.

    Raises
    ------
    ValueError
        If the look angle is out of bounds, an eccentricity is not in [0, 1), the sweep does not
        increase, there is no argument of perigee, or the samples are too few.
    """

    semi_major_axis: float
    inclination: float
    look_angle: float
    side: LookSide
    eccentricity: float
    arguments_of_perigee: tuple[float, ...]
    eccentricities: Array
    samples: int = 721

    def __post_init__(self) -> None:
        FixedLook(self.look_angle)  # checks it
        sweep = np.atleast_1d(np.asarray(self.eccentricities, dtype=np.float64))
        object.__setattr__(self, "eccentricities", sweep)
        for value in (self.eccentricity, *sweep):
            if not 0.0 <= value < 1.0:
                raise ValueError(f"eccentricity = {float(value)!r} must lie in [0, 1)")
        if sweep.size < 2 or not np.all(np.diff(sweep) > 0.0):
            raise ValueError("eccentricities must be two or more and increase; sort them")
        if not self.arguments_of_perigee:
            raise ValueError("arguments_of_perigee is empty; give one or more")
        if self.samples < 8:
            raise ValueError(f"samples = {self.samples!r} must be 8 or more; 721 resolve an orbit")


def compensate(request: CompensationRequest) -> Compensation:
    """Compare the exact and the simplified Doppler of an unsteered radar over one revolution.

    Parameters
    ----------
    request : orbit and radar.

    Returns
    -------
    Compensation — the Earth's shape and J2 on the circular orbit, once each; the eccentricity, and
    all effects together, for each argument of perigee; and the sweep of the eccentricity alone.

    Notes
    -----
    A beam at a fixed look angle has f = (2/λ) û·v, whatever the figure of the Earth that it meets:
    the true effect of `Effect.EARTH_SHAPE` is zero. Its curve therefore takes the target as
    Meng 2003 does, eq. (2) (see `target_at_depth`), and `Effect.ALL` the beam at its look angle.
    """
    perigees, e = request.arguments_of_perigee, request.eccentricity
    curves = [_curve(request, Effect.EARTH_SHAPE), _curve(request, Effect.J2)]
    for effect in (Effect.ECCENTRICITY, Effect.ALL):
        curves += [_curve(request, effect, eccentricity=e, perigee=each) for each in perigees]
    sweep = [
        _curve(request, Effect.ECCENTRICITY, eccentricity=float(each), perigee=perigees[0])
        for each in request.eccentricities
    ]
    return Compensation(
        semi_major_axis=request.semi_major_axis,
        inclination=request.inclination,
        look_angle=request.look_angle,
        side=request.side,
        curves=tuple(curves),
        eccentricities=request.eccentricities,
        sweep=np.array([curve.compensation for curve in sweep]),
        sweep_rms=np.array([curve.compensation_rms for curve in sweep]),
        sweep_deviation=np.array([deviation(curve) for curve in sweep]),
    )


def deviation(curve: CompensationCurve) -> float:
    """Largest difference of the exact and the simplified Doppler of a curve [m/s]."""
    return float(np.abs(curve.exact - curve.simplified).max())


def target_at_depth(
    states: States,
    *,
    look_angle: float,
    side: LookSide,
    ellipsoid: Ellipsoid = WGS84,
) -> Array:
    """Target on the ellipsoid at the depth below the satellite that a sphere would give.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    look_angle : scalar — at which the beam would meet the sphere [rad].
    side : where the radar looks.
    ellipsoid : the Earth's figure.

    Returns
    -------
    (..., 3) — in the plane across the orbit, Earth-fixed [m].

    Notes
    -----
    Meng 2003 eq. (2): the projection P of the target on the satellite's vertical comes from the
    triangle satellite, target, center, in which both ends of the ground arc have one radius: here
    that of the ellipsoid below the satellite, which the paper does not say. The target is then
    moved at this P until it is on the ellipsoid. So its look angle is not quite the stated one.
    With one radius for the whole orbit the ellipsoid would change the Doppler by more than 80 m/s,
    not by the 2 m/s of the paper, and there would be no target over the poles.
    """
    axes = rtn_axes(states)
    radial, aside = axes[..., 0, :], int(side) * axes[..., 2, :]
    orbit_radius = dot(states.position, radial)
    earth_radius = 1.0 / np.sqrt((radial**2 / ellipsoid.squared_axes).sum(axis=-1))
    across = orbit_radius * np.sin(look_angle)
    slant_range = orbit_radius * np.cos(look_angle) - np.sqrt(earth_radius**2 - across**2)
    depth = (orbit_radius - slant_range * np.cos(look_angle))[..., None] * radial  # P
    # |depth + y aside| = 1 in the metric of the ellipsoid.
    scaled = aside / ellipsoid.squared_axes
    a, b = dot(scaled, aside), dot(scaled, depth)
    c = dot(depth / ellipsoid.squared_axes, depth) - 1.0
    offset = (np.sqrt(b**2 - a * c) - b) / a
    return np.asarray(depth + offset[..., None] * aside)


def _curve(
    request: CompensationRequest,
    effect: Effect,
    *,
    eccentricity: float = 0.0,
    perigee: float = 0.0,
) -> CompensationCurve:
    """Exact and simplified Doppler with one effect, or all."""
    states = _revolution(
        request, eccentricity, perigee, perturbed=effect in (Effect.J2, Effect.ALL)
    )
    exact = doppler_of_direction(
        states, _line_of_sight(request, states, effect), wavelength=_RANGE_RATE
    )
    latitude = np.unwrap(orbit_geometry(states).argument_of_latitude)
    simplified = simplified_broadside_doppler(
        radius=request.semi_major_axis,
        inclination=request.inclination,
        argument_of_latitude=latitude,
        look_angle=request.look_angle,
        side=request.side,
        wavelength=_RANGE_RATE,
    )
    left = exact - simplified
    return CompensationCurve(
        effect=effect,
        eccentricity=eccentricity,
        argument_of_perigee=perigee,
        argument_of_latitude=latitude,
        exact=exact,
        simplified=simplified,
        compensation=float(1.0 - np.abs(left).max() / np.abs(exact).max()),
        compensation_rms=float(1.0 - np.sqrt(np.mean(left**2) / np.mean(exact**2))),
    )


def _revolution(
    request: CompensationRequest, eccentricity: float, perigee: float, *, perturbed: bool
) -> States:
    """One revolution from the ascending node, evenly in the argument of latitude, Earth-fixed.

    The mean elements stay: in one revolution J2 turns the perigee by 0.2°.
    """
    e, anomaly = eccentricity, np.linspace(0.0, 2.0 * np.pi, request.samples) - perigee
    ratio = np.sqrt((1.0 - e) / (1.0 + e))
    eccentric = 2.0 * np.arctan2(ratio * np.sin(anomaly / 2.0), np.cos(anomaly / 2.0))
    elements = Elements(
        semi_major_axis=request.semi_major_axis,
        eccentricity=e,
        inclination=request.inclination,
        raan=0.0,
        argument_of_perigee=perigee,
        mean_anomaly=eccentric - e * np.sin(eccentric),
    )
    inertial = osculating_states(elements) if perturbed else states_from_elements(elements)
    # The Greenwich meridian is on the x axis all the time: the Earth is symmetric about its axis.
    velocity = inertial.velocity - rotation_velocity(inertial.position)
    return States(inertial.position, velocity)


def _line_of_sight(request: CompensationRequest, states: States, effect: Effect) -> Array:
    """Unsteered beam; towards the target of Meng's eq. (2) for the Earth's shape."""
    if effect is Effect.EARTH_SHAPE:
        target = target_at_depth(states, look_angle=request.look_angle, side=request.side)
        return unit(target - states.position)
    beam = steer(Law.NONE, states, boresight=FixedLook(request.look_angle), side=request.side)
    return beam.boresight
