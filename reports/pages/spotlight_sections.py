"""Sections of a spotlight imaging: where and when, attitude, aim error, range and Doppler."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd

from insar.observe.agile.spotlight_results import SpotlightResult

from ..agile_words import heading_name, side_name
from ..document import (
    Column,
    Figure,
    Paragraph,
    Section,
    Table,
)
from ..figures.spotlight import AIM_METHODS, aim_figure, echo_figure
from ..reading_agile import AIM_ROUNDING, passage_of, path_length
from ..tables_steering import largest, least
from ..wording import (
    MISSING,
    counted,
    fixed,
    moment_text,
    or_zero,
    plain,
    significant,
)
from .closing import facts
from .turning import attitude_blocks, pass_figure

_ANGLES = ("yaw", "roll", "pitch")
"""In the order of the sequence 3-1-2."""


def pass_section(result: SpotlightResult) -> Section:
    """Where and when."""
    plan, history = result.plan, result.history
    rows = [
        ("zero Doppler", f"{moment_text(plan.epoch)} UTC"),
        ("pass", f"{plan.number} of {plan.passes} in the time searched"),
        ("direction", heading_name(ascending=plan.ascending)),
        ("look side", side_name(plan.side)),
        ("slant range at zero Doppler", f"{fixed(plan.slant_range / 1e3, 3)} km"),
        ("look angle", f"{fixed(math.degrees(plan.look_angle), 4)}°"),
        ("incidence", f"{fixed(math.degrees(plan.incidence), 4)}°"),
        ("Doppler rate", f"{fixed(plan.doppler_rate, 2)} Hz/s"),
        ("speed of the zero-Doppler line", f"{fixed(plan.ground_speed, 2)} m/s"),
        ("aperture time, solved for the resolution", f"{fixed(plan.aperture_time, 4)} s"),
        ("the same to first order", f"{fixed(plan.first_order_time, 4)} s"),
        ("imaging time", f"{fixed(plan.imaging_time, 4)} s"),
        ("Doppler bandwidth", f"{fixed(history.bandwidth, 2)} Hz"),
        ("resolution in azimuth", f"{significant(history.resolution, 5)} m"),
        ("range migration over the aperture time", f"{significant(history.range_migration, 4)} m"),
    ]
    if result.request.sliding_factor:
        length = path_length(history.latitude, history.longitude)
        rows.append(
            (
                "way of the beam over the ground",
                f"{fixed(length / 1e3, 2)} km, {fixed(length / float(np.ptp(result.times)), 1)} "
                "m/s on average",
            )
        )
    return Section(
        "pass",
        "Where and when",
        (
            pass_figure(passage_of(result), "imaging"),
            facts(rows, "The imaging."),
        ),
    )


def attitude_section(result: SpotlightResult) -> Section:
    """Angles and quaternions."""
    return Section("attitude", "Attitude", attitude_blocks(result.times, _ANGLES, result.profile))


def aim_section(result: SpotlightResult) -> Section:
    """Where the beam falls, of attitudes that consider more or less."""
    turn = largest(result.iteration.turn)
    error = result.aim_error
    frame = pd.DataFrame(
        [
            {
                "method": name.capitalize(),
                "least": least(values),
                "largest": largest(values),
            }
            for key, name in AIM_METHODS.items()
            for values in [getattr(error, key)]
        ]
    )
    target = "the aim point"
    if result.request.sliding_factor:
        target = "the point that the sliding beam should be on"
    return Section(
        "aim",
        "Aim error",
        (
            Paragraph(
                "How far on the ground the real beam falls from "
                f"{target}, for attitudes that consider more or less of the antenna: closed form "
                f"and iteration ({counted(result.iteration.steps, 'step')}) with everything, "
                "without the phase center, and without the off-axis angle as well. The two exact "
                "attitudes differ by a turn about the line of sight of up to "
                f"{or_zero(math.degrees(turn), 1e-12)}°, which moves nothing."
            ),
            Figure(
                aim_figure(result.times, error),
                "Aim error on a logarithmic axis. In the shaded range a value is the rounding of "
                "64-bit arithmetic. A line that is missing has no beam that meets the Earth.",
                "Line chart of four aim errors against time.",
            ),
            Table(
                frame,
                (
                    Column("method", "The attitude considers"),
                    Column("least", "Least", "m", _errors),
                    Column("largest", "Largest", "m", _errors),
                ),
                f"Aim errors over the imaging; 0 where below {plain(AIM_ROUNDING)}\u00a0m. "
                f"{MISSING}: the beam misses the Earth.",
            ),
        ),
    )


def _errors(values: Sequence[float]) -> list[str]:
    return [or_zero(float(value), AIM_ROUNDING) for value in values]


def echo_section(result: SpotlightResult) -> Section:
    """Range and Doppler history."""
    plan = result.plan
    longer = plan.aperture_time < 0.995 * float(np.ptp(result.times))
    history = result.history
    rows = (
        ("Solved", plan.aperture_time, history.bandwidth, history.resolution),
        (
            "To first order",
            plan.first_order_time,
            history.first_order_bandwidth,
            history.first_order_resolution,
        ),
    )
    frame = pd.DataFrame(rows, columns=["what", "time", "bandwidth", "resolution"])
    return Section(
        "echo",
        "Range and Doppler",
        (
            Figure(
                echo_figure(result),
                "The aim point as the radar sees it, from the antenna's phase center: (a) slant "
                "range, (b) Doppler frequency, positive while it approaches, (c) the same less the "
                "straight line through zero Doppler"
                + (". Dotted: the aperture time that the resolution needs" if longer else "")
                + ".",
                "Three line charts of slant range and Doppler against time.",
            ),
            Table(
                frame,
                (
                    Column("what", "Aperture time"),
                    Column("time", "Time", "s", _to_digits),
                    Column("bandwidth", "Bandwidth", "Hz", _to_hertz),
                    Column("resolution", "Resolution", "m", _to_digits),
                ),
                "Bandwidth of the Doppler history, and resolution in azimuth on the ground: in the "
                "time that is solved for the resolution, and in that of the source, which takes "
                "the rate at zero Doppler for the whole aperture. The history bends, so that the "
                "latter falls short.",
            ),
        ),
    )


def _to_digits(values: Sequence[float]) -> list[str]:
    return [significant(float(value), 5) for value in values]


def _to_hertz(values: Sequence[float]) -> list[str]:
    return [fixed(float(value), 1) for value in values]
