"""Turns what pydantic finds wrong with a study into messages for its author."""

from __future__ import annotations

from typing import Any, NamedTuple

from pydantic import ValidationError

from .base import CROSS_CHECK, MISSING_KEY, Block
from .messages import (
    Finding,
    KeyPath,
    Mark,
    StudyError,
    closest,
    did_you_mean,
    show,
    show_path,
    study_error,
)
from .reader import Document
from .remedies import in_known_unit, remedy
from .schema import Schema, block_at, describe, resolve, schema_at

MAX_FINDINGS = 5
"""Findings that one message lists; the others are counted."""

_EXAMPLES = {
    "steering": "terrasar_x",
    "spotlight": "han2016_spotlight",
    "video": "liang2018_video",
    "coverage": "walker_coverage",
}
"""Example to copy a block from, for the kinds other than those of `three_sat`."""

_SHORT = 45
"""Longest list that is shown with its key."""


def explain(
    error: ValidationError, document: Document, model: type[Block], *, file: str
) -> StudyError:
    """One message for a failed validation, each finding with its place in the file.

    Parameters
    ----------
    error : from the validation of ``document.data`` by ``model``.
    document : the data and the places of its values.
    model : the kind of study.
    file : its name.
    """
    schema = model.model_json_schema()
    details = {}
    for detail in error.errors(include_url=False):
        path, kind = _real_path(detail["loc"], document.data, detail["type"]), detail["type"]
        if kind == MISSING_KEY:
            path, kind = (*path, detail["ctx"]["key"]), "missing"
        if kind == "missing" and isinstance(path[-1], int):  # a list that is too short
            path, kind = path[:-1], "too_short"
        details[path] = (kind, detail.get("ctx", {}))
    # A list with a wrong entry is reported as too short as well.
    parents = {path[:length] for path in details for length in range(len(path))}
    mistakes = [
        _Mistake(path, kind, context)
        for path, (kind, context) in details.items()
        if path not in parents
    ]
    # A misspelt key is one mistake, not an unknown key and a missing one.
    unknown = [mistake.path for mistake in mistakes if mistake.kind == "extra_forbidden"]
    meant = {(*path[:-1], _meant(path, document.data, schema)) for path in unknown[:MAX_FINDINGS]}
    mistakes = [m for m in mistakes if m.kind != "missing" or m.path not in meant]
    mistakes.sort(key=lambda mistake: mistake.place(document))
    findings = [
        Finding(mistake.text(document, schema), mistake.place(document))
        for mistake in mistakes[:MAX_FINDINGS]
    ]
    return study_error(file, findings, more=len(mistakes) - len(findings))


def located(at: KeyPath, text: str, document: Document, *, file: str) -> StudyError:
    """One message for a value that is refused after the validation.

    Parameters
    ----------
    at : path of the value; it may come by default.
    text : what is wrong, and the remedy.
    document : the data and the places of its values.
    file : its name.
    """
    finding = Finding(f"{_assignment(at, document.data)} {text}", _place(at, document))
    return study_error(file, [finding])


class _Mistake(NamedTuple):
    """One thing that pydantic found."""

    path: KeyPath
    kind: str
    context: dict[str, Any]

    def place(self, document: Document) -> Mark:
        """Where the file says it."""
        if self.kind == "extra_forbidden":
            return document.keys[self.path]
        if self.kind == "missing":
            return _place(self.path[:-1], document)
        return _place((*self.path, *self.context.get("at", ())), document)

    def text(self, document: Document, schema: Schema) -> str:
        """What is wrong, with the limit and the remedy."""
        if self.kind == CROSS_CHECK:
            named = _assignment((*self.path, *self.context["at"]), document.data)
            return f"{named} {self.context['text']}; {self.context['remedy']}"
        if self.kind == "extra_forbidden":
            return _unknown_key(self.path, document.data, schema)
        allowed = schema_at(schema, self.path)
        if self.kind == "missing":
            return _missing(self.path, allowed, schema)
        return _wrong_value(self.path, document.data, allowed)


def _real_path(location: KeyPath, data: Any, kind: str) -> KeyPath:
    """The location without the names of alternatives that pydantic adds to it."""
    path: list[str | int] = []
    for position, part in enumerate(location):
        last = position == len(location) - 1
        if _holds(data, part):
            data = data[part]
        elif not (last and kind == "missing"):
            continue
        path.append(part)
    return tuple(path)


def _holds(data: Any, part: str | int) -> bool:
    if isinstance(data, list):
        return isinstance(part, int) and part < len(data)
    return isinstance(data, dict) and part in data


def _value(path: KeyPath, data: Any) -> Any:
    for part in path:
        if not _holds(data, part):
            return None  # a value that is not in the file but comes by default
        data = data[part]
    return data


def _place(path: KeyPath, document: Document) -> Mark:
    """Where a value stands; a block and an empty value are better found by their key."""
    while path not in document.marks:
        path = path[:-1]
    value = _value(path, document.data)
    by_key = value is None or isinstance(value, dict)
    return document.keys.get(path, document.marks[path]) if by_key else document.marks[path]


def _assignment(path: KeyPath, data: Any) -> str:
    """``key = value``; long lists and blocks are only named."""
    if not path:
        return "the study"
    value = _value(path, data)
    several_lines = isinstance(value, str) and "\n" in value
    if isinstance(value, dict) or several_lines:
        return show_path(path)
    if isinstance(value, list) and len(show(value)) > _SHORT:
        return show_path(path)
    return f"{show_path(path)} = {show(value)}"


def _unknown_key(path: KeyPath, data: Any, schema: Schema) -> str:
    key, parent = str(path[-1]), path[:-1]
    known = list(block_at(schema, parent))
    where = show_path(parent) if parent else "the study"
    homes = _homes(key, schema)
    named = " or ".join(repr(home) for home in homes)
    converted = in_known_unit(key, _value(path, data), known)
    hint = f"it belongs under {named}; " if homes else did_you_mean(key, known)
    if converted is not None:
        hint = f"write {converted[0]}: {converted[1]:.6g}; "
    return f"{show_path(path)} is not a known key; {hint}the keys of {where} are {', '.join(known)}"


def _meant(path: KeyPath, data: Any, schema: Schema) -> str | None:
    """The known key that an unknown one stands for: in another unit, or misspelt."""
    key, known = str(path[-1]), list(block_at(schema, path[:-1]))
    converted = in_known_unit(key, _value(path, data), known)
    return closest(key, known) if converted is None else converted[0]


def _homes(key: str, schema: Schema) -> list[str]:
    """The blocks of a study, and the blocks in one, that have a key."""
    blocks = [(outer,) for outer in block_at(schema, ())]
    nested = [(*outer, inner) for outer in blocks for inner in block_at(schema, outer)]
    return [".".join(path) for path in (*blocks, *nested) if key in block_at(schema, path)]


def _missing(path: KeyPath, allowed: Schema, schema: Schema) -> str:
    about = allowed.get("description", "").rstrip(".")
    if resolve(allowed).get("type") == "object":
        kind = schema_at(schema, ("kind",)).get("const", "")
        return (
            f"{show_path(path)} is missing ({about}); add this block as in the example that "
            f"formation-opt --new {_EXAMPLES.get(kind, 'three_sat')} prints"
        )
    return f"{show_path(path)} is missing; add {describe(allowed, str(path[-1]))} ({about})"


def _wrong_value(path: KeyPath, data: Any, schema: Schema) -> str:
    value = _value(path, data)
    key = next((part for part in reversed(path) if isinstance(part, str)), "")
    return (
        f"{_assignment(path, data)} must be {describe(schema, key)}; {remedy(value, key, schema)}"
    )
