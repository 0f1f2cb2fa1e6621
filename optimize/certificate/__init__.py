"""Lower bounds of the height error that no design within the limits can beat.

cvxpy is imported in `semidefinite` only, when it is used.
"""

from .certify import CertificateSettings, certify
from .result import (
    Certificate,
    Convergence,
    Infeasibility,
    LowerBound,
    Method,
    Relief,
    TargetVerdict,
)
from .target import judge_target

__all__ = [
    "Certificate",
    "CertificateSettings",
    "Convergence",
    "Infeasibility",
    "LowerBound",
    "Method",
    "Relief",
    "TargetVerdict",
    "certify",
    "judge_target",
]
