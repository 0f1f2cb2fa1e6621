"""What every block of a study has in common, and the types of its values."""

from __future__ import annotations

import unicodedata
from datetime import UTC, datetime
from typing import Annotated

from pydantic import AfterValidator, AllowInfNan, BaseModel, ConfigDict, Field, Strict
from pydantic_core import PydanticCustomError

from .messages import KeyPath, printable

CROSS_CHECK = "cross_check"
"""Type of the errors raised by `wrong`: their text is complete."""


MISSING_KEY = "missing_key"
"""Type of the errors raised by `missing`."""


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


def refused(at: KeyPath, error: ValueError) -> PydanticCustomError:
    """Error of a value that what computes with it refuses.

    Parameters
    ----------
    at : path of the value to blame, from the block that is checked.
    error : what was said of it: "what is wrong; remedy".
    """
    text, _, remedy = printable(" ".join(str(error).split())).partition("; ")
    return wrong(at, f"cannot be used: {text}", remedy or "correct it")


def missing(key: str) -> PydanticCustomError:
    """Error of a check across keys: this one is needed because of the others.

    Parameters
    ----------
    key : of the block that is checked.
    """
    return PydanticCustomError(MISSING_KEY, "{key} is missing", {"key": key})


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


_MOMENT = r"^\d{4}-\d{2}-\d{2}([T ]\d{2}:\d{2}(:\d{2}(\.\d{1,6})?)?Z?)?$"
_FIRST_YEAR, _LAST_YEAR = 1972, 2099


def utc(text: str) -> datetime:
    """The moment that a `Moment` stands for."""
    return datetime.fromisoformat(text).replace(tzinfo=UTC)


def _an_existing_moment(text: str) -> str:
    try:
        year = utc(text).year
    except ValueError as error:
        raise wrong((), f"does not exist ({error})", "correct the date or the time") from None
    if not _FIRST_YEAR <= year <= _LAST_YEAR:
        raise wrong(
            (),
            f"lies outside the years {_FIRST_YEAR} to {_LAST_YEAR}: before them UTC had no SI "
            "seconds, and after them nobody knows how the Earth has turned",
            "correct the year",
        )
    return text


Moment = Annotated[
    str,
    Strict(),
    Field(max_length=30, pattern=_MOMENT, examples=["2026-11-23T05:07:00Z"]),
    AfterValidator(_an_existing_moment),
]
"""A moment in UTC, as ISO 8601 writes it; see `utc`."""

TimeOfDay = Annotated[
    str,
    Strict(),
    Field(pattern=r"^([01]\d|2[0-3]):[0-5]\d(:[0-5]\d)?$", examples=["18:00"]),
]
"""A time of the day, hours and minutes."""
