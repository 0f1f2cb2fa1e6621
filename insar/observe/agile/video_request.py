"""What a video study asks for."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from formation import Trajectory

from ...scene import LookSide
from ..scenes.passes import Direction
from .agility import Agility
from .spotlight_results import FAR_INCIDENCE, NEAR_INCIDENCE, SpotlightRequest


class YawLaw(StrEnum):
    """What the turn about the line of sight holds, once roll and pitch point the beam.

    NONE keeps the yaw at zero: roll and pitch only. SHORTEST_ROTATION takes the shortest turn from
    the orbit frame. The others keep one direction of the footprint fixed on the ground: the trace
    of the antenna's azimuth plane (X and Z), that of its range plane (Y and Z), or the major axis
    of the footprint's ellipse.
    """

    NONE = "none"
    SHORTEST_ROTATION = "shortest_rotation"
    AZIMUTH_TRACE = "azimuth_trace"
    RANGE_TRACE = "range_trace"
    MAJOR_AXIS = "major_axis"


@dataclass(frozen=True, kw_only=True, eq=False)
class VideoRequest:
    """A point on the Earth that an agile satellite shall film.

    Parameters
    ----------
    trajectory : of the satellite.
    latitude, longitude : scalars — of the scene's center, geodetic, WGS84 [rad].
    height : scalar — of the center above the ellipsoid [m].
    wavelength : scalar — of the carrier [m].
    resolution : scalar — in azimuth on the ground, of each frame, ρ_a [m].
    frame_rate : scalar — frames per second, 1/T_f [1/s].
    duration : scalar — of the film, centered on zero Doppler [s].
    start, stop : scalars — the time that is searched for a pass, since the trajectory's epoch [s].
    azimuth_beamwidth, elevation_beamwidth : scalars — full width of the beam, about the antenna's
        Y and X axes [rad].
    yaw_law : what the turn about the line of sight holds.
    reference_time : scalar — at which the yaw is zero and the footprint as it shall stay, since
        zero Doppler [s].
    max_overlap : scalar — share of its data that a frame may have in common with the one before;
        sets the limit of the frame rate. With 0 it is that of frames without common data.
    pointing_error : (3,) — standard deviations of small turns about the body's X, Y and Z [rad].
    side : where the radar looks; None for a satellite that can turn to either.
    direction : which passes count.
    number : of the pass to take, from 1 in order of time.
    near_incidence, far_incidence : scalars — of the center at zero Doppler [rad].
    agility : limits; None for none.

    Raises
    ------
    ValueError
        If a value is out of bounds.
    """

    trajectory: Trajectory
    latitude: float
    longitude: float
    height: float = 0.0
    wavelength: float
    resolution: float
    frame_rate: float
    duration: float
    start: float = 0.0
    stop: float
    azimuth_beamwidth: float
    elevation_beamwidth: float
    yaw_law: YawLaw = YawLaw.AZIMUTH_TRACE
    reference_time: float = 0.0
    max_overlap: float = 0.0
    pointing_error: tuple[float, float, float] = (0.0, 0.0, 0.0)
    side: LookSide | None = None
    direction: Direction = Direction.EITHER
    number: int = 1
    near_incidence: float = NEAR_INCIDENCE
    far_incidence: float = FAR_INCIDENCE
    agility: Agility | None = None

    def __post_init__(self) -> None:
        self.as_spotlight()  # checks what both have in common
        for name, unit in (("frame_rate", "1/s"), ("duration", "s")):
            self._check(name, 0.0 < getattr(self, name) < math.inf, f"{unit}: positive")
        for name in ("azimuth_beamwidth", "elevation_beamwidth"):
            value = getattr(self, name)
            self._check(name, 0.0 < value < math.pi / 2, "rad, 0 to π/2; give radians")
        self._check("max_overlap", 0.0 <= self.max_overlap < 1.0, "0 to below 1")
        self._check(
            "reference_time",
            abs(self.reference_time) <= 0.5 * self.duration,
            "s from zero Doppler, within the film: at most half its duration",
        )
        self._check(
            "pointing_error",
            len(self.pointing_error) == 3
            and all(0.0 <= error < 0.1 for error in self.pointing_error),
            "rad: standard deviations about X, Y and Z, 0 to 0.1; give radians",
        )

    def as_spotlight(self) -> SpotlightRequest:
        """The same point, orbit and resolution as one spotlight image."""
        return SpotlightRequest(
            trajectory=self.trajectory,
            latitude=self.latitude,
            longitude=self.longitude,
            height=self.height,
            wavelength=self.wavelength,
            resolution=self.resolution,
            start=self.start,
            stop=self.stop,
            side=self.side,
            direction=self.direction,
            number=self.number,
            near_incidence=self.near_incidence,
            far_incidence=self.far_incidence,
        )

    def _check(self, name: str, valid: bool, requirement: str) -> None:
        if not valid:  # NaN is not valid either
            raise ValueError(f"{name} = {getattr(self, name)!r} must be {requirement}")
