"""Upper bounds of what the machine can do: scores of three satellites, written out by hand.

No loop but those over formations and segments, no array but the constants, no satellite that could
be a fourth: what the compiled evaluator would be if it knew but one problem. Both models are those
of `benchmarks/evaluate.py`, one transmitter, and give the same numbers to 1e-9, which is checked.

plain: pairs measured apart with one given deviation, shared position and azimuth errors, no
decorrelation, no limits. default: joint information after filtering to the common bands in range
and azimuth, exact phase statistics, the same shared errors, unwrapping, radius and separation: the
model of `three_sat` as shipped.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from optimize import DesignSpace, Problem
from optimize.kernel.constants import constants

Array = NDArray[np.float64]

_jit = numba.njit(error_model="numpy", nogil=True)


@_jit
def plain(designs, side, height, azimuth, beta, factor, shift, out):  # type: ignore[no-untyped-def]
    for p in range(designs.shape[0]):
        z1, z2 = designs[p, 2] - designs[p, 0], designs[p, 4] - designs[p, 0]
        y1, y2 = designs[p, 3] - designs[p, 1], designs[p, 5] - designs[p, 1]
        total = 0.0
        for s in range(shift.size):
            h0, h1 = height[side, s, 0], height[side, s, 1]
            a0, a1 = azimuth[side, s, 0], azimuth[side, s, 1]
            k1, k2 = h0 * z1 + h1 * y1, h0 * z2 + h1 * y2
            c1, c2 = a0 * z1 + a1 * y1, a0 * z2 + a1 * y2
            km, cm = (k1 + k2) / 3.0, (c1 + c2) / 3.0
            k0, k1, k2 = -km, k1 - km, k2 - km
            c0, c1, c2 = -cm, c1 - cm, c2 - cm
            mixed = k0 * c0 + k1 * c1 + k2 * c2
            t = mixed / (beta[s] / factor**2 + c0 * c0 + c1 * c1 + c2 * c2)
            k0, k1, k2 = k0 - t * c0, k1 - t * c1, k2 - t * c2
            information = (k0 * k0 + k1 * k1 + k2 * k2) / beta[s] + (t / factor) ** 2
            total += 1.0 / information + shift[s]
        out[p] = math.sqrt(total / shift.size)


@_jit
def efficiency(area, looks, curve):  # type: ignore[no-untyped-def]
    cubics, rate, contrast = curve
    looks = looks * area
    share = 1.0 / (1.0 + rate * looks)
    position = share * len(cubics)
    interval = min(int(position), len(cubics) - 1)
    t = position - interval
    scaled = ((cubics[interval, 3] * t + cubics[interval, 2]) * t + cubics[interval, 1]) * t
    scaled += cubics[interval, 0]
    return min(scaled / (max(2.0 * looks * contrast, 1e-300) * share), 1.0)


@_jit
def default(  # type: ignore[no-untyped-def]
    designs,
    height,
    azimuth,
    range_rate,
    doppler_rate,
    u,
    looks,
    curve,
    own,
    factor,
    prior,
    shift,
    limits,
    out,
    worst,
):
    radius_limit, separation_limit, failure_limit, n = limits
    for p in range(designs.shape[0]):
        side = 1 if designs[p, 6] >= 0.0 else 0
        z0, z1, z2 = designs[p, 0], designs[p, 2] - designs[p, 0], designs[p, 4] - designs[p, 0]
        y0, y1, y2 = designs[p, 1], designs[p, 3] - designs[p, 1], designs[p, 5] - designs[p, 1]
        r = 4.0 * max(
            z0 * z0 + (y0 / n) ** 2,
            max(
                designs[p, 2] ** 2 + (designs[p, 3] / n) ** 2,
                designs[p, 4] ** 2 + (designs[p, 5] / n) ** 2,
            ),
        )
        d = 4.0 * min(
            z1 * z1 + (y1 / n) ** 2,
            min(z2 * z2 + (y2 / n) ** 2, (z2 - z1) ** 2 + ((y2 - y1) / n) ** 2),
        )
        worst[p, 0] = 1.0 - math.sqrt(r) / radius_limit
        worst[p, 1] = math.sqrt(d) / separation_limit - 1.0
        total, failed = 0.0, 0.0
        for s in range(shift.size):
            h0, h1 = height[side, s, 0], height[side, s, 1]
            a0, a1 = azimuth[side, s, 0], azimuth[side, s, 1]
            k1, k2 = h0 * z1 + h1 * y1, h0 * z2 + h1 * y2
            c1, c2 = factor * (a0 * z1 + a1 * y1), factor * (a0 * z2 + a1 * y2)
            o1, o2 = k1 * range_rate[s], k2 * range_rate[s]
            e1, e2 = (a0 * z1 + a1 * y1) * doppler_rate[s], (a0 * z2 + a1 * y2) * doppler_rate[s]
            v01 = max(0.0, 1.0 - abs(o1)) * max(0.0, 1.0 - abs(e1))
            v02 = max(0.0, 1.0 - abs(o2)) * max(0.0, 1.0 - abs(e2))
            v12 = max(0.0, 1.0 - abs(o2 - o1)) * max(0.0, 1.0 - abs(e2 - e1))
            across = max(0.0, max(o1, o2)) - min(0.0, min(o1, o2))
            along = max(0.0, max(e1, e2)) - min(0.0, min(e1, e2))
            every = max(0.0, 1.0 - across) * max(0.0, 1.0 - along)
            two, three = 1.0 / (1.0 + 2.0 * u), 1.0 / (1.0 + 3.0 * u)
            scale = 2.0 * looks * u * u
            x01 = scale * ((v01 - every) * two + every * three) * efficiency(v01, looks, curve)
            x02 = scale * ((v02 - every) * two + every * three) * efficiency(v02, looks, curve)
            x12 = scale * ((v12 - every) * two + every * three) * efficiency(v12, looks, curve)
            d1, d2 = x01 + x12, x02 + x12
            det = 1.0 / ((d1 + 1e-12) * (d2 + 1e-12) - x12 * x12)
            q11 = d2 * det + 2.0 * own + c1 * c1
            q22 = d1 * det + 2.0 * own + c2 * c2
            q12 = x12 * det + own + c1 * c2
            det = q11 * q22 - q12 * q12
            total += det / (k1 * k1 * q22 - 2.0 * k1 * k2 * q12 + k2 * k2 * q11) + shift[s]
            q11, q22, q12 = q11 + prior * k1 * k1, q22 + prior * k2 * k2, q12 + prior * k1 * k2
            first = min(q11, min(q22, q11 + q22 - 2.0 * q12))
            second = (q11 * q22 - q12 * q12) / first  # in two dimensions, whatever came first
            one = math.erfc(math.pi / math.sqrt(2.0 * first))
            other = math.erfc(math.pi / math.sqrt(2.0 * second))
            failed = max(failed, one + other - one * other)
        worst[p, 2] = failure_limit - math.log10(max(failed, 1e-16))
        out[p] = math.sqrt(total / shift.size)


def hand_written(problem: Problem, space: DesignSpace) -> Callable[[Array], Array]:
    """Designs → region height errors, by the straight line that fits the problem."""
    k = constants(problem, space)
    own = k.own_variance
    # Without exact statistics a curve that nothing reaches: an efficiency of 1.
    exact = (k.eta_cubics, k.eta_rate[0], k.eta_contrast[0])
    curve = exact if k.has_efficiency else (np.full((1, 4), 1e300), 0.0, 1.0)
    height = k.height * k.per_height[:, None]
    per_kz = k.range_rate / k.per_height
    limits = (k.max_radius, k.min_separation, k.failure_limit, k.mean_motion)

    def score(designs: Array) -> Array:
        out = np.empty(len(designs))
        if k.decorrelation == 0:
            side = 1 if k.sign > 0 else 0
            plain(designs, side, height, k.azimuth, k.alike, k.azimuth_factor, k.shift, out)
            return out
        worst: Any = np.empty((len(designs), 3))
        default(
            designs,
            height,
            k.azimuth,
            per_kz,
            k.doppler_rate,
            k.weight[0, 0],
            k.looks,
            curve,
            own,
            k.azimuth_factor,
            k.prior**2,
            k.shift,
            limits,
            out,
            worst,
        )
        return out

    return score
