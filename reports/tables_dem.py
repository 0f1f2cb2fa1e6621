"""The tables on the elevation model of a formation."""

from __future__ import annotations

import numpy as np
import pandas as pd

from insar import Scale
from optimize import DemVerdict, FailedDemand
from optimize.sensitivity import Quantity

from .dem_words import DEMANDS, SCALES, item_name, item_value
from .wording import MISSING, percent, probability, source_name


def criteria_frame(dem: DemVerdict) -> pd.DataFrame:
    """Demands of each class, and how the model stands to them."""
    return pd.DataFrame(
        [
            {
                "specification": judgment.specification.name
                + ("" if judgment.specification.confirmed else " (unconfirmed)"),
                "quantity": DEMANDS[one.quantity],
                "value_m": one.value,
                "limit_m": one.limit,
                "segment": MISSING if one.segment is None else str(one.segment + 1),
                "verdict": "pass" if one.passed else "fail",
            }
            for judgment in dem.judgments
            for one in judgment.criteria
        ]
    )


def scales_frame(dem: DemVerdict) -> pd.DataFrame:
    """Error of each source, with its scale, as an offset and a tilt; RMS over the segments."""
    accuracy = dem.accuracy
    rows: list[dict[str, object]] = [
        {
            "source": "random (phase noise)",
            "scale": SCALES[Scale.PIXEL],
            "offset_m": _rms(accuracy.random),
            "tilt_mm_km": float("nan"),
            "calibrated": "",
        }
    ]
    order = list(Scale)
    found = sorted(accuracy.sources.items(), key=lambda item: order.index(item[1].scale))
    for name, source in found:
        if not np.any(source.covariance):
            continue
        rows.append(
            {
                "source": source_name(name),
                "scale": SCALES[source.scale],
                "offset_m": _rms(source.offset),
                "tilt_mm_km": 1e6 * _rms(source.tilt),
                "calibrated": "adjusted" if source.removed else "stays",
            }
        )
    if accuracy.residual is not None:
        rows.append(
            {
                "source": "left by the adjustment",
                "scale": "",
                "offset_m": _rms(np.sqrt(accuracy.residual[..., 0, 0])),
                "tilt_mm_km": 1e6 * _rms(np.sqrt(accuracy.residual[..., 1, 1])),
                "calibrated": "",
            }
        )
    return pd.DataFrame(rows)


_LEAST = 0.005
"""Elasticity that a table rounds to nothing."""


def elasticities_frame(dem: DemVerdict) -> pd.DataFrame:
    """Elasticities of the errors to each item that moves one of them."""
    return pd.DataFrame(
        [
            {
                "item": item_name(one.item),
                "value": item_value(one.item, one.value),
                **{str(quantity): one.elasticities.get(quantity, np.nan) for quantity in Quantity},
            }
            for one in dem.sensitivities
            if any(abs(value) >= _LEAST for value in one.elasticities.values())
        ]
    )


def remedies_frame(failed: FailedDemand, *, prior: bool) -> pd.DataFrame:
    """Value of each item at which a failed demand would pass."""
    rows = []
    for remedy in failed.remedies:
        row = {
            "item": item_name(remedy.item),
            "value": item_value(remedy.item, remedy.value),
            "needed": "no value alone suffices"
            if remedy.needed is None
            else item_value(remedy.item, remedy.needed),
            "change": MISSING if remedy.needed is None else _change(remedy.needed / remedy.value),
        }
        if prior:
            known = remedy.probability
            row["probability"] = MISSING if known is None else probability(known)
        rows.append(row)
    return pd.DataFrame(rows)


def _change(factor: float) -> str:
    """Relative change in words.

    >>> _change(0.5), _change(1.25), _change(12.0)
    ('−50 %', '+25 %', '× 12')
    """
    if factor >= 3.0:
        return f"× {factor:.3g}"
    if factor <= 0.1:
        return f"÷ {1.0 / factor:.3g}"
    sign = "−" if factor < 1.0 else "+"
    return f"{sign}{percent(abs(factor - 1.0))}"


def _rms(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    return float(np.sqrt(np.mean(values**2)))
