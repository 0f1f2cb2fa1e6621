"""Height error of images that are all alike: from the scatter of their phase centers alone.

Without decorrelation all images see the same, and noise and shared errors act on their phases as a
multiple of the identity, β, but for what all have in common. So the height information is that of
N numbers with one variance: O(N) for each formation, where matrices of N images cost O(N³).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from formation import relative_positions
from insar import BaselineDecorrelation, ErrorBudget, Radar, Scene, SharedBy, Weighting
from insar.baselines import sensitivity
from insar.coherence import image_amplitude
from insar.errors import PhaseStatistics
from insar.height import common_height_errors
from insar.statistics import efficiency_curves

from .shared_errors import shared_errors

Array = NDArray[np.float64]

_NO_WAVENUMBER = 1e-15
_NOTHING = 1e-60
"""What `insar.height` takes for no baseline [rad/m] and no information [1/m²]."""

_CHUNK = 512
"""Formations of one pass, so that its arrays stay in the cache."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Scatter:
    """Region height error of formations whose images are all alike.

    Parameters
    ----------
    incidence : (M, N) — how often the satellites' positions count in each phase center.
    directions : (2S, 6) — vertical wavenumber [rad/m], then azimuth phase by one deviation of the
        azimuth error [rad], of a satellite by its state.
    variance : (S,) — β of a phase: noise and shared errors but that of the azimuth [rad²].
    azimuth : whether there is an azimuth error.
    shift : (S,) — squares of the errors that move the height directly [m²].
    """

    incidence: Array
    directions: Array
    variance: Array
    azimuth: bool
    shift: Array

    @property
    def satellites(self) -> int:
        """Number N of satellites."""
        return int(self.incidence.shape[1])

    def region(self, states: Array) -> Array:
        """Region height error.

        Parameters
        ----------
        states : (P, N, 6) — RTN states at t = 0 [m, m/s].

        Returns
        -------
        (P,) — [m]; `inf` where no height is measured.

        Notes
        -----
        With kz and the azimuth phases c, both less their mean, t = Σkz c/(β + Σc²) and
        J = Σ(kz − tc)²/β + t²: what the azimuth error leaves, without cancellation.
        """
        result = np.empty(len(states))
        for start in range(0, len(states), _CHUNK):
            part = slice(start, start + _CHUNK)
            result[part] = self._region(states[part])
        return result

    def _region(self, states: Array) -> Array:
        relative = np.ascontiguousarray((states - states[:, :1]).transpose(2, 1, 0))  # (6, N, P)
        centers = self.incidence @ relative
        centers -= centers.mean(axis=1, keepdims=True)
        flat = self.directions @ centers.reshape(6, -1)
        kz, along = flat.reshape(2, len(self.shift), *centers.shape[1:])  # (S, M, P) each
        beta = self.variance[:, None]
        own = np.zeros((len(self.shift), len(states)))
        for image in range(kz.shape[1]):
            own += kz[:, image] ** 2
        information = own / beta
        if self.azimuth:
            information = self._less_azimuth(kz, along, beta)
        measured = (own >= _NO_WAVENUMBER**2) & (information >= _NOTHING)
        variance = 1.0 / np.where(measured, information, 1.0) + self.shift[:, None]
        return np.asarray(np.sqrt(np.mean(np.where(measured, variance, np.inf), axis=0)))

    @staticmethod
    def _less_azimuth(kz: Array, along: Array, beta: Array) -> Array:
        """Information that the azimuth error leaves, (S, P)."""
        mixed, across = np.zeros((2, kz.shape[0], kz.shape[2]))
        for image in range(kz.shape[1]):
            mixed += kz[:, image] * along[:, image]
            across += along[:, image] ** 2
        across += beta
        slope = mixed / across
        left = np.zeros_like(mixed)
        for image in range(kz.shape[1]):
            left += (kz[:, image] - slope * along[:, image]) ** 2
        return np.asarray(left / beta + slope**2)


def scatter_of(
    *, scene: Scene, radar: Radar, errors: ErrorBudget, mean_motion: float
) -> Scatter | None:
    """Reduce a problem to the scatter of the phase centers.

    Parameters
    ----------
    scene, radar, errors : of the problem.
    mean_motion : scalar — angular rate of the reference orbit [rad/s].

    Returns
    -------
    Scatter; None where images differ, or something but the azimuth error depends on the design.
    """
    variance = alike_variance(scene=scene, radar=radar, errors=errors)
    if variance is None:
        return None
    direction = sensitivity(scene, errors.held_constant)
    wavenumber = 2.0 * np.pi / radar.wavelength
    motion = relative_positions(np.eye(6), scene.times, mean_motion=mean_motion)  # (S, 6, 3)
    height = (motion @ direction.height_direction[..., None])[..., 0]
    azimuth = (motion @ direction.azimuth_direction[..., None])[..., 0]
    scaled = height * (wavenumber / direction.height_lever)[:, None]
    common = common_height_errors(scene, radar=radar, errors=errors)
    return Scatter(
        incidence=radar.incidence_matrix,
        directions=np.concatenate([scaled, azimuth * (wavenumber * errors.azimuth.std)]),
        variance=variance,
        azimuth=errors.azimuth.std > 0.0,
        shift=np.sum([error**2 for error in common.values()], axis=0),
    )


def alike_variance(*, scene: Scene, radar: Radar, errors: ErrorBudget) -> Array | None:
    """Variance of each segment's phases where all images are alike, noise and shared errors.

    With a Laplacian of equal edges x, and shared errors that act on centered phases as p² times the
    identity, both are multiples of it: 1/(Mx) + p².

    Parameters
    ----------
    scene, radar, errors : of the problem.

    Returns
    -------
    (S,) — [rad²]; None where images differ, or something but the azimuth error depends on the
    design.
    """
    if errors.baseline_decorrelation is not BaselineDecorrelation.NONE:
        return None
    if not errors.coherence.spectral or errors.azimuth.shared_by is SharedBy.PAIR:
        return None
    shared = shared_errors(radar=radar, errors=errors)
    count = len(radar.images)
    amplitude = image_amplitude(scene, radar=radar, errors=errors)
    amplitude = np.broadcast_to(amplitude, (len(scene), count))
    same = shared.own_variance >= 0.0 and np.ptp(shared.pair_variance) == 0.0
    if not same or np.any(np.ptp(amplitude, axis=-1) > 0.0):
        return None
    gamma = amplitude[:, 0] ** 2
    efficiency = np.ones(len(scene))
    if errors.phase_statistics is PhaseStatistics.EXACT:
        looks = np.full((len(scene), 1), radar.looks)
        efficiency = efficiency_curves(gamma[:, None])(looks)[:, 0]
    if errors.weighting is Weighting.JOINT:
        weight = gamma / (1.0 - gamma)
        edge = 2.0 * radar.looks * weight**2 / (1.0 + count * weight)
        return np.asarray(1.0 / (count * edge * efficiency) + shared.own_variance)
    variance = (1.0 - gamma**2) / (2.0 * radar.looks * gamma**2) / efficiency
    if errors.phase_std is not None:
        variance = np.full(len(scene), errors.phase_std**2)
    return np.asarray((variance + shared.pair_variance[0]) / count + shared.own_variance)
