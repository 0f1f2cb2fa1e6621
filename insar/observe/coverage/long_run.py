"""Long-run cover of a Walker constellation, for every longitude and epoch at once.

Whether a satellite sees a target of a given latitude depends on two angles: the target's longitude
θ east of the ascending node, and the satellite's argument of latitude u. What it sees is a set A on
the torus of (θ, u), the same for every satellite, altitude and inclination given. The pattern
T/P/F is a lattice of T shifts of that set. In time, a target runs along a line of constant slope;
unless the ground track repeats, the line comes everywhere. So the long-run cover is the part of
the torus that the shifted sets cover, whatever the longitude and **whatever the Earth's rate**,
and a band is covered at all times if nothing of the torus is left over. By symmetry, the part with
θ < 2π/P and u < 2π/S stands for all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from formation.constants import EARTH_ROTATION_RATE

from ..earth import WGS84, Ellipsoid
from .walker import Visibility, Walker, annulus, central_cosine, ground_points, left_of_plane

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Counts = NDArray[np.int_]

CELLS = 360
"""Least number of cells of the torus in each direction; the next multiple of T is taken."""


def cells_for(total: int, *, least: int = CELLS) -> int:
    """Cells in each direction of the torus, so that all shifts are whole cells."""
    return total * -(-least // total)


def single_view(
    *,
    orbit_radius: float,
    inclination: float,
    latitude: float,
    visibility: Visibility,
    cells: int,
    ellipsoid: Ellipsoid = WGS84,
) -> Mask:
    """Set A of (θ, u) in which one satellite sees a target.

    Parameters
    ----------
    orbit_radius : scalar — radius of the orbit [m].
    inclination : scalar [rad].
    latitude : scalar — geodetic, of the target [rad].
    visibility : what a satellite sees.
    cells : of the torus in each direction.
    ellipsoid : on which the target lies.

    Returns
    -------
    (cells, cells) — at the centers of the cells, θ first.
    """
    point = ground_points(latitude, 0.0, ellipsoid=ellipsoid)
    inner, outer = annulus(visibility, orbit_radius=orbit_radius, target_radius=point.radius)
    u = 2 * np.pi * (np.arange(cells) + 0.5) / cells
    theta = u[:, None]
    closeness = central_cosine(latitude=point.latitude, theta=theta, u=u, inclination=inclination)
    seen: Mask = (closeness >= np.cos(outer)) & (closeness <= np.cos(inner))
    if visibility.side is not None:
        left = left_of_plane(latitude=point.latitude, theta=theta, inclination=inclination)
        seen &= visibility.side * left >= 0.0
    return seen


def fold(seen: Mask, *, planes: int, slots: int, phasing: int) -> Counts:
    """How many satellites of a pattern see the target, on the part that stands for all.

    Parameters
    ----------
    seen : (cells, cells) — of one satellite; the cells are a multiple of planes·slots.
    planes, slots, phasing : P, S = T/P and F.

    Returns
    -------
    (cells/P, cells/S) — θ first.
    """
    cells = seen.shape[0]
    rows, columns = cells // planes, cells // slots
    # Satellites of one plane: whole shifts in u.
    plane = seen.reshape(planes, rows, slots, columns).sum(axis=2, dtype=np.int16)
    number = np.arange(planes)
    shift = (number * phasing) % planes * (columns // planes)
    column = (np.arange(columns) + shift[:, None]) % columns
    shifted = plane[-number % planes][
        number[:, None, None], np.arange(rows)[:, None], column[:, None]
    ]
    counts: Counts = shifted.sum(axis=0)
    return counts


def longest_run(covered: Mask, *, planes: int, phasing: int, slope: float, limit: int) -> int:
    """Longest stay of any target outside the cover, in steps of one cell of u.

    Parameters
    ----------
    covered : (cells/P, cells/S) — where the pattern sees the target.
    planes, phasing : P and F.
    slope : scalar — dθ/du of the motion.
    limit : steps after which the search ends.

    Returns
    -------
    Steps; 0 if all is covered, and `limit` if that was reached. Lines between those through the
    middles of the cells may stay out longer, where they just miss the tip of a view.
    """
    rows, columns = covered.shape
    if not covered.any():
        return limit
    turn = columns // planes
    # A gap begins where the cell before, in the same row or in the one before, is covered.
    row_before = np.concatenate([[np.roll(covered[-1], phasing * turn)], covered[:-1]])
    row, column = np.nonzero(~covered & np.roll(covered | row_before, 1, axis=1))
    for step in range(limit):
        if row.size == 0:
            return step
        plane, east = np.divmod(row + round(slope * step), rows)
        ahead = (column + step + plane * phasing * turn) % columns
        out = ~covered[east, ahead]
        row, column = row[out], column[out]
    return limit


def long_run_counts(
    walker: Walker,
    *,
    latitude: float,
    visibility: Visibility,
    least_cells: int = CELLS,
    ellipsoid: Ellipsoid = WGS84,
) -> Counts:
    """How many satellites see a target, on the part of the torus that stands for all.

    Parameters
    ----------
    walker : the constellation.
    latitude : scalar — geodetic [rad].
    visibility : what a satellite sees.
    least_cells : of the torus in each direction.
    ellipsoid : on which the target lies.

    Returns
    -------
    (cells/P, cells/S) — its mean is the mean number of satellites in view, the part above zero the
    long-run cover; along the second axis, that of a target under which the Earth does not turn.
    """
    seen = single_view(
        orbit_radius=walker.semi_major_axis,
        inclination=walker.inclination,
        latitude=latitude,
        visibility=visibility,
        cells=cells_for(walker.total, least=least_cells),
        ellipsoid=ellipsoid,
    )
    slots = walker.satellites_per_plane
    return fold(seen, planes=walker.planes, slots=slots, phasing=walker.phasing)


def track_slope(walker: Walker) -> float:
    """Slope dθ/du at which a target moves over the torus: the Earth's rate by the orbit's."""
    rates = walker.rates
    return (EARTH_ROTATION_RATE - rates.node) / rates.argument_of_latitude
