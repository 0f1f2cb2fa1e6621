"""Orbital mechanics of a formation: orbits, relative motion, families, separation; no radar.

Positions are RTN of the reference orbit: R radial outward, T along-track, N along the orbit
normal. Everything is in SI units and radians.
"""

from .earth_orientation import Coverage, orientation_coverage, orientation_span
from .elements import Elements, elements_from_states, states_from_elements
from .families import (
    CircularFamily,
    equally_spaced,
    ground_track_circular,
    orbit_radius,
    space_circular,
)
from .keplerian import (
    ElementKind,
    KeplerianOrbit,
    raan_from_local_time,
    raan_from_longitude,
)
from .oem import Ephemeris
from .orbit import Orbit
from .reference import mean_elements_at, reference_orbit
from .relative_motion import (
    centered_state,
    drift_per_orbit,
    propagate,
    relative_positions,
    transition_matrix,
)
from .separation import min_separation, satellite_pairs
from .tle import TwoLineOrbit
from .trajectory import States, Trajectory

__all__ = [
    "CircularFamily",
    "Coverage",
    "ElementKind",
    "Elements",
    "Ephemeris",
    "KeplerianOrbit",
    "Orbit",
    "States",
    "Trajectory",
    "TwoLineOrbit",
    "centered_state",
    "drift_per_orbit",
    "elements_from_states",
    "equally_spaced",
    "ground_track_circular",
    "mean_elements_at",
    "min_separation",
    "orbit_radius",
    "orientation_coverage",
    "orientation_span",
    "propagate",
    "raan_from_local_time",
    "raan_from_longitude",
    "reference_orbit",
    "relative_positions",
    "satellite_pairs",
    "space_circular",
    "states_from_elements",
    "transition_matrix",
]
