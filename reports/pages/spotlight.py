"""The report of a study of kind `spotlight`: one place, imaged by a body that turns as a whole."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from insar.observe.agile.spotlight_results import SpotlightRequest, SpotlightResult

from ..agile_words import heading_name, side_name
from ..document import Document, Section, Table
from ..json_spotlight import spotlight_json
from ..study import Provenance, StudyInfo
from ..tables_spotlight import spotlight_tables
from ..wording import fixed, latitude_text, longitude_text, plain, sentences
from . import sections
from .claims import claims_section
from .closing import closing_sections, facts
from .spotlight_methods import spotlight_methods
from .spotlight_sections import (
    aim_section,
    attitude_section,
    echo_section,
    pass_section,
)
from .spotlight_verdict import spotlight_verdict
from .turning import limit_text, rates_section


def document(result: SpotlightResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of a study of spotlight."""
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (
                *spotlight_verdict(result),
                *sections.warning_blocks(sentences(result.warnings)),
                *sections.inferred_blocks(study),
            ),
        ),
        claims_section(result.claims, "inputs of this study", digits=5),
        pass_section(result),
        attitude_section(result),
        rates_section(result.times, result.profile, result.request.agility),
        aim_section(result),
        echo_section(result),
        spotlight_methods(result),
        *closing_sections(_setting(result), study, provenance),
    )


def json(result: SpotlightResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to a study of spotlight."""
    return spotlight_json(result)


def csv(result: SpotlightResult) -> dict[str, pd.DataFrame]:
    """Tables of a study of spotlight."""
    return spotlight_tables(result)


def _setting(result: SpotlightResult) -> Table:
    request = result.request
    rows = [
        ("aim point", place_text(request.latitude, request.longitude, request.height)),
        *searched_rows(request),
        ("wavelength", f"{plain(1e2 * request.wavelength)} cm"),
        ("resolution in azimuth", f"{plain(request.resolution)} m"),
        ("weighting factor", plain(request.weighting)),
        ("off-axis angle of the beam, positive to the left", f"{_degrees(request.off_axis)}°"),
        (
            "phase center from the center of mass, X, Y, Z",
            f"{', '.join(plain(part) if part else '0' for part in request.phase_center)} m",
        ),
        ("sliding factor", "0, staring" if not request.sliding_factor else _sliding(request)),
        *agility_rows(request),
        ("samples", f"{len(result.times)} over {plain(float(result.times[-1] * 2.0))} s"),
    ]
    return facts(rows, "The setting: the place, the pass that is searched, radar and satellite.")


def _degrees(angle: float) -> str:
    return plain(math.degrees(angle)) if angle else "0"


def _sliding(request: SpotlightRequest) -> str:
    return f"{plain(request.sliding_factor)}, over a scene of {plain(request.scene_length)} m"


def place_text(latitude: float, longitude: float, height: float) -> str:
    """Place on the ellipsoid."""
    return (
        f"{latitude_text(math.degrees(latitude), 4)}, {longitude_text(math.degrees(longitude), 4)}"
        f", {fixed(height, 0)} m above the ellipsoid"
    )


def searched_rows(request: Any) -> list[tuple[str, str]]:
    """Which pass was asked for, of a spotlight or a film."""
    near, far = (math.degrees(a) for a in (request.near_incidence, request.far_incidence))
    side = "either side" if request.side is None else f"the {side_name(request.side)} side"
    return [
        ("epoch of the orbit", f"{request.trajectory.epoch:%Y-%m-%d %H:%M:%S} UTC"),
        (
            "searched",
            f"{plain(request.start) if request.start else '0'} … {plain(request.stop)} s since "
            f"the epoch, {request.direction.value} passes",
        ),
        (
            "seen from",
            f"{side}, at an incidence of {fixed(near, 2)}° … {fixed(far, 2)}° at zero Doppler",
        ),
    ]


def agility_rows(request: Any) -> list[tuple[str, str]]:
    """What the satellite can do, of a spotlight or a film."""
    if request.agility is None:
        return [("agility", "no limits given")]
    return [
        ("largest rate [°/s]", limit_text(request.agility.max_rate)),
        ("largest acceleration [°/s²]", limit_text(request.agility.max_acceleration)),
    ]


def pass_text(result: Any) -> str:
    """Pass of a spotlight or a film in words."""
    plan = result.plan
    return (
        f"{plan.number} of {plan.passes} in the time searched, flying "
        f"{heading_name(ascending=plan.ascending)}, looking {side_name(plan.side)}"
    )
