"""Proof that a Walker constellation sees every target of a band at all times.

The torus of `long_run`, times the band, is divided into boxes. The central angle between a
satellite and a target changes by no more than both move, so a satellite that sees the middle of a
box with that margin sees the whole box. Boxes of which no satellite sees the whole are divided.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..earth import WGS84, Ellipsoid
from ..vectors import safe_arccos, safe_arcsin
from .results import Verdict
from .walker import (
    Visibility,
    Walker,
    annulus,
    central_cosine,
    geocentric_radius,
    ground_points,
    left_of_plane,
)

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_SMALLEST_BOX = 1e-4
"""Half size at which the proof gives up: 0.1 s of a low orbit [rad]."""
_LARGEST_BOX = 0.1
_MOST_BOXES = 400_000
_CHUNK = 2_000_000
"""Numbers held at once: boxes times satellites."""


class _Boxes(NamedTuple):
    """Boxes of geocentric latitude, θ and u: their middles and half sizes, (B, 3) each [rad]."""

    middle: Array
    half: Array

    @property
    def nearest_equator(self) -> Array:
        """Least distance from the equator, (B,) [rad]."""
        return np.maximum(0.0, np.abs(self.middle[:, 0]) - self.half[:, 0])

    @property
    def nearest_pole(self) -> Array:
        """Largest distance from the equator, (B,) [rad]."""
        return np.abs(self.middle[:, 0]) + self.half[:, 0]


def prove_continuous(
    walker: Walker,
    *,
    latitudes: tuple[float, float],
    visibility: Visibility,
    ellipsoid: Ellipsoid = WGS84,
) -> Verdict:
    """Whether a constellation sees every target of a band at all times.

    Parameters
    ----------
    walker : the constellation.
    latitudes : geodetic, from and to; the same twice for one latitude [rad].
    visibility : what a satellite sees.
    ellipsoid : on which the targets lie.

    Returns
    -------
    Verdict — `GAPS` when a place without cover was met; `UNDECIDED` when cover is so thin that
    gaps shorter than about 0.1 s can't be excluded, or that too many boxes are needed.
    """
    boxes = _first_boxes(walker, latitudes, ellipsoid)
    while boxes.middle.size:
        if boxes.middle.shape[0] > _MOST_BOXES:
            return Verdict.UNDECIDED
        size = max(1, _CHUNK // walker.total)
        left = []
        for first in range(0, boxes.middle.shape[0], size):
            part = _Boxes(*(column[first : first + size] for column in boxes))
            seen, whole = _seen(walker, part, visibility, ellipsoid)
            if not seen.all():
                return Verdict.GAPS
            left.append(_Boxes(part.middle[~whole], part.half[~whole]))
        boxes = _Boxes(*(np.concatenate(columns) for columns in zip(*left, strict=True)))
        if boxes.half.size and boxes.half.max(axis=1).min() < _SMALLEST_BOX:
            return Verdict.UNDECIDED
        boxes = _split(boxes)
    return Verdict.CONTINUOUS


def _first_boxes(walker: Walker, latitudes: tuple[float, float], ellipsoid: Ellipsoid) -> _Boxes:
    """The part of the torus that stands for all, times the band."""
    south, north = (float(ground_points(x, 0.0, ellipsoid=ellipsoid).latitude) for x in latitudes)
    low = np.array([south, 0.0, 0.0])
    size = np.array(
        [north - south, 2 * np.pi / walker.planes, 2 * np.pi / walker.satellites_per_plane]
    )
    count = np.maximum(1, np.ceil(size / (2 * _LARGEST_BOX))).astype(int)
    half = size / count / 2
    index = np.stack(np.meshgrid(*map(np.arange, count), indexing="ij"), axis=-1).reshape(-1, 3)
    middle = low + (2 * index + 1) * half
    return _Boxes(middle, np.broadcast_to(half, middle.shape).copy())


def _seen(
    walker: Walker, boxes: _Boxes, visibility: Visibility, ellipsoid: Ellipsoid
) -> tuple[Mask, Mask]:
    """Whether any satellite sees the middle of each box, and any the whole of it, (B,) each."""
    latitude, east, along = boxes.middle.T[:, :, None]
    node, argument = replace(walker, first_node=0.0, first_argument=0.0).pattern()
    theta, u, tilt = east - node, along + argument, walker.inclination
    angle = safe_arccos(
        np.clip(central_cosine(latitude=latitude, theta=theta, u=u, inclination=tilt), -1.0, 1.0)
    )
    # The target moves by its half sizes, the satellite by that of u.
    shift = (boxes.half[:, 0] + np.cos(boxes.nearest_equator) * boxes.half[:, 1])[:, None]
    margin = shift + boxes.half[:, 2:]
    # The annulus grows where the ground is lower, towards the poles.
    inner, outer = _annulus(walker, boxes.middle[:, 0], visibility, ellipsoid)
    _, least_outer = _annulus(walker, boxes.nearest_equator, visibility, ellipsoid)
    most_inner, _ = _annulus(walker, boxes.nearest_pole, visibility, ellipsoid)
    seen = (angle >= inner) & (angle <= outer)
    whole = angle <= least_outer - margin
    if visibility.min_incidence > 0.0:
        whole &= angle >= most_inner + margin
    if visibility.side is not None:
        left = left_of_plane(latitude=latitude, theta=theta, inclination=tilt)
        distance = visibility.side * safe_arcsin(np.clip(left, -1.0, 1.0))
        seen &= distance >= 0.0
        whole &= distance >= shift
    any_middle: Mask = np.any(seen, axis=1)
    any_whole: Mask = np.any(whole, axis=1)
    return any_middle, any_whole


def _annulus(
    walker: Walker, latitude: Array, visibility: Visibility, ellipsoid: Ellipsoid
) -> tuple[Array, Array]:
    """Inner and outer central angle at geocentric latitudes (B,), (B, 1) each."""
    radius = geocentric_radius(latitude, ellipsoid=ellipsoid)[:, None]
    return annulus(visibility, orbit_radius=walker.semi_major_axis, target_radius=radius)


def _split(boxes: _Boxes) -> _Boxes:
    """Halve each box in the direction that moves targets or satellites most."""
    weight = np.ones_like(boxes.half)
    weight[:, 1] = np.cos(boxes.middle[:, 0])
    widest = np.argmax(boxes.half * weight, axis=1)
    rows = np.arange(widest.size)
    half = boxes.half.copy()
    half[rows, widest] /= 2
    offset = np.zeros_like(half)
    offset[rows, widest] = half[rows, widest]
    middle = np.concatenate([boxes.middle - offset, boxes.middle + offset])
    return _Boxes(middle, np.concatenate([half, half]))
