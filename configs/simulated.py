"""Builds what a study of kind `simulate` computes with."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Orbit, relative_positions
from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar import LookSide, Radar, Scene
from insar.simulation import TerrainRequest, natural_errors
from insar.simulation.synthesis import unsupported_scales
from insar.terrain import TerrainView, view_terrain

from .domain import build_instrument
from .flying import formation_states
from .messages import BuildError
from .simulate_study import SimulateStudy
from .terrain_files import build_terrain

Array = NDArray[np.float64]

MAX_IMAGES = 40
"""Images of the largest formation that is simulated over terrain."""

MAX_DRAWS = 1_000_000_000
"""Looks that are drawn, of all points, images and acquisitions: a quarter of an hour."""


class SimulateSetup(NamedTuple):
    """Everything that a study of kind `simulate` computes with.

    Attributes
    ----------
    request : what is simulated.
    names : name of each satellite.
    states : (N, 6) — the formation, RTN at t = 0 [m, m/s].
    seed : of the random numbers.
    orbit : the reference orbit.
    """

    request: TerrainRequest
    names: tuple[str, ...]
    states: Array
    seed: int
    orbit: Orbit


def build_simulate(study: SimulateStudy) -> SimulateSetup:
    """Build what a study of kind `simulate` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If its terrain cannot be read, or is not seen.
    """
    block, names, orbit = study.terrain, study.formation.names, study.reference_orbit
    side = LookSide.LEFT if block.side == "left" else LookSide.RIGHT
    look = math.radians(block.look_deg)
    terrain = build_terrain(block)
    try:
        view = view_terrain(
            terrain,
            orbit_radius=orbit.semi_major_axis,
            earth_radius=EARTH_EQUATORIAL_RADIUS,
            look_angle=look,
            side=side,
            heading=math.radians(block.heading_deg),
        )
    except ValueError as error:
        raise BuildError(("terrain", "look_deg"), f"cannot be used: {error}") from None
    middle = Scene.broadside_strip(
        times=[block.middle_s],
        look_angle=look,
        altitude=orbit.altitude,
        earth_radius=EARTH_EQUATORIAL_RADIUS,
        side=side,
    )
    speed = orbit.mean_motion * orbit.semi_major_axis
    radar, errors = build_instrument(study.radar, study.errors, names, middle, speed=speed)
    _check_effort(study, view, radar)
    for name in unsupported_scales(natural_errors(errors).errors):
        raise BuildError(
            ("errors", f"{name}_scale"),
            "is pixel, which is not drawn over a terrain; set it to scene, or remove it",
        )
    states = formation_states(study.formation, names, orbit.mean_motion)
    n, start = orbit.mean_motion, block.middle_s
    request = TerrainRequest(
        view=view,
        radar=radar,
        errors=errors,
        relative_positions=lambda times: relative_positions(states, times + start, mean_motion=n),
        mean_motion=n,
        prior_height_std=block.prior_height_std_m,
        prior_correlation=block.prior_correlation_m,
        acquisitions=study.simulation.acquisitions,
    )
    return SimulateSetup(request, names, states, study.simulation.seed, orbit)


def _check_effort(study: SimulateStudy, view: TerrainView, radar: Radar) -> None:
    """Refuse what would take hours."""
    images, points = len(radar.images), view.layover.size
    if images > MAX_IMAGES:
        raise BuildError(
            ("radar", "images"),
            f"are {images}, more than {MAX_IMAGES}, the most over a terrain; leave some out",
        )
    draws = points * images * radar.looks * study.simulation.acquisitions
    if draws > MAX_DRAWS:
        raise BuildError(
            ("simulation", "acquisitions"),
            f"would draw {draws:.1e} looks of {points} points and {images} images, more than "
            f"{MAX_DRAWS:.0e}; crop the terrain, or take fewer acquisitions or looks",
        )
