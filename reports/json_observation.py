"""The observation behind a scene, for ``result.json``."""

from __future__ import annotations

from insar.observe import Boresight, FixedIncidence, Observation

from .json_numbers import Json, finite


def observation_json(observation: Observation) -> Json:
    """Which pass is taken, and what it sees."""
    return {
        "epoch_utc": observation.epoch.isoformat(),
        "side": observation.side.name.lower(),
        "law": observation.law.value,
        "boresight": boresight_json(observation.boresight),
        "reference": observation.reference.value,
        "semi_major_axis_m": finite(observation.orbit.semi_major_axis),
        "inclination_rad": finite(observation.orbit.inclination),
        "eccentricity": finite(observation.eccentricity),
        "ascending": observation.ascending,
        "passes": observation.passes,
        "pass_number": observation.revolution,
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
    return [
        {name: finite(values[index]) for name, values in columns.items()}
        for index in range(len(scene))
    ]
