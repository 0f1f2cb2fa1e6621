"""The linear model of the image phases that height, its error and the unwrapping share."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BaselineDecorrelation, ErrorBudget, PhaseStatistics, Scale, SharedBy, Weighting
from .image_model import ImageModel, image_information, image_model, pair_noise
from .phase_information import independent_pairs_information, pair_phase_variance
from .phase_noise import lessen_information, pair_efficiency
from .radar import Radar
from .scene import Scene
from .statistics import efficiency_curves

Array = NDArray[np.float64]


class PhaseModel(NamedTuple):
    """Phases of M images, φ = kz·h + Σ F_s ε_s + noise, for every design and segment.

    Attributes
    ----------
    vertical_wavenumber : (..., S, M) — kz of each image relative to the first [rad/m].
    information : (..., S, M, M) — information of the noise, rows summing to zero: Fisher's, and
        under the exact phase statistics lessened pair by pair [1/rad²].
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
    images = image_model(positions, scene, radar=radar, errors=errors)
    kz = images.vertical_wavenumber
    wavenumber = 2.0 * np.pi / radar.wavelength

    factors: dict[str, Array] = {}
    if errors.position.std > 0.0:
        factors["position"] = wavenumber * errors.position.std * radar.relative_incidence
    if errors.azimuth.std > 0.0:
        factors["azimuth"] = wavenumber * errors.azimuth.std * images.azimuth_projection[..., None]
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
        information = image_information(images, radar=radar, errors=errors)
        if errors.phase_statistics is PhaseStatistics.EXACT:
            efficiency = _efficiency(images, radar, errors)
            information = lessen_information(information, efficiency, pairs=radar.image_pairs)
        return PhaseModel(kz, information, nuisance, {}, scale)

    pair_variance = {"phase": _pair_variance(images, radar, errors)}
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


def _pair_variance(images: ImageModel, radar: Radar, errors: ErrorBudget) -> Array:
    noise = pair_noise(images, radar=radar, errors=errors)
    if errors.phase_std is not None:
        coherent = (noise.coherence > 0.0) & (noise.looks > 0.0)
        return np.where(coherent, errors.phase_std**2, np.inf)
    bound = pair_phase_variance(noise.coherence, looks=noise.looks)
    if errors.phase_statistics is PhaseStatistics.CRAMER_RAO:
        return bound
    return bound / _efficiency(images, radar, errors)


def _efficiency(images: ImageModel, radar: Radar, errors: ErrorBudget) -> Array:
    noise = pair_noise(images, radar=radar, errors=errors)
    varies = errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED
    if varies or images.pair_factor is not None:
        return pair_efficiency(noise.coherence, noise.looks)
    first, second = radar.image_pairs.T  # coherence stays, looks vary from design to design
    steady = efficiency_curves(images.amplitude[:, first] * images.amplitude[:, second])
    return steady(noise.looks)
