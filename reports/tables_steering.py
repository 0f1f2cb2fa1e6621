"""Tables of a study of steering, in degrees and hertz where people read them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from insar import Claim
from insar.observe import CaseResult, Compensation, LawCurves, Outcome, Selection, SteeringResult

from .steering_words import law_name, solved, unsolved_reason

Array = NDArray[np.float64]

POINTING_STEP = math.radians(0.01)
"""Turn of the beam to which pointing sensitivities refer [rad]."""


def largest(values: Array) -> float:
    """Largest magnitude of those that are finite; NaN if there is none."""
    finite = np.abs(values[np.isfinite(values)])
    return float(finite.max()) if finite.size else math.nan


def least(values: Array) -> float:
    """Smallest value of those that are finite; NaN if there is none."""
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else math.nan


def rate_of(rates: Array) -> Array:
    """Magnitude of angular velocities (S, 3)."""
    return np.asarray(np.linalg.norm(rates, axis=-1))


def steering_frame(cases: Sequence[CaseResult]) -> pd.DataFrame:
    """Every curve: a row for each sample of each law of each case."""
    return pd.concat(
        [_curves_frame(case, curves) for case in cases for curves in case.curves],
        ignore_index=True,
    )


def _curves_frame(case: CaseResult, curves: LawCurves) -> pd.DataFrame:
    count = case.argument_of_latitude.size
    offsets = np.rad2deg(case.case.swath_offsets)
    return pd.DataFrame(
        {
            "case": [case.name] * count,
            "law": [curves.law.value] * count,
            "time_s": case.case.times,
            "argument_of_latitude_deg": np.rad2deg(case.argument_of_latitude),
            "latitude_deg": np.rad2deg(case.latitude),
            "longitude_deg": np.rad2deg(case.longitude),
            "altitude_m": case.altitude,
            "yaw_deg": np.rad2deg(curves.yaw),
            "pitch_deg": np.rad2deg(curves.pitch),
            "roll_deg": np.rad2deg(curves.roll),
            "rate_orbit_deg_s": np.rad2deg(rate_of(curves.rate_orbit)),
            "rate_inertial_deg_s": np.rad2deg(rate_of(curves.rate_inertial)),
            "off_nadir_deg": np.rad2deg(curves.off_nadir),
            "incidence_deg": np.rad2deg(curves.incidence),
            "slant_range_m": curves.slant_range,
            "residual_doppler_hz": curves.residual_doppler,
            **{
                f"doppler_at_{offset:+.6g}_deg_hz": curves.swath_doppler[:, index]
                for index, offset in enumerate(offsets)
            },
            "pointing_sensitivity_hz_deg": curves.pointing_sensitivity * math.radians(1.0),
            "outcome": [Outcome(value).name.lower() for value in curves.outcome],
        }
    )


def laws_frame(cases: Sequence[CaseResult]) -> pd.DataFrame:
    """Largest values over the orbit, a row for each law of each case."""
    return pd.DataFrame([_law_row(case, curves) for case in cases for curves in case.curves])


def _law_row(case: CaseResult, curves: LawCurves) -> dict[str, object]:
    degrees = math.degrees
    finite = curves.incidence[np.isfinite(curves.incidence)]
    return {
        "case": case.name,
        "law": law_name(curves.law),
        "yaw_deg": degrees(largest(curves.yaw)),
        "pitch_deg": degrees(largest(curves.pitch)),
        "roll_deg": degrees(largest(curves.roll)),
        "steering_deg": degrees(largest(curves.steering_angle)),
        "rate_orbit_deg_s": degrees(largest(rate_of(curves.rate_orbit))),
        "rate_inertial_deg_s": degrees(largest(rate_of(curves.rate_inertial))),
        "residual_hz": largest(curves.residual_doppler),
        **{
            f"swath_{index}": largest(curves.swath_doppler[:, index])
            for index in range(case.case.swath_offsets.size)
        },
        "hz_per_centidegree": largest(curves.pointing_sensitivity) * POINTING_STEP,
        "incidence": _incidences(finite),
        "solved": solved(curves),
        "reason": unsolved_reason(curves) or "",
    }


def _incidences(values: Array) -> tuple[float, float]:
    if values.size == 0:
        return math.nan, math.nan
    return math.degrees(values.min()), math.degrees(values.max())


def selection_frame(selections: Sequence[Selection]) -> pd.DataFrame:
    """Both laws over altitude and inclination, a row for each point of each selection."""
    return pd.concat([_selection_rows(one) for one in selections], ignore_index=True)


def _selection_rows(selection: Selection) -> pd.DataFrame:
    shape = selection.steering_angle.shape
    laws = np.array([law.value for law in selection.laws])[:, None, None]
    inclinations = np.rad2deg(selection.inclinations)[:, None]
    columns = {
        "law": laws,
        "inclination_deg": inclinations,
        "altitude_m": selection.altitudes,
        "steering_angle_deg": np.rad2deg(selection.steering_angle),
        "slew_time_s": selection.slew_time,
        "rate_deg_s": np.rad2deg(selection.rate),
        "pointing_sensitivity_hz_deg": selection.pointing_sensitivity * math.radians(1.0),
        "swath_doppler_hz": selection.swath_doppler,
    }
    frame = pd.DataFrame(
        {name: np.broadcast_to(values, shape).ravel() for name, values in columns.items()}
    )
    frame.insert(0, "held", selection.held.value)
    frame.insert(1, "boresight_deg", math.degrees(selection.boresight_angle))
    return frame


def crossover_frame(selections: Sequence[Selection]) -> pd.DataFrame:
    """Altitudes at which the steering angles are equal, a row for each inclination."""
    return pd.DataFrame(
        [
            {
                "selection": selection,
                "inclination_deg": math.degrees(inclination),
                "crossovers": crossovers,
            }
            for selection in selections
            for inclination, crossovers in zip(
                selection.inclinations, selection.crossovers, strict=True
            )
        ]
    )


def compensation_frame(compensation: Compensation) -> pd.DataFrame:
    """Exact and simplified Doppler of every effect, a row for each sample."""
    return pd.concat(
        [
            pd.DataFrame(
                {
                    "effect": curve.effect.value,
                    "eccentricity": curve.eccentricity,
                    "argument_of_perigee_deg": math.degrees(curve.argument_of_perigee),
                    "argument_of_latitude_deg": np.rad2deg(curve.argument_of_latitude),
                    "exact_m_s": curve.exact,
                    "simplified_m_s": curve.simplified,
                }
            )
            for curve in compensation.curves
        ],
        ignore_index=True,
    )


def effects_frame(compensation: Compensation) -> pd.DataFrame:
    """What each effect leaves, a row for each."""
    return pd.DataFrame(
        [
            {
                "curve": curve,
                "eccentricity": curve.eccentricity,
                "exact_m_s": largest(curve.exact),
                "deviation_m_s": largest(curve.exact - curve.simplified),
                "compensation": curve.compensation,
                "compensation_rms": curve.compensation_rms,
            }
            for curve in compensation.curves
        ]
    )


def claims_frame(claims: Sequence[Claim]) -> pd.DataFrame:
    """Printed figures and their verdicts."""
    return pd.DataFrame(
        [claim._asdict() | {"verdict": claim.verdict.value} for claim in claims],
        columns=list(Claim._fields),
    )


def steering_tables(result: SteeringResult) -> dict[str, pd.DataFrame]:
    """Tables by the name of their file."""
    tables = {"steering.csv": steering_frame(result.cases)}
    if result.selections:
        tables["selection.csv"] = selection_frame(result.selections)
    if result.compensation is not None:
        tables["compensation.csv"] = compensation_frame(result.compensation)
    if result.claims:
        tables["claims.csv"] = claims_frame(result.claims)
    return tables
