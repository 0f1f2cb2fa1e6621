"""Can the phase be unwrapped? Integer bootstrapping, decorrelation, and their check by drawing."""

from .decorrelation import Decorrelation, decorrelate, decorrelated_unwrapping, success_ceiling
from .drawing import UnwrappingTrial, try_unwrapping
from .float_covariance import float_covariance, noise_covariance
from .ladder import (
    UnwrappingLadder,
    bootstrap_failure,
    two_baseline_probability,
    unwrapping_ladder,
    unwrapping_probability,
)

__all__ = [
    "Decorrelation",
    "UnwrappingLadder",
    "UnwrappingTrial",
    "bootstrap_failure",
    "decorrelate",
    "decorrelated_unwrapping",
    "float_covariance",
    "noise_covariance",
    "success_ceiling",
    "try_unwrapping",
    "two_baseline_probability",
    "unwrapping_ladder",
    "unwrapping_probability",
]
