"""The Doppler model of Meng 2003: circular orbit, spherical Earth, no perturbation.

The azimuth χ is that of the beam about nadir, from along-track towards the look side, whichever
that is; broadside is π/2. With the project's azimuth γ (from T towards N) it is |γ|.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation.constants import EARTH_ROTATION_RATE

from ..scene import LookSide
from .doppler import doppler_per_speed

Array = NDArray[np.float64]


def simplified_doppler(
    *,
    radius: ArrayLike,
    orbital_rate: ArrayLike,
    inclination: ArrayLike,
    argument_of_latitude: ArrayLike,
    look_angle: ArrayLike,
    azimuth: ArrayLike,
    side: LookSide,
    wavelength: float,
) -> Array:
    """Doppler centroid of a beam in any direction.

    Parameters
    ----------
    radius : (...) — of the orbit R_s [m].
    orbital_rate : (...) — ω_s; mean motion, or the instantaneous rate [rad/s].
    inclination, argument_of_latitude : (...) [rad].
    look_angle : (...) — γ of the beam from nadir [rad].
    azimuth : (...) — χ of the beam, see above [rad].
    side : where the radar looks.
    wavelength : scalar [m].

    Returns
    -------
    (...) — f = (2/λ) V_s sinγ {cosχ − (ω_e/ω_s)[cosχ cos i + k sin i cos u sinχ]}, V_s = R_s ω_s,
    k = 1 to the right and −1 to the left [Hz].

    Notes
    -----
    Meng 2003 eq. (3), whose print lost the minus sign and confuses the indices of ω.
    """
    chi, i = np.asarray(azimuth, np.float64), np.asarray(inclination, np.float64)
    across = -int(side) * np.sin(i) * np.cos(argument_of_latitude) * np.sin(chi)
    rotation = EARTH_ROTATION_RATE * (np.cos(chi) * np.cos(i) + across)
    forward = np.asarray(orbital_rate, np.float64) * np.cos(chi)
    speed: Array = np.asarray(radius, np.float64) * (forward - rotation)
    return doppler_per_speed(wavelength) * np.sin(look_angle) * speed


def simplified_broadside_doppler(
    *,
    radius: ArrayLike,
    inclination: ArrayLike,
    argument_of_latitude: ArrayLike,
    look_angle: ArrayLike,
    side: LookSide,
    wavelength: float,
) -> Array:
    """Doppler centroid of the unsteered broadside beam: what the simplified yaw takes out.

    Parameters
    ----------
    radius : (...) — of the *orbit* R_s [m].
    inclination, argument_of_latitude, look_angle, side, wavelength : as in `simplified_doppler`.

    Returns
    -------
    (...) — f = −(2k/λ) R_s ω_e sinγ sin i cos u [Hz].

    Notes
    -----
    Meng 2003 eq. (5), whose print lost k and takes ω_s for ω_e.
    """
    across = -int(side) * np.sin(inclination) * np.cos(argument_of_latitude)
    speed: Array = np.asarray(radius, np.float64) * EARTH_ROTATION_RATE * across
    return -doppler_per_speed(wavelength) * np.sin(look_angle) * speed


def simplified_azimuth(
    *,
    orbital_rate: ArrayLike,
    inclination: ArrayLike,
    argument_of_latitude: ArrayLike,
    side: LookSide,
) -> Array:
    """Azimuth χ of the beam at which the simplified model gives zero Doppler.

    Parameters
    ----------
    orbital_rate : (...) — ω_s [rad/s].
    inclination, argument_of_latitude : (...) [rad].
    side : where the radar looks.

    Returns
    -------
    (...) — tanχ = k(ω_s/ω_e − cos i)/(sin i cos u), on the look side: between 0 and π where
    ω_s > ω_e cos i [rad].

    References
    ----------
    Meng 2003 eq. (4).
    """
    k = -int(side)
    forward = np.asarray(orbital_rate, np.float64) / EARTH_ROTATION_RATE - np.cos(inclination)
    across = np.sin(inclination) * np.cos(argument_of_latitude)
    chi: Array = np.arctan2(forward, k * across)
    return chi


def simplified_yaw(
    *,
    orbital_rate: ArrayLike,
    inclination: ArrayLike,
    argument_of_latitude: ArrayLike,
    side: LookSide,
) -> Array:
    """Yaw of the simplified model, about nadir, as Meng counts it.

    Parameters
    ----------
    orbital_rate, inclination, argument_of_latitude, side : as in `simplified_azimuth`.

    Returns
    -------
    (...) — π/2 − χ: the turn of the beam from broadside towards the flight direction [rad]. The
    yaw of the body about +Z (nadir) is −k times it, the same for both sides.
    """
    return np.pi / 2 - simplified_azimuth(
        orbital_rate=orbital_rate,
        inclination=inclination,
        argument_of_latitude=argument_of_latitude,
        side=side,
    )
