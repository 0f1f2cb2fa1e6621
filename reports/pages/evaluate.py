"""The report of a study of kind `evaluate`: a formation that was given."""

from __future__ import annotations

from typing import Any

import pandas as pd

from optimize import EvaluateResult

from ..document import Document, Section
from ..json_result import evaluate_json
from ..reading import Shown
from ..study import Provenance, StudyInfo
from ..tables import formation_frame, height_error_frame, positions_frame
from ..tables_steering import claims_frame
from . import sections
from .closing import closing_sections, formation_setting
from .coherence import coherence_section
from .comparison import comparison_section
from .dem import dem_section, limits_section
from .interferometry import pairs_section, unwrapping_section
from .methods import methods_section
from .mission_claims import mission_claims_section
from .observation import observation_section, unseen
from .placed import placed_section
from .refutation import refutation_section
from .verdict import evaluate_verdict


def document(result: EvaluateResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of an evaluation."""
    problem, formation = result.problem, Shown(result.formation, 0)
    apart = result.acquisitions
    others = [Shown(one, 1 + index) for index, one in enumerate((*apart, *result.compare))]
    single = apart or (result.formation,)
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (
                *evaluate_verdict(result, unseen(study.observation)),
                *sections.warning_blocks(result.warnings),
            ),
        ),
        observation_section(study.observation),
        sections.formation_section(problem, [formation])
        if result.formation.motion is not None
        else placed_section(problem, others[: len(apart)] or [formation]),
        sections.height_error_section(problem, [formation, *others]),
        pairs_section(problem, result.critical_baseline, single),
        coherence_section(problem, single[0]),
        unwrapping_section(problem, [formation, *others], ladder=result.formation),
        refutation_section(problem, result.formation, (*apart, *result.compare)),
        sections.attribution_section([formation, *others[: min(2, len(apart))]]),
        dem_section(problem, result.dem),
        limits_section(problem, result.dem),
        sections.constraints_section([result.formation]),
        comparison_section(result.formation, result.compare),
        mission_claims_section(result),
        methods_section(
            problem,
            search=None,
            observation=study.observation,
            formations=(result.formation, *result.compare),
        ),
        *closing_sections(
            formation_setting(problem, result.critical_baseline, study), study, provenance
        ),
    )


def json(result: EvaluateResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to an evaluation."""
    return evaluate_json(result)


def csv(result: EvaluateResult) -> dict[str, pd.DataFrame]:
    """Tables of an evaluation."""
    assessments = [result.formation, *result.acquisitions, *result.compare]
    tables = {"height_error.csv": height_error_frame(result.problem, assessments)}
    placed = [one for one in assessments if one.motion is None and not one.acquisitions]
    if len(placed) < len(assessments) - len(result.formation.acquisitions[:1]):
        tables["formation.csv"] = formation_frame(assessments)
    if placed:
        tables["positions.csv"] = positions_frame(placed)
    if result.claims:
        tables["claims.csv"] = claims_frame(result.claims)
    return tables
