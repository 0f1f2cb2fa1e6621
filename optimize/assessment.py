"""Everything that a report says of one formation, computed once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import min_separation, relative_positions, satellite_pairs
from insar import (
    HeightError,
    UnwrappingLadder,
    pair_coherence,
    pair_critical_baseline,
    pair_geometry,
    unwrapping_ladder,
)
from insar.simulation import Refutation
from insar.unwrapping import bootstrap_failure

from .constraints import ConstraintReport
from .problem import Problem

Array = NDArray[np.float64]

_ORBIT_SAMPLES = 181
"""Points of a drawn relative orbit: 2° apart, closed."""


class ImagePair(NamedTuple):
    """The interferogram of two images.

    Attributes
    ----------
    images : the two images, as indices into `Radar.images`.
    perpendicular_baseline, azimuth_baseline : (S,) — signed, between the satellites [m].
    height_of_ambiguity : (S,) — `inf` at zero baseline [m].
    baseline_over_critical : (S,) — |B⊥| in parts of the critical baseline of this pair; from 1 on
        the pair is not coherent.
    coherence : (S,) — of an interferogram at these baselines.
    looks : (S,) — effective looks, fewer than the radar's after spectral filtering.
    """

    images: tuple[int, int]
    perpendicular_baseline: Array
    azimuth_baseline: Array
    height_of_ambiguity: Array
    baseline_over_critical: Array
    coherence: Array
    looks: Array


class Rung(NamedTuple):
    """One step of the unwrapping ladder.

    Attributes
    ----------
    images : the two images joined, as indices into `Radar.images`.
    phase_std : deviation of its phase, given the prior height and the rungs below [rad].
    probability : that its cycle is found.
    """

    images: tuple[int, int]
    phase_std: float
    probability: float


class Unwrapping(NamedTuple):
    """Whether the phase of a formation can be unwrapped.

    Attributes
    ----------
    prior_height_std : deviation of the height known beforehand [m].
    probability : (S,) — that every rung succeeds.
    worst_segment : 0-based segment with the smallest probability.
    rungs : the ladder in that segment, the surest pair first.
    """

    prior_height_std: float
    probability: Array
    worst_segment: int
    rungs: tuple[Rung, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """One formation, assessed.

    Attributes
    ----------
    label : what it is called in the report.
    names : name of each satellite.
    states : (N, 6) — RTN states at t = 0 [m, m/s]; z0 is [:, 0] and ż0 is [:, 3].
    orbits : (T, N, 3) — RTN positions over one revolution from t = 0, closed [m].
    scene_positions : (S, N, 3) — RTN positions at the scene's times [m].
    height_error : of (S,) arrays.
    pairs : of every two images, ordered as `Radar.image_pairs`.
    separations : (K,) — closest approach of each two satellites, ordered as
        `formation.satellite_pairs` [m].
    unwrapping : None without a prior height.
    constraints : how it stands to each limit.
    refutation : what a simulation says of its height error; None where there was none.
    """

    label: str
    names: tuple[str, ...]
    states: Array
    orbits: Array
    scene_positions: Array
    height_error: HeightError
    pairs: tuple[ImagePair, ...]
    separations: Array
    unwrapping: Unwrapping | None
    constraints: tuple[ConstraintReport, ...]
    refutation: Refutation | None = None

    @property
    def feasible(self) -> bool:
        """Whether it measures a height within every limit."""
        return bool(np.isfinite(self.height_error.region)) and all(
            report.satisfied for report in self.constraints
        )

    @property
    def separation_pairs(self) -> NDArray[np.intp]:
        """Satellites of each separation, (K, 2)."""
        return satellite_pairs(len(self.names))


def assess(
    problem: Problem, states: ArrayLike, *, label: str, names: tuple[str, ...]
) -> Assessment:
    """Assess one formation.

    Parameters
    ----------
    problem : what it observes, and its limits.
    states : (N, 6) — RTN states at t = 0 [m, m/s].
    label : what it is called in the report.
    names : name of each satellite.

    Returns
    -------
    Assessment
    """
    state = np.asarray(states, dtype=np.float64)
    population = problem.population(state[None])
    times = np.linspace(0.0, 2.0 * np.pi / problem.mean_motion, _ORBIT_SAMPLES)
    positions = population.positions[0]
    unwrapping = None
    if problem.constraints.prior_height_std is not None:
        prior = problem.constraints.prior_height_std
        unwrapping = _unwrapping(unwrapping_ladder(population.model, prior_height_std=prior), prior)
    error = problem.height_error(population)
    return Assessment(
        label=label,
        names=names,
        states=state,
        orbits=relative_positions(state, times, mean_motion=problem.mean_motion),
        scene_positions=positions,
        height_error=HeightError(
            total=error.total[0],
            relative=error.relative[0],
            terms={name: term[0] for name, term in error.terms.items()},
            status=error.status[0],
        ),
        pairs=_pairs(problem, positions),
        separations=min_separation(state, mean_motion=problem.mean_motion),
        unwrapping=unwrapping,
        constraints=problem.constraint_reports(population),
    )


def _pairs(problem: Problem, positions: Array) -> tuple[ImagePair, ...]:
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    geometry = pair_geometry(positions, scene, radar=radar, held_constant=errors.held_constant)
    coherence, looks = pair_coherence(
        geometry.perpendicular_baseline,
        scene,
        radar=radar,
        baseline_decorrelation=errors.baseline_decorrelation,
    )
    critical = pair_critical_baseline(scene, radar)
    fraction = np.abs(geometry.perpendicular_baseline) / critical
    return tuple(
        ImagePair(
            images=(int(first), int(second)),
            perpendicular_baseline=geometry.perpendicular_baseline[:, k],
            azimuth_baseline=geometry.azimuth_baseline[:, k],
            height_of_ambiguity=geometry.height_of_ambiguity[:, k],
            baseline_over_critical=fraction[:, k],
            coherence=coherence[:, k],
            looks=looks[:, k],
        )
        for k, (first, second) in enumerate(radar.image_pairs)
    )


def _unwrapping(ladder: UnwrappingLadder, prior_height_std: float) -> Unwrapping:
    probability = ladder.probability[0]
    worst = int(np.argmax(ladder.failure[0]))
    deviations = ladder.cycle_std[0, worst]
    rungs = tuple(
        Rung(
            images=(int(min(pair)), int(max(pair))),
            phase_std=float(2.0 * np.pi * deviation),
            probability=float(1.0 - bootstrap_failure(deviation[None])),
        )
        for pair, deviation in zip(ladder.pairs[0, worst], deviations, strict=True)
    )
    return Unwrapping(prior_height_std, probability, worst, rungs)
