"""Circular formations as points of a plane, and what each segment of a scene sees of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import relative_positions
from insar import HeldConstant, Scene
from insar.baselines import sensitivity

from .design_space import DesignSpace

Array = NDArray[np.float64]


class Projection(NamedTuple):
    """Projections of the plane v = (z0, ż0/n) on the sensitivity directions of S segments.

    Positions of both circular families are linear in v, p(t) = P(t) v, so a satellite has the
    perpendicular coordinate (Pᵀe_h)·v and the azimuth coordinate (Pᵀe_a)·v.

    Attributes
    ----------
    height : (S, 2) — Pᵀe_h.
    azimuth : (S, 2) — Pᵀe_a.
    lever : (S,) — height lever K [m/rad].
    """

    height: Array
    azimuth: Array
    lever: Array


def projection(
    space: DesignSpace, scene: Scene, *, held_constant: HeldConstant, sign: int
) -> Projection:
    """Project the plane of the design variables on the sensitivity directions of a scene.

    Parameters
    ----------
    space : for its family and mean motion.
    scene : the S segments.
    held_constant : what a target keeps while its height changes.
    sign : ±1 — of the cross-track motion.

    Returns
    -------
    Projection
    """
    direction = sensitivity(scene, held_constant)
    n = space.mean_motion
    unit = space.family([1.0, 0.0], [0.0, n], mean_motion=n, sign=sign)
    motion = relative_positions(unit, scene.times, mean_motion=n)  # (S, 2, 3): Pᵀ
    return Projection(
        height=(motion @ direction.height_direction[..., None])[..., 0],
        azimuth=(motion @ direction.azimuth_direction[..., None])[..., 0],
        lever=direction.height_lever,
    )


def plane_radius(space: DesignSpace, *, max_radius: float | None, inscribed: bool = False) -> float:
    """Radius of a disc about zero in the plane v = (z0, ż0/n) [m].

    Parameters
    ----------
    space : for its box.
    max_radius : scalar — limit on the radius of a relative orbit, twice |v|; None without [m].
    inscribed : False for a disc that holds every allowed satellite; True for one in which every
        satellite is allowed.
    """
    box = (space.max_offset, space.max_rate / space.mean_motion)
    of_box = min(box) if inscribed else float(np.hypot(*box))
    return of_box if max_radius is None else min(of_box, 0.5 * max_radius)
