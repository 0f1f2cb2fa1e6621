"""Random problems for the certificate: radars, geometries, budgets, limits, both families."""

from __future__ import annotations

from typing import Any

import numpy as np

from formation import ground_track_circular, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    LookSide,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    monostatic,
    one_transmitter,
    ping_pong,
)
from insar.baselines import scene_critical_baseline
from optimize import Constraints, DesignSpace, Problem


def random_scene(rng: np.random.Generator, segments: int) -> Scene:
    """A strip, some squinted a little, so that the segments differ."""
    strip = Scene.broadside_strip(
        times=rng.uniform(-300.0, 300.0) + np.linspace(0.0, rng.uniform(1.0, 60.0), segments),
        look_angle=np.deg2rad(rng.uniform(18.0, 45.0)),
        altitude=rng.uniform(400e3, 800e3),
        earth_radius=6378137.0,
        side=LookSide.LEFT if rng.random() < 0.5 else LookSide.RIGHT,
    )
    if rng.random() < 0.5:
        return strip
    return Scene(
        times=strip.times,
        slant_range=strip.slant_range * rng.uniform(1.0, 1.05, segments),
        look_angle=strip.look_angle,
        azimuth=strip.azimuth
        + np.deg2rad(rng.uniform(-8.0, 8.0) + rng.uniform(-4.0, 4.0, segments)),
        incidence=strip.incidence,
    )


def random_problem(
    rng: np.random.Generator, satellites: int, *, segments: int = 3, **fixed: Any
) -> tuple[Problem, DesignSpace]:
    """A problem and its designs; `fixed` names fields of the budget."""
    scene = random_scene(rng, segments)
    arrangements = [one_transmitter(satellites), monostatic(satellites)]
    if satellites <= 3:
        arrangements.append(ping_pong(satellites))
    radar = Radar(
        wavelength=float(rng.choice([0.031, 0.056, 0.236])),
        slant_range_resolution=rng.uniform(1.0, 8.0),
        snr=10.0 ** rng.uniform(0.3, 2.0),
        looks=float(rng.integers(1, 64)),
        images=arrangements[rng.integers(len(arrangements))],
        azimuth_resolution=None if rng.random() < 0.4 else 10.0 ** rng.uniform(0.0, 1.3),
    )
    pairs = rng.random() < 0.3
    shared = SharedBy.PAIR if pairs and rng.random() < 0.5 else None
    budget: dict[str, Any] = {
        "position": ErrorSource(10.0 ** rng.uniform(-4.0, -2.0), shared or SharedBy.SATELLITE),
        "azimuth": ErrorSource(10.0 ** rng.uniform(-7.0, -4.0), shared or SharedBy.ALL),
        "range": ErrorSource(0.01, SharedBy.ALL),
        "synchronization": ErrorSource(float(rng.choice([0.0, 0.02])), shared or SharedBy.IMAGE),
        "weighting": Weighting.PAIRS if pairs else Weighting.JOINT,
        "baseline_decorrelation": list(BaselineDecorrelation)[rng.integers(3)],
        "held_constant": list(HeldConstant)[rng.integers(2)],
    }
    budget |= fixed
    errors = ErrorBudget(**budget)
    n = 1.1e-3
    critical = float(scene_critical_baseline(scene, radar).min())
    amplitude = critical * rng.uniform(0.05, 0.5)
    probability = None if rng.random() < 0.5 else float(rng.uniform(0.3, 0.99))
    problem = Problem(
        mean_motion=n,
        scene=scene,
        radar=radar,
        errors=errors,
        constraints=Constraints(
            max_radius=2.0 * amplitude,
            min_separation=amplitude * rng.uniform(0.02, 0.2),
            min_unwrapping_probability=probability,
            prior_height_std=10.0 ** rng.uniform(-0.5, 1.0),
            max_baseline_fraction=None if rng.random() < 0.7 else rng.uniform(0.1, 0.9),
        ),
    )
    space = DesignSpace(
        names=tuple(f"S{index}" for index in range(satellites)),
        family=space_circular if rng.random() < 0.5 else ground_track_circular,
        mean_motion=n,
        max_offset=amplitude,
        max_rate=amplitude * n,
        signs=(1, -1) if rng.random() < 0.5 else (1,),
    )
    return problem, space


def random_designs(
    rng: np.random.Generator, problem: Problem, space: DesignSpace, count: int
) -> np.ndarray:
    """Designs in the disc: uniform, on its edge, and along lines."""
    size = (count, space.satellites)
    radius = 0.5 * (problem.constraints.max_radius or 0.0) * (1.0 - 1e-12)
    length = np.sqrt(rng.random(size))
    length[: count // 3] = 1.0
    angle = rng.uniform(0.0, 2.0 * np.pi, size)
    line = slice(count // 3, 2 * count // 3)
    angle[line] = angle[line, :1] + np.pi * rng.integers(0, 2, angle[line].shape)
    angle[line] += rng.normal(0.0, 0.02, angle[line].shape)
    z0, rate = radius * length * np.cos(angle), radius * length * np.sin(angle)
    sign = np.asarray(space.signs, dtype=float)[rng.integers(len(space.signs), size=count)]
    return space.encode(z0, rate * space.mean_motion, sign)
