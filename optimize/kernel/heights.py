"""Height information J of a segment, and the same from the scatter of the fleet alone.

The azimuth error, one angle for all images, is taken out last: with A = (X⁺ + FFᵀ)⁺ of noise and
all other shared errors, kz and the azimuth projections c, t = cᵀA kz/(1/f² + cᵀAc),

    J = (kz − tc)ᵀA(kz − tc) + t²/f²:

sums of squares, without cancellation. A itself is never formed: of each vector v only what the
shared errors leave of it, r = v − Fa, is needed, and vᵀAw = rᵥᵀXr_w + aᵥᵀa_w.
"""

from __future__ import annotations

import math

from .algebra import factorize, solve
from .lanes import every, jit, keep, lanes, larger, magnitude, number, where_less

_NOTHING = 1e-60
_NO_WAVENUMBER = 1e-15


@jit
def mean_square(k, r, s):
    """Mean square height error of a segment; `inf` where no height is measured."""
    largest = magnitude(lanes(r.kz, 0))
    for i in range(1, k.images):
        largest = larger(largest, magnitude(lanes(r.kz, i)))
    information = _alike_errors(k, r) if k.own_variance >= 0.0 else _any_errors(k, r)
    measured = where_less(largest, _NO_WAVENUMBER, 0.0, information)
    return where_less(measured, _NOTHING, math.inf, 1.0 / measured + number(k.shift, s))


@jit
def _center(source, target, count):
    """A vector less its mean: no information is in what all images have in common."""
    mean = lanes(source, 0)
    for i in range(1, count):
        mean += lanes(source, i)
    mean = mean / float(count)
    for i in range(count):
        keep(target, i, lanes(source, i) - mean)


@jit
def _laplacian(k, r, v, out):
    """X v of the Laplacian, without cancellation: Σ_j x_ij (v_i − v_j)."""
    for i in range(k.images):
        keep(out, i, 0.0)
    pair = 0
    for i in range(k.images):
        own, total = lanes(v, i), lanes(out, i)
        for j in range(i + 1, k.images):
            flow = lanes(r.edges, pair) * (own - lanes(v, j))
            total += flow
            keep(out, j, lanes(out, j) - flow)
            pair += 1
        keep(out, i, total)


@jit
def _alike_errors(k, r):
    """J where the shared errors act on all images alike, FFᵀ = p²I: r = (I + p²X)⁻¹v, a = pXr."""
    count, own = k.images, k.own_variance
    _center(r.kz, r.height, count)
    if own > 0.0:
        _alike_normal(k, r)
        solve(r.matrix, count, r.height)
    _laplacian(k, r, r.height, r.product)
    if k.azimuth_factor > 0.0:
        _center(r.along, r.azimuth, count)
        if own > 0.0:
            solve(r.matrix, count, r.azimuth)
        mixed = lanes(r.along, 0) * lanes(r.product, 0)
        for i in range(1, count):
            mixed += lanes(r.along, i) * lanes(r.product, i)
        _laplacian(k, r, r.azimuth, r.column)
        across = lanes(r.along, 0) * lanes(r.column, 0)
        for i in range(1, count):
            across += lanes(r.along, i) * lanes(r.column, i)
        t = mixed / (1.0 / k.azimuth_factor**2 + across)
        for i in range(count):
            keep(r.height, i, lanes(r.height, i) - t * lanes(r.azimuth, i))
            keep(r.product, i, lanes(r.product, i) - t * lanes(r.column, i))
        rest = t / k.azimuth_factor
        information = rest * rest
    else:
        information = every(0.0)
    for i in range(count):
        product = lanes(r.product, i)
        information += product * (lanes(r.height, i) + own * product)
    return information


@jit
def _alike_normal(k, r):
    """I + p²X, factorized."""
    count, own = k.images, k.own_variance
    for i in range(count):
        keep(r.matrix, i * count + i, 1.0)
    pair = 0
    for i in range(count):
        diagonal = lanes(r.matrix, i * count + i)
        for j in range(i + 1, count):
            edge = own * lanes(r.edges, pair)
            diagonal += edge
            keep(r.matrix, j * count + j, lanes(r.matrix, j * count + j) + edge)
            keep(r.matrix, j * count + i, edge * -1.0)
            pair += 1
        keep(r.matrix, i * count + i, diagonal)
    factorize(r.matrix, count)


@jit
def _any_errors(k, r):
    """J with any factor F of the shared errors: a = (I + FᵀXF)⁻¹FᵀXv, r = v − Fa."""
    count, sources = k.images, k.sources
    if sources > 0:
        _any_normal(k, r)
    _residual(k, r, r.kz, r.height, r.gain)
    if k.azimuth_factor > 0.0:
        _residual(k, r, r.along, r.azimuth, r.joined)
        _laplacian(k, r, r.azimuth, r.product)
        mixed, across = every(0.0), every(0.0)
        for i in range(count):
            mixed += lanes(r.height, i) * lanes(r.product, i)
            across += lanes(r.azimuth, i) * lanes(r.product, i)
        for q in range(sources):
            mixed += lanes(r.gain, q) * lanes(r.joined, q)
            across += lanes(r.joined, q) * lanes(r.joined, q)
        t = mixed / (1.0 / k.azimuth_factor**2 + across)
        for i in range(count):
            keep(r.height, i, lanes(r.height, i) - t * lanes(r.azimuth, i))
        for q in range(sources):
            keep(r.gain, q, lanes(r.gain, q) - t * lanes(r.joined, q))
        rest = t / k.azimuth_factor
        information = rest * rest
    else:
        information = every(0.0)
    _laplacian(k, r, r.height, r.product)
    for i in range(count):
        information += lanes(r.height, i) * lanes(r.product, i)
    for q in range(sources):
        information += lanes(r.gain, q) * lanes(r.gain, q)
    return information


@jit
def _any_normal(k, r):
    """I + FᵀXF, factorized."""
    count, sources = k.images, k.sources
    for element in range(count * sources):
        keep(r.inverse, element, 0.0)
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            edge = lanes(r.edges, pair)
            for q in range(sources):
                step = number(k.factor, i * sources + q) - number(k.factor, j * sources + q)
                flow = edge * step
                keep(r.inverse, i * sources + q, lanes(r.inverse, i * sources + q) + flow)
                keep(r.inverse, j * sources + q, lanes(r.inverse, j * sources + q) - flow)
            pair += 1
    for q in range(sources):
        for p in range(q + 1):
            total = every(1.0 if p == q else 0.0)
            for i in range(count):
                total += number(k.factor, i * sources + q) * lanes(r.inverse, i * sources + p)
            keep(r.matrix, q * sources + p, total)
    factorize(r.matrix, sources)


@jit
def _residual(k, r, v, left, amplitude):
    """What the shared errors leave of a vector, and how large each of them is."""
    count, sources = k.images, k.sources
    _laplacian(k, r, v, r.product)
    for q in range(sources):
        total = number(k.factor, q) * lanes(r.product, 0)
        for i in range(1, count):
            total += number(k.factor, i * sources + q) * lanes(r.product, i)
        keep(amplitude, q, total)
    solve(r.matrix, sources, amplitude)
    for i in range(count):
        rest = lanes(v, i)
        for q in range(sources):
            rest -= number(k.factor, i * sources + q) * lanes(amplitude, q)
        keep(left, i, rest)
