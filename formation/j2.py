"""Motion about an oblate Earth: mean and osculating elements, and the drift of the mean ones.

Mean elements are Brouwer's: the osculating ones freed from the terms that repeat with each
revolution. Those terms, first order in J2, come from Brouwer's generating function

    W = K Θ [(3c² − 1)/2 (f − M + e sin f) + ¾ s² (sin 2θ + e sin(2θ − f) + ⅓ e sin(2θ + f))],

K = J2 R²/2p², c and s the cosine and sine of the inclination, in Hill's variables: radius r and its
rate, argument of latitude θ and momentum Θ, node ν and N = Θ c. A coordinate changes by minus the
derivative of W by its momentum, a momentum by the derivative by its coordinate. No term divides by
the eccentricity or by the sine of the inclination: circular and equatorial orbits need no care.

The drift of the angles and the energy go to second order. The momentum is then closed by the
energy integral, since an error of second order in the semi-major axis, 10 m, would carry a
satellite 100 m along its track in each revolution. What is left out, terms of second order that
repeat with the revolution or with the perigee, is measured in docs/orbits.md.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .constants import EARTH_EQUATORIAL_RADIUS, EARTH_GRAVITATIONAL_PARAMETER, EARTH_J2
from .elements import (
    Elements,
    PolarState,
    elements_from_polar,
    ellipse,
    mean_motion,
    polar_from_elements,
    polar_from_states,
    states_from_polar,
)
from .trajectory import States

Array = NDArray[np.float64]

_ITERATIONS: Final = 8  # each shrinks the error of the inverse by J2 or so


class SecularRates(NamedTuple):
    """Rates of the mean angles.

    Attributes
    ----------
    raan, argument_of_perigee : (...) [rad/s].
    mean_anomaly : (...) — the mean motion included [rad/s].
    """

    raan: Array
    argument_of_perigee: Array
    mean_anomaly: Array


def secular_rates(elements: Elements) -> SecularRates:
    """Rates of the mean angles, to second order in J2.

    Parameters
    ----------
    elements : mean, each (...).

    References
    ----------
    Brouwer 1959, doi:10.1086/107958, without the other harmonics.
    """
    a, e, i, *_ = (np.asarray(value, dtype=np.float64) for value in elements)
    eta, c2 = np.sqrt(1.0 - e * e), np.cos(i) ** 2
    n, k = mean_motion(a), _strength(a * (1.0 - e * e))
    node = -3.0 + 0.375 * k * (
        -5.0 + 12.0 * eta + 9.0 * eta**2 - (35.0 + 36.0 * eta + 5.0 * eta**2) * c2
    )
    perigee = 1.5 * (5.0 * c2 - 1.0) + 0.09375 * k * (
        -35.0
        + 24.0 * eta
        + 25.0 * eta**2
        + (90.0 - 192.0 * eta - 126.0 * eta**2) * c2
        + (385.0 + 360.0 * eta + 45.0 * eta**2) * c2**2
    )
    anomaly = 1.5 * (3.0 * c2 - 1.0) + 0.09375 * k * (
        -15.0
        + 16.0 * eta
        + 25.0 * eta**2
        + (30.0 - 96.0 * eta - 90.0 * eta**2) * c2
        + (105.0 + 144.0 * eta + 25.0 * eta**2) * c2**2
    )
    return SecularRates(
        raan=n * k * np.cos(i) * node,
        argument_of_perigee=n * k * perigee,
        mean_anomaly=n * (1.0 + k * eta * anomaly),
    )


def drifted(elements: Elements, times: Array) -> Elements:
    """Mean elements after some time.

    Parameters
    ----------
    elements : mean, at time 0, each broadcast against the times.
    times : (...) [s].
    """
    rates = secular_rates(elements)
    return elements._replace(
        raan=elements.raan + rates.raan * times,
        argument_of_perigee=elements.argument_of_perigee + rates.argument_of_perigee * times,
        mean_anomaly=elements.mean_anomaly + rates.mean_anomaly * times,
    )


def osculating_states(mean: Elements) -> States:
    """States of a satellite with given mean elements.

    Parameters
    ----------
    mean : mean elements, each (...).

    Returns
    -------
    States (..., 3) in the axes of the elements, z along the Earth's axis [m, m/s].
    """
    return states_from_polar(_osculating(polar_from_elements(mean)))


def mean_elements(states: States) -> Elements:
    """Mean elements of osculating states: the inverse of `osculating_states`.

    Parameters
    ----------
    states : (..., 3) in inertial axes, z along the Earth's axis [m, m/s].

    Returns
    -------
    Elements, each (...); NaN for a state that is not on an ellipse.
    """
    osculating = polar_from_states(states)
    mean = osculating
    for _ in range(_ITERATIONS):
        residual = _sum(osculating, _osculating(mean), -1.0)
        mean = _sum(mean, residual, 1.0)
    return elements_from_polar(mean)


def _osculating(mean: PolarState) -> PolarState:
    """Add the periodic terms, and let the momentum bring the energy to its value."""
    polar = _sum(mean, _periodic(mean), 1.0)
    latitude_sine = np.sin(polar.inclination) * np.sin(polar.argument_of_latitude)
    flattening = _strength(polar.radius) * (3.0 * latitude_sine**2 - 1.0)
    potential = -EARTH_GRAVITATIONAL_PARAMETER / polar.radius * (1.0 - flattening)
    kinetic = _mean_energy(mean) - potential
    transverse = np.sqrt(np.maximum(2.0 * kinetic - polar.radial_rate**2, 0.0))
    return polar._replace(momentum=polar.radius * transverse)


def _mean_energy(mean: PolarState) -> Array:
    """Energy per mass in a field with J2, from mean coordinates, to second order [m²/s²]."""
    p, _, _, eta, _ = ellipse(mean)
    k, c2 = _strength(p), np.cos(mean.inclination) ** 2
    second = (
        -5.0
        + 4.0 * eta
        + 5.0 * eta**2
        + (10.0 - 24.0 * eta - 18.0 * eta**2) * c2
        + (35.0 + 36.0 * eta + 5.0 * eta**2) * c2**2
    )
    factor = 1.0 + k * eta * (3.0 * c2 - 1.0) + 0.1875 * k**2 * eta * second
    energy: Array = -0.5 * EARTH_GRAVITATIONAL_PARAMETER * eta**2 / p * factor
    return energy


def _periodic(mean: PolarState) -> PolarState:
    """Periodic terms of first order: osculating minus mean polar coordinates."""
    p, kappa, sigma, eta, center = ellipse(mean)
    k = _strength(p)
    c, s = np.cos(mean.inclination), np.sin(mean.inclination)
    cos2, sin2 = np.cos(2.0 * mean.argument_of_latitude), np.sin(2.0 * mean.argument_of_latitude)
    zonal = 1.5 * c * c - 0.5
    lead = center + sigma
    wave = (1.0 + 4.0 / 3.0 * kappa) * sin2 - 2.0 / 3.0 * sigma * cos2
    swing = (1.5 + 2.0 * kappa) * cos2 + sigma * sin2
    latitude = (
        3.0 * (zonal + c * c) * lead
        + (2.25 * s * s - 1.5 * c * c) * wave
        - zonal * sigma * (1.0 - (2.0 + kappa) / (1.0 + eta))
        - s * s * (2.0 * (1.0 + kappa) * sin2 - 0.5 * sigma * cos2)
    )
    height = zonal * (1.0 + kappa / (1.0 + eta) + 2.0 * eta / (1.0 + kappa)) - 0.5 * s * s * cos2
    climb = zonal * sigma * ((1.0 + kappa) ** 2 / (1.0 + eta) + eta)
    climb -= s * s * (1.0 + kappa) ** 2 * sin2
    return PolarState(
        radius=-k * p * height,
        radial_rate=k * mean.momentum / p * climb,
        argument_of_latitude=k * latitude,
        momentum=np.zeros_like(k),  # follows from the energy
        inclination=k * c * s * swing,
        raan=-k * c * (3.0 * lead - 1.5 * wave),
    )


def _sum(polar: PolarState, change: PolarState, sign: float) -> PolarState:
    return PolarState(*(value + sign * step for value, step in zip(polar, change, strict=True)))


def _strength(parameter: Array) -> Array:
    strength: Array = 0.5 * EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / parameter) ** 2
    return strength
