"""The report of a study of kind `optimize`: a formation that was searched for."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from optimize import Assessment, OptimizeResult, SearchResult

from ..document import Block, Document, Figure, Paragraph, Section
from ..figures.convergence import convergence_figure
from ..json_result import optimize_json
from ..reading import Shown
from ..study import Provenance, StudyInfo
from ..tables import formation_frame, height_error_frame
from ..wording import counted, meters, method_name
from . import sections
from .certificate import certificate_section
from .closing import closing_sections, formation_setting
from .coherence import coherence_section
from .comparison import comparison_section
from .dem import dem_section, limits_section
from .interferometry import pairs_section, unwrapping_section
from .methods import methods_section
from .observation import observation_section, unseen
from .refutation import refutation_section
from .verdict import optimize_verdict

_INITIAL_STYLE, _BEST_STYLE = 7, 0


def document(result: OptimizeResult, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of an optimization."""
    problem = result.problem
    initial, best = Shown(result.initial, _INITIAL_STYLE), Shown(result.best, _BEST_STYLE)
    others = [Shown(one, 1 + index) for index, one in enumerate(result.compare)]
    return sections.document(
        study,
        provenance,
        Section(
            "result",
            "Result",
            (
                *optimize_verdict(result, unseen(study.observation)),
                *sections.warning_blocks(result.warnings),
            ),
        ),
        observation_section(study.observation),
        sections.formation_section(problem, [best, initial]),
        sections.height_error_section(problem, [initial, best, *others]),
        _convergence_section(result),
        certificate_section(result),
        pairs_section(problem, result.critical_baseline, [result.best, result.initial]),
        coherence_section(problem, result.best),
        unwrapping_section(problem, [initial, best, *others], ladder=result.best),
        refutation_section(problem, result.best, (result.initial, *result.compare)),
        sections.attribution_section([initial, best]),
        dem_section(problem, result.dem),
        limits_section(problem, result.dem),
        sections.constraints_section([result.best, result.initial]),
        comparison_section(result.best, result.compare),
        methods_section(problem, search=result.search, observation=study.observation),
        *closing_sections(
            formation_setting(problem, result.critical_baseline, study), study, provenance
        ),
    )


def json(result: OptimizeResult) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to an optimization."""
    return optimize_json(result)


def csv(result: OptimizeResult) -> dict[str, pd.DataFrame]:
    """Tables of an optimization."""
    assessments: list[Assessment] = [result.initial, result.best, *result.compare]
    return {
        "height_error.csv": height_error_frame(result.problem, assessments),
        "formation.csv": formation_frame(assessments),
    }


def _convergence_section(result: OptimizeResult) -> Section:
    search = result.search
    text = f"{counted(search.evaluations, 'formation')} were scored"
    if search.compiled:
        text += " in compiled loops"
    if search.refined:
        last = search.history[-1].evaluations - search.history[-2].evaluations
        text += f", {last} of them by the local refinement"
    text += "."
    blocks: list[Block] = []
    if search.refined:
        text += _found_by(search)
    elif not search.interrupted:
        text += " The best was not refined."
    if search.interrupted:
        text += " The search was interrupted before its end."
    blocks.append(Paragraph(text))
    if any(record.feasible_fraction > 0.0 for record in search.history):
        blocks.append(
            Figure(
                convergence_figure(search),
                "Convergence. Above: region height error of the best feasible formation so far, "
                "and mean over the feasible formations of each generation. Below: feasible share "
                "of each generation.",
                "Line chart of the best and the mean height error against the number of "
                "formations scored, above an area chart of the feasible share.",
            )
        )
    return Section("convergence", "Convergence of the search", tuple(blocks))


def _found_by(search: SearchResult) -> str:
    """What each part of the search contributed."""
    algorithm = method_name(search.method)
    if not search.feasible:
        return f" Neither the {algorithm} nor the refinement met every limit."
    alone, refined = search.population_objective, search.refined_objective
    text = (
        f" The {algorithm} alone "
        + (
            f"reached {meters(alone)}"
            if math.isfinite(alone)
            else "found none that keeps every limit"
        )
        + "; local refinement of its best, mutually distant designs "
        + (f"brought {meters(refined)}." if math.isfinite(refined) else "did not find one either.")
    )
    if search.settings.structured == 0 or search.interrupted:
        return text
    if search.objective < (1.0 - 1e-6) * refined:
        return f"{text} Refined dumbbells and ladders brought {meters(search.objective)}."
    return f"{text} Refined dumbbells and ladders found nothing better."
