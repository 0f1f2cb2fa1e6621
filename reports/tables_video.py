"""Tables of a film, in degrees where people read them."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from insar.observe.agile.video_results import Staring, VideoResult

from .agile_words import yaw_law_name
from .tables_spotlight import profile_columns
from .tables_steering import claims_frame

MODELS = ("exact", "hyperbolic")


def video_frame(result: VideoResult) -> pd.DataFrame:
    """Attitude, footprint and pointing errors, a row for each sample."""
    profile, left, pointing = result.profile, result.distortion, result.pointing
    turns = ("azimuth_trace", "range_trace", "major_axis", "shear")
    return pd.DataFrame(
        {
            "time_s": result.times,
            "roll_deg": np.rad2deg(profile.roll),
            "pitch_deg": np.rad2deg(profile.pitch),
            "yaw_deg": np.rad2deg(profile.yaw),
            **profile_columns(profile),
            "rate_exceeded": profile.rate_exceeded,
            "acceleration_exceeded": profile.acceleration_exceeded,
            **{f"{name}_deg": np.rad2deg(getattr(left, name)) for name in turns},
            "azimuth_stretch": left.azimuth_stretch,
            "range_stretch": left.range_stretch,
            "area_ratio": left.area,
            **{
                f"center_{to}_per_{axis}_m_deg": np.radians(
                    pointing.center_per_turn[:, row, column]
                )
                for row, to in enumerate(("east", "north"))
                for column, axis in enumerate("xyz")
            },
            **{
                f"rotation_per_{axis}": pointing.rotation_per_turn[:, column]
                for column, axis in enumerate("xyz")
            },
            "center_error_m": pointing.center,
            "rotation_error_deg": np.rad2deg(pointing.rotation),
            "outcome": [Staring(value).name.lower() for value in profile.outcome],
        }
    )


def frames_frame(result: VideoResult) -> pd.DataFrame:
    """How the data are cut, a row for each frame of the film."""
    frames = result.frames
    columns = {
        "frame": np.arange(1, len(frames.times) + 1),
        "time_s": frames.times,
        "squint_deg": np.rad2deg(frames.squint),
    }
    for name in MODELS:
        model = getattr(frames, name)
        columns |= {
            f"{name}_duration_s": model.duration,
            f"{name}_aperture_m": model.length,
            f"{name}_overlap": model.overlap,
            f"{name}_independent_rate_hz": model.independent_rate,
            f"{name}_rate_limit_hz": model.rate_limit,
        }
    return pd.DataFrame(
        {
            **columns,
            "printed_aperture_m": frames.printed_length,
            "ground_resolution_m": frames.ground_resolution,
            "complete": frames.complete,
        }
    )


def footprints_frame(result: VideoResult) -> pd.DataFrame:
    """Corners of the outlines, a row for each."""
    prints = result.footprints
    moments, corners = prints.latitude.shape
    return pd.DataFrame(
        {
            "time_s": np.repeat(prints.times, corners),
            "corner": np.tile(np.arange(1, corners + 1), moments),
            "latitude_deg": np.rad2deg(prints.latitude).ravel(),
            "longitude_deg": np.rad2deg(prints.longitude).ravel(),
        }
    )


def laws_frame(result: VideoResult) -> pd.DataFrame:
    """What every yaw law leaves, a row for each."""
    degrees = ("azimuth_trace", "range_trace", "major_axis", "shear", "yaw")
    return pd.DataFrame(
        [
            {
                "law": summary.law.value,
                "name": yaw_law_name(summary.law),
                **{f"{name}_deg": math.degrees(getattr(summary, name)) for name in degrees},
                "rate_orbit_deg_s": math.degrees(summary.rate_orbit),
                "rate_inertial_deg_s": math.degrees(summary.rate_inertial),
                "common_area": summary.common_area,
                "solved_fraction": summary.solved,
            }
            for summary in result.laws
        ]
    )


def pointing_frame(result: VideoResult) -> pd.DataFrame:
    """What a turn about each axis does, at the start, in the middle and at the end."""
    effect = result.pointing
    middle = int(np.argmin(np.abs(result.times)))
    return pd.DataFrame(
        [
            {
                "time_s": result.times[index],
                "axis": axis.upper(),
                "error_deg": math.degrees(result.request.pointing_error[column]),
                "east_m_deg": math.radians(effect.center_per_turn[index, 0, column]),
                "north_m_deg": math.radians(effect.center_per_turn[index, 1, column]),
                "rotation": effect.rotation_per_turn[index, column],
            }
            for index in sorted({0, middle, len(result.times) - 1})
            for column, axis in enumerate("xyz")
        ]
    )


def video_tables(result: VideoResult) -> dict[str, pd.DataFrame]:
    """Tables by the name of their file."""
    tables = {
        "video.csv": video_frame(result),
        "frames.csv": frames_frame(result),
        "footprints.csv": footprints_frame(result),
        "yaw_laws.csv": laws_frame(result).drop(columns="name"),
    }
    if result.claims:
        tables["claims.csv"] = claims_frame(result.claims)
    return tables
