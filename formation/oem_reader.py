"""CCSDS Orbit Ephemeris Messages in keyword-value notation (CCSDS 502.0-B, versions 1 to 3)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import date
from typing import Final, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from .timescales import DAY, GPS_MINUS_TAI, MJD_EPOCH, TT_MINUS_TAI, tai_minus_utc

Array = NDArray[np.float64]

_VERSIONS: Final = ("1", "2", "3")
_REQUIRED: Final = (
    "OBJECT_NAME",
    "OBJECT_ID",
    "CENTER_NAME",
    "REF_FRAME",
    "TIME_SYSTEM",
    "START_TIME",
    "STOP_TIME",
)
_SINCE_TAI: Final = {"TAI": 0.0, "TT": TT_MINUS_TAI, "GPS": GPS_MINUS_TAI}
_EPOCH: Final = re.compile(
    r"(\d{4})-(?:(\d{2})-(\d{2})|(\d{3}))T(\d{2}):(\d{2}):(\d{2}(?:\.\d*)?)Z?"
)


class Instant(NamedTuple):
    """Moment of TAI: whole modified Julian day, and seconds since its beginning."""

    day: int
    seconds: float

    def since(self, other: Instant) -> float:
        """Time elapsed from another moment [s]."""
        return (self.day - other.day) * DAY + (self.seconds - other.seconds)


@dataclass(frozen=True, kw_only=True, eq=False)
class Block:
    """One segment of a message: its header and its lines.

    Attributes
    ----------
    line : number of the line at which the segment begins.
    lines : number of the line of each state.
    header : what its header says, by keyword.
    times : moments of its lines, increasing.
    position, velocity : (N, 3) — in the frame of the header [m, m/s].
    """

    line: int
    lines: tuple[int, ...]
    header: dict[str, str]
    times: tuple[Instant, ...]
    position: Array
    velocity: Array

    def instant(self, keyword: str) -> Instant | None:
        """Moment that the header gives under a keyword."""
        text = self.header.get(keyword)
        return None if text is None else _instant(text, self.header["TIME_SYSTEM"], self.line)


@dataclass
class _Draft:
    """A segment while it is read."""

    line: int
    lines: list[int] = field(default_factory=list)
    header: dict[str, str] = field(default_factory=dict)
    times: list[Instant] = field(default_factory=list)
    states: list[list[float]] = field(default_factory=list)


def read_oem(text: str) -> list[Block]:
    """Read the segments of a message.

    Parameters
    ----------
    text : of the file.

    Raises
    ------
    ValueError
        If the text is no such message or is malformed; the message names the line and the remedy.
    """
    lines = _meaningful(text)
    _check_version(next(lines, (1, "")))
    drafts: list[_Draft] = []
    place = "preamble"
    for number, line in lines:
        if line in _TRANSITIONS:
            place = _moved(place, line, number)
            if line == "META_START":
                drafts.append(_Draft(number))
        elif place == "header":
            key, value = _keyword(line, number)
            drafts[-1].header[key] = value
        elif place == "lines":
            _add_line(drafts[-1], line, number)
    if not drafts:
        _fail(1, "there is no META_START; the file holds no ephemeris, or was cut short")
    if place in ("header", "covariance"):
        _fail(drafts[-1].line, f"the {place} that follows is never closed; the file was cut short")
    return [_finished(draft) for draft in drafts]


_TRANSITIONS: Final = {
    "META_START": (("preamble", "lines"), "header"),
    "META_STOP": (("header",), "lines"),
    "COVARIANCE_START": (("lines",), "covariance"),
    "COVARIANCE_STOP": (("covariance",), "lines"),
}


def _moved(place: str, marker: str, number: int) -> str:
    allowed, target = _TRANSITIONS[marker]
    if place not in allowed:
        _fail(
            number,
            f"{marker} stands in the {place} of a segment; it must follow the "
            f"{' or the '.join(allowed)}",
        )
    return target


def _meaningful(text: str) -> Iterator[tuple[int, str]]:
    """Numbered lines without blanks and comments."""
    for number, raw in enumerate(text.removeprefix("\ufeff").splitlines(), start=1):
        line = raw.strip()
        if line and line.split(maxsplit=1)[0] != "COMMENT":
            yield number, line


def _check_version(first: tuple[int, str]) -> None:
    number, line = first
    if line.startswith("<"):
        _fail(number, "this is XML; only the keyword-value notation is read: convert the message")
    key, _, value = (part.strip() for part in line.partition("="))
    if key != "CCSDS_OEM_VERS":
        _fail(number, f"must be CCSDS_OEM_VERS = 2.0 or the like, not {line!r}: is it an OEM?")
    if value.split(".")[0] not in _VERSIONS:
        _fail(number, f"CCSDS_OEM_VERS = {value}; versions 1.0, 2.0 and 3.0 are read")


def _keyword(line: str, number: int) -> tuple[str, str]:
    key, sign, value = (part.strip() for part in line.partition("="))
    if not sign or not value:
        _fail(number, f"expected KEYWORD = value, or META_STOP, not {line!r}")
    return key, value


def _add_line(draft: _Draft, line: str, number: int) -> None:
    if not draft.times:
        _check_header(draft)
    epoch, *numbers = line.split()
    if len(numbers) not in (6, 9):
        _fail(number, f"expected an epoch, 3 km and 3 km/s (and 3 km/s²), not {line!r}")
    try:
        values = [float(value) for value in numbers[:6]]
    except ValueError:
        _fail(number, f"a coordinate is no number: {line!r}")
    if not np.all(np.isfinite(values)):
        _fail(number, f"a coordinate is not finite: {line!r}")
    instant = _instant(epoch, draft.header["TIME_SYSTEM"], number)
    if draft.times and instant.since(draft.times[-1]) <= 0.0:
        _fail(number, f"epoch {epoch} is not after that of the line before; sort the lines")
    draft.lines.append(number)
    draft.times.append(instant)
    draft.states.append(values)


def _check_header(draft: _Draft) -> None:
    missing = [key for key in _REQUIRED if key not in draft.header]
    if missing:
        _fail(draft.line, f"the segment that begins here lacks {', '.join(missing)}; add it")
    center = draft.header["CENTER_NAME"]
    if center.upper() != "EARTH":
        _fail(draft.line, f"CENTER_NAME = {center}; only orbits about EARTH are read")


def _instant(text: str, system: str, number: int) -> Instant:
    """Moment written in CCSDS's calendar or day-of-year form."""
    match = _EPOCH.fullmatch(text)
    if not match:
        _fail(number, f"epoch {text!r} must look like 2026-03-01T12:00:00.000")
    year, month, day, day_of_year, hour, minute, second = match.groups()
    try:
        if day_of_year:
            start = date(int(year), 1, 1).toordinal() + int(day_of_year) - 1
        else:
            start = date(int(year), int(month), int(day)).toordinal()
    except ValueError:
        _fail(number, f"epoch {text!r} is no date of the calendar")
    leap = (hour, minute) == ("23", "59")
    if int(hour) > 23 or int(minute) > 59 or float(second) >= (61.0 if leap else 60.0):
        _fail(
            number,
            f"epoch {text!r} is no time of the day: hours run to 23, minutes and seconds to 59; "
            "correct it",
        )
    mjd = start - MJD_EPOCH.toordinal()
    seconds = int(hour) * 3600.0 + int(minute) * 60.0 + float(second)
    if system == "UTC":
        return Instant(mjd, seconds + float(tai_minus_utc(mjd)))
    if system not in _SINCE_TAI:
        _fail(number, f"TIME_SYSTEM = {system}; read are UTC, {', '.join(_SINCE_TAI)}: convert")
    return Instant(mjd, seconds - _SINCE_TAI[system])


def _finished(draft: _Draft) -> Block:
    if not draft.times:
        _fail(draft.line, "the segment that begins here has no ephemeris lines")
    states = np.array(draft.states) * 1e3
    return Block(
        line=draft.line,
        lines=tuple(draft.lines),
        header=draft.header,
        times=tuple(draft.times),
        position=states[:, :3],
        velocity=states[:, 3:],
    )


def _fail(number: int, message: str) -> NoReturn:
    raise ValueError(f"OEM line {number}: {message}")
