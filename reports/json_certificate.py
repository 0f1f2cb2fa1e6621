"""What is proved of a result, in the machine-readable result."""

from __future__ import annotations

from optimize import OptimizeResult
from optimize.certificate import Infeasibility, TargetVerdict

from .json_numbers import Json, finite


def certificate_json(result: OptimizeResult) -> Json:
    """Block of an optimization: the bound and its gap, or why there is none."""
    certificate = result.certificate
    if certificate is None:
        return {
            "lower_bound_m": None,
            "gap": None,
            "method": None,
            "reason": result.certificate_reason,
            "bounds": [],
            "assumptions": [],
            "boxes": 0,
            "infeasibility": None,
            "target": None,
        }
    strongest, blocked = certificate.strongest, certificate.infeasibility
    return {
        "lower_bound_m": finite(certificate.lower_bound),
        "gap": finite(certificate.gap),
        "method": None if strongest is None else str(strongest.method),
        "reason": _reason(result),
        "bounds": [
            {
                "method": str(bound.method),
                "lower_bound_m": finite(bound.value),
                "reason": bound.reason or None,
            }
            for bound in certificate.bounds
        ],
        "assumptions": list(certificate.assumptions),
        "boxes": certificate.boxes,
        "infeasibility": None if blocked is None else _impossible(blocked),
        "target": _target(certificate.target),
    }


def _target(target: TargetVerdict | None) -> Json | None:
    if target is None:
        return None
    impossible = target.impossible
    missed = "not_known" if impossible is None else "impossible"
    return {
        "height_error_m": target.height_error,
        "verdict": "reached" if target.reached else missed,
        "proof": None if impossible is None else _impossible(impossible),
    }


def _impossible(proof: Infeasibility) -> Json:
    return {
        "statement": proof.statement,
        "reliefs": [
            {
                "name": relief.name,
                "unit": relief.unit,
                "limit": finite(relief.limit),
                "blocks_to": finite(relief.blocks_to),
                "passes_at": finite(relief.passes_at),
            }
            for relief in proof.reliefs
        ],
    }


def _reason(result: OptimizeResult) -> str | None:
    """Why there is no gap; None where there is one."""
    certificate = result.certificate
    if certificate is None or certificate.strongest is None:
        return "no bound applies"
    return None if result.best.feasible else "no feasible formation was found"
