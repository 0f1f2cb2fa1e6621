"""Failure of the unwrapping in a segment: integer bootstrapping, the surest pair first."""

from __future__ import annotations

import math

from .algebra import factorize, invert
from .functions import complementary_error
from .lanes import every, jit, keep, lanes, larger, number, root, smaller, where_equal, where_less

_TWO_PI = 2.0 * math.pi
_UNMEASURED = 1e-12


@jit
def unwrapping_failure(k, r):
    """Failure of `insar.unwrapping_ladder`, for a prior height."""
    _noise_covariance(k, r)
    largest = _pair_variances(k, r)
    return _climb(k, r, 1e-14 * largest)


@jit
def _noise_covariance(k, r):
    """Covariance of the phases relative to the first, by their noise: M − 1 rows."""
    last = k.images - 1
    for i in range(last):
        keep(r.matrix, i * last + i, lanes(r.edges, i) + _UNMEASURED)
    pair = last
    for i in range(last):
        diagonal = lanes(r.matrix, i * last + i)
        for j in range(i + 1, last):
            edge = lanes(r.edges, pair)
            diagonal += edge
            keep(r.matrix, j * last + j, lanes(r.matrix, j * last + j) + edge)
            keep(r.matrix, j * last + i, edge * -1.0)
            pair += 1
        keep(r.matrix, i * last + i, diagonal)
    factorize(r.matrix, last)
    invert(r.matrix, last, r.inverse, r.column)


@jit
def _pair_variances(k, r):
    """Variances of the differences of two images, all errors counted; the largest of an image."""
    last, count = k.images - 1, k.images
    prior, azimuth = k.prior**2, k.azimuth_factor**2
    largest = every(0.0)
    for i in range(last):
        kz, along = prior * lanes(r.kz, i + 1), azimuth * lanes(r.along, i + 1)
        for j in range(i + 1):
            value = lanes(r.inverse, i * last + j) + number(k.shared, (i + 1) * count + j + 1)
            value += kz * lanes(r.kz, j + 1) + along * lanes(r.along, j + 1)
            keep(r.inverse, i * last + j, value * (1.0 / _TWO_PI**2))
        own = lanes(r.inverse, i * last + i)
        keep(r.variance, i, own)
        largest = larger(largest, own)
    pair = last
    for i in range(last):
        for j in range(i + 1, last):
            both = lanes(r.variance, i) + lanes(r.variance, j)
            keep(r.variance, pair, both - 2.0 * lanes(r.inverse, j * last + i))
            pair += 1
    return largest


@jit
def _climb(k, r, rounding):
    """Join the images, the pair that is known best first, each conditioned on those before."""
    count = k.images
    failure = every(0.0)
    for i in range(count):
        keep(r.joined, i, 0.0)
    for rung in range(count - 1):
        smallest, first, second = every(math.inf), every(0.0), every(0.0)
        pair = 0
        for i in range(count):
            for j in range(i + 1, count):
                value = lanes(r.variance, pair) + (lanes(r.joined, i) + lanes(r.joined, j))
                first = where_less(value, smallest, float(i), first)
                second = where_less(value, smallest, float(j), second)
                smallest = smaller(value, smallest)
                pair += 1
        wrong = complementary_error(root(0.125 / larger(smallest, 1e-300)))
        failure += wrong * (1.0 - failure)
        if rung < count - 2:
            scale = where_less(rounding, smallest, 0.5 / root(larger(smallest, 1e-300)), 0.0)
            _condition(k, r, first, second, scale)
    return failure


@jit
def _condition(k, r, first, second, scale):
    """Condition all pairs on one whose cycle is known; its second image goes with the first."""
    count = k.images
    for i in range(count):
        keep(r.gain, i, 0.0)
    pair = 0
    for i in range(count):
        own, here = lanes(r.gain, i), float(i)
        for j in range(i + 1, count):
            there, value = float(j), lanes(r.variance, pair)
            own += where_equal(first, there, value, 0.0) - where_equal(second, there, value, 0.0)
            other = where_equal(first, here, value, 0.0) - where_equal(second, here, value, 0.0)
            keep(r.gain, j, lanes(r.gain, j) + other)
            pair += 1
        keep(r.gain, i, own)
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            step = scale * (lanes(r.gain, i) - lanes(r.gain, j))
            keep(r.variance, pair, lanes(r.variance, pair) - step * step)
            pair += 1
    for i in range(count):
        keep(r.joined, i, lanes(r.joined, i) + where_equal(second, float(i), math.inf, 0.0))
