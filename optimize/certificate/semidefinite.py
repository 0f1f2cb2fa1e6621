"""The 2 × 2 semidefinite program of the convex reduction; the only place that imports cvxpy."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reduction import Reduction

Array = NDArray[np.float64]


class SolverError(Exception):
    """The convex solver is missing, or found no solution; the message says which."""


def best_scatter(problem: Reduction, cuts: tuple[tuple[float, float], ...] = ()) -> Array:
    """Scatter matrix with the smallest error under the limits that are convex.

    Parameters
    ----------
    problem : the reduction.
    cuts : pairs (μ, h) — (1 − μ)·λ_max(M) + μ·tr M ≤ h holds for every attainable M.

    Returns
    -------
    (2, 2) — positive definite; to be used as a point of tangency, not for its last digits.

    Raises
    ------
    SolverError
        If cvxpy is missing or does not solve it.
    """
    try:
        import cvxpy
    except ImportError as error:
        raise SolverError("the convex solver, cvxpy, is not installed") from error
    cp: Any = cvxpy  # its functions are not in its type hints
    scatter = cp.Variable((2, 2), PSD=True)
    # Scaled so that the information of every segment is near 1.
    scale = float(np.mean(problem.strength * np.sum(problem.height**2, axis=-1)))
    terms = []
    for a, c, strength in zip(problem.height, problem.azimuth, problem.strength, strict=True):
        information = cp.trace(np.outer(a, a) @ scatter)
        if problem.ratio > 0.0:
            length = float(np.linalg.norm(c)) or 1.0
            across = c / length
            information -= cp.quad_over_lin(
                a @ scatter @ across,
                1.0 / (problem.ratio * length**2) + cp.trace(np.outer(across, across) @ scatter),
            )
        terms.append(cp.inv_pos(float(strength / scale) * information))
    largest = cp.lambda_max(scatter)
    limits = [largest <= problem.largest_scatter, cp.trace(scatter) <= problem.count]
    limits += [(1.0 - mu) * largest + mu * cp.trace(scatter) <= h for mu, h in cuts]
    program = cp.Problem(cp.Minimize(sum(terms) / len(terms)), limits)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an inaccurate solution serves as well as any
            program.solve()
    except cp.error.SolverError as error:
        raise SolverError(f"the convex solver failed: {error}") from error
    value = scatter.value
    if value is None or not np.all(np.isfinite(value)):
        raise SolverError(f"the convex solver found no solution: {program.status}")
    symmetric = 0.5 * (value + value.T)
    floor = 1e-9 * float(np.trace(symmetric))
    values, vectors = np.linalg.eigh(symmetric)
    return np.asarray((vectors * np.maximum(values, floor)) @ vectors.T)
