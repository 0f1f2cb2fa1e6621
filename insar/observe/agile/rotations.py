"""Attitude toolbox of agile satellites: quaternions, Euler sequences, axis and angle.

An attitude is a matrix (..., 3, 3) from the orbit frame, or from any other frame of reference, to
the body: its rows are the body axes, as in `attitude`. Conversions are those of scipy's `Rotation`,
under these conventions. A matrix that is no rotation, NaN above all, becomes NaN. `turning` has the
turns that point a beam, and their rates.
"""

from __future__ import annotations

import warnings
from enum import StrEnum
from typing import Any, Final, NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from ..vectors import dot, unit

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SINGULAR: Final = 1e-6
"""Of the middle angle from ±90°, below which the two others are no longer told apart [rad]."""
_NAMES: Final = {"X": "roll", "Y": "pitch", "Z": "yaw"}
"""Of the turns about the body's axes."""
_NO_ROTATION: Final = 1e-6
"""Largest entry of C Cᵀ − 1 that is taken for rounding."""
_ROUNDING: Final = 1e-13
"""The same, below which nothing is gained by making the matrix orthogonal."""
_TRUSTS: Final = tuple(int(part) for part in scipy.__version__.split(".")[:2]) >= (1, 17)
"""Whether scipy can be told that a matrix is a rotation; else it always decomposes it."""


class EulerSequence(StrEnum):
    """Axes about which the body turns, one after the other; the turned ones after the first.

    THREE_ONE_TWO is yaw, roll, pitch (spotlight), singular at a roll of ±90°; ONE_TWO_THREE is
    roll, pitch, yaw (video), singular at a pitch of ±90°.
    """

    THREE_ONE_TWO = "3-1-2"
    ONE_TWO_THREE = "1-2-3"

    @property
    def axes(self) -> str:
        """Name of the sequence to scipy; capitals are turns about the body's axes."""
        return "ZXY" if self is EulerSequence.THREE_ONE_TWO else "XYZ"


class SequenceAngles(NamedTuple):
    """Euler angles of a sequence.

    Attributes
    ----------
    yaw, pitch, roll : (...) — about Z, Y and X [rad].
    singular : (...) of bool — the middle angle is ±90°: the outer two turn about one axis, of
        which only their sum or difference has a meaning; the last is set to 0.
    """

    yaw: Array
    pitch: Array
    roll: Array
    singular: Mask


def euler_sequence(attitude: ArrayLike, sequence: EulerSequence) -> SequenceAngles:
    """Euler angles of attitudes, the inverse of `attitude_of_sequence`.

    Parameters
    ----------
    attitude : (..., 3, 3).
    sequence : which.

    Returns
    -------
    SequenceAngles — the middle one within ±π/2; NaN for no rotation.

    References
    ----------
    Han 2016 eq. (2) for 3-1-2.
    """
    turns, valid = _checked(attitude)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of the singularity: the mask tells
        angles = turns.as_euler(sequence.axes).reshape(*valid.shape, 3)
    angles = np.where(valid[..., None], angles, np.nan)
    named = dict(zip(sequence.axes, np.moveaxis(angles, -1, 0), strict=True))
    singular = np.abs(np.abs(angles[..., 1]) - np.pi / 2) < SINGULAR
    return SequenceAngles(named["Z"], named["Y"], named["X"], singular)


def upright(angles: SequenceAngles, sequence: EulerSequence) -> SequenceAngles:
    """The same attitudes by the Euler angles that a person would give.

    Two triples give the same attitude: (α, β, γ) and (α ± π, π − β, γ ± π). A body that rolls by
    115° is (0°, 115°, 0°) to whoever steers it, and not (180°, 65°, 180°).

    Parameters
    ----------
    angles : of `euler_sequence`.
    sequence : theirs.

    Returns
    -------
    SequenceAngles — of the two triples, the one whose outer angles are nearer to zero, by the sum
    of their cosines; the middle one within ±π. Angles whose outer ones sum up to less than π in
    magnitude stay as they are.
    """
    first, middle, last = (getattr(angles, _NAMES[axis]) for axis in sequence.axes)
    turned = np.cos(first) + np.cos(last) < 0.0  # False for NaN
    found = {
        sequence.axes[0]: np.where(turned, _opposite(first), first),
        sequence.axes[1]: np.where(turned, np.copysign(np.pi, middle) - middle, middle),
        sequence.axes[2]: np.where(turned, _opposite(last), last),
    }
    return SequenceAngles(found["Z"], found["Y"], found["X"], angles.singular)


def _opposite(angle: Array) -> Array:
    """Angle half a turn on, within ±π."""
    return angle - np.copysign(np.pi, angle)


def attitude_of_sequence(
    *, yaw: ArrayLike, pitch: ArrayLike, roll: ArrayLike, sequence: EulerSequence
) -> Array:
    """Attitudes from Euler angles.

    Parameters
    ----------
    yaw, pitch, roll : (...) — about Z, Y and X [rad].
    sequence : which comes first.

    Returns
    -------
    (..., 3, 3).

    References
    ----------
    Han 2016 eq. (3) for 3-1-2: C = R_y(θ) R_x(φ) R_z(ψ); Liang 2018 eq. (13) for 1-2-3.
    """
    values = {"Z": yaw, "Y": pitch, "X": roll}
    ordered = (np.asarray(values[axis], dtype=np.float64) for axis in sequence.axes)
    angles = np.stack(np.broadcast_arrays(*ordered), axis=-1)
    return _from_scipy(Rotation.from_euler(sequence.axes, _rows(angles, (3,))), angles.shape[:-1])


def quaternion(attitude: ArrayLike) -> Array:
    """Quaternions of attitudes.

    Parameters
    ----------
    attitude : (..., 3, 3).

    Returns
    -------
    (..., 4) — of the turn that takes the frame's axes to the body's; scalar last and not negative.
    NaN for no rotation.
    """
    turns, valid = _checked(attitude)
    found = turns.as_quat(canonical=True).reshape(*valid.shape, 4)
    return np.where(valid[..., None], found, np.nan)


def attitude_of_quaternion(quaternions: ArrayLike) -> Array:
    """Attitudes of quaternions, the inverse of `quaternion`.

    Parameters
    ----------
    quaternions : (..., 4) — scalar last; either sign, any length but zero.

    Returns
    -------
    (..., 3, 3) — NaN for the zero quaternion.
    """
    values = np.asarray(quaternions, dtype=np.float64)
    valid = dot(values, values) > 0.0  # False for NaN
    usable = np.where(valid[..., None], values, [0.0, 0.0, 0.0, 1.0])
    found = _from_scipy(Rotation.from_quat(_rows(usable, (4,))), valid.shape)
    return np.where(valid[..., None, None], found, np.nan)


def continuous(quaternions: ArrayLike) -> Array:
    """Quaternions of a series with the signs that let each follow from the one before.

    Parameters
    ----------
    quaternions : (S, 4); rows of NaN are passed over.

    Returns
    -------
    (S, 4) — the first keeps its sign.
    """
    values = np.array(quaternions, dtype=np.float64)
    known = np.flatnonzero(np.isfinite(values[:, 0]))
    steps = dot(values[known[1:]], values[known[:-1]])
    values[known[1:]] *= np.cumprod(np.where(steps < 0.0, -1.0, 1.0))[:, None]
    return values


class AxisAngle(NamedTuple):
    """The one turn that leads to an attitude.

    Attributes
    ----------
    axis : (..., 3) — unit vector, the same in the frame and in the body; NaN for no turn.
    angle : (...) — 0 to π [rad].
    """

    axis: Array
    angle: Array


def axis_angle(attitude: ArrayLike) -> AxisAngle:
    """Euler axis and angle of attitudes.

    Parameters
    ----------
    attitude : (..., 3, 3).

    Returns
    -------
    AxisAngle — NaN for no rotation.

    References
    ----------
    Han 2016 eq. (1).
    """
    turns, valid = _checked(attitude)
    turn = turns.as_rotvec().reshape(*valid.shape, 3)
    turn = np.where(valid[..., None], turn, np.nan)
    return AxisAngle(unit(turn), np.sqrt(dot(turn, turn)))


def attitude_of_axis_angle(axis: ArrayLike, angle: ArrayLike) -> Array:
    """Attitudes that a turn about an axis leads to.

    Parameters
    ----------
    axis : (..., 3) — need not be normalized.
    angle : (...) [rad].

    Returns
    -------
    (..., 3, 3) — NaN for an axis of length zero.
    """
    turn = unit(np.asarray(axis, dtype=np.float64)) * np.asarray(angle, np.float64)[..., None]
    valid = np.isfinite(np.sum(turn, axis=-1))
    usable = np.where(valid[..., None], turn, 0.0)
    found = _from_scipy(Rotation.from_rotvec(_rows(usable, (3,))), valid.shape)
    return np.where(valid[..., None, None], found, np.nan)


def _checked(attitude: ArrayLike) -> tuple[Any, Mask]:
    """Turns of the frame's axes to the body's, none for what is no rotation, and where it is one.

    scipy's matrices act on vectors, ours on axes.
    """
    matrix = np.asarray(attitude, dtype=np.float64)
    products = np.einsum("...ij,...kj->...ik", matrix, matrix)
    excess = np.abs(products - np.eye(3)).max(axis=(-1, -2))
    proper = dot(np.cross(matrix[..., 0, :], matrix[..., 1, :]), matrix[..., 2, :]) > 0.0
    valid: Mask = proper & (excess < _NO_ROTATION)
    usable = np.where(valid[..., None, None], matrix, np.eye(3))
    turns = _rows(np.swapaxes(usable, -1, -2), (3, 3))
    if _TRUSTS and np.all(excess[valid] < _ROUNDING):
        return Rotation.from_matrix(turns, assume_valid=True), valid
    return Rotation.from_matrix(turns), valid


def _rows(values: Array, shape: tuple[int, ...]) -> Array:
    """The same values with one leading axis: scipy before 1.17 knows no more."""
    return values.reshape(-1, *shape)


def _from_scipy(rotation: Any, shape: tuple[int, ...]) -> Array:
    matrix: Array = rotation.as_matrix().reshape(*shape, 3, 3)
    return np.swapaxes(matrix, -1, -2)
