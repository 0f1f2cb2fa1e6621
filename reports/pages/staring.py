"""Where the geometry of a formation study lies, when the beam stays on one place."""

from __future__ import annotations

import math

import numpy as np

from insar.observe.agile.staring import StaringScene

from ..agile_words import heading_name, side_name
from ..document import Block, Column, Paragraph, Section, Strong, Table
from ..reading_agile import passage_of_scene
from ..tables_observation import staring_frame
from ..wording import (
    counted,
    fixed,
    latitude_text,
    longitude_text,
    moment_text,
    plain,
    to_decimals,
)
from .closing import facts
from .flown import eccentricity_block, orbit_rows
from .turning import pass_figure

_MOST_LISTED = 24
"""Rows of the table of segments where there are more, at equal steps."""


def staring_section(staring: StaringScene) -> Section:
    """The pass, a map and the segments."""
    count = len(staring.scene)
    blocks: list[Block] = [
        Paragraph(
            (
                "The scene is ",
                Strong(f"one place, {_place(staring)}"),
                ", on which the beam stays: ",
                f"{counted(count, 'segment')} are moments, "
                + (f"over {plain(staring.duration)} s about" if count > 1 else "at")
                + " zero Doppler, and the line of sight turns from ahead to behind.",
            )
        ),
        pass_figure(passage_of_scene(staring), "scene"),
        eccentricity_block(staring.eccentricity),
        facts(_pass(staring), "The pass."),
        _segments_table(staring),
    ]
    return Section("observation", "Where the geometry lies", tuple(blocks))


def _place(staring: StaringScene) -> str:
    request = staring.request
    latitude = latitude_text(math.degrees(request.latitude), 3)
    return f"{latitude} {longitude_text(math.degrees(request.longitude), 3)}"


def _pass(staring: StaringScene) -> list[tuple[str, str]]:
    plan, orbit = staring.plan, staring.orbit
    return [
        ("place", f"{_place(staring)}, {plain(staring.request.height)} m above the ellipsoid"),
        ("zero Doppler", f"{moment_text(plan.epoch)} UTC"),
        (
            "epoch of the formation's states",
            f"{moment_text(staring.epoch)} UTC, the first segment",
        ),
        *orbit_rows(staring),
        ("pass", f"{plan.number} of {plan.passes} in the time searched that can see the place"),
        ("direction", heading_name(ascending=plan.ascending)),
        ("look side", side_name(plan.side)),
        ("duration", f"{fixed(staring.duration, 3)} s"),
        ("slant range at zero Doppler", f"{fixed(plan.slant_range / 1e3, 3)} km"),
        ("look angle at zero Doppler", f"{fixed(math.degrees(plan.look_angle), 3)}°"),
        ("incidence at zero Doppler", f"{fixed(math.degrees(plan.incidence), 3)}°"),
        ("mean semi-major axis", f"{fixed(orbit.semi_major_axis / 1e3, 3)} km"),
        ("mean inclination", f"{fixed(math.degrees(orbit.inclination), 3)}°"),
        ("mean eccentricity", fixed(staring.eccentricity, 5)),
    ]


def _segments_table(staring: StaringScene) -> Table:
    frame = staring_frame(staring)
    count = len(frame)
    caption = (
        "The segments: the place at moments of the pass. Azimuth is counted about nadir from the "
        "flight direction, positive to the left; the squint is that of the line of sight ahead of "
        "the plane of zero Doppler"
    )
    if count > _MOST_LISTED + 8:
        chosen = np.unique(np.linspace(0, count - 1, _MOST_LISTED).round().astype(int))
        frame = frame.iloc[chosen]
        caption += f". {len(chosen)} of {count}; segments.csv has all"
    frame = frame.assign(
        moment=[text[11:23] for text in frame["utc"]],
        slant_range_km=frame["slant_range_m"] / 1e3,
    )
    degrees = to_decimals(3)
    return Table(
        frame,
        (
            Column("segment", "No."),
            Column("moment", "UTC"),
            Column("since_zero_doppler_s", "Since zero Doppler", "s", to_decimals(3)),
            Column("slant_range_km", "Range", "km", to_decimals(3)),
            Column("look_deg", "Look", "°", degrees),
            Column("incidence_deg", "Incidence", "°", degrees),
            Column("azimuth_deg", "Azimuth", "°", degrees),
            Column("squint_deg", "Squint", "°", degrees),
        ),
        f"{caption}.",
    )
