"""What the studies of steering find: curves over the orbit, a selection, claims and verdicts."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ...claims import Claim
from ...scene import LookSide
from ..boresight import Boresight
from ..steering import Law

Array = NDArray[np.float64]


class LawCurves(NamedTuple):
    """What one steering law does over the samples of one case; NaN where it has no solution.

    Attributes
    ----------
    law : which.
    yaw, pitch, roll : (S,) — attitude of the body against the orbit frame [rad].
    rate_orbit, rate_inertial : (S, 3) — angular velocity of the body against the orbit frame and
        against inertial space, in body axes [rad/s].
    off_nadir, incidence, slant_range : (S,) — of the boresight [rad, rad, m].
    residual_doppler : (S,) — Doppler centroid at the boresight [Hz].
    swath_doppler : (S, E) — the same at the elevations of the case off the boresight [Hz].
    pointing_sensitivity : (S,) — largest change of the Doppler centroid for a small turn of the
        beam in any direction [Hz/rad].
    steering_angle : (S,) — the angles that are steered, added: |yaw| + |pitch| or
        |pitch| + |roll| [rad].
    outcome : (S,) of `Outcome` — solved, or why not.
    """

    law: Law
    yaw: Array
    pitch: Array
    roll: Array
    rate_orbit: Array
    rate_inertial: Array
    off_nadir: Array
    incidence: Array
    slant_range: Array
    residual_doppler: Array
    swath_doppler: Array
    pointing_sensitivity: Array
    steering_angle: Array
    outcome: NDArray[np.int_]


@dataclass(frozen=True, kw_only=True, eq=False)
class SteeringCase:
    """One orbit, one boresight, and the laws that are compared on it.

    Attributes
    ----------
    name : what it is called.
    trajectory : the orbit.
    times : (S,) — samples, since the trajectory's epoch [s].
    wavelength : scalar [m].
    side : where the radar looks.
    boresight : what is held constant.
    laws : to compare, in the order of the report.
    swath_offsets : (E,) — elevations off the boresight, positive away from nadir [rad].
    """

    name: str
    trajectory: Trajectory
    times: Array
    wavelength: float
    side: LookSide
    boresight: Boresight
    laws: tuple[Law, ...]
    swath_offsets: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class CaseResult:
    """What the laws do in a case.

    Attributes
    ----------
    case : the case.
    argument_of_latitude : (S,) — from the ascending node, unwrapped: it grows over revolutions
        [rad].
    latitude, longitude : (S,) — geodetic, of the point below the satellite [rad].
    altitude : (S,) — above the ellipsoid [m].
    semi_major_axis, eccentricity, inclination : scalars — mean elements at the first sample
        [m, 1, rad].
    curves : of each law of the case, in order.
    """

    case: SteeringCase
    argument_of_latitude: Array
    latitude: Array
    longitude: Array
    altitude: Array
    semi_major_axis: float
    eccentricity: float
    inclination: float
    curves: tuple[LawCurves, ...]

    def of(self, law: Law) -> LawCurves:
        """Curves of one law.

        Raises
        ------
        KeyError
            If the case does not compare this law.
        """
        for curves in self.curves:
            if curves.law is law:
                return curves
        raise KeyError(f"the case {self.name!r} has no law {law.value!r}")

    @property
    def name(self) -> str:
        """Name of the case."""
        return self.case.name


class Held(StrEnum):
    """What a selection holds constant as altitude and inclination vary."""

    LOOK = "look"
    INCIDENCE = "incidence"


@dataclass(frozen=True, kw_only=True, eq=False)
class Selection:
    """Yaw-pitch against pitch-roll steering, over altitude A and inclination I.

    Largest values over one revolution. NaN where a law has no solution all around.

    Attributes
    ----------
    altitudes : (A,) — of the semi-major axis above the equatorial radius [m].
    inclinations : (I,) [rad].
    eccentricity, argument_of_perigee : scalars, of all orbits [1, rad].
    held : what is held constant.
    boresight_angle : scalar — the look angle or incidence held [rad].
    slew_rate : scalar — rate limit of the slew times [rad/s].
    swath_offset : scalar — elevation off the boresight of the swath Doppler, both ways [rad].
    laws : the two laws, yaw-pitch first: first axis of what follows.
    steering_angle : (2, I, A) — largest sum of the steered angles [rad].
    slew_time : (2, I, A) — to turn by the largest single angle at `slew_rate` [s].
    rate : (2, I, A) — largest rate of the steered angles [rad/s].
    pointing_sensitivity : (2, I, A) [Hz/rad].
    swath_doppler : (2, I, A) — largest magnitude at ±`swath_offset` [Hz].
    crossovers : for each inclination, the altitudes where the steering angles are equal, from
        below; empty if there is none in range [m].
    """

    altitudes: Array
    inclinations: Array
    eccentricity: float
    argument_of_perigee: float
    held: Held
    boresight_angle: float
    slew_rate: float
    swath_offset: float
    laws: tuple[Law, Law]
    steering_angle: Array
    slew_time: Array
    rate: Array
    pointing_sensitivity: Array
    swath_doppler: Array
    crossovers: tuple[tuple[float, ...], ...]


class Effect(StrEnum):
    """What the exact Doppler model has and Meng's simplified one does not."""

    EARTH_SHAPE = "earth_shape"
    J2 = "j2"
    ECCENTRICITY = "eccentricity"
    ALL = "all"


@dataclass(frozen=True, kw_only=True, eq=False)
class CompensationCurve:
    """Exact and simplified Doppler of the unsteered radar over one revolution.

    Doppler is given as a range rate, λf/2 (Meng's frequency number N) [m/s].

    Attributes
    ----------
    effect : what is switched on.
    eccentricity, argument_of_perigee : scalars, of the orbit [1, rad].
    argument_of_latitude : (S,) [rad].
    exact, simplified : (S,) — Meng (1) and Meng (5) [m/s].
    compensation : scalar — 1 − max|exact − simplified| / max|exact|: the part of the Doppler
        that yaw steering by the simplified model takes away, in the maximum norm.
    compensation_rms : scalar — the same in the root-mean-square norm.
    """

    effect: Effect
    eccentricity: float
    argument_of_perigee: float
    argument_of_latitude: Array
    exact: Array
    simplified: Array
    compensation: float
    compensation_rms: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Compensation:
    """Meng's study: how much of the Doppler the simplified yaw law compensates.

    Attributes
    ----------
    semi_major_axis, inclination, look_angle : scalars [m, rad, rad].
    side : where the radar looks.
    curves : the effects one by one and all together.
    eccentricities : (C,) — of the sweep.
    sweep : (C,) — compensation of each, effect of eccentricity alone, maximum norm.
    sweep_rms : (C,) — the same in the root-mean-square norm.
    sweep_deviation : (C,) — max|exact − simplified| [m/s].
    """

    semi_major_axis: float
    inclination: float
    look_angle: float
    side: LookSide
    curves: tuple[CompensationCurve, ...]
    eccentricities: Array
    sweep: Array
    sweep_rms: Array
    sweep_deviation: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class SteeringResult:
    """What a study of kind `steering` finds.

    Attributes
    ----------
    cases : one or more.
    selections : one for each that the study asks for; may be empty.
    compensation : None if the study asks for none.
    claims : printed figures and their verdicts; may be empty.
    warnings : what a user should know.
    """

    cases: tuple[CaseResult, ...]
    selections: tuple[Selection, ...]
    compensation: Compensation | None
    claims: tuple[Claim, ...]
    warnings: tuple[str, ...]
