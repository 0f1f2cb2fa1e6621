"""The items of the coherence budget, each of which can be changed alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from insar import CoherenceBudget
from insar.coherence import AnyVolume, PenetratedVolume, ProfileVolume

from .problem import Problem

Change = tuple[str, str, float, int, Callable[[float], Problem]]
"""Name, unit, value, which way is better, and the problem with the item multiplied by a factor."""

_MOST_BITS = 8

_A_LITTLE = 1e-6
"""Of a bit: what rounding may lack of a whole number."""


def coherence_changes(problem: Problem) -> list[Change]:
    """Items of the coherence budget; what is zero is not there.

    Parameters
    ----------
    problem : scene, radar, errors and limits.

    Returns
    -------
    Ambiguities, co-registration, losses (1 − coherence) by processing and by what the budget does
    not name, volume and time. Of a number that depends on the segment the largest is the value, and
    all of them are multiplied. Backscatter and NESZ are in the signal-to-noise ratio already.
    """
    budget, radar = problem.errors.coherence, problem.radar

    def with_budget(**changes: object) -> Problem:
        changed = replace(budget, **changes)  # type: ignore[arg-type]
        return replace(problem, errors=replace(problem.errors, coherence=changed))

    def scaled(name: str) -> Callable[[float], Problem]:
        return lambda f: with_budget(**{name: _times(f, getattr(budget, name))})

    loss, unnamed = 1.0 - budget.processing, 1.0 - radar.other_coherence
    changes: list[Change] = [
        ("rasr", "", _largest(budget.rasr), -1, scaled("rasr")),
        ("aasr", "", _largest(budget.aasr), -1, scaled("aasr")),
        ("range_shift", "", budget.range_shift, -1, scaled("range_shift")),
        ("azimuth_shift", "", budget.azimuth_shift, -1, scaled("azimuth_shift")),
        ("processing_loss", "", loss, -1, lambda f: with_budget(processing=1.0 - f * loss)),
        (
            "other_loss",
            "",
            unnamed,
            -1,
            lambda f: replace(problem, radar=replace(radar, other_coherence=1.0 - f * unnamed)),
        ),
    ]
    volume = budget.volume
    if volume is not None:
        changes.append(
            (
                "volume_height",
                "m",
                _height(volume),
                -1,
                lambda f: with_budget(volume=_stretched(volume, f)),
            )
        )
    temporal = budget.temporal
    if temporal is not None:
        constant = temporal.time_constant
        changes.append(
            (
                "time_constant",
                "s",
                constant,
                1,
                lambda f: with_budget(temporal=replace(temporal, time_constant=f * constant)),
            )
        )
    return changes


def quantization_change(problem: Problem) -> Change | None:
    """Bits of the raw data, of which there are only whole ones; None where they are neglected.

    Parameters
    ----------
    problem : scene, radar, errors and limits.

    Returns
    -------
    A fraction of a bit is none, and more than 8 are 8: they leave nothing to gain.
    """
    budget: CoherenceBudget = problem.errors.coherence
    bits = budget.quantization_bits
    if bits is None:
        return None

    def changed(factor: float) -> Problem:
        whole = min(_MOST_BITS, max(1, int(factor * bits + _A_LITTLE)))
        coherence = replace(budget, quantization_bits=whole)
        return replace(problem, errors=replace(problem.errors, coherence=coherence))

    return ("quantization_bits", "", float(bits), 1, changed)


def _times(factor: float, value: float | tuple[float, ...]) -> float | tuple[float, ...]:
    if isinstance(value, tuple):
        return tuple(factor * one for one in value)
    return factor * value


def _largest(value: float | tuple[float, ...]) -> float:
    return max(value) if isinstance(value, tuple) else value


def _height(volume: AnyVolume) -> float:
    if isinstance(volume, ProfileVolume):
        return max(volume.heights) - min(volume.heights)
    return volume.depth if isinstance(volume, PenetratedVolume) else volume.height


def _stretched(volume: AnyVolume, factor: float) -> AnyVolume:
    """The same profile with its heights multiplied, its extinction as it is."""
    if isinstance(volume, ProfileVolume):
        return replace(volume, heights=tuple(factor * height for height in volume.heights))
    if isinstance(volume, PenetratedVolume):
        return replace(volume, depth=factor * volume.depth)
    return replace(volume, height=factor * volume.height)
