"""Orbital mechanics of a formation: orbits, relative motion, families, separation; no radar.

Positions are RTN of the reference orbit: R radial outward, T along-track, N along the orbit
normal. Everything is in SI units and radians.
"""

from .families import (
    CircularFamily,
    equally_spaced,
    ground_track_circular,
    orbit_radius,
    space_circular,
)
from .orbit import Orbit
from .relative_motion import (
    centered_state,
    drift_per_orbit,
    propagate,
    relative_positions,
    transition_matrix,
)
from .separation import min_separation, satellite_pairs

__all__ = [
    "CircularFamily",
    "Orbit",
    "centered_state",
    "drift_per_orbit",
    "equally_spaced",
    "ground_track_circular",
    "min_separation",
    "orbit_radius",
    "propagate",
    "relative_positions",
    "satellite_pairs",
    "space_circular",
    "transition_matrix",
]
