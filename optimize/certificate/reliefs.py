"""What, eased alone, would let a formation pass: limits and errors, each by bisection."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from ..design_space import DesignSpace
from ..problem import Problem
from .result import Relief

_STEPS = 8
"""Bisections of the value at which something no longer blocks."""

_FARTHEST = 32.0
"""Factor by which a limit or an error is eased at most."""

_FARTHEST_RADIUS = 8.0
"""The same of the radius: beyond, the baselines that cohere are a small part of the disc."""

Verdict = Callable[[Problem, DesignSpace], bool | None]
"""Whether a formation that exists passes; False if it is proved that none does, None if unknown."""


class Candidate(NamedTuple):
    """A limit or an error of a study that may be eased.

    Attributes
    ----------
    name, unit, value : in words, of its values (empty for a ratio), as the study has it.
    farthest : factor by which it is eased at most.
    value_at : its value eased by a factor.
    eased : problem and designs with a value.
    """

    name: str
    unit: str
    value: float
    farthest: float
    value_at: Callable[[float], float]
    eased: Callable[[float], tuple[Problem, DesignSpace]]


def reliefs(problem: Problem, space: DesignSpace, verdict: Verdict) -> tuple[Relief, ...]:
    """Ease every limit and error that the trees count on, each alone.

    Parameters
    ----------
    problem : the problem, in which nothing passes.
    space : the designs.
    verdict : whether something passes in an eased one.

    Returns
    -------
    Those that help, with the value to which each is proved to block, and one at which it doesn't.
    """
    found = (_relief(candidate, verdict) for candidate in _candidates(problem, space))
    return tuple(relief for relief in found if relief is not None)


def _candidates(problem: Problem, space: DesignSpace) -> list[Candidate]:
    return [
        *_of_unwrapping(problem, space),
        *_of_places(problem, space),
        *_of_errors(problem, space),
    ]


def _of_unwrapping(problem: Problem, space: DesignSpace) -> list[Candidate]:
    limits = problem.constraints
    prior, probability = limits.prior_height_std, limits.min_unwrapping_probability
    if prior is None or probability is None:
        return []
    return [
        Candidate(
            "standard deviation of the prior height",
            "m",
            prior,
            _FARTHEST,
            lambda factor: prior / factor,
            lambda value: (_limited(problem, prior_height_std=value), space),
        ),
        Candidate(
            "probability of unwrapping",
            "",
            probability,
            _FARTHEST,
            lambda factor: 1.0 - min(1.0 - 1e-9, (1.0 - probability) * factor),
            lambda value: (_limited(problem, min_unwrapping_probability=value), space),
        ),
    ]


def _of_places(problem: Problem, space: DesignSpace) -> list[Candidate]:
    limits = problem.constraints
    found: list[Candidate] = []
    fraction = limits.max_baseline_fraction
    if fraction is not None:
        found.append(
            Candidate(
                "perpendicular over critical baseline",
                "",
                fraction,
                _FARTHEST,
                lambda factor: fraction * factor,
                lambda value: (_limited(problem, max_baseline_fraction=value), space),
            )
        )
    radius = limits.max_radius
    if radius is not None and limits.max_offset is None and limits.max_rate is None:
        found.append(
            Candidate(
                "radius of each relative orbit",
                "m",
                radius,
                _FARTHEST_RADIUS,
                lambda factor: radius * factor,
                lambda value: (_limited(problem, max_radius=value), _wider(space, value / radius)),
            )
        )
    return found


def _of_errors(problem: Problem, space: DesignSpace) -> list[Candidate]:
    errors, position = problem.errors, problem.errors.position
    if position.std == 0.0:
        return []
    return [
        Candidate(
            "position error",
            "m",
            position.std,
            _FARTHEST,
            lambda factor: position.std / factor,
            lambda value: (
                replace(problem, errors=replace(errors, position=position._replace(std=value))),
                space,
            ),
        )
    ]


def _limited(problem: Problem, **limits: float) -> Problem:
    return replace(problem, constraints=replace(problem.constraints, **limits))


def _wider(space: DesignSpace, factor: float) -> DesignSpace:
    return replace(space, max_offset=space.max_offset * factor, max_rate=space.max_rate * factor)


def _relief(candidate: Candidate, verdict: Verdict) -> Relief | None:
    """Bisect a candidate; None where easing it alone does not help."""

    def passes_at(factor: float) -> bool | None:
        return verdict(*candidate.eased(candidate.value_at(factor)))

    if passes_at(candidate.farthest) is not True:
        return None
    blocks, passes = 1.0, candidate.farthest
    low, high = 0.0, math.log(candidate.farthest)
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        outcome = passes_at(math.exp(middle))
        if outcome is True:
            high, passes = middle, math.exp(middle)
        else:
            low = middle
            if outcome is False:
                blocks = math.exp(middle)
    value_at = candidate.value_at
    return Relief(
        candidate.name, candidate.unit, candidate.value, value_at(blocks), value_at(passes)
    )
