"""Constants of the Earth that the orbital mechanics needs."""

from __future__ import annotations

from typing import Final

EARTH_GRAVITATIONAL_PARAMETER: Final = 3.986004418e14
"""GM of the Earth, atmosphere included (WGS84) [m³/s²]."""

EARTH_EQUATORIAL_RADIUS: Final = 6_378_137.0
"""Semi-major axis of the WGS84 ellipsoid [m]; altitudes are counted from it."""

EARTH_ROTATION_RATE: Final = 7.2921159e-5
"""Sidereal rate of the Earth's rotation about the ITRS z axis [rad/s]."""

EARTH_J2: Final = 1.082626684e-3
"""Second zonal harmonic of the Earth's gravity, unnormalized (EGM2008, tide-free)."""
