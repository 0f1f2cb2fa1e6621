"""Critical baseline, height of ambiguity and the projected baselines of every pair of images."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import HeldConstant
from .geometry import Sensitivity, constant_azimuth_sensitivity, constant_doppler_sensitivity
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]


def critical_baseline(
    *,
    wavelength: ArrayLike,
    slant_range: ArrayLike,
    incidence: ArrayLike,
    slant_range_resolution: ArrayLike,
    slope: ArrayLike = 0.0,
    multiplicity: ArrayLike = 1.0,
) -> Array:
    """Perpendicular baseline at which two images have no common range band left.

    Parameters
    ----------
    wavelength : (...) — carrier wavelength λ [m].
    slant_range : (...) — distance r to the target [m].
    incidence : (...) — incidence angle θ_inc at the target [rad].
    slant_range_resolution : (...) — resolution ρ_r across the line of sight [m].
    slope : (...) — terrain slope in range, positive towards the radar [rad].
    multiplicity : (...) — m: 1 where the pair shares its transmitter, 2 where both images are
        monostatic.

    Returns
    -------
    (...) — λ r tan(θ_inc − slope)/(m ρ_r) [m].

    References
    ----------
    Li 2009 section 4: 2422.5 m printed; its smallest over the segments of Table 2 is 2422.0 m.

    Examples
    --------
    >>> import numpy as np
    >>> float(critical_baseline(wavelength=0.031, slant_range=557.58e3,
    ...     incidence=np.deg2rad(22.80), slant_range_resolution=3.0).round(1))
    2422.0
    """
    local = np.asarray(incidence, dtype=np.float64) - np.asarray(slope, dtype=np.float64)
    resolution = np.asarray(slant_range_resolution, dtype=np.float64)
    critical: Array = (
        np.asarray(wavelength, dtype=np.float64)
        * np.asarray(slant_range, dtype=np.float64)
        * np.tan(local)
        / (np.asarray(multiplicity, dtype=np.float64) * resolution)
    )
    return critical


def scene_critical_baseline(scene: Scene, radar: Radar, *, multiplicity: float = 1.0) -> Array:
    """Critical baseline of each segment of a scene.

    Parameters
    ----------
    scene : the S segments.
    radar : the radar.
    multiplicity : scalar — m of the pair, as in `critical_baseline`.

    Returns
    -------
    (S,) — critical baselines [m].
    """
    return critical_baseline(
        wavelength=radar.wavelength,
        slant_range=scene.slant_range,
        incidence=scene.incidence,
        slant_range_resolution=radar.slant_range_resolution,
        slope=scene.slope,
        multiplicity=multiplicity,
    )


def pair_critical_baseline(scene: Scene, radar: Radar) -> Array:
    """Critical baseline of each pair of images in each segment.

    Parameters
    ----------
    scene : the S segments.
    radar : the radar, whose `image_pairs` order the K pairs.

    Returns
    -------
    (S, K) — halved for a pair of monostatic images [m].
    """
    return scene_critical_baseline(scene, radar)[:, None] / radar.pair_multiplicity


def height_of_ambiguity(
    perpendicular_baseline: ArrayLike,
    *,
    wavelength: ArrayLike,
    slant_range: ArrayLike,
    incidence: ArrayLike,
    multiplicity: ArrayLike = 1.0,
) -> Array:
    """Height difference that turns the interferometric phase once, at broadside.

    Parameters
    ----------
    perpendicular_baseline : (...) — B⊥, signed or not [m].
    wavelength, slant_range, incidence, multiplicity : (...) — as in `critical_baseline`.

    Returns
    -------
    (...) — λ r sin θ_inc/(m |B⊥|), positive, `inf` for a zero baseline [m].

    Examples
    --------
    TanDEM-X-like: 250 m at 35° incidence.

    >>> import numpy as np
    >>> float(height_of_ambiguity(250.0, wavelength=0.031066, slant_range=616.39e3,
    ...     incidence=np.deg2rad(35.0)).round(2))
    43.93
    """
    baseline = np.abs(np.asarray(perpendicular_baseline, dtype=np.float64))
    with np.errstate(divide="ignore"):
        height: Array = (
            np.asarray(wavelength, dtype=np.float64)
            * np.asarray(slant_range, dtype=np.float64)
            * np.sin(np.asarray(incidence, dtype=np.float64))
            / (np.asarray(multiplicity, dtype=np.float64) * baseline)
        )
    return height


@lru_cache(maxsize=16)  # a scene is immutable and hashes by identity
def sensitivity(scene: Scene, held_constant: HeldConstant) -> Sensitivity:
    """Sensitivity directions of each segment of a scene.

    Parameters
    ----------
    scene : the S segments.
    held_constant : what a target keeps while its height changes.

    Returns
    -------
    Sensitivity — of (S, 3), (S, 3) and (S,) arrays.

    Raises
    ------
    ValueError
        If a segment is seen along the ground track, where range and Doppler hold no height.
    """
    if held_constant is HeldConstant.AZIMUTH:
        return constant_azimuth_sensitivity(
            look_angle=scene.look_angle, azimuth=scene.azimuth, slant_range=scene.slant_range
        )
    result = constant_doppler_sensitivity(
        scene.line_of_sight,
        velocity_direction=scene.velocity_direction,
        vertical=scene.vertical,
        slant_range=scene.slant_range,
    )
    blind = result.height_lever < 1e-6 * scene.slant_range
    if np.any(blind):
        segment = int(np.argmax(blind))
        raise ValueError(
            f"segment {segment + 1} is seen along the ground track "
            f"(azimuth = {np.rad2deg(scene.azimuth[segment]):.6g}°): at constant range and Doppler "
            "its height cannot be sensed; look to the side"
        )
    return result


class PairGeometry(NamedTuple):
    """Baselines of every pair of images.

    Attributes
    ----------
    perpendicular_baseline : (..., S, K) — signed baseline along the height direction, between
        the satellites: not doubled for a monostatic pair. Of images that share neither their
        transmitter nor their kind, the difference of the phase centers p_tx + p_rx [m].
    azimuth_baseline : (..., S, K) — signed baseline along the azimuth direction, likewise [m].
    height_of_ambiguity : (..., S, K) — height that turns the phase once; `inf` at zero [m].
    """

    perpendicular_baseline: Array
    azimuth_baseline: Array
    height_of_ambiguity: Array


def pair_geometry(
    positions: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    held_constant: HeldConstant = HeldConstant.DOPPLER,
) -> PairGeometry:
    """Project the baselines of every pair of images on the sensitivity directions.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar, whose `image_pairs` order the K pairs.
    held_constant : what a target keeps while its height changes.

    Returns
    -------
    PairGeometry — of (..., S, K) arrays.
    """
    direction = sensitivity(scene, held_constant)
    phase_center = image_projections(positions, direction, radar=radar)
    first, second = radar.image_pairs.T
    effective = phase_center[..., second, :] - phase_center[..., first, :]
    with np.errstate(divide="ignore"):
        ambiguity = radar.wavelength * direction.height_lever[:, None] / np.abs(effective[..., 0])
    physical = effective / radar.pair_multiplicity[:, None]
    return PairGeometry(physical[..., 0], physical[..., 1], ambiguity)


def image_projections(positions: ArrayLike, direction: Sensitivity, *, radar: Radar) -> Array:
    """Project the phase centers p_tx + p_rx on the height and azimuth directions.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions [m].
    direction : the sensitivity of the S segments.
    radar : the radar, for its images.

    Returns
    -------
    (..., S, M, 2) — components along the height and the azimuth direction, relative to the first
    image [m].

    Raises
    ------
    ValueError
        If the shape does not fit the scene and the images.
    """
    position = np.asarray(positions, dtype=np.float64)
    segments, satellites = direction.height_lever.shape[0], radar.satellite_count
    if position.ndim < 3 or position.shape[-3:] != (segments, satellites, 3):
        raise ValueError(
            f"positions has shape {position.shape}; the scene has {segments} segments and the "
            f"radar's images use {satellites} satellites: "
            f"it must end in ({segments}, {satellites}, 3)"
        )
    # Differences first: they vanish exactly where satellites coincide.
    relative = position - position[..., :1, :]
    axes = np.stack([direction.height_direction, direction.azimuth_direction], axis=-1)
    projected = radar.incidence_matrix @ (relative @ axes)
    return np.asarray(projected - projected[..., :1, :], dtype=np.float64)
