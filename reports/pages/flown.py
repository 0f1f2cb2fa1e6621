"""The orbit from which a scene is seen, of targets or of one place."""

from __future__ import annotations

from insar.observe import Observation
from insar.observe.agile.staring import StaringScene

from ..document import Block, Callout, Paragraph, Status
from ..wording import fixed, moment_text, percent

Flown = Observation | StaringScene

_AT_THE_PASS = 0.002
"""Age that is none, some three minutes [days]."""

_ECCENTRIC = 0.01
"""Eccentricity from which the circular reference orbit is a warning, not a remark."""


def orbit_rows(flown: Flown) -> list[tuple[str, str]]:
    """What the orbit is known from, and how old that is at the pass."""
    epoch = f"{moment_text(flown.orbit_epoch)} UTC, {_age(flown)}"
    return [("orbit from", flown.orbit_source), ("epoch of the orbit", epoch)]


def _age(flown: Flown) -> str:
    days = (flown.epoch - flown.orbit_epoch).total_seconds() / 86400.0
    side = "before" if days >= 0.0 else "after"
    if abs(days) < _AT_THE_PASS:
        return "at the pass"
    if abs(days) < 1.0:
        return f"{fixed(24.0 * abs(days), 1)} hours {side} the pass"
    return f"{fixed(abs(days), 1)} days {side} the pass"


def eccentricity_block(eccentricity: float) -> Block:
    """What the circular reference orbit of the relative motion leaves out."""
    text = (
        f"The orbit has a mean eccentricity of {fixed(eccentricity, 5)}. The geometry is that of "
        "the orbit as it is, but the satellites move relative to each other as about a circle of "
        "the same mean semi-major axis (Clohessy-Wiltshire): right at the epoch, relative "
        f"positions are wrong by up to {percent(3.0 * eccentricity)} of their size within a "
        "revolution."
    )
    if eccentricity < _ECCENTRIC:
        return Paragraph(text)
    return Callout(Status.WARNING, "The reference orbit is not a circle", (text,))
