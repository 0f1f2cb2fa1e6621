"""Celestial and terrestrial frames: GCRS, ITRS, TEME, true equator and equinox of date.

The theory is IAU 2006/2000A as implemented by pyerfa (the IAU's SOFA under a free license). Its
series of two thousand terms vary slowly, so that they are evaluated four times a day and joined by
splines; that is exact to 0.1 mm at the geostationary radius. Velocities are exact derivatives of
the positions, the motion of the axes included.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from functools import lru_cache
from typing import Any, Final, NamedTuple

import erfa
import numpy as np
from numpy.typing import NDArray

from .earth_orientation import EarthOrientation, earth_orientation
from .timescales import DAY, MJD_ZERO, TT_MINUS_TAI, Moments, moments
from .trajectory import States

Array = NDArray[np.float64]

_EARTH_ROTATION_ANGLE_RATE: Final = 2.0 * np.pi * 1.002_737_811_911_354_48 / DAY
"""Rate of the Earth rotation angle by UT1 (IAU 2000) [rad/s]."""

_SIDEREAL_RATE: Final = 2.0 * np.pi * 1.002_737_909_350_795 / DAY
"""Rate of Greenwich mean sidereal time by UT1 (IAU 1982) [rad/s]."""

_NODES_PER_DAY: Final = 4
_BLOCK: Final = 32  # days of splines that are kept together
_MARGIN: Final = 8  # nodes beyond a block, so that the ends of its spline are never used


class Rotation(NamedTuple):
    """Turn of axes, and its rate: x' = matrix x and v' = matrix v + rate x.

    Attributes
    ----------
    matrix : (..., 3, 3) — rows are the new axes.
    rate : (..., 3, 3) — its rate of change [1/s].
    """

    matrix: Array
    rate: Array

    def apply(self, states: States) -> States:
        """States in the new axes."""
        position = _times(self.matrix, states.position)
        velocity = _times(self.matrix, states.velocity) + _times(self.rate, states.position)
        return States(position, velocity)

    def inverse(self) -> Rotation:
        """Turn back to the old axes."""
        return Rotation(np.swapaxes(self.matrix, -1, -2), np.swapaxes(self.rate, -1, -2))

    def after(self, first: Rotation) -> Rotation:
        """One turn after another."""
        return Rotation(
            self.matrix @ first.matrix, self.rate @ first.matrix + self.matrix @ first.rate
        )


def gcrs_to_itrs(at: Moments) -> Rotation:
    """Turn from celestial to Earth-fixed axes.

    Parameters
    ----------
    at : (...) moments.

    References
    ----------
    IERS Conventions 2010, section 5.4: polar motion, Earth rotation angle, celestial pole.
    """
    return _earth_spin(at).after(_splined(_celestial_block, at))


def true_of_date_to_gcrs(at: Moments) -> Rotation:
    """Turn from the true equator and equinox of date.

    Parameters
    ----------
    at : (...) moments.
    """
    return _splined(_true_block, at).inverse()


def true_of_epoch_to_gcrs(epoch: datetime) -> Array:
    """Axes of the true equator and equinox of one epoch, which then stay.

    Parameters
    ----------
    epoch : UTC, with a time zone.

    Returns
    -------
    (3, 3) — turns a vector in those axes into the GCRS.
    """
    return true_of_date_to_gcrs(moments(epoch)).matrix


def teme_to_itrs(at: Moments) -> Rotation:
    """Turn from the true equator and mean equinox of date, the axes of SGP4.

    Parameters
    ----------
    at : (...) moments.

    References
    ----------
    Vallado et al. 2006, AIAA 2006-6753, appendix C: sidereal time of 1982 and polar motion.
    """
    pole = earth_orientation(at)
    ut1 = at.shifted(pole.ut1_minus_tai)
    angle = erfa.gmst82(MJD_ZERO + ut1.day, ut1.fraction)
    return _polar_motion(pole, at).after(_spin(angle, _SIDEREAL_RATE * (1.0 + pole.ut1_rate)))


def teme_to_gcrs(at: Moments) -> Rotation:
    """Turn from the axes of SGP4 to celestial ones, by way of the Earth-fixed axes.

    Parameters
    ----------
    at : (...) moments.
    """
    return gcrs_to_itrs(at).inverse().after(teme_to_itrs(at))


def sidereal_angle(epoch: datetime) -> float:
    """Greenwich apparent sidereal time: right ascension of the zero meridian, true equinox [rad].

    Parameters
    ----------
    epoch : UTC, with a time zone.
    """
    at = moments(epoch)
    tt, ut1 = at.shifted(TT_MINUS_TAI), at.shifted(earth_orientation(at).ut1_minus_tai)
    angle = erfa.gst06a(MJD_ZERO + ut1.day, ut1.fraction, MJD_ZERO + tt.day, tt.fraction)
    return float(angle)


def _earth_spin(at: Moments) -> Rotation:
    """Turn from the celestial intermediate axes of date to the ITRS."""
    pole = earth_orientation(at)
    ut1 = at.shifted(pole.ut1_minus_tai)
    angle = erfa.era00(MJD_ZERO + ut1.day, ut1.fraction)
    spin = _spin(angle, _EARTH_ROTATION_ANGLE_RATE * (1.0 + pole.ut1_rate))
    return _polar_motion(pole, at).after(spin)


def _spin(angle: Array, rate: Array) -> Rotation:
    """Turn about the z axis."""
    cosine, sine = np.cos(angle), np.sin(angle)
    matrix = np.zeros((*np.shape(angle), 3, 3))
    turning = np.zeros_like(matrix)
    matrix[..., 0, 0] = matrix[..., 1, 1] = cosine
    matrix[..., 0, 1], matrix[..., 1, 0] = sine, -sine
    matrix[..., 2, 2] = 1.0
    turning[..., 0, 0] = turning[..., 1, 1] = -rate * sine
    turning[..., 0, 1], turning[..., 1, 0] = rate * cosine, -rate * cosine
    return Rotation(matrix, turning)


def _polar_motion(pole: EarthOrientation, at: Moments) -> Rotation:
    """Turn from the axes of the intermediate pole to the ITRS."""
    tt = at.shifted(TT_MINUS_TAI)
    locator = erfa.sp00(MJD_ZERO + tt.day, tt.fraction)
    matrix = np.asarray(erfa.pom00(pole.pole_x, pole.pole_y, locator))
    rate = np.zeros_like(matrix)  # to first order in the pole's coordinates, 1e-6 rad
    rate[..., 0, 2], rate[..., 2, 0] = pole.pole_x_rate, -pole.pole_x_rate
    rate[..., 1, 2], rate[..., 2, 1] = -pole.pole_y_rate, pole.pole_y_rate
    return Rotation(matrix, rate)


def _splined(block: Callable[[int], Any], at: Moments) -> Rotation:
    """Matrices and rates read off the splines of the blocks in which the moments lie."""
    days = at.mjd + TT_MINUS_TAI / DAY
    numbers = np.floor(days / _BLOCK).astype(int)
    matrix = np.empty((*days.shape, 3, 3))
    rate = np.empty_like(matrix)
    for number in np.unique(numbers):
        here = numbers == number
        spline = block(int(number))
        matrix[here] = spline(days[here])
        rate[here] = spline(days[here], 1) / DAY
    return Rotation(matrix, rate)


@lru_cache(maxsize=64)
def _celestial_block(number: int) -> Any:
    """Spline of the turn from the GCRS to the celestial intermediate axes of date."""
    return _block(erfa.c2i06a, number)


@lru_cache(maxsize=64)
def _true_block(number: int) -> Any:
    """Spline of the turn from the GCRS to the true equator and equinox of date."""
    return _block(erfa.pnm06a, number)


def _block(matrices: Callable[[float, Array], Array], number: int) -> Any:
    from scipy.interpolate import CubicSpline  # slow to import

    nodes = np.arange(-_MARGIN, _BLOCK * _NODES_PER_DAY + _MARGIN + 1) / _NODES_PER_DAY
    days = number * _BLOCK + nodes
    return CubicSpline(days, matrices(MJD_ZERO, days))


def _times(matrix: Array, vector: Array) -> Array:
    product: Array = (matrix @ vector[..., None])[..., 0]
    return product
