"""A simulation beside its predictions, in the machine-readable result."""

from __future__ import annotations

from insar.simulation import Refutation, SegmentRefutation

from .json_comparison import height_comparison, share_comparison
from .json_numbers import Json, finite


def refutation_json(refutation: Refutation | None) -> Json | None:
    """Block of a formation; None where nothing was simulated."""
    if refutation is None:
        return None
    return {
        "verdict": str(refutation.verdict),
        "samples": refutation.samples,
        "draws": refutation.draws,
        "prior_height_std_m": finite(refutation.segments[0].prior_height_std),
        "departures": list(refutation.departures),
        "segments": [_segment(segment) for segment in refutation.segments],
    }


def _segment(segment: SegmentRefutation) -> Json:
    return {
        "segment": segment.segment + 1,
        "verdict": str(segment.verdict),
        "total": height_comparison(segment.total),
        "relative": height_comparison(segment.relative_error),
        "wrong_cycles": share_comparison(segment.wrong_cycles),
        "unwrapped_rms_m": finite(segment.unwrapped.value),
        "most_likely_rms_m": finite(segment.most_likely.value),
        "two_thirds_within_m": finite(segment.two_thirds),
        "posterior_mean_rms_m": finite(segment.best.value),
        "gain_m": finite(segment.gain),
        "gain_bits": finite(segment.bits),
    }
