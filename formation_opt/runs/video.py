"""Runs a study of kind `video`: how a satellite turns to film a place, frames and footprints."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from configs import VideoStudy
from configs.staring import VideoSetup
from insar.observe.agile.video import video
from insar.observe.agile.video_claims import judge_video
from insar.observe.agile.video_results import VideoResult
from reports.agile_words import staring_reason

from .outcome import Options, Outcome, Summary
from .shown import agility, largest_degrees, moment


def run(study: VideoStudy, setup: VideoSetup, options: Options) -> Outcome:
    """Compute attitude, frames and footprints of a study, and judge its claims.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line; nothing here is random.
    """
    result = video(setup.request, setup.samples, setup.footprints)
    claims = tuple(judge_video(claim, result) for claim in setup.claims)
    return Outcome(
        result=dataclasses.replace(result, claims=claims),
        summary=_summary(result),
        orbit=setup.orbit,
    )


def _summary(result: VideoResult) -> Summary:
    """When, how many frames, what it takes, and what the yaw law leaves."""
    plan, profile, frames, left = result.plan, result.profile, result.frames, result.distortion
    why = staring_reason(profile.outcome)
    rows = (
        ("zero Doppler", moment(plan.epoch)),
        ("incidence", f"{math.degrees(plan.incidence):.2f}°"),
        ("frames", f"{len(frames.times)}, {np.count_nonzero(frames.complete)} complete"),
        ("frames without common data up to", f"{_least(frames.exact.independent_rate):.3g} Hz"),
        ("largest roll", f"{largest_degrees(profile.roll)}°"),
        ("largest pitch", f"{largest_degrees(profile.pitch)}°"),
        ("largest yaw", f"{largest_degrees(profile.yaw)}°"),
        ("largest rate, inertial", f"{largest_degrees(profile.rate_inertial)}°/s"),
        ("agility", agility(profile, result.request.agility, why)),
        ("azimuth trace turns by", f"{largest_degrees(left.azimuth_trace)}°"),
        ("range trace turns by", f"{largest_degrees(left.range_trace)}°"),
        ("shear of the footprint", f"{largest_degrees(left.shear)}°"),
    )
    law = result.request.yaw_law.value.replace("_", " ")
    return Summary(
        headings=(law,),
        rows=tuple((label, (text,)) for label, text in rows),
        warnings=result.warnings,
    )


def _least(values: NDArray[np.float64]) -> float:
    """Smallest value; NaN where there is none."""
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else math.nan
