"""Everything that a report says of one formation, computed once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import min_separation, relative_positions, satellite_pairs
from insar import (
    Decorrelation,
    HeightError,
    PhaseModel,
    UnwrappingLadder,
    decorrelated_unwrapping,
    pair_budget,
    pair_coherence,
    pair_critical_baseline,
    pair_geometry,
    unwrapping_ladder,
)
from insar.simulation import Refutation
from insar.unwrapping import bootstrap_failure

from .constraints import ConstraintReport
from .population import Population
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
    factors : name → (S,) — of the coherence; see `insar.pair_budget`.
    common_range, common_azimuth : (S,) — shares of the bands that the images have in common.
    volume_bias : (S,) — height above the ground that the pair reports of a volume [m]; None
        without one.
    """

    images: tuple[int, int]
    perpendicular_baseline: Array
    azimuth_baseline: Array
    height_of_ambiguity: Array
    baseline_over_critical: Array
    coherence: Array
    looks: Array
    factors: dict[str, Array]
    common_range: Array
    common_azimuth: Array
    volume_bias: Array | None


class Rung(NamedTuple):
    """One step of the unwrapping ladder.

    Attributes
    ----------
    images : the two images joined, as indices into `Radar.images`.
    height_of_ambiguity : of their difference, `inf` at zero baseline [m].
    phase_std : deviation of its phase, given the prior height and the rungs below [rad].
    probability : that its cycle is found.
    """

    images: tuple[int, int]
    height_of_ambiguity: float
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
    decorrelated : (S,) — that bootstrapping succeeds after decorrelation of the ambiguities
        (LAMBDA), never below `probability`; what a limit asks for is the ladder's.
    ceiling : (S,) — what no integer estimator exceeds.
    """

    prior_height_std: float
    probability: Array
    worst_segment: int
    rungs: tuple[Rung, ...]
    decorrelated: Array
    ceiling: Array


class Motion(NamedTuple):
    """Relative orbits of a formation.

    Attributes
    ----------
    states : (N, 6) — RTN states at t = 0 [m, m/s]; z0 is [:, 0] and ż0 is [:, 3].
    orbits : (T, N, 3) — RTN positions over one revolution from t = 0, closed [m].
    separations : (K,) — closest approach of each two satellites, ordered as
        `formation.satellite_pairs` [m].
    """

    states: Array
    orbits: Array
    separations: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """One formation, assessed.

    Attributes
    ----------
    label : what it is called in the report.
    names : name of each satellite.
    motion : its orbits; None where only positions are given, by a table: nothing is known of where
        the satellites are at other times, nor how close they come.
    scene_positions : (S, N, 3), or (A, S, N, 3) of A acquisitions that are combined — RTN positions
        at the scene's times [m].
    height_error : of (S,) arrays.
    pairs : of every two images of an acquisition, ordered as `Radar.image_pairs`.
    acquisitions : labels of the acquisitions that are combined; empty for a single one. The images
        of a combination are numbered as `insar.combine_acquisitions` orders them.
    unwrapping : None without a prior height.
    constraints : how it stands to each limit.
    refutation : what a simulation says of its height error; None where there was none.
    """

    label: str
    names: tuple[str, ...]
    motion: Motion | None
    scene_positions: Array
    height_error: HeightError
    pairs: tuple[ImagePair, ...]
    unwrapping: Unwrapping | None
    constraints: tuple[ConstraintReport, ...]
    acquisitions: tuple[str, ...] = ()
    refutation: Refutation | None = None

    @property
    def feasible(self) -> bool:
        """Whether it measures a height within every limit."""
        return bool(np.isfinite(self.height_error.region)) and all(
            report.satisfied for report in self.constraints
        )

    @property
    def flown(self) -> Motion:
        """Its orbits.

        Raises
        ------
        ValueError
            If it is given by its positions alone.
        """
        if self.motion is None:
            raise ValueError(f"the orbits of {self.label!r} are not known, only its positions")
        return self.motion

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
    times = np.linspace(0.0, 2.0 * np.pi / problem.mean_motion, _ORBIT_SAMPLES)
    motion = Motion(
        states=state,
        orbits=relative_positions(state, times, mean_motion=problem.mean_motion),
        separations=min_separation(state, mean_motion=problem.mean_motion),
    )
    return _assessed(problem, problem.population(state[None]), motion, label=label, names=names)


def assess_placed(
    problem: Problem, positions: ArrayLike, *, label: str, names: tuple[str, ...]
) -> Assessment:
    """Assess a formation that is given by its positions.

    Parameters
    ----------
    problem : what it observes, and its limits.
    positions : (S, N, 3) — RTN positions at the scene's times [m].
    label : what it is called in the report.
    names : name of each satellite.

    Raises
    ------
    ValueError
        If a limit is on that needs orbits.
    """
    population = problem.placed(np.asarray(positions, dtype=np.float64)[None])
    return _assessed(problem, population, None, label=label, names=names)


def _assessed(
    problem: Problem,
    population: Population,
    motion: Motion | None,
    *,
    label: str,
    names: tuple[str, ...],
) -> Assessment:
    return Assessment(
        label=label,
        names=names,
        motion=motion,
        scene_positions=population.positions[0],
        height_error=first_height_error(problem.height_error(population)),
        pairs=image_pairs(problem, population.positions[0]),
        unwrapping=unwrapping_of(problem, population.model),
        constraints=problem.constraint_reports(population),
    )


def first_height_error(error: HeightError) -> HeightError:
    """Height error of the first of several designs, of (S,) arrays."""
    return HeightError(
        total=error.total[0],
        relative=error.relative[0],
        terms={name: term[0] for name, term in error.terms.items()},
        status=error.status[0],
    )


def unwrapping_of(problem: Problem, model: PhaseModel) -> Unwrapping | None:
    """Whether the phase of the first design of a model can be unwrapped; None without a prior."""
    prior = problem.constraints.prior_height_std
    if prior is None:
        return None
    ladder = unwrapping_ladder(model, prior_height_std=prior)
    reduced = decorrelated_unwrapping(model, prior_height_std=prior, ladder=ladder)
    return _unwrapping(ladder, reduced, model.vertical_wavenumber[0], prior)


def image_pairs(problem: Problem, positions: Array) -> tuple[ImagePair, ...]:
    """Interferogram of every two images of one acquisition.

    Parameters
    ----------
    problem : scene, radar and errors.
    positions : (S, N, 3) — RTN positions at the scene's times [m].
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    geometry = pair_geometry(positions, scene, radar=radar, held_constant=errors.held_constant)
    coherence, looks = pair_coherence(positions, scene, radar=radar, errors=errors)
    budget = pair_budget(positions, scene, radar=radar, errors=errors)
    bias = budget.volume_bias
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
            factors={name: values[:, k] for name, values in budget.factors.items()},
            common_range=budget.common_range[:, k],
            common_azimuth=budget.common_azimuth[:, k],
            volume_bias=None if bias is None else bias[:, k],
        )
        for k, (first, second) in enumerate(radar.image_pairs)
    )


def _unwrapping(
    ladder: UnwrappingLadder,
    reduced: Decorrelation,
    vertical_wavenumber: Array,
    prior_height_std: float,
) -> Unwrapping:
    probability = ladder.probability[0]
    worst = int(np.argmax(ladder.failure[0]))
    deviations = ladder.cycle_std[0, worst]
    kz = vertical_wavenumber[worst]
    with np.errstate(divide="ignore"):
        ambiguity = 2.0 * np.pi / np.abs(kz[:, None] - kz)
    rungs = tuple(
        Rung(
            images=(int(min(pair)), int(max(pair))),
            height_of_ambiguity=float(ambiguity[pair[0], pair[1]]),
            phase_std=float(2.0 * np.pi * deviation),
            probability=float(1.0 - bootstrap_failure(deviation[None])),
        )
        for pair, deviation in zip(ladder.pairs[0, worst], deviations, strict=True)
    )
    return Unwrapping(
        prior_height_std,
        probability,
        worst,
        rungs,
        decorrelated=reduced.probability[0],
        ceiling=reduced.ceiling[0],
    )
