"""The kinds of study: what is built and what runs for each.

A new kind is a builder in `configs`, a module in `runs`, and a line here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from configs.build import build_evaluate, build_optimize
from configs.covered import build_coverage
from configs.simulated import build_simulate
from configs.staring import build_spotlight, build_video
from configs.steered import build_steering

from .runs import (
    Options,
    Outcome,
    coverage,
    evaluate,
    optimize,
    simulate,
    spotlight,
    steering,
    video,
)


class Kind(NamedTuple):
    """What happens to a study of one kind.

    Attributes
    ----------
    build : study → what it is computed with; raises `configs.BuildError` for a study that makes no
        sense, such as a target that is never seen.
    run : study, what was built, options → outcome.
    searches : whether the run searches, and can go on with a search that was stopped.
    """

    build: Callable[[Any], Any]
    run: Callable[[Any, Any, Options], Outcome]
    searches: bool = False


KINDS: dict[str, Kind] = {
    "optimize": Kind(build_optimize, optimize.run, searches=True),
    "evaluate": Kind(build_evaluate, evaluate.run),
    "steering": Kind(build_steering, steering.run),
    "spotlight": Kind(build_spotlight, spotlight.run),
    "video": Kind(build_video, video.run),
    "coverage": Kind(build_coverage, coverage.run),
    "simulate": Kind(build_simulate, simulate.run),
}
