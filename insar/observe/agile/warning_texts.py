"""Warnings that spotlight and video share."""

from __future__ import annotations

import math
from datetime import datetime, timedelta

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory

from ..scenes.cautions import dated_cautions
from .profiles import Profile

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_LARGEST_MISFIT = 1e-3
"""Of the smooth orbit that goes unmentioned: 1e-9 rad of attitude, in low orbit [m]."""

_STEEP = math.radians(10.0)
"""Incidence below which a cell in range is six times longer on the ground [rad]."""

_OVERHEAD = 1e-4
"""Sine of an incidence at which a cell in range has no useful length on the ground."""


def part(times: Array, where: Mask, what: str, remedy: str, unit: str = "samples") -> str:
    """One warning for the samples where something holds; empty if there are none.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    where : (S,).
    what : holds there.
    remedy : against it.
    unit : what is counted.
    """
    if not np.any(where):
        return ""
    there = times[where]
    return (
        f"{what}: {np.count_nonzero(where)} of {len(where)} {unit}, the first {there[0]:.2f} s and "
        f"the last {there[-1]:.2f} s from zero Doppler; {remedy}"
    )


def steep_warning(incidence: float) -> str:
    """Warning of a place near the satellite's nadir at zero Doppler; empty if it is not.

    Parameters
    ----------
    incidence : scalar — at zero Doppler [rad].
    """
    if incidence >= _STEEP:
        return ""
    sine = math.sin(incidence)
    coarser = f"{1.0 / sine:.3g} times" if sine > _OVERHEAD else "without limit"
    return (
        f"the aim point is {math.degrees(incidence):.2f}° from the satellite's nadir at zero "
        f"Doppler: on the ground range resolves {coarser} more coarsely than along the line of "
        "sight, and places left and right of the track share a range; take another pass"
    )


def turning_warnings(times: Array, profile: Profile, *, angles: str, easier: str) -> list[str]:
    """Warnings of angles that are singular or upside down, and of what is not agile enough.

    Parameters
    ----------
    times : (S,) — since zero Doppler [s].
    profile : over these times.
    angles : what is not told apart where the middle angle is ±90°, and which that is.
    easier : what asks less of the satellite.
    """
    return [
        part(times, profile.singular, angles, "use the quaternions there"),
        part(
            times,
            profile.upside_down,
            "the body is upside down, its Z axis above the horizontal",
            "look to the side on which the beam leaves the body, or change the off-axis angle",
        ),
        part(
            times,
            profile.rate_exceeded,
            f"the body would have to turn faster (up to {_peak(profile.rate_inertial)}°/s) than "
            "its agility allows",
            easier,
        ),
        part(
            times,
            profile.acceleration_exceeded,
            "the body would have to accelerate more (up to "
            f"{_peak(profile.acceleration_inertial)}°/s²) than its agility allows",
            easier,
        ),
    ]


def orbit_warnings(
    trajectory: Trajectory, epoch: datetime, half: float, *, misfit: float
) -> list[str]:
    """Warnings of an orbit that is old, beyond the table of the Earth's rotation, or not smooth.

    Parameters
    ----------
    trajectory : of the satellite.
    epoch : UTC of zero Doppler.
    half : scalar — imaged before and after [s].
    misfit : scalar — of the smooth orbit [m].
    """
    reach = timedelta(seconds=half)
    found = list(
        dated_cautions(trajectory.source, trajectory.epoch, first=epoch - reach, last=epoch + reach)
    )
    if misfit > _LARGEST_MISFIT:
        found.append(
            f"the orbit is smooth to {misfit:.1e} m only over the imaging: attitude and rates are "
            "those of a smooth curve through it"
        )
    return found


def _peak(vector: Array) -> str:
    """Largest magnitude, in degrees."""
    magnitudes = np.linalg.norm(vector, axis=-1)
    if not np.any(np.isfinite(magnitudes)):
        return "?"
    return f"{math.degrees(float(np.nanmax(magnitudes))):.4g}"
