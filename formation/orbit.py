"""The reference orbit that a formation flies around."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .constants import EARTH_EQUATORIAL_RADIUS, EARTH_GRAVITATIONAL_PARAMETER


@dataclass(frozen=True, kw_only=True)
class Orbit:
    """A circular Keplerian reference orbit.

    Parameters
    ----------
    semi_major_axis : scalar — distance from the center of the Earth [m].
    inclination : scalar — angle between the orbit and the equator, 0 to π [rad].

    Raises
    ------
    ValueError
        If the orbit lies inside the Earth or the inclination is outside 0 to π.

    Notes
    -----
    Valid for the linear (Clohessy-Wiltshire) relative motion of `formation`, which assumes a
    circular orbit around a spherical Earth.
    """

    semi_major_axis: float
    inclination: float

    def __post_init__(self) -> None:
        if not (
            math.isfinite(self.semi_major_axis) and self.semi_major_axis > EARTH_EQUATORIAL_RADIUS
        ):
            raise ValueError(
                f"semi_major_axis = {self.semi_major_axis!r} m must be a finite number above the "
                f"Earth's radius, {EARTH_EQUATORIAL_RADIUS:.0f} m; give meters from the center of "
                "the Earth, or use Orbit.circular(altitude=...)"
            )
        if not 0.0 <= self.inclination <= math.pi:
            raise ValueError(
                f"inclination = {self.inclination!r} rad must lie within 0 and π; give radians"
            )

    @classmethod
    def circular(cls, *, altitude: float, inclination: float) -> Orbit:
        """Build the circular orbit at an altitude above the equatorial radius of the Earth.

        Parameters
        ----------
        altitude : scalar — height above 6378.137 km, the convention of Li 2009 [m].
        inclination : scalar — angle between the orbit and the equator [rad].

        Examples
        --------
        >>> orbit = Orbit.circular(altitude=514e3, inclination=1.7)
        >>> f"{orbit.mean_motion:.5e} rad/s"
        '1.10341e-03 rad/s'
        """
        return cls(semi_major_axis=EARTH_EQUATORIAL_RADIUS + altitude, inclination=inclination)

    @property
    def altitude(self) -> float:
        """Height above the equatorial radius [m]."""
        return self.semi_major_axis - EARTH_EQUATORIAL_RADIUS

    @property
    def mean_motion(self) -> float:
        """Mean angular rate n = √(μ/a³) [rad/s]."""
        return math.sqrt(EARTH_GRAVITATIONAL_PARAMETER / self.semi_major_axis**3)

    @property
    def period(self) -> float:
        """Time of one revolution [s]."""
        return 2.0 * math.pi / self.mean_motion
