"""What a simulation says, in words."""

from __future__ import annotations

from insar.simulation import SegmentRefutation, Verdict

from .wording import meters, percent, plain, quantity

VERDICTS = {
    Verdict.AGREES: "agrees",
    Verdict.DISAGREES: "disagrees",
    Verdict.OFTEN_WRONG: "cycles often wrong",
    Verdict.MEASURES_NOTHING: "measures nothing",
}


def bits(value: float) -> str:
    """Information to a tenth of a bit."""
    return f"{value:.1f} bit{'' if f'{value:.1f}' == '1.0' else 's'}"


def worst_of(segments: tuple[SegmentRefutation, ...]) -> SegmentRefutation:
    """The segment that says most against the formation."""
    order = list(Verdict)
    return max(segments, key=lambda segment: (order.index(segment.verdict), segment.wrong.value))


def finding(segment: SegmentRefutation) -> str:
    """What the simulation of a segment found, in a sentence or two."""
    simulated = (
        f"With every cycle right, simulated heights in segment {segment.segment + 1} are wrong by "
        f"{meters(segment.right_cycles.value)} (predicted {meters(segment.predicted_total)}); a "
        f"cycle is wrong in {percent(segment.wrong.value)} of the pixels (predicted "
        f"{percent(segment.predicted_failure)})."
    )
    if segment.verdict is Verdict.MEASURES_NOTHING:
        return (
            f"{simulated} Taken together, no estimate from these phases is better than the height "
            f"known beforehand: its error is {meters(segment.best.value)}, that of the prior "
            f"{_prior(segment)}."
        )
    return (
        f"{simulated} Over the prior height of {_prior(segment)}, "
        f"{bits(segment.bits)} are gained; two thirds of the heights lie within "
        f"{meters(segment.two_thirds)}."
    )


def _prior(segment: SegmentRefutation) -> str:
    return quantity(plain(segment.prior_height_std), "m")
