"""What a user must know of an observation before relying on it."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta
from typing import Protocol

from formation.earth_orientation import Coverage, orientation_coverage, orientation_span

from ...scene import Scene
from .observation import Observation

NEARLY_CIRCULAR = 0.005
"""Eccentricity up to which relative motion about a circle is right to 1.5 % of its size."""

FRESH_TWO_LINES = timedelta(days=14)
"""Age up to which two-line elements place a satellite to 40 km, 5 s of flight."""

FRESH_ELEMENTS = timedelta(days=365)
"""Age up to which Keplerian elements, which leave out drag, are taken without a word."""


class Flown(Protocol):
    """What is seen from an orbit, of targets or of one place."""

    @property
    def scene(self) -> Scene:
        """The segments, in order of time."""
        ...

    @property
    def epoch(self) -> datetime:
        """UTC of the scene's time zero."""
        ...

    @property
    def orbit_source(self) -> str:
        """What the orbit is known from."""
        ...

    @property
    def orbit_epoch(self) -> datetime:
        """UTC of its elements."""
        ...

    @property
    def eccentricity(self) -> float:
        """Mean eccentricity of the orbit."""
        ...


def cautions(observation: Observation) -> tuple[str, ...]:
    """Warnings of an observation, one sentence or two each.

    Parameters
    ----------
    observation : of a formation study.
    """
    return (*_of_targets(observation), *orbit_cautions(observation))


def orbit_cautions(flown: Flown) -> tuple[str, ...]:
    """Warnings of the orbit alone, one sentence or two each.

    Parameters
    ----------
    flown : what is seen from the orbit.
    """
    return tuple(_of_orbit(flown))


def _of_targets(observation: Observation) -> Iterator[str]:
    """Warning of targets that are not seen."""
    missed = len(observation.missed_reasons)
    if missed:
        total = missed + len(observation.scene)
        yield (
            f"The pass sees {len(observation.scene)} of {total} targets: the height error is that "
            "of these. Widen the strip's incidences, or choose another pass or side."
        )


def _of_orbit(flown: Flown) -> Iterator[str]:
    last = flown.epoch + timedelta(seconds=float(flown.scene.times[-1]))
    yield from dated_cautions(flown.orbit_source, flown.orbit_epoch, first=flown.epoch, last=last)
    if flown.eccentricity > NEARLY_CIRCULAR:
        yield (
            f"The orbit has an eccentricity of {flown.eccentricity:.3g}, and the satellites "
            "move about a circle: relative positions, right at the epoch, are wrong by up to "
            f"{300 * flown.eccentricity:.2g} % of their size within a revolution."
        )


def dated_cautions(
    source: str, elements: datetime, *, first: datetime, last: datetime, what: str = "The pass"
) -> Iterator[str]:
    """Warnings of an orbit that is used on a date for which it is not good.

    Parameters
    ----------
    source : what the orbit is known from.
    elements : UTC of its elements, or of the beginning of its ephemeris.
    first, last : UTC between which it is used.
    what : uses it.

    Yields
    ------
    One sentence or two each: on the age of the elements, and on a date beyond the table of the
    Earth's rotation.
    """
    yield from _of_age(source, elements, first, what)
    if orientation_coverage(first, last) is Coverage.HELD:
        span = orientation_span()
        yield (
            f"The table of the Earth's rotation covers {span.first:%Y-%m-%d} to "
            f"{span.last_predicted:%Y-%m-%d}, and {what[:1].lower()}{what[1:]} is on "
            f"{first:%Y-%m-%d}: the ground track may be off by 0.1 km within a year and 1 km "
            "within five. A newer astropy-iers-data mends it."
        )


def _of_age(source: str, elements: datetime, first: datetime, what: str) -> Iterator[str]:
    """Warnings of elements that are far from the date on which they are used."""
    age = first - elements
    far = f"{what} is {abs(age).days} days {'after' if age > timedelta(0) else 'before'}"
    if source.startswith("two-line elements") and abs(age) > FRESH_TWO_LINES:
        yield (
            f"{far} the epoch of the {source}: the satellite may be {abs(age).days} to "
            f"{3 * abs(age).days} km from there along its orbit, and more if it maneuvers. Take "
            "elements of a date nearer to the pass."
        )
    if "elements" in source and not source.startswith("two-line") and abs(age) > FRESH_ELEMENTS:
        yield (
            f"{far} the epoch of the {source}: drag is left out, so that a low satellite will be "
            "elsewhere on its orbit, and on another pass, unless it is kept on station. Give "
            "elements of a date nearer to the pass."
        )
