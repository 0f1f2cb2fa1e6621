"""Functions of eight numbers that the processor has no instruction for."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray
from scipy.special import erfcx

from .lanes import every, floor, jit, power_of_two, smaller

Array = NDArray[np.float64]

_TURN = 3.0
_FARTHEST = 8.5
"""Beyond it erfc is below 3e-33, far under any failure that counts."""

_UNIT_SCALE = 1.0 + _TURN / _FARTHEST


def _scaled_erfc() -> Array:
    """Polynomial (1 + 2x)·e^{x²}·erfc(x) of u = 2ax/(x + c) − 1, from −1 to 1, within 5e-15."""

    def smooth(u: Array) -> Array:
        share = (u + 1.0) / (2.0 * _UNIT_SCALE)
        x = _TURN * share / (1.0 - share)
        return np.asarray((1.0 + 2.0 * x) * erfcx(x))

    chebyshev = np.polynomial.chebyshev
    return np.asarray(chebyshev.cheb2poly(chebyshev.chebinterpolate(smooth, 19)))


_ERFC = _scaled_erfc()
_EXP = np.array([1.0 / math.factorial(order) for order in range(14)])
_LOG2 = math.log(2.0)
_LOG2_HIGH = math.ldexp(round(math.ldexp(_LOG2, 32)), -32)
_LOG2_LOW = float(Decimal(2).ln() - Decimal(_LOG2_HIGH))


@jit
def _polynomial(coefficients, x):
    """Even and odd powers apart, so that two sums go on side by side."""
    squared = x * x
    last = coefficients.size - 1
    even, odd = coefficients[last - 1], coefficients[last]
    total_even, total_odd = every(even), every(odd)
    for order in range(last - 2, 0, -2):
        total_even = total_even * squared + coefficients[order - 1]
        total_odd = total_odd * squared + coefficients[order]
    return total_even + x * total_odd


@jit
def fast_exponential(x):
    """e^x of numbers between −700 and 700, within 1e-15 of itself."""
    power = floor(x * (1.0 / _LOG2) + 0.5)
    rest = (x - power * _LOG2_HIGH) - power * _LOG2_LOW
    return _polynomial(_EXP, rest) * power_of_two(power)


@jit
def complementary_error(x):
    """erfc(x) of numbers from 0 on, within 1e-14 of itself up to 8.5, where it stays."""
    x = smaller(x, _FARTHEST)
    scaled = _polynomial(_ERFC, _UNIT_SCALE * 2.0 * x / (x + _TURN) - 1.0)
    return scaled / (1.0 + 2.0 * x) * fast_exponential(-1.0 * (x * x))
