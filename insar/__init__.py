"""The radar side: line of sight, baselines, coherence, unwrapping and the height error.

Stands alone: it takes arrays of satellite positions and knows no orbit, study or optimizer.
Vectors are RTN (R radial outward, T along-track, N along the orbit normal); SI and radians.
"""

from .accuracy import Cell, HeightAccuracy, height_accuracy
from .acquisitions import combine_acquisitions
from .atmosphere import Ionosphere
from .bands import BandCell, band_cells
from .baselines import (
    PairGeometry,
    critical_baseline,
    height_of_ambiguity,
    pair_critical_baseline,
    pair_geometry,
    scene_critical_baseline,
)
from .calibration import Calibration
from .claims import Claim, PrintedFigure, Relation, Verdict, judged, judged_range
from .coherence import CoherenceBudget, common_band, image_amplitude, snr_coherence
from .dataset import to_xarray
from .errors import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Scale,
    SharedBy,
    Weighting,
)
from .geometry import line_of_sight
from .height import HeightError, HeightStatus, height_error, height_error_of
from .image_model import ImageModel, PairNoise, image_model, pair_coherence
from .pair_budget import PairBudget, pair_budget
from .phase_information import filtered_information, fisher_information, pair_phase_variance
from .phase_model import PhaseModel, phase_model
from .phase_noise import lessen_information, pair_efficiency
from .point_to_point import point_to_point_error, point_to_point_factor
from .radar import Radar, monostatic, one_transmitter, ping_pong
from .scene import LookSide, Scene
from .unwrapping import (
    Decorrelation,
    UnwrappingLadder,
    UnwrappingTrial,
    decorrelated_unwrapping,
    try_unwrapping,
    two_baseline_probability,
    unwrapping_ladder,
    unwrapping_probability,
)

__all__ = [
    "BandCell",
    "BaselineDecorrelation",
    "Calibration",
    "Cell",
    "Claim",
    "CoherenceBudget",
    "Decorrelation",
    "ErrorBudget",
    "ErrorSource",
    "HeightAccuracy",
    "HeightError",
    "HeightStatus",
    "HeldConstant",
    "ImageModel",
    "Ionosphere",
    "LookSide",
    "PairBudget",
    "PairGeometry",
    "PairNoise",
    "PhaseModel",
    "PhaseStatistics",
    "PrintedFigure",
    "Radar",
    "Relation",
    "Scale",
    "Scene",
    "SharedBy",
    "UnwrappingLadder",
    "UnwrappingTrial",
    "Verdict",
    "Weighting",
    "band_cells",
    "combine_acquisitions",
    "common_band",
    "critical_baseline",
    "decorrelated_unwrapping",
    "filtered_information",
    "fisher_information",
    "height_accuracy",
    "height_error",
    "height_error_of",
    "height_of_ambiguity",
    "image_amplitude",
    "image_model",
    "judged",
    "judged_range",
    "lessen_information",
    "line_of_sight",
    "monostatic",
    "one_transmitter",
    "pair_budget",
    "pair_coherence",
    "pair_critical_baseline",
    "pair_efficiency",
    "pair_geometry",
    "pair_phase_variance",
    "phase_model",
    "ping_pong",
    "point_to_point_error",
    "point_to_point_factor",
    "scene_critical_baseline",
    "snr_coherence",
    "to_xarray",
    "try_unwrapping",
    "two_baseline_probability",
    "unwrapping_ladder",
    "unwrapping_probability",
]
