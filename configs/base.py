"""What every block of a study has in common, and the types of its values."""

from __future__ import annotations

import unicodedata
from typing import Annotated

from pydantic import AfterValidator, AllowInfNan, BaseModel, ConfigDict, Field, Strict
from pydantic_core import PydanticCustomError

from .messages import KeyPath

CROSS_CHECK = "cross_check"
"""Type of the errors raised by `wrong`: their text is complete."""


class Block(BaseModel):
    """A block of keys: unknown ones are refused, values never change."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def wrong(at: KeyPath, text: str, remedy: str) -> PydanticCustomError:
    """Error of a check across keys.

    Parameters
    ----------
    at : path of the value to blame, from the block that is checked.
    text : what is wrong and the limit; follows "key = value" in the message.
    remedy : what to do.
    """
    return PydanticCustomError(
        CROSS_CHECK, "{text}; {remedy}", {"at": at, "text": text, "remedy": remedy}
    )


def _without_control_characters(text: str) -> str:
    if any(unicodedata.category(character) == "Cc" for character in text if character != "\n"):
        raise wrong((), "holds a control character", "remove it")
    return text


Number = Annotated[float, Strict(), AllowInfNan(False)]
"""A finite number; neither text nor true/false."""

Whole = Annotated[int, Strict()]
"""A whole number, written without a decimal point."""

_ONE_LINE = r"^\S(.*\S)?$"

StudyName = Annotated[str, Strict(), Field(max_length=64, pattern=r"^\w([\w.-]*\w)?$")]
"""Name of a study, which can also be that of a folder."""

Name = Annotated[
    str,
    Strict(),
    Field(min_length=1, max_length=40, pattern=_ONE_LINE),
    AfterValidator(_without_control_characters),
]
"""Name of a satellite, on one line."""

Label = Annotated[
    str,
    Strict(),
    Field(min_length=1, max_length=80, pattern=_ONE_LINE),
    AfterValidator(_without_control_characters),
]
"""Short text on one line."""

Prose = Annotated[
    str, Strict(), Field(max_length=4000), AfterValidator(_without_control_characters)
]
"""Text of some sentences."""
