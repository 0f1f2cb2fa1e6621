"""The machine-readable result; `result.schema.json` beside this module describes it."""

from __future__ import annotations

import json
from importlib import resources

import numpy as np

from optimize import Assessment, EvaluateResult, ImagePair, OptimizeResult, Problem

from .json_certificate import certificate_json
from .json_claims import claims_json
from .json_dem import dem_json
from .json_numbers import Json, finite, finite_list
from .json_observation import observation_json
from .json_refutation import refutation_json
from .reading import image_name, pair_satellites, unmeasured_reason
from .study import Provenance, StudyInfo

SCHEMA_VERSION = 1


def result_schema() -> Json:
    """JSON Schema (2020-12) of ``result.json``."""
    text = resources.files(__package__).joinpath("result.schema.json").read_text("utf-8")
    schema: Json = json.loads(text)
    return schema


def result_json(body: Json, *, study: StudyInfo, provenance: Provenance) -> bytes:
    """Envelope around the results of a study.

    Parameters
    ----------
    body : the part that depends on the kind of study, with its ``warnings``.
    study : the study that was run.
    provenance : how it was run.

    Returns
    -------
    UTF-8 text that ends in a newline; but for ``provenance`` the same study and seed give the
    same bytes.
    """
    document = {
        "schema_version": SCHEMA_VERSION,
        "study": {
            "name": study.name,
            "kind": study.kind,
            "description": study.description,
            "config_sha256": study.config_sha256,
            "inputs": [{"file": name, "sha256": digest} for name, digest in study.inputs],
            "inferred": [{"key": key, "value": value} for key, value in study.inferred],
        },
        "provenance": {
            "version": provenance.version,
            "seed": provenance.seed,
            "python": provenance.python,
            "platform": provenance.platform,
            "packages": dict(provenance.packages),
            "started": provenance.started,
            "wall_s": provenance.wall_s,
            "evaluations": provenance.evaluations,
            "compiled": provenance.compiled,
            "command": provenance.command,
        },
        **_observed(study),
        **body,
    }
    text = json.dumps(document, ensure_ascii=False, indent=2, allow_nan=False)
    return f"{text}\n".encode()


def _observed(study: StudyInfo) -> Json:
    """Block of the observation, where the scene comes from one."""
    if study.observation is None:
        return {}
    return {"observation": observation_json(study.observation)}


def optimize_json(result: OptimizeResult) -> Json:
    """Results of a study of kind ``optimize``."""
    problem, search = result.problem, result.search
    return {
        "critical_baseline_m": finite(result.critical_baseline),
        "mean_motion_rad_s": finite(problem.mean_motion),
        "initial": assessment_json(problem, result.initial),
        "best": assessment_json(problem, result.best),
        "compare": [assessment_json(problem, one) for one in result.compare],
        "search": {
            "method": search.method.value,
            "genetic_best_m": finite(search.population_objective),
            "refined_best_m": finite(search.refined_objective),
            "best_m": finite(search.objective),
            "feasible": search.feasible,
            "interrupted": search.interrupted,
        },
        "history": [
            {
                "generation": record.generation,
                "evaluations": record.evaluations,
                "best_m": finite(record.best),
                "mean_m": finite(record.mean),
                "feasible_fraction": finite(record.feasible_fraction),
                "refinement": record.refinement,
            }
            for record in search.history
        ],
        "dem": dem_json(result.dem),
        "certificate": certificate_json(result),
        "warnings": [*result.notices, *result.warnings],
    }


def evaluate_json(result: EvaluateResult) -> Json:
    """Results of a study of kind ``evaluate``."""
    problem = result.problem
    return {
        "evaluate": {
            "critical_baseline_m": finite(result.critical_baseline),
            "mean_motion_rad_s": finite(problem.mean_motion),
            "formation": assessment_json(problem, result.formation),
            "acquisitions": [assessment_json(problem, one) for one in result.acquisitions],
            "compare": [assessment_json(problem, one) for one in result.compare],
            "dem": dem_json(result.dem),
            "claims": claims_json(result.claims),
            "open": [one._asdict() for one in result.opened],
        },
        "warnings": list(result.warnings),
    }


def assessment_json(problem: Problem, assessment: Assessment) -> Json:
    """One formation."""
    error, unwrapping = assessment.height_error, assessment.unwrapping
    return {
        "label": assessment.label,
        "acquisitions": list(assessment.acquisitions),
        "satellites": _satellites(assessment),
        "height_error": {
            "region_rms_m": finite(error.region),
            "relative_rms_m": finite(error.relative_region),
            "segments_m": finite_list(error.total),
            "relative_segments_m": finite_list(error.relative),
            "terms_m": {name: finite(term) for name, term in error.region_terms.items()},
            "reason": unmeasured_reason(assessment),
        },
        "unwrapping": None
        if unwrapping is None
        else {
            "probability": finite(unwrapping.probability.min()),
            "prior_height_std_m": finite(unwrapping.prior_height_std),
            "decorrelated": finite(unwrapping.decorrelated.min()),
            "ceiling": finite(unwrapping.ceiling.min()),
            "segments": finite_list(unwrapping.probability),
            "worst_segment": unwrapping.worst_segment + 1,
            "rungs": [
                {
                    "images": _images(problem, assessment, rung.images),
                    "phase_std_rad": finite(rung.phase_std),
                    "probability": finite(rung.probability),
                }
                for rung in unwrapping.rungs
            ],
        },
        "pairs": [_pair_json(problem, assessment, pair) for pair in assessment.pairs],
        "separations": _separations(assessment),
        "constraints": [
            {
                "name": report.limit.name,
                "value": finite(report.value),
                "limit": finite(report.limit.value),
                "bound": report.limit.bound.name.lower(),
                "unit": report.limit.unit,
                "margin": finite(report.margin),
                "satisfied": report.satisfied,
                "remedy": report.limit.remedy,
            }
            for report in assessment.constraints
        ],
        "refutation": refutation_json(assessment.refutation),
        "feasible": assessment.feasible,
    }


def _satellites(assessment: Assessment) -> list[Json]:
    """State of each satellite; of one that is placed, its positions in the segments."""
    if assessment.acquisitions:
        return [{"name": name} for name in assessment.names]
    if assessment.motion is None:
        positions = np.swapaxes(assessment.scene_positions, 0, 1)
        return [
            {"name": name, "segment_positions_rtn_m": [finite_list(row) for row in rows]}
            for name, rows in zip(assessment.names, positions, strict=True)
        ]
    return [
        {
            "name": name,
            "z0_m": finite(state[0]),
            "zdot0_m_s": finite(state[3]),
            "position_rtn_m": finite_list(state[:3]),
            "velocity_rtn_m_s": finite_list(state[3:]),
        }
        for name, state in zip(assessment.names, assessment.motion.states, strict=True)
    ]


def _separations(assessment: Assessment) -> list[Json] | None:
    """Closest approaches; None where only positions are known."""
    if assessment.motion is None:
        return None
    return [
        {
            "satellites": [assessment.names[first], assessment.names[second]],
            "min_separation_m": finite(separation),
        }
        for (first, second), separation in zip(
            assessment.separation_pairs, assessment.motion.separations, strict=True
        )
    ]


def _pair_json(problem: Problem, assessment: Assessment, pair: ImagePair) -> Json:
    zero = not np.all(np.isfinite(pair.height_of_ambiguity))
    return {
        "images": _images(problem, assessment, pair.images),
        "satellites": [
            assessment.names[index] for index in pair_satellites(problem, assessment, pair.images)
        ],
        "perpendicular_baseline_m": finite_list(pair.perpendicular_baseline),
        "azimuth_baseline_m": finite_list(pair.azimuth_baseline),
        "baseline_over_critical": finite_list(pair.baseline_over_critical),
        "height_of_ambiguity_m": finite_list(pair.height_of_ambiguity),
        "coherence": finite_list(pair.coherence),
        "looks": finite_list(pair.looks),
        "coherence_factors": {name: finite_list(value) for name, value in pair.factors.items()},
        "common_range_band": finite_list(pair.common_range),
        "common_azimuth_band": finite_list(pair.common_azimuth),
        "volume_bias_m": None if pair.volume_bias is None else finite_list(pair.volume_bias),
        "reason": "the perpendicular baseline is zero where the height of ambiguity is null"
        if zero
        else None,
    }


def _images(problem: Problem, assessment: Assessment, images: tuple[int, int]) -> list[str]:
    return [image_name(problem, assessment, image) for image in images]
