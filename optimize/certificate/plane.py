"""The plane (z0, ż0/n) of the satellites, turned to what the segments of a scene see of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from insar import SharedBy
from insar.baselines import scene_critical_baseline

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import Projection, plane_radius
from .projected import ROUNDING

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Frame:
    """The plane of the design variables, turned to the common direction of the height.

    Parameters
    ----------
    axes : (2, 2) — unit vectors along and across.
    radius : scalar — of the disc that holds every satellite [m].
    reach : (2,) — largest coordinate of a satellite along and across, in parts of the disc.
    tilt : scalar — what the coordinate across counts in the segment that sees most of it.
    height : (S, 2) — a of each segment, along and, over the tilt, across.
    azimuth : (S, 2) — c likewise, as the phase that the azimuth error turns at a unit [rad].
    shift : (S,) — band offset at a unit of a·v [bandwidths].
    wavenumber : (S,) — vertical wavenumber there [rad/m].
    """

    axes: Array
    radius: float
    reach: Array
    tilt: float
    height: Array
    azimuth: Array
    shift: Array
    wavenumber: Array


def plane_frame(problem: Problem, space: DesignSpace, seen: Projection) -> Frame:
    """Turn the plane of the design variables to the common direction of the height.

    Parameters
    ----------
    problem : for its scene, radar and limits.
    space : the designs.
    seen : what each segment sees of the plane.
    """
    # The line that the directions share, also where segments see it from opposite sides.
    unit = np.linalg.svd(seen.height)[2][0]
    unit = np.where(seen.height.sum(axis=0) @ unit < 0.0, -unit, unit)
    axes = np.array([unit, [-unit[1], unit[0]]])
    radius = plane_radius(space, max_radius=problem.constraints.max_radius)
    radius *= 1.0 + ROUNDING
    of_box = np.abs(axes) @ [space.max_offset, space.max_rate / space.mean_motion]
    height, azimuth = seen.height @ axes.T, seen.azimuth @ axes.T
    error = problem.errors.azimuth
    # Drawn anew for every pair it is no error that images share: left out, which can only help.
    std = error.std if error.shared_by is SharedBy.ALL else 0.0
    turn = 2.0 * np.pi / problem.radar.wavelength * radius * std
    tilt = max(float(np.abs(height[:, 1]).max()), 1e-3)
    scale = np.array([1.0, 1.0 / tilt])
    return Frame(
        axes=axes,
        radius=radius,
        reach=np.minimum(1.0, of_box * (1.0 + ROUNDING) / radius),
        tilt=tilt,
        height=height * scale,
        azimuth=azimuth * scale * turn,
        shift=radius / scene_critical_baseline(problem.scene, problem.radar),
        wavenumber=2.0 * np.pi / problem.radar.wavelength * radius / seen.lever,
    )
