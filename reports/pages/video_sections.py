"""Sections of a film: the pass, its frames, attitude."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from insar.observe.agile.video_request import YawLaw
from insar.observe.agile.video_results import VideoResult

from ..agile_words import heading_name, side_name
from ..document import Block, Column, Figure, Paragraph, Section, Table
from ..figures.video import frames_figure
from ..reading_agile import passage_of
from ..wording import (
    MISSING,
    fixed,
    moment_text,
    once,
    percent,
    significant,
    to_decimals,
)
from .closing import facts
from .turning import attitude_blocks, pass_figure

_ANGLES = ("roll", "pitch", "yaw")
"""In the order of the sequence 1-2-3."""


def frames_section(result: VideoResult) -> Section:
    """How the data are cut."""
    frames, request = result.frames, result.request
    fifth = (
        f"(e) the frame rate at which {percent(request.max_overlap)} of it is"
        if request.max_overlap
        else "(e) squint"
    )
    return Section(
        "frames",
        "Frames",
        (
            Paragraph(
                "A frame needs the data of as much time as its Doppler runs through "
                f"{fixed(frames.bandwidth, 0)} Hz. Away from zero Doppler the Doppler changes more "
                "slowly, so frames need more data, and consecutive frames have more of it in "
                "common."
            ),
            Figure(
                frames_figure(result),
                "Every frame of the film, exact on the real orbit and by the hyperbola of the "
                "source: (a) length of its aperture, with the form that the source prints, (b) "
                "departure of the hyperbola, (c) share of its data in common with the frame "
                "before, (d) frame rate above which any is in common, "
                f"{fifth}, (f) resolution across the lines of equal Doppler on the ground.",
                "Six line charts of lengths, overlaps, frame rates and resolution against time.",
            ),
            _models_table(result),
        ),
    )


def _models_table(result: VideoResult) -> Table:
    frames, allowed = result.frames, result.request.max_overlap
    middle = int(np.argmin(np.abs(frames.times)))
    rows = []
    for name, model in (("exact", frames.exact), ("hyperbola", frames.hyperbolic)):
        for where, index in (("zero Doppler", middle), ("first frame", 0), ("last frame", -1)):
            rows.append(
                {
                    "model": name,
                    "where": where,
                    "time": frames.times[index],
                    "duration": model.duration[index],
                    "length": model.length[index] / 1e3,
                    "overlap": _shared(float(model.overlap[index])),
                    "independent": model.independent_rate[index],
                    "limit": model.rate_limit[index],
                }
            )
    frame = pd.DataFrame(rows)
    frame["model"] = once(frame["model"].tolist())
    return Table(
        frame,
        (
            Column("model", "Model"),
            Column("where", "Frame"),
            Column("time", "Time", "s", to_decimals(1)),
            Column("duration", "Data", "s", _digits),
            Column("length", "Aperture", "km", _digits),
            Column("overlap", "In common", "%", list),
            Column("independent", "Independent", "Hz", _digits),
            *((Column("limit", "Limit", "Hz", _digits),) if allowed else ()),
        ),
        "Frames at zero Doppler and at both ends: duration of the data and length of the aperture, "
        "share in common with the frame before, the frame rate above which any data are in common"
        + (f", and that above which more than {percent(allowed)} are. " if allowed else ". ")
        + f"{MISSING}: the Doppler does not run through the bandwidth.",
    )


def _shared(share: float) -> str:
    return fixed(100.0 * share, 1)


def _digits(values: Sequence[float]) -> list[str]:
    return [significant(float(value), 4) for value in values]


def pass_section(result: VideoResult) -> Section:
    """Where and when."""
    plan, frames = result.plan, result.frames
    rows = [
        ("zero Doppler", f"{moment_text(plan.epoch)} UTC"),
        ("pass", f"{plan.number} of {plan.passes} in the time searched"),
        ("direction", heading_name(ascending=plan.ascending)),
        ("look side", side_name(plan.side)),
        ("slant range at zero Doppler", f"{fixed(plan.slant_range / 1e3, 3)} km"),
        ("look angle", f"{fixed(math.degrees(plan.look_angle), 4)}°"),
        ("incidence", f"{fixed(math.degrees(plan.incidence), 4)}°"),
        ("squint", _squints(result)),
        ("Doppler rate", f"{fixed(plan.doppler_rate, 2)} Hz/s"),
        ("speed of the zero-Doppler line", f"{fixed(plan.ground_speed, 2)} m/s"),
        ("effective speed of the hyperbola", f"{fixed(frames.effective_speed, 2)} m/s"),
    ]
    return Section(
        "pass",
        "Where and when",
        (pass_figure(passage_of(result), "film"), facts(rows, "The film.")),
    )


def _squints(result: VideoResult) -> str:
    known = np.degrees(result.frames.squint[np.isfinite(result.frames.squint)])
    if known.size == 0:
        return MISSING
    return f"{fixed(float(known.min()), 2)}° … {fixed(float(known.max()), 2)}°, positive ahead"


def attitude_section(result: VideoResult) -> Section:
    """Angles and quaternions."""
    blocks: list[Block] = [*attitude_blocks(result.times, _ANGLES, result.profile)]
    if result.request.yaw_law is YawLaw.NONE:
        blocks.insert(0, Paragraph("This law keeps the yaw at zero."))
    return Section("attitude", "Attitude", tuple(blocks))
