"""Line of sight, and the directions in which a formation senses height and azimuth.

Vectors are RTN of the formation's reference orbit, last axis (R, T, N).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def line_of_sight(*, look_angle: ArrayLike, azimuth: ArrayLike) -> Array:
    """Unit vector û from the formation to the target.

    Parameters
    ----------
    look_angle : (...) — angle θ from nadir (−R) [rad].
    azimuth : (...) — angle γ about nadir, from T towards N [rad].

    Returns
    -------
    (..., 3) — û = cosγ sinθ T + sinγ sinθ N − cosθ R.

    References
    ----------
    Li 2009 eq. (1), with its axes x = T, y = N, z = R.
    """
    theta, gamma = np.broadcast_arrays(
        np.asarray(look_angle, dtype=np.float64), np.asarray(azimuth, dtype=np.float64)
    )
    return np.stack(
        [-np.cos(theta), np.cos(gamma) * np.sin(theta), np.sin(gamma) * np.sin(theta)], axis=-1
    )


def local_vertical(*, look_angle: ArrayLike, azimuth: ArrayLike, incidence: ArrayLike) -> Array:
    """Unit vector upward at the target.

    Parameters
    ----------
    look_angle, azimuth : (...) — direction of the line of sight, as in `line_of_sight` [rad].
    incidence : (...) — angle between the line of sight and the vertical at the target [rad].

    Returns
    -------
    (..., 3) — the radial direction turned by the central angle θ_inc − θ towards the target;
    exact on a sphere, and R itself on a flat Earth (θ_inc = θ).
    """
    theta, gamma, inc = np.broadcast_arrays(
        *(np.asarray(v, dtype=np.float64) for v in (look_angle, azimuth, incidence))
    )
    central = inc - theta
    return np.stack(
        [
            np.cos(central),
            np.sin(central) * np.cos(gamma),
            np.sin(central) * np.sin(gamma),
        ],
        axis=-1,
    )


class Sensitivity(NamedTuple):
    """How a change of relative position acts on a measured height, per segment.

    Attributes
    ----------
    height_direction : (..., 3) — the perpendicular baseline is the baseline along it.
    azimuth_direction : (..., 3) — an azimuth error of 1 rad lengthens the path of a baseline by
        its component along this.
    height_lever : (...) — dh/dθ along `height_direction` [m/rad]; positive.
    """

    height_direction: Array
    azimuth_direction: Array
    height_lever: Array


def constant_doppler_sensitivity(
    line_of_sight: ArrayLike,
    *,
    velocity_direction: ArrayLike,
    vertical: ArrayLike,
    slant_range: ArrayLike,
) -> Sensitivity:
    """Sensitivity of a target that keeps its range *and Doppler* while its height changes.

    A SAR image fixes range and Doppler, so a change of height turns the line of sight about the
    satellite's Earth-fixed velocity: along e_h = unit(û × v̂), signed upward.

    Parameters
    ----------
    line_of_sight : (..., 3) — unit vectors û.
    velocity_direction : (..., 3) — unit vectors v̂ of the Earth-fixed velocity.
    vertical : (..., 3) — unit vectors upward at the targets.
    slant_range : (...) — distance to the targets [m].

    Returns
    -------
    Sensitivity — with height_lever r (e_h·up); sin of the incidence times r at broadside.

    Notes
    -----
    A line of sight along the velocity has no such direction and gives NaN.
    """
    los = np.asarray(line_of_sight, dtype=np.float64)
    velocity = np.asarray(velocity_direction, dtype=np.float64)
    height = _unit(np.cross(los, velocity))
    rise = np.sum(height * np.asarray(vertical, dtype=np.float64), axis=-1)
    along = np.sum(velocity * los, axis=-1, keepdims=True)
    return Sensitivity(
        height_direction=height * np.where(rise < 0.0, -1.0, 1.0)[..., None],
        azimuth_direction=_unit(velocity - along * los),
        height_lever=np.asarray(slant_range, dtype=np.float64) * np.abs(rise),
    )


def constant_azimuth_sensitivity(
    *, look_angle: ArrayLike, azimuth: ArrayLike, slant_range: ArrayLike
) -> Sensitivity:
    """Sensitivity of a target that keeps its range and *azimuth angle* while its height changes.

    The form of Li 2009, kept to reproduce it: at its azimuth of 82° it is 25 % off the
    measurement that a SAR makes (see `constant_doppler_sensitivity`).

    Parameters
    ----------
    look_angle, azimuth : (...) — direction of the line of sight [rad].
    slant_range : (...) — distance to the targets [m].

    Returns
    -------
    Sensitivity — with ∂û/∂θ, ∂û/∂γ (whose length is sin θ) and r sin θ (a flat Earth).

    References
    ----------
    Li 2009 eqs (1) and (2), differentiated.
    """
    theta, gamma = np.broadcast_arrays(
        np.asarray(look_angle, dtype=np.float64), np.asarray(azimuth, dtype=np.float64)
    )
    zero = np.zeros_like(theta)
    return Sensitivity(
        height_direction=np.stack(
            [np.sin(theta), np.cos(gamma) * np.cos(theta), np.sin(gamma) * np.cos(theta)], axis=-1
        ),
        azimuth_direction=np.stack(
            [zero, -np.sin(gamma) * np.sin(theta), np.cos(gamma) * np.sin(theta)], axis=-1
        ),
        height_lever=np.asarray(slant_range, dtype=np.float64) * np.sin(theta),
    )


def _unit(vector: Array) -> Array:
    norm = np.linalg.norm(vector, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        unit: Array = vector / norm
    return unit
