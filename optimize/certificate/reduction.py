"""The convex reduction: where coherence is the same for every baseline, only the scatter counts.

With satellites alike the height information of a segment is

    J = (κ/K²)·[aᵀMa − q(aᵀMc)²/(1 + q cᵀMc)] = (κ/K²)·aᵀ(M⁻¹ + q ccᵀ)⁻¹a,   q = κs²,

M = Σ(v_i − v̄)(v_i − v̄)ᵀ the 2 × 2 scatter matrix of the points v = (z0, ż0/n), a = Pᵀe_h and
c = Pᵀe_a their projections, s the azimuth error. J is concave and increasing in M, so the squared
region error F(M) is convex and decreasing; all that is not convex sits in which M are attainable.
Decorrelation by the baseline and limits beyond radius and separation only take information or
designs away: with the most that phases can tell, every bound here holds for those models too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, PhaseStatistics, SharedBy, Weighting
from insar.coherence import image_amplitude
from insar.height import common_height_errors
from insar.phase_information import pair_phase_variance

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import plane_radius, projection
from .shared import pair_variance

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Reduction:
    """The squared region error as a convex function of the scatter matrix.

    Parameters
    ----------
    height, azimuth : (S, 2) — a and c, in parts of the disc [m].
    strength : (S,) — κ/K² [1/m⁴ times m², the disc scaled to 1].
    ratio : scalar — q for the scaled disc; zero leaves the azimuth error out.
    floor : scalar — squared error that no formation changes, mean over the segments [m²].
    count : number N of satellites.
    separation : scalar — smallest distance of two points, in parts of the disc.
    """

    height: Array
    azimuth: Array
    strength: Array
    ratio: float
    floor: float
    count: int
    separation: float

    @property
    def largest_scatter(self) -> float:
        """Largest eigenvalue that a scatter matrix can have: (N² − [N odd])/N.

        Σ(x_i − x̄)² is convex in each coordinate |x_i| ≤ 1, so all stand at an end, split evenly.
        """
        return (self.count**2 - self.count % 2) / self.count

    def squared_error(self, scatter: Array) -> float:
        """Squared region error of a scatter matrix.

        Parameters
        ----------
        scatter : (2, 2) — in parts of the disc squared.
        """
        information, _ = self._information(scatter)
        return float(np.mean(1.0 / information)) + self.floor

    def slope(self, scatter: Array) -> Array:
        """H = −∇F, positive semidefinite, (2, 2).

        Parameters
        ----------
        scatter : (2, 2) — in parts of the disc squared.
        """
        information, direction = self._information(scatter)
        weight = self.strength / information**2 / len(information)
        return np.asarray(np.einsum("s,si,sj->ij", weight, direction, direction))

    def _information(self, scatter: Array) -> tuple[Array, Array]:
        moved = self.azimuth @ scatter
        share = self.ratio * np.sum(moved * self.height, axis=-1)
        share /= 1.0 + self.ratio * np.sum(moved * self.azimuth, axis=-1)
        direction = self.height - share[:, None] * self.azimuth  # (I + q c cᵀM)⁻¹a
        information = self.strength * np.sum((direction @ scatter) * self.height, axis=-1)
        return information, direction

    def closed_form(self) -> float:
        """Squared error that no formation beats: the largest scatter, all along each a."""
        best = self.strength * np.sum(self.height**2, axis=-1) * self.largest_scatter
        return float(np.mean(1.0 / best)) + self.floor

    def tangent_bound(self, scatter: Array, support: float | None = None) -> float:
        """Squared error that no formation beats, from the tangent of F at a scatter matrix.

        F(M) ≥ F(M₀) + ⟨H, M₀⟩ − ⟨H, M⟩ ≥ F(M₀) + ⟨H, M₀⟩ − h(H), h(H) = max ⟨H, M⟩.

        Parameters
        ----------
        scatter : (2, 2) — M₀, any positive definite matrix: a poor one only loosens the bound.
        support : scalar — h(H) over H's largest eigenvalue, from `scatter_support`; without it
            that of λ_max(M) ≤ `largest_scatter`, tr M ≤ N.
        """
        slope = self.slope(scatter)
        small, large = np.linalg.eigvalsh(slope)
        if support is None:
            most = (large - small) * self.largest_scatter + max(small, 0.0) * self.count
        else:
            most = large * support
        return float(self.squared_error(scatter) + np.sum(slope * scatter) - most)

    def flatness(self, scatter: Array) -> float:
        """Smaller over larger eigenvalue of H.

        Parameters
        ----------
        scatter : (2, 2) — in parts of the disc squared.
        """
        small, large = np.linalg.eigvalsh(self.slope(scatter))
        return float(max(small, 0.0) / large)


def scatter_of(points: Array) -> Array:
    """Scatter matrix of points.

    Parameters
    ----------
    points : (N, 2).

    Returns
    -------
    (2, 2) — Σ(v_i − v̄)(v_i − v̄)ᵀ.
    """
    centered = points - points.mean(axis=0)
    return np.asarray(centered.T @ centered)


def why_not_reduced(problem: Problem) -> str:
    """Why the reduction does not hold for a problem, in words; empty where it does.

    Parameters
    ----------
    problem : the problem.
    """
    radar = problem.radar
    receivers = [rx for _, rx in radar.images]
    one = len({tx for tx, _ in radar.images}) == 1
    monostatic = all(tx == rx for tx, rx in radar.images)
    if len(set(receivers)) < len(receivers) or not (one or monostatic):
        return "the images are neither of one transmitter nor each of its own satellite"
    if len(radar.images) != radar.satellite_count:
        return "a satellite has no image of its own"
    return ""


def what_is_left_out(problem: Problem) -> tuple[str, ...]:
    """What the reduction leaves out of a problem, so that its bounds are loose: in words.

    Parameters
    ----------
    problem : the problem.
    """
    errors, limits = problem.errors, problem.constraints
    left = []
    if errors.baseline_decorrelation is not BaselineDecorrelation.NONE:
        left.append("decorrelation by the baseline")
    if errors.phase_std is None and errors.phase_statistics is PhaseStatistics.EXACT:
        left.append("what the exact phase statistics lose against the Cramér-Rao bound")
    if not errors.coherence.spectral:
        left.append("decorrelation by volume or time")
    amplitude = image_amplitude(problem.scene, radar=problem.radar, errors=errors)
    if np.ptp(amplitude) > 0.0:
        left.append("what some images and segments lose in coherence against the best")
    if limits.min_unwrapping_probability is not None:
        left.append("the limit on the unwrapping")
    if limits.max_baseline_fraction is not None:
        left.append("the limit on the perpendicular baseline")
    by_pair = [
        name
        for name in ("position", "azimuth", "synchronization")
        if getattr(errors, name).std > 0.0 and getattr(errors, name).shared_by is SharedBy.PAIR
    ]
    if "azimuth" in by_pair:
        left.append("the azimuth error, drawn anew for every pair")
    if errors.synchronization.std > 0.0:
        left.append("the synchronization error")
    return tuple(left)


def reduction(problem: Problem, space: DesignSpace, *, sign: int) -> Reduction:
    """Reduce a problem to the scatter of its satellites.

    Parameters
    ----------
    problem : what is minimized, and within which limits; `why_not_reduced` must be empty.
    space : the designs.
    sign : ±1 — of the cross-track motion.
    """
    errors, radar, limits = problem.errors, problem.radar, problem.constraints
    seen = projection(space, problem.scene, held_constant=errors.held_constant, sign=sign)
    radius = plane_radius(space, max_radius=limits.max_radius) * (1.0 + 1e-9)
    ways = 2.0 if all(tx == rx for tx, rx in radar.images) else 1.0
    variance = (radar.wavelength / (2.0 * math.pi)) ** 2 / _image_information(problem)
    if errors.position.shared_by is SharedBy.SATELLITE:
        variance += (ways * errors.position.std) ** 2
    kappa = ways**2 / variance
    shared = errors.azimuth.shared_by is SharedBy.ALL
    azimuth = errors.azimuth.std if shared else 0.0
    common = common_height_errors(problem.scene, radar=radar, errors=errors)
    floor = sum((part**2 for part in common.values()), start=np.zeros(()))
    return Reduction(
        height=seen.height,
        azimuth=seen.azimuth,
        strength=kappa / seen.lever**2 * radius**2,
        ratio=kappa * azimuth**2 * radius**2,
        floor=float(np.mean(floor)),
        count=len(radar.images),
        # The closest approach of a pair over the orbit is twice its distance in the plane.
        separation=0.5 * (limits.min_separation or 0.0) / radius * (1.0 - 1e-9),
    )


def _image_information(problem: Problem) -> float:
    """Most that the noise lets know of each image's phase, among images alike [1/rad²]."""
    errors, radar, count = problem.errors, problem.radar, len(problem.radar.images)
    amplitude = float(image_amplitude(problem.scene, radar=radar, errors=errors).max())
    if errors.weighting is Weighting.PAIRS:
        noise = (
            errors.phase_std**2
            if errors.phase_std is not None
            else float(pair_phase_variance(amplitude**2, looks=radar.looks))
        )
        return count / (noise + float(pair_variance(radar, errors).min()))
    weight = amplitude**2 / (1.0 - amplitude**2)
    whole = 2.0 * radar.looks * weight
    unfiltered = errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED
    if unfiltered or not errors.coherence.spectral:
        # Exact statistics lessen each pair by itself: see `InformationBound`.
        if errors.phase_statistics is PhaseStatistics.EXACT and count > 2:
            return whole * count
        return whole  # see `InformationBound`: what the signal without noise would tell
    return whole * count * weight / (1.0 + count * weight)
