"""The sizing of a Walker constellation in Liang (2018), and why it falls short of its aim."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from formation import Orbit
from formation.constants import EARTH_EQUATORIAL_RADIUS, EARTH_ROTATION_RATE

from ..earth import WGS84, Ellipsoid
from .long_run import long_run_counts
from .results import SizingShortfall, WalkerSizing
from .walker import Visibility, central_angle

_CELLS = 720
"""Of the torus: fractions to about 0.1 %."""


def walker_sizing(*, altitude: float, max_incidence: float) -> WalkerSizing:
    """Size a constellation by Liang (2018) eqs. 14–20.

    Parameters
    ----------
    altitude : scalar — above the equatorial radius [m].
    max_incidence : scalar — β, largest zenith angle of the satellite at the target [rad].

    Returns
    -------
    WalkerSizing.

    Raises
    ------
    ValueError
        If the altitude is not positive or the incidence is not between 0 and π/2.

    Notes
    -----
    It counts the satellites of one plane that follow each other over a target *in that plane*,
    and as many planes as bring one over the target when the Earth has turned for a revolution. It
    does **not** guarantee continuous cover: halfway between planes, passes are shorter or do not
    exist; a SAR needs a least incidence; many look to one side only. Inclination, latitude and
    phasing do not enter. `sizing_shortfall` shows each reason, `smallest_walker` does the task.

    The paper's P = 2π/|Δφ| (eq. 19) is no whole number: rounded up here.
    """
    Visibility(max_incidence=max_incidence)  # refuses degrees
    orbit = Orbit.circular(altitude=altitude, inclination=0.0)
    half_angle = float(
        central_angle(
            max_incidence, orbit_radius=orbit.semi_major_axis, target_radius=EARTH_EQUATORIAL_RADIUS
        )
    )  # eq. 14
    view_time = 2 * half_angle / orbit.mean_motion  # eq. 15
    node_shift = orbit.period * EARTH_ROTATION_RATE  # eq. 17
    return WalkerSizing(
        altitude=altitude,
        max_incidence=max_incidence,
        half_angle=half_angle,
        period=orbit.period,
        view_time=view_time,
        satellites_per_plane=math.ceil(orbit.period / view_time),  # eq. 16
        node_shift=node_shift,
        planes=math.ceil(2 * math.pi / node_shift),  # eq. 19
    )


def sizing_shortfall(
    sizing: WalkerSizing,
    *,
    latitude: float,
    inclination: float,
    visibility: Visibility,
    phasing: int = 0,
    ellipsoid: Ellipsoid = WGS84,
) -> SizingShortfall:
    """Long-run cover of a sized constellation, one reason for its failure at a time.

    Parameters
    ----------
    sizing : the constellation.
    latitude : scalar — geodetic, of the target [rad].
    inclination : scalar [rad].
    visibility : what the radar really sees; the sizing knows only its largest incidence.
    phasing : F, which the paper leaves open.
    ellipsoid : on which the target lies.

    Returns
    -------
    SizingShortfall.
    """
    walker = sizing.walker(inclination=inclination, phasing=phasing)
    anywhere = replace(visibility, min_incidence=0.0, side=None)
    cases = (
        anywhere,
        replace(visibility, side=None),
        replace(visibility, min_incidence=0.0),
        visibility,
    )
    counts = [
        long_run_counts(
            walker, latitude=latitude, visibility=case, least_cells=_CELLS, ellipsoid=ellipsoid
        )
        for case in cases
    ]
    covered = [float(np.mean(count > 0)) for count in counts]
    held = np.mean(counts[0] > 0, axis=1)
    in_plane = sizing.satellites_per_plane * sizing.half_angle / math.pi
    return SizingShortfall(
        sizing=sizing,
        walker=walker,
        latitude=latitude,
        visibility=visibility,
        in_plane=min(1.0, in_plane),
        held_least=float(held.min()),
        held_most=float(held.max()),
        spacing=covered[0],
        spacing_and_nadir=covered[1],
        spacing_and_side=covered[2],
        all_reasons=covered[3],
        seen_by=float(np.mean(counts[3])),
    )
