"""A lower bound for any number of satellites: their information as a sum over single satellites.

In a part f of the ground band, seen by the images S, the phases of n images alike tell

    kzᵀX(f)kz = 2Lu·nu/(1 + nu)·min_c Σ_S (k_i − c)²,   u = γ²/(1 − γ²),

and shared position errors leave min_c Σ (k_i − c)²/σ². With any c(f), c' and share θ of the split
of J = min_y yᵀXy + (kz − y)ᵀC⁻¹(kz − y), y = θkz, J is at most a sum of Φ(x_i) over the coordinates
of the satellites: no more than r times its largest value right of the middle, and N − r times that
left of it. The best c and θ for each r are found by Frank and Wolfe's method, on the measure of
where satellites stand; whatever they are, the bound holds.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, PhaseStatistics, SharedBy, Weighting
from insar.baselines import scene_critical_baseline
from insar.coherence import image_amplitude
from insar.height import common_height_errors
from insar.phase_noise import pair_efficiency

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import projection
from .projected import ALIKE, ROUNDING, largest_coordinates
from .reduction import why_not_reduced
from .shared import TABLE

Array = NDArray[np.float64]

_CELLS = 96
"""Cells of the line on which the satellites stand."""

_LEAST_CELLS = 12
"""Cells of a band, where that line is many bands long."""

_FARTHEST = 20.0
"""Bands between the middle of the line and its ends beyond which nothing is said: its parts are
more than memory should hold, and satellites that may stand so far apart have no such limit."""

_STEPS = 100
"""Steps of the search for the best c and θ."""


def why_not_separable(problem: Problem) -> str:
    """Why this bound does not apply, in words; empty where it does.

    Parameters
    ----------
    problem : the problem.
    """
    errors = problem.errors
    if errors.weighting is not Weighting.JOINT:
        return "only for the joint weighting"
    if errors.baseline_decorrelation is not BaselineDecorrelation.FILTERED:
        return "only with spectral filtering"
    if not errors.coherence.spectral:
        return "not with decorrelation by volume or time"
    return why_not_reduced(problem)


def separable_bound(problem: Problem, space: DesignSpace, *, sign: int) -> float:
    """Squared region height error that no formation beats.

    Parameters
    ----------
    problem : what is minimized, and within which limits; `why_not_separable` must be empty.
    space : the designs.
    sign : ±1 — of the cross-track motion.

    Returns
    -------
    scalar [m²]; 0 where satellites can stand so many bands apart that nothing is said of them.
    """
    scene, radar, errors = problem.scene, problem.radar, problem.errors
    seen = projection(space, scene, held_constant=errors.held_constant, sign=sign)
    ways = 2.0 if radar.pursuit else 1.0
    reach = ways * largest_coordinates(problem, space, seen)
    edge = reach / scene_critical_baseline(scene, radar)
    if edge.max() > _FARTHEST:
        return 0.0
    wavenumber = 2.0 * np.pi / radar.wavelength * reach / seen.lever
    every = np.broadcast_to(
        image_amplitude(scene, radar=radar, errors=errors), (len(scene), len(radar.images))
    )
    common = common_height_errors(scene, radar=radar, errors=errors)
    variance = sum((part**2 for part in common.values()), start=np.zeros(len(scene)))
    # Segments alike share a bound. At the farthest of them, edge E, stands who is at e·x/E of it:
    # the offsets are the same, and heights turn the phase by wavenumber/e at a unit of them.
    label = np.round(np.log(np.stack([edge, wavenumber, every.max(axis=-1)])) / 2e-3)
    _, first, of = np.unique(label, axis=1, return_index=True, return_inverse=True)
    squared = np.zeros(len(scene))
    for index in range(len(first)):
        members = np.flatnonzero(of.ravel() == index)
        farthest = float(edge[members].max())
        most = _most_information(
            problem,
            edge=farthest,
            wavenumber=farthest * float((wavenumber / edge)[members].max()),
            amplitude=float(every[members].max()),
            alike=bool(np.ptp(every[members]) <= ALIKE),
        )
        squared[members] = 1.0 / most
    return float(np.mean(squared + variance)) * (1.0 - ROUNDING)


def _most_information(
    problem: Problem,
    *,
    edge: float,
    wavenumber: float,
    amplitude: float,
    alike: bool,
) -> float:
    """Largest height information of a segment [1/m²]."""
    radar, errors, count = problem.radar, problem.errors, len(problem.radar.images)
    weight = amplitude**2 / (1.0 - amplitude**2)
    phase = 2.0 * radar.looks * weight * count * weight / (1.0 + count * weight)
    if errors.phase_statistics is PhaseStatistics.EXACT and alike:
        shifted = radar.azimuth_resolution is not None and not radar.pursuit
        least = 0.0 if shifted else max(0.0, 1.0 - 2.0 * edge)
        ends = pair_efficiency(amplitude**2, radar.looks * np.array([1.0, least]))
        phase *= min(1.0, float(ends.max()) * (1.0 + TABLE))
    shared = errors.position.shared_by is SharedBy.SATELLITE and errors.position.std > 0.0
    turn = 2.0 * np.pi / radar.wavelength * errors.position.std * (2.0 if radar.pursuit else 1.0)
    line = line_of_satellites(edge, phase, turn**-2 if shared else math.inf)
    most = max(_of_split(line, right, count - right) for right in range(count // 2 + 1))
    return most * wavenumber**2


class SatelliteLine(NamedTuple):
    """The line of the satellites, from −1 to 1, in cells that no end of a band cuts.

    Attributes
    ----------
    at : (G + 1,) — ends of the cells.
    width : (F,) — widths of the parts of the ground band [bandwidths].
    lost, gained : (G,) — the part that an image leaves out, or gains, on its way through a cell.
    sees : (G + 1, F) — 1 where an image at the end of a cell sees a part.
    phase : scalar — weight of the noise.
    position : scalar — of the position error; `inf` without.
    """

    at: Array
    width: Array
    lost: NDArray[np.intp]
    gained: NDArray[np.intp]
    sees: Array
    phase: float
    position: float


def line_of_satellites(edge: float, phase: float, position: float) -> SatelliteLine:
    """Cut the line where satellites stand into cells that no end of a band cuts.

    Parameters
    ----------
    edge : scalar — how far its ends are from the middle [bandwidths].
    phase, position : as in `SatelliteLine`.
    """
    # All ends a whole band apart, so that both ends of a band cross one part of it at a time.
    of_band = max(_LEAST_CELLS, math.ceil(_CELLS / (2.0 * edge)))
    number = math.floor(edge * of_band)
    even = np.arange(-number, number + 1) / of_band
    shifts = np.arange(-math.ceil(2.0 * edge), math.ceil(2.0 * edge) + 1)
    offset = np.concatenate([even, shifts + edge, shifts - edge])
    offset = np.unique(np.round(offset, 10))
    offset = offset[np.abs(offset) < edge - 1e-9]
    offset = np.concatenate([[-edge], offset, [edge]])
    cuts = np.unique(np.round(np.concatenate([offset, offset + 1.0]), 10))
    middle = 0.5 * (cuts[1:] + cuts[:-1])
    sees = ((offset[:, None] < middle) & (middle < offset[:, None] + 1.0)).astype(np.float64)
    return SatelliteLine(
        at=offset / edge,
        width=np.diff(cuts),
        lost=np.searchsorted(cuts, offset[:-1] + 1e-9, side="right") - 1,
        gained=np.searchsorted(cuts, offset[:-1] + 1.0 + 1e-9, side="right") - 1,
        sees=sees,
        phase=phase,
        position=position,
    )


def _of_split(line: SatelliteLine, right: int, left: int) -> float:
    """Bound with a number of satellites right of the middle, the others left of it."""
    onright = line.at >= 0.0
    measure = np.zeros(len(line.at))
    measure[-1], measure[0] = right, left
    best = math.inf
    for step in range(_STEPS):
        center, mean, share = _centers(line, measure)
        value, upper = _single(line, center, mean, share)
        bound = right * float(upper[:, line.at[1:] > 0.0].max(initial=0.0))
        bound += left * float(upper[:, line.at[:-1] < 0.0].max(initial=0.0))
        best = min(best, bound)
        toward = np.zeros_like(measure)
        toward[np.argmax(np.where(onright, value, -1.0))] += right
        toward[np.argmax(np.where(onright, -1.0, value))] += left
        measure += 2.0 / (step + 2.0 + _STEPS / 8.0) * (toward - measure)
    return best


def _centers(line: SatelliteLine, measure: Array) -> tuple[Array, float, float]:
    """c(f), c' and θ that are best for a measure of the satellites."""
    seen = measure @ line.sees
    first = (measure * line.at) @ line.sees
    center = np.divide(first, seen, out=np.zeros_like(first), where=seen > 0.0)
    mean = float(measure @ line.at / measure.sum())
    if math.isinf(line.position):
        return center, mean, 1.0
    second = (measure * line.at**2) @ line.sees
    noise = line.phase * float(line.width @ (second - center * first))
    shared = line.position * float(measure @ (line.at - mean) ** 2)
    return center, mean, shared / (noise + shared) if noise + shared > 0.0 else 0.5


def _single(line: SatelliteLine, center: Array, mean: float, share: float) -> tuple[Array, Array]:
    """Φ at the ends of the cells, (G + 1,), and what it is at most at both sides of one, (2, G).

    Within a cell the middle of the band is convex in x, and the parts that leave and enter grow
    linearly at most with the larger of their ends: so the largest is at an end.
    """
    away = (line.at[:, None] - center) ** 2 * line.width  # of every end from every part
    noise = share**2 * line.phase
    rest = np.zeros(len(line.at))
    if share < 1.0:
        rest = (1.0 - share) ** 2 * line.position * (line.at - mean) ** 2
    value = noise * np.sum(line.sees * away, axis=-1) + rest
    cell = np.arange(len(line.lost))
    before, after = value[:-1].copy(), value[1:].copy()
    # At the near end the part that is about to leave counts at its largest in the cell, and at
    # the far end the one that entered.
    before += noise * np.maximum(0.0, away[cell + 1, line.lost] - away[cell, line.lost])
    after += noise * np.maximum(0.0, away[cell, line.gained] - away[cell + 1, line.gained])
    return value, np.stack([before, after])
