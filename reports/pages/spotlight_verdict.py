"""Verdict on a spotlight imaging: whether the satellite can do it, and what it gives."""

from __future__ import annotations

import math

import numpy as np

from insar import Verdict
from insar.observe.agile.spotlight_results import SpotlightResult

from ..agile_words import heading_name, pointing_reason, side_name
from ..document import (
    Block,
    Callout,
    Metric,
    Metrics,
    Status,
    Strong,
    Text,
)
from ..reading_agile import AIM_ROUNDING, exceeds, is_limited
from ..tables_steering import largest
from ..wording import (
    MISSING,
    counted,
    fixed,
    joined,
    latitude_text,
    longitude_text,
    meters,
    moment_text,
    percent,
    plain,
    quantity,
    significant,
)
from .claims import claims_text
from .turning import agility_text, demand_metrics, exceeded_share


def spotlight_verdict(result: SpotlightResult) -> tuple[Block, ...]:
    """Verdict on a spotlight imaging."""
    status, title = _title(result)
    paragraphs: list[Text] = [_when(result), _maneuver(result), _image(result)]
    reason = pointing_reason(result.profile.outcome)
    if reason is not None:
        paragraphs.append((Strong("Not pointed for part of the time: "), f"{reason}."))
    paragraphs += claims_text(result.claims, "inputs of this study")
    return Callout(status, title, tuple(paragraphs)), _metrics(result)


def _title(result: SpotlightResult) -> tuple[Status, str]:
    profile, agility = result.profile, result.request.agility
    if exceeds(profile):
        share = percent(exceeded_share(profile))
        return Status.BAD, f"The satellite is not agile enough for {share} of the time"
    if pointing_reason(profile.outcome) is not None:
        return Status.WARNING, "The beam cannot be pointed all the time"
    kept = "the beam stays on the aim point"
    if result.request.sliding_factor:
        kept = "the beam slides over the scene as wanted"
    if any(claim.verdict is not Verdict.HOLDS for claim in result.claims):
        return Status.WARNING, f"{kept[:1].upper()}{kept[1:]}, but a printed figure does not hold"
    if is_limited(agility):
        return Status.GOOD, f"Within the agility, {kept}"
    return Status.NOTE, f"{kept[:1].upper()}{kept[1:]}; no limits of agility are given"


def _when(result: SpotlightResult) -> Text:
    plan, request = result.plan, result.request
    place = (
        f"{latitude_text(math.degrees(request.latitude), 3)}, "
        f"{longitude_text(math.degrees(request.longitude), 3)}"
    )
    return (
        f"{place} is at zero Doppler at ",
        Strong(f"{moment_text(plan.epoch)} UTC"),
        f", seen to the {side_name(plan.side)} from a satellite that flies "
        f"{heading_name(ascending=plan.ascending)}, at an incidence of "
        f"{fixed(math.degrees(plan.incidence), 2)}° and a slant range of "
        f"{fixed(plan.slant_range / 1e3, 1)} km (pass {plan.number} of {plan.passes} in the time "
        "searched).",
    )


def _maneuver(result: SpotlightResult) -> Text:
    swings = joined(
        [
            f"{name} {significant(math.degrees(_swing(getattr(result.profile, name))))}°"
            for name in ("pitch", "yaw", "roll")
        ]
    )
    return (
        f"Over {plain(float(np.ptp(result.times)))} s the attitude runs through {swings}. "
        + agility_text(result.profile, result.request.agility)
    )


def _swing(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    finite = values[np.isfinite(values)]
    return float(np.ptp(np.unwrap(finite))) if finite.size else math.nan


def _image(result: SpotlightResult) -> Text:
    plan, history, error = result.plan, result.history, result.aim_error
    lost = largest(error.without_both)
    if lost < AIM_ROUNDING:
        aim = "The beam is along the body's Z axis and from the center of mass."
    else:
        without = largest(error.without_phase_center)
        aim = "An attitude that neglects the phase center aims " + (
            f"{meters(without)} beside the point"
            if without >= AIM_ROUNDING
            else "as well, for there is no offset"
        )
        aim += (
            f"; one that neglects the off-axis angle too, {_far(lost)}."
            if math.isfinite(lost)
            else "; one that neglects the off-axis angle too misses the Earth."
        )
    return (
        f"The aperture time of {fixed(plan.aperture_time, 3)} s has a Doppler bandwidth of "
        f"{fixed(history.bandwidth, 0)} Hz, which resolves ",
        Strong(meters(history.resolution)),
        " in azimuth on the ground, as asked for; the formula of first order would take "
        f"{fixed(plan.first_order_time, 3)} s and resolve "
        f"{meters(history.first_order_resolution)}. {aim}",
    )


def _far(distance: float) -> str:
    """Distance in meters, or kilometers beyond ten."""
    return meters(distance) if distance < 1e4 else quantity(significant(distance / 1e3), "km")


def _metrics(result: SpotlightResult) -> Metrics:
    plan, history = result.plan, result.history
    error = largest(result.aim_error.closed_form)
    extra = plan.imaging_time - plan.aperture_time
    return Metrics(
        (
            Metric(
                "Imaging time",
                quantity(fixed(plan.imaging_time, 3), "s"),
                f"of which {fixed(extra, 2)} s slide over the scene"
                if extra > 0.0
                else f"for {plain(result.request.resolution)} m; to first order "
                f"{fixed(plan.first_order_time, 3)} s",
            ),
            Metric(
                "Azimuth resolution",
                meters(history.resolution),
                f"of {fixed(history.bandwidth, 0)} Hz",
            ),
            *demand_metrics(result.profile, result.request.agility),
            Metric(
                "Largest aim error",
                _aim(error),
                f"iteration: the same after {counted(result.iteration.steps, 'step')}",
                Status.GOOD if error < AIM_ROUNDING else Status.NOTE,
            ),
        )
    )


def _aim(error: float) -> str:
    if not math.isfinite(error):
        return MISSING
    return f"< {plain(AIM_ROUNDING)}\u00a0m" if error < AIM_ROUNDING else meters(error)
