"""Runs a study of kind `spotlight`: how a satellite turns to image a place, and what it sees."""

from __future__ import annotations

import dataclasses
import math

from configs import SpotlightStudy
from configs.staring import SpotlightSetup
from insar.observe.agile.spotlight import spotlight
from insar.observe.agile.spotlight_claims import judge_spotlight
from insar.observe.agile.spotlight_results import SpotlightResult
from reports.agile_words import pointing_reason

from .outcome import Options, Outcome, Summary
from .shown import agility, largest, largest_degrees, moment


def run(study: SpotlightStudy, setup: SpotlightSetup, options: Options) -> Outcome:
    """Compute the attitude, the rates and the echo of a study, and judge its claims.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line; nothing here is random.
    """
    result = spotlight(setup.request, setup.samples)
    claims = tuple(judge_spotlight(claim, result) for claim in setup.claims)
    return Outcome(
        result=dataclasses.replace(result, claims=claims),
        summary=_summary(result),
        orbit=setup.orbit,
    )


def _summary(result: SpotlightResult) -> Summary:
    """When, for how long, how sharp, and what it takes."""
    plan, profile, history = result.plan, result.profile, result.history
    why = pointing_reason(profile.outcome)
    side = plan.side.name.lower()
    heading = "northward" if plan.ascending else "southward"
    rows = (
        ("zero Doppler", moment(plan.epoch)),
        ("pass", f"{plan.number} of {plan.passes}, flying {heading}, looking {side}"),
        ("incidence", f"{math.degrees(plan.incidence):.2f}°"),
        ("imaging time", f"{plan.imaging_time:.3f} s"),
        ("aperture time, first order", f"{plan.first_order_time:.3f} s"),
        ("resolution in azimuth", f"{history.resolution:.3f} m of {history.bandwidth:.0f} Hz"),
        ("largest yaw", f"{largest_degrees(profile.yaw)}°"),
        ("largest pitch", f"{largest_degrees(profile.pitch)}°"),
        ("largest roll", f"{largest_degrees(profile.roll)}°"),
        ("largest rate, inertial", f"{largest_degrees(profile.rate_inertial)}°/s"),
        ("largest acceleration, inertial", f"{largest_degrees(profile.acceleration_inertial)}°/s²"),
        ("agility", agility(profile, result.request.agility, why)),
        ("largest aim error", f"{largest(result.aim_error.closed_form):.1e} m"),
    )
    return Summary(
        headings=("spotlight",),
        rows=tuple((label, (text,)) for label, text in rows),
        warnings=result.warnings,
    )
