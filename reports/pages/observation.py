"""Where the geometry of a formation study lies, when its scene comes from an orbit."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from insar import LookSide
from insar.observe import Observation, Reference

from ..document import Block, Callout, Column, Figure, Paragraph, Section, Status, Strong, Table
from ..figures.observation_map import observation_map
from ..reading_steering import ROUNDING
from ..steering_words import boresight_text, law_name
from ..tables_observation import missed_frame, segments_frame
from ..wording import counted, fixed, percent, plain, significant, to_decimals
from .closing import facts

_ECCENTRIC = 0.01
"""Eccentricity from which the circular reference orbit is a warning, not a remark."""

_MOST_LISTED = 24
"""Segments that a table lists in full; of more, so many at equal steps."""


def observation_section(observation: Observation | None) -> Section | None:
    """The pass, maps and segments; None where the study gives its geometry itself."""
    if observation is None:
        return None
    blocks: list[Block] = [
        Paragraph(_seen(observation)),
        Figure(
            observation_map(observation),
            "Where the geometry lies, north up, every distance from the middle of a map true. "
            "(a) Ground track with the flight direction, the strip between its edges of least and "
            "largest incidence, and the frame of (b); the red square on the globe is the place. "
            "(b) The segments and their local incidence on the ellipsoid"
            + (", the area" if observation.outlines else "")
            + ("; crosses: targets not seen" if observation.missed_reasons else "")
            + ". Land: Natural Earth, 1:50 million, for orientation only.",
            "Two maps, of the satellite's ground track and strip and of the segments, with a "
            "globe for orientation.",
        ),
    ]
    if observation.missed_reasons:
        blocks.append(_missed_table(observation))
    blocks += [*_eccentricity(observation), facts(_pass(observation), "The pass.")]
    blocks.append(_segments_table(observation))
    return Section("observation", "Where the geometry lies", tuple(blocks))


def _seen(observation: Observation) -> tuple[str, ...]:
    missed = len(observation.missed_reasons)
    seen = len(observation.scene)
    text: tuple[str, ...] = (
        "The scene is ",
        Strong(
            f"one {'ascending' if observation.ascending else 'descending'} pass, "
            f"looking {_side(observation)}"
        ),
        f", of a real orbit over the WGS84 ellipsoid: {counted(seen, 'segment')}"
        + (f" of {counted(seen + missed, 'target')}" if missed else "")
        + f", from {_moment(observation)} UTC on. ",
    )
    if missed:
        text += (Strong(f"{counted(missed, 'target')} not seen by this pass take no part. "),)
    return (*text, _REFERENCE[observation.reference])


_REFERENCE = {
    Reference.AS_OBSERVED: "Each segment is taken as observed: at the moment when the middle of "
    "the beam passes it.",
    Reference.ZERO_DOPPLER: "Each segment is referred to zero Doppler, its closest approach, to "
    "which SAR images are usually focused.",
}


_GEOMETRY = {
    Reference.AS_OBSERVED: "as observed",
    Reference.ZERO_DOPPLER: "referred to zero Doppler",
}


def _side(observation: Observation) -> str:
    return "left" if observation.side is LookSide.LEFT else "right"


def _moment(observation: Observation) -> str:
    return observation.epoch.strftime("%Y-%m-%d %H:%M:%S")


def _eccentricity(observation: Observation) -> tuple[Block, ...]:
    """What the circular reference orbit of the relative motion leaves out."""
    eccentricity = observation.eccentricity
    text = (
        f"The orbit has a mean eccentricity of {fixed(eccentricity, 5)}. The geometry is that of "
        "the orbit as it is, but the satellites move relative to each other as about a circle of "
        "the same mean semi-major axis (Clohessy-Wiltshire): this leaves out terms of the order "
        f"of the eccentricity, some {percent(eccentricity)} of the relative positions."
    )
    if eccentricity < _ECCENTRIC:
        return (Paragraph(text),)
    title = "The reference orbit is not a circle"
    return (Callout(Status.WARNING, title, (text,)),)


def _missed_table(observation: Observation) -> Table:
    return Table(
        missed_frame(observation),
        (Column("reason", "Why"), Column("targets", "Targets", "", to_decimals(0))),
        "Targets that the pass does not see.",
        (Status.WARNING,) * len(set(observation.missed_reasons)),
    )


def _pass(observation: Observation) -> list[tuple[str, str]]:
    orbit = observation.orbit
    return [
        ("epoch of the formation's states", f"{_moment(observation)} UTC, the first segment"),
        (
            "pass",
            f"{observation.revolution} of {observation.passes} in the time searched that see any "
            "target",
        ),
        ("direction", "ascending" if observation.ascending else "descending"),
        ("look side", _side(observation)),
        ("mean semi-major axis", f"{fixed(orbit.semi_major_axis / 1e3, 3)} km"),
        ("mean inclination", f"{fixed(math.degrees(orbit.inclination), 3)}°"),
        ("mean eccentricity", fixed(observation.eccentricity, 5)),
        ("steering", law_name(observation.law)),
        ("boresight", boresight_text(observation.boresight)),
        (
            "strip, incidence at its edges",
            f"{fixed(math.degrees(observation.near_incidence), 2)}° … "
            f"{fixed(math.degrees(observation.far_incidence), 2)}°",
        ),
        ("geometry", _GEOMETRY[observation.reference]),
    ]


def _segments_table(observation: Observation) -> Table:
    frame = segments_frame(observation)
    count = len(frame)
    caption = (
        "The segments: time, place, and the geometry from the orbit. Azimuth is counted about "
        "nadir from the flight direction, positive to the left; the Doppler centroid is that of "
        f"the beam as observed, 0 where it is below {plain(ROUNDING)}\u00a0Hz"
    )
    if count > _MOST_LISTED:
        chosen = np.unique(np.linspace(0, count - 1, _MOST_LISTED).round().astype(int))
        frame = frame.iloc[chosen]
        caption += f". {len(chosen)} of {count}; segments.csv has all"
    frame = frame.assign(
        moment=[text[11:23] for text in frame["utc"]],
        slant_range_km=frame["slant_range_m"] / 1e3,
    )
    degrees = to_decimals(2)
    return Table(
        frame,
        (
            Column("segment", "No."),
            Column("moment", "UTC"),
            Column("latitude_deg", "Latitude", "°", to_decimals(3)),
            Column("longitude_deg", "Longitude", "°", to_decimals(3)),
            Column("height_m", "Height", "m", to_decimals(0)),
            Column("slant_range_km", "Range", "km", to_decimals(2)),
            Column("look_deg", "Look", "°", degrees),
            Column("incidence_deg", "Incidence", "°", degrees),
            Column("azimuth_deg", "Azimuth", "°", degrees),
            Column("doppler_hz", "Doppler", "Hz", _hertz),
        ),
        f"{caption}.",
    )


def _hertz(values: Sequence[float]) -> list[str]:
    return ["0" if abs(value) < ROUNDING else significant(float(value)) for value in values]
