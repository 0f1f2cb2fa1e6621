"""Reverse derivatives of the phase information with respect to the shifts of the images' bands.

The information X of M images is a graph Laplacian. A sum over its edges,

    E = Σ_{i<j} C_ij x_ij,   x_ij = −X_ij = 2L u_i u_j η_ij I_ij,   I_ij = ∬ df/(1 + U(f)),

depends on the design only through the lower ends o_i, d_i of the images' range and azimuth bands:
through I_ij, the integral over the common band, and through the efficiency η_ij, a function of the
common area A_ij. With K_ij = 2L u_i u_j η_ij C_ij the first part is an integral over the spectrum,

    Σ K_ij I_ij = ∬ h(f) df,   h(f) = Σ_{i<j seen at f} K_ij / (1 + U(f)),

piecewise constant between the ends of the bands, so that moving an end by dq changes it by
(h before − h behind) dq. One reverse pass gives all 2M derivatives at the cost of a few E.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STEP = 1e-6
"""Relative step of the derivative of the efficiency, a smooth function of one variable."""


class Bands(NamedTuple):
    """The bands of M images in S segments of one formation.

    Attributes
    ----------
    range_offset : (S, M) — lower ends o_i, in bandwidths.
    doppler_offset : (S, M) — lower ends d_i; None where azimuth bands are not counted.
    weight : (S, M) — u_i = γ_i²/(1 − γ_i²).
    looks : scalar — L at full bandwidth.
    range_rate : (S,) — do/dB⊥ of a phase center [1/m].
    doppler_rate : (S,) — dd/dB_a likewise; None where azimuth bands are not counted.
    efficiency : (S, M, M) common areas → η_ij; None for one.
    """

    range_offset: Array
    doppler_offset: Array | None
    weight: Array
    looks: float
    range_rate: Array
    doppler_rate: Array | None
    efficiency: Callable[[Array], Array] | None


class EdgeModel(NamedTuple):
    """Edges x_ij of the information, and what their derivatives need.

    Attributes
    ----------
    edges : (S, M, M) — x_ij, zero on the diagonal [1/rad²].
    integral : (S, M, M) — I_ij.
    area : (S, M, M) — A_ij.
    strength : (S, M, M) — 2L u_i u_j, zero on the diagonal.
    eta : (S, M, M) — η_ij.
    eta_slope : (S, M, M) — dη_ij/dA_ij.
    across, along : the intervals of the range and the azimuth axis.
    density : (S, n, m) — 1/(1 + U) of each cell.
    """

    edges: Array
    integral: Array
    area: Array
    strength: Array
    eta: Array
    eta_slope: Array
    across: Intervals
    along: Intervals
    density: Array


class Intervals(NamedTuple):
    """The n = 2M − 1 intervals between the ends of the bands on one axis.

    Attributes
    ----------
    width : (S, n) — in bandwidths.
    seen : (S, M, n) — 1 where an image sees an interval, else 0.
    order : (S, 2M) — index of the band's end, lower ends first, at each place of the sorted axis.
    """

    width: Array
    seen: Array
    order: NDArray[np.intp]


def intervals(offset: Array) -> Intervals:
    """Cut an axis at the ends of the bands.

    Parameters
    ----------
    offset : (S, M) — lower ends, in bandwidths.
    """
    ends = np.concatenate([offset, offset + 1.0], axis=-1)
    order = np.argsort(ends, axis=-1, kind="stable")
    ordered = np.take_along_axis(ends, order, axis=-1)
    middle = 0.5 * (ordered[:, 1:] + ordered[:, :-1])[:, None, :]
    start = offset[..., None]
    seen = ((start <= middle) & (middle < start + 1.0)).astype(np.float64)
    return Intervals(np.diff(ordered, axis=-1), seen, order)


def edge_model(bands: Bands) -> EdgeModel:
    """Edges of the information of filtered images, from scratch.

    Parameters
    ----------
    bands : of one formation.
    """
    across = intervals(bands.range_offset)
    along = _everything(bands) if bands.doppler_offset is None else intervals(bands.doppler_offset)
    total = np.swapaxes(across.seen * bands.weight[..., None], -1, -2) @ along.seen
    density = 1.0 / (1.0 + total)
    integral = _pair_sums(
        density * across.width[..., None] * along.width[:, None, :], across.seen, along.seen
    )
    area = _overlap(bands.range_offset)
    if bands.doppler_offset is not None:
        area = area * _overlap(bands.doppler_offset)
    strength = 2.0 * bands.looks * bands.weight[..., :, None] * bands.weight[..., None, :]
    strength = strength * (1.0 - np.eye(strength.shape[-1]))
    if bands.efficiency is None:
        eta, slope = np.ones_like(area), np.zeros_like(area)
    else:
        eta = bands.efficiency(area)
        ahead = bands.efficiency(area * (1.0 + _STEP))
        behind = bands.efficiency(area * (1.0 - _STEP))
        slope = (ahead - behind) / (2.0 * _STEP * np.where(area > 0.0, area, 1.0))
    return EdgeModel(
        strength * eta * integral, integral, area, strength, eta, slope, across, along, density
    )


def edge_slopes(bands: Bands, model: EdgeModel, coefficient: Array) -> tuple[Array, Array]:
    """Derivatives of E = Σ_{i<j} C_ij x_ij by the shifts of the bands.

    Parameters
    ----------
    bands : of one formation.
    model : its edges, from `edge_model`.
    coefficient : (..., S, M, M) — C, symmetric.

    Returns
    -------
    (..., S, M) — ∂E/∂o_i, and ∂E/∂d_i, zero where azimuth bands are not counted [1/rad²].
    """
    kernel = coefficient * model.strength * model.eta
    height = _cell_sums(kernel, model.across.seen, model.along.seen) * model.density
    through_area = coefficient * model.strength * model.eta_slope * model.integral
    across = _end_slopes(height @ model.along.width[..., None], model.across)
    shared = 1.0 if bands.doppler_offset is None else _overlap(bands.doppler_offset)
    across = across + _overlap_slopes(through_area * shared, bands.range_offset)
    if bands.doppler_offset is None:
        return across, np.zeros_like(across)
    weighed = np.swapaxes(height, -1, -2) @ model.across.width[..., None]
    along = _end_slopes(weighed, model.along)
    through_area = through_area * _overlap(bands.range_offset)
    return across, along + _overlap_slopes(through_area, bands.doppler_offset)


def _everything(bands: Bands) -> Intervals:
    """One interval of the azimuth axis, which all images see."""
    segments, count = bands.range_offset.shape
    return Intervals(
        np.ones((segments, 1)),
        np.ones((segments, count, 1)),
        np.zeros((segments, 2), dtype=np.intp),
    )


def _pair_sums(cells: Array, across: Array, along: Array) -> Array:
    """Σ of the cells (S, n, m) that both images of each pair see, (S, M, M)."""
    if along.shape[-1] == 1:
        return np.asarray((across * cells[..., 0][:, None, :]) @ np.swapaxes(across, -1, -2))
    count = across.shape[-2]
    first, second = np.triu_indices(count, k=1)
    rows = (across[:, first] * across[:, second]) @ cells
    sums = np.zeros((len(cells), count, count))
    sums[:, first, second] = np.sum(rows * along[:, first] * along[:, second], axis=-1)
    return sums + np.swapaxes(sums, -1, -2)


def _cell_sums(kernel: Array, across: Array, along: Array) -> Array:
    """Σ_{i<j} K_ij over the pairs that see each cell, (..., S, n, m)."""
    if along.shape[-1] == 1:
        return np.asarray(0.5 * np.sum(across * (kernel @ across), axis=-2)[..., None])
    first, second = np.triu_indices(across.shape[-2], k=1)
    both = np.swapaxes(across[:, first] * across[:, second], -1, -2)
    weighed = kernel[..., first, second][..., None] * (along[:, first] * along[:, second])
    return np.asarray(both @ weighed)


def _end_slopes(profile: Array, axis: Intervals) -> Array:
    """What the integral of a profile (..., S, n, 1) gains where each image's band moves up."""
    inside = profile[..., 0]
    gain = -np.diff(inside, axis=-1, prepend=0.0, append=0.0)
    by_end = np.empty_like(gain)
    np.put_along_axis(by_end, np.broadcast_to(axis.order, gain.shape), gain, axis=-1)
    count = gain.shape[-1] // 2
    slopes: Array = by_end[..., :count] + by_end[..., count:]
    return slopes


def _overlap(offset: Array) -> Array:
    return np.maximum(0.0, 1.0 - np.abs(offset[..., :, None] - offset[..., None, :]))


def _overlap_slopes(coefficient: Array, offset: Array) -> Array:
    """Derivatives of Σ_{i<j} C_ij · overlap_ij by the offsets."""
    apart = offset[..., :, None] - offset[..., None, :]
    slope = np.where(np.abs(apart) < 1.0, -np.sign(apart), 0.0)
    return np.asarray(np.sum(coefficient * slope, axis=-1))
