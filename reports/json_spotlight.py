"""Results of a study of kind ``spotlight``; the curves themselves are in ``spotlight.csv``."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from insar.observe.agile.agility import Agility
from insar.observe.agile.plans import PassPlan, SpotlightPlan
from insar.observe.agile.profiles import Profile
from insar.observe.agile.spotlight_results import AimError, SpotlightResult

from .agile_words import pointing_reason, side_name
from .json_claims import claims_json
from .json_numbers import Json, finite, finite_list
from .tables_steering import largest, rate_of

Array = NDArray[np.float64]


def spotlight_json(result: SpotlightResult) -> Json:
    """Moment, maneuver, aim errors, echo and verdicts."""
    request, history = result.request, result.history
    return {
        "spotlight": {
            "target": place_json(request.latitude, request.longitude, request.height),
            "plan": _imaging_json(result.plan),
            "samples": len(result.times),
            "duration_s": finite(np.ptp(result.times)),
            "maneuver": maneuver_json(
                result.profile,
                ("yaw", "pitch", "roll"),
                request.agility,
                pointing_reason(result.profile.outcome),
            ),
            "solved_fraction": float(np.mean(result.profile.outcome == 0)),
            "reason": pointing_reason(result.profile.outcome),
            "aim_error": _aim_error(result.aim_error),
            "iteration_steps": result.iteration.steps,
            "bandwidth_hz": finite(history.bandwidth),
            "resolution_m": finite(history.resolution),
            "first_order_bandwidth_hz": finite(history.first_order_bandwidth),
            "first_order_resolution_m": finite(history.first_order_resolution),
            "range_migration_m": finite(history.range_migration),
            "orbit_misfit_m": finite(result.orbit_misfit),
            "claims": claims_json(result.claims),
        },
        "warnings": list(result.warnings),
    }


def _aim_error(error: AimError) -> Json:
    """Largest aim error of every attitude."""
    found = {f"max_{name}_m": finite(largest(values)) for name, values in error._asdict().items()}
    missed = None in found.values()
    return {**found, "reason": "the beam never meets the Earth where null" if missed else None}


def place_json(latitude: float, longitude: float, height: float) -> Json:
    """A place on the ellipsoid."""
    return {
        "latitude_rad": finite(latitude),
        "longitude_rad": finite(longitude),
        "height_m": finite(height),
    }


def _imaging_json(plan: SpotlightPlan) -> Json:
    """Moment and geometry of zero Doppler, and times."""
    return {
        **plan_json(plan),
        "aperture_time_s": finite(plan.aperture_time),
        "first_order_time_s": finite(plan.first_order_time),
        "imaging_time_s": finite(plan.imaging_time),
    }


def plan_json(plan: PassPlan) -> Json:
    """Moment and geometry of zero Doppler."""
    return {
        "zero_doppler_utc": plan.epoch.isoformat(),
        "pass_number": plan.number,
        "passes": plan.passes,
        "side": side_name(plan.side),
        "ascending": plan.ascending,
        "slant_range_m": finite(plan.slant_range),
        "look_rad": finite(plan.look_angle),
        "incidence_rad": finite(plan.incidence),
        "azimuth_rad": finite(plan.azimuth),
        "doppler_rate_hz_s": finite(plan.doppler_rate),
        "ground_speed_m_s": finite(plan.ground_speed),
    }


def maneuver_json(
    profile: Profile, angles: Sequence[str], agility: Agility | None, reason: str | None
) -> Json:
    """Ranges of the angles, largest rates and accelerations, and what is allowed.

    Parameters
    ----------
    profile : the attitude.
    angles : names of the Euler angles, in their sequence.
    agility : what is allowed; None for anything.
    reason : why samples have no attitude; None where all have.
    """
    return {
        **{f"{name}_rad": _ends(getattr(profile, name)) for name in angles},
        "max_rate_orbit_rad_s": finite(largest(rate_of(profile.rate_orbit))),
        "max_rate_inertial_rad_s": finite(largest(rate_of(profile.rate_inertial))),
        "max_acceleration_orbit_rad_s2": finite(largest(rate_of(profile.acceleration_orbit))),
        "max_acceleration_inertial_rad_s2": finite(largest(rate_of(profile.acceleration_inertial))),
        "rate_limit_rad_s": None if agility is None else _limit(agility.max_rate),
        "acceleration_limit_rad_s2": None if agility is None else _limit(agility.max_acceleration),
        "rate_exceeded_fraction": _known_share(profile, profile.rate_exceeded),
        "acceleration_exceeded_fraction": _known_share(profile, profile.acceleration_exceeded),
        "singular_fraction": _known_share(profile, profile.singular),
        "reason": reason,
    }


def _known_share(profile: Profile, mask: NDArray[np.bool_]) -> float | None:
    """Of the samples that have an attitude; None where none has."""
    return float(np.mean(mask[profile.solved])) if np.any(profile.solved) else None


def _ends(values: Array) -> list[float | None]:
    """Least and largest."""
    known = values[np.isfinite(values)]
    return [finite(known.min(initial=np.inf)), finite(known.max(initial=-np.inf))]


def _limit(limit: float | tuple[float, float, float]) -> float | list[float | None] | None:
    return finite_list(limit) if isinstance(limit, tuple) else finite(limit)
