"""The radar, and which satellites transmit and receive each image."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import helmert

Array = NDArray[np.float64]
Image = tuple[int, int]
"""An image: the 0-based indices of its (transmitter, receiver)."""


@dataclass(frozen=True, kw_only=True)
class Radar:
    """What the error model needs to know of the radar.

    Parameters
    ----------
    wavelength : scalar — carrier wavelength [m].
    slant_range_resolution : scalar — resolution across the line of sight, c/2B [m].
    snr : scalar — signal-to-noise ratio of an image, as a power ratio.
    looks : scalar — independent looks averaged in an interferogram; need not be whole.
    images : the (transmitter, receiver) of each image, as 0-based satellite indices. The phase
        center of an image is p_tx + p_rx, so one transmitter for all counts baselines once and
        monostatic images count them twice.
    other_coherence : scalar — coherence that is left by what the budget does not name, the same in
        every pair, at most 1.
    azimuth_resolution : scalar — resolution along track, on the ground [m]. None: separations along
        track are taken to cost no coherence.

    Raises
    ------
    ValueError
        If a number is outside its range or there are fewer than two images.
    """

    wavelength: float
    slant_range_resolution: float
    snr: float
    looks: float
    images: tuple[Image, ...]
    other_coherence: float = 1.0
    azimuth_resolution: float | None = None

    def __post_init__(self) -> None:
        for name in ("wavelength", "slant_range_resolution", "snr"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be a finite positive number")
        if not (math.isfinite(self.looks) and self.looks >= 1.0):
            raise ValueError(f"looks = {self.looks!r} must be a finite number, at least 1")
        if not 0.0 < self.other_coherence <= 1.0:
            raise ValueError(
                f"other_coherence = {self.other_coherence!r} must lie above 0 and at most 1"
            )
        azimuth = self.azimuth_resolution
        if azimuth is not None and not (math.isfinite(azimuth) and azimuth > 0.0):
            raise ValueError(f"azimuth_resolution = {azimuth!r} must be a finite positive number")
        if len(self.images) < 2:
            raise ValueError(f"images = {self.images!r}: interferometry needs at least two")
        if len(set(self.images)) < len(self.images):
            raise ValueError(f"images = {self.images!r}: an image is listed twice")
        if any(index < 0 for image in self.images for index in image):
            raise ValueError(f"images = {self.images!r}: satellite indices start at 0")

    @staticmethod
    def snr_from_nesz(*, backscatter: float, nesz: float) -> float:
        """Signal-to-noise ratio of an image.

        Parameters
        ----------
        backscatter : scalar — normalized radar cross-section σ⁰, as a ratio.
        nesz : scalar — noise-equivalent σ⁰, as a ratio.
        """
        return backscatter / nesz

    @property
    def satellite_count(self) -> int:
        """Number of satellites that the images refer to."""
        return 1 + max(index for image in self.images for index in image)

    @cached_property
    def image_pairs(self) -> NDArray[np.intp]:
        """Pairs of images (i, j), i < j: (K, 2), ordered (0,1), (0,2), …, (1,2), …."""
        return np.stack(np.triu_indices(len(self.images), k=1), axis=-1)

    @cached_property
    def incidence_matrix(self) -> Array:
        """How often each image uses each satellite: (M, N) of 0, 1 (one way) or 2 (both ways)."""
        matrix = np.zeros((len(self.images), self.satellite_count))
        for row, (transmitter, receiver) in enumerate(self.images):
            matrix[row, transmitter] += 1.0
            matrix[row, receiver] += 1.0
        return matrix

    @cached_property
    def relative_incidence(self) -> Array:
        """`incidence_matrix` for shifts relative to the fleet's mean, in an orthonormal basis.

        (M, N − 1). No phase sees a common shift, and carrying it along would leave the shared
        system of `height_error_of` near singular.
        """
        return np.asarray(self.incidence_matrix @ helmert(self.satellite_count).T)

    @cached_property
    def pair_multiplicity(self) -> Array:
        """How often each pair counts its baseline: (K,), 2 where both images are monostatic."""
        monostatic = np.array([tx == rx for tx, rx in self.images])
        both = monostatic[self.image_pairs].all(axis=-1)
        return np.where(both, 2.0, 1.0)

    @property
    def multiplicity(self) -> float:
        """The largest of `pair_multiplicity`: the m of the critical baseline of the formation."""
        return float(self.pair_multiplicity.max())

    @property
    def pursuit(self) -> bool:
        """Whether every image is monostatic.

        Then each satellite looks at the target when it passes it, at zero Doppler: images that are
        apart along track share their azimuth band and differ in time. All other images are taken at
        one moment, under one illumination: they share the time and differ in their azimuth band.
        """
        return all(transmitter == receiver for transmitter, receiver in self.images)

    @property
    def image_coherence(self) -> float:
        """Amplitude γ_i by noise alone; `insar.coherence.image_amplitude` counts all."""
        return math.sqrt(self.other_coherence / (1.0 + 1.0 / self.snr))


def one_transmitter(count: int, *, transmitter: int = 0) -> tuple[Image, ...]:
    """Images of a formation in which one satellite transmits and all receive (TanDEM-X).

    Parameters
    ----------
    count : number of satellites.
    transmitter : 0-based index of the satellite that transmits.
    """
    return tuple((transmitter, receiver) for receiver in range(count))


def monostatic(count: int) -> tuple[Image, ...]:
    """Images of a formation in which each satellite receives its own echoes (pursuit).

    Parameters
    ----------
    count : number of satellites.
    """
    return tuple((index, index) for index in range(count))


def ping_pong(count: int) -> tuple[Image, ...]:
    """Images of a formation whose satellites transmit in turn while all receive.

    Parameters
    ----------
    count : number of satellites.

    Notes
    -----
    Image (j, i) has the phase center of image (i, j) and adds looks, not baselines.
    """
    return tuple((tx, rx) for tx in range(count) for rx in range(count))
