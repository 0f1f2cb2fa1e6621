"""Formations with everything that an objective or a limit may look at."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from formation import relative_positions
from insar import ErrorBudget, PhaseModel, Radar, Scene, phase_model

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, kw_only=True)
class Population:
    """P formations; what follows from their states is computed when it is first asked for.

    Parameters
    ----------
    states : (P, N, 6) — RTN states at t = 0 [m, m/s]; None for satellites that are placed at each
        time, by a table, and follow no known orbit.
    mean_motion : scalar — angular rate of the reference orbit [rad/s].
    scene, radar, errors : what they observe, and how.
    placed : (P, S, N, 3) — RTN positions at the scene's times where there are no states [m].
    given_model : a phase model that does not follow from the positions alone; None for the one
        that does.
    """

    states: Array | None
    mean_motion: float
    scene: Scene
    radar: Radar
    errors: ErrorBudget
    placed: Array | None = None
    given_model: PhaseModel | None = None

    @cached_property
    def positions(self) -> Array:
        """RTN positions at the scene's times, (P, S, N, 3) [m]."""
        if self.placed is not None or self.states is None:
            return np.asarray(self.placed)
        return relative_positions(self.states, self.scene.times, mean_motion=self.mean_motion)

    @cached_property
    def model(self) -> PhaseModel:
        """The phase model at the scene's times."""
        if self.given_model is not None:
            return self.given_model
        return phase_model(self.positions, self.scene, radar=self.radar, errors=self.errors)
