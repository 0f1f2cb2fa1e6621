"""A report as PDF, typeset by typst from a template and plain data."""

from __future__ import annotations

import json
import tempfile
from importlib import resources
from pathlib import Path
from typing import Any, assert_never

import typst

from .document import (
    Block,
    Callout,
    CodeListing,
    Column,
    Document,
    Equation,
    Figure,
    Metrics,
    Paragraph,
    References,
    Strong,
    Symbol,
    Table,
    Text,
    parts,
)

_LAST_EMBEDDED = 0x2E7F
"""Typst brings fonts for scripts up to here; beyond, the fonts of the system are asked."""


def pdf_bytes(document: Document) -> bytes:
    """Render a report as PDF.

    Parameters
    ----------
    document : the report.

    Notes
    -----
    Every text travels as data, through a JSON file, and is never read as typst markup; only the
    equations, which come from this package, are.
    """
    with tempfile.TemporaryDirectory(prefix="formation-opt-") as folder:
        root = Path(folder)
        data = json.dumps(_document(document, root), ensure_ascii=False, allow_nan=False)
        (root / "document.json").write_text(data, "utf-8")
        template = resources.files(__package__).joinpath("templates", "report.typ").read_bytes()
        (root / "report.typ").write_bytes(template)
        return typst.compile(
            str(root / "report.typ"),
            root=str(root),
            ignore_system_fonts=max(map(ord, data)) <= _LAST_EMBEDDED,
        )


def _document(document: Document, root: Path) -> dict[str, Any]:
    return {
        "title": document.title,
        "subtitle": document.subtitle,
        "description": document.description,
        "producer": document.producer,
        "sections": [
            {
                "title": section.title,
                "blocks": [_block(block, root) for block in section.blocks if _is_printed(block)],
            }
            for section in document.sections
        ],
    }


def _is_printed(block: Block) -> bool:
    return not isinstance(block, CodeListing) or block.printed


def _block(block: Block, root: Path) -> dict[str, Any]:
    match block:
        case Paragraph():
            return {"kind": "paragraph", "text": _text(block.text)}
        case Callout():
            paragraphs = [_text(text) for text in block.paragraphs]
            return {
                "kind": "callout",
                "status": block.status,
                "title": block.title,
                "paragraphs": paragraphs,
            }
        case Metrics():
            return {"kind": "metrics", "items": [item._asdict() for item in block.items]}
        case Table():
            return _table(block)
        case Figure():
            return _figure(block, root)
        case Equation():
            return {"kind": "equation", "math": block.typst}
        case CodeListing():
            return {"kind": "code", "text": block.text, "caption": block.caption}
        case References():
            return {"kind": "references", "items": [work._asdict() for work in block.items]}
        case _:
            assert_never(block)


def _table(table: Table) -> dict[str, Any]:
    cells = table.cells()
    most = 44 if len(table.columns) <= 5 else 24
    return {
        "kind": "table",
        "caption": _text(table.caption),
        "columns": [
            {
                "heading": _text(column.heading),
                "unit": column.unit,
                "numeric": column.numeric,
                "weight": _weight(column, [row[index] for row in cells], most=most),
            }
            for index, column in enumerate(table.columns)
        ],
        "rows": cells,
        "marks": list(table.marks),
        "notes": list(table.notes) or [""] * len(cells),
    }


def _weight(column: Column, cells: list[str], *, most: int) -> int:
    """Share of the width that a column gets: as its longest entry needs, within reason."""
    heading = len("".join(parts(column.heading))) + len(column.unit) + 3
    longest = min(max([min(heading, 14), *map(len, cells)]), most)
    return longest + 2  # for the padding


def _figure(figure: Figure, root: Path) -> dict[str, Any]:
    name = f"figure-{len(list(root.glob('figure-*.svg'))) + 1}.svg"
    (root / name).write_bytes(figure.svg)
    return {
        "kind": "figure",
        "path": name,
        "alt": figure.alt,
        "caption": _text(figure.caption),
    }


def _text(text: Text) -> list[dict[str, str]]:
    return [_part(part) for part in parts(text)]


def _part(part: str) -> dict[str, str]:
    match part:
        case Strong():
            return {"kind": "strong", "text": part}
        case Symbol():
            base, _, subscript = part.partition("_")
            return {"kind": "symbol", "text": base, "subscript": subscript}
        case _:
            return {"kind": "plain", "text": part}
