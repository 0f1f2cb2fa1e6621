"""Sections on how a body turns, which the pages of spotlight and video share."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from insar.observe.agile.agility import Agility
from insar.observe.agile.profiles import Profile

from ..document import Block, Column, Figure, Metric, Section, Status, Table
from ..figures.pass_map import pass_map
from ..figures.turning import Angle, attitude_figure, rates_figure
from ..reading_agile import Demand, Passage, demands, exceeds
from ..tables_spotlight import axes_frame, quaternions_frame, turns_frame
from ..wording import MISSING, fixed, or_zero, percent, plain, significant, to_decimals

Array = NDArray[np.float64]

BODY_AXES = ("X", "Y", "Z")


def pass_figure(passage: Passage, noun: str) -> Figure:
    """Map and sky of a pass."""
    return Figure(
        pass_map(passage),
        "The pass, north up, every distance from the aim point (red square) true. (a) Track of the "
        f"point below the satellite, the {noun} in orange, with the horizontal directions of the "
        "lines of sight at its start, zero Doppler and end. (b) Where the satellite stands in the "
        "sky of the aim point: its vertical in the middle, the horizon at the rim, the distance "
        "from the middle being the incidence. Land: Natural Earth, 1:50 million, for orientation "
        "only.",
        "A map of the ground track with lines of sight to the aim point, a globe for orientation, "
        "and a polar chart of the satellite in the sky of the aim point.",
    )


def attitude_blocks(times: Array, angles: Sequence[str], profile: Profile) -> tuple[Block, ...]:
    """Angles and quaternions.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    angles : their names, in the order of the sequence.
    profile : which has them.
    """
    named = [Angle(name, getattr(profile, name)) for name in angles]
    return (
        Figure(
            attitude_figure(times, named, profile),
            "Attitude of the body against the orbit frame as Euler angles, each on a scale of its "
            "own, and as quaternions against the orbit frame and against inertial axes (GCRS).",
            "Line charts of three Euler angles and two quaternions against time.",
        ),
        _angles_table(profile, tuple(angles)),
        _quaternions_table(times, profile),
    )


def _angles_table(profile: Profile, angles: tuple[str, ...]) -> Table:
    return Table(
        turns_frame(profile, angles),
        (
            Column("what", "Angle"),
            Column("low", "Least", "°", to_decimals(4)),
            Column("high", "Largest", "°", to_decimals(4)),
            Column("swing", "Range", "°", to_decimals(4)),
        ),
        "Least and largest Euler angles, and the range between them.",
    )


def _quaternions_table(times: Array, profile: Profile) -> Table:
    parts = to_decimals(7)
    return Table(
        quaternions_frame(times, profile),
        (
            Column("frame", "Against"),
            Column("time_s", "Time", "s", to_decimals(3)),
            *(Column(part, part, "", parts) for part in ("i", "j", "k", "scalar")),
        ),
        "Quaternions of the turn that takes the axes of the frame to those of the body, the "
        "scalar last, at the start, in the middle and at the end. The CSV has every sample.",
    )


def rates_section(times: Array, profile: Profile, agility: Agility | None) -> Section:
    """Rates and accelerations, and what is allowed."""
    frame = axes_frame(profile)
    inertial = frame["what"].str.contains("inertial")
    frame["limit"] = [_limit(agility, what) for what in frame["what"]]
    exceeded = {
        "Rate, inertial": bool(np.any(profile.rate_exceeded)),
        "Acceleration, inertial": bool(np.any(profile.acceleration_exceeded)),
    }
    columns = [
        Column("what", "Largest"),
        Column("x", "X", "", _digits),
        Column("y", "Y", "", _digits),
        Column("z", "Z", "", _digits),
        Column("magnitude", "Magnitude", "", _digits),
        Column("unit", "Unit"),
    ]
    if agility is not None:
        columns.append(Column("limit", "Limit"))
    return Section(
        "rates",
        "Rates and accelerations",
        (
            Figure(
                rates_figure(times, profile, agility),
                "Angular velocity of the body and its rate of change, in body axes. What the "
                "actuators must give is the inertial one: it contains the turn of the orbit frame "
                "itself, once a revolution."
                + (" Where a limit is exceeded, the ground is shaded." if exceeds(profile) else ""),
                "Line charts of angular rates and accelerations about X, Y and Z against time.",
            ),
            Table(
                frame,
                tuple(columns),
                "Largest rates and accelerations about each body axis, and in magnitude.",
                tuple(
                    Status.BAD if is_inertial and exceeded[what] else Status.NOTE
                    for what, is_inertial in zip(frame["what"], inertial, strict=True)
                ),
            ),
        ),
    )


def _digits(values: Sequence[float]) -> list[str]:
    return [or_zero(float(value), 1e-9) for value in values]


def _limit(agility: Agility | None, what: str) -> str:
    if agility is None or "inertial" not in what:
        return ""
    limit = agility.max_rate if what.startswith("Rate") else agility.max_acceleration
    return limit_text(limit)


def limit_text(limit: float | tuple[float, float, float]) -> str:
    """Limit in degrees, or three of them about the axes."""
    if np.all(np.isinf(limit)):
        return "none"
    if isinstance(limit, tuple):
        return ", ".join(
            f"{axis} {plain(math.degrees(value)) if math.isfinite(value) else 'none'}"
            for axis, value in zip(BODY_AXES, limit, strict=True)
        )
    return plain(math.degrees(limit))


def demand_metrics(profile: Profile, agility: Agility | None) -> tuple[Metric, Metric]:
    """Key figures of rate and acceleration."""
    rate, acceleration = demands(profile, agility)
    known = bool(np.all(profile.solved))
    return (
        _metric("Largest rate", rate, "°/s", known=known),
        _metric("Largest acceleration", acceleration, "°/s²", known=known),
    )


def _metric(label: str, found: Demand, unit: str, *, known: bool) -> Metric:
    """One of them; what is not known at some samples may be larger there, and is not good."""
    if not math.isfinite(found.largest):
        return Metric(label, MISSING, "not known: the beam is never pointed", Status.WARNING)
    value = f"{significant(math.degrees(found.largest), 2 if unit.endswith('²') else 3)}{unit}"
    part = "" if known else ", where known"
    if not math.isfinite(found.share):
        return Metric(label, value, f"inertial{part}; no limit given")
    status = Status.BAD if found.share > 1.0 else Status.GOOD if known else Status.WARNING
    return Metric(label, value, f"inertial{part}; {_used(found.share)} of the limit", status)


def _used(share: float) -> str:
    """Share of a limit; one that is exceeded is never rounded down to it."""
    if share > 1.0:
        return f"{fixed(share, 2)} times" if share > 1.005 else "just over all"
    return percent(min(share, 0.999)) if share < 1.0 else "all"


def agility_text(profile: Profile, agility: Agility | None) -> str:
    """Whether the satellite is agile enough, in a sentence."""
    rate, acceleration = demands(profile, agility)
    if not math.isfinite(rate.largest):
        return (
            "Whether the satellite is agile enough is not known: the beam cannot be pointed at any "
            "sample."
        )
    known = "" if np.all(profile.solved) else "Where the beam can be pointed, "
    turn = (
        f"{known}{'t' if known else 'T'}he body turns at up to "
        f"{significant(math.degrees(rate.largest))}°/s and accelerates "
        f"by up to {significant(math.degrees(acceleration.largest))}°/s² against inertial space"
    )
    shares = [
        f"{_used(found.share)} of the allowed {name}"
        for name, found in (("rate", rate), ("acceleration", acceleration))
        if math.isfinite(found.share)
    ]
    return f"{turn}: {' and '.join(shares)}." if shares else f"{turn}; the study gives no limits."


def exceeded_share(profile: Profile) -> float:
    """Share of the samples at which a limit is exceeded."""
    return float(np.mean(profile.rate_exceeded | profile.acceleration_exceeded))
