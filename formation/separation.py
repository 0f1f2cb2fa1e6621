"""Closest approach of each pair of satellites over the whole relative orbit, in closed form."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .relative_motion import drift_per_orbit

Array = NDArray[np.float64]

NEGLIGIBLE_DRIFT = 1.0
"""Relative drift that `min_separation` neglects [m per orbit].

Velocities printed with four decimals (0.1 mm/s) already carry 0.85 m per orbit of it.
"""


@lru_cache(maxsize=64)
def satellite_pairs(count: int) -> NDArray[np.intp]:
    """Index pairs (i, j), i < j, in the order used everywhere: (0,1), (0,2), …, (1,2), ….

    Parameters
    ----------
    count : number of satellites.

    Returns
    -------
    (K, 2) — K = count·(count − 1)/2 pairs.
    """
    pairs = np.stack(np.triu_indices(count, k=1), axis=-1)
    pairs.setflags(write=False)  # it is shared
    return pairs


def min_separation(states: ArrayLike, *, mean_motion: float) -> Array:
    """Smallest distance of each pair over one revolution, at any time and not at samples of it.

    The relative motion of a pair is p(τ) = c + u cos τ + w sin τ with τ = nt. When it is centered
    (c = 0, as in both circular families) the smallest squared distance is the smaller eigenvalue
    of the Gram matrix of u and w. With an along-track offset, the stationary points are the roots
    of a quartic in exp(iτ).

    Parameters
    ----------
    states : (..., N, 6) — drift-free RTN states at t = 0 [m, m/s].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].

    Returns
    -------
    (..., K) — smallest separations [m], pairs in the order of `satellite_pairs`.

    Raises
    ------
    ValueError
        If a pair drifts apart by more than `NEGLIGIBLE_DRIFT` per orbit: its separation then has
        no minimum over the orbit.
    """
    state = np.asarray(states, dtype=np.float64)
    first, second = satellite_pairs(state.shape[-2]).T
    relative = state[..., second, :] - state[..., first, :]
    drift = float(np.max(np.abs(drift_per_orbit(relative, mean_motion=mean_motion)), initial=0.0))
    if drift > NEGLIGIBLE_DRIFT:
        raise ValueError(
            f"a pair drifts by {drift:.3g} m per orbit, above {NEGLIGIBLE_DRIFT} m: its separation "
            "has no minimum over the orbit; make the states drift-free (Ṫ = −2nR)"
        )
    center, cosine, sine = _ellipse(relative, mean_motion)
    mean_square = 0.5 * (_dot(cosine, cosine) + _dot(sine, sine))
    second_harmonic = 0.5 * (_dot(cosine, cosine) - _dot(sine, sine)) - 1j * _dot(cosine, sine)
    first_harmonic = 2.0 * _dot(center, cosine) - 2j * _dot(center, sine)
    # Rounding leaves 1e-16 of the satellites' own coordinates as an offset of a centered pair.
    if np.any(np.abs(center) > 1e-12 * np.max(np.abs(state[..., :3]), initial=0.0)):
        squared = _offset_minimum(center, mean_square, first_harmonic, second_harmonic)
    else:
        squared = _dot(center, center) + mean_square - np.abs(second_harmonic)
    return np.sqrt(np.maximum(squared, 0.0))


def _ellipse(relative: Array, n: float) -> tuple[Array, Array, Array]:
    """Center, cosine and sine vectors (..., 3) of drift-free relative states (..., 6)."""
    r, t, cross, rdot, _, cross_rate = np.moveaxis(relative, -1, 0)
    zero = np.zeros_like(r)
    center = np.stack([zero, t - 2.0 * rdot / n, zero], axis=-1)
    cosine = np.stack([r, 2.0 * rdot / n, cross], axis=-1)
    sine = np.stack([rdot / n, -2.0 * r, cross_rate / n], axis=-1)
    return center, cosine, sine


def _dot(a: Array, b: Array) -> Array:
    product: Array = np.einsum("...i,...i->...", a, b)
    return product


def _offset_minimum(
    center: Array,
    mean_square: Array,
    first: NDArray[np.complex128],
    second: NDArray[np.complex128],
) -> Array:
    """Minimum over τ of |c|² + mean + Re(first·z + second·z²), z = exp(iτ)."""
    # Stationary points solve 2b z⁴ + a z³ − ā z − 2b̄ = 0. A vanishing b leaves the first harmonic
    # alone, whose minimum is added as a candidate.
    scale = np.maximum(np.abs(first) + np.abs(second), 1e-200)
    lead = np.where(np.abs(second) > 1e-14 * scale, second, 1e-14 * scale)
    companion = np.zeros((*first.shape, 4, 4), dtype=np.complex128)
    companion[..., 0, 0] = -first / (2.0 * lead)
    companion[..., 0, 2] = np.conj(first) / (2.0 * lead)
    companion[..., 0, 3] = np.conj(lead) / lead
    companion[..., [1, 2, 3], [0, 1, 2]] = 1.0
    angles = np.concatenate(
        [
            np.angle(np.linalg.eigvals(companion)),
            (np.pi - np.angle(first))[..., None],
        ],
        axis=-1,
    )
    z = np.exp(1j * angles)
    wave = np.real(first[..., None] * z + second[..., None] * z**2)
    minimum: Array = _dot(center, center) + mean_square + wave.min(axis=-1)
    return minimum
