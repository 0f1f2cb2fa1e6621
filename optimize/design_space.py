"""The design variables: a radial offset and rate (z0, ż0) for each satellite."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from formation import CircularFamily

Array = NDArray[np.float64]


class DesignVariables(NamedTuple):
    """A decoded design.

    Attributes
    ----------
    z0 : (..., N) — radial offsets at t = 0 [m].
    zdot0 : (..., N) — radial rates at t = 0 [m/s].
    sign : (...) — sign of the cross-track motion, ±1.
    """

    z0: Array
    zdot0: Array
    sign: Array


@dataclass(frozen=True, kw_only=True)
class DesignSpace:
    """The box in which formations of one family are searched.

    A design is the vector (z1, ż1, z2, ż2, …) of Li 2009 eq. (13); where both cross-track signs
    are allowed, one more variable within ±1 carries the sign.

    Parameters
    ----------
    names : name of each satellite.
    family : generator of the relative orbits, such as `formation.space_circular`.
    mean_motion : scalar — angular rate of the reference orbit [rad/s].
    max_offset : scalar — bound of |z0| [m].
    max_rate : scalar — bound of |ż0| [m/s].
    signs : allowed signs of the cross-track motion, of +1 and −1; the search chooses.

    Raises
    ------
    ValueError
        If a bound is not a positive number, or there is no satellite or sign.
    """

    names: tuple[str, ...]
    family: CircularFamily
    mean_motion: float
    max_offset: float
    max_rate: float
    signs: tuple[int, ...] = (1,)

    def __post_init__(self) -> None:
        for name in ("mean_motion", "max_offset", "max_rate"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be a finite positive number")
        if not self.names:
            raise ValueError("names is empty: a formation needs satellites")
        if not self.signs or not set(self.signs) <= {1, -1}:
            raise ValueError(f"signs = {self.signs!r} must hold +1, -1 or both")

    @property
    def satellites(self) -> int:
        """Number N of satellites."""
        return len(self.names)

    @property
    def dimension(self) -> int:
        """Number D of design variables."""
        return 2 * self.satellites + (len(set(self.signs)) > 1)

    @property
    def upper(self) -> Array:
        """Upper bounds, (D,); the lower bounds are their negatives."""
        bounds = np.tile([self.max_offset, self.max_rate], self.satellites)
        return np.append(bounds, 1.0) if self.dimension > bounds.size else bounds

    def encode(self, z0: ArrayLike, zdot0: ArrayLike, sign: ArrayLike | None = None) -> Array:
        """Design vectors of given offsets and rates; the inverse of `decode`.

        Parameters
        ----------
        z0, zdot0 : (..., N) — radial offsets [m] and rates [m/s].
        sign : (...) — ±1; ignored where only one is allowed.

        Returns
        -------
        (..., D) — design vectors.
        """
        pairs = np.stack(
            [np.asarray(z0, dtype=np.float64), np.asarray(zdot0, dtype=np.float64)], axis=-1
        )
        vector = pairs.reshape(*pairs.shape[:-2], 2 * self.satellites)
        if self.dimension == vector.shape[-1]:
            return vector
        signs = np.broadcast_to(self.signs[0] if sign is None else sign, vector.shape[:-1])
        return np.concatenate([vector, np.asarray(signs, dtype=np.float64)[..., None]], axis=-1)

    def decode(self, designs: ArrayLike) -> DesignVariables:
        """Offsets, rates and sign of design vectors.

        Parameters
        ----------
        designs : (..., D) — design vectors.

        Raises
        ------
        ValueError
            If the last axis is not D long.
        """
        vector = np.asarray(designs, dtype=np.float64)
        if vector.shape[-1:] != (self.dimension,):
            raise ValueError(f"designs has shape {vector.shape}; it must end in {self.dimension}")
        pairs = vector[..., : 2 * self.satellites].reshape(*vector.shape[:-1], self.satellites, 2)
        if self.dimension > 2 * self.satellites:
            sign = np.where(vector[..., -1] < 0.0, -1.0, 1.0)
        else:
            sign = np.full(vector.shape[:-1], float(self.signs[0]))
        return DesignVariables(pairs[..., 0], pairs[..., 1], sign)

    def states(self, designs: ArrayLike) -> Array:
        """RTN states at t = 0 of design vectors.

        Parameters
        ----------
        designs : (..., D) — design vectors.

        Returns
        -------
        (..., N, 6) — RTN states [m, m/s].
        """
        z0, zdot0, sign = self.decode(designs)
        return self.family(z0, zdot0, mean_motion=self.mean_motion, sign=sign[..., None])

    def mirrored(self, design: ArrayLike) -> Array | None:
        """A design with the other cross-track sign; None where only one is allowed.

        Parameters
        ----------
        design : (D,) — a design vector.
        """
        vector = np.array(design, dtype=np.float64)
        if self.dimension == 2 * self.satellites:
            return None
        vector[-1] = -1.0 if vector[-1] >= 0.0 else 1.0
        return vector

    def pretty(self, design: ArrayLike) -> str:
        """One design as text, a line for each satellite.

        Parameters
        ----------
        design : (D,) — a design vector.
        """
        z0, zdot0, sign = self.decode(design)
        lines = [
            f"{name}: z0 = {offset:+9.2f} m, ż0 = {rate:+8.4f} m/s"
            for name, offset, rate in zip(self.names, z0, zdot0, strict=True)
        ]
        return "\n".join([*lines, f"cross-track sign {int(sign):+d}"])
