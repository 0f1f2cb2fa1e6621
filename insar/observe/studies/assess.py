"""What steering laws do over the samples of an orbit: attitude, rates and Doppler."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from formation import States, mean_elements_at

from ..attitude import angular_rates
from ..doppler import doppler_centroid, doppler_of_direction, pointing_sensitivity
from ..earth import intersect, meets, to_geodetic
from ..frames import orbit_axes, orbit_geometry
from ..look import look_at
from ..steering import Law, Steering, off_boresight, steer
from .results import CaseResult, LawCurves, SteeringCase

Array = NDArray[np.float64]


def assess_case(case: SteeringCase) -> CaseResult:
    """Attitude, rates, residual Doppler and pointing of every law of a case.

    Parameters
    ----------
    case : orbit, samples, boresight and laws, on the WGS84 ellipsoid.

    Returns
    -------
    CaseResult — NaN, with the reason, where a law has no solution.

    Raises
    ------
    ValueError
        If there are fewer than three samples, they do not increase, or one lies outside the
        trajectory's span.
    """
    states = case.trajectory.earth_fixed(case.times)
    point = to_geodetic(states.position)
    mean = mean_elements_at(case.trajectory, float(case.times[0]))
    return CaseResult(
        case=case,
        argument_of_latitude=_unwrapped(orbit_geometry(states).argument_of_latitude),
        latitude=point.latitude,
        longitude=point.longitude,
        altitude=point.height,
        semi_major_axis=float(mean.semi_major_axis),
        eccentricity=float(mean.eccentricity),
        inclination=float(mean.inclination),
        curves=tuple(_law_curves(law, case, states) for law in case.laws),
    )


def _law_curves(law: Law, case: SteeringCase, states: States) -> LawCurves:
    """One law over the samples of a case."""
    steering = steer(law, states, boresight=case.boresight, side=case.side)
    target = intersect(states.position, steering.boresight)
    look = look_at(states, target)
    rates = angular_rates(case.times, steering.attitude, orbit_axes=orbit_axes(states))
    return LawCurves(
        law=law,
        yaw=steering.yaw,
        pitch=steering.pitch,
        roll=steering.roll,
        rate_orbit=rates.orbit,
        rate_inertial=rates.inertial,
        off_nadir=steering.off_nadir,
        incidence=look.incidence,
        slant_range=look.slant_range,
        residual_doppler=doppler_centroid(states, target, wavelength=case.wavelength),
        swath_doppler=swath_doppler(
            states, steering, case.swath_offsets, wavelength=case.wavelength
        ),
        pointing_sensitivity=pointing_sensitivity(
            states, steering.boresight, wavelength=case.wavelength
        ),
        steering_angle=np.abs(steering.yaw) + np.abs(steering.pitch) + np.abs(steering.roll),
        outcome=steering.outcome,
    )


def swath_doppler(
    states: States, steering: Steering, offsets: Array, *, wavelength: float
) -> Array:
    """Doppler centroid over the swath, at elevations off the boresight.

    Parameters
    ----------
    states : Earth-fixed, (..., 3) each [m, m/s].
    steering : of the same states, (...).
    offsets : (E,) — positive away from nadir [rad].
    wavelength : scalar [m].

    Returns
    -------
    (..., E) — [Hz]; NaN where the line of sight misses the Earth.
    """
    lines = off_boresight(steering, offsets)
    each = States(states.position[..., None, :], states.velocity[..., None, :])
    doppler = doppler_of_direction(each, lines, wavelength=wavelength)
    return np.where(meets(each.position, lines), doppler, np.nan)


def _unwrapped(angle: Array) -> Array:
    """A growing angle without its jumps, from [0, 2π) on."""
    whole: Array = np.unwrap(angle)
    shifted: Array = whole - 2.0 * np.pi * np.floor(whole[0] / (2.0 * np.pi))
    return shifted
