"""The report of a study of kind `coverage`: how many satellites keep a place in view."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd

from insar.observe.coverage.results import CoverageResult

from ..agile_words import visibility_text, walker_name
from ..document import Document, Section, Table
from ..json_coverage import coverage_json
from ..study import Provenance, StudyInfo
from ..tables_coverage import coverage_tables
from ..wording import counted, fixed, latitude_text, plain, sentences
from . import sections
from .claims import claims_section
from .closing import closing_sections, facts
from .coverage_methods import coverage_methods
from .coverage_sections import search_section, simulation_section, sizing_section
from .coverage_verdict import coverage_verdict, days_text


def document(result: CoverageResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of a study of coverage."""
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (
                *coverage_verdict(result),
                *sections.warning_blocks(sentences(result.warnings)),
                *sections.inferred_blocks(study),
            ),
        ),
        claims_section(result.claims, "inputs of this study", digits=4),
        sizing_section(result.shortfall),
        simulation_section(result.simulations),
        search_section(result.search),
        coverage_methods(result),
        *closing_sections(_setting(result), study, provenance),
    )


def json(result: CoverageResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to a study of coverage."""
    return coverage_json(result)


def csv(result: CoverageResult) -> dict[str, pd.DataFrame]:
    """Tables of a study of coverage."""
    return coverage_tables(result)


def _setting(result: CoverageResult) -> Table:
    rows = []
    if result.shortfall is not None:
        found = result.shortfall
        rows += [
            ("sized constellation", walker_name(found.walker)),
            ("sized for", f"an incidence of up to {_degrees(found.sizing.max_incidence)}°"),
            ("explained at", latitude_text(math.degrees(found.latitude))),
            ("visibility", visibility_text(found.visibility)),
        ]
    for number, one in enumerate(result.simulations, 1):
        degrees = np.rad2deg(np.unique(one.latitude))
        rows.append(
            (
                f"simulation {number}",
                f"{walker_name(one.walker)}, over {days_text(one.duration)}; "
                f"{counted(one.cover.size, 'place')} at latitudes of "
                f"{_ends(degrees)}; {visibility_text(one.visibility)}",
            )
        )
    if result.search is not None:
        search = result.search
        rows += [
            ("search", f"{plain(search.altitude / 1e3)} km, {visibility_text(search.visibility)}"),
            ("band of the search", f"latitudes of {_ends(np.rad2deg(search.latitudes))}"),
        ]
    return facts(rows, "The setting: constellations, places and what a satellite sees.")


def _degrees(angle: float) -> str:
    return plain(math.degrees(angle))


def _ends(degrees: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
    low, high = fixed(float(degrees[0]), 2), fixed(float(degrees[-1]), 2)
    return f"{low}°" if low == high else f"{low}° … {high}°"
