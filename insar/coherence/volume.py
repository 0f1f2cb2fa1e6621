"""Coherence of scatterers that are spread in height: complex, and with it the height it reports.

With p(z) the power from height z, F(k) = ∫ p(z) e^{ikz} dz / ∫ p(z) dz. A pair with the vertical
wavenumber kz keeps |F(kz)| of its coherence, and its phase is that of the height arg F(kz)/kz: a
bias against the ground at z = 0. Only the complex factor is a coherence matrix, by Bochner's
theorem; of three images its modulus alone can lack a positive eigenvalue.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class Volume(Protocol):
    """A profile of backscattered power over the height."""

    def coherence(self, vertical_wavenumber: ArrayLike, *, incidence: ArrayLike) -> Complex:
        """F at vertical wavenumbers (...) [rad/m], seen at an incidence (...) [rad]."""
        ...


@dataclass(frozen=True, kw_only=True)
class UniformVolume:
    """Equal power from every height of a layer above the ground.

    Parameters
    ----------
    height : scalar — of the layer [m].

    Raises
    ------
    ValueError
        If the height is negative or not finite.

    References
    ----------
    Bamler and Hartl 1998, doi:10.1088/0266-5611/14/4/001.

    Examples
    --------
    20 m at a height of ambiguity of 80 m: the layer's middle is seen.

    >>> import numpy as np
    >>> kz = 2.0 * np.pi / 80.0
    >>> factor = UniformVolume(height=20.0).coherence(kz, incidence=0.5)
    >>> print(np.abs(factor).round(4), (np.angle(factor) / kz).round(3))
    0.9003 10.0
    """

    height: float

    def __post_init__(self) -> None:
        _check(self.height, "height")

    def coherence(self, vertical_wavenumber: ArrayLike, *, incidence: ArrayLike) -> Complex:
        """e^{ik h/2} sinc(kh/2π)."""
        turn = np.asarray(vertical_wavenumber, dtype=np.float64) * self.height
        turn = np.broadcast_arrays(turn, np.asarray(incidence))[0]
        return np.asarray(np.exp(0.5j * turn) * np.sinc(turn / (2.0 * np.pi)))


@dataclass(frozen=True, kw_only=True)
class AttenuatedVolume:
    """A layer above the ground that dims what lies below: a forest without its ground echo.

    Parameters
    ----------
    height : scalar — of the layer [m].
    extinction : scalar — of the wave's power, one way along the ray [1/m]: a dB/m is 0.2303/m.

    Raises
    ------
    ValueError
        If a number is negative or not finite.

    References
    ----------
    Papathanassiou and Cloude 2001, doi:10.1109/36.964971, without the ground.
    """

    height: float
    extinction: float

    def __post_init__(self) -> None:
        _check(self.height, "height")
        _check(self.extinction, "extinction")

    def coherence(self, vertical_wavenumber: ArrayLike, *, incidence: ArrayLike) -> Complex:
        """∫₀ʰ e^{(a + ik)z} dz / ∫₀ʰ e^{az} dz with a = 2σ/cos θ_inc."""
        kz = np.asarray(vertical_wavenumber, dtype=np.float64)
        rise = 2.0 * self.extinction / np.cos(np.asarray(incidence, dtype=np.float64))
        # From the top down, so that a dense layer does not overflow.
        seen = _mean_exponential((rise + 1j * kz) * self.height)
        seen = seen / _mean_exponential(rise * self.height)
        return np.asarray(np.exp(1j * kz * self.height) * seen)


@dataclass(frozen=True, kw_only=True)
class PenetratedVolume:
    """A surface at z = 0 that the wave enters: dry snow, ice, sand.

    Parameters
    ----------
    depth : scalar — vertical depth over which the power that returns falls to 1/e, two ways [m].

    Raises
    ------
    ValueError
        If the depth is negative or not finite.

    References
    ----------
    Dall 2007, IEEE Trans. Geosci. Remote Sens. 45(7), 2319–2324: for small kz the surface seems
    to lie the depth d lower.
    """

    depth: float

    def __post_init__(self) -> None:
        _check(self.depth, "depth")

    def coherence(self, vertical_wavenumber: ArrayLike, *, incidence: ArrayLike) -> Complex:
        """1/(1 + ikd)."""
        turn = np.asarray(vertical_wavenumber, dtype=np.float64) * self.depth
        turn = np.broadcast_arrays(turn, np.asarray(incidence))[0]
        return np.asarray(1.0 / (1.0 + 1j * turn))


@dataclass(frozen=True, kw_only=True)
class ProfileVolume:
    """Power at heights of your own: a measured profile, or a layer over a ground that shines.

    Parameters
    ----------
    heights : where scatterers are, above the ground [m].
    powers : what each returns, on any scale.

    Raises
    ------
    ValueError
        If the two differ in length, a power is negative, or all are zero.
    """

    heights: tuple[float, ...]
    powers: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.heights) != len(self.powers):
            raise ValueError(
                f"heights and powers hold {len(self.heights)} and {len(self.powers)} numbers; "
                "each height needs one power"
            )
        for power in self.powers:
            _check(power, "powers")
        if not all(math.isfinite(height) for height in self.heights):
            raise ValueError(f"heights = {self.heights!r} must be finite")
        if not sum(self.powers) > 0.0:
            raise ValueError("powers must not all be zero")

    def coherence(self, vertical_wavenumber: ArrayLike, *, incidence: ArrayLike) -> Complex:
        """Σ p e^{ikz}/Σ p."""
        kz = np.asarray(vertical_wavenumber, dtype=np.float64)
        kz = np.broadcast_arrays(kz, np.asarray(incidence))[0]
        share = np.asarray(self.powers) / sum(self.powers)
        return np.asarray(np.exp(1j * kz[..., None] * np.asarray(self.heights)) @ share)


def volume_bias(factor: ArrayLike, vertical_wavenumber: ArrayLike) -> Array:
    """Height that a pair reports of a volume, above its ground.

    Parameters
    ----------
    factor : (...) — complex coherence of the volume.
    vertical_wavenumber : (...) — kz of the pair [rad/m].

    Returns
    -------
    (...) — arg F/kz, within half a height of ambiguity; the mean height where kz vanishes is not
    told and given as 0 [m].
    """
    kz = np.asarray(vertical_wavenumber, dtype=np.float64)
    phase = np.angle(np.asarray(factor))
    return np.asarray(np.where(kz == 0.0, 0.0, phase / np.where(kz == 0.0, 1.0, kz)))


def _mean_exponential(argument: ArrayLike) -> Complex:
    """(1 − e^{−x})/x: the mean of e^{−xt} over 0 to 1."""
    exponent = np.asarray(argument, dtype=np.complex128)
    small = np.abs(exponent) < 1e-4
    safe = np.where(small, 1.0, exponent)
    series = 1.0 - exponent / 2.0 + exponent**2 / 6.0
    return np.asarray(np.where(small, series, -np.expm1(-safe) / safe))


def _check(value: float, name: str) -> None:
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"{name} = {value!r} must be finite and not negative")
