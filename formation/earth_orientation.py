"""Orientation of the Earth that no theory predicts: UT1 and the motion of the pole.

The values are those of IERS's file finals2000A in the copy that the package astropy-iers-data
ships: measured ones from 1973 on, and a year of predictions after its date of release. Nothing is
downloaded. Beyond the table its last values are held. What that costs is in docs/orbits.md.
"""

from __future__ import annotations

from datetime import datetime, timedelta
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .timescales import DAY, MJD_EPOCH, Moments, as_utc, tai_minus_utc

Array = NDArray[np.float64]

_ARCSECOND: Final = np.pi / 648_000.0


class Coverage(StrEnum):
    """How the Earth's orientation is known over a stretch of time, from best to worst."""

    MEASURED = "measured"
    PREDICTED = "predicted"
    HELD = "held"


class EarthOrientation(NamedTuple):
    """Orientation parameters and their rates.

    Attributes
    ----------
    ut1_minus_tai : (...) [s]; its rate is 1e-8 or less.
    pole_x, pole_y : (...) — coordinates of the celestial intermediate pole in the ITRS [rad].
    ut1_rate : (...) — of ut1_minus_tai [s/s].
    pole_x_rate, pole_y_rate : (...) [rad/s].
    """

    ut1_minus_tai: Array
    pole_x: Array
    pole_y: Array
    ut1_rate: Array
    pole_x_rate: Array
    pole_y_rate: Array


class OrientationSpan(NamedTuple):
    """What the shipped table covers (UTC)."""

    first: datetime
    last_measured: datetime
    last_predicted: datetime


def earth_orientation(at: Moments) -> EarthOrientation:
    """Orientation parameters at given moments, by a cubic spline through the daily values.

    Notes
    -----
    Tides with periods of a day and less are left out, as they are in the table: up to 3 cm at the
    radius of a low orbit.
    """
    table = _table()
    days = np.clip(at.mjd, table.spline.x[0], table.spline.x[-1])
    inside = days == at.mjd
    values = np.moveaxis(table.spline(days), -1, 0)
    rates = np.moveaxis(table.spline(days, 1), -1, 0) * (inside / DAY)
    return EarthOrientation(*values, *rates)


def orientation_span() -> OrientationSpan:
    """Dates between which the shipped table measures and predicts the Earth's orientation."""
    table = _table()
    days = (table.first, table.last_measured, table.last_predicted)
    return OrientationSpan(*(MJD_EPOCH + timedelta(days=day) for day in days))


def orientation_coverage(start: datetime, stop: datetime) -> Coverage:
    """Worst way in which the orientation is known between two moments.

    Parameters
    ----------
    start, stop : UTC, with a time zone.
    """
    span = orientation_span()
    if as_utc(start) < span.first or as_utc(stop) > span.last_predicted:
        return Coverage.HELD
    return Coverage.MEASURED if as_utc(stop) <= span.last_measured else Coverage.PREDICTED


class _Table(NamedTuple):
    spline: Any  # scipy's CubicSpline over days of TAI, with 3 columns
    first: int
    last_measured: int
    last_predicted: int


@cache
def _table() -> _Table:
    # Both take longer to import than the rest of this package together.
    from astropy_iers_data import IERS_A_FILE
    from scipy.interpolate import CubicSpline

    lines = Path(IERS_A_FILE).read_text(encoding="ascii").splitlines()
    # The last lines of the file are dates without values. Columns: readme of finals2000A.
    rows = [line for line in lines if line[16] in "IP" and line[57] in "IP"]
    days, x, y, ut1_minus_utc = (
        np.array([float(row[cut]) for row in rows])
        for cut in (slice(7, 15), slice(18, 27), slice(37, 46), slice(58, 68))
    )
    offset = tai_minus_utc(days)
    columns = [ut1_minus_utc - offset, x * _ARCSECOND, y * _ARCSECOND]
    measured = [day for row, day in zip(rows, days, strict=True) if row[16] + row[57] == "II"]
    return _Table(
        CubicSpline(days + offset / DAY, np.stack(columns, axis=-1)),
        int(days[0]),
        int(measured[-1]),
        int(days[-1]),
    )
