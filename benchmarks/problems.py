"""Problems that the benchmarks share: those of the tests, which they do not import."""

from __future__ import annotations

import dataclasses
import tomllib
from pathlib import Path
from typing import NamedTuple

import numpy as np

import configs
from configs.build import build_optimize
from configs.loader import load_study
from formation import Orbit, ground_track_circular, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    one_transmitter,
)
from insar.baselines import scene_critical_baseline
from optimize import Constraints, DesignSpace, GeneticSettings, Problem, SearchSettings

MEAN_MOTION = Orbit.circular(altitude=514e3, inclination=np.deg2rad(97.44)).mean_motion

_PUBLISHED = Path(__file__).parents[1] / "tests" / "published" / "li2009.toml"

REALISTIC_LIMITS = Constraints(
    max_radius=1353.66,  # half of the critical baseline
    min_separation=100.0,
    min_unwrapping_probability=0.99,
    prior_height_std=4.0,
)


class Landscape(NamedTuple):
    """A search problem with the settings that a study of it would use.

    Attributes
    ----------
    name : in words.
    problem, space : what is searched.
    settings : of our search.
    """

    name: str
    problem: Problem
    space: DesignSpace
    settings: SearchSettings


def realistic_problem(
    satellites: int,
    *,
    errors: ErrorBudget | None = None,
    constraints: Constraints = REALISTIC_LIMITS,
    segments: int = 10,
) -> tuple[Problem, DesignSpace]:
    """X band, broadside, 1 mm, filtering, joint weighting, unwrapping from 4 m.

    Parameters
    ----------
    satellites : number N of satellites.
    errors : another error budget than the realistic one.
    constraints : the limits.
    segments : number S of segments of the 10 s.
    """
    scene = Scene.broadside_strip(
        times=np.linspace(0.0, 10.0, segments),
        look_angle=np.deg2rad(23),
        altitude=514e3,
        earth_radius=6_378_137.0,
    )
    problem = Problem(
        mean_motion=MEAN_MOTION,
        scene=scene,
        radar=_radar(satellites, looks=16.0),
        errors=realistic_errors() if errors is None else errors,
        constraints=constraints,
    )
    return problem, _space(satellites, radius=1353.66, signs=(1, -1))


def realistic_errors() -> ErrorBudget:
    """1 mm per satellite and axis, 1 m on the ground in azimuth, 1 cm in range."""
    return ErrorBudget(
        position=ErrorSource(0.001, SharedBy.SATELLITE),
        azimuth=ErrorSource(1.0 / 562.5e3, SharedBy.ALL),
        range=ErrorSource(0.01, SharedBy.ALL),
    )


def paper_problem(
    satellites: int, *, errors: ErrorBudget, constraints: Constraints
) -> tuple[Problem, DesignSpace]:
    """The radar, the scene (Table 2) and the ground-track family of Li 2009.

    Parameters
    ----------
    satellites : number N of satellites.
    errors : the error budget.
    constraints : the limits.
    """
    table = tomllib.loads(_PUBLISHED.read_text(encoding="utf-8"))["table2"]
    scene = Scene.flat_earth(
        times=np.arange(1.0, 11.0),
        slant_range=np.array(table["slant_range_km"]) * 1e3,
        look_angle=np.deg2rad(table["look_deg"]),
        azimuth=np.deg2rad(table["azimuth_deg"]),
    )
    problem = Problem(
        mean_motion=MEAN_MOTION,
        scene=scene,
        radar=_radar(satellites, looks=1.0),
        errors=errors,
        constraints=constraints,
    )
    return problem, _space(satellites, radius=1211.2, signs=(1,))


def shipped_problem(name: str) -> tuple[Problem, DesignSpace]:
    """The problem of a study that comes with the program.

    Parameters
    ----------
    name : of the study, which optimizes.
    """
    study = load_study(Path(configs.__file__).parent / f"{name}.yaml").study
    setup = build_optimize(study)
    return setup.problem, setup.space


def landscapes(*, counts: tuple[int, ...] = (3, 5, 8), quick: bool = False) -> list[Landscape]:
    """The landscapes of `search.py`, with the settings of the shipped studies.

    Parameters
    ----------
    counts : numbers of satellites.
    quick : few generations and refinements, to see that all runs.
    """
    shared = dataclasses.replace(
        ErrorBudget.li2009(),
        azimuth=ErrorSource(np.deg2rad(0.01), SharedBy.ALL),
        phase_std=0.316,
    )
    unfiltered = dataclasses.replace(
        realistic_errors(),
        position=ErrorSource(0.01, SharedBy.SATELLITE),
        baseline_decorrelation=BaselineDecorrelation.UNFILTERED,
    )
    limits = Constraints(max_radius=1211.2, min_separation=100.0)
    genetic = GeneticSettings(population=40, generations=5 if quick else 25)
    settings = SearchSettings(genetic, refinements=1 if quick else 6)
    made: list[Landscape] = []
    for count in counts:
        problems = {
            # No decorrelation: a dumbbell, whose optimum a convex certificate proves.
            "dumbbell": paper_problem(count, errors=shared, constraints=limits),
            # Unfiltered decorrelation: an unequal ladder.
            "ladder": paper_problem(count, errors=unfiltered, constraints=limits),
            # The shipped study: filtering, and the phase must be unwrapped.
            "unwrapped": realistic_problem(count),
        }
        made += [
            Landscape(f"{name}, {count} satellites", *pair, settings)
            for name, pair in problems.items()
        ]
    return made


def random_study(number: int) -> Landscape:
    """A problem as a study might describe it; the same number gives the same one.

    Parameters
    ----------
    number : counts the problems; the satellites go through 2 to 8.
    """
    rng = np.random.default_rng([6, number])
    satellites = 2 + number % 7
    band, wavelength, resolution = (("X", 0.031, 3.0), ("C", 0.056, 5.0), ("L", 0.236, 8.0))[
        rng.integers(3)
    ]
    altitude = rng.uniform(400e3, 800e3)
    orbit = Orbit.circular(altitude=altitude, inclination=np.deg2rad(97.5))
    scene = Scene.broadside_strip(
        times=np.linspace(0.0, 10.0, 8),
        look_angle=np.deg2rad(rng.uniform(20.0, 40.0)),
        altitude=altitude,
        earth_radius=6_378_137.0,
    )
    radar = Radar(
        wavelength=wavelength,
        slant_range_resolution=resolution,
        snr=10.0 ** rng.uniform(0.7, 1.5),
        looks=float(rng.integers(6, 49)),
        images=one_transmitter(satellites),
        azimuth_resolution=resolution if rng.random() < 0.5 else None,
    )
    pairs = rng.random() < 0.25
    decorrelation = (
        BaselineDecorrelation.FILTERED,
        BaselineDecorrelation.FILTERED,
        BaselineDecorrelation.UNFILTERED,
        BaselineDecorrelation.NONE,
    )[rng.integers(4)]
    errors = ErrorBudget(
        position=ErrorSource(10.0 ** rng.uniform(-3.0, -2.0), SharedBy.SATELLITE),
        azimuth=ErrorSource(rng.uniform(0.5, 3.0) / float(scene.slant_range[0]), SharedBy.ALL),
        range=ErrorSource(0.01, SharedBy.ALL),
        weighting=Weighting.PAIRS if pairs else Weighting.JOINT,
        baseline_decorrelation=decorrelation,
    )
    # Of satellites that are still allowed to turn, half of the smallest critical baseline.
    radius = min(0.5 * float(scene_critical_baseline(scene, radar).min()), 4000.0)
    prior = rng.uniform(2.0, 8.0) if rng.random() < 0.85 else None
    family, name = ((ground_track_circular, "ground track"), (space_circular, "space"))[
        rng.integers(2)
    ]
    problem = Problem(
        mean_motion=orbit.mean_motion,
        scene=scene,
        radar=radar,
        errors=errors,
        constraints=Constraints(
            max_radius=radius,
            min_separation=min(100.0, 0.5 * radius / satellites),
            min_unwrapping_probability=None if prior is None else 0.99,
            prior_height_std=prior,
        ),
    )
    space = DesignSpace(
        names=tuple(f"sat {index + 1}" for index in range(satellites)),
        family=family,
        mean_motion=orbit.mean_motion,
        max_offset=radius / 2.0,
        max_rate=radius / 2.0 * orbit.mean_motion,
        signs=(1, -1),
    )
    words = (
        f"{satellites} satellites, {name}, {band} band, {errors.weighting.value}, "
        f"{decorrelation.value}, prior {'none' if prior is None else f'{prior:.1f} m'}"
    )
    return Landscape(words, problem, space, SearchSettings())


def _radar(satellites: int, *, looks: float) -> Radar:
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=looks,
        images=one_transmitter(satellites),
    )


def _space(satellites: int, *, radius: float, signs: tuple[int, ...]) -> DesignSpace:
    return DesignSpace(
        names=tuple(f"sat {index + 1}" for index in range(satellites)),
        family=ground_track_circular,
        mean_motion=MEAN_MOTION,
        max_offset=radius / 2.0,
        max_rate=radius / 2.0 * MEAN_MOTION,
        signs=signs,
    )
