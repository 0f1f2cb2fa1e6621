"""The report of a study of kind `evaluate`: a formation that was given."""

from __future__ import annotations

from typing import Any

import pandas as pd

from optimize import EvaluateResult

from ..document import Document, Section
from ..json_result import evaluate_json
from ..reading import Shown
from ..study import Provenance, StudyInfo
from ..tables import formation_frame, height_error_frame
from . import sections
from .closing import closing_sections, formation_setting
from .interferometry import pairs_section, unwrapping_section
from .methods import methods_section
from .observation import observation_section, unseen
from .refutation import refutation_section
from .verdict import evaluate_verdict


def document(result: EvaluateResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of an evaluation."""
    problem, formation = result.problem, Shown(result.formation, 0)
    others = [Shown(one, 1 + index) for index, one in enumerate(result.compare)]
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
        sections.formation_section(problem, [formation]),
        sections.height_error_section(problem, [formation, *others]),
        pairs_section(problem, result.critical_baseline, [result.formation]),
        unwrapping_section(problem, [formation, *others], ladder=result.formation),
        refutation_section(problem, result.formation, result.compare),
        sections.attribution_section([formation]),
        sections.constraints_section([result.formation]),
        sections.comparison_section(result.formation, result.compare),
        methods_section(problem, search=None, observation=study.observation),
        *closing_sections(
            formation_setting(problem, result.critical_baseline, study), study, provenance
        ),
    )


def json(result: EvaluateResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to an evaluation."""
    return evaluate_json(result)


def csv(result: EvaluateResult) -> dict[str, pd.DataFrame]:
    """Tables of an evaluation."""
    assessments = [result.formation, *result.compare]
    return {
        "height_error.csv": height_error_frame(result.problem, assessments),
        "formation.csv": formation_frame(assessments),
    }
