"""Time of one exact phase deviation: curves and table against direct quadrature.

Run ``python benchmarks/phase_statistics.py``. Peers in the same process: the Cramér-Rao formula,
the exact variance by 96 Gauss points over the density, and by SciPy's adaptive quadrature over the
published form with its hypergeometric function.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from time import perf_counter

import numpy as np
from scipy.integrate import quad
from scipy.special import gammaln, hyp2f1

from insar.phase_information import pair_phase_variance
from insar.statistics import efficiency_curves, phase_efficiency, phase_pdf, phase_variance


def main() -> None:
    rng = np.random.default_rng(1)
    gamma = np.full((10, 3), 0.909)
    looks = rng.uniform(0.5, 16.0, (100, 10, 3))
    start = perf_counter()
    phase_variance(0.9, looks=1.0)
    print(f"first use (builds the table): {1e3 * (perf_counter() - start):.0f} ms")
    curves = efficiency_curves(gamma)
    cases: dict[str, tuple[Callable[[], object], int]] = {
        "Cramér-Rao formula": (lambda: pair_phase_variance(gamma, looks=looks), looks.size),
        "curves of fixed coherences": (lambda: curves(looks), looks.size),
        "table, any coherence": (lambda: phase_efficiency(gamma, looks=looks), looks.size),
        "96 Gauss points": (lambda: gauss(0.909, looks.ravel()[:300]), 300),
        "scipy.integrate.quad": (lambda: [adaptive(0.909, x) for x in looks.ravel()[:5]], 5),
    }
    for name, (function, count) in cases.items():
        print(f"{name:28s} {1e9 * fastest(function) / count:12.0f} ns an element")


def fastest(function: Callable[[], object]) -> float:
    """Seconds of the fastest of 20 calls: the machine is shared."""
    times = []
    for _ in range(20):
        start = perf_counter()
        function()
        times.append(perf_counter() - start)
    return min(times)


def gauss(gamma: float, looks: np.ndarray) -> np.ndarray:
    node, weight = np.polynomial.legendre.leggauss(96)
    phi = 0.5 * math.pi * (node + 1)
    density = phase_pdf(phi, coherence=gamma, looks=looks[:, None])
    return np.sum(math.pi * weight * phi**2 * density, axis=-1)


def adaptive(gamma: float, looks: float) -> float:
    def integrand(phi: float) -> float:
        beta = gamma * math.cos(phi)
        first = math.exp(
            gammaln(looks + 0.5)
            - gammaln(looks)
            + looks * math.log(1 - gamma**2)
            - (looks + 0.5) * math.log(1 - beta**2)
        )
        second = (1 - gamma**2) ** looks / (2 * math.pi) * hyp2f1(looks, 1, 0.5, beta**2)
        return 2 * phi**2 * (first * beta / (2 * math.sqrt(math.pi)) + second)

    return quad(integrand, 0, math.pi)[0]


if __name__ == "__main__":
    main()
