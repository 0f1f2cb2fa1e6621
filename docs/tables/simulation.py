"""The error model against its simulation, over coherence and looks."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from insar import ErrorBudget, Radar, Scene, one_transmitter, scene_critical_baseline
from insar.simulation import SegmentRefutation, refute
from insar.statistics import phase_std

from .markdown import markdown_table

_AMBIGUITY = 30.0
_SCENE = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6378137.0
)

_RADAR = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=1.0, looks=1.0, images=one_transmitter(2)
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
    """Phase deviation of two images, simulated against exact and Cramér-Rao."""
    rows = []
    critical = float(scene_critical_baseline(_SCENE, _RADAR)[0])
    lever = float(_SCENE.slant_range[0] * np.sin(_SCENE.incidence[0]))
    share = 1.0 - 0.031 * lever / _AMBIGUITY / critical
    for coherence in (0.4, 0.6, 0.8, 0.95):
        for looks in (4.0, 16.0, 64.0):
            one = _simulated((0.0, 1.0), coherence=coherence, looks=looks)
            exact = float(phase_std(coherence, looks=looks * share))
            bound = math.sqrt((1.0 - coherence**2) / (2.0 * looks * share * coherence**2))
            phase = one.right_cycles.value * 2.0 * math.pi / _AMBIGUITY
            rows.append(
                [
                    f"{coherence:g}",
                    f"{looks:g}",
                    *(f"{value:.3f}" for value in (bound, exact, phase)),
                    f"{phase / exact:.2f}",
                    f"{100.0 * one.wrong.value:.1f}",
                ]
            )
    head = [
        "γ",
        "L",
        "Cramér-Rao [rad]",
        "exact [rad]",
        "simulated [rad]",
        "simulated over exact",
        "wrong cycles [%]",
    ]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {"simulation_grid": simulation_grid}
"""Tables by the name that a page calls them."""
