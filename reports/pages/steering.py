"""The report of a study of kind `steering`: what each steering law does, and when to take which."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd

from insar import LookSide
from insar.observe import CaseResult, SteeringResult

from ..document import Document, Section, Table
from ..json_steering import steering_json
from ..steering_words import boresight_text, law_name
from ..study import Provenance, StudyInfo
from ..tables_steering import steering_tables
from ..wording import fixed, joined, plain
from . import sections
from .claims import claims_section
from .closing import closing_sections, facts
from .steering_methods import steering_methods
from .steering_sections import (
    attitude_section,
    doppler_section,
    rates_section,
    swath_section,
)
from .steering_studies import compensation_section, selection_section
from .steering_verdict import steering_verdict


def document(result: SteeringResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of a study of steering."""
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (*steering_verdict(result), *sections.warning_blocks(result.warnings)),
        ),
        claims_section(result.claims, "stated inputs"),
        attitude_section(result.cases),
        rates_section(result.cases),
        doppler_section(result.cases),
        swath_section(result.cases),
        selection_section(result.selections),
        compensation_section(result.compensation),
        steering_methods(result),
        *closing_sections(_setting(result), study, provenance),
    )


def json(result: SteeringResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to a study of steering."""
    return steering_json(result)


def csv(result: SteeringResult) -> dict[str, pd.DataFrame]:
    """Tables of a study of steering."""
    return steering_tables(result)


def _setting(result: SteeringResult) -> Table:
    rows = [row for case in result.cases for row in _case_rows(case)]
    return facts(rows, "The setting: the orbit, the radar and the laws of each case.")


def _case_rows(case: CaseResult) -> list[tuple[str, str]]:
    radar = case.case
    revolutions = np.ptp(case.argument_of_latitude) / (2.0 * math.pi)
    offsets = joined([f"{plain(value)}°" for value in np.rad2deg(radar.swath_offsets)] or ["none"])
    side = "left" if radar.side is LookSide.LEFT else "right"
    return [
        (
            f"{case.name}: orbit",
            f"mean semi-major axis {fixed(case.semi_major_axis / 1e3, 3)} km, eccentricity "
            f"{fixed(case.eccentricity, 5)}, inclination "
            f"{fixed(math.degrees(case.inclination), 3)}°; "
            f"{fixed(float(case.altitude.min()) / 1e3, 1)} … "
            f"{fixed(float(case.altitude.max()) / 1e3, 1)} km above the ellipsoid",
        ),
        (
            f"{case.name}: time",
            f"{radar.times.size} samples over {fixed(float(np.ptp(radar.times)), 1)} s "
            f"({fixed(float(revolutions), 2)} revolutions), from "
            f"{radar.trajectory.epoch:%Y-%m-%d %H:%M:%S} UTC + {plain(float(radar.times[0]))} s",
        ),
        (
            f"{case.name}: radar",
            f"wavelength {plain(1e2 * radar.wavelength)} cm, looking {side}, boresight at "
            f"{boresight_text(radar.boresight)}; elevations off it {offsets}",
        ),
        (f"{case.name}: laws", joined([law_name(law) for law in radar.laws])),
    ]
