"""What a user of a spotlight result should know, in words."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from .spotlight_results import Pointing, SpotlightResult

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

LARGEST_MISFIT = 1e-3
"""Of the smooth orbit that goes unmentioned: 1e-9 rad of attitude, in low orbit [m]."""


COARSER = 1.02
"""Ratio of the resolution that is reached to the one asked for that goes unmentioned."""


def warnings_of(result: SpotlightResult) -> SpotlightResult:
    """The same result with its warnings.

    Parameters
    ----------
    result : of `spotlight`, complete but for them.
    """
    profile = result.profile
    found = [
        _part(
            result,
            profile.pointing == Pointing.BELOW_HORIZON,
            "the aim point does not see the satellite above its horizon",
            "a coarser resolution or a shorter duration stays in view",
        ),
        _part(
            result,
            profile.pointing == Pointing.OPPOSITE,
            "the beam would have to turn by 180°, and no turn is the shortest",
            "change the off-axis angle",
        ),
        _part(
            result,
            profile.singular,
            "the roll is ±90°, where yaw and pitch are not told apart",
            "use the quaternions there",
        ),
        _part(
            result,
            profile.rate_exceeded,
            f"the body would have to turn faster (up to {_peak(profile.rate_inertial)}°/s) than "
            "its agility allows",
            "take a larger incidence or a coarser resolution",
        ),
        _part(
            result,
            profile.acceleration_exceeded,
            "the body would have to accelerate more (up to "
            f"{_peak(profile.acceleration_inertial)}°/s²) than its agility allows",
            "take a larger incidence or a coarser resolution",
        ),
    ]
    asked, reached = result.request.resolution, result.history.resolution
    if reached > COARSER * asked:
        found.append(
            f"the imaging resolves {reached:.4g} m and not the {asked:.4g} m asked for: its time "
            "is that of a straight Doppler history, and this one bends; ask for a finer "
            "resolution, or give a longer duration"
        )
    if result.orbit_misfit > LARGEST_MISFIT:
        found.append(
            f"the orbit is smooth to {result.orbit_misfit:.1e} m only over the imaging: attitude "
            "and rates are those of a smooth curve through it"
        )
    return dataclasses.replace(result, warnings=tuple(text for text in found if text))


def _part(result: SpotlightResult, where: Mask, what: str, remedy: str) -> str:
    """One warning for the samples where something holds; empty if there are none."""
    if not np.any(where):
        return ""
    times = result.times[where]
    return (
        f"{what}: {np.count_nonzero(where)} of {len(where)} samples, between {times[0]:.2f} s "
        f"and {times[-1]:.2f} s after zero Doppler; {remedy}"
    )


def _peak(vector: Array) -> str:
    """Largest magnitude, in degrees."""
    magnitudes = np.linalg.norm(vector, axis=-1)
    if not np.any(np.isfinite(magnitudes)):
        return "?"
    return f"{math.degrees(float(np.nanmax(magnitudes))):.4g}"
