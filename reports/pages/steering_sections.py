"""Sections on what steering laws do: attitude, rates, Doppler."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from insar.observe import CaseResult

from ..document import Block, Column, Figure, Paragraph, Section, Status, Table
from ..figures.steering import attitude_figure, boresight_figure, rates_figure, swath_figure
from ..reading_steering import ROUNDING, steers
from ..tables_steering import laws_frame
from ..wording import fixed, once, or_zero, plain
from .steering_verdict import share_solved

Array = NDArray[np.float64]

_MOST_OFFSETS = 5
"""Elevations off the boresight that a table has columns for."""


def attitude_section(cases: Sequence[CaseResult]) -> Section:
    """Angles of each law."""
    frame = laws_frame(cases)
    blocks: list[Block] = []
    if any(steers(curves) for case in cases for curves in case.curves):
        blocks.append(
            Figure(
                attitude_figure(cases),
                "Attitude of the body against the orbit frame over the argument of latitude, a "
                "row for each case. The laws that yaw turn about nadir, then pitch; pitch-roll "
                "steering pitches, then rolls about the pitched axis, and its angles have scales "
                "of their own. Where lines coincide, the exact yaw-pitch law is the broad one "
                "beneath.",
                "Line charts of yaw, pitch and roll angles against the argument of latitude.",
            )
        )
    blocks.append(
        Table(
            frame.assign(
                solved=[share_solved(float(share)) for share in frame["solved"]],
                case=once(frame["case"].tolist()),
            ),
            (
                *_case_column(cases),
                Column("law", "Law"),
                Column("yaw_deg", "Yaw", "°", _degrees),
                Column("pitch_deg", "Pitch", "°", _degrees),
                Column("roll_deg", "Roll", "°", _degrees),
                Column("steering_deg", "Added", "°", _degrees),
                Column("rate_orbit_deg_s", "Rate", "°/s", _digits),
                Column("rate_inertial_deg_s", "Inertial", "°/s", _digits),
                Column("incidence", "Incidence", "°", _ranges),
                *(() if frame["solved"].eq(1.0).all() else (Column("solved", "Solved"),)),
            ),
            "Largest values over the orbit: angles and the sum of those that are steered, angular "
            "rate against the orbit frame and against inertial space; and the incidence of the "
            "boresight. The roll of pitch-roll steering contains the look angle itself, which a "
            "law that yaws leaves to the mount of the antenna."
            + (
                ""
                if frame["solved"].eq(1.0).all()
                else " Solved: the share of the orbit for which the law has a solution; the "
                "result says why not elsewhere."
            ),
            tuple(Status.WARNING if share < 1.0 else Status.NOTE for share in frame["solved"]),
        )
    )
    return Section("attitude", "Attitude", tuple(blocks))


def _case_column(cases: Sequence[CaseResult]) -> tuple[Column, ...]:
    return (Column("case", "Case"),) if len(cases) > 1 else ()


def _degrees(values: Sequence[float]) -> list[str]:
    return ["0" if abs(value) < 1e-9 else fixed(float(value), 3) for value in values]


def _ranges(values: Sequence[tuple[float, float]]) -> list[str]:
    return [_range(low, high) for low, high in values]


def _range(low: float, high: float) -> str:
    first, last = fixed(low, 2), fixed(high, 2)
    return first if first == last else f"{first} … {last}"


def rates_section(cases: Sequence[CaseResult]) -> Section:
    """Angular rates of the body."""
    return Section(
        "rates",
        "Angular rates",
        (
            Paragraph(
                "What the actuators must give is the rate against inertial space: it contains "
                "the turn of the orbit frame itself, once a revolution."
            ),
            Figure(
                rates_figure(cases),
                "Magnitude of the body's angular velocity, against the orbit frame and against "
                "inertial space.",
                "Line charts of angular rates against the argument of latitude.",
            ),
        ),
    )


def _digits(values: Sequence[float]) -> list[str]:
    """Three digits each; what is rounding only is zero."""
    return [or_zero(float(value), 1e-9) for value in values]


def _hertz(values: Sequence[float]) -> list[str]:
    """Three digits each; what is rounding only is zero."""
    return [or_zero(float(value), ROUNDING) for value in values]


def doppler_section(cases: Sequence[CaseResult]) -> Section:
    """Doppler that is left at the boresight."""
    return Section(
        "boresight",
        "Doppler at the boresight",
        (
            Figure(
                boresight_figure(cases),
                "Magnitude of the Doppler centroid at the boresight, on a logarithmic axis, and "
                "the incidence of the boresight on the ellipsoid. In the shaded range a value is "
                "the rounding of 64-bit arithmetic: it would be another on another machine.",
                "Line charts of the residual Doppler and the incidence along the orbit.",
            ),
        ),
    )


def swath_section(cases: Sequence[CaseResult]) -> Section:
    """Doppler off the boresight."""
    frame = laws_frame(cases)
    frame["case"] = once(frame["case"].tolist())
    blocks: list[Block] = []
    if all(case.case.swath_offsets.size for case in cases):
        blocks += [
            Paragraph(
                "A law that turns the antenna's plane into the plane of zero Doppler keeps the "
                "whole swath there; one that only points the boresight into it leaves a Doppler "
                "that grows with the elevation off the boresight."
            ),
            Figure(
                swath_figure(cases),
                "Doppler over the swath. Left, the largest of the orbit against the elevation off "
                "the boresight, positive away from nadir. Right, for the laws that are exact at "
                "the boresight, the range over these elevations along the orbit.",
                "Charts of the Doppler off the boresight: its largest magnitude against "
                "elevation, and its range along the orbit.",
            ),
        ]
    columns = _offset_columns(cases)
    blocks.append(
        Table(
            frame,
            (
                *_case_column(cases),
                Column("law", "Law"),
                Column("residual_hz", "Boresight", "Hz", _hertz),
                *columns,
                Column("hz_per_centidegree", "Pointing", "Hz per 0.01°", _hertz),
            ),
            "Largest magnitude of the Doppler centroid over the orbit, at the boresight and at "
            "elevations off it, and its change for a beam turned by 0.01° in the worst direction. "
            f"0: below {plain(ROUNDING)}\u00a0Hz, the rounding of the arithmetic.",
        )
    )
    return Section("swath", "Doppler over the swath", tuple(blocks))


def _offset_columns(cases: Sequence[CaseResult]) -> tuple[Column, ...]:
    """Columns of the elevations off the boresight, where all cases have the same."""
    first = cases[0].case.swath_offsets
    if any(not np.array_equal(case.case.swath_offsets, first) for case in cases):
        return ()
    wanted = [index for index in range(first.size) if abs(first[index]) > 1e-12]
    if len(wanted) > _MOST_OFFSETS:
        ends = np.linspace(0, len(wanted) - 1, _MOST_OFFSETS).round().astype(int)
        wanted = [wanted[end] for end in ends]
    return tuple(
        Column(f"swath_{index}", f"{_signed(math.degrees(first[index]))}°", "Hz", _hertz)
        for index in wanted
    )


def _signed(value: float) -> str:
    return f"+{plain(value)}" if value > 0.0 else plain(value)
