"""The optimization problem: score a whole population of formations in one call."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from insar import ErrorBudget, HeightError, Radar, Scene, height_error_of

from .constraints import (
    FEASIBILITY_TOLERANCE,
    ConstraintReport,
    Constraints,
    Limit,
)
from .population import Population
from .scatter import Scatter, scatter_of

Array = NDArray[np.float64]

_CHUNK = 150_000
"""Elements of matrices of all images, over formations and segments, that a pass works on."""

_LEAST_CHUNK = 16
"""Formations of a pass below which the calls take more time than the cache saves."""


class Evaluation(NamedTuple):
    """Scores of P formations.

    Attributes
    ----------
    objectives : (P,) — region height error [m]; `inf` where no height is measured.
    violations : (P, C) — how far each limit is broken, in the units of `Limit.margins`; 0 where
        it is kept.
    """

    objectives: Array
    violations: Array

    @property
    def total_violation(self) -> Array:
        """Sum of the violations, (P,); 0 for a formation that keeps every limit."""
        total: Array = self.violations.sum(axis=-1)
        return total

    @property
    def feasible(self) -> NDArray[np.bool_]:
        """Which formations keep every limit and measure a height, (P,)."""
        feasible: NDArray[np.bool_] = (self.total_violation == 0.0) & np.isfinite(self.objectives)
        return feasible


@dataclass(frozen=True, kw_only=True)
class Problem:
    """Minimize the region height error within the constraints.

    Parameters
    ----------
    mean_motion : scalar — angular rate of the reference orbit [rad/s].
    scene : the S segments; their time zero is the epoch of the states.
    radar : the radar and its images.
    errors : the error budget.
    constraints : the limits.
    """

    mean_motion: float
    scene: Scene
    radar: Radar
    errors: ErrorBudget
    constraints: Constraints

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """The C limits, in the order of `Evaluation.violations`."""
        return self.constraints.limits

    def evaluate(self, states: ArrayLike) -> Evaluation:
        """Score formations, all in one batch.

        Parameters
        ----------
        states : (P, N, 6) — RTN states at t = 0 [m, m/s].

        Returns
        -------
        Evaluation
        """
        objectives, margins = self.objectives_and_margins(states)
        worst = np.zeros((objectives.shape[0], len(margins)))
        for column, margin in enumerate(margins):
            worst[:, column] = margin.min(axis=-1)
        broken = worst < -FEASIBILITY_TOLERANCE
        return Evaluation(objectives, np.where(broken, -worst, 0.0))

    def objectives_and_margins(self, states: ArrayLike) -> tuple[Array, list[Array]]:
        """Region height error, and the margin of every single limited item.

        Parameters
        ----------
        states : (P, N, 6) — RTN states at t = 0 [m, m/s].

        Returns
        -------
        objectives : (P,) — region height error [m].
        margins : for each limit (P, items) — see `Limit.margins`; each item is a smooth function
            of the design, the worst of them is not.
        """
        state = np.asarray(states, dtype=np.float64)
        passes = max(1, math.ceil(len(state) / self._chunk))
        parts = [self._scored(part) for part in np.array_split(state, passes)]
        if len(parts) == 1:
            return parts[0]
        regions, margins = zip(*parts, strict=True)
        return np.concatenate(regions), [np.concatenate(one) for one in zip(*margins, strict=True)]

    def _scored(self, states: Array) -> tuple[Array, list[Array]]:
        population = self.population(states)
        return self.region_error(population), [limit.margins(population) for limit in self.limits]

    @property
    def _chunk(self) -> int:
        """Formations of one pass, so that a matrix for each segment stays in the cache."""
        return max(_LEAST_CHUNK, _CHUNK // (len(self.scene) * len(self.radar.images) ** 2))

    def region_error(self, population: Population) -> Array:
        """Region height error, without what each segment and each source adds.

        Parameters
        ----------
        population : from `population` or `placed`.

        Returns
        -------
        (P,) — [m]; `inf` where no height is measured. Where all images are alike it comes of the
        scatter of their phase centers (`optimize.scatter`), elsewhere of `height_error`.
        """
        scatter, states = self._scatter, population.states
        if scatter is None or states is None or states.shape[1:] != (scatter.satellites, 6):
            return self.height_error(population).region
        return scatter.region(states)

    @cached_property
    def _scatter(self) -> Scatter | None:
        return scatter_of(
            scene=self.scene, radar=self.radar, errors=self.errors, mean_motion=self.mean_motion
        )

    def population(self, states: ArrayLike) -> Population:
        """Formations with their phase model at the scene's times.

        Parameters
        ----------
        states : (P, N, 6) — RTN states at t = 0 [m, m/s].
        """
        return self._population(np.asarray(states, dtype=np.float64), None)

    def placed(self, positions: ArrayLike) -> Population:
        """Formations that are given by their positions, whatever orbits lead there.

        Parameters
        ----------
        positions : (P, S, N, 3) — RTN positions at the scene's times [m].

        Raises
        ------
        ValueError
            If a limit is on that needs orbits.
        """
        if self.constraints.of_orbits:
            raise ValueError(
                f"the limits {', '.join(self.constraints.of_orbits)} are on the orbits, which "
                "positions alone do not tell; switch them off"
            )
        return self._population(None, np.asarray(positions, dtype=np.float64))

    def _population(self, states: Array | None, placed: Array | None) -> Population:
        return Population(
            states=states,
            placed=placed,
            mean_motion=self.mean_motion,
            scene=self.scene,
            radar=self.radar,
            errors=self.errors,
        )

    def height_error(self, population: Population) -> HeightError:
        """Height error of formations.

        Parameters
        ----------
        population : from `population`.
        """
        return height_error_of(
            population.model, scene=self.scene, radar=self.radar, errors=self.errors
        )

    def constraint_reports(self, population: Population) -> tuple[ConstraintReport, ...]:
        """How the first formation of a population stands to each limit.

        Parameters
        ----------
        population : from `population`.
        """
        return tuple(
            ConstraintReport(
                limit,
                value=float(limit.worst(population)[0]),
                satisfied=bool(self.keeps(limit, population)[0]),
            )
            for limit in self.limits
        )

    @staticmethod
    def keeps(limit: Limit, population: Population) -> NDArray[np.bool_]:
        """Which formations of a population keep a limit, (P,).

        Parameters
        ----------
        limit : one of the limits.
        population : from `population` or `placed`.
        """
        kept: NDArray[np.bool_] = limit.margins(population).min(axis=-1) >= -FEASIBILITY_TOLERANCE
        return kept
