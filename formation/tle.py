"""Orbits given as two-line elements, propagated by SGP4."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .constants import EARTH_EQUATORIAL_RADIUS
from .derivative import states_from_positions
from .frames import Rotation, teme_to_gcrs, teme_to_itrs
from .keplerian import LOWEST_PERIGEE
from .timescales import DAY, MJD_EPOCH, MJD_ZERO, moments
from .trajectory import States

Array = NDArray[np.float64]

_LINE_LENGTH: Final = 69
_LOWEST: Final = EARTH_EQUATORIAL_RADIUS + LOWEST_PERIGEE
_FARTHEST: Final = 4.0e8  # beyond the Moon [m]
_DECAYED: Final = 6
_REASONS: Final = {
    1: "the mean eccentricity leaves the range 0 to 1",
    2: "the mean motion is negative",
    3: "the eccentricity leaves the range 0 to 1",
    4: "the semi-latus rectum is negative",
    _DECAYED: "the satellite has decayed",
}


@dataclass(frozen=True, kw_only=True)
class TwoLineOrbit:
    """An orbit from two-line elements; build it by `from_lines` or `from_text`.

    Attributes
    ----------
    line1, line2 : the elements.
    name : of the satellite, if it was given.

    Notes
    -----
    Two-line elements are good to about 1 km at their epoch and lose 1 to 3 km per day.
    """

    line1: str
    line2: str
    name: str | None = None
    _satellite: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        _check_line(self.line1, 1)
        _check_line(self.line2, 2)
        if self.line1[2:7] != self.line2[2:7]:
            raise ValueError(
                f"line 1 is of satellite {self.line1[2:7]}, line 2 of {self.line2[2:7]}; give the "
                "two lines of one satellite"
            )
        object.__setattr__(self, "_satellite", _satellite(self.line1, self.line2))
        perigee = float(self._satellite.altp) * EARTH_EQUATORIAL_RADIUS
        if not perigee >= LOWEST_PERIGEE:
            reason = f"the perigee is at a height of {perigee / 1e3:.0f} km, decayed"
            raise ValueError(self._failure(reason, 0.0))
        self._teme(np.zeros(()))  # a satellite that has decayed says so here

    @classmethod
    def from_lines(cls, line1: str, line2: str, name: str | None = None) -> TwoLineOrbit:
        """Build the orbit from its lines.

        Parameters
        ----------
        line1, line2 : the elements; blanks at the end are forgiven.
        name : of the satellite, for messages and reports.

        Raises
        ------
        ValueError
            If a line is damaged (format or checksum), the lines are swapped or of two satellites,
            or the satellite has decayed.
        """
        return cls(line1=line1.rstrip(), line2=line2.rstrip(), name=name)

    @classmethod
    def from_text(cls, text: str) -> TwoLineOrbit:
        """Build the orbit from the text of a file: two lines, or three with the name first.

        Raises
        ------
        ValueError
            If there are more or fewer lines, and as `from_lines` does.
        """
        lines = [line.rstrip() for line in text.splitlines() if line.strip()]
        numbers = [line[2:7].strip() for line in lines if line.startswith("1 ")]
        if len(numbers) > 1 and len(lines) > 3:
            raise ValueError(
                f"these are two-line elements of {len(numbers)} satellites or dates (catalog "
                f"numbers {', '.join(numbers[:5])}); keep the lines of one"
            )
        if len(lines) not in (2, 3):
            raise ValueError(
                f"two-line elements have 2 lines, or 3 with the name first; found {len(lines)}; "
                "give those of one satellite"
            )
        name = lines[0].removeprefix("0 ").strip() if len(lines) == 3 else None
        return cls.from_lines(lines[-2], lines[-1], name=name)

    @property
    def epoch(self) -> datetime:
        """Epoch of the elements (UTC)."""
        # sgp4 keeps the eight printed decimals of a day, 864 µs: whole microseconds.
        days = self._satellite.jdsatepoch - MJD_ZERO
        microseconds = round(self._satellite.jdsatepochF * DAY * 1e6)
        return MJD_EPOCH + timedelta(days=days, microseconds=microseconds)

    @property
    def span(self) -> tuple[float, float]:
        """No limit, though the accuracy fades away from the epoch."""
        return -math.inf, math.inf

    @property
    def source(self) -> str:
        """Kind of the orbit, and the satellite with its catalog number."""
        number = self.line1[2:7].strip()
        satellite = f"{self.name} ({number})" if self.name else f"satellite {number}"
        return f"two-line elements of {satellite}"

    @property
    def perturbed(self) -> bool:
        """Always: SGP4 has them."""
        return True

    def inertial(self, times: ArrayLike) -> States:
        """States in the GCRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If SGP4 fails at one of the times, the satellite having decayed for instance.
        """
        return self._turned(times, inertial=True)

    def earth_fixed(self, times: ArrayLike) -> States:
        """States in the ITRS.

        Parameters
        ----------
        times : (...) — since the epoch [s].

        Raises
        ------
        ValueError
            If SGP4 fails at one of the times, the satellite having decayed for instance.
        """
        return self._turned(times, inertial=False)

    def _turned(self, times: ArrayLike, *, inertial: bool) -> States:
        at = moments(self.epoch, times)
        turn: Rotation = teme_to_gcrs(at) if inertial else teme_to_itrs(at)
        # SGP4's own velocity is centimeters per second off the derivative of its position.
        return turn.apply(states_from_positions(self._teme, times))

    def _teme(self, times: Array) -> Array:
        """Positions (..., 3) in the axes of SGP4 [m]."""
        days = self._satellite.jdsatepochF + times.ravel() / DAY
        codes, position, _ = self._satellite.sgp4_array(
            np.full(days.shape, self._satellite.jdsatepoch), days
        )
        if np.any(codes):
            first = int(np.argmax(codes > 0))
            code = int(codes[first])
            reason = _REASONS.get(code, f"SGP4 gives error {code}")
            raise ValueError(self._failure(reason, float(times.ravel()[first])))
        self._check_distances(position * 1e3, times.ravel())
        positions: Array = position.reshape(*times.shape, 3) * 1e3
        return positions

    def _check_distances(self, position: Array, times: Array) -> None:
        """Refuse what SGP4 lets pass without an error."""
        distance = np.linalg.norm(position, axis=-1)
        # False for NaN.
        near = (distance >= _LOWEST) & (distance <= _FARTHEST)
        if not np.all(near):
            first = int(np.argmin(near))
            height = (distance[first] - EARTH_EQUATORIAL_RADIUS) / 1e3
            reason = (
                f"SGP4 takes it to a height of {height:.0f} km, where it has decayed"
                if distance[first] < _LOWEST
                else f"SGP4 takes it to a height of {height:.3g} km, away from the Earth"
            )
            raise ValueError(self._failure(reason, float(times[first])))

    def _failure(self, reason: str, time: float) -> str:
        days = round(time / DAY, 2)
        when, remedy = (
            (f"{days:+.2f} days from their epoch", "give elements of a date nearer to the study's")
            if days
            else ("at their epoch", "they are damaged or of a lost satellite, give others")
        )
        return f"{self.source}, {when} {self.epoch:%Y-%m-%d %H:%M}: {reason}; {remedy}"


def _satellite(line1: str, line2: str) -> Any:
    from sgp4.api import Satrec

    try:
        return Satrec.twoline2rv(line1, line2)
    except ValueError as error:
        raise ValueError(f"two-line elements can't be read: {error}") from error


def _check_line(line: str, number: int) -> None:
    from sgp4.io import compute_checksum

    if line.startswith(f"{3 - number} "):
        raise ValueError(
            f"line {number} of the two-line elements begins with {line[0]!r}: the lines are "
            "swapped; give line 1 first"
        )
    if not line.startswith(f"{number} ") or len(line) != _LINE_LENGTH or not line.isascii():
        raise ValueError(
            f"line {number} of the two-line elements must begin with '{number} ' and have "
            f"{_LINE_LENGTH} ASCII characters; this has {len(line)}: {line!r}"
        )
    if str(compute_checksum(line)) != line[-1]:
        raise ValueError(
            f"line {number} of the two-line elements ends with checksum {line[-1]}, but its digits "
            f"add up to {compute_checksum(line)}; it is damaged, fetch it again: {line!r}"
        )
