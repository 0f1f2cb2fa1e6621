"""Orbits given as a table of states: CCSDS Orbit Ephemeris Messages."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .frames import Rotation, gcrs_to_itrs
from .interpolation import interpolate
from .oem_checks import check_distances, check_motion
from .oem_header import Method, frame_to_gcrs, interpolation_method, tai_seconds, usable_interval
from .oem_reader import Block, Instant, read_oem
from .timescales import DAY, Moments, moments, utc_of
from .trajectory import States

Array = NDArray[np.float64]

_GAP_RATIO: Final = 4.0
"""A step this much longer than both of its neighbors is a gap: lines are missing."""

_TOLERANCE: Final = 1e-6  # datetime's resolution [s]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Piece:
    """A stretch of states without gaps, in one frame.

    `first` and `last` bound the times at which it may be used; the nodes may reach beyond.
    """

    first: float
    last: float
    nodes: Array
    position: Array
    velocity: Array
    method: Method
    to_gcrs: Callable[[Moments], Rotation]

    def states(self, times: Array) -> States:
        """States (S, 3) in the frame of the message."""
        slopes = self.velocity if self.method.hermite else None
        inside = np.clip(times, self.nodes[0], self.nodes[-1])
        return States(
            *interpolate(inside, self.nodes, self.position, slopes, points=self.method.points)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Ephemeris:
    """An orbit from a table of states; build it by `from_oem`.

    Attributes
    ----------
    name : of the satellite.
    epoch : first moment at which it may be used, rounded to a microsecond (UTC).

    Notes
    -----
    States are interpolated by the polynomial that the message names, in the frame of the message;
    the velocity is the derivative of that polynomial. A message that names none is interpolated
    by Hermite's of degree 11. A Hermite polynomial meets the velocities of the message; Lagrange's
    ignores them. A message that takes steps of four times the length of those around has lost
    lines: that is a gap.
    """

    name: str
    epoch: datetime
    _pieces: tuple[_Piece, ...]

    @classmethod
    def from_oem(cls, text: str) -> Ephemeris:
        """Build the orbit from the text of a CCSDS Orbit Ephemeris Message.

        Parameters
        ----------
        text : keyword-value notation, version 1 to 3; states about the Earth in EME2000, GCRF,
            ICRF, ITRF (any year), TEME or TOD, times in UTC, TAI, TT or GPS.

        Raises
        ------
        ValueError
            If the message is malformed, of several objects, in another frame or time system, has
            fewer lines than its interpolation needs, or states that are not those of a satellite;
            the line and the remedy are named.
        """
        blocks = read_oem(text)
        _check_one_object(blocks)
        first = min((usable_interval(block)[0] for block in blocks), key=tai_seconds)
        epoch = utc_of(first.day, first.seconds)
        pieces = [piece for block in blocks for piece in _pieces(block, epoch)]
        name = blocks[0].header["OBJECT_NAME"]
        return cls(
            name=name, epoch=epoch, _pieces=tuple(sorted(pieces, key=lambda piece: piece.first))
        )

    @property
    def span(self) -> tuple[float, float]:
        """First and last time at which the message may be used [s]; gaps may lie between."""
        return self._pieces[0].first, max(piece.last for piece in self._pieces)

    @property
    def source(self) -> str:
        """Kind of the orbit, and the satellite."""
        return f"ephemeris of {self.name}"

    @property
    def perturbed(self) -> bool:
        """Always: the ephemeris is of a real orbit."""
        return True

    def inertial(self, times: ArrayLike) -> States:
        """States in the GCRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If a time lies outside the span or in a gap, which is named.
        """
        return self._read(times, lambda piece, at: piece.to_gcrs(at))

    def earth_fixed(self, times: ArrayLike) -> States:
        """States in the ITRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If a time lies outside the span or in a gap, which is named.
        """
        return self._read(times, lambda piece, at: gcrs_to_itrs(at).after(piece.to_gcrs(at)))

    def _read(self, times: ArrayLike, turn: Callable[[_Piece, Moments], Rotation]) -> States:
        time = np.asarray(times, dtype=np.float64)
        flat = time.ravel()
        which = self._piece_of(flat)
        position, velocity = np.empty((2, flat.size, 3))
        for index in np.unique(which):
            here, piece = which == index, self._pieces[index]
            rotation = turn(piece, moments(self.epoch, flat[here]))
            position[here], velocity[here] = rotation.apply(piece.states(flat[here]))
        shape = (*time.shape, 3)
        return States(position.reshape(shape), velocity.reshape(shape))

    def _piece_of(self, times: Array) -> NDArray[np.intp]:
        """Index of the piece to use at each time; where two overlap, of the later."""
        starts = np.array([piece.first for piece in self._pieces])
        stops = np.array([piece.last for piece in self._pieces])
        which = np.searchsorted(starts - _TOLERANCE, times, side="right") - 1
        missed = (which < 0) | (times > stops[which] + _TOLERANCE) | np.isnan(times)
        if np.any(missed):
            raise ValueError(self._missing(float(times[np.argmax(missed)]), starts, stops))
        return which

    def _missing(self, time: float, starts: Array, stops: Array) -> str:
        if not math.isfinite(time):
            return f"time = {time} s must be finite"
        first, last = self.span
        if first <= time <= last:
            where = (
                f"lies in a gap from {self._date(float(stops[stops < time].max()))} "
                f"to {self._date(float(starts[starts > time].min()))}"
            )
        else:
            where = f"is not within {self._date(first)} to {self._date(last)}"
        return (
            f"{self._date(time)} {where} of the ephemeris of {self.name}; choose other times, or "
            "a message that covers them"
        )

    def _date(self, time: float) -> str:
        return f"{self.epoch + timedelta(seconds=time):%Y-%m-%dT%H:%M:%SZ}"


def _check_one_object(blocks: list[Block]) -> None:
    for block in blocks:
        if block.header["OBJECT_ID"] != blocks[0].header["OBJECT_ID"]:
            raise ValueError(
                f"OEM line {block.line}: this segment is of object {block.header['OBJECT_ID']}, "
                f"the first of {blocks[0].header['OBJECT_ID']}; give a message of one object"
            )


def _pieces(block: Block, epoch: datetime) -> list[_Piece]:
    """Split a segment at its gaps."""
    zero = moments(epoch)
    origin = Instant(int(zero.day), float(zero.fraction) * DAY)
    nodes = np.array([instant.since(origin) for instant in block.times])
    check_distances(block.position, block.lines)
    first, last = (instant.since(origin) for instant in usable_interval(block))
    method = interpolation_method(block)
    to_gcrs = frame_to_gcrs(block)
    pieces = []
    for lines in np.split(np.arange(len(nodes)), _gaps(nodes) + 1):
        start, stop = max(first, nodes[lines[0]]), min(last, nodes[lines[-1]])
        if start >= stop:
            continue
        if len(lines) < method.points:
            raise ValueError(
                f"OEM line {block.line}: {len(lines)} lines without a gap follow, but the "
                f"interpolation needs {method.points}; lower INTERPOLATION_DEGREE or add lines"
            )
        states = States(block.position[lines], block.velocity[lines])
        check_motion(
            nodes[lines],
            to_gcrs(moments(epoch, nodes[lines])).apply(states),
            block.lines[lines[0] : lines[-1] + 1],
        )
        pieces.append(
            _Piece(
                first=start,
                last=stop,
                nodes=nodes[lines],
                position=states.position,
                velocity=states.velocity,
                method=method,
                to_gcrs=to_gcrs,
            )
        )
    if not pieces:
        raise ValueError(
            f"OEM line {block.line}: the segment covers no time; give it lines within "
            "USEABLE_START_TIME and USEABLE_STOP_TIME"
        )
    return pieces


def _gaps(nodes: Array) -> NDArray[np.intp]:
    """Indices of lines after which lines are missing."""
    steps = np.diff(nodes)
    before = np.concatenate([[np.inf], steps])[: steps.size]
    after = np.concatenate([steps, [np.inf]])[1 : steps.size + 1]
    neighbor = np.minimum(
        np.where(np.isinf(before), after, before), np.where(np.isinf(after), before, after)
    )
    return np.flatnonzero(steps > _GAP_RATIO * neighbor)
