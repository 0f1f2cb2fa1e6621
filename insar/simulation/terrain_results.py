"""What is simulated over a terrain, and what came of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import ErrorBudget
from ..radar import Radar
from ..terrain.view import Mask, TerrainView
from .comparison import Comparison

Array = NDArray[np.float64]
RelativePositions = Callable[[Array], Array]
"""Times (T,) since the middle of the terrain was broadside → positions (T, N, 3), RTN [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TerrainRequest:
    """What is simulated.

    Attributes
    ----------
    view : the terrain as the radar sees it.
    radar : the radar and its M images.
    errors : the error budget of the study.
    relative_positions : how the formation moves.
    mean_motion : scalar — angular rate of the orbit [rad/s].
    prior_height_std : scalar — of the elevation model that is known beforehand [m].
    prior_correlation : scalar — standard deviation of the Gaussian that smooths its errors [m].
    acquisitions : how often it is flown, each time with errors, noise and a prior of its own.
    """

    view: TerrainView
    radar: Radar
    errors: ErrorBudget
    relative_positions: RelativePositions
    mean_motion: float
    prior_height_std: float
    prior_correlation: float
    acquisitions: int


@dataclass(frozen=True, kw_only=True, eq=False)
class TerrainMaps:
    """Maps of the first acquisition, (rows, columns), NaN where nothing is seen.

    Attributes
    ----------
    phase : (M − 1, rows, columns) — wrapped, of every image but the first against it, less what
        the mean height would give at the same range [rad].
    residual_phase : (M − 1, rows, columns) — likewise less what the prior height would give: what
        is unwrapped [rad].
    coherence : (M − 1, rows, columns) — of the same pairs at the local slope, before filtering.
    predicted_total, predicted_relative : of the height, by the error model [m].
    predicted_failure : probability that a cycle is wrong, by the error model.
    prior_error : of the height known beforehand [m].
    random_error : of the height by noise alone, weighted least squares with right cycles [m].
    least_squares_error, likely_error : of the height by weighted least squares, and of the one of
        maximum likelihood [m].
    wrong : whether bootstrapping found a wrong cycle.
    clear : whether every image has a phase worth the name, of 1 rad or better; where slopes leave
        next to no common band it has not.
    """

    phase: Array
    residual_phase: Array
    coherence: Array
    predicted_total: Array
    predicted_relative: Array
    predicted_failure: Array
    prior_error: Array
    random_error: Array
    least_squares_error: Array
    likely_error: Array
    wrong: Mask
    clear: Mask


@dataclass(frozen=True, kw_only=True, eq=False)
class TerrainSimulation:
    """What came of it.

    Attributes
    ----------
    request : what was simulated.
    maps : of the first acquisition.
    points : how many are clear: seen, and coherent in every image. All figures are of these.
    random : height error by noise alone, of weighted least squares with right cycles [m].
    total : with the errors of the scene, right cycles [m].
    wrong : share of points with a wrong cycle.
    least_squares : RMS error with the cycles that bootstrapping finds, over all acquisitions [m].
    most_likely : RMS error of maximum likelihood with the prior, first acquisition [m].
    prior : RMS error of the prior, over all acquisitions [m].
    offsets : (acquisitions,) — mean height error that the errors of the scene cause [m].
    departures : where nature, as drawn, differs from the error model of the study.
    """

    request: TerrainRequest
    maps: TerrainMaps
    points: int
    random: Comparison
    total: Comparison
    wrong: Comparison
    least_squares: float
    most_likely: float
    prior: float
    offsets: Array
    departures: tuple[str, ...]
