"""Results of a study of kind ``steering``; the curves themselves are in ``steering.csv``."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from insar.observe import CaseResult, Compensation, LawCurves, Selection, SteeringResult

from .json_claims import claims_json
from .json_numbers import Json, finite, finite_list
from .json_observation import boresight_json
from .steering_words import solved, unsolved_reason
from .tables_steering import largest, rate_of


def steering_json(result: SteeringResult) -> Json:
    """Largest values of each law, the selections, the compensation and the verdicts."""
    compensation = result.compensation
    return {
        "steering": {
            "cases": [_case(case) for case in result.cases],
            "selections": [_selection(one) for one in result.selections],
            "compensation": None if compensation is None else _compensation(compensation),
            "claims": claims_json(result.claims),
        },
        "warnings": list(result.warnings),
    }


def _case(case: CaseResult) -> Json:
    return {
        "name": case.name,
        "semi_major_axis_m": finite(case.semi_major_axis),
        "eccentricity": finite(case.eccentricity),
        "inclination_rad": finite(case.inclination),
        "epoch_utc": case.case.trajectory.epoch.isoformat(),
        "duration_s": finite(case.case.times[-1] - case.case.times[0]),
        "samples": case.case.times.size,
        "wavelength_m": finite(case.case.wavelength),
        "side": case.case.side.name.lower(),
        "boresight": boresight_json(case.case.boresight),
        "swath_offsets_rad": finite_list(case.case.swath_offsets),
        "laws": [_law(curves) for curves in case.curves],
    }


def _law(curves: LawCurves) -> Json:
    incidence = curves.incidence[np.isfinite(curves.incidence)]
    return {
        "law": curves.law.value,
        "max_yaw_rad": finite(largest(curves.yaw)),
        "max_pitch_rad": finite(largest(curves.pitch)),
        "max_roll_rad": finite(largest(curves.roll)),
        "max_steering_rad": finite(largest(curves.steering_angle)),
        "max_rate_orbit_rad_s": finite(largest(rate_of(curves.rate_orbit))),
        "max_rate_inertial_rad_s": finite(largest(rate_of(curves.rate_inertial))),
        "max_residual_doppler_hz": finite(largest(curves.residual_doppler)),
        "max_swath_doppler_hz": [finite(largest(column)) for column in curves.swath_doppler.T],
        "max_pointing_sensitivity_hz_rad": finite(largest(curves.pointing_sensitivity)),
        "min_incidence_rad": finite(incidence.min(initial=np.inf)),
        "max_incidence_rad": finite(incidence.max(initial=-np.inf)),
        "solved_fraction": solved(curves),
        "reason": unsolved_reason(curves),
    }


def _selection(selection: Selection) -> Json:
    unsolved = bool(np.any(np.isnan(selection.steering_angle)))
    return {
        "held": selection.held.value,
        "boresight_rad": finite(selection.boresight_angle),
        "eccentricity": finite(selection.eccentricity),
        "argument_of_perigee_rad": finite(selection.argument_of_perigee),
        "slew_rate_rad_s": finite(selection.slew_rate),
        "swath_offset_rad": finite(selection.swath_offset),
        "altitudes_m": finite_list(selection.altitudes),
        "inclinations_rad": finite_list(selection.inclinations),
        "laws": [
            {
                "law": law.value,
                "steering_rad": _grid(selection.steering_angle[index]),
                "slew_time_s": _grid(selection.slew_time[index]),
                "rate_rad_s": _grid(selection.rate[index]),
                "pointing_sensitivity_hz_rad": _grid(selection.pointing_sensitivity[index]),
                "swath_doppler_hz": _grid(selection.swath_doppler[index]),
            }
            for index, law in enumerate(selection.laws)
        ],
        "crossovers_m": [finite_list(found) for found in selection.crossovers],
        "reason": "a law has no solution all around the orbit where its values are null"
        if unsolved
        else None,
    }


def _grid(values: NDArray[np.float64]) -> list[list[float | None]]:
    return [finite_list(row) for row in values]


def _compensation(compensation: Compensation) -> Json:
    return {
        "semi_major_axis_m": finite(compensation.semi_major_axis),
        "inclination_rad": finite(compensation.inclination),
        "look_rad": finite(compensation.look_angle),
        "side": compensation.side.name.lower(),
        "effects": [
            {
                "effect": curve.effect.value,
                "eccentricity": finite(curve.eccentricity),
                "argument_of_perigee_rad": finite(curve.argument_of_perigee),
                "max_exact_m_s": finite(largest(curve.exact)),
                "max_deviation_m_s": finite(largest(curve.exact - curve.simplified)),
                "compensation": finite(curve.compensation),
                "compensation_rms": finite(curve.compensation_rms),
            }
            for curve in compensation.curves
        ],
        "sweep": [
            {
                "eccentricity": finite(eccentricity),
                "compensation": finite(by_maximum),
                "compensation_rms": finite(by_rms),
                "max_deviation_m_s": finite(deviation),
            }
            for eccentricity, by_maximum, by_rms, deviation in zip(
                compensation.eccentricities,
                compensation.sweep,
                compensation.sweep_rms,
                compensation.sweep_deviation,
                strict=True,
            )
        ],
    }
