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


class PlaneBoxes(NamedTuple):
    """Boxes of differences between neighboring satellites in the plane (z0, ż0/n).

    Attributes
    ----------
    lower, upper : (n, 2(N − 1)) — bounds, along one direction and then across it.
    height : (2,) — what the height direction sees of each.
    azimuth : (2,) — what the azimuth direction sees, as the phase that it costs [rad].
    """

    lower: Array
    upper: Array
    height: Array
    azimuth: Array


class Boxes(NamedTuple):
    """Boxes of gaps between neighboring satellites, in parts of the largest coordinate.

    Attributes
    ----------
    lower, upper : (n, N − 1) — bounds of the gaps; at most 2, the gap of opposite ends.
    plane : the boxes in the plane that have these gaps, where the azimuth error counts.
    """

    lower: Array
    upper: Array
    plane: PlaneBoxes | None = None

    def some(self, which: NDArray[np.intp]) -> Boxes:
        """Some of the boxes.

        Parameters
        ----------
        which : (m,) — indices.
        """
        plane = self.plane
        if plane is not None:
            plane = plane._replace(lower=plane.lower[which], upper=plane.upper[which])
        return Boxes(self.lower[which], self.upper[which], plane)


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

    Notes
    -----
    Where least and largest are the same, gaps may be negative too: sorted along the direction of
    another segment.
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
        cases = [(self._squared_error(case, boxes), case) for case in self._cases(boxes)]
        failure = [self._failure(case, boxes) for _, case in cases]
        return BoxBounds(np.stack([one for one, _ in cases], -1), np.stack(failure, -1))

    def feasible_error(self, boxes: Boxes, *, failure: float, enough: Array | float) -> Array:
        """Smallest squared error of a box that may keep a limit on the failure.

        Parameters
        ----------
        boxes : the boxes.
        failure : scalar — the limit.
        enough : scalar or (n,) — squared error above which a box need not be feasible to get its
            bound.

        Returns
        -------
        (n,) — `inf` where the limit is missed for sure.
        """
        smallest = np.full(len(boxes.lower), np.inf)
        for case in self._cases(boxes):
            squared = self._squared_error(case, boxes)
            # Most boxes are dropped for their error, and the failure is the costlier of the two.
            asked = np.flatnonzero(squared < enough)
            some = BoxInformation(case.whole[asked], case.parted[asked], case.shares)
            wrong = self._failure(some, boxes.some(asked))
            squared[asked[wrong > failure]] = np.inf
            smallest = np.minimum(smallest, squared)
        return smallest

    def _cases(self, boxes: Boxes) -> tuple[BoxInformation, ...]:
        return self._information.upper(self.shifts[0] * boxes.lower, self.shifts[1] * boxes.upper)

    def _squared_error(self, case: BoxInformation, boxes: Boxes) -> Array:
        with np.errstate(divide="ignore"):
            return 1.0 / self._height_information(case, boxes) + self.range_variance

    def _failure(self, case: BoxInformation, boxes: Boxes) -> Array:
        if self._cycles is None:
            return np.zeros(len(boxes.lower))
        lower, upper = self.wavenumbers[0] * boxes.lower, self.wavenumbers[1] * boxes.upper
        return self._cycles.failure(case.ceiling(), lower, upper)

    def _height_information(self, case: BoxInformation, boxes: Boxes) -> Array:
        """Largest J = kzᵀ(X⁻¹ + C)⁻¹kz over each box: convex in the gaps, so taken at a corner.

        J is the smallest yᵀXy + zᵀC⁻¹z of all y + z = kz, so that the y of one X bounds the J of
        all others, linearly in X.
        """
        noise = case.whole @ self._shared
        index = np.arange(noise.shape[-1])
        noise[:, index, index] += 1.0
        # (X⁻¹ + C)⁻¹ = (I + XC)⁻¹X, where X may be singular.
        weight = np.asarray(np.linalg.solve(noise, case.whole), dtype=np.float64)
        kz, turned, share = self._corner_wavenumbers(boxes, weight)
        value = self._largest_at(case, weight, kz)
        if turned is not None:
            less = kz - share[:, None, None] * turned
            value = np.minimum(value, self._largest_at(case, weight, less) + share**2)
        return np.maximum(value, 0.0)

    def _largest_at(self, case: BoxInformation, weight: Array, kz: Array) -> Array:
        """Largest J of all X of a case, and of n boxes with corners kz, (n,)."""
        pull = kz @ weight  # C⁻¹z = (X⁻¹ + C)⁻¹kz, symmetric
        value = np.sum(pull * kz, axis=-1)
        if case.parted.shape[1]:
            split = kz - pull @ self._shared
            whole = np.einsum("nvi,nij,nvj->nv", split, case.whole, split)
            parted = np.einsum("nvi,npij,nvj->nvp", split, case.parted, split).max(axis=-1)
            loss = whole - parted
            value = value - np.minimum(case.shares[0] * loss, case.shares[1] * loss)
        return np.asarray(value.max(axis=-1))

    def _corner_wavenumbers(self, boxes: Boxes, weight: Array) -> tuple[Array, Array | None, Array]:
        """Wavenumbers kz and phases k_a of a unit azimuth error at corners, and a share of k_a.

        J = min_m J₀(kz − m k_a) + m² with the error: every m bounds it, convex in kz and k_a. The
        share is the m of the middle of a box.
        """
        if boxes.plane is None:
            corners = _corners(boxes.lower, boxes.upper)
            kz = self.wavenumbers[1] * corners @ self.gap_matrix[1:].T
            return kz, None, np.zeros(len(kz))
        plane = boxes.plane
        corners = _corners(plane.lower, plane.upper)
        corners = np.concatenate([corners, 0.5 * (plane.lower + plane.upper)[:, None]], axis=1)
        corners = corners.reshape(*corners.shape[:2], 2, -1)
        of_image = corners @ self.gap_matrix[1:].T
        kz = self.wavenumbers[1] * np.einsum("nvcm,c->nvm", of_image, plane.height)
        turned = np.einsum("nvcm,c->nvm", of_image, plane.azimuth)
        pull = np.einsum("ni,nij->nj", turned[:, -1], weight)
        share = np.sum(pull * kz[:, -1], axis=-1) / (1.0 + np.sum(pull * turned[:, -1], axis=-1))
        return kz[:, :-1], turned[:, :-1], share

    @cached_property
    def gap_matrix(self) -> Array:
        """Phase centers of the images relative to the first, per gap: (M, N − 1)."""
        return gap_matrix(self.radar, self.order)

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


def _corners(lower: Array, upper: Array) -> Array:
    """Corners of boxes (n, G): (n, 2^G, G)."""
    count = lower.shape[-1]
    signs = np.array(np.meshgrid(*[[-0.5, 0.5]] * count)).reshape(count, -1).T
    middle, width = 0.5 * (upper + lower), upper - lower
    return np.asarray(middle[:, None, :] + width[:, None, :] * signs)


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
