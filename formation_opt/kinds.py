"""The kinds of study: what runs for each. A new kind is a module in `runs` and a line here."""

from __future__ import annotations

from collections.abc import Callable

from .runs import Options, Outcome, evaluate, optimize

RUNS: dict[str, Callable[..., Outcome]] = {
    "optimize": optimize.run,
    "evaluate": evaluate.run,
}

__all__ = ["RUNS", "Options", "Outcome"]
