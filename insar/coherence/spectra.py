"""Coherence that shifted spectra and shifted images leave."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def common_band(first_offset: ArrayLike, second_offset: ArrayLike) -> Array:
    """Share of the band that two images have in common on the ground.

    A perpendicular baseline B⊥ shifts the ground's range spectrum by B⊥/B_crit bandwidths, an
    along-track separation its azimuth spectrum by `doppler_offset`. This is the coherence of a
    surface without spectral filtering; with filtering the coherence stays and this share of the
    looks remains.

    Parameters
    ----------
    first_offset, second_offset : (...) — shifts of the images' bands, in bandwidths.

    Returns
    -------
    (...) — max(0, 1 − |o₁ − o₂|).

    Notes
    -----
    The band is a rectangle: no weighting, or one that the processor undoes.

    References
    ----------
    Gatelli et al. 1994, doi:10.1109/36.298013.
    """
    first = np.asarray(first_offset, dtype=np.float64)
    shift = np.abs(first - np.asarray(second_offset, dtype=np.float64))
    return np.maximum(0.0, 1.0 - shift)


def azimuth_resolution(
    doppler_bandwidth: ArrayLike,
    *,
    speed: ArrayLike,
    look_angle: ArrayLike,
    incidence: ArrayLike,
) -> Array:
    """Resolution along track, on the ground, of a processed Doppler bandwidth.

    Parameters
    ----------
    doppler_bandwidth : (...) — processed bandwidth B_D [Hz].
    speed : (...) — of the satellite on its circle [m/s].
    look_angle, incidence : (...) — at the satellite, from nadir, and at the target [rad].

    Returns
    -------
    (...) — V_g/B_D [m]; V_g = V (R/a) cos(θ_inc − θ) is the speed of the zero-Doppler line over a
    sphere of radius R, seen from a circle of radius a, and R/a = sinθ/sinθ_inc. On a flat Earth
    V_g = V.

    Notes
    -----
    The band is a rectangle, as everywhere here: a weighting makes the resolution coarser. The
    Earth's rotation is left out: 1 % for near-polar orbits, up to 7 % for equatorial ones.

    Examples
    --------
    2765 Hz from 514 km at 35° incidence:

    >>> import numpy as np
    >>> incidence = np.deg2rad(35.0)
    >>> look = np.arcsin(np.sin(incidence) * 6371.0 / 6885.0)
    >>> found = azimuth_resolution(2765.0, speed=7605.0, look_angle=look, incidence=incidence)
    >>> print(found.round(3))
    2.542
    """
    look, flat = (np.asarray(angle, dtype=np.float64) for angle in (look_angle, incidence))
    ground_speed = np.asarray(speed) * np.sin(look) / np.sin(flat) * np.cos(flat - look)
    return np.asarray(ground_speed / np.asarray(doppler_bandwidth, dtype=np.float64))


def doppler_offset(
    along_track: ArrayLike,
    *,
    wavelength: float,
    slant_range: ArrayLike,
    azimuth_resolution: ArrayLike,
) -> Array:
    """Shift of the azimuth spectrum of the ground by an along-track separation.

    Parameters
    ----------
    along_track : (...) — separation of the phase centers p_tx + p_rx along the azimuth direction,
        signed [m].
    wavelength : scalar — carrier wavelength λ [m].
    slant_range : (...) — distance r to the target [m].
    azimuth_resolution : (...) — resolution ρ_a along track, on the ground [m].

    Returns
    -------
    (...) — B_a ρ_a/(λ r), in bandwidths: the azimuth band of the ground is 2π/ρ_a wide, and a
    direction that turns by B_a/r shifts it by 2π B_a/(λ r).

    Notes
    -----
    It holds for images taken at the same moment. With ρ_a = V/B_D it is `doppler_shift` over the
    processed Doppler bandwidth B_D, with the same V in both.

    Examples
    --------
    >>> float(doppler_offset(1201.0, wavelength=0.031, slant_range=557.58e3,
    ...     azimuth_resolution=3.0).round(4))
    0.2084
    """
    along = np.asarray(along_track, dtype=np.float64)
    distance = wavelength * np.asarray(slant_range, dtype=np.float64)
    return np.asarray(along * np.asarray(azimuth_resolution, dtype=np.float64) / distance)


def doppler_shift(
    along_track: ArrayLike, *, speed: ArrayLike, wavelength: float, slant_range: ArrayLike
) -> Array:
    """Difference of the Doppler centroids of two images taken at the same moment.

    Parameters
    ----------
    along_track : (...) — separation of the phase centers p_tx + p_rx along the azimuth direction
        [m].
    speed : (...) — of the zero-Doppler line on the ground; the orbital speed, as on a flat Earth,
        is 5 to 10 % too much in low orbit [m/s].
    wavelength : scalar — carrier wavelength [m].
    slant_range : (...) — distance to the target [m].

    Returns
    -------
    (...) — B_a V/(λ r) [Hz].

    Examples
    --------
    Li 2009's ladder, with the orbital speed:

    >>> float(doppler_shift(1201.0, speed=7606.0, wavelength=0.031, slant_range=557.58e3).round())
    528.0
    """
    along = np.asarray(along_track, dtype=np.float64)
    distance = wavelength * np.asarray(slant_range, dtype=np.float64)
    return np.asarray(along * np.asarray(speed, dtype=np.float64) / distance)


def coregistration_coherence(shift: ArrayLike) -> Array:
    """Coherence of two images that are shifted against each other in one direction.

    Parameters
    ----------
    shift : (...) — in resolution cells, below 1.

    Returns
    -------
    (...) — sin(πδ)/(πδ).

    Raises
    ------
    ValueError
        If a shift reaches a whole cell, where nothing is left.

    References
    ----------
    Just and Bamler 1994, doi:10.1364/AO.33.004361.

    Examples
    --------
    >>> float(coregistration_coherence(0.1).round(4))
    0.9836
    """
    cells = np.asarray(shift, dtype=np.float64)
    if np.any(np.abs(cells) >= 1.0):
        worst = float(np.max(np.abs(cells)))
        raise ValueError(f"shift = {worst!r} cells must stay below 1, where no coherence is left")
    return np.asarray(np.sinc(cells))
