"""Error of the height difference of two points by phase noise, as a bound that most pairs keep."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtri

from .errors import ErrorBudget, PhaseStatistics
from .height import height_error_of
from .image_model import pair_coherence
from .phase_model import PhaseModel, phase_model
from .radar import Radar
from .scene import Scene
from .statistics import cramer_rao_std, difference_quantile, phase_std

Array = NDArray[np.float64]


def point_to_point_error(
    positions: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    errors: ErrorBudget,
    level: float = 0.9,
) -> Array:
    """Bound of the error of the difference of two heights, by what varies from pixel to pixel.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar and its images.
    errors : the error budget.
    level : scalar — share of the pairs of points that keep the bound, between 0 and 1.

    Returns
    -------
    (..., S) — [m]; `inf` where no height is measured.

    Raises
    ------
    ValueError
        If the shape of the positions does not fit the scene and the images, or the level is not
        between 0 and 1.

    Notes
    -----
    Two images: the quantile of the difference of two independent phase errors times the height of
    ambiguity over 2π, exactly. More images have no such distribution in closed form; see
    `point_to_point_factor`. Errors shared over the scene are not in it.
    """
    model = phase_model(positions, scene, radar=radar, errors=errors)
    error = height_error_of(model, scene=scene, radar=radar, errors=errors)
    if errors.phase_std is not None:  # given, as a normal deviation
        return error.relative * _normal(level)
    coherence, looks = pair_coherence(positions, scene, radar=radar, errors=errors)
    factor = point_to_point_factor(
        model,
        coherence=coherence,
        looks=looks,
        pairs=radar.image_pairs,
        phase_statistics=errors.phase_statistics,
        level=level,
    )
    return error.relative * factor


def point_to_point_factor(
    model: PhaseModel,
    *,
    coherence: ArrayLike,
    looks: ArrayLike,
    pairs: NDArray[np.intp],
    phase_statistics: PhaseStatistics,
    level: float = 0.9,
    quantile: Callable[..., Array] = difference_quantile,
) -> Array:
    """Bound of the point-to-point error over the random deviation of one point.

    Parameters
    ----------
    model : the phase model of the designs.
    coherence, looks : (..., S, K) — of each pair of images, as from `pair_coherence`.
    pairs : (K, 2) — the images of each pair, `Radar.image_pairs`.
    phase_statistics : what the model was built with.
    level : scalar — share of the pairs of points that keep the bound, between 0 and 1.
    quantile : of the difference of two phases; `statistics.quick.quick_difference_quantile` is
        much faster for many pairs, within 1e-3.

    Returns
    -------
    (..., S) — 2.326 at 90 % for normal errors of the deviation that the model assumes.

    Raises
    ------
    ValueError
        If the level is not between 0 and 1.

    Notes
    -----
    Each pair of images has its factor, the exact quantile over the deviation that the model gives
    its phase. They are averaged, squared, by each pair's part −X_ij(kz_j − kz_i)² in the
    information on the height. For two images that is exact, and for more an approximation that is
    right where one pair dominates (the longest usually does) and at many looks, where all factors
    are alike: the phases of several pairs that are combined are closer to normal than each.
    """
    first, second = pairs.T
    kz = model.vertical_wavenumber
    weight = -model.information[..., first, second] * (kz[..., second] - kz[..., first]) ** 2
    gamma, number = np.broadcast_arrays(
        np.asarray(coherence, dtype=np.float64), np.asarray(looks, dtype=np.float64)
    )
    told = (weight > 0.0) & (gamma > 0.0) & (number > 0.0)
    gamma, number = np.where(told, gamma, 0.5), np.where(told, number, 1.0)
    deviation = phase_std if phase_statistics is PhaseStatistics.EXACT else cramer_rao_std
    assumed = deviation(gamma, looks=number)
    factor = np.full(told.shape, _normal(level))
    exact = quantile(gamma[told], looks=number[told], level=level)
    factor[told] = exact / assumed[told]
    share = np.where(told, weight, 0.0)
    total = np.sum(share, axis=-1)
    mean = np.sum(share * factor**2, axis=-1) / np.where(total > 0.0, total, 1.0)
    return np.asarray(np.where(total > 0.0, np.sqrt(mean), factor[..., 0]))


def _normal(level: float) -> float:
    return math.sqrt(2.0) * float(ndtri(0.5 + 0.5 * level))
