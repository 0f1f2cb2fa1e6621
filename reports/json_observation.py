"""The observation behind a scene, for ``result.json``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from insar.observe import Boresight, FixedIncidence, Observation
from insar.observe.agile.staring import StaringScene

from .json_numbers import Json, finite
from .tables_observation import squint


def observation_json(observation: Observation | StaringScene) -> Json:
    """Which pass is taken, and what it sees."""
    if isinstance(observation, Observation):
        return _pass(observation)
    return _staring(observation)


def _pass(observation: Observation) -> Json:
    return {
        "epoch_utc": observation.epoch.isoformat(),
        **_orbit(observation),
        "side": observation.side.name.lower(),
        "law": observation.law.value,
        "boresight": boresight_json(observation.boresight),
        "reference": observation.reference.value,
        "ascending": observation.ascending,
        "passes": observation.passes,
        "pass_number": observation.pass_number,
        "near_incidence_rad": finite(observation.near_incidence),
        "far_incidence_rad": finite(observation.far_incidence),
        "segments": _segments(observation),
        "missed": [
            {"latitude_rad": finite(lat), "longitude_rad": finite(lon), "reason": reason}
            for lat, lon, reason in zip(
                observation.missed_latitude,
                observation.missed_longitude,
                observation.missed_reasons,
                strict=True,
            )
        ],
    }


def _orbit(observation: Observation | StaringScene) -> Json:
    return {
        "orbit_source": observation.orbit_source,
        "orbit_epoch_utc": observation.orbit_epoch.isoformat(),
        "semi_major_axis_m": finite(observation.orbit.semi_major_axis),
        "inclination_rad": finite(observation.orbit.inclination),
        "eccentricity": finite(observation.eccentricity),
    }


def _staring(staring: StaringScene) -> Json:
    """One place that is watched."""
    plan, request, scene = staring.plan, staring.request, staring.scene
    columns = {
        "time_s": scene.times,
        "slant_range_m": scene.slant_range,
        "look_rad": scene.look_angle,
        "incidence_rad": scene.incidence,
        "azimuth_rad": scene.azimuth,
        "squint_rad": squint(scene),
    }
    return {
        "epoch_utc": staring.epoch.isoformat(),
        **_orbit(staring),
        "side": plan.side.name.lower(),
        "ascending": plan.ascending,
        "passes": plan.passes,
        "pass_number": plan.number,
        "place": {
            "latitude_rad": finite(request.latitude),
            "longitude_rad": finite(request.longitude),
            "height_m": finite(request.height),
        },
        "zero_doppler_utc": plan.epoch.isoformat(),
        "duration_s": finite(staring.duration),
        "segments": _rows(columns, len(scene)),
    }


def boresight_json(boresight: Boresight) -> Json:
    """What a boresight holds constant."""
    held = "incidence" if isinstance(boresight, FixedIncidence) else "look"
    return {"held": held, "angle_rad": finite(boresight.angle)}


def _segments(observation: Observation) -> list[Json]:
    scene = observation.scene
    columns = {
        "time_s": scene.times,
        "latitude_rad": observation.latitude,
        "longitude_rad": observation.longitude,
        "height_m": observation.height,
        "slant_range_m": scene.slant_range,
        "look_rad": scene.look_angle,
        "incidence_rad": scene.incidence,
        "azimuth_rad": scene.azimuth,
        "doppler_hz": observation.doppler,
        "off_boresight_rad": observation.off_boresight,
    }
    return _rows(columns, len(scene))


def _rows(columns: Mapping[str, NDArray[np.float64]], count: int) -> list[Json]:
    return [
        {name: finite(values[index]) for name, values in columns.items()} for index in range(count)
    ]
