"""Phases by the true paths between satellites and ground, and what a processor expects of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import ErrorBudget
from ..radar import Radar
from ..scale import Scale
from ..terrain.view import TerrainView, place

Array = NDArray[np.float64]


def path_phase(target: Array, positions: Array, *, radar: Radar) -> Array:
    """Phases of the paths transmitter, ground, receiver.

    Parameters
    ----------
    target : (P, 3) — places on the ground, RTN [m].
    positions : (P, N, 3) — of the satellites, RTN [m].
    radar : the radar and its images.

    Returns
    -------
    (P, M) — −2π/λ times the path, relative to the first image [rad]; not wrapped.
    """
    distance = np.linalg.norm(target[:, None] - positions, axis=-1)
    path = distance @ radar.incidence_matrix.T
    return np.asarray(-2.0 * np.pi / radar.wavelength * (path - path[:, :1]))


def at_range(
    view: TerrainView, height: Array, slant_range: Array, *, azimuth_error: float = 0.0
) -> Array:
    """Where a point of this height and range lies in the plane of zero Doppler.

    Parameters
    ----------
    view : orbit, sphere and side.
    height : (P,) — above the sphere [m].
    slant_range : (P,) — from the reference orbit [m].
    azimuth_error : scalar — of the direction along track in which it is assumed [rad].

    Returns
    -------
    (P, 3) — RTN [m]; NaN where no such point exists.
    """
    orbit, radius = view.orbit_radius, view.earth_radius + height
    cosine = (orbit**2 + radius**2 - slant_range**2) / (2.0 * orbit * radius)
    with np.errstate(invalid="ignore"):
        angle = np.arccos(cosine)
    found = place(angle, radius, orbit_radius=orbit, side=view.side)
    found[:, 1] += azimuth_error * slant_range
    return found


class SceneErrors(NamedTuple):
    """What is wrong in one acquisition, the same over the scene.

    Attributes
    ----------
    position : (N, 3) — of where the satellites are thought to be, RTN [m].
    azimuth : scalar — of the direction along track [rad].
    slant_range : scalar [m].
    synchronization : (M,) — phase of each image [rad].
    """

    position: Array
    azimuth: float
    slant_range: float
    synchronization: Array


def draw_scene_errors(
    errors: ErrorBudget, *, radar: Radar, rng: np.random.Generator
) -> SceneErrors:
    """Draw the errors of an acquisition.

    Parameters
    ----------
    errors : a natural budget; errors of scale pixel are taken for errors of the scene.
    radar : the radar and its images.
    rng : source of random numbers.
    """
    bistatic = np.array([float(tx != rx) for tx, rx in radar.images])
    return SceneErrors(
        position=errors.position.std * rng.standard_normal((radar.satellite_count, 3)),
        azimuth=errors.azimuth.std * float(rng.standard_normal()),
        slant_range=errors.range.std * float(rng.standard_normal()),
        synchronization=errors.synchronization.std * bistatic * rng.standard_normal(len(bistatic)),
    )


def unsupported_scales(errors: ErrorBudget) -> tuple[str, ...]:
    """Errors that are random from pixel to pixel, which a scene of terrain does not draw."""
    names = ("position", "azimuth", "range", "synchronization")
    return tuple(
        name
        for name in names
        if getattr(errors, name).std > 0.0 and getattr(errors, name).scale is Scale.PIXEL
    )
