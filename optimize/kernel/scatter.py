"""Height error where all images are alike: from the scatter of their phase centers alone.

Without decorrelation every segment sees the same images, and its information depends on the 2 × 2
scatter matrix of the phase centers in the plane (z0, ż0): O(M) for a formation, and a handful of
products for each segment.
"""

from __future__ import annotations

import math

from .lanes import every, jit, lanes, number, where_less

_NOTHING = 1e-60
_NO_WAVENUMBER = 1e-15


@jit
def scatter_error(k, r):
    """Sum over the segments of the mean square errors.

    J = (A β/f² + AD − B²)/(β(β/f² + D)) with A = kᵀMk, B = kᵀMc, D = cᵀMc of the scatter matrix M;
    and AD − B² is det M times the square of k × c, which does not cancel.
    """
    zz, zy, yy, determinant = _scatter(k, r)
    total = every(0.0)
    side, segments = lanes(r.side, 0), k.segments
    for s in range(segments):
        below, above, scale = 2 * s, 2 * (segments + s), number(k.per_height, s)
        k0 = scale * where_less(side, 0.0, number(k.height, below), number(k.height, above))
        k1 = scale * where_less(side, 0.0, number(k.height, below + 1), number(k.height, above + 1))
        own = k0 * k0 * zz + 2.0 * k0 * k1 * zy + k1 * k1 * yy
        beta = number(k.alike, s)
        noise, signal = every(beta), own
        if k.azimuth_factor > 0.0:
            f = k.azimuth_factor
            c0 = f * where_less(side, 0.0, number(k.azimuth, below), number(k.azimuth, above))
            c1 = where_less(side, 0.0, number(k.azimuth, below + 1), number(k.azimuth, above + 1))
            c1 = f * c1
            across = c0 * c0 * zz + 2.0 * c0 * c1 * zy + c1 * c1 * yy
            turn = k0 * c1 - k1 * c0
            signal = own * beta + determinant * turn * turn
            noise = beta * (beta + across)
        total += number(k.shift, s) + where_less(
            signal,
            _NOTHING * noise,
            math.inf,
            where_less(own, _NO_WAVENUMBER**2, math.inf, noise / signal),
        )
    return total


@jit
def _scatter(k, r):
    """Scatter matrix of the phase centers, and its determinant without cancellation."""
    z, y = lanes(r.center_radial, 0), lanes(r.center_rate, 0)
    for i in range(1, k.images):
        z += lanes(r.center_radial, i)
        y += lanes(r.center_rate, i)
    z, y = z / float(k.images), y / float(k.images)
    zz, zy = every(0.0), every(0.0)
    for i in range(k.images):
        radial, rate = lanes(r.center_radial, i) - z, lanes(r.center_rate, i) - y
        zz += radial * radial
        zy += radial * rate
    slope = where_less(0.0, zz, zy / zz, 0.0)
    yy, rest = every(0.0), every(0.0)
    for i in range(k.images):
        radial, rate = lanes(r.center_radial, i) - z, lanes(r.center_rate, i) - y
        left = rate - slope * radial
        yy += rate * rate
        rest += left * left
    return zz, zy, yy, zz * rest
