"""Exact phase statistics as the compiled loops read them: cubics, and a line of a table."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import ErrorBudget
from insar.errors import PhaseStatistics
from insar.statistics import efficiency_curves
from insar.statistics.table import VarianceLine, log_variance_line

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


class Efficiency(NamedTuple):
    """Curves of the efficiency of each segment and pair, a row each; of one value without."""

    cubics: Array
    first: Indices
    rate: Array
    contrast: Array
    intervals: int


def exact(errors: ErrorBudget) -> bool:
    """Whether phase noise follows from coherence and looks by its exact statistics."""
    return errors.phase_statistics is PhaseStatistics.EXACT and errors.phase_std is None


def efficiency(coherence: Array) -> Efficiency:
    """Curves of pairs whose coherence stays while their looks vary.

    Parameters
    ----------
    coherence : (S, K) — of each segment and pair.
    """
    curves = efficiency_curves(coherence)
    starts = np.unique(np.append(curves.first, len(curves.coefficients)))
    return Efficiency(
        cubics=np.ascontiguousarray(curves.coefficients),
        first=curves.first.astype(np.int64).ravel(),
        rate=np.ascontiguousarray(curves.rate).ravel(),
        contrast=np.ascontiguousarray(curves.contrast).ravel(),
        intervals=int(np.diff(starts)[0]),
    )


def variance_line(looks: float) -> VarianceLine:
    """Exact variances of pairs whose coherence varies while their looks stay.

    Parameters
    ----------
    looks : L.
    """
    return log_variance_line(looks)


NO_EFFICIENCY = Efficiency(
    np.zeros((1, 4)), np.zeros(1, dtype=np.int64), np.zeros(1), np.zeros(1), 1
)
NO_LINE = VarianceLine(0.0, 1.0, np.zeros(1))
