"""From the derivatives of each segment to those by the design variables."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import ground_track_circular, space_circular
from formation.separation import satellite_pairs
from insar import BaselineDecorrelation, PhaseModel, Weighting
from insar.baselines import scene_critical_baseline

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import Projection, projection
from .edges import Bands, EdgeModel, edge_model, edge_slopes
from .heights import Slopes, failure_slopes, height_slopes
from .images import bands_of

Array = NDArray[np.float64]

_SAME_MODEL = 1e-7
"""Relative difference of the information here and in `insar` that is rounding, not another model.
Unequal rows of a nearly coherent matrix cancel: it is far above 1e-16."""

_LEAST_FAILURE = 1e-16
"""Failure below which its margin is held constant, as `FailureLimit` has it."""


class DesignSlopes(NamedTuple):
    """Scores of one design and their derivatives.

    Attributes
    ----------
    objective : region height error [m].
    margins : (items,) — as `Problem.objectives_and_margins` has them, all limits in a row.
    log_objective_slopes : (2N,) — of the logarithm of the region height error.
    margin_slopes : (items, 2N)
    """

    objective: float
    margins: Array
    log_objective_slopes: Array
    margin_slopes: Array


def design_slopes(problem: Problem, space: DesignSpace) -> Callable[[Array], DesignSlopes | None]:
    """Return the function that differentiates designs of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.

    Returns
    -------
    (D,) design → `DesignSlopes`; None where the model has a part whose derivatives are not known
    here, or the design measures no height: differences are to be taken instead.
    """
    if not _differentiable(problem, space):
        return lambda _design: None
    return _Differentiation(problem, space)


def _differentiable(problem: Problem, space: DesignSpace) -> bool:
    errors = problem.errors
    return (
        space.family in (space_circular, ground_track_circular)
        and errors.weighting is Weighting.JOINT
        and errors.baseline_decorrelation is not BaselineDecorrelation.UNFILTERED
    )


@dataclass(frozen=True)
class _Differentiation:
    problem: Problem
    space: DesignSpace

    def __call__(self, design: Array) -> DesignSlopes | None:
        problem = self.problem
        population = problem.population(self.space.states(design[None]))
        bands = bands_of(population, problem)
        if bands is None:
            return None
        margins = [limit.margins(population)[0] for limit in problem.limits]
        objective = float(problem.region_error(population)[0])
        if not math.isfinite(objective):
            return None
        model = _first(population.model)
        edges = edge_model(bands)
        if not _agrees(edges.edges, model.information):
            return None  # the model has grown a part that is not known here
        plane = projection(
            self.space,
            problem.scene,
            held_constant=problem.errors.held_constant,
            sign=int(self.space.decode(design).sign),
        )
        fisher, slopes = height_slopes(model)
        quantities = [slopes]
        limits = problem.constraints
        if limits.min_unwrapping_probability is not None and limits.prior_height_std is not None:
            logarithm, slopes = failure_slopes(model, prior_height_std=limits.prior_height_std)
            # Below the floor of the margin nothing changes it.
            counts = (logarithm > math.log(_LEAST_FAILURE))[:, None]
            quantities.append(
                Slopes(
                    slopes.wavenumber * counts,
                    slopes.edge * counts[..., None],
                    slopes.azimuth * counts,
                )
            )
        by_segment = self._by_design(quantities, bands, edges, plane)
        weight = -0.5 / (objective**2 * len(fisher) * fisher**2)
        perpendicular = model.vertical_wavenumber * plane.lever[:, None]
        failure = by_segment[1] if len(quantities) > 1 else None
        rows = self._margin_slopes(design, plane, perpendicular, failure)
        return DesignSlopes(
            objective,
            np.concatenate([np.empty(0), *margins]),
            np.einsum("s,snv->nv", weight, by_segment[0]).ravel(),
            rows.reshape(len(rows), 2 * self.space.satellites),
        )

    def _by_design(
        self, quantities: list[Slopes], bands: Bands, edges: EdgeModel, plane: Projection
    ) -> Array:
        """Derivatives (Q, S, N, 2) of quantities of the segments by the design variables."""
        problem = self.problem
        wavenumber = 2.0 * math.pi / problem.radar.wavelength
        coefficient = np.stack([slopes.edge for slopes in quantities])
        by_range, by_doppler = edge_slopes(bands, edges, coefficient)
        kz = np.stack([slopes.wavenumber for slopes in quantities])
        azimuth = np.stack([slopes.azimuth for slopes in quantities])
        per_height = kz * (wavenumber / plane.lever[:, None]) + by_range * bands.range_rate[:, None]
        per_azimuth = azimuth * wavenumber * problem.errors.azimuth.std
        if bands.doppler_rate is not None:
            per_azimuth = per_azimuth + by_doppler * bands.doppler_rate[:, None]
        # Projections are relative to the first image, which therefore answers for all others.
        for part in (per_height, per_azimuth):
            part[..., 0] -= part.sum(axis=-1)
        incidence = problem.radar.incidence_matrix
        across = (per_height @ incidence)[..., None] * plane.height[:, None, :]
        along = (per_azimuth @ incidence)[..., None] * plane.azimuth[:, None, :]
        return np.asarray((across + along) * np.array([1.0, 1.0 / self.space.mean_motion]))

    def _margin_slopes(
        self, design: Array, plane: Projection, perpendicular: Array, failure: Array | None
    ) -> Array:
        """Derivatives (items, N, 2) of all margins, in the order of `Constraints.limits`.

        `failure` holds those of the logarithm of the unwrapping failure, (S, N, 2).
        """
        limits = self.problem.constraints
        count, rate = self.space.satellites, np.array([1.0, 1.0 / self.space.mean_motion])
        points = design[: 2 * count].reshape(count, 2) * rate
        rows = [np.empty((0, count, 2))]
        if limits.max_radius is not None:
            rows.append(-2.0 / limits.max_radius * _own(_direction(points)) * rate)
        if limits.min_separation is not None:
            rows.append(2.0 / limits.min_separation * _apart(points) * rate)
        if failure is not None:
            rows.append(-failure / math.log(10.0))
        if limits.max_baseline_fraction is not None:
            slopes = self._fraction_slopes(plane, perpendicular) * rate
            rows.append(-slopes / limits.max_baseline_fraction)
        if limits.max_offset is not None:
            rows.append(-_own(np.sign(points) * [1.0, 0.0]) / limits.max_offset)
        if limits.max_rate is not None:
            rows.append(-_own(np.sign(points) * [0.0, 1.0]) / limits.max_rate)
        return np.concatenate(rows)

    def _fraction_slopes(self, plane: Projection, perpendicular: Array) -> Array:
        """Derivatives (S·K, N, 2) of |B⊥|/B_crit of each pair, `perpendicular` (S, M)."""
        radar, scene = self.problem.radar, self.problem.scene
        first, second = radar.image_pairs.T
        side = np.sign(perpendicular[:, second] - perpendicular[:, first])
        side = side / scene_critical_baseline(scene, radar)[:, None]
        uses = radar.incidence_matrix[second] - radar.incidence_matrix[first]
        slopes = side[..., None, None] * uses[..., None] * plane.height[:, None, None, :]
        return np.asarray(slopes.reshape(-1, *slopes.shape[2:]))


def _first(model: PhaseModel) -> PhaseModel:
    """The model of the first formation of a population."""
    return model._replace(
        vertical_wavenumber=model.vertical_wavenumber[0],
        information=model.information[0],
        nuisance={name: factor[0] for name, factor in model.nuisance.items()},
    )


def _agrees(edges: Array, information: Array) -> bool:
    """Whether edges are those of the information, in each segment up to rounding."""
    apart = np.abs(edges + information) * (1.0 - np.eye(edges.shape[-1]))
    return bool(np.all(apart.max((-2, -1)) <= _SAME_MODEL * np.abs(edges).max((-2, -1))))


def _direction(vectors: Array) -> Array:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit: Array = vectors / np.where(length > 0.0, length, 1.0)
    return unit


def _own(slopes: Array) -> Array:
    """Derivatives (N, N, 2) of one quantity of each satellite, which depends on that alone."""
    count = len(slopes)
    return np.asarray(np.eye(count)[..., None] * slopes[:, None, :])


def _apart(points: Array) -> Array:
    """Derivatives (K, N, 2) of the distance of each pair in the plane.

    The closest approach of a pair of either family is twice that: |k| ≥ √3.
    """
    first, second = satellite_pairs(len(points)).T
    unit = _direction(points[second] - points[first])
    slopes = np.zeros((len(first), len(points), 2))
    pair = np.arange(len(first))
    slopes[pair, first], slopes[pair, second] = -unit, unit
    return slopes
