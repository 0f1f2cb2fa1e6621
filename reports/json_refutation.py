"""A simulation beside its predictions, in the machine-readable result."""

from __future__ import annotations

from insar.simulation import Refutation, SegmentRefutation, Simulated

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
        "total": _height(segment.predicted_total, segment.right_cycles, segment.deviation),
        "relative": _height(
            segment.predicted_relative, segment.relative, segment.relative_deviation
        ),
        "wrong_cycles": {
            "predicted": finite(segment.predicted_failure),
            "simulated": finite(segment.wrong.value),
            "sampling_error": finite(segment.wrong.sampling_error),
            "deviation": finite(segment.wrong_deviation),
        },
        "unwrapped_rms_m": finite(segment.unwrapped.value),
        "most_likely_rms_m": finite(segment.most_likely.value),
        "two_thirds_within_m": finite(segment.two_thirds),
        "posterior_mean_rms_m": finite(segment.best.value),
        "gain_m": finite(segment.gain),
        "gain_bits": finite(segment.bits),
    }


def _height(predicted: float, simulated: Simulated, deviation: float) -> Json:
    return {
        "predicted_m": finite(predicted),
        "simulated_m": finite(simulated.value),
        "sampling_error_m": finite(simulated.sampling_error),
        "deviation": finite(deviation),
    }
