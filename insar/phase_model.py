"""The linear model of the image phases that height, its error and the unwrapping share."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .baselines import (
    image_projections,
    pair_critical_baseline,
    scene_critical_baseline,
    sensitivity,
)
from .coherence import common_band
from .errors import BaselineDecorrelation, ErrorBudget, Scale, SharedBy, Weighting
from .phase_information import (
    filtered_information,
    fisher_information,
    independent_pairs_information,
    pair_phase_variance,
)
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]


class PhaseModel(NamedTuple):
    """Phases of M images, φ = kz·h + Σ F_s ε_s + noise, for every design and segment.

    Attributes
    ----------
    vertical_wavenumber : (..., S, M) — kz of each image relative to the first [rad/m].
    information : (..., S, M, M) — Fisher information of the noise, rows summing to zero [1/rad²].
    nuisance : source → (..., S, M, R) — factor F_s of the errors that images share, relative to
        the first image [rad], with ε_s independent and of unit variance.
    pair_variance : source → (..., S, K) — variances that are independent from pair to pair
        [rad²]; empty under the joint weighting.
    scale : source → its scale.
    """

    vertical_wavenumber: Array
    information: Array
    nuisance: dict[str, Array]
    pair_variance: dict[str, Array]
    scale: dict[str, Scale]


def phase_model(
    positions: ArrayLike, scene: Scene, *, radar: Radar, errors: ErrorBudget
) -> PhaseModel:
    """Build the phase model of a formation, or of a whole population of them.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar and its M images.
    errors : the error budget.

    Returns
    -------
    PhaseModel

    Raises
    ------
    ValueError
        If the shape of the positions does not fit the scene and the images.
    """
    direction = sensitivity(scene, errors.held_constant)
    projected = image_projections(positions, direction, radar=radar)
    wavenumber = 2.0 * np.pi / radar.wavelength
    kz = wavenumber * projected[..., 0] / direction.height_lever[:, None]
    offset = projected[..., 0] / scene_critical_baseline(scene, radar)[:, None]

    factors: dict[str, Array] = {}
    if errors.position.std > 0.0:
        factors["position"] = wavenumber * errors.position.std * radar.relative_incidence
    if errors.azimuth.std > 0.0:
        factors["azimuth"] = wavenumber * errors.azimuth.std * projected[..., 1:2]
    if errors.synchronization.std > 0.0:
        bistatic = np.diag([float(tx != rx) for tx, rx in radar.images])
        factors["synchronization"] = errors.synchronization.std * bistatic
    nuisance = {
        name: np.broadcast_to(factor - factor[..., :1, :], (*kz.shape, factor.shape[-1]))
        for name, factor in factors.items()
    }

    scale = {"phase": Scale.PIXEL} | errors.common_scales
    scale |= {name: getattr(errors, name).scale for name in nuisance}
    if errors.weighting is Weighting.JOINT:
        information = _joint_information(offset, radar, errors.baseline_decorrelation)
        return PhaseModel(kz, information, nuisance, {}, scale)

    pair_variance = {"phase": _pair_noise(offset, radar, errors)}
    first, second = radar.image_pairs.T
    for name in list(nuisance):
        if getattr(errors, name).shared_by is SharedBy.PAIR:
            factor = nuisance.pop(name)
            pair_variance[name] = np.sum(
                (factor[..., second, :] - factor[..., first, :]) ** 2, axis=-1
            )
    information = independent_pairs_information(
        sum(pair_variance.values(), start=np.zeros(())),
        pairs=radar.image_pairs,
        count=len(radar.images),
    )
    return PhaseModel(kz, information, nuisance, pair_variance, scale)


def pair_coherence(
    perpendicular_baseline: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    baseline_decorrelation: BaselineDecorrelation,
) -> tuple[Array, Array]:
    """Coherence and looks of each pair.

    Parameters
    ----------
    perpendicular_baseline : (..., S, K) — from `pair_geometry` [m].
    scene : the S segments.
    radar : the radar.
    baseline_decorrelation : what a perpendicular baseline costs.

    Returns
    -------
    coherence : (..., S, K) — zero where a pair has no common band.
    looks : (..., S, K) — effective number of looks.
    """
    baseline = np.asarray(perpendicular_baseline, dtype=np.float64)
    shift = baseline / pair_critical_baseline(scene, radar)
    return _coherence_and_looks(common_band(0.0, shift), radar, baseline_decorrelation)


def _coherence_and_looks(
    band: Array, radar: Radar, decorrelation: BaselineDecorrelation
) -> tuple[Array, Array]:
    base = radar.image_coherence**2
    everywhere = np.ones_like(band)
    if decorrelation is BaselineDecorrelation.NONE:
        return base * everywhere, radar.looks * everywhere
    if decorrelation is BaselineDecorrelation.UNFILTERED:
        return base * band, radar.looks * everywhere
    return np.where(band > 0.0, base, 0.0), radar.looks * band


def _joint_information(offset: Array, radar: Radar, decorrelation: BaselineDecorrelation) -> Array:
    if decorrelation is BaselineDecorrelation.UNFILTERED:
        coherence = radar.image_coherence**2 * common_band(
            offset[..., :, None], offset[..., None, :]
        )
        index = np.arange(offset.shape[-1])
        coherence[..., index, index] = 1.0
        return fisher_information(coherence, looks=radar.looks)
    if decorrelation is BaselineDecorrelation.NONE:
        offset = np.zeros_like(offset)
    return filtered_information(offset, image_coherence=radar.image_coherence, looks=radar.looks)


def _pair_noise(offset: Array, radar: Radar, errors: ErrorBudget) -> Array:
    first, second = radar.image_pairs.T
    band = common_band(offset[..., first], offset[..., second])
    if errors.phase_std is not None:
        visible = (band > 0.0) | (errors.baseline_decorrelation is BaselineDecorrelation.NONE)
        return np.where(visible, errors.phase_std**2, np.inf)
    coherence, looks = _coherence_and_looks(band, radar, errors.baseline_decorrelation)
    return pair_phase_variance(coherence, looks=looks)
