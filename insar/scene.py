"""Where the radar looks: one line-of-sight sample for each segment of the observed area."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .geometry import line_of_sight, local_vertical

Array = NDArray[np.float64]

DEFLECTION = np.deg2rad(0.2)
"""Largest angle between the ellipsoid's normal and the direction from the Earth's center [rad].

The look angle is from the geocentric nadir, the incidence from the normal: on the ellipsoid, and
near nadir, an incidence may be smaller than its look angle by this.
"""


class LookSide(IntEnum):
    """Side of the flight direction that the radar looks to; the value is the sign of û·N."""

    LEFT = 1
    RIGHT = -1


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """The segments (line-of-sight samples) of an observed area, S of them.

    Parameters
    ----------
    times : (S,) — time of each segment since the epoch of the formation's states [s].
    slant_range : (S,) — distance from the formation to the target [m].
    look_angle : (S,) — angle of the line of sight from nadir (−R) [rad].
    azimuth : (S,) — angle of the line of sight about nadir, from T (0) towards N (π/2): targets
        with azimuth in (0, π) are on the left of the flight direction [rad].
    incidence : (S,) — angle between the line of sight and the vertical at the target [rad]; not
        below the look angle, but for the deflection of the ellipsoid's normal.
    velocity_direction : (S, 3) or (3,) — direction of the satellite's Earth-fixed velocity, RTN,
        normalized here; along-track when not given.
    slope : (S,) or scalar — terrain slope in the range direction, positive towards the radar [rad].

    Raises
    ------
    ValueError
        If an array is not finite, has the wrong shape, or an angle or range is impossible.

    Notes
    -----
    The vertical at the target is taken in the plane of the line of sight and the radial direction:
    exact on a sphere, within the deflection of the ellipsoid's normal (below 0.2°) on the Earth.
    """

    times: Array
    slant_range: Array
    look_angle: Array
    azimuth: Array
    incidence: Array
    velocity_direction: Array = field(default_factory=lambda: np.array([0.0, 1.0, 0.0]))
    slope: Array = field(default_factory=lambda: np.zeros(()))

    def __post_init__(self) -> None:
        count = np.atleast_1d(np.asarray(self.times, dtype=np.float64)).shape[0]
        for name in ("times", "slant_range", "look_angle", "azimuth", "incidence", "slope"):
            self._store(name, (count,))
        self._store("velocity_direction", (count, 3))
        self._check(self.slant_range > 0.0, "slant_range", "m must be positive")
        self._check(
            (self.look_angle > 0.0) & (self.look_angle < np.pi / 2),
            "look_angle",
            "rad must lie between 0 and π/2, from nadir",
        )
        self._check(
            (self.incidence >= self.look_angle - DEFLECTION) & (self.incidence < np.pi / 2),
            "incidence",
            "rad must lie between the look angle (flat Earth) and π/2",
        )
        self._check(
            (self.slope < self.incidence) & (self.incidence - self.slope < np.pi / 2),
            "slope",
            "rad must leave a local incidence between 0 (layover) and π/2 (shadow)",
        )
        norm = np.linalg.norm(self.velocity_direction, axis=-1, keepdims=True)
        self._check(norm[:, 0] > 0.0, "velocity_direction", "must not be the zero vector")
        object.__setattr__(self, "velocity_direction", self.velocity_direction / norm)
        alignment = np.abs(np.sum(self.line_of_sight * self.velocity_direction, axis=-1))
        self._check(
            alignment < 1.0 - 1e-9,
            "velocity_direction",
            "must not point along the line of sight: height has no interferometric sensitivity",
        )

    def _store(self, name: str, shape: tuple[int, ...]) -> None:
        value = np.asarray(getattr(self, name), dtype=np.float64)
        try:
            stored = np.array(np.broadcast_to(value, shape))
        except ValueError as error:
            raise ValueError(
                f"{name} has shape {value.shape}; a scene of {shape[0]} times needs {shape}"
            ) from error
        if not np.all(np.isfinite(stored)):
            raise ValueError(f"{name} = {stored} must be finite")
        stored.setflags(write=False)
        object.__setattr__(self, name, stored)

    def _check(self, valid: NDArray[np.bool_], name: str, requirement: str) -> None:
        if not np.all(valid):
            segment = int(np.argmin(valid))
            value = getattr(self, name)[segment]
            raise ValueError(f"{name} = {value} in segment {segment + 1} {requirement}")

    def __len__(self) -> int:
        return len(self.times)

    @cached_property
    def line_of_sight(self) -> Array:
        """Unit vectors û from the formation to the targets, (S, 3) RTN."""
        return line_of_sight(look_angle=self.look_angle, azimuth=self.azimuth)

    @cached_property
    def vertical(self) -> Array:
        """Unit vectors upward at the targets, (S, 3) RTN."""
        return local_vertical(
            look_angle=self.look_angle, azimuth=self.azimuth, incidence=self.incidence
        )

    @classmethod
    def flat_earth(
        cls,
        *,
        times: ArrayLike,
        slant_range: ArrayLike,
        look_angle: ArrayLike,
        azimuth: ArrayLike,
    ) -> Scene:
        """Scene over a flat Earth, where the incidence equals the look angle.

        Parameters
        ----------
        times, slant_range, look_angle, azimuth : (S,) — as in `Scene` [s, m, rad, rad].

        References
        ----------
        Li 2009 Table 2 is such a scene.
        """
        look = np.asarray(look_angle, dtype=np.float64)
        return cls(
            times=np.asarray(times, dtype=np.float64),
            slant_range=np.asarray(slant_range, dtype=np.float64),
            look_angle=look,
            azimuth=np.asarray(azimuth, dtype=np.float64),
            incidence=look,
        )

    @classmethod
    def broadside_strip(
        cls,
        *,
        times: ArrayLike,
        look_angle: float,
        altitude: float,
        earth_radius: float,
        side: LookSide = LookSide.LEFT,
        slope: float = 0.0,
    ) -> Scene:
        """Strip observed at broadside (zero squint) over a spherical Earth that does not rotate.

        Parameters
        ----------
        times : (S,) — time of each segment since the epoch of the formation's states [s].
        look_angle : scalar — angle of the line of sight from nadir [rad].
        altitude : scalar — height of the orbit above the sphere [m].
        earth_radius : scalar — radius of the sphere [m].
        side : side of the flight direction that is observed.
        slope : scalar — terrain slope in range, positive towards the radar [rad].

        Raises
        ------
        ValueError
            If the line of sight misses the Earth.

        Examples
        --------
        >>> scene = Scene.broadside_strip(
        ...     times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6378137.0
        ... )
        >>> print(np.rad2deg(scene.incidence).round(2), (scene.slant_range / 1e3).round(1))
        [24.97] [562.5]
        """
        ratio = (earth_radius + altitude) / earth_radius
        if not 0.0 < np.sin(look_angle) * ratio < 1.0 or look_angle >= np.pi / 2:
            limit = np.rad2deg(np.arcsin(1.0 / ratio))
            raise ValueError(
                f"look_angle = {np.rad2deg(look_angle):.6g}° misses the Earth from "
                f"{altitude / 1e3:.6g} km; it must lie between 0 and {limit:.2f}°"
            )
        incidence = float(np.arcsin(ratio * np.sin(look_angle)))
        # Law of sines in the triangle Earth center, satellite, target.
        slant_range = earth_radius * np.sin(incidence - look_angle) / np.sin(look_angle)
        time = np.atleast_1d(np.asarray(times, dtype=np.float64))
        one = np.ones_like(time)
        return cls(
            times=time,
            slant_range=slant_range * one,
            look_angle=look_angle * one,
            azimuth=side * np.pi / 2 * one,
            incidence=incidence * one,
            slope=slope * one,
        )
