"""A formation's scene as a radar on a real orbit sees it, and where on the Earth it lies."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from formation import Orbit

from ...scene import LookSide, Scene
from ..boresight import Boresight
from ..steering import Law

Array = NDArray[np.float64]


class Reference(StrEnum):
    """The moment to which the geometry of a target is referred.

    AS_OBSERVED takes the moment at which the beam's center line passes the target; ZERO_DOPPLER
    the moment of closest approach, to which SAR images are usually focused. They are the same for
    a beam steered to zero Doppler.
    """

    AS_OBSERVED = "as_observed"
    ZERO_DOPPLER = "zero_doppler"


@dataclass(frozen=True, kw_only=True, eq=False)
class Observation:
    """One pass over the targets of a study: S segments seen of K targets.

    Attributes
    ----------
    scene : the segments, in order of time.
    orbit : circular reference orbit for the relative motion: mean semi-major axis and inclination.
    epoch : UTC of the scene's time zero, the epoch of the formation's states.
    orbit_source : what the orbit is known from, in a few words.
    orbit_epoch : UTC of its elements, or of the beginning of its ephemeris.
    side, law, boresight, reference : how it is observed; the boresight as resolved for the pass.
    eccentricity : scalar — mean, of the orbit.
    ascending : whether the satellite flies northward.
    passes : how many passes of the searched time see any target.
    pass_number : number of the chosen pass, from 1.
    latitude, longitude, height : (S,) — geodetic, of the segments [rad, rad, m].
    doppler : (S,) — Doppler centroid of each segment as observed [Hz].
    off_boresight : (S,) — elevation off the boresight as observed, positive away from nadir [rad].
    missed_latitude, missed_longitude : (K − S,) — targets that the pass does not see [rad].
    missed_reasons : (K − S,) — why, in words.
    track_latitude, track_longitude : (G,) — ground track around the pass [rad].
    near_latitude, near_longitude, far_latitude, far_longitude : (W,) — edges of the strip [rad].
    near_incidence, far_incidence : scalars — of the strip's edges [rad].
    outlines : polygons of the area, each (V, 2) of longitude, latitude [rad]; empty for points.
    """

    scene: Scene
    orbit: Orbit
    epoch: datetime
    orbit_source: str
    orbit_epoch: datetime
    side: LookSide
    law: Law
    boresight: Boresight
    reference: Reference
    eccentricity: float
    ascending: bool
    passes: int
    pass_number: int
    latitude: Array
    longitude: Array
    height: Array
    doppler: Array
    off_boresight: Array
    missed_latitude: Array
    missed_longitude: Array
    missed_reasons: tuple[str, ...]
    track_latitude: Array
    track_longitude: Array
    near_latitude: Array
    near_longitude: Array
    far_latitude: Array
    far_longitude: Array
    near_incidence: float
    far_incidence: float
    outlines: tuple[Array, ...]
