"""Sections on the footprint of a film: outlines, rotation and shear, pointing errors."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from insar.observe.agile.video_results import VideoResult

from ..agile_words import common_reason, yaw_law_name
from ..document import Block, Column, Figure, Paragraph, Section, Status, Table
from ..figures.footprints import footprints_map
from ..figures.footprints_moving import moving_footprints
from ..figures.video import distortion_figure, laws_figure, pointing_figure
from ..reading_agile import passage_of
from ..tables_video import laws_frame, pointing_frame
from ..wording import (
    counted,
    fixed,
    once,
    or_zero,
    plain,
    significant,
    to_decimals,
)

_ROUNDING = 1e-6
"""Rotations [°] below this are zero."""


def footprint_section(result: VideoResult) -> Section:
    """Outlines on a map, and moving."""
    prints = result.footprints
    areas = prints.area[np.isfinite(prints.area)]
    missing = prints.area.size - areas.size
    area = (
        f"from {significant(float(areas.min()) / 1e6)} to {significant(float(areas.max()) / 1e6)} "
        "km²"
        if areas.size
        else "not known"
    )
    if np.isfinite(prints.common_area):
        common = (
            f"{significant(prints.common_area / 1e6)} km² are seen all the time"
            if prints.common_area > 0.0
            else "nothing is seen all the time"
        )
    else:
        common = f"what is seen all the time is not known, since {common_reason(result)}"
    return Section(
        "footprints",
        "Footprints",
        (
            Paragraph(
                f"The beam covers {area} on the ground; {common}."
                + (
                    f" {counted(missing, 'outline')} of {prints.area.size} are not drawn: "
                    "the beam is not held there, or reaches beyond the horizon."
                    if missing
                    else ""
                )
            ),
            Figure(
                footprints_map(result),
                "Outlines of the beam on the ground under the yaw law "
                f"“{yaw_law_name(result.request.yaw_law)}”, at the start, at zero Doppler, at the "
                "end and between, by the time from zero Doppler. North up, every distance from "
                "the aim point (cross) true. Land: Natural Earth, 1:50 million, for "
                "orientation only.",
                "A map with outlines of the beam at the start, in the middle and at the end.",
                interactive=moving_footprints(result, passage_of(result)),
                instruction="The same moving: left the satellite's way over the ground and its "
                "line of sight, right the footprint, with those of start, middle and end in gray. "
                "Play, or drag the slider.",
            ),
        ),
    )


def yaw_section(result: VideoResult) -> Section:
    """Rotation and shear under the law of the study, and what the others leave."""
    frame = laws_frame(result)
    chosen = [law.law is result.request.yaw_law for law in result.laws]
    frame["name"] = [
        f"{name} (this film)" if own else name
        for name, own in zip(frame["name"], chosen, strict=True)
    ]
    unsolved = frame["solved_fraction"] < 1.0
    columns = [
        Column("name", "Yaw law"),
        Column("azimuth_trace_deg", "Azimuth trace", "°", _degrees),
        Column("range_trace_deg", "Range trace", "°", _degrees),
        Column("major_axis_deg", "Major axis", "°", _degrees),
        Column("shear_deg", "Shear", "°", _degrees),
        Column("yaw_deg", "Yaw", "°", _degrees),
        Column("rate_inertial_deg_s", "Rate", "°/s", _rates),
        Column("common_area", "Seen all the time", "%", _percents),
    ]
    if unsolved.any():
        columns.append(Column("solved_fraction", "Solved", "%", _percents))
    return Section(
        "yaw",
        "Rotation and shear",
        (
            Paragraph(
                "Roll and pitch point the beam; the turn about the line of sight is free, and can "
                "hold one direction of the footprint on the ground. It cannot hold all: the "
                "angle between the traces of the antenna's azimuth and range planes changes with "
                "the slant of the beam."
            ),
            Figure(
                distortion_figure(result),
                f"The footprint under the yaw law “{yaw_law_name(result.request.yaw_law)}”, by "
                "that at the reference time (gray line): rotation of its traces and its major "
                "axis, counterclockwise seen from above, and its shear; right, its lengths and "
                "area.",
                "Line charts of rotations and sizes of the footprint against time.",
            ),
            Figure(
                laws_figure(result.laws),
                "What every yaw law leaves over the film: largest rotation of the azimuth trace, "
                "range trace and major axis, and the shear; right, the part of the footprint at "
                "the reference time that all footprints see"
                + (
                    "; a law without a solution at some time counts where it has one"
                    if unsolved.any()
                    else ""
                )
                + ".",
                "A dot plot of rotations and a bar chart of common areas, a row for each yaw law.",
            ),
            Table(
                frame,
                tuple(columns),
                "What every yaw law leaves, largest values over the film; rate: of the body "
                "against inertial space.",
                tuple(Status.WARNING if part else Status.NOTE for part in unsolved),
            ),
        ),
    )


def _degrees(values: Sequence[float]) -> list[str]:
    return ["0" if abs(value) < _ROUNDING else fixed(float(value), 3) for value in values]


def _rates(values: Sequence[float]) -> list[str]:
    return [significant(float(value)) for value in values]


def _percents(values: Sequence[float]) -> list[str]:
    return [fixed(100.0 * float(value), 1) for value in values]


def pointing_section(result: VideoResult) -> Section:
    """What pointing errors do."""
    blocks: list[Block] = [
        Paragraph(
            "Small turns of the body about its axes move the footprint and rotate it, to first "
            "order. A turn about Z, of the yaw, leaves the center where it is; turns about X and "
            "Y move it, and at a slant they rotate the azimuth trace too."
        )
    ]
    if any(result.request.pointing_error):
        errors = ", ".join(
            f"{axis} {plain(math.degrees(error)) if error else '0'}°"
            for axis, error in zip("XYZ", result.request.pointing_error, strict=True)
        )
        blocks.append(
            Figure(
                pointing_figure(result),
                f"For independent errors with standard deviations of {errors}: displacement of "
                "the footprint's center, and rotation of its azimuth trace.",
                "Two line charts of displacement and rotation against time.",
            )
        )
    frame = pointing_frame(result)
    frame["time_s"] = once(to_decimals(1)(frame["time_s"].tolist()))
    for column in ("east_m_deg", "north_m_deg"):
        frame[column] *= 0.01
    blocks.append(
        Table(
            frame,
            (
                Column("time_s", "Time [s]"),
                Column("axis", "About"),
                Column("east_m_deg", "Center to the east", "m per 0.01°", _moves),
                Column("north_m_deg", "Center to the north", "m per 0.01°", _moves),
                Column("rotation", "Rotation", "° per °", _moves),
            ),
            "Displacement and rotation by a turn about each body axis, at the start, at zero "
            "Doppler and at the end.",
        )
    )
    return Section("pointing", "Pointing errors", tuple(blocks))


def _moves(values: Sequence[float]) -> list[str]:
    return [or_zero(float(value), 1e-9) for value in values]
