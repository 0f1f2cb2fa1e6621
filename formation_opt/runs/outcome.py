"""What a run is given, and what it hands back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from formation import Orbit
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from optimize import GenerationRecord, Keeper


@dataclass(frozen=True, kw_only=True)
class Options:
    """What the command line adds to a study.

    Attributes
    ----------
    seed : of the random generator; that of the study if None.
    on_start : called with the number of generations to come.
    on_generation : called after each.
    should_stop : whether the user asked to stop.
    keeper : given the seed, and whether compiled loops score the formations, what keeps the steps
        of a search; None keeps nothing.
    """

    seed: int | None = None
    on_start: Callable[[int], None] = lambda _: None
    on_generation: Callable[[GenerationRecord], None] = lambda _: None
    should_stop: Callable[[], bool] = lambda: False
    keeper: Callable[[int, bool], Keeper] | None = None


class Summary(NamedTuple):
    """The compact table that the terminal shows.

    Attributes
    ----------
    headings : of the columns, the one that matters last.
    rows : a label, and a value for each column.
    warnings : what must be read before the numbers are believed.
    """

    headings: tuple[str, ...]
    rows: tuple[tuple[str, tuple[str, ...]], ...]
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a run found.

    Attributes
    ----------
    result : for `reports.write_report`.
    summary : for the terminal.
    evaluations : formations scored; 0 where none are.
    compiled : whether compiled loops scored them; None where nothing is searched.
    seed : that was used; None where nothing is random.
    orbit : the reference orbit; None where the study has several, or none.
    observation : where the scene comes from; None if it was given.
    blocked : None, or what keeps every design from being feasible, in words.
    interrupted : whether the run was stopped before its end.
    """

    result: object
    summary: Summary
    evaluations: int = 0
    compiled: bool | None = None
    seed: int | None = None
    orbit: Orbit | None = None
    observation: Observation | StaringScene | None = None
    blocked: str | None = None
    interrupted: bool = False
