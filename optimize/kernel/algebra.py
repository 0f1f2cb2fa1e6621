"""Small symmetric positive-definite systems, one for each of eight formations."""

from __future__ import annotations

from .lanes import jit, keep, lanes, larger

_SMALLEST = 1e-300


@jit
def factorize(matrix, size):
    """L D Lᵀ of the lower triangle, in place: L below the diagonal, 1/D on it."""
    for j in range(size):
        inverse = 1.0 / larger(lanes(matrix, j * size + j), _SMALLEST)
        keep(matrix, j * size + j, inverse)
        for i in range(j + 1, size):
            value = lanes(matrix, i * size + j)
            share = value * inverse
            for m in range(j + 1, i):
                rest = lanes(matrix, i * size + m) - value * lanes(matrix, m * size + j)
                keep(matrix, i * size + m, rest)
            keep(matrix, i * size + i, lanes(matrix, i * size + i) - value * share)
            keep(matrix, i * size + j, share)


@jit
def solve(matrix, size, vector):
    """Solve with a matrix that is factorized, in place."""
    for i in range(size):
        total = lanes(vector, i)
        for m in range(i):
            total -= lanes(matrix, i * size + m) * lanes(vector, m)
        keep(vector, i, total)
    for i in range(size - 1, -1, -1):
        total = lanes(vector, i) * lanes(matrix, i * size + i)
        for m in range(i + 1, size):
            total -= lanes(matrix, m * size + i) * lanes(vector, m)
        keep(vector, i, total)


@jit
def invert(matrix, size, inverse, column):
    """Lower triangle of the inverse of a matrix that is factorized."""
    for c in range(size):
        keep(column, c, 1.0)
        for i in range(c + 1, size):
            total = lanes(matrix, i * size + c)
            for m in range(c + 1, i):
                total += lanes(matrix, i * size + m) * lanes(column, m)
            keep(column, i, total * -1.0)
        for i in range(size - 1, c - 1, -1):
            total = lanes(column, i) * lanes(matrix, i * size + i)
            for m in range(i + 1, size):
                total -= lanes(matrix, m * size + i) * lanes(inverse, m * size + c)
            keep(inverse, i * size + c, total)
