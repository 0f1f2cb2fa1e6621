"""CMA-ES (DEAP's strategy) within a box, feasibility first."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from deap import cma
from numpy.typing import NDArray

from .genetic import Individual
from .islands import COLLAPSED, SearchMethod, own_seed
from .problem import Evaluation

Array = NDArray[np.float64]

_START_RADIUS = 0.6
"""The first mean is drawn within this part of the box."""

_LONGEST_AXIS = 1e7
"""Ratio of the axes of the distribution beyond which its covariance is no longer trusted."""


class CovarianceSettings(NamedTuple):
    """Settings of the covariance matrix adaptation.

    Attributes
    ----------
    population : designs that are drawn each generation, at least 4.
    generations : generations after the first.
    step : first standard deviation, in parts of half the box.
    """

    population: int = 20
    generations: int = 120
    step: float = 0.4

    @property
    def method(self) -> SearchMethod:
        """Which algorithm these are the settings of."""
        return SearchMethod.CMA_ES

    def begin(
        self, *, lower: Array, upper: Array, rng: np.random.Generator, start: Array | None
    ) -> CovariancePopulation:
        """Begin a distribution anywhere in the box, or at the first start.

        Parameters
        ----------
        lower, upper : (D,) — the box.
        rng : draws the first mean and seeds the population's own stream; not kept.
        start : (P0, D) — its first becomes the mean; None: anywhere.
        """
        mean = rng.uniform(-_START_RADIUS, _START_RADIUS, size=lower.size)
        if start is not None and len(start):
            mean = np.clip((start[0] - _middle(lower, upper)) / _half(lower, upper), -1.0, 1.0)
        stream = np.random.default_rng(own_seed(rng))
        strategy = cma.Strategy(mean, self.step, lambda_=self.population)
        return CovariancePopulation(lower, upper, strategy, stream, first=mean)

    def restore(self, data: dict[str, Any], *, lower: Array, upper: Array) -> CovariancePopulation:
        """Restore a distribution from `CovariancePopulation.plain`.

        Parameters
        ----------
        data : the plain data.
        lower, upper : (D,) — the box.
        """
        stream = np.random.default_rng()
        stream.bit_generator.state = data["random"]
        strategy = cma.Strategy(
            np.array(data["mean"]),
            data["step"],
            lambda_=self.population,
            cmatrix=np.array(data["covariance"]),
        )
        strategy.pc, strategy.ps = np.array(data["path"]), np.array(data["step_path"])
        strategy.update_count = data["updates"]
        first = None if data["first"] is None else np.array(data["first"])
        best = None if data["best"] is None else tuple(np.array(part) for part in data["best"])
        return CovariancePopulation(lower, upper, strategy, stream, first=first, best=best)


@dataclass
class CovariancePopulation:
    """A normal distribution that moves and stretches towards better designs.

    Attributes
    ----------
    lower, upper : (D,) — the box; the strategy works in it scaled to ±1.
    strategy : DEAP's.
    rng : its own stream.
    first : a design, scaled, that is scored with the first generation; None later on.
    best : the best design so far and its scores; None before the first.

    Notes
    -----
    A draw outside the box is scored at the nearest design within, and its squared distance from
    there adds to its violation. An island of this algorithm takes in no designs from others: one
    foreign point says nothing of a distribution.

    References
    ----------
    Hansen and Ostermeier 2001, doi:10.1162/106365601750190398; Fortin et al. 2012 (DEAP).
    """

    lower: Array
    upper: Array
    strategy: Any
    rng: np.random.Generator
    first: Array | None = None
    best: tuple[Array, ...] | None = None
    _drawn: Array | None = None

    def propose(self) -> Array:
        """Designs drawn from the distribution, moved into the box."""
        strategy = self.strategy
        normal = self.rng.standard_normal((strategy.lambda_, strategy.dim))
        drawn: Array = strategy.centroid + strategy.sigma * normal @ strategy.BD.T
        if self.first is not None:
            drawn[0], self.first = self.first, None
        self._drawn = drawn
        return self._designs(drawn)

    def learn(self, evaluation: Evaluation) -> None:
        """Adapt mean, step and covariance to the ranking of the draws.

        Parameters
        ----------
        evaluation : of the designs that were proposed.
        """
        if self._drawn is None:
            raise ValueError("learn() before propose(): nothing was proposed")
        violation, objective = evaluation.total_violation, evaluation.objectives
        top = np.lexsort((objective, violation))[0]
        scores = np.array([violation[top], objective[top]])
        if self.best is None or tuple(scores) < tuple(self.best[1]):
            self.best = (self._designs(self._drawn[top]), scores)
        outside = np.sum((self._drawn - np.clip(self._drawn, -1.0, 1.0)) ** 2, axis=-1)
        individuals = [Individual(one) for one in self._drawn.tolist()]
        for individual, *values in zip(individuals, violation + outside, objective, strict=True):
            individual.fitness.values = (float(values[0]), float(values[1]))
        self.strategy.update(individuals)

    @property
    def collapsed(self) -> bool:
        """Whether the distribution has shrunk to a point, or lost its shape."""
        strategy = self.strategy
        axes = strategy.sigma * strategy.diagD
        if not (math.isfinite(strategy.sigma) and np.all(np.isfinite(axes))):
            return True
        # A thousandth of the box is ±: twice the deviation each side.
        return bool(4.0 * axes.max() < 2.0 * COLLAPSED or strategy.cond > _LONGEST_AXIS)

    @property
    def champion(self) -> tuple[Array, Array]:
        """The best design and its scores."""
        if self.best is None:
            raise ValueError("the population has not been scored yet")
        return self.best[0], self.best[1]

    def welcome(self, design: Array, scores: Array) -> None:
        """Take in nothing: see the notes of the class.

        Parameters
        ----------
        design, scores : of a design from another island.
        """

    def plain(self) -> dict[str, Any]:
        """Distribution, best design and random state, as plain data."""
        strategy = self.strategy
        return {
            "mean": strategy.centroid.tolist(),
            "step": float(strategy.sigma),
            "covariance": strategy.C.tolist(),
            "path": strategy.pc.tolist(),
            "step_path": strategy.ps.tolist(),
            "updates": strategy.update_count,
            "first": None if self.first is None else self.first.tolist(),
            "best": None if self.best is None else [part.tolist() for part in self.best],
            "random": self.rng.bit_generator.state,
        }

    def _designs(self, scaled: Array) -> Array:
        within = np.clip(scaled, -1.0, 1.0)
        designs: Array = _middle(self.lower, self.upper) + _half(self.lower, self.upper) * within
        return designs


def _middle(lower: Array, upper: Array) -> Array:
    return 0.5 * (lower + upper)


def _half(lower: Array, upper: Array) -> Array:
    return 0.5 * (upper - lower)
