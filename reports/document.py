"""A report without a format: sections of blocks that HTML and PDF render alike.

Texts are data. The renderers escape them; nothing here is markup of either format, except the
two forms of an `Equation`, which come from this package and never from a study.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple

import pandas as pd


class Status(StrEnum):
    """What a callout or a table row tells at a glance."""

    GOOD = "good"
    WARNING = "warning"
    BAD = "bad"
    NOTE = "note"


class Strong(str):
    """A stressed part of a text."""

    __slots__ = ()


class Symbol(str):
    """A symbol of the field in italics; what follows an underscore is its subscript."""

    __slots__ = ()


Text = str | tuple[str, ...]
"""A text, or its parts, of which some may be `Strong` or a `Symbol`."""


def parts(text: Text) -> tuple[str, ...]:
    """Parts of a text; one if it is plain."""
    return (text,) if isinstance(text, str) else text


class Paragraph(NamedTuple):
    """A paragraph."""

    text: Text


class Callout(NamedTuple):
    """A framed message: the verdict, or a warning."""

    status: Status
    title: str
    paragraphs: tuple[Text, ...] = ()


class Metric(NamedTuple):
    """One key figure: what it is, its value with the unit, and a remark."""

    label: str
    value: str
    remark: str
    status: Status = Status.NOTE


class Metrics(NamedTuple):
    """The key figures, side by side."""

    items: tuple[Metric, ...]


class Column(NamedTuple):
    """A column of a table as people read it.

    Attributes
    ----------
    key : column of the frame.
    heading : its name, in words or the symbol of the field.
    unit : its unit, empty for none.
    show : formats the whole column; None for text.
    """

    key: str
    heading: Text
    unit: str = ""
    show: Callable[[Sequence[Any]], list[str]] | None = None

    @property
    def numeric(self) -> bool:
        """Whether it holds numbers, which are aligned at the right."""
        return self.show is not None


@dataclass(frozen=True, eq=False)
class Table:
    """A table of a frame.

    Attributes
    ----------
    frame : the numbers, one row each.
    columns : those that are shown.
    caption : what it shows.
    marks : status of each row; empty for none.
    notes : what is said beneath each row, over the whole width; empty for none.
    """

    frame: pd.DataFrame
    columns: tuple[Column, ...]
    caption: Text
    marks: tuple[Status, ...] = ()
    notes: tuple[str, ...] = ()

    def cells(self) -> list[list[str]]:
        """Formatted cells, row by row."""
        shown = [
            [str(value) for value in self.frame[column.key]]
            if column.show is None
            else column.show(self.frame[column.key].tolist())
            for column in self.columns
        ]
        return [list(row) for row in zip(*shown, strict=True)]


@dataclass(frozen=True, eq=False)
class Figure:
    """A figure.

    Attributes
    ----------
    svg : the drawing.
    caption : what it shows.
    alt : the same in words, for those who do not see it.
    interactive : a plotly figure shown beneath it in HTML, with its frames if it moves; None for
        none.
    instruction : what a reader can do with that one.
    """

    svg: bytes
    caption: Text
    alt: str
    interactive: dict[str, Any] | None = None
    instruction: str = ""


class Equation(NamedTuple):
    """A displayed equation, in the notation of each format; always from this package."""

    latex: str
    typst: str


class CodeListing(NamedTuple):
    """A listing, word for word; `printed` is whether it takes up pages of the PDF too."""

    text: str
    caption: str
    printed: bool = True


class Reference(NamedTuple):
    """A work that a method comes from; `doi` may be empty."""

    text: str
    doi: str


class References(NamedTuple):
    """The works cited, numbered from 1."""

    items: tuple[Reference, ...]


Block = Paragraph | Callout | Metrics | Table | Figure | Equation | CodeListing | References


class Section(NamedTuple):
    """A titled part of the report; `key` names it in links."""

    key: str
    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, eq=False)
class Document:
    """A report.

    Attributes
    ----------
    title, subtitle : of the front page.
    description : the study's own words; may be empty.
    producer : program and version.
    sections : its parts, in order.
    """

    title: str
    subtitle: str
    description: str
    producer: str
    sections: tuple[Section, ...]
