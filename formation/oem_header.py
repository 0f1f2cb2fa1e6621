"""What the header of an OEM segment says about its use: interval, interpolation, frame."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final, NamedTuple

import erfa
import numpy as np

from .frames import Rotation, gcrs_to_itrs, teme_to_gcrs, true_of_date_to_gcrs
from .oem_reader import Block, Instant
from .timescales import DAY, MJD_ZERO, Moments

DEFAULT_DEGREE: Final = 11
"""Degree of the Hermite polynomial where the message names no interpolation."""

_HIGHEST_DEGREE: Final = 25
_J2000: Final = 51_544.5  # modified Julian date


class Method(NamedTuple):
    """How to interpolate: through how many lines, and whether to meet their velocities."""

    points: int
    hermite: bool


def usable_interval(block: Block) -> tuple[Instant, Instant]:
    """First and last moment at which a segment may be used."""
    first = block.instant("USEABLE_START_TIME") or block.times[0]
    last = block.instant("USEABLE_STOP_TIME") or block.times[-1]
    return max(first, block.times[0], key=tai_seconds), min(last, block.times[-1], key=tai_seconds)


def tai_seconds(instant: Instant) -> float:
    """Seconds of TAI since modified Julian day 0, to compare moments by."""
    return instant.since(Instant(0, 0.0))


def interpolation_method(block: Block) -> Method:
    """Read the interpolation of a segment.

    Raises
    ------
    ValueError
        If it is neither Hermite's nor Lagrange's, or its degree is no number from 1 to 25.
    """
    method = block.header.get("INTERPOLATION", "HERMITE").upper()
    if method not in ("HERMITE", "LAGRANGE"):
        raise ValueError(
            f"OEM line {block.line}: INTERPOLATION = {method} is not known; state HERMITE or "
            "LAGRANGE, or leave it out"
        )
    stated = block.header.get("INTERPOLATION_DEGREE", "")
    if stated and not (stated.isdigit() and 1 <= int(stated) <= _HIGHEST_DEGREE):
        raise ValueError(
            f"OEM line {block.line}: INTERPOLATION_DEGREE = {stated} must be a whole number from "
            f"1 to {_HIGHEST_DEGREE}"
        )
    hermite = method == "HERMITE"
    degree = int(stated) if stated else min(DEFAULT_DEGREE, 2 * len(block.times) - 1)
    return Method((degree + 2) // 2 if hermite else degree + 1, hermite)


def frame_to_gcrs(block: Block) -> Callable[[Moments], Rotation]:
    """Read the frame of a segment as the turn from it into the GCRS.

    Raises
    ------
    ValueError
        If the frame is not known.
    """
    name = block.header["REF_FRAME"].upper()
    if re.fullmatch(r"ITRF?S?[-_]?\d*", name):
        return lambda at: gcrs_to_itrs(at).inverse()
    if name not in _FRAMES:
        raise ValueError(
            f"OEM line {block.line}: REF_FRAME = {name} is not known; read are "
            f"{', '.join(_FRAMES)} and ITRF with or without a year: convert the message"
        )
    turn = _FRAMES[name]
    fixed = block.instant("REF_FRAME_EPOCH")
    if fixed is None:
        return turn
    moment = Moments(fixed.day, np.array(fixed.seconds / DAY))
    return lambda at: Rotation(turn(moment).matrix, np.zeros((3, 3)))


def _celestial(at: Moments) -> Rotation:
    return Rotation(np.eye(3), np.zeros((3, 3)))


def _mean_of_2000(at: Moments) -> Rotation:
    """Frame bias between the mean equator and equinox of 2000 and the GCRS: 0.02 arcseconds."""
    bias, _, _ = erfa.bp06(MJD_ZERO, _J2000)
    return Rotation(np.asarray(bias).T, np.zeros((3, 3)))


_FRAMES: Final[dict[str, Callable[[Moments], Rotation]]] = {
    "EME2000": _mean_of_2000,
    "GCRF": _celestial,
    "ICRF": _celestial,
    "TEME": teme_to_gcrs,
    "TOD": true_of_date_to_gcrs,
}
