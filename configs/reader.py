"""Reads the YAML of a study: plain data only, with the place of every value.

YAML 1.2's rules decide what is a number: ``1e-3`` is one, ``no``, ``10:30`` and ``2026-11-23`` are
text and ``010`` is ten; PyYAML's own rules (YAML 1.1) decide otherwise in all of these. Duplicate
keys, tags, several documents and input that unfolds without end are refused.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import yaml

from .messages import Finding, KeyPath, Mark, StudyError, printable, show_path, study_error
from .texts import NotTextError, decode

MAX_BYTES = 1_000_000
MAX_DEPTH = 50
MAX_VALUES = 20_000
"""Values of a study, counted before and after aliases (``*name``) are replaced."""

_TOO_DEEP = f"is nested more than {MAX_DEPTH} deep, where a study needs 5; remove brackets"
_TOO_MANY = (
    f"holds more than {MAX_VALUES} values, counting what aliases (*name) stand for; shorten it"
)
_TAG = "tag:yaml.org,2002:"


class Document(NamedTuple):
    """The data of a study, and where each value and each key stands."""

    data: Any
    marks: dict[KeyPath, Mark]
    keys: dict[KeyPath, Mark]


def read_document(content: bytes, *, file: str) -> Document:
    """Read the data of a study.

    Parameters
    ----------
    content : the bytes of the file.
    file : its name, for messages.

    Raises
    ------
    StudyError
        If it is too large, not text, not YAML, or more than plain data.
    """
    text = _decode(content, file)
    loader = _Loader(text, file)
    try:
        node = loader.get_single_node()
        if node is None:
            raise study_error(
                file,
                [Finding("is empty; start from an example: formation-opt --new three_sat")],
            )
        walk = _Walk(file)
        return Document(walk.value(node, ()), walk.marks, walk.keys)
    except yaml.MarkedYAMLError as error:
        raise _syntax_error(error, file) from None
    except (ValueError, OverflowError):  # PyYAML: an escape beyond Unicode, an endless version
        mark = loader.get_mark()
        finding = Finding("is not valid YAML: an escape or a number is too large", _mark(mark))
        raise study_error(file, [finding]) from None


def _decode(content: bytes, file: str) -> str:
    if len(content) > MAX_BYTES:
        finding = Finding(
            f"is larger than {MAX_BYTES // 1000} kB, the limit for a study; is it another file?"
        )
        raise study_error(file, [finding])
    try:
        return decode(content)
    except NotTextError as error:
        raise study_error(file, [Finding(error.text, error.mark)]) from None


def _mark(mark: Any) -> Mark:
    return Mark(mark.line + 1, mark.column + 1)


class _Loader(yaml.SafeLoader):
    """Composes nodes by the rules of YAML 1.2's core schema, to a limited depth."""

    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012 — PyYAML's own class attribute

    def __init__(self, text: str, file: str) -> None:
        super().__init__(text)
        self.file = file
        self.depth = 0
        self.count = 0

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Compose a node of a document that is neither too deep nor too large."""
        self.depth += 1
        self.count += 1
        if self.depth > MAX_DEPTH or self.count > MAX_VALUES:
            event = self.peek_event()  # type: ignore[no-untyped-call]
            text = _TOO_DEEP if self.depth > MAX_DEPTH else _TOO_MANY
            raise study_error(self.file, [Finding(text, _mark(event.start_mark))])
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


for _name, _pattern, _first in (
    ("null", r"(?:~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("bool", r"(?:true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"[-+]?[0-9]+$|0o[0-7]+$|0x[0-9a-fA-F]+$", list("-+0123456789")),
    (
        "float",
        r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?$"
        r"|[-+]?\.(?:inf|Inf|INF)$|\.(?:nan|NaN|NAN)$",
        list("-+.0123456789"),
    ),
):
    _Loader.add_implicit_resolver(_TAG + _name, re.compile(_pattern, re.ASCII), _first)


class _Walk:
    """Turns nodes into data, keeping the place of each value."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.marks: dict[KeyPath, Mark] = {}
        self.keys: dict[KeyPath, Mark] = {}

    def value(self, node: yaml.Node, path: KeyPath) -> Any:
        """Value of a node in plain Python; notes where each key stands."""
        mark = _mark(node.start_mark)
        self.marks[path] = mark
        if len(self.marks) > MAX_VALUES:
            raise self._error(_TOO_MANY, mark)
        if len(path) > MAX_DEPTH:
            raise self._error(
                f"{show_path(path[:3])}… contains itself; remove the alias (*name)", mark
            )
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node, path, mark)
        if isinstance(node, yaml.SequenceNode) and node.tag == _TAG + "seq":
            return [self.value(item, (*path, index)) for index, item in enumerate(node.value)]
        if isinstance(node, yaml.MappingNode) and node.tag == _TAG + "map":
            return self._mapping(node, path)
        raise self._tag_error(node, path, mark)

    def _mapping(self, node: yaml.MappingNode, path: KeyPath) -> dict[str, Any]:
        data: dict[str, Any] = {}
        for key_node, value_node in node.value:
            place = _mark(key_node.start_mark)
            if not isinstance(key_node, yaml.ScalarNode):
                raise self._error("a list or block stands where a key belongs: quote it", place)
            if key_node.tag.removeprefix(_TAG) not in _SCALARS:
                raise self._tag_error(key_node, path, place)
            key = self._text(key_node, path, place)
            if key in data:
                raise self._error(
                    f"{show_path((*path, key))} is given twice, first in line "
                    f"{self.keys[*path, key].line}; keep one",
                    place,
                )
            self.keys[*path, key] = place
            data[key] = self.value(value_node, (*path, key))
        return data

    def _scalar(self, node: yaml.ScalarNode, path: KeyPath, mark: Mark) -> Any:
        kind = node.tag.removeprefix(_TAG)
        if kind not in _SCALARS:
            raise self._tag_error(node, path, mark)
        text = self._text(node, path, mark)
        try:
            return _SCALARS[kind](text)
        except (ValueError, KeyError):
            raise self._error(
                f"{show_path(path)} = {printable(text[:60])} is not a {kind}; remove the tag "
                f"!!{kind} or correct the value",
                mark,
            ) from None

    def _text(self, node: yaml.ScalarNode, path: KeyPath, mark: Mark) -> str:
        text: str = node.value
        if any("\ud800" <= character <= "\udfff" for character in text):
            raise self._error(
                f"{show_path(path)} holds half a character (\\uD800-\\uDFFF); write the character",
                mark,
            )
        return text

    def _tag_error(self, node: yaml.Node, path: KeyPath, mark: Mark) -> StudyError:
        tag = printable(node.tag.replace(_TAG, "!!"))[:80]
        where = f"{show_path(path)} has" if path else "the study has"
        return self._error(
            f"{where} the tag {tag}; a study is plain data and runs no code: remove the tag", mark
        )

    def _error(self, text: str, mark: Mark) -> StudyError:
        return study_error(self.file, [Finding(text, mark)])


def _number(text: str) -> int | float:
    # Whole numbers beyond any use become floats, which bounds then refuse.
    for prefix, base in (("0x", 16), ("0o", 8)):
        if text.startswith(prefix):
            text = str(int(text, base)) if len(text) < 20 else "inf"
    return int(text) if len(text) < 20 else float(text)


def _float(text: str) -> float:
    return float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))


_SCALARS: dict[str, Any] = {
    "str": str,
    "null": {"": None, "~": None, "null": None, "Null": None, "NULL": None}.__getitem__,
    "bool": lambda text: {"true": True, "false": False}[text.lower()],
    "int": _number,
    "float": _float,
}

_HELP = {
    r"'\t'": "a tab stands here, which YAML does not allow: indent with spaces",
    "mapping values are not allowed": "check the indentation; text that holds ': ' needs quotes",
    "could not find expected ':'": "write 'key: value', with a space after the colon",
    "undefined alias": "text that starts with * needs quotes",
    "second occurrence": "give each anchor (&name) a name of its own",
    "cannot start any token": "text that starts with this character needs quotes",
    "<block end>": "compare the indentation with the lines above; close every quote",
    "unexpected end of stream": "a quote is not closed",
    "expected ',' or": "a bracket is not closed, or a comma is missing",
    "unknown escape": "use single quotes, in which a backslash is a backslash",
    "but found another document": "a study is one document: remove the line '---'",
}


def _syntax_error(error: yaml.MarkedYAMLError, file: str) -> StudyError:
    problem = error.problem or error.context or "it can't be parsed"
    if "another document" in problem:
        problem = "expected one document, but found another document"
    remedy = next((text for key, text in _HELP.items() if key in problem), None)
    mark = error.problem_mark or error.context_mark
    text = f"is not valid YAML: {printable(problem)[:200]}; {remedy or 'correct the line'}"
    return study_error(file, [Finding(text, None if mark is None else _mark(mark))])
