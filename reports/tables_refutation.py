"""Tables of a simulation that tries to refute the error model."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pandas as pd

from insar.simulation import SegmentRefutation, Simulated
from optimize import Assessment

from .wording import meters, percent, quantity


def refutation_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """One row for each formation and each of its simulated segments.

    Parameters
    ----------
    assessments : those that were simulated.
    """
    rows = [
        {
            "label": one.label,
            "segment": segment.segment + 1,
            "quantity": name,
            "predicted": predicted,
            "simulated": simulated,
            "deviation": deviation,
            "verdict": segment.verdict,
        }
        for one in assessments
        if one.refutation is not None
        for segment in one.refutation.segments
        for name, predicted, simulated, deviation in _compared(segment)
    ]
    return pd.DataFrame(rows)


def _compared(segment: SegmentRefutation) -> list[tuple[str, str, str, float]]:
    """Quantity, prediction, simulation and deviation, as people read them."""
    wrong = 100.0 * segment.wrong.value, 100.0 * segment.wrong.sampling_error
    return [
        (
            "total error, right cycles",
            meters(segment.predicted_total, 4),
            _plus_minus(segment.right_cycles),
            segment.total.deviation,
        ),
        (
            "relative error, right cycles",
            meters(segment.predicted_relative, 4),
            _plus_minus(segment.relative),
            segment.relative_error.deviation,
        ),
        (
            "pixels with a wrong cycle",
            percent(segment.predicted_failure),
            f"{wrong[0]:.2f} ± {quantity(f'{wrong[1]:.2f}', '%')}",
            segment.wrong_cycles.deviation,
        ),
    ]


def _plus_minus(simulated: Simulated) -> str:
    """Figure with its sampling error, to the same decimals."""
    decimals = max(0, 1 - math.floor(math.log10(max(simulated.sampling_error, 1e-9))))
    value, error = (f"{number:.{decimals}f}" for number in simulated)
    return f"{value} ± {quantity(error, 'm')}"


def gain_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """What each estimate makes of the data, against the height known beforehand.

    Parameters
    ----------
    assessments : those that were simulated.
    """
    rows = [
        {
            "label": one.label,
            "segment": segment.segment + 1,
            "prior_height_std_m": segment.prior_height_std,
            "unwrapped_m": segment.unwrapped.value,
            "most_likely_m": segment.most_likely.value,
            "two_thirds_m": segment.two_thirds,
            "best_m": segment.best.value,
            "gain_m": segment.gain,
            "bits": segment.bits,
        }
        for one in assessments
        if one.refutation is not None
        for segment in one.refutation.segments
    ]
    return pd.DataFrame(rows)
