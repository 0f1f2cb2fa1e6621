"""Tables of a spotlight imaging, in degrees where people read them."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from insar.observe.agile.profiles import Profile
from insar.observe.agile.spotlight_results import Pointing, SpotlightResult

from .tables_steering import claims_frame, largest, least, rate_of

Array = NDArray[np.float64]

_QUATERNION = ("i", "j", "k", "scalar")


def profile_columns(profile: Profile) -> dict[str, Array]:
    """Quaternions, rates and accelerations, a column for each part."""
    columns: dict[str, Array] = {}
    for frame in ("orbit", "inertial"):
        values = getattr(profile, f"quaternion_{frame}")
        for index, part in enumerate(_QUATERNION):
            columns[f"quaternion_{frame}_{part}"] = values[:, index]
    for what, unit in (("rate", "deg_s"), ("acceleration", "deg_s2")):
        for frame in ("orbit", "inertial"):
            values = np.rad2deg(getattr(profile, f"{what}_{frame}"))
            for index, axis in enumerate("xyz"):
                columns[f"{what}_{frame}_{axis}_{unit}"] = values[:, index]
    return columns


def spotlight_frame(result: SpotlightResult) -> pd.DataFrame:
    """The imaging, a row for each sample."""
    profile, history = result.profile, result.history
    errors = result.aim_error._asdict()
    return pd.DataFrame(
        {
            "time_s": result.times,
            "yaw_deg": np.rad2deg(profile.yaw),
            "pitch_deg": np.rad2deg(profile.pitch),
            "roll_deg": np.rad2deg(profile.roll),
            **profile_columns(profile),
            "rate_exceeded": profile.rate_exceeded,
            "acceleration_exceeded": profile.acceleration_exceeded,
            **{f"aim_error_{name}_m": values for name, values in errors.items()},
            "slant_range_m": history.slant_range,
            "doppler_hz": history.doppler,
            "latitude_deg": np.rad2deg(history.latitude),
            "longitude_deg": np.rad2deg(history.longitude),
            "outcome": [Pointing(value).name.lower() for value in profile.outcome],
        }
    )


def turns_frame(profile: Profile, angles: tuple[str, ...]) -> pd.DataFrame:
    """Range and largest values of the angles and of the rates about each axis."""
    rows = [
        {
            "what": name.capitalize(),
            "low": math.degrees(least(values)),
            "high": -math.degrees(least(-values)),
            "unit": "°",
        }
        for name in angles
        for values in [getattr(profile, name)]
    ]
    frame = pd.DataFrame(rows)
    frame["swing"] = frame["high"] - frame["low"]
    return frame


def axes_frame(profile: Profile) -> pd.DataFrame:
    """Largest rate and acceleration about each axis and in magnitude, in either frame."""
    rows = []
    for what, unit in (("rate", "°/s"), ("acceleration", "°/s²")):
        for frame, name in (("orbit", "against the orbit frame"), ("inertial", "inertial")):
            values = getattr(profile, f"{what}_{frame}")
            rows.append(
                {
                    "what": f"{what.capitalize()}, {name}",
                    "unit": unit,
                    **{axis: math.degrees(largest(values[:, i])) for i, axis in enumerate("xyz")},
                    "magnitude": math.degrees(largest(rate_of(values))),
                }
            )
    return pd.DataFrame(rows)


def quaternions_frame(times: Array, profile: Profile) -> pd.DataFrame:
    """Quaternions at the start, in the middle and at the end, a row for each frame."""
    middle = int(np.argmin(np.abs(times)))
    rows = []
    for frame, name in (("orbit", "orbit frame"), ("inertial", "GCRS")):
        values = getattr(profile, f"quaternion_{frame}")
        for index in sorted({0, middle, len(times) - 1}):
            rows.append(
                {
                    "frame": name,
                    "time_s": times[index],
                    **dict(zip(_QUATERNION, values[index], strict=True)),
                }
            )
    return pd.DataFrame(rows)


def spotlight_tables(result: SpotlightResult) -> dict[str, pd.DataFrame]:
    """Tables by the name of their file."""
    tables = {"spotlight.csv": spotlight_frame(result)}
    if result.claims:
        tables["claims.csv"] = claims_frame(result.claims)
    return tables
