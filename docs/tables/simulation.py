"""The error model against its simulation, over coherence and looks."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from insar import ErrorBudget, Radar, Scene, one_transmitter
from insar.simulation import SegmentRefutation, refute

from .markdown import markdown_table

_AMBIGUITY = 30.0
_SCENE = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6378137.0
)


def _simulated(shares: tuple[float, ...], *, coherence: float, looks: float) -> SegmentRefutation:
    """Images at these shares of a baseline with 30 m height of ambiguity, phase noise only."""
    radar = Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=coherence / (1.0 - coherence),
        looks=looks,
        images=one_transmitter(len(shares)),
    )
    lever = float(_SCENE.slant_range[0] * np.sin(_SCENE.incidence[0]))
    across = np.cross(_SCENE.line_of_sight, _SCENE.velocity_direction)
    across *= np.sign(across[:, :1]) / np.linalg.norm(across)
    baselines = np.array(shares) * 0.031 * lever / _AMBIGUITY
    return refute(
        baselines[None, :, None] * across[:, None],
        _SCENE,
        radar=radar,
        errors=ErrorBudget(),
        prior_height_std=0.1 * _AMBIGUITY,
        samples=8192,
        rng=np.random.default_rng(1),
    ).segments[0]


def simulation_grid() -> str:
    """Height error and wrong cycles, simulated against predicted."""
    rows = []
    for coherence in (0.4, 0.6, 0.8, 0.95):
        for looks in (4.0, 16.0, 64.0):
            cells = [f"{coherence:g}", f"{looks:g}"]
            for shares in ((0.0, 1.0), (0.0, 0.25, 1.0)):
                one = _simulated(shares, coherence=coherence, looks=looks)
                deviation = one.predicted_total * 2.0 * math.pi / _AMBIGUITY
                cells += [
                    f"{deviation:.3f}",
                    f"{one.right_cycles.value / one.predicted_total:.2f}",
                    f"{100.0 * one.predicted_failure:.1f}",
                    f"{100.0 * one.wrong.value:.1f}",
                ]
            rows.append(cells)
    columns = ("predicted [rad]", "simulated", "wrong, predicted [%]", "simulated [%]")
    head = ["γ", "L", *(f"two: {c}" for c in columns), *(f"three: {c}" for c in columns)]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {"simulation_grid": simulation_grid}
"""Tables by the name that a page calls them."""
