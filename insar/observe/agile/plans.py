"""When a place is imaged, and for how long."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from ...scene import LookSide

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class PassPlan:
    """The moment of zero Doppler at which a place is seen.

    Attributes
    ----------
    time : scalar — of zero Doppler, the middle of the imaging, since the trajectory's epoch [s].
    epoch : UTC of that time.
    passes, number : how many there are in the searched time, and which this is.
    side : where the aim point lies, seen along the Earth-fixed velocity.
    ascending : whether the satellite flies northward.
    slant_range, look_angle, incidence, azimuth : scalars — at zero Doppler [m, rad, rad, rad].
    doppler_rate : scalar — f_a [Hz/s].
    ground_speed : scalar — V_g of the zero-Doppler line over the ground, across itself [m/s].
    """

    time: float
    epoch: datetime
    passes: int
    number: int
    side: LookSide
    ascending: bool
    slant_range: float
    look_angle: float
    incidence: float
    azimuth: float
    doppler_rate: float
    ground_speed: float


@dataclass(frozen=True, kw_only=True, eq=False)
class SpotlightPlan(PassPlan):
    """The same, and for how long the beam stays.

    Attributes
    ----------
    aperture_time : scalar — in which the aim point's Doppler runs through the bandwidth that the
        resolution needs [s].
    first_order_time : scalar — the same if the Doppler went on at its rate at zero Doppler, which
        is the formula of Han (2016) [s].
    imaging_time : scalar — the aperture time, and the time in which the beam slides over the scene
        [s].
    rotation_center : (3,) — point that the beam looks at: the aim point, or beyond it in sliding
        spotlight; Earth-fixed [m].
    """

    aperture_time: float
    first_order_time: float
    imaging_time: float
    rotation_center: Array
