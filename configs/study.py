"""What every study says."""

from __future__ import annotations

from pydantic import Field

from .base import Block, Prose, StudyName


class Study(Block):
    """What every study says."""

    kind: str = Field(description="What the study does.")
    name: StudyName = Field(
        default="study",
        description="Name in the report and of the output folder: letters, digits, '.', '-' and "
        "'_'; the name of the file if absent.",
    )
    description: Prose = Field(default="", description="What the study is for, in words.")
