"""What a study may say: its schema, reading it, building what it describes, and the examples.

Loading needs neither scipy nor DEAP. `configs.build` does, and is imported by what runs a study.
"""

from __future__ import annotations

from .examples import example_names, example_path, example_text
from .files import InputFile
from .loader import LoadedStudy, effective_text, load_study
from .messages import BuildError, StudyError
from .studies import (
    STUDIES,
    EvaluateStudy,
    OptimizeStudy,
    SteeringStudy,
    Study,
    json_schema,
)

__all__ = [
    "STUDIES",
    "BuildError",
    "EvaluateStudy",
    "InputFile",
    "LoadedStudy",
    "OptimizeStudy",
    "SteeringStudy",
    "Study",
    "StudyError",
    "effective_text",
    "example_names",
    "example_path",
    "example_text",
    "json_schema",
    "load_study",
]
