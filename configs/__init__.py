"""What a study may say: its schema, reading it, building what it describes, and the examples.

Loading needs neither scipy nor DEAP; `configs.build` does, and is imported on first use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .examples import example_names, example_path, example_text
from .loader import LoadedStudy, load_study
from .messages import StudyError
from .studies import STUDIES, EvaluateStudy, OptimizeStudy, Study, json_schema

if TYPE_CHECKING:
    from .build import (
        EvaluateSetup,
        NamedStates,
        OptimizeSetup,
        build_evaluate,
        build_optimize,
    )

_BUILD = ("EvaluateSetup", "NamedStates", "OptimizeSetup", "build_evaluate", "build_optimize")

__all__ = [
    "STUDIES",
    "EvaluateSetup",
    "EvaluateStudy",
    "LoadedStudy",
    "NamedStates",
    "OptimizeSetup",
    "OptimizeStudy",
    "Study",
    "StudyError",
    "build_evaluate",
    "build_optimize",
    "example_names",
    "example_path",
    "example_text",
    "json_schema",
    "load_study",
]


def __getattr__(name: str) -> Any:
    if name in _BUILD:
        from . import build

        return getattr(build, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
