"""The kinds of study: what is built and what runs for each.

A new kind is a builder in `configs`, a module in `runs`, and a line here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from configs.build import build_evaluate, build_optimize
from configs.steered import build_steering

from .runs import Options, Outcome, evaluate, optimize, steering


class Kind(NamedTuple):
    """What happens to a study of one kind.

    Attributes
    ----------
    build : study → what it is computed with; raises `configs.BuildError` for a study that makes no
        sense, such as a target that is never seen.
    run : study, what was built, options → outcome.
    """

    build: Callable[[Any], Any]
    run: Callable[[Any, Any, Options], Outcome]


KINDS: dict[str, Kind] = {
    "optimize": Kind(build_optimize, optimize.run),
    "evaluate": Kind(build_evaluate, evaluate.run),
    "steering": Kind(build_steering, steering.run),
}
