"""What the author of a wrong study reads: place, key, value, limit and remedy."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

KeyPath = tuple[str | int, ...]
"""Keys (text) and list positions (0-based) that lead to a value of a study."""

_SHOWN_LENGTH = 60


class StudyError(Exception):
    """A study that can't be used; the text is one complete message for its author."""


class BuildError(StudyError):
    """A valid study that what computes with it refuses; `LoadedStudy.located` adds the place.

    Parameters
    ----------
    at : path of the value to blame.
    text : what is wrong with it and the remedy.
    """

    def __init__(self, at: KeyPath, text: str) -> None:
        super().__init__(f"{show_path(at)} {text}")
        self.at = at
        self.text = text


class Mark(NamedTuple):
    """A place in a file, counted from 1."""

    line: int
    column: int


class Finding(NamedTuple):
    """One thing that is wrong, where it is known."""

    text: str
    mark: Mark | None = None


def study_error(file: str, findings: Sequence[Finding], *, more: int = 0) -> StudyError:
    """One error for everything found wrong in a file.

    Parameters
    ----------
    file : name of the file as its author gave it.
    findings : at least one.
    more : how many others are not among them.
    """
    lines = [_located(file, finding) for finding in findings]
    if len(lines) == 1 and not more:
        return StudyError(lines[0])
    title = f"{printable(file)} has {len(lines) + more} errors:"
    return StudyError("\n  ".join([title, *lines, *([f"and {more} more"] if more else [])]))


def _located(file: str, finding: Finding) -> str:
    place = "" if finding.mark is None else f":{finding.mark.line}:{finding.mark.column}"
    return f"{printable(file)}{place}: {finding.text}"


def show_path(path: KeyPath) -> str:
    """Key path as it is written in messages.

    Examples
    --------
    >>> show_path(("scene", "table", "look_deg", 2))
    'scene.table.look_deg[#3]'
    """
    text = "".join(
        f"[#{part + 1}]" if isinstance(part, int) else f".{_shortened(printable(part))}"
        for part in path
    )
    return text.removeprefix(".")


def show(value: Any) -> str:
    """A value as its author would write it, on one short line.

    Examples
    --------
    >>> show([1.5, float("nan"), None, "ten"])
    "[1.5, .nan, null, 'ten']"
    """
    return _shortened(_show(value))


def _show(value: Any) -> str:
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and not math.isfinite(value):
        return ".nan" if math.isnan(value) else f"{'-' if value < 0 else ''}.inf"
    if isinstance(value, list | tuple):
        # More items than fit on the line need no look.
        return f"[{', '.join(_show(item) for item in value[:_SHOWN_LENGTH])}]"
    if isinstance(value, dict):
        pairs = list(value.items())[:_SHOWN_LENGTH]
        return f"{{{', '.join(f'{printable(key)}: {_show(item)}' for key, item in pairs)}}}"
    if isinstance(value, float) and abs(value) >= 1e7:
        return f"{value:g}"
    return ascii(value) if isinstance(value, str) and not value.isprintable() else repr(value)


def printable(text: str) -> str:
    """Text that a terminal shows as it is: control characters and lone surrogates escaped."""
    return text if text.isprintable() else ascii(text)[1:-1]


def _shortened(text: str) -> str:
    return text if len(text) <= _SHOWN_LENGTH else f"{text[: _SHOWN_LENGTH - 1]}…"


def closest(word: str, known: Iterable[str]) -> str | None:
    """The known word that a word was probably meant to be."""
    names = {name.lower(): name for name in known}
    found = difflib.get_close_matches(word.lower()[:200], names, n=1, cutoff=0.6)
    stem = word.lower().rsplit("_", 1)[0]  # the same quantity in another unit
    found += [name for name in names if len(stem) > 2 and name.startswith(stem)]
    return names[found[0]] if found else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """A question naming the closest known word, or nothing.

    Examples
    --------
    >>> did_you_mean("wavelenght_m", ["wavelength_m", "looks"])
    "did you mean 'wavelength_m'? "
    """
    near = closest(word, known)
    return "" if near is None else f"did you mean {near!r}? "
