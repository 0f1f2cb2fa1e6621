"""What the atmosphere does to heights: the parts of its delay that a pair of images differs by.

The rays of two images meet at the target and part by an angle B⊥/r, so the same layer delays them
by different amounts. In a single pass that difference is all that is left of the atmosphere; in
repeat passes the delay itself changes, which is another and a far larger error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.constants import speed_of_light

from .scale import Scale

Array = NDArray[np.float64]

IONOSPHERIC_CONSTANT = 40.308
"""Delay of a group (advance of a phase) by free electrons: 40.308·TEC/f² [m³/s²]."""

TEC_UNIT = 1e16
"""One TEC unit, in electrons/m²."""

_EARTH_RADIUS = 6_371_000.0
"""Of the sphere above which the ionosphere is a thin shell [m]."""


@dataclass(frozen=True, kw_only=True)
class Ionosphere:
    """What is not known of the ionosphere, as a thin shell.

    Parameters
    ----------
    electrons : scalar — standard deviation of the vertical electron content, or all of it where
        nothing is corrected [1/m²].
    gradient : scalar — standard deviation of its horizontal gradient across track [1/m³].
    shell_height : scalar — of the shell above the ground [m].
    scale : how far the errors stay the same.

    Raises
    ------
    ValueError
        If a number is negative or not finite.
    """

    electrons: float
    gradient: float = 0.0
    shell_height: float = 350e3
    scale: Scale = Scale.DATA_TAKE

    def __post_init__(self) -> None:
        for name in ("electrons", "gradient", "shell_height"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and not negative")


def tropospheric_height_error(zenith_delay: ArrayLike, *, incidence: ArrayLike) -> Array:
    """Height bias by a tropospheric delay that a single pass does not correct.

    Parameters
    ----------
    zenith_delay : (...) — one-way delay of a vertical ray, or what a correction leaves of it [m].
    incidence : (...) — incidence at the target, from the vertical [rad].

    Returns
    -------
    (...) — h = Z tan²θ_inc, whatever the baseline [m]; positive for an uncorrected delay.

    Notes
    -----
    A ray at incidence θ is delayed by Z/cosθ. The two rays differ by δθ = B⊥/r, their paths by
    Z tanθ δθ/cosθ, and a path difference δ stands for a height r sinθ δ/B⊥: the baseline and the
    range cancel. With the repeated counting of monostatic pairs (m = 2) both double, and the
    result stays. A horizontally stratified atmosphere; turbulence between rays that part by some
    tens of centimeters at its height is far smaller and not counted.

    Examples
    --------
    2.4 m of delay at 30° and 45°:

    >>> print(tropospheric_height_error(2.4, incidence=np.deg2rad([30.0, 45.0])).round(2))
    [0.8 2.4]
    """
    return np.asarray(np.asarray(zenith_delay, dtype=np.float64) * np.tan(incidence) ** 2)


def ionospheric_path(electrons: ArrayLike, *, wavelength: float) -> Array:
    """Path by which free electrons advance a phase, and delay a pulse, one way and vertically.

    Parameters
    ----------
    electrons : (...) — electron content of the column [1/m²].
    wavelength : scalar — of the carrier [m].

    Returns
    -------
    (...) — 40.308·TEC/f², first order in 1/f² [m].

    Examples
    --------
    10 TEC units in X, C and L band:

    >>> for wavelength in (0.031, 0.0555, 0.2384):
    ...     print(ionospheric_path(10 * TEC_UNIT, wavelength=wavelength).round(3))
    0.043
    0.138
    2.549
    """
    frequency = speed_of_light / wavelength
    content = np.asarray(electrons, dtype=np.float64)
    return np.asarray(IONOSPHERIC_CONSTANT * content / frequency**2)


def ionospheric_height_error(
    electrons: ArrayLike,
    *,
    wavelength: float,
    incidence: ArrayLike,
    shell_height: float = 350e3,
) -> Array:
    """Height bias by a uniform ionosphere, in a single pass.

    Parameters
    ----------
    electrons : (...) — vertical electron content, or what a correction leaves of it [1/m²].
    wavelength : scalar — of the carrier [m].
    incidence : (...) — incidence at the target [rad].
    shell_height : scalar — of the thin shell above the ground [m].

    Returns
    -------
    (...) — signed [m]: negative, since a phase is advanced where the troposphere delays it.

    Notes
    -----
    What both images have in common, the delay itself, drops out of the interferogram; it moves
    the target in range in all of them alike and belongs to the range error. The rays pierce the
    shell at an angle θ_p from its vertical, sinθ_p = sinθ_inc·R/(R + h), so that
    dθ_p = (tanθ_p/tanθ_inc)(B⊥/r), and the rest is as in `tropospheric_height_error`:
    h = −Z tan²θ_p cosθ_inc/cosθ_p, which is −Z tan²θ_inc for a low layer. Electrons above the
    satellites are not passed: give the content below them.
    """
    path = ionospheric_path(electrons, wavelength=wavelength)
    angle = np.asarray(incidence, dtype=np.float64)
    pierce = _pierce_angle(angle, shell_height)
    return np.asarray(-path * np.tan(pierce) ** 2 * np.cos(angle) / np.cos(pierce))


def ionospheric_gradient_height_error(
    gradient: ArrayLike,
    *,
    wavelength: float,
    incidence: ArrayLike,
    shell_height: float = 350e3,
) -> Array:
    """Height bias by a horizontal gradient of the electron content across track, single pass.

    Parameters
    ----------
    gradient : (...) — of the vertical electron content, positive away from the radar's nadir
        [1/m³].
    wavelength : scalar — of the carrier [m].
    incidence : (...) — incidence at the target [rad].
    shell_height : scalar — of the thin shell above the ground [m].

    Returns
    -------
    (...) — signed [m]; on a flat Earth Z′h tanθ/cos²θ, whatever the baseline.

    Notes
    -----
    The pierce point lies at the central angle θ_inc − θ_p from the target, on the radar's side.
    A ray of larger incidence has it farther away, by (R + h)(1 − dθ_p/dθ_inc) for each radian, and
    meets fewer electrons there if they become more away from nadir. A gradient along track acts
    through the azimuth baseline and depends on the formation: it is not counted.
    """
    slope = ionospheric_path(gradient, wavelength=wavelength)
    angle = np.asarray(incidence, dtype=np.float64)
    pierce = _pierce_angle(angle, shell_height)
    turned = np.tan(pierce) / np.tan(angle)
    shift = (_EARTH_RADIUS + shell_height) * (1.0 - turned)
    return np.asarray(slope * shift * np.sin(angle) / np.cos(pierce))


def repeat_pass_path_std(zenith_std: ArrayLike, *, incidence: ArrayLike) -> Array:
    """Path error of one monostatic image of a repeat pass, by the delay of its day.

    Parameters
    ----------
    zenith_std : (...) — standard deviation of the zenith delay of an image [m].
    incidence : (...) — incidence at the target, or at the shell for the ionosphere [rad].

    Returns
    -------
    (...) — 2 Z/cosθ, both ways [m]. Unlike in a single pass it does not scale with the baseline:
    as a height it is HoA/λ times √2 of this for a pair, 46 m for 1 cm at HoA 50 m and 31 mm.
    """
    return np.asarray(2.0 * np.asarray(zenith_std, dtype=np.float64) / np.cos(incidence))


def _pierce_angle(incidence: Array, shell_height: float) -> Array:
    ratio = _EARTH_RADIUS / (_EARTH_RADIUS + shell_height)
    return np.asarray(np.arcsin(ratio * np.sin(incidence)))
