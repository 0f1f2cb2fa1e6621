"""Moments in time: seconds since a UTC epoch, as the uniform time scale TAI.

A moment is a day number and a fraction, so that microseconds survive beside decades. Seconds are
SI seconds: a leap second between the epoch and a time counts as any other.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from functools import cache
from typing import Final, NamedTuple

import erfa
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

DAY: Final = 86_400.0
"""Length of a day [s]."""

TT_MINUS_TAI: Final = 32.184
"""Offset of terrestrial time, by definition [s]."""

GPS_MINUS_TAI: Final = -19.0
"""Offset of GPS time, by definition [s]."""

MJD_ZERO: Final = 2_400_000.5
"""Julian date of modified Julian day 0."""

MJD_EPOCH: Final = datetime(1858, 11, 17, tzinfo=UTC)
"""Moment of modified Julian day 0 (UTC)."""

_FIRST_YEAR: Final = 1972  # since then, UTC differs from TAI by whole seconds


class Moments(NamedTuple):
    """Moments of TAI.

    Attributes
    ----------
    day : scalar — modified Julian day, a whole number.
    fraction : (...) — days since then; may be negative or exceed one.
    """

    day: float
    fraction: Array

    def shifted(self, seconds: ArrayLike) -> Moments:
        """Moments that lie some seconds later, or the same ones on another uniform scale."""
        return Moments(self.day, self.fraction + np.asarray(seconds, dtype=np.float64) / DAY)

    @property
    def mjd(self) -> Array:
        """Modified Julian dates in one number, good to a microsecond."""
        return self.day + self.fraction


def as_utc(epoch: datetime) -> datetime:
    """Epoch in UTC.

    Parameters
    ----------
    epoch : moment with a time zone, 1972 or later.

    Raises
    ------
    ValueError
        If it has no time zone, or lies before 1972, when seconds of UTC were not SI seconds.
    """
    if epoch.tzinfo is None:
        raise ValueError(
            f"epoch = {epoch.isoformat()} has no time zone; give UTC, for instance "
            f"{epoch.isoformat()}Z"
        )
    if epoch.year < _FIRST_YEAR:
        raise ValueError(
            f"epoch = {epoch.isoformat()} lies before {_FIRST_YEAR}, when UTC had no SI seconds; "
            "give a later epoch"
        )
    return epoch.astimezone(UTC)


def moments(epoch: datetime, times: ArrayLike = 0.0) -> Moments:
    """Moments given by times since an epoch.

    Parameters
    ----------
    epoch : UTC, with a time zone.
    times : (...) — SI seconds since the epoch [s].
    """
    since = as_utc(epoch) - MJD_EPOCH
    seconds = since.seconds + since.microseconds * 1e-6 + float(tai_minus_utc(since.days))
    return Moments(float(since.days), (seconds + np.asarray(times, dtype=np.float64)) / DAY)


def seconds_between(start: datetime, stop: datetime) -> float:
    """SI seconds from one UTC epoch to another, leap seconds counted [s]."""
    first, last = moments(start), moments(stop)
    return float(last.day - first.day + last.fraction - first.fraction) * DAY


def utc_of(day: int, seconds: float) -> datetime:
    """UTC of a moment of TAI, rounded to a microsecond.

    Parameters
    ----------
    day : modified Julian day of TAI.
    seconds : scalar — since the beginning of that day [s].
    """
    late = float(tai_minus_utc(day + seconds / DAY))  # looked up half a minute too late
    utc = seconds - float(tai_minus_utc(day + (seconds - late) / DAY))
    return MJD_EPOCH + timedelta(days=day, microseconds=round(utc * 1e6))


def tai_minus_utc(mjd_utc: ArrayLike) -> Array:
    """Seconds by which TAI leads UTC.

    Parameters
    ----------
    mjd_utc : (...) — modified Julian dates, 1972 or later; after the last leap second announced
        none is foreseen.

    Returns
    -------
    (...) — whole seconds [s].
    """
    starts, offsets = _leap_seconds()
    index = np.searchsorted(starts, np.asarray(mjd_utc, dtype=np.float64), side="right") - 1
    return offsets[np.maximum(index, 0)]


@cache
def _leap_seconds() -> tuple[Array, Array]:
    """Days from which each offset holds, and the offsets [s]."""
    # Looked up here because erfa's own conversion warns of any date a few years ahead.
    table = erfa.leap_seconds.get()
    table = table[table["year"] >= _FIRST_YEAR]
    days = [
        (datetime(int(row["year"]), int(row["month"]), 1, tzinfo=UTC) - MJD_EPOCH).days
        for row in table
    ]
    return np.array(days, dtype=np.float64), np.array(table["tai_utc"], dtype=np.float64)
