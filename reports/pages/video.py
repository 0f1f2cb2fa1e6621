"""The report of a study of kind `video`: a place filmed by a body that turns as a whole."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from insar.observe.agile.video_results import VideoResult

from ..agile_words import yaw_law_name
from ..document import Document, Section, Table
from ..json_video import video_json
from ..study import Provenance, StudyInfo
from ..tables_video import video_tables
from ..wording import plain, sentences
from . import sections
from .claims import claims_section
from .closing import closing_sections, facts
from .spotlight import agility_rows, place_text, searched_rows
from .turning import rates_section
from .video_footprints import footprint_section, pointing_section, yaw_section
from .video_methods import video_methods
from .video_sections import attitude_section, frames_section, pass_section
from .video_verdict import video_verdict


def document(result: VideoResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of a study of video."""
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (
                *video_verdict(result),
                *sections.warning_blocks(sentences(result.warnings)),
                *sections.inferred_blocks(study),
            ),
        ),
        claims_section(result.claims, "inputs of this study", digits=4),
        footprint_section(result),
        frames_section(result),
        yaw_section(result),
        pass_section(result),
        attitude_section(result),
        rates_section(result.times, result.profile, result.request.agility),
        pointing_section(result),
        video_methods(result),
        *closing_sections(_setting(result), study, provenance),
    )


def json(result: VideoResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to a study of video."""
    return video_json(result)


def csv(result: VideoResult) -> dict[str, pd.DataFrame]:
    """Tables of a study of video."""
    return video_tables(result)


def _setting(result: VideoResult) -> Table:
    request = result.request
    beam = (request.azimuth_beamwidth, request.elevation_beamwidth)
    widths = " × ".join(f"{plain(math.degrees(width))}°" for width in beam)
    errors = (plain(math.degrees(e)) if e else "0" for e in request.pointing_error)
    rows = [
        ("aim point", place_text(request.latitude, request.longitude, request.height)),
        *searched_rows(request),
        ("wavelength", f"{plain(1e2 * request.wavelength)} cm"),
        ("resolution of a frame in azimuth", f"{plain(request.resolution)} m"),
        ("frame rate", f"{plain(request.frame_rate)} Hz"),
        ("film", f"{plain(request.duration)} s, centered on zero Doppler"),
        ("data in common, at most", f"{plain(100.0 * request.max_overlap)} %"),
        ("beamwidths in azimuth and elevation", widths),
        ("yaw law", yaw_law_name(request.yaw_law)),
        ("reference time", f"{plain(request.reference_time)} s from zero Doppler"),
        ("pointing error about X, Y, Z, standard deviation", f"{', '.join(errors)}°"),
        *agility_rows(request),
        (
            "samples",
            f"{len(result.times)} of attitude, {len(result.footprints.times)} footprints",
        ),
    ]
    return facts(rows, "The setting: the place, the pass that is searched, film and satellite.")
