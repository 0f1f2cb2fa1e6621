"""Files that a study names: orbits and areas that others made."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from .base import wrong
from .messages import did_you_mean, printable
from .texts import NotTextError, decode

MAX_FILE_BYTES = 5_000_000
MAX_BINARY_BYTES = 400_000_000

SHIPPED = ("areas", "orbits")
"""Folders of this package in which a file is looked for that is not beside the study."""

_MAX_NAME = 300


@dataclass(frozen=True)
class InputFile:
    """A file that a study names, with its content.

    Attributes
    ----------
    name : as the study writes it.
    sha256 : hexadecimal digest of its bytes.
    text : its content; empty for a file that is not text.
    content : its bytes; empty for a text.
    """

    name: str
    sha256: str
    text: str = field(repr=False, compare=False)
    content: bytes = field(default=b"", repr=False, compare=False)


def _open_binary(value: Any, info: ValidationInfo) -> InputFile:
    if isinstance(value, InputFile):
        return value
    if not isinstance(value, str) or not 0 < len(value) <= _MAX_NAME:
        raise PydanticCustomError("string_type", "must be the name of a file")
    folder = Path((info.context or {}).get("folder", "."))
    content = _read(_find(value, folder), limit=MAX_BINARY_BYTES)
    return InputFile(value, hashlib.sha256(content).hexdigest(), "", content)


def _open(value: Any, info: ValidationInfo) -> InputFile:
    if isinstance(value, InputFile):
        return value
    if not isinstance(value, str) or not 0 < len(value) <= _MAX_NAME:
        raise PydanticCustomError("string_type", "must be the name of a file")
    content = _read(_find(value, Path((info.context or {}).get("folder", "."))))
    try:
        text = decode(content)
    except NotTextError as error:
        what, _, remedy = error.text.partition("; ")
        where = "" if error.mark is None else f"cannot be read in line {error.mark.line}: "
        raise wrong((), where + what, remedy) from None
    return InputFile(value, hashlib.sha256(content).hexdigest(), text)


def _find(name: str, folder: Path) -> Path:
    """The file beside the study, or the one of this name that comes with the package."""
    places = [folder / name]
    if Path(name).name == name:
        places += [Path(str(files(__package__) / shipped / name)) for shipped in SHIPPED]
    try:
        found = next((place for place in places if place.exists()), None)
        is_file = found is not None and found.is_file()
    except (OSError, ValueError) as error:
        raise _unreadable(error) from None
    if found is None:
        beside = f"a file beside the study, in {printable(str(folder.resolve()))}"
        # An area is no substitute for an orbit.
        shipped = [each for each in shipped_files() if Path(each).suffix == Path(name).suffix]
        raise wrong(
            (),
            f"is neither {beside}, nor one that comes with formation-opt ({', '.join(shipped)})"
            if shipped
            else f"is not {beside}",
            f"{did_you_mean(name, shipped)}write its path from the folder of the study",
        )
    if not is_file:
        raise wrong((), "is no file but a folder or a device", "name a file")
    return found


def shipped_files() -> tuple[str, ...]:
    """Names of the files that come with the package, in alphabetical order."""
    folders = (Path(str(files(__package__) / folder)) for folder in SHIPPED)
    return tuple(
        sorted(path.name for folder in folders if folder.is_dir() for path in folder.iterdir())
    )


def _read(path: Path, limit: int = MAX_FILE_BYTES) -> bytes:
    try:
        with path.open("rb") as stream:
            content = stream.read(limit + 1)
    except (OSError, ValueError) as error:
        raise _unreadable(error) from None
    if len(content) > limit:
        raise wrong(
            (),
            f"is larger than {limit // 1_000_000} MB, the limit for such a file",
            "cut it down to what the study needs",
        )
    return content


def _unreadable(error: Exception) -> PydanticCustomError:
    reason = getattr(error, "strerror", None) or str(error)
    return wrong((), f"cannot be read ({reason})", "check its name and its permissions")


def _name(file: InputFile) -> str:
    """As the study writes it: its content has a digest of its own."""
    return file.name


File = Annotated[
    InputFile,
    PlainValidator(_open),
    PlainSerializer(_name, return_type=str),
    WithJsonSchema({"type": "string", "minLength": 1, "maxLength": _MAX_NAME, "format": "path"}),
]
"""A file, named by its path from the folder of the study; its content is read with the study."""

BinaryFile = Annotated[
    InputFile,
    PlainValidator(_open_binary),
    PlainSerializer(_name, return_type=str),
    WithJsonSchema({"type": "string", "minLength": 1, "maxLength": _MAX_NAME, "format": "path"}),
]
"""A file that is not text, named likewise."""
