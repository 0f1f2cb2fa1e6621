"""A stretch of an orbit as one polynomial: smooth states and accelerations, fast."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev, chebyshev
from numpy.typing import ArrayLike, NDArray

from formation import States, Trajectory
from formation.frames import gcrs_to_itrs
from formation.timescales import moments

Array = NDArray[np.float64]

_DEGREE: Final = 16
"""Of the polynomials: exact to 1e-6 m over 1500 s of a low orbit, horizon to horizon."""
_NODES: Final = 48
SHORTEST: Final = 240.0
"""Of the stretch that is fitted [s]: on a shorter one rounding would shake the accelerations."""
_MARGIN: Final = 0.25
"""Fitted beyond both ends, in lengths of the stretch: polynomials are worst at their ends."""


class SmoothOrbit(NamedTuple):
    """Earth-fixed motion and the turn of the Earth over a stretch of time.

    Attributes
    ----------
    position : polynomial, (3,) of time since the trajectory's epoch [m].
    celestial : polynomial, (9,) — entries of the matrix from the GCRS to the Earth-fixed axes.
    misfit : scalar — largest distance between the trajectory and the polynomial, between its
        nodes [m].
    """

    position: tuple[Chebyshev, ...]
    celestial: tuple[Chebyshev, ...]
    misfit: float

    def states(self, times: ArrayLike) -> States:
        """Earth-fixed states at times (...) of the stretch, (..., 3) each [m, m/s]."""
        return States(_at(self.position, times, 0), _at(self.position, times, 1))

    def acceleration(self, times: ArrayLike) -> Array:
        """Of the Earth-fixed coordinates at times (...), (..., 3) [m/s²]."""
        return _at(self.position, times, 2)

    def from_celestial(self, times: ArrayLike) -> Array:
        """GCRS components to Earth-fixed ones, (...) to (..., 3, 3)."""
        entries = _at(self.celestial, times, 0)
        return entries.reshape(*entries.shape[:-1], 3, 3)


def smooth_orbit(trajectory: Trajectory, start: float, stop: float) -> SmoothOrbit:
    """Fit polynomials to a stretch of an orbit.

    Parameters
    ----------
    trajectory : of the satellite.
    start, stop : scalars — of the stretch, since the trajectory's epoch [s].

    Returns
    -------
    SmoothOrbit — by least squares over the stretch and a margin around it. The misfit is that of
    the rounding of the Earth's rotation angle, below 1e-6 m, for analytic orbits, and shows the
    kinks between the pieces of an interpolated ephemeris.

    Raises
    ------
    ValueError
        If the trajectory does not cover the stretch.
    """
    first, last = trajectory.span
    if not first <= start <= stop <= last:
        raise ValueError(
            f"the orbit is needed from {start:.3f} s to {stop:.3f} s after its epoch and is known "
            f"from {first:.3f} s to {last:.3f} s; image for a shorter time, or take an ephemeris "
            "that reaches farther"
        )
    length = max((1.0 + 2.0 * _MARGIN) * (stop - start), SHORTEST)
    middle = 0.5 * (start + stop)
    domain = max(middle - length / 2, first), min(middle + length / 2, last)
    times = _spread(chebyshev.chebpts1(_NODES), domain)
    turn = gcrs_to_itrs(moments(trajectory.epoch, times)).matrix.reshape(_NODES, 9)
    position = _fit(times, trajectory.earth_fixed(times).position, domain)
    between = _spread(chebyshev.chebpts2(_NODES), domain)
    gap = _at(position, between, 0) - trajectory.earth_fixed(between).position
    misfit = float(np.linalg.norm(gap, axis=-1).max())
    return SmoothOrbit(position, _fit(times, turn, domain), misfit)


def _spread(points: Array, domain: tuple[float, float]) -> Array:
    """Points of [-1, 1] moved to a domain."""
    return 0.5 * (domain[0] + domain[1]) + 0.5 * (domain[1] - domain[0]) * points


def _fit(times: Array, values: Array, domain: tuple[float, float]) -> tuple[Chebyshev, ...]:
    """One polynomial for each column of (T, K)."""
    return tuple(Chebyshev.fit(times, column, _DEGREE, domain=domain) for column in values.T)


def _at(polynomials: tuple[Chebyshev, ...], times: ArrayLike, order: int) -> Array:
    """Derivatives of some order at times (...), (..., K)."""
    time = np.asarray(times, dtype=np.float64)
    return np.stack([polynomial.deriv(order)(time) for polynomial in polynomials], axis=-1)
