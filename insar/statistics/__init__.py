"""Statistics of the multilook interferometric phase: exact, and beside the Cramér-Rao bound.

The phase of an interferogram of coherence γ, averaged over L looks, with L any positive number:
the distribution is a constant in noise whose signal power is gamma distributed, for which L need
not be whole. Below one look, where spectral filtering leaves less than a resolution cell's worth
of the band, no averaging of looks makes such a phase; the formula is continued there (it stays a
distribution, and becomes uniform as L → 0). What a processor finds instead is a single look of a
larger cell; the continuation never promises less noise than that.
"""

from .distribution import phase_cdf, phase_exceedance, phase_pdf
from .noise import (
    EfficiencyCurves,
    cramer_rao_std,
    efficiency_curves,
    phase_efficiency,
    phase_std,
    phase_variance,
)
from .quantiles import difference_quantile, phase_quantile

__all__ = [
    "EfficiencyCurves",
    "cramer_rao_std",
    "difference_quantile",
    "efficiency_curves",
    "phase_cdf",
    "phase_efficiency",
    "phase_exceedance",
    "phase_pdf",
    "phase_quantile",
    "phase_std",
    "phase_variance",
]
