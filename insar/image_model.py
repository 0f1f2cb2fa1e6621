"""The images as the coherence model sees them: amplitudes, bands, and factors of pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bands import BandCell, band_cells
from .baselines import image_projections, scene_critical_baseline, sensitivity
from .coherence import common_band, doppler_offset, image_amplitude
from .errors import BaselineDecorrelation, ErrorBudget
from .phase_information import (
    cell_information,
    filtered_information,
    fisher_information,
)
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class ImageModel(NamedTuple):
    """M images of every design and segment.

    Attributes
    ----------
    vertical_wavenumber : (..., S, M) — kz relative to the first image [rad/m].
    azimuth_projection : (..., S, M) — phase center along the azimuth direction, relative to the
        first image [m].
    range_offset : (..., S, M) — shift of the range band on the ground, in bandwidths.
    doppler_offset : (..., S, M) — of the azimuth band; None where it is not counted.
    amplitude : (S, M) — γ_i of each image.
    volume : (..., S, M, M) — complex factor of a volume, Hermitian; None without one.
    temporal : (..., S, M, M) — factor of time; None without it.
    """

    vertical_wavenumber: Array
    azimuth_projection: Array
    range_offset: Array
    doppler_offset: Array | None
    amplitude: Array
    volume: Complex | None
    temporal: Array | None

    @property
    def pair_factor(self) -> Complex | None:
        """What volume and time leave of each pair, (..., S, M, M); None where both are off."""
        if self.volume is None or self.temporal is None:
            return self.volume if self.temporal is None else self.temporal.astype(np.complex128)
        return self.volume * self.temporal

    @property
    def coherence(self) -> Complex:
        """Γ of the parts of the spectrum that images have in common, (..., S, M, M)."""
        gamma = (self.amplitude[..., :, None] * self.amplitude[..., None, :]).astype(np.complex128)
        if self.pair_factor is not None:
            gamma = gamma * self.pair_factor
        index = np.arange(gamma.shape[-1])
        gamma[..., index, index] = 1.0
        return gamma


class PairNoise(NamedTuple):
    """What the phase noise of each pair follows from.

    Attributes
    ----------
    coherence : (..., S, K) — magnitude; zero where a pair has no common band.
    looks : (..., S, K) — effective number of looks.
    """

    coherence: Array
    looks: Array


def image_model(
    positions: ArrayLike, scene: Scene, *, radar: Radar, errors: ErrorBudget
) -> ImageModel:
    """Amplitudes, bands and pair factors of the images of a formation, or of many.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar and its M images.
    errors : the error budget.

    Returns
    -------
    ImageModel

    Raises
    ------
    ValueError
        If the shape of the positions does not fit the scene and the images.

    Notes
    -----
    Images that are all monostatic (`Radar.pursuit`) are each at zero Doppler: no shift of the
    azimuth band, but the lag that the satellites' separation takes. All others are taken at one
    moment.
    """
    direction = sensitivity(scene, errors.held_constant)
    projected = image_projections(positions, direction, radar=radar)
    wavenumber = 2.0 * np.pi / radar.wavelength
    kz = wavenumber * projected[..., 0] / direction.height_lever[:, None]
    along = projected[..., 1]
    doppler = None
    if radar.azimuth_resolution is not None and not radar.pursuit:
        doppler = doppler_offset(
            along,
            wavelength=radar.wavelength,
            slant_range=scene.slant_range[:, None],
            azimuth_resolution=radar.azimuth_resolution,
        )
    return ImageModel(
        vertical_wavenumber=kz,
        azimuth_projection=along,
        range_offset=projected[..., 0] / scene_critical_baseline(scene, radar)[:, None],
        doppler_offset=doppler,
        amplitude=image_amplitude(scene, radar=radar, errors=errors),
        volume=_volume(kz, scene, errors),
        temporal=_temporal(along, radar, errors),
    )


def _volume(kz: Array, scene: Scene, errors: ErrorBudget) -> Complex | None:
    volume = errors.coherence.volume
    if volume is None:
        return None
    # The phase of Γ_ij is φ_i − φ_j.
    difference = kz[..., :, None] - kz[..., None, :]
    return volume.coherence(difference, incidence=scene.incidence[:, None, None])


def _temporal(along: Array, radar: Radar, errors: ErrorBudget) -> Array | None:
    temporal = errors.coherence.temporal
    if temporal is None:
        return None
    count = len(radar.images)
    if temporal.image_times and len(temporal.image_times) != count:
        raise ValueError(
            f"image_times holds {len(temporal.image_times)} numbers, but there are {count} images; "
            "each needs one"
        )
    times = np.broadcast_to(np.asarray(temporal.image_times or 0.0), along.shape)
    if radar.pursuit and temporal.speed is not None:
        times = times - 0.5 * along / temporal.speed  # a monostatic phase center counts twice
    return temporal.coherence(times[..., :, None] - times[..., None, :])


def pair_noise(images: ImageModel, *, radar: Radar, errors: ErrorBudget) -> PairNoise:
    """Coherence and looks of each pair of images.

    Parameters
    ----------
    images : from `image_model`.
    radar, errors : what it was built from.

    Returns
    -------
    PairNoise — of (..., S, K) arrays, ordered as `Radar.image_pairs`.
    """
    first, second = radar.image_pairs.T
    base = np.broadcast_to(
        images.amplitude[:, first] * images.amplitude[:, second],
        (*images.range_offset.shape[:-1], len(first)),
    )
    if images.pair_factor is not None:
        base = base * np.abs(images.pair_factor[..., first, second])
    decorrelation = errors.baseline_decorrelation
    if decorrelation is BaselineDecorrelation.NONE:
        return PairNoise(base, np.full(base.shape, radar.looks))
    band = common_band(images.range_offset[..., first], images.range_offset[..., second])
    if images.doppler_offset is not None:
        band = band * common_band(
            images.doppler_offset[..., first], images.doppler_offset[..., second]
        )
    if decorrelation is BaselineDecorrelation.UNFILTERED:
        return PairNoise(base * band, np.full(base.shape, radar.looks))
    return PairNoise(np.where(band > 0.0, base, 0.0), radar.looks * band)


def pair_coherence(
    positions: ArrayLike, scene: Scene, *, radar: Radar, errors: ErrorBudget
) -> PairNoise:
    """Coherence and looks of each pair of a formation, or of many.

    Parameters
    ----------
    positions, scene, radar, errors : as for `image_model`.

    Returns
    -------
    PairNoise — of (..., S, K) arrays, ordered as `Radar.image_pairs`.
    """
    return pair_noise(
        image_model(positions, scene, radar=radar, errors=errors), radar=radar, errors=errors
    )


def image_information(images: ImageModel, *, radar: Radar, errors: ErrorBudget) -> Array:
    """Joint Fisher information of the phases by their noise.

    Parameters
    ----------
    images : from `image_model`.
    radar, errors : what it was built from.

    Returns
    -------
    (..., S, M, M) — X, rows summing to zero [1/rad²].

    Notes
    -----
    Volume and time make the coherence matrix general, so that it is inverted numerically; each only
    takes information from the closed form of the amplitudes.
    """
    decorrelation = errors.baseline_decorrelation
    if decorrelation is BaselineDecorrelation.UNFILTERED:
        return fisher_information(unfiltered_coherence(images), looks=radar.looks)
    offset, doppler = images.range_offset, images.doppler_offset
    if decorrelation is BaselineDecorrelation.NONE:
        offset, doppler = np.zeros_like(offset), None
    if errors.coherence.spectral:
        alike = not errors.coherence.image_snr
        return filtered_information(
            offset,
            image_coherence=images.amplitude[..., :1] if alike else images.amplitude,
            looks=radar.looks,
            doppler_offset=doppler,
        )
    return cell_information(
        images.coherence, looks=radar.looks, band_offset=offset, doppler_offset=doppler
    )


def unfiltered_coherence(images: ImageModel) -> Array | Complex:
    """Γ of images whose bands are not filtered, (..., S, M, M); real where no factor is complex.

    Parameters
    ----------
    images : from `image_model`.
    """
    gamma: Array | Complex = images.coherence
    if images.volume is None:
        gamma = np.real(gamma)
    for offset in (images.range_offset, images.doppler_offset):
        if offset is not None:
            gamma = gamma * common_band(offset[..., :, None], offset[..., None, :])
    return gamma


def segment_cells(
    images: ImageModel, segment: int, *, errors: ErrorBudget
) -> tuple[Complex, tuple[BandCell, ...]]:
    """Coherence of the images of one design and segment, and who sees what of the spectrum.

    Parameters
    ----------
    images : of one design, from `image_model`.
    segment : index of the segment.
    errors : what it was built from.

    Returns
    -------
    coherence : (M, M) — Γ of images that see the same part of the spectrum.
    cells : the parts of the spectrum that two or more images see, and their shares of the looks;
        one, of all images, where bands are not filtered or baselines cost nothing.
    """
    count = images.range_offset.shape[-1]
    everything = (BandCell(1.0, np.arange(count)),)
    if errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED:
        return unfiltered_coherence(images)[segment].astype(np.complex128), everything
    one = images.coherence
    gamma = one[min(segment, len(one) - 1)]
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        return gamma, everything
    doppler = None if images.doppler_offset is None else images.doppler_offset[segment]
    return gamma, band_cells(images.range_offset[segment], doppler)
