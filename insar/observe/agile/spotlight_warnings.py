"""What a user of a spotlight result should know, in words."""

from __future__ import annotations

import dataclasses

from .spotlight_results import Pointing, SpotlightResult
from .warning_texts import orbit_warnings, part, steep_warning, turning_warnings


def warnings_of(result: SpotlightResult) -> SpotlightResult:
    """The same result with its warnings.

    Parameters
    ----------
    result : of `spotlight`, complete but for them.
    """
    profile, times, request = result.profile, result.times, result.request
    found = [
        steep_warning(result.plan.incidence),
        part(
            times,
            profile.outcome == Pointing.BELOW_HORIZON,
            "the aim point does not see the satellite above its horizon",
            "a coarser resolution or a shorter duration stays in view",
        ),
        part(
            times,
            profile.outcome == Pointing.OPPOSITE,
            "the beam would have to turn by 180°, and no turn is the shortest",
            "change the off-axis angle",
        ),
        *turning_warnings(
            times,
            profile,
            angles="the roll is ±90°, where yaw and pitch are not told apart",
            easier="take a larger incidence or a coarser resolution",
        ),
        *orbit_warnings(
            request.trajectory,
            result.plan.epoch,
            0.5 * max(result.plan.imaging_time, float(times[-1] - times[0])),
            misfit=result.orbit_misfit,
        ),
    ]
    return dataclasses.replace(result, warnings=tuple(text for text in found if text))
