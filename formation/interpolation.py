"""Polynomials through a few neighboring samples of a table: Lagrange's and Hermite's."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def interpolate(
    times: Array, nodes: Array, values: Array, slopes: Array | None, *, points: int
) -> tuple[Array, Array]:
    """Values and derivatives between the samples of a table.

    Parameters
    ----------
    times : (S,) — where to interpolate, within the nodes [s].
    nodes : (N,) — times of the samples, increasing [s].
    values : (N, 3) — samples.
    slopes : (N, 3) — their derivatives, met as well (Hermite); None to let the values decide
        (Lagrange).
    points : samples to pass through, N at most: a polynomial of degree ``points − 1`` by Lagrange,
        ``2·points − 1`` by Hermite.

    Returns
    -------
    values, derivatives : (S, 3) — of one and the same polynomial.
    """
    before = np.searchsorted(nodes, times, side="right") - 1
    starts = np.clip(before - (points - 1) // 2, 0, len(nodes) - points)
    windows, which = np.unique(starts, return_inverse=True)
    inside = windows[:, None] + np.arange(points)
    center = nodes[inside].mean(axis=-1)
    abscissas = nodes[inside] - center[:, None]
    if slopes is None:
        coefficients = _divided_differences(abscissas, values[inside], None)
    else:
        # A node that counts twice is met in value and slope.
        abscissas = np.repeat(abscissas, 2, axis=-1)
        twice = np.repeat(inside, 2, axis=-1)
        coefficients = _divided_differences(abscissas, values[twice], slopes[twice])
    return _evaluate(times - center[which], abscissas[which], coefficients[which])


def _divided_differences(nodes: Array, values: Array, slopes: Array | None) -> Array:
    """Coefficients (W, K, 3) of Newton's form for K nodes in each of W windows."""
    table = values
    coefficients = [table[:, 0]]
    for order in range(1, nodes.shape[-1]):
        span = (nodes[:, order:] - nodes[:, :-order])[..., None]
        change = table[:, 1:] - table[:, :-1]
        if order == 1 and slopes is not None:
            table = np.where(span > 0.0, change / np.where(span > 0.0, span, 1.0), slopes[:, 1:])
        else:
            table = change / span
        coefficients.append(table[:, 0])
    return np.stack(coefficients, axis=1)


def _evaluate(times: Array, nodes: Array, coefficients: Array) -> tuple[Array, Array]:
    """Newton's form and its derivative by Horner's rule."""
    value = coefficients[:, -1]
    derivative = np.zeros_like(value)
    for k in range(nodes.shape[-1] - 2, -1, -1):
        distance = (times - nodes[:, k])[:, None]
        derivative = derivative * distance + value
        value = value * distance + coefficients[:, k]
    return value, derivative
