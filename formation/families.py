"""The two families of circular relative orbits of Li 2009.

Both are drift-free and centered; the cross-track motion is k times the radial motion and in phase
with it, so a satellite is fixed by its radial offset and rate (z0, ż0) alone:

    R = z0 cos nt + (ż0/n) sin nt,   T = (2ż0/n) cos nt − 2 z0 sin nt,   N = k R.

Both are passively unsafe: the minimum radial-normal separation over an orbit is zero, because the
relative eccentricity and inclination vectors are perpendicular.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .relative_motion import centered_state

Array = NDArray[np.float64]


class CircularFamily(Protocol):
    """A generator of relative orbits from (z0, ż0), such as `space_circular`."""

    def __call__(
        self, z0: ArrayLike, zdot0: ArrayLike, *, mean_motion: float, sign: ArrayLike = 1
    ) -> Array:
        """Return ``(..., 6)`` RTN states at t = 0 [m, m/s]."""
        ...


def space_circular(
    z0: ArrayLike, zdot0: ArrayLike, *, mean_motion: float, sign: ArrayLike = 1
) -> Array:
    """States whose relative orbit is a circle in space, of radius 2√(z0² + (ż0/n)²).

    Parameters
    ----------
    z0 : (...) — radial offset at t = 0 [m].
    zdot0 : (...) — radial rate at t = 0 [m/s].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].
    sign : ±1, broadcast against z0 — sign of the cross-track motion, N = sign·√3·R.

    Returns
    -------
    (..., 6) — RTN states at t = 0 [m, m/s].

    Raises
    ------
    ValueError
        If a sign is neither +1 nor −1.

    References
    ----------
    Li 2009 eq. (11), whose radial row carries a stray x0 in print.

    Examples
    --------
    >>> state = space_circular(605.6, 0.0, mean_motion=1.10341e-3)
    >>> state.round(4).tolist()
    [605.6, 0.0, 1048.93, 0.0, -1.3365, 0.0]
    """
    return _circular(z0, zdot0, math.sqrt(3.0), mean_motion=mean_motion, sign=sign)


def ground_track_circular(
    z0: ArrayLike, zdot0: ArrayLike, *, mean_motion: float, sign: ArrayLike = 1
) -> Array:
    """States whose relative orbit, seen from above, is a circle of radius 2√(z0² + (ż0/n)²).

    Parameters
    ----------
    z0 : (...) — radial offset at t = 0 [m].
    zdot0 : (...) — radial rate at t = 0 [m/s].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].
    sign : ±1, broadcast against z0 — sign of the cross-track motion, N = sign·2·R.

    Returns
    -------
    (..., 6) — RTN states at t = 0 [m, m/s].

    Raises
    ------
    ValueError
        If a sign is neither +1 nor −1.

    References
    ----------
    Li 2009 eq. (12), whose radial row carries a stray x0 in print.
    """
    return _circular(z0, zdot0, 2.0, mean_motion=mean_motion, sign=sign)


def _circular(
    z0: ArrayLike, zdot0: ArrayLike, ratio: float, *, mean_motion: float, sign: ArrayLike
) -> Array:
    signs = np.asarray(sign, dtype=np.float64)
    if not np.all(np.abs(signs) == 1.0):
        raise ValueError(f"sign = {sign!r} must be +1 or -1: it mirrors the cross-track motion")
    radial, rate = np.asarray(z0, dtype=np.float64), np.asarray(zdot0, dtype=np.float64)
    k = ratio * signs
    return centered_state(radial, rate, k * radial, k * rate, mean_motion=mean_motion)


def orbit_radius(z0: ArrayLike, zdot0: ArrayLike, *, mean_motion: float) -> Array:
    """Radius of the circle that either family flies.

    Parameters
    ----------
    z0 : (...) — radial offset at t = 0 [m].
    zdot0 : (...) — radial rate at t = 0 [m/s].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].

    Returns
    -------
    (...) — 2√(z0² + (ż0/n)²) [m], so that a limit on the radius is a disc in (z0, ż0/n).
    """
    return 2.0 * np.hypot(
        np.asarray(z0, dtype=np.float64), np.asarray(zdot0, dtype=np.float64) / mean_motion
    )


def equally_spaced(count: int, *, radius: float, mean_motion: float) -> tuple[Array, Array]:
    """Radial offsets and rates of satellites evenly phased along one relative orbit.

    Parameters
    ----------
    count : number of satellites.
    radius : scalar — radius of the circle [m].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].

    Returns
    -------
    z0 : (count,) — radial offsets [m]; the first satellite is at the top of its orbit.
    zdot0 : (count,) — radial rates [m/s].

    References
    ----------
    Li 2009 section 4, the unoptimized formation, for ``count=3, radius=1211.2``.
    """
    phase = 2.0 * np.pi * np.arange(count) / count
    amplitude = radius / 2.0
    # Subtracted from 0.0, lest the first rate be −0.0.
    return amplitude * np.cos(phase), 0.0 - amplitude * mean_motion * np.sin(phase)
