"""The elevation model of a formation, in the machine-readable result."""

from __future__ import annotations

import math

import numpy as np

from insar import Scale
from insar.dem import Judgment
from optimize import DemVerdict, FailedDemand
from optimize.sensitivity import Quantity, Remedy, Sensitivity

from .json_numbers import Json, finite, finite_list


def dem_json(dem: DemVerdict | None) -> Json | None:
    """Block of a run; None where no elevation model was judged."""
    if dem is None:
        return None
    accuracy = dem.accuracy
    return {
        "label": dem.label,
        "cell_m": finite(accuracy.cell.size),
        "swath_m": finite(accuracy.cell.swath),
        "posting_m": _optional(dem.posting),
        "posting_of_looks_m": _optional(dem.posting_of_looks),
        "relative_90_m": finite(accuracy.relative_90.max()),
        "absolute_90_m": finite(accuracy.absolute_90.max()),
        "segments": {
            "random_m": finite_list(accuracy.random),
            "relative_m": finite_list(accuracy.relative),
            "absolute_m": finite_list(accuracy.absolute),
            "relative_90_m": finite_list(accuracy.relative_90),
            "absolute_90_m": finite_list(accuracy.absolute_90),
        },
        "sources": [
            {
                "source": name,
                "scale": str(source.scale),
                "calibrated": source.removed,
                "offset_m": finite(_rms(source.offset)),
                "tilt": finite(_rms(source.tilt)),
            }
            for name, source in accuracy.sources.items()
        ],
        "scales": [
            {"scale": str(scale), "systematic_m": finite(_rms(accuracy.systematic(scale)))}
            for scale in Scale
            if scale is not Scale.PIXEL
        ],
        "judgments": [_judgment(one) for one in dem.judgments],
        "failed": [_failed(one) for one in dem.failed],
        "sensitivities": [_sensitivity(one) for one in dem.sensitivities],
        "notes": list(dem.notes),
    }


def _judgment(judgment: Judgment) -> Json:
    return {
        "specification": judgment.specification.name,
        "confirmed": judgment.specification.confirmed,
        "passed": judgment.passed,
        "criteria": [
            {
                "quantity": str(one.quantity),
                "value_m": finite(one.value),
                "limit_m": finite(one.limit),
                "passed": one.passed,
                "segment": None if one.segment is None else one.segment + 1,
            }
            for one in judgment.criteria
        ],
    }


def _failed(failed: FailedDemand) -> Json:
    return {
        "specification": failed.specification,
        "quantity": str(failed.criterion.quantity),
        "remedies": [_remedy(one) for one in failed.remedies],
    }


def _remedy(remedy: Remedy) -> Json:
    return {
        "item": remedy.item,
        "unit": remedy.unit,
        "value": finite(remedy.value),
        "needed": _optional(remedy.needed),
        "probability": _optional(remedy.probability),
    }


def _sensitivity(one: Sensitivity) -> Json:
    return {
        "item": one.item,
        "unit": one.unit,
        "value": finite(one.value),
        "elasticities": {
            str(quantity): finite(one.elasticities.get(quantity, math.nan)) for quantity in Quantity
        },
    }


def _optional(value: float | None) -> float | None:
    return None if value is None else finite(value)


def _rms(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    return float(np.sqrt(np.mean(values**2)))
