"""Tables of an observation: the segments, and the targets that the pass does not see."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import timedelta

import numpy as np
import pandas as pd

from insar.observe import Observation


def observation_tables(observation: Observation | None) -> Mapping[str, pd.DataFrame]:
    """Tables by the name of their file; none without an observation."""
    return {} if observation is None else {"segments.csv": segments_frame(observation)}


def segments_frame(observation: Observation) -> pd.DataFrame:
    """Where and when each segment is seen, and from where."""
    scene = observation.scene
    moments = [observation.epoch + timedelta(seconds=float(time)) for time in scene.times]
    return pd.DataFrame(
        {
            "segment": np.arange(1, len(scene) + 1),
            "utc": [moment.strftime("%Y-%m-%dT%H:%M:%S.%fZ") for moment in moments],
            "time_s": scene.times,
            "latitude_deg": np.rad2deg(observation.latitude),
            "longitude_deg": np.rad2deg(observation.longitude),
            "height_m": observation.height,
            "slant_range_m": scene.slant_range,
            "look_deg": np.rad2deg(scene.look_angle),
            "incidence_deg": np.rad2deg(scene.incidence),
            "azimuth_deg": np.rad2deg(scene.azimuth),
            "doppler_hz": observation.doppler,
            "off_boresight_deg": np.rad2deg(observation.off_boresight),
        }
    )


def missed_frame(observation: Observation) -> pd.DataFrame:
    """Why targets are not seen, and how many for each reason, the most frequent first."""
    reasons = pd.Series(observation.missed_reasons, dtype=str)
    counts = reasons.value_counts(sort=False)
    counts = counts.sort_values(ascending=False, kind="stable")
    return pd.DataFrame({"reason": counts.index.astype(str), "targets": counts.to_numpy()})
