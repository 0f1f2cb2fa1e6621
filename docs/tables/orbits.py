"""How good the theory of mean elements is."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from formation import (
    Elements,
)
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
    EARTH_J2,
)
from formation.j2 import drifted, osculating_states

from .markdown import markdown_table


def _flattened(_: float, state: np.ndarray) -> np.ndarray:
    """Rate of a state in the field of a flattened Earth."""
    position = state[:3]
    radius = float(np.linalg.norm(position))
    flattening = 1.5 * EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / radius) ** 2
    factors = 1.0 - flattening * (5.0 * (position[2] / radius) ** 2 - np.array([1.0, 1.0, 3.0]))
    pull = -EARTH_GRAVITATIONAL_PARAMETER / radius**3 * position * factors
    return np.concatenate([state[3:], pull])


def _theory_error(eccentricity: float, inclination: float, duration: float) -> float:
    """Largest distance of the theory from the integrated orbit [m]."""
    axis = (EARTH_EQUATORIAL_RADIUS + 600e3) / (1.0 - eccentricity)
    mean = Elements(axis, eccentricity, math.radians(inclination), 1.0, 0.7, 0.4)
    times = np.linspace(0.0, duration, 1000)
    start = np.concatenate(osculating_states(mean))
    integrated = solve_ivp(
        _flattened, (0.0, duration), start, "DOP853", times, rtol=1e-12, atol=1e-6
    ).y[:3]
    theory = osculating_states(drifted(mean, times)).position
    return float(np.linalg.norm(theory - integrated.T, axis=-1).max())


def mean_elements() -> str:
    """Mean elements with secular drift against numerical integration."""
    inclinations = (90.0, 97.44, 63.43, 5.0)
    rows = [
        [
            f"e = {eccentricity:g}",
            *(
                " / ".join(
                    f"{_theory_error(eccentricity, inclination, duration):.0f}"
                    for duration in (6000.0, 86_400.0)
                )
                for inclination in inclinations
            ),
        ]
        for eccentricity in (0.0, 0.001, 0.1, 0.3)
    ]
    head = ["6000 s / 1 day [m]", *(f"i = {inclination:g}°" for inclination in inclinations)]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {
    "mean_elements": mean_elements,
}
"""Tables by the name that a page calls them."""
