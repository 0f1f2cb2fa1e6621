"""Verdict on a film: whether the satellite can make it, at which frame rate, and what turns."""

from __future__ import annotations

import math

import numpy as np

from insar.observe.agile.video_results import LawSummary, VideoResult

from ..agile_words import common_reason, heading_name, side_name, staring_reason, yaw_law_name
from ..document import Block, Callout, Metric, Metrics, Status, Strong, Text
from ..reading_agile import exceeds, is_limited
from ..tables_steering import largest, least
from ..wording import (
    MISSING,
    counted,
    fixed,
    latitude_text,
    longitude_text,
    moment_text,
    or_zero,
    percent,
    plain,
    quantity,
    significant,
)
from .claims import claims_text
from .turning import agility_text, demand_metrics, exceeded_share

_ROUNDING = 1e-6
"""Rotation [°] below which a direction is held."""


def video_verdict(result: VideoResult) -> tuple[Block, ...]:
    """Verdict on a film."""
    status, title = _title(result)
    paragraphs: list[Text] = [_when(result), _frames(result), _turns(result)]
    paragraphs.append(agility_text(result.profile, result.request.agility))
    reason = staring_reason(result.profile.outcome)
    if reason is not None:
        paragraphs.append((Strong("Not pointed for part of the film: "), f"{reason}."))
    paragraphs += claims_text(result.claims, "inputs of this study")
    return Callout(status, title, tuple(paragraphs)), _metrics(result)


def shared_too_much(result: VideoResult) -> bool:
    """Whether frames have more data in common than is allowed."""
    allowed = result.request.max_overlap
    return largest(result.frames.exact.overlap) > allowed * (1.0 + 1e-9)


def _title(result: VideoResult) -> tuple[Status, str]:
    if exceeds(result.profile):
        share = percent(exceeded_share(result.profile))
        return Status.BAD, f"The satellite is not agile enough for {share} of the film"
    if staring_reason(result.profile.outcome) is not None:
        return Status.WARNING, "The beam cannot be held for all of the film"
    if shared_too_much(result) and result.request.max_overlap:
        return Status.WARNING, "Frames have more data in common than is allowed"
    if is_limited(result.request.agility):
        overlap = " and the allowed overlap" if result.request.max_overlap else ""
        return Status.GOOD, f"The film is within the agility{overlap}"
    return Status.NOTE, "The beam is held for all of the film; no limits of agility are given"


def _when(result: VideoResult) -> Text:
    plan, request = result.plan, result.request
    return (
        f"{latitude_text(math.degrees(request.latitude), 2)}, "
        f"{longitude_text(math.degrees(request.longitude), 2)} is filmed for "
        f"{plain(request.duration)} s about zero Doppler at ",
        Strong(f"{moment_text(plan.epoch)} UTC"),
        f", from a satellite that flies {heading_name(ascending=plan.ascending)} and sees it to "
        f"the {side_name(plan.side)} at an incidence of {fixed(math.degrees(plan.incidence), 2)}°.",
    )


def _frames(result: VideoResult) -> Text:
    frames, request = result.frames, result.request
    complete = int(np.count_nonzero(frames.complete))
    independent = least(frames.exact.independent_rate)
    text: tuple[str, ...] = (
        f"Of {counted(len(frames.times), 'frame')} of {plain(request.resolution)} m at "
        f"{plain(request.frame_rate)} Hz, {complete} have all their data within the film. Frames "
        "share no data up to ",
        Strong(f"{significant(independent)} Hz"),
    )
    if request.max_overlap:
        limit = least(frames.exact.rate_limit)
        text += (
            f", and at most {percent(request.max_overlap)} of it up to {significant(limit)} Hz",
        )
    shared = largest(frames.exact.overlap)
    return (
        *text,
        f"; at the rate asked for it is up to {_percent(shared)}. The "
        "hyperbola of the source departs from the real orbit by up to "
        f"{significant(100.0 * _departure(result))} % of a frame's length.",
    )


def _departure(result: VideoResult) -> float:
    return largest(result.frames.hyperbolic.length / result.frames.exact.length - 1.0)


def chosen_law(result: VideoResult) -> LawSummary:
    """What the yaw law of the study leaves."""
    return next(law for law in result.laws if law.law is result.request.yaw_law)


def _turns(result: VideoResult) -> Text:
    law = chosen_law(result)
    return (
        f"Under the yaw law “{yaw_law_name(law.law)}” the footprint's azimuth trace turns by "
        f"{_degrees(law.azimuth_trace)}, its range trace by {_degrees(law.range_trace)} and its "
        f"major axis by {_degrees(law.major_axis)}: no law holds all three, for the footprint "
        f"shears by up to {_degrees(law.shear)}. ",
        *_common(law, common_reason(result)),
    )


def _common(law: LawSummary, why: str | None) -> tuple[str, ...]:
    """What is seen all the time, or why that is not known."""
    if not math.isfinite(law.common_area):
        return (f"What is seen all the time is not known: {why}.",)
    return (
        Strong(_capital(_share(law.common_area))),
        " of the footprint at the reference time is seen all the time"
        + ("." if law.solved == 1.0 else " that the beam is held."),
    )


def _degrees(angle: float) -> str:
    """Angle with its unit, exactly nothing where it is rounding."""
    if not math.isfinite(angle):
        return MISSING
    return f"{or_zero(math.degrees(angle), _ROUNDING)}°"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _share(share: float) -> str:
    if not math.isfinite(share):
        return "not known how much is"
    return "nothing" if share == 0.0 else percent(share)


def _metrics(result: VideoResult) -> Metrics:
    law = chosen_law(result)
    independent = least(result.frames.exact.independent_rate)
    return Metrics(
        (
            Metric(
                "Independent frames",
                quantity(significant(independent), "Hz") if math.isfinite(independent) else MISSING,
                f"at most; asked for: {plain(result.request.frame_rate)} Hz",
            ),
            Metric(
                "Data in common",
                _percent(largest(result.frames.exact.overlap)),
                "at most"
                + (
                    f"; allowed: {percent(result.request.max_overlap)}"
                    if result.request.max_overlap
                    else ""
                ),
                Status.BAD
                if result.request.max_overlap and shared_too_much(result)
                else Status.NOTE,
            ),
            *demand_metrics(result.profile, result.request.agility),
            Metric(
                "Shear of footprint",
                _degrees(law.shear),
                f"{yaw_law_name(law.law)}; {_share(law.common_area)} seen all the time",
            ),
        )
    )


def _percent(share: float) -> str:
    return "none" if share == 0.0 else f"{fixed(100.0 * share, 1)}\u00a0%"
