"""Monte-Carlo simulation of what a formation measures: the error model put to the test.

Draws images (speckle, noise, wrapped phases) and errors at their scales, estimates heights from
them, and compares what comes out with what `insar.height_error` and `insar.unwrapping_ladder`
predict.
"""

from .comparison import Comparison, Simulated
from .end_to_end import simulate_terrain
from .nature import Nature, natural_errors
from .refutation import (
    MAX_IMAGES,
    Refutation,
    SegmentRefutation,
    Verdict,
    refute,
)
from .terrain_results import TerrainMaps, TerrainRequest, TerrainSimulation

__all__ = [
    "MAX_IMAGES",
    "Comparison",
    "Nature",
    "Refutation",
    "SegmentRefutation",
    "Simulated",
    "TerrainMaps",
    "TerrainRequest",
    "TerrainSimulation",
    "Verdict",
    "natural_errors",
    "refute",
    "simulate_terrain",
]
