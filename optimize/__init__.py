"""Scores formations by the height-error model, and searches for the best within limits."""

from .acquisitions import assess_acquisitions
from .assessment import (
    Assessment,
    ImagePair,
    Motion,
    Rung,
    Unwrapping,
    assess,
    assess_placed,
)
from .certificate import Certificate, CertificateSettings, certify, judge_target
from .claims import FormationClaim, FormationQuantity, OpenNumber, Over, measure, possible
from .constraints import Bound, ConstraintReport, Constraints, FailureLimit, Limit
from .covariance import CovarianceSettings
from .dem_verdict import DemRequest, DemVerdict, FailedDemand, dem_verdict, looks_for
from .design_space import DesignSpace, DesignVariables
from .differential import DifferentialSettings
from .findings import findings
from .genetic import GeneticSettings
from .islands import IslandSettings, SearchMethod
from .noise_excess import NoiseExcess, noise_excess
from .problem import Evaluation, Problem
from .progress import GenerationRecord, Keeper
from .refuting import RefutationSettings, refuted
from .result import EvaluateResult, OptimizeResult
from .search import SearchResult, SearchSettings, compiled_loops, search
from .structured import structured_designs

__all__ = [
    "Assessment",
    "Bound",
    "Certificate",
    "CertificateSettings",
    "ConstraintReport",
    "Constraints",
    "CovarianceSettings",
    "DemRequest",
    "DemVerdict",
    "DesignSpace",
    "DesignVariables",
    "DifferentialSettings",
    "EvaluateResult",
    "Evaluation",
    "FailedDemand",
    "FailureLimit",
    "FormationClaim",
    "FormationQuantity",
    "GenerationRecord",
    "GeneticSettings",
    "ImagePair",
    "IslandSettings",
    "Keeper",
    "Limit",
    "Motion",
    "NoiseExcess",
    "OpenNumber",
    "OptimizeResult",
    "Over",
    "Problem",
    "RefutationSettings",
    "Rung",
    "SearchMethod",
    "SearchResult",
    "SearchSettings",
    "Unwrapping",
    "assess",
    "assess_acquisitions",
    "assess_placed",
    "certify",
    "compiled_loops",
    "dem_verdict",
    "findings",
    "judge_target",
    "looks_for",
    "measure",
    "noise_excess",
    "possible",
    "refuted",
    "search",
    "structured_designs",
]
