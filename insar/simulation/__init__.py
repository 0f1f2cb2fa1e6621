"""Monte-Carlo simulation of what a formation measures: the error model put to the test.

Draws images (speckle, noise, wrapped phases) and errors at their scales, estimates heights from
them, and compares what comes out with what `insar.height_error` and `insar.unwrapping_ladder`
predict.
"""

from .nature import Nature, natural_errors
from .refutation import (
    MAX_IMAGES,
    Refutation,
    SegmentRefutation,
    Simulated,
    Verdict,
    refute,
)

__all__ = [
    "MAX_IMAGES",
    "Nature",
    "Refutation",
    "SegmentRefutation",
    "Simulated",
    "Verdict",
    "natural_errors",
    "refute",
]
