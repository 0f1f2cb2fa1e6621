"""The places beside a scene: the same pass, nearer and farther in the swath."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .scene import Scene

Array = NDArray[np.float64]

_FLAT = 1e-6
"""Central angle between nadir and target below which the Earth counts as flat [rad]: 6 m."""


def across_swath(scene: Scene, distance: float) -> Scene:
    """Move every target of a scene along the ground, away from the radar's nadir.

    Parameters
    ----------
    scene : the S segments.
    distance : scalar — along the ground in the plane of line of sight and vertical, negative
        towards nadir [m].

    Returns
    -------
    Scene — of the same times and azimuths, over the sphere that the slant range, the look angle
    and the incidence of each segment imply (a flat Earth where the last two agree).

    Raises
    ------
    ValueError
        If a target would pass nadir or the horizon, or the slope would put it into layover or
        shadow there.

    Notes
    -----
    At broadside the azimuth stays exactly; a squinted beam on a zero-Doppler line would turn by a
    fraction of its squint, which does not matter for the differences that this is for.
    """
    look, incidence, slant = scene.look_angle, scene.incidence, scene.slant_range
    central = incidence - look
    flat = central < _FLAT
    # Law of sines in the triangle Earth center, satellite, target.
    earth = slant * np.sin(look) / np.sin(np.where(flat, 1.0, central))
    orbit = earth * np.sin(incidence) / np.sin(look)
    moved = np.where(flat, 0.0, central + distance / earth)
    out = np.where(flat, slant * np.sin(look) + distance, earth * np.sin(moved))
    down = np.where(flat, slant * np.cos(look), orbit - earth * np.cos(moved))
    new_look = np.arctan2(out, down)
    new_incidence = np.where(flat, incidence + new_look - look, new_look + moved)
    if np.any(out <= 0.0) or np.any(new_incidence >= np.pi / 2):
        raise ValueError(
            f"distance = {distance!r} m moves a target past nadir or the horizon: "
            "take a narrower swath"
        )
    return replace(
        scene,
        slant_range=np.hypot(out, down),
        look_angle=new_look,
        incidence=new_incidence,
    )
