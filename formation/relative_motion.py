"""Linear relative motion about a circular orbit (Clohessy-Wiltshire), in RTN.

States are ``(..., 6)`` arrays ``[R, T, N, Ṙ, Ṫ, Ṅ]`` [m, m/s] in the rotating frame of the
reference orbit: R radially outward, T along the flight direction, N along the orbit normal.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def transition_matrix(times: ArrayLike, *, mean_motion: float) -> Array:
    """State transition of the Clohessy-Wiltshire equations, drift included.

    Parameters
    ----------
    times : (...) — time since the epoch of the states, any sign [s].
    mean_motion : scalar — angular rate n of the circular reference orbit [rad/s].

    Returns
    -------
    (..., 6, 6) — Φ with ``state(t) = Φ state(0)``.

    Notes
    -----
    Valid while separations are small against the orbit radius: the neglected curvature is about
    d²/2a, 0.07 m at 1 km. Perturbations (J2, drag) are not included.

    References
    ----------
    Clohessy and Wiltshire 1960, doi:10.2514/8.8704. The radial rows of Li 2009
    eqs (11) and (12) carry a stray x0; this is derived from the equations of motion.
    """
    time = np.asarray(times, dtype=np.float64)
    n = float(mean_motion)
    s, c, nt = np.sin(n * time), np.cos(n * time), n * time
    phi = np.zeros((*time.shape, 6, 6))
    phi[..., 0, 0] = 4.0 - 3.0 * c
    phi[..., 0, 3] = s / n
    phi[..., 0, 4] = 2.0 * (1.0 - c) / n
    phi[..., 1, 0] = 6.0 * (s - nt)
    phi[..., 1, 1] = 1.0
    phi[..., 1, 3] = -2.0 * (1.0 - c) / n
    phi[..., 1, 4] = (4.0 * s - 3.0 * nt) / n
    phi[..., 2, 2] = c
    phi[..., 2, 5] = s / n
    phi[..., 3, 0] = 3.0 * n * s
    phi[..., 3, 3] = c
    phi[..., 3, 4] = 2.0 * s
    phi[..., 4, 0] = -6.0 * n * (1.0 - c)
    phi[..., 4, 3] = -2.0 * s
    phi[..., 4, 4] = 4.0 * c - 3.0
    phi[..., 5, 2] = -n * s
    phi[..., 5, 5] = c
    return phi


def propagate(states: ArrayLike, times: ArrayLike, *, mean_motion: float) -> Array:
    """Relative states at given times.

    Parameters
    ----------
    states : (..., N, 6) — RTN states of N satellites at t = 0 [m, m/s].
    times : (S,) — times since the epoch of the states [s].
    mean_motion : scalar — angular rate of the reference orbit [rad/s].

    Returns
    -------
    (..., S, N, 6) — RTN states [m, m/s].
    """
    initial = np.asarray(states, dtype=np.float64)
    phi = transition_matrix(np.atleast_1d(times), mean_motion=mean_motion)
    return _apply(initial, phi)


def relative_positions(states: ArrayLike, times: ArrayLike, *, mean_motion: float) -> Array:
    """Relative positions at given times.

    Parameters
    ----------
    states : (..., N, 6) — RTN states of N satellites at t = 0 [m, m/s].
    times : (S,) — times since the epoch of the states [s].
    mean_motion : scalar — angular rate of the reference orbit [rad/s].

    Returns
    -------
    (..., S, N, 3) — RTN positions [m].
    """
    initial = np.asarray(states, dtype=np.float64)
    phi = transition_matrix(np.atleast_1d(times), mean_motion=mean_motion)
    return _apply(initial, phi[:, :3, :])


def _apply(initial: Array, phi: Array) -> Array:
    """Contract (..., N, 6) states with (S, C, 6) matrices into (..., S, N, C)."""
    samples, components, _ = phi.shape
    # One matrix product for the whole batch: BLAS beats a broadcast einsum tenfold here.
    flat = initial @ phi.reshape(samples * components, 6).T
    split = flat.reshape(*initial.shape[:-1], samples, components)
    return np.ascontiguousarray(np.moveaxis(split, -2, -3))


def drift_per_orbit(states: ArrayLike, *, mean_motion: float) -> Array:
    """Along-track drift in one revolution.

    Parameters
    ----------
    states : (..., 6) — RTN states [m, m/s].
    mean_motion : scalar — angular rate of the reference orbit [rad/s].

    Returns
    -------
    (...) — change of T in one revolution, positive forward [m]; zero when Ṫ = −2nR.
    """
    state = np.asarray(states, dtype=np.float64)
    rate: Array = -3.0 * (2.0 * mean_motion * state[..., 0] + state[..., 4])
    return rate * (2.0 * np.pi / mean_motion)


def centered_state(
    radial: ArrayLike,
    radial_rate: ArrayLike,
    cross_track: ArrayLike,
    cross_track_rate: ArrayLike,
    *,
    mean_motion: float,
) -> Array:
    """Drift-free state whose relative orbit is centered on the reference satellite.

    Parameters
    ----------
    radial, cross_track : (...) — R and N at t = 0 [m].
    radial_rate, cross_track_rate : (...) — Ṙ and Ṅ at t = 0 [m/s].
    mean_motion : scalar — angular rate n of the reference orbit [rad/s].

    Returns
    -------
    (..., 6) — RTN state with T = 2Ṙ/n and Ṫ = −2nR [m, m/s].
    """
    r, rdot, cross, cross_rate = np.broadcast_arrays(
        *(
            np.asarray(v, dtype=np.float64)
            for v in (radial, radial_rate, cross_track, cross_track_rate)
        )
    )
    return np.stack(
        [
            r,
            2.0 * rdot / mean_motion,  # centered: the orbit's mean T is zero
            cross,
            rdot,
            -2.0 * mean_motion * r,  # drift-free: equal energies
            cross_rate,
        ],
        axis=-1,
    )
