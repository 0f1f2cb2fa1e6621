"""What a run is given, and what it hands back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from formation import Orbit
from optimize import Assessment, GenerationRecord


@dataclass(frozen=True, kw_only=True)
class Options:
    """What the command line adds to a study.

    Attributes
    ----------
    seed : of the random generator; that of the study if None.
    on_start : called with the number of generations to come.
    on_generation : called after each.
    should_stop : whether the user asked to stop.
    """

    seed: int | None = None
    on_start: Callable[[int], None] = lambda _: None
    on_generation: Callable[[GenerationRecord], None] = lambda _: None
    should_stop: Callable[[], bool] = lambda: False


class Outcome(NamedTuple):
    """What a run found.

    Attributes
    ----------
    result : for `reports.write_report`.
    orbit : the reference orbit.
    seed : that was used; None where nothing is random.
    evaluations : formations scored.
    shown : the formations that the terminal shows, the one that matters last.
    blocked : None, or what keeps every design from being feasible, in words.
    interrupted : whether the run was stopped before its end.
    """

    result: object
    orbit: Orbit
    seed: int | None
    evaluations: int
    shown: tuple[Assessment, ...]
    blocked: str | None = None
    interrupted: bool = False
