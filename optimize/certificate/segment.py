"""What a segment of a scene can tell at best: bounds over boxes of projected baselines.

In one segment, height error and unwrapping depend on the formation only through the coordinates
t_i = (Pᵀe_h)·v_i of its satellites along the height direction, up to a common shift, once the
azimuth error, which can only hurt, is left out. Satellites sorted by t leave N − 1 gaps; a *box* is
an interval for each gap. All bounds are optimistic: no formation of the box is better.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import ErrorBudget, Radar

from .information import InformationBound
from .ladders import CycleBound
from .parted import BoxInformation
from .shared import shared_factor

Array = NDArray[np.float64]


class Boxes(NamedTuple):
    """Boxes of gaps between neighboring satellites, in parts of the largest coordinate.

    Attributes
    ----------
    lower, upper : (n, N − 1) — bounds of the gaps; at most 2, the gap of opposite ends.
    """

    lower: Array
    upper: Array


class BoxBounds(NamedTuple):
    """Optimistic bounds over boxes, in each of the cases into which a formation may fall.

    Attributes
    ----------
    squared_error : (n, cases) — no formation of the box has a smaller squared height error [m²].
    failure : (n, cases) — nor a smaller probability that a cycle is wrong; zero without a prior
        height.
    """

    squared_error: Array
    failure: Array

    def within(self, failure: float) -> Array:
        """Smallest squared error of a box that may keep a limit on the failure; `inf` if none.

        Parameters
        ----------
        failure : scalar — the limit.

        Returns
        -------
        (n,)
        """
        possible = self.failure <= failure
        return np.asarray(np.where(possible, self.squared_error, np.inf).min(axis=-1))


@dataclass(frozen=True, kw_only=True, eq=False)
class SegmentModel:
    """One segment, or several of which it takes the most favorable of every property.

    Parameters
    ----------
    radar, errors : what the phases tell.
    order : satellites by increasing coordinate.
    wavenumbers : (least, largest) — vertical wavenumber at the largest coordinate of a satellite,
        over the segments that the model stands for [rad/m].
    shifts : (least, largest) — band offset at that coordinate [bandwidths].
    amplitude : scalar — the largest γ_i of an image.
    alike : whether all images have that amplitude.
    range_variance : scalar — squared height error that no formation changes, the smallest [m²].
    prior_height_std : scalar — None where nothing need be unwrapped [m].
    """

    radar: Radar
    errors: ErrorBudget
    order: tuple[int, ...]
    wavenumbers: tuple[float, float]
    shifts: tuple[float, float]
    amplitude: float
    alike: bool
    range_variance: float
    prior_height_std: float | None

    def bounds(self, boxes: Boxes) -> BoxBounds:
        """Bound height error and failure over boxes.

        Parameters
        ----------
        boxes : the boxes.
        """
        cases = self._information.upper(self.shifts[0] * boxes.lower, self.shifts[1] * boxes.upper)
        bounds = [self._case(case, boxes) for case in cases]
        return BoxBounds(*(np.stack(values, axis=-1) for values in zip(*bounds, strict=True)))

    def _case(self, case: BoxInformation, boxes: Boxes) -> tuple[Array, Array]:
        """Squared error and failure of one case of the azimuth bands, (n,) each."""
        with np.errstate(divide="ignore"):
            squared = 1.0 / self._height_information(case, boxes) + self.range_variance
        if self._cycles is None:
            return squared, np.zeros_like(squared)
        lower, upper = self.wavenumbers[0] * boxes.lower, self.wavenumbers[1] * boxes.upper
        return squared, self._cycles.failure(case.ceiling(), lower, upper)

    def _height_information(self, case: BoxInformation, boxes: Boxes) -> Array:
        """Largest J = kzᵀ(X⁻¹ + C)⁻¹kz over each box: convex in the gaps, so taken at a corner.

        J is the smallest yᵀXy + zᵀC⁻¹z of all y + z = kz, so that the y of one X bounds the J of
        all others, linearly in X.
        """
        half = 0.5 * (boxes.upper - boxes.lower)
        middle = 0.5 * (boxes.upper + boxes.lower)
        corners = middle[:, None, :] + half[:, None, :] * self._corners
        kz = self.wavenumbers[1] * corners @ self.gap_matrix[1:].T
        noise = case.whole @ self._shared
        index = np.arange(noise.shape[-1])
        noise[:, index, index] += 1.0
        # (X⁻¹ + C)⁻¹ = (I + XC)⁻¹X, where X may be singular.
        weight = np.asarray(np.linalg.solve(noise, case.whole), dtype=np.float64)
        pull = kz @ weight  # C⁻¹z = (X⁻¹ + C)⁻¹kz, symmetric
        value = np.sum(pull * kz, axis=-1)
        if case.parted.shape[1]:
            split = kz - pull @ self._shared
            whole = np.einsum("nvi,nij,nvj->nv", split, case.whole, split)
            parted = np.einsum("nvi,npij,nvj->nvp", split, case.parted, split).max(axis=-1)
            loss = whole - parted
            value = value - np.minimum(case.shares[0] * loss, case.shares[1] * loss)
        return np.asarray(np.maximum(value.max(axis=-1), 0.0))

    @cached_property
    def gap_matrix(self) -> Array:
        """Phase centers of the images relative to the first, per gap: (M, N − 1)."""
        return gap_matrix(self.radar, self.order)

    @cached_property
    def _corners(self) -> Array:
        count = len(self.order) - 1
        return np.array(np.meshgrid(*[[-1.0, 1.0]] * count)).reshape(count, -1).T

    @cached_property
    def _shared(self) -> Array:
        """Covariance of the shared errors, relative to the first image: (M − 1, M − 1) [rad²]."""
        factor = shared_factor(self.radar, self.errors)
        relative = (factor - factor[:1])[1:]
        return np.asarray(relative @ relative.T)

    @cached_property
    def _information(self) -> InformationBound:
        return InformationBound(
            radar=self.radar,
            errors=self.errors,
            amplitude=self.amplitude,
            alike=self.alike,
            offsets=self.gap_matrix,
        )

    @cached_property
    def _cycles(self) -> CycleBound | None:
        if self.prior_height_std is None:
            return None
        return CycleBound(
            shared=self._shared,
            phase_centers=self.gap_matrix[1:],
            prior_height_std=self.prior_height_std,
        )


def gap_matrix(radar: Radar, order: tuple[int, ...]) -> Array:
    """Phase centers of the images relative to the first, for satellites in a given order.

    Parameters
    ----------
    radar : for its images.
    order : satellites by increasing coordinate; of those left out no phase difference depends.

    Returns
    -------
    (M, N − 1) — per gap between neighbors.
    """
    above = np.zeros((radar.satellite_count, len(order) - 1))
    for rank, satellite in enumerate(order):
        above[satellite, :rank] = 1.0
    centers = radar.incidence_matrix @ above
    return np.asarray(centers - centers[0])
