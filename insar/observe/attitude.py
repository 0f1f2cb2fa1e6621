"""Attitude of a body against the orbit frame: Euler angles and angular rates.

Matrices take components in the orbit frame (X forward, Y = −N, Z nadir) to the body's: their rows
are the body axes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .frames import EARTH_ROTATION
from .vectors import rotate, safe_arcsin

Array = NDArray[np.float64]

_STENCIL = 5
"""Samples of a numerical derivative: fourth order."""


def attitude_matrix(*, yaw: ArrayLike, pitch: ArrayLike, roll: ArrayLike) -> Array:
    """Attitude from Euler angles: yaw about Z first, then pitch about Y, then roll about X.

    Parameters
    ----------
    yaw : (...) — ψ about nadir, turns the nose right [rad].
    pitch : (...) — θ about the yawed Y, lifts the nose [rad].
    roll : (...) — φ about the pitched X, lowers the right side [rad].

    Returns
    -------
    (..., 3, 3) — C = R_x(φ) R_y(θ) R_z(ψ), orbit frame to body. With no roll it is the sequence of
    yaw-pitch steering, with no yaw that of pitch-roll steering.
    """
    angles = np.broadcast_arrays(*(np.asarray(a, np.float64) for a in (yaw, pitch, roll)))
    (cy, cp, cr), (sy, sp, sr) = np.cos(angles), np.sin(angles)
    rows = (
        (cp * cy, cp * sy, -sp),
        (sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, sr * cp),
        (cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


class EulerAngles(NamedTuple):
    """Yaw, pitch and roll in the order of `attitude_matrix`, (...) each [rad]."""

    yaw: Array
    pitch: Array
    roll: Array


def euler_angles(attitude: ArrayLike) -> EulerAngles:
    """Euler angles of an attitude, the inverse of `attitude_matrix`.

    Parameters
    ----------
    attitude : (..., 3, 3) — orbit frame to body.

    Returns
    -------
    EulerAngles — pitch within ±π/2, where yaw and roll become one; NaN for a matrix with an
    entry above 1.
    """
    c = np.asarray(attitude, dtype=np.float64)
    return EulerAngles(
        yaw=np.arctan2(c[..., 0, 1], c[..., 0, 0]),
        pitch=-safe_arcsin(c[..., 0, 2]),
        roll=np.arctan2(c[..., 1, 2], c[..., 2, 2]),
    )


class AngularRates(NamedTuple):
    """Angular velocity of a body.

    Attributes
    ----------
    orbit : (S, 3) — against the orbit frame, in body axes [rad/s].
    inertial : (S, 3) — against inertial space, in body axes [rad/s].
    """

    orbit: Array
    inertial: Array


def angular_rates(times: ArrayLike, attitude: Array, *, orbit_axes: Array) -> AngularRates:
    """Angular velocity of a body from samples of its attitude.

    Parameters
    ----------
    times : (S,) — at least three, increasing; any spacing [s].
    attitude : (S, 3, 3) — orbit frame to body.
    orbit_axes : (S, 3, 3) — Earth-fixed axes to orbit frame; `frames.orbit_axes`.

    Returns
    -------
    AngularRates — NaN within two samples of a missing attitude.

    Raises
    ------
    ValueError
        If there are fewer than three times, or they do not increase.

    Notes
    -----
    Derivatives of the matrices by polynomials through five neighboring samples (three or four if
    there are no more): an error of (Δu)⁴/30 of the rate's own fifth harmonic, 3e-9 at 360 samples
    a revolution; at the ends six times that.
    """
    index, weights = _stencil(times)
    body = attitude @ orbit_axes
    against_earth = _angular_velocity(body, index, weights)
    return AngularRates(
        orbit=_angular_velocity(attitude, index, weights),
        inertial=against_earth + rotate(body, EARTH_ROTATION),
    )


def _angular_velocity(axes: Array, index: NDArray[np.int_], weights: Array) -> Array:
    """Rate of the rows of `axes` against its columns' frame, in the axes of the rows, (S, 3)."""
    derivative = np.einsum("sk,skij->sij", weights, axes[index])
    # The rows turn with the body: dA/dt = −[ω]× A.
    cross = -derivative @ np.swapaxes(axes, -1, -2)
    skew = 0.5 * (cross - np.swapaxes(cross, -1, -2))
    return np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)


def _stencil(times: ArrayLike) -> tuple[NDArray[np.int_], Array]:
    """Neighbors of each sample and their weights in its derivative, (S, K) each.

    The derivative at t_i of the polynomial through K samples has the weights
    (λ_j/λ_i)/(t_i − t_j) with λ_j = 1/Π(t_j − t_l), and minus their sum at i itself.
    """
    t = np.asarray(times, dtype=np.float64)
    if t.ndim != 1 or t.size < 3:
        raise ValueError(f"times has shape {t.shape}; angular rates need three or more samples")
    if not np.all(np.diff(t) > 0.0):
        first = int(np.argmin(np.diff(t))) + 1
        raise ValueError(f"times[{first}] = {t[first]} s must come after the one before it")
    count = min(_STENCIL, t.size)
    sample = np.arange(t.size)
    start = np.clip(sample - count // 2, 0, t.size - count)
    index = start[:, None] + np.arange(count)
    own = index == sample[:, None]
    spacing = t[index][:, :, None] - t[index][:, None, :] + np.eye(count)
    inverse = np.prod(spacing, axis=-1)  # 1/λ
    gap = np.where(own, 1.0, t[:, None] - t[index])
    weights = np.where(own, 0.0, inverse[own][:, None] / (inverse * gap))
    return index, np.where(own, -weights.sum(axis=-1, keepdims=True), weights)
