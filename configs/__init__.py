"""What a study may say: its schema, reading it, building what it describes, and the examples.

Loading needs neither scipy nor DEAP. `configs.build` does, and is imported by what runs a study.
"""

from __future__ import annotations

from .agile_studies import CoverageStudy, SpotlightStudy, VideoStudy
from .examples import example_names, example_path, example_text
from .files import InputFile
from .loader import LoadedStudy, effective_text, load_study
from .messages import BuildError, StudyError
from .simulate_study import SimulateStudy
from .studies import (
    STUDIES,
    EvaluateStudy,
    OptimizeStudy,
    SteeringStudy,
    json_schema,
)
from .study import SourcedStudy, Study

__all__ = [
    "STUDIES",
    "BuildError",
    "CoverageStudy",
    "EvaluateStudy",
    "InputFile",
    "LoadedStudy",
    "OptimizeStudy",
    "SimulateStudy",
    "SourcedStudy",
    "SpotlightStudy",
    "SteeringStudy",
    "Study",
    "StudyError",
    "VideoStudy",
    "effective_text",
    "example_names",
    "example_path",
    "example_text",
    "json_schema",
    "load_study",
]
