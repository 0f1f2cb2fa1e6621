"""How a radar that looks at a terrain from the side sees it: ranges, slopes, layover, shadow.

The orbit is a circle over a sphere that stands still, and the radar looks broadside: the geometry
of `Scene.broadside_strip`, point by point. A map direction is laid along the flight by its heading,
and distances on the map are those on the sphere (37 km apart, the two differ by 1 m in 37 km).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from ..scene import LookSide, Scene
from .grid import Terrain

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class TerrainView:
    """A terrain as a radar at broadside sees it; arrays are (rows, columns) of the terrain.

    Attributes
    ----------
    terrain : the terrain.
    orbit_radius, earth_radius : scalar — of the circular orbit and of the sphere [m].
    side : of the flight direction that is observed.
    heading : scalar — flight direction on the map, clockwise from north [rad].
    look_angle : scalar — from nadir, at the middle of the terrain at height zero [rad].
    along : distance of each point along the flight from the middle [m].
    across : distance on the ground from the middle, away from the radar [m].
    slope : in range, positive towards the radar [rad].
    layover : whether another point has the same range, or the slope faces the radar too steeply.
    shadow : whether higher ground hides it from the radar.
    """

    terrain: Terrain
    orbit_radius: float
    earth_radius: float
    side: LookSide
    heading: float
    look_angle: float
    along: Array
    across: Array
    slope: Array
    layover: Mask
    shadow: Mask

    @property
    def seen(self) -> Mask:
        """Points that have a phase of their own: known, in neither layover nor shadow."""
        return np.isfinite(self.slope) & ~self.layover & ~self.shadow

    @property
    def central_angle(self) -> float:
        """From the ground track to the middle of the terrain, at the Earth's center [rad]."""
        ratio = self.orbit_radius / self.earth_radius
        return math.asin(ratio * math.sin(self.look_angle)) - self.look_angle

    def targets(self, points: Mask) -> Array:
        """Places of points in the frame of the satellite that is broadside of each.

        Parameters
        ----------
        points : (rows, columns) — which.

        Returns
        -------
        (P, 3) — RTN, from the place of the reference orbit, at the time of zero Doppler [m].
        """
        angle = self.central_angle + self.across[points] / self.earth_radius
        radius = self.earth_radius + self.terrain.heights[points]
        return place(angle, radius, orbit_radius=self.orbit_radius, side=self.side)

    def times(self, points: Mask, *, mean_motion: float) -> Array:
        """When the satellite is broadside of points, since it was of the middle, (P,) [s].

        Parameters
        ----------
        points : (rows, columns) — which.
        mean_motion : scalar — angular rate of the orbit [rad/s].
        """
        on_ground = self.earth_radius * math.cos(self.central_angle) * mean_motion
        return np.asarray(self.along[points] / on_ground)

    def scene(self, points: Mask, *, mean_motion: float) -> Scene:
        """The points as segments of a scene, for the error model.

        Parameters
        ----------
        points : (rows, columns) — which; all of them seen.
        mean_motion : scalar — angular rate of the orbit [rad/s].
        """
        target = self.targets(points)
        look = np.arctan2(self.side * target[:, 2], -target[:, 0])
        angle = self.central_angle + self.across[points] / self.earth_radius
        return Scene(
            times=self.times(points, mean_motion=mean_motion),
            slant_range=np.linalg.norm(target, axis=-1),
            look_angle=look,
            azimuth=np.full(look.shape, self.side * np.pi / 2),
            incidence=look + angle,
            slope=self.slope[points],
        )


def place(angle: Array, radius: Array, *, orbit_radius: float, side: LookSide) -> Array:
    """Points in the plane of zero Doppler.

    Parameters
    ----------
    angle : (P,) — from the satellite's nadir, at the Earth's center [rad].
    radius : (P,) — distance from the Earth's center [m].
    orbit_radius : scalar — of the satellite [m].
    side : of the flight direction.

    Returns
    -------
    (P, 3) — RTN [m].
    """
    return np.stack(
        [
            radius * np.cos(angle) - orbit_radius,
            np.zeros_like(angle),
            side * radius * np.sin(angle),
        ],
        axis=-1,
    )


def view_terrain(
    terrain: Terrain,
    *,
    orbit_radius: float,
    earth_radius: float,
    look_angle: float,
    side: LookSide,
    heading: float,
) -> TerrainView:
    """Look at a terrain.

    Parameters
    ----------
    terrain : the terrain.
    orbit_radius, earth_radius : scalar — of the circular orbit and of the sphere [m].
    look_angle : scalar — from nadir, at the middle of the terrain at height zero [rad].
    side : of the flight direction that is observed.
    heading : scalar — flight direction on the map, clockwise from north [rad].

    Raises
    ------
    ValueError
        If the look angle misses the Earth, or the terrain reaches to nadir or to the horizon.
    """
    ratio = orbit_radius / earth_radius
    if not 0.0 < math.sin(look_angle) * ratio < 1.0:
        raise ValueError(f"look_angle = {math.degrees(look_angle):.6g}° misses the Earth")
    east, north = np.meshgrid(terrain.east, terrain.north)
    # On the map, the flight is (sin, cos) of the heading; left of it is (−cos, sin).
    flight, left = _directions(heading)
    along = flight[0] * east + flight[1] * north
    across = side * (left[0] * east + left[1] * north)
    center = math.asin(ratio * math.sin(look_angle)) - look_angle
    nearest, farthest = (center + float(x) / earth_radius for x in (across.min(), across.max()))
    if nearest <= 0.0 or farthest >= math.acos(1.0 / ratio):
        raise ValueError(
            f"the terrain reaches from {nearest * earth_radius / 1e3:.0f} to "
            f"{farthest * earth_radius / 1e3:.0f} km from nadir, beyond nadir or the horizon; cut "
            "it down, or look elsewhere"
        )
    rise_east, rise_north = terrain.gradient()
    away = side * (left[0] * rise_east + left[1] * rise_north)
    layover, shadow = _hidden(
        terrain,
        across,
        along,
        center=center,
        ratio=ratio,
        earth_radius=earth_radius,
        side=side,
        heading=heading,
    )
    slope = np.arctan(away)
    angle = center + across / earth_radius
    incidence = angle + _look(angle, earth_radius + terrain.heights, orbit_radius)
    facing = np.nan_to_num(slope) >= incidence - _GRAZING
    averted = np.nan_to_num(slope) <= incidence - np.pi / 2 + _GRAZING
    return TerrainView(
        terrain=terrain,
        orbit_radius=orbit_radius,
        earth_radius=earth_radius,
        side=side,
        heading=heading,
        look_angle=look_angle,
        along=along,
        across=across,
        slope=slope,
        layover=layover | facing,
        shadow=shadow | averted,
    )


_GRAZING = math.radians(1.0)
"""A slope nearer than this to layover or to shadow counts as such: no looks are left there."""


def _directions(heading: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Directions of the flight and of its left, (east, north)."""
    sine, cosine = math.sin(heading), math.cos(heading)
    return (sine, cosine), (-cosine, sine)


def _look(angle: Array, radius: Array, orbit_radius: float) -> Array:
    """Angle from nadir at the satellite [rad]."""
    return np.asarray(np.arctan2(radius * np.sin(angle), orbit_radius - radius * np.cos(angle)))


def _hidden(
    terrain: Terrain,
    across: Array,
    along: Array,
    *,
    center: float,
    ratio: float,
    earth_radius: float,
    side: LookSide,
    heading: float,
) -> tuple[Mask, Mask]:
    """Layover and shadow: where range, or look angle, does not grow along a line of range.

    The terrain is laid on lines of range at half its posting, and the masks are read off there.
    """
    step = 0.5 * min(terrain.posting_north, terrain.posting_east)
    ground = np.arange(across.min(), across.max() + step, step)
    lines = np.arange(along.min(), along.max() + 2.0 * step, 2.0 * step)
    flight, left = _directions(heading)
    east = flight[0] * lines[:, None] + side * left[0] * ground
    north = flight[1] * lines[:, None] + side * left[1] * ground
    rows = (terrain.north[0] - north) / terrain.posting_north
    columns = (east - terrain.east[0]) / terrain.posting_east
    height = map_coordinates(
        terrain.heights, [rows, columns], order=1, mode="constant", cval=np.nan
    )
    angle = center + ground / earth_radius
    radius = earth_radius + height
    orbit = ratio * earth_radius
    slant = np.sqrt(orbit**2 + radius**2 - 2.0 * orbit * radius * np.cos(angle))
    look = _look(angle, radius, orbit)
    nearer = np.fmax.accumulate(slant, axis=1)
    farther = np.fmin.accumulate(slant[:, ::-1], axis=1)[:, ::-1]
    with np.errstate(invalid="ignore"):
        layover = (slant < nearer) | (slant > farther)
        shadow = look < np.fmax.accumulate(look, axis=1)
    line = np.rint((along - lines[0]) / (2.0 * step)).astype(int)
    place_across = np.rint((across - ground[0]) / step).astype(int)
    return layover[line, place_across], shadow[line, place_across]
