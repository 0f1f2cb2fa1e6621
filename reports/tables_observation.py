"""Tables of an observation: the segments, and the targets that the pass does not see."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime, timedelta

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from insar import Scene
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene


def observation_tables(
    observation: Observation | StaringScene | None,
) -> Mapping[str, pd.DataFrame]:
    """Tables by the name of their file; none without an observation."""
    if observation is None:
        return {}
    if isinstance(observation, Observation):
        return {"segments.csv": segments_frame(observation)}
    return {"segments.csv": staring_frame(observation)}


def segments_frame(observation: Observation) -> pd.DataFrame:
    """Where and when each segment is seen, and from where."""
    scene = observation.scene
    return pd.DataFrame(
        {
            "segment": np.arange(1, len(scene) + 1),
            "utc": _moments(observation.epoch, scene.times),
            "time_s": scene.times.round(6),
            "latitude_deg": np.rad2deg(observation.latitude),
            "longitude_deg": np.rad2deg(observation.longitude),
            "height_m": observation.height,
            "slant_range_m": scene.slant_range.round(3),
            "look_deg": np.rad2deg(scene.look_angle),
            "incidence_deg": np.rad2deg(scene.incidence),
            "azimuth_deg": np.rad2deg(scene.azimuth),
            "doppler_hz": observation.doppler.round(3) + 0.0,
            "off_boresight_deg": np.rad2deg(observation.off_boresight),
        }
    )


def staring_frame(staring: StaringScene) -> pd.DataFrame:
    """When one place is seen, and from where."""
    scene, request = staring.scene, staring.request
    count = len(scene)
    before = (staring.epoch - staring.plan.epoch).total_seconds()
    return pd.DataFrame(
        {
            "segment": np.arange(1, count + 1),
            "utc": _moments(staring.epoch, scene.times),
            "time_s": scene.times.round(6),
            "since_zero_doppler_s": (scene.times + before).round(6),
            "latitude_deg": np.full(count, np.rad2deg(request.latitude)),
            "longitude_deg": np.full(count, np.rad2deg(request.longitude)),
            "height_m": np.full(count, request.height),
            "slant_range_m": scene.slant_range.round(3),
            "look_deg": np.rad2deg(scene.look_angle),
            "incidence_deg": np.rad2deg(scene.incidence),
            "azimuth_deg": np.rad2deg(scene.azimuth),
            "squint_deg": np.rad2deg(squint(scene)),
        }
    )


def squint(scene: Scene) -> NDArray[np.float64]:
    """Angle of each line of sight ahead of the plane of zero Doppler, (S,) [rad]."""
    ahead = np.sum(scene.line_of_sight * scene.velocity_direction, axis=-1)
    return np.asarray(np.arcsin(np.clip(ahead, -1.0, 1.0)))


def _moments(epoch: datetime, times: NDArray[np.float64]) -> list[str]:
    """Moments in UTC, ISO 8601."""
    moments = [epoch + timedelta(seconds=float(time)) for time in times]
    return [moment.strftime("%Y-%m-%dT%H:%M:%S.%fZ") for moment in moments]


def missed_frame(observation: Observation) -> pd.DataFrame:
    """Why targets are not seen, and how many for each reason, the most frequent first."""
    reasons = pd.Series(observation.missed_reasons, dtype=str)
    counts = reasons.value_counts(sort=False)
    counts = counts.sort_values(ascending=False, kind="stable")
    return pd.DataFrame({"reason": counts.index.astype(str), "targets": counts.to_numpy()})
