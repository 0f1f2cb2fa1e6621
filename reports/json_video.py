"""Results of a study of kind ``video``; curves, frames and outlines are in the CSV files."""

from __future__ import annotations

import numpy as np

from insar.observe.agile.video_results import FrameModel, LawSummary, VideoResult

from .agile_words import common_reason, staring_reason
from .json_claims import claims_json
from .json_numbers import Json, finite
from .json_spotlight import maneuver_json, place_json, plan_json
from .tables_steering import largest, least


def video_json(result: VideoResult) -> Json:
    """Moment, maneuver, frames, what each yaw law leaves, footprints and pointing errors."""
    request, frames, prints = result.request, result.frames, result.footprints
    return {
        "video": {
            "target": place_json(request.latitude, request.longitude, request.height),
            "plan": plan_json(result.plan),
            "samples": len(result.times),
            "duration_s": finite(request.duration),
            "yaw_law": request.yaw_law.value,
            "reference_time_s": finite(request.reference_time),
            "maneuver": maneuver_json(
                result.profile,
                ("roll", "pitch", "yaw"),
                request.agility,
                staring_reason(result.profile.outcome),
            ),
            "solved_fraction": float(np.mean(result.profile.outcome == 0)),
            "reason": staring_reason(result.profile.outcome),
            "frames": {
                "count": len(frames.times),
                "complete": int(np.count_nonzero(frames.complete)),
                "frame_rate_hz": finite(request.frame_rate),
                "max_overlap": finite(request.max_overlap),
                "bandwidth_hz": finite(frames.bandwidth),
                "effective_speed_m_s": finite(frames.effective_speed),
                "exact": _model(frames.exact),
                "hyperbolic": _model(frames.hyperbolic),
                "max_hyperbolic_departure": finite(
                    largest(frames.hyperbolic.length / frames.exact.length - 1.0)
                ),
                "max_ground_resolution_m": finite(largest(frames.ground_resolution)),
                "reason": None
                if np.all(np.isfinite(frames.exact.duration))
                else "the Doppler does not run through the bandwidth of a frame",
            },
            "yaw_laws": [_law(law) for law in result.laws],
            "footprints": {
                "count": len(prints.times),
                "max_area_m2": finite(largest(prints.area)),
                "common_area_m2": finite(prints.common_area),
                "reason": common_reason(result),
            },
            "pointing": {
                "error_rad": [finite(error) for error in request.pointing_error],
                "max_center_m": finite(largest(result.pointing.center)),
                "max_rotation_rad": finite(largest(result.pointing.rotation)),
            },
            "orbit_misfit_m": finite(result.orbit_misfit),
            "claims": claims_json(result.claims),
        },
        "warnings": list(result.warnings),
    }


def _model(model: FrameModel) -> Json:
    """Ends of what a model of the frames gives."""
    return {
        "min_duration_s": finite(least(model.duration)),
        "max_duration_s": finite(largest(model.duration)),
        "max_aperture_m": finite(largest(model.length)),
        "max_overlap": finite(largest(model.overlap)),
        "min_independent_rate_hz": finite(least(model.independent_rate)),
        "min_rate_limit_hz": finite(least(model.rate_limit)),
    }


def _law(summary: LawSummary) -> Json:
    return {
        "law": summary.law.value,
        "max_azimuth_trace_rad": finite(summary.azimuth_trace),
        "max_range_trace_rad": finite(summary.range_trace),
        "max_major_axis_rad": finite(summary.major_axis),
        "max_shear_rad": finite(summary.shear),
        "max_yaw_rad": finite(summary.yaw),
        "max_rate_orbit_rad_s": finite(summary.rate_orbit),
        "max_rate_inertial_rad_s": finite(summary.rate_inertial),
        "common_area_fraction": finite(summary.common_area),
        "solved_fraction": finite(summary.solved),
        "reason": _law_reason(summary),
    }


def _law_reason(summary: LawSummary) -> str | None:
    """Why something of a law is null, or of part of the film only."""
    if summary.solved < 1.0:
        return "the law has no solution at some samples"
    if not np.isfinite(summary.common_area):
        return "the beam reaches past the horizon"
    return None
