"""What a spotlight study asks for, and what it finds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ...claims import Claim
from ...scene import LookSide
from ..scenes.passes import Direction
from .agility import Agility
from .plans import SpotlightPlan
from .profiles import Profile

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

NEAR_INCIDENCE: Final = math.radians(5.0)
"""Nearer to nadir, range does not resolve the ground, and left and right fold together."""
FAR_INCIDENCE: Final = math.radians(80.0)


class Pointing(IntEnum):
    """Whether the beam can be pointed at a sample, and why not."""

    SOLVED = 0
    BELOW_HORIZON = 1
    """The aim point does not see the satellite."""
    OPPOSITE = 2
    """The beam would have to turn by 180°: no turn is the shortest."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SpotlightRequest:
    """A point on the Earth that an agile satellite shall image in spotlight mode.

    Parameters
    ----------
    trajectory : of the satellite.
    latitude, longitude : scalars — of the aim point, geodetic, WGS84 [rad].
    height : scalar — of the aim point above the ellipsoid [m].
    wavelength : scalar — of the carrier [m].
    resolution : scalar — in azimuth on the ground, ρ_a [m].
    weighting : scalar — k_wa, how much the weighting of the Doppler spectrum widens the impulse
        response.
    start, stop : scalars — the time that is searched, since the trajectory's epoch [s].
    side : where the radar looks; None for a satellite that can turn to either.
    direction : which passes count.
    number : of the pass to take, from 1 in order of time.
    near_incidence, far_incidence : scalars — of the aim point at zero Doppler [rad].
    off_axis : scalar — of the beam from the body's Z axis towards its −Y, which is left of the
        flight direction [rad].
    phase_center : (3,) — of the antenna in body axes, from the center of mass [m].
    sliding_factor : scalar — speed of the beam over the ground by that of the zero-Doppler line:
        0 is staring spotlight, values towards 1 come near to a strip.
    scene_length : scalar — along azimuth at full resolution, sliding spotlight only [m].
    duration : scalar — of the attitude profile [s]; None for the imaging time.
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
    weighting: float = 1.0
    start: float = 0.0
    stop: float
    side: LookSide | None = None
    direction: Direction = Direction.EITHER
    number: int = 1
    near_incidence: float = NEAR_INCIDENCE
    far_incidence: float = FAR_INCIDENCE
    off_axis: float = 0.0
    phase_center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    sliding_factor: float = 0.0
    scene_length: float = 0.0
    duration: float | None = None
    agility: Agility | None = None

    def __post_init__(self) -> None:
        self._check("latitude", abs(self.latitude) <= math.pi / 2, "rad, −π/2 to π/2")
        self._check("longitude", abs(self.longitude) <= math.tau, "rad, −2π to 2π")
        self._check("height", abs(self.height) < 1e5, "m above the ellipsoid; give meters")
        for name, unit in (("wavelength", "m"), ("resolution", "m"), ("weighting", "")):
            value = getattr(self, name)
            self._check(name, 0.0 < value < math.inf, f"{unit}: positive".lstrip(": "))
        self._check("number", self.number >= 1, "pass, counted from 1")
        self._check("off_axis", abs(self.off_axis) < math.pi / 2, "rad, −π/2 to π/2; radians")
        self._check(
            "phase_center",
            len(self.phase_center) == 3 and all(abs(part) < 1e3 for part in self.phase_center),
            "m: X, Y, Z in body axes, on the satellite",
        )
        self._check("sliding_factor", 0.0 <= self.sliding_factor < 1.0, "0 (staring) to below 1")
        self._check(
            "scene_length",
            0.0 <= self.scene_length < math.inf,
            "m: 0 or more",
        )
        if self.scene_length > 0.0 and self.sliding_factor == 0.0:
            raise ValueError(
                f"scene_length = {self.scene_length!r} m needs a beam that moves over the ground: "
                "give a sliding_factor above 0; the length of a staring scene is that of the beam"
            )
        if self.duration is not None:
            self._check("duration", 0.0 < self.duration < math.inf, "s: positive")
        if not 0.0 <= self.near_incidence < self.far_incidence < math.pi / 2:
            raise ValueError(
                f"near_incidence = {self.near_incidence!r} and far_incidence = "
                f"{self.far_incidence!r} rad must be in order between 0 and π/2; give radians"
            )

    def _check(self, name: str, valid: bool, requirement: str) -> None:
        if not valid:  # NaN is not valid either
            raise ValueError(f"{name} = {getattr(self, name)!r} must be {requirement}")


class Iteration(NamedTuple):
    """The attitude by Han's iteration.

    Attributes
    ----------
    attitude : (S, 3, 3) — orbit frame to body.
    steps : how many were needed.
    turn : (S,) — angle between this attitude and the closed form's: about the line of sight, which
        both share [rad].
    """

    attitude: Array
    steps: int
    turn: Array


class AimError(NamedTuple):
    """Distance on the ground between where the beam's center falls and where it should fall.

    NaN where it misses the Earth. The reference is the aim point, in sliding spotlight the point
    on the way to the rotation center.

    Attributes
    ----------
    closed_form, iterated : (S,) — with everything considered [m].
    without_phase_center : (S,) — the attitude takes the beam to start from the center of mass [m].
    without_both : (S,) — it also takes it to be along the body's Z axis [m].
    """

    closed_form: Array
    iterated: Array
    without_phase_center: Array
    without_both: Array


class EchoHistory(NamedTuple):
    """The aim point as the radar sees it.

    Attributes
    ----------
    slant_range : (S,) — from the antenna's phase center [m].
    doppler : (S,) — of the phase center, which the turning body carries along [Hz].
    bandwidth : scalar — of the Doppler over the aperture time [Hz].
    resolution : scalar — that this bandwidth gives, k_wa V_g/B [m].
    first_order_bandwidth, first_order_resolution : scalars — the same over the aperture time of
        first order [Hz, m].
    range_migration : scalar — largest less smallest slant range over the aperture time [m].
    latitude, longitude : (S,) — where the beam's center falls [rad].
    """

    slant_range: Array
    doppler: Array
    bandwidth: float
    resolution: float
    first_order_bandwidth: float
    first_order_resolution: float
    range_migration: float
    latitude: Array
    longitude: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class SpotlightResult:
    """One spotlight imaging: S samples of it.

    Attributes
    ----------
    request : what was asked for.
    plan : moment and duration.
    times : (S,) — since zero Doppler [s].
    profile, iteration, aim_error, history : over these times.
    orbit_misfit : scalar — of the smooth orbit from which all is computed [m].
    warnings : what a user should know.
    claims : printed figures and their verdicts; empty unless a study adds them.
    """

    request: SpotlightRequest
    plan: SpotlightPlan
    times: Array
    profile: Profile
    iteration: Iteration
    aim_error: AimError
    history: EchoHistory
    orbit_misfit: float
    warnings: tuple[str, ...]
    claims: tuple[Claim, ...] = ()
