"""Constants of the Earth that the orbital mechanics needs."""

from __future__ import annotations

from typing import Final

EARTH_GRAVITATIONAL_PARAMETER: Final = 3.986004418e14
"""GM of the Earth, atmosphere included (WGS84) [m³/s²]."""

EARTH_EQUATORIAL_RADIUS: Final = 6_378_137.0
"""Semi-major axis of the WGS84 ellipsoid [m]; altitudes are counted from it."""
