"""Products and unit vectors over the last axis, and inverse functions that give NaN in silence."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def dot(one: Array, other: Array) -> Array:
    """Scalar product over the last axis, (..., 3) and (..., 3) to (...)."""
    product: Array = np.vecdot(one, other)
    return product


def unit(vector: Array) -> Array:
    """Vector of length 1 in the same direction, (..., 3); NaN for the zero vector."""
    with np.errstate(invalid="ignore", divide="ignore"):
        scaled: Array = vector / np.sqrt(dot(vector, vector))[..., None]
    return scaled


def rotate(axes: Array, vector: Array) -> Array:
    """Components of a vector along the rows of `axes`, (..., 3, 3) and (..., 3) to (..., 3)."""
    components: Array = np.einsum("...ij,...j->...i", axes, vector)
    return components


def safe_arccos(cosine: Array) -> Array:
    """Angle of a cosine; NaN outside [-1, 1], without a warning."""
    with np.errstate(invalid="ignore"):
        angle: Array = np.arccos(cosine)
    return angle


def safe_arcsin(sine: Array) -> Array:
    """Angle of a sine; NaN outside [-1, 1], without a warning."""
    with np.errstate(invalid="ignore"):
        angle: Array = np.arcsin(sine)
    return angle
