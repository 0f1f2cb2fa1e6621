"""Where the geometry of a formation study lies, when its scene comes from an orbit."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from insar import LookSide
from insar.observe import Observation, Reference
from insar.observe.agile.staring import StaringScene

from ..document import Block, Column, Figure, Paragraph, Section, Status, Strong, Table
from ..figures.observation_map import observation_map
from ..reading_steering import ROUNDING
from ..steering_words import boresight_text, law_name
from ..tables_observation import missed_frame, segments_frame
from ..wording import counted, fixed, moment_text, plain, significant, to_decimals
from .closing import facts
from .flown import eccentricity_block, orbit_rows
from .staring import staring_section

_MOST_LISTED = 24
"""Rows of the table of segments where there are many more, at equal steps."""

_LISTED_IN_FULL = 32
"""Segments of which a table leaves out none: a few rows more are better than a gap."""

_A_WHOLE = 0.02
"""Part of a revolution by which the segments of a whole one may miss it: they are moments of it."""

_A_BEAM = 1e-9
"""Angle off the boresight below which a segment is a point of the boresight itself [rad]."""


def observation_section(observation: Observation | StaringScene | None) -> Section | None:
    """The pass, maps and segments; None where the study gives its geometry itself."""
    if observation is None:
        return None
    if not isinstance(observation, Observation):
        return staring_section(observation)
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
    blocks += [eccentricity_block(observation.eccentricity), facts(_pass(observation), "The pass.")]
    blocks.append(_segments_table(observation))
    return Section("observation", "Where the geometry lies", tuple(blocks))


def unseen(observation: Observation | StaringScene | None) -> int:
    """Targets that the pass does not see."""
    return len(observation.missed_reasons) if isinstance(observation, Observation) else 0


def _seen(observation: Observation) -> tuple[str, ...]:
    missed = len(observation.missed_reasons)
    seen = len(observation.scene)
    text: tuple[str, ...] = (
        "The scene is ",
        Strong(f"{_stretch(observation)}, looking {_side(observation)}"),
        f", of a real orbit over the WGS84 ellipsoid: {counted(seen, 'segment')}"
        + (f" of {counted(seen + missed, 'target')}" if missed else "")
        + f", from {_moment(observation)} UTC on. ",
    )
    if missed:
        take = "takes" if missed == 1 else "take"
        text += (Strong(f"{counted(missed, 'target')} not seen by this pass {take} no part. "),)
    return (*text, _REFERENCE[observation.reference])


def _stretch(observation: Observation) -> str:
    """What is flown: a pass, or so much of a revolution that it goes both north and south."""
    if not _turns(observation):
        return f"one {_direction(observation)} pass"
    revolutions = float(np.ptp(observation.scene.times)) * observation.orbit.mean_motion / math.tau
    if abs(revolutions - 1.0) < _A_WHOLE:
        return "a whole revolution"
    return f"a stretch of {fixed(revolutions, 2)} revolutions"


def _turns(observation: Observation) -> bool:
    """Whether the boresight sweeps a band in which the satellite turns north or south."""
    swept = bool(np.all(np.abs(observation.off_boresight) < _A_BEAM))
    northward = np.diff(observation.latitude) > 0.0
    return swept and bool(np.any(northward) and not np.all(northward))


def _direction(observation: Observation) -> str:
    return "ascending" if observation.ascending else "descending"


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
    return moment_text(observation.epoch)


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
        *orbit_rows(observation),
        ("pass", f"{observation.pass_number} of {observation.passes} found in the time searched"),
        (
            "direction",
            f"{_direction(observation)} at the first segment"
            if _turns(observation)
            else _direction(observation),
        ),
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
    if count > _LISTED_IN_FULL:
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
