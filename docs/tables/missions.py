"""What real missions print of themselves beside what their public parameters give."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from configs import EvaluateStudy, example_path, load_study
from configs.build import build_evaluate
from formation_opt.runs import Options, evaluate
from insar import Cell, Claim
from optimize import EvaluateResult
from optimize.claims import accuracy_of

from .markdown import digits, markdown_table

MISSIONS = (
    "tandem_x",
    "tandem_x_helix",
    "srtm_x",
    "tandem_l",
    "lutan_1",
    "hongtu_1",
    "cartwheel",
)


@cache
def result_of(name: str) -> EvaluateResult:
    """Result of a shipped study of a mission."""
    study = load_study(example_path(name)).study
    if not isinstance(study, EvaluateStudy):
        raise TypeError(f"{name} is not of kind evaluate")
    result = evaluate.run(study, build_evaluate(study), Options()).result
    if not isinstance(result, EvaluateResult):
        raise TypeError(f"{name} has another result")
    return result


def comparison() -> str:
    """Every printed figure, what the study gives, and the range that is possible."""
    rows = [
        [
            f"`{name}`",
            claim.text,
            claim.printed,
            _with_unit(claim.computed, claim),
            _range(claim),
            claim.verdict.value,
        ]
        for name in MISSIONS
        for claim in result_of(name).claims
    ]
    return markdown_table(["study", "figure", "printed", "computed", "possible", "verdict"], rows)


def _with_unit(value: float, claim: Claim) -> str:
    if math.isnan(value):
        return "—"
    return f"{digits(value, 3)} {claim.unit}".strip()


def _range(claim: Claim) -> str:
    if math.isnan(claim.lowest):
        return "—"
    if claim.highest - claim.lowest < 1e-9 * abs(claim.highest):
        return "no other"
    return f"{digits(claim.lowest, 3)} … {_with_unit(claim.highest, claim)}"


def curves() -> str:
    """Relative error at 90 % of TanDEM-X over the incidence, each coverage and combined."""
    result = result_of("tandem_x")
    shown = (*result.acquisitions, result.formation)
    incidence = np.degrees(result.problem.scene.incidence)
    rows = [
        [
            one.label,
            *(f"{value:.2f}" for value in accuracy_of(result.problem, one, Cell()).random_pair_90),
        ]
        for one in shown
    ]
    return markdown_table(
        [
            "random error at 90 % [m] at incidence",
            *(f"{angle:.0f}°" for angle in incidence),
        ],
        rows,
    )


def helix() -> str:
    """Height of ambiguity and unwrapping of the TanDEM-X helix over the argument of latitude."""
    result = result_of("tandem_x_helix")
    (pair,) = result.formation.pairs
    latitude = np.degrees(result.problem.mean_motion * result.problem.scene.times)
    rows = [
        ["perpendicular baseline [m]", *(f"{b:.0f}" for b in pair.perpendicular_baseline)],
        ["height of ambiguity [m]", *(f"{h:.0f}" for h in pair.height_of_ambiguity)],
        [
            "relative error, 1σ [m]",
            *(f"{e:.2f}" for e in result.formation.height_error.relative),
        ],
    ]
    return markdown_table(["argument of latitude", *(f"{u:.0f}°" for u in latitude)], rows)


TABLES: dict[str, Callable[[], str]] = {
    "missions": comparison,
    "mission_curves": curves,
    "mission_helix": helix,
}
