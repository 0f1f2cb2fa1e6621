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
    """Optimistic bounds over boxes.

    Attributes
    ----------
    squared_error : (n,) — no formation of the box has a smaller squared height error [m²].
    failure : (n,) — nor a smaller probability that a cycle is wrong; zero without a prior height.
    """

    squared_error: Array
    failure: Array


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
        information = self._information.upper(
            self.shifts[0] * boxes.lower, self.shifts[1] * boxes.upper
        )
        noise = information @ self._shared
        index = np.arange(information.shape[-1])
        noise[:, index, index] += 1.0
        # (X⁻¹ + C)⁻¹ = (I + XC)⁻¹X, where X may be singular.
        weight = np.asarray(np.linalg.solve(noise, information), dtype=np.float64)
        best = self._height_information(weight, boxes)
        with np.errstate(divide="ignore"):
            squared = 1.0 / best + self.range_variance
        failure = np.zeros_like(squared)
        if self._cycles is not None:
            failure = self._cycles.failure(
                information, self.wavenumbers[0] * boxes.lower, self.wavenumbers[1] * boxes.upper
            )
        return BoxBounds(squared, failure)

    def _height_information(self, weight: Array, boxes: Boxes) -> Array:
        """Largest kzᵀ·weight·kz over each box: convex in the gaps, so taken at a corner."""
        half = 0.5 * (boxes.upper - boxes.lower)
        middle = 0.5 * (boxes.upper + boxes.lower)
        corners = middle[:, None, :] + half[:, None, :] * self._corners
        kz = self.wavenumbers[1] * corners @ self.gap_matrix[1:].T
        values: Array = np.einsum("nvi,nij,nvj->nv", kz, weight, kz).max(axis=-1)
        return np.maximum(values, 0.0)

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
