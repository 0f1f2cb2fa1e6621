"""A report as one HTML file that needs no network."""

from __future__ import annotations

import base64
import json
from collections import Counter
from collections.abc import Iterator
from html import escape
from importlib import resources
from typing import Any, assert_never

from latex2mathml.converter import convert as mathml

from .document import (
    Block,
    Callout,
    CodeListing,
    Document,
    Equation,
    Figure,
    Metrics,
    Paragraph,
    References,
    Section,
    Status,
    Strong,
    Symbol,
    Table,
    Text,
    parts,
)

# Nothing is fetched, whatever a text may smuggle in.
_POLICY = (
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
)

_MARK_CLASSES = {Status.NOTE: "", Status.GOOD: "good", Status.WARNING: "warning", Status.BAD: "bad"}


def html_bytes(document: Document) -> bytes:
    """Render a report as HTML (UTF-8).

    Parameters
    ----------
    document : the report.
    """
    renderer = _Renderer()
    body = "\n".join(renderer.section(section) for section in document.sections)
    links = "\n".join(
        f'<li><a href="#{escape(section.key)}">{escape(section.title)}</a></li>'
        for section in document.sections
    )
    description = f"<p>{escape(document.description)}</p>" if document.description else ""
    page = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{_POLICY}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="{escape(document.producer)}">
<title>{escape(document.title)}</title>
<style>
{_template("report.css")}
</style>
</head>
<body>
<a class="skip" href="#report">Skip to the report</a>
<nav aria-label="Contents"><p>{escape(document.title)}</p><ol>
{links}
</ol></nav>
<main id="report">
<header><h1>{escape(document.title)}</h1><p class="subtitle">{escape(document.subtitle)}</p>
{description}</header>
{body}
<footer>{escape(document.producer)}</footer>
</main>
{_scripts(renderer.interactive)}
</body>
</html>
"""
    return page.encode()


class _Renderer:
    """Renders blocks, numbering figures and tables."""

    def __init__(self) -> None:
        self.interactive: list[dict[str, Any]] = []
        self._numbers: Counter[str] = Counter()

    def section(self, section: Section) -> str:
        """A section with its heading and blocks."""
        blocks = "\n".join(self._block(block) for block in section.blocks)
        key, title = escape(section.key), escape(section.title)
        return (
            f'<section id="{key}" aria-labelledby="{key}-title">\n'
            f'<h2 id="{key}-title">{title}</h2>\n{blocks}\n</section>'
        )

    def _block(self, block: Block) -> str:
        match block:
            case Paragraph():
                return f"<p>{_text(block.text)}</p>"
            case Callout():
                return _callout(block)
            case Metrics():
                return _metrics(block)
            case Table():
                return self._table(block)
            case Figure():
                return self._figure(block)
            case Equation():
                return f'<div class="equation">{mathml(block.latex, display="block")}</div>'
            case CodeListing():
                return (
                    f"<details open><summary>{escape(block.caption)}</summary>"
                    f'<pre tabindex="0"><code>{escape(block.text)}</code></pre></details>'
                )
            case References():
                return _references(block)
            case _:
                assert_never(block)

    def _caption(self, kind: str, text: Text) -> str:
        self._numbers[kind] += 1
        return f"<figcaption><b>{kind} {self._numbers[kind]}.</b> {_text(text)}</figcaption>"

    def _table(self, table: Table) -> str:
        head = "".join(
            f'<th scope="col"{_number_class(column.numeric)}>{_text(column.heading)}'
            + (f' <span class="unit">[{escape(column.unit)}]</span>' if column.unit else "")
            + "</th>"
            for column in table.columns
        )
        rows = "\n".join(_rows(table))
        caption = self._caption("Table", table.caption)
        number = self._numbers["Table"]
        return (
            f'<figure class="table">{caption}'
            f'<div class="scroll" tabindex="0" role="region" aria-label="Table {number}">'
            f"<table><thead><tr>{head}</tr></thead><tbody>\n{rows}\n</tbody></table></div></figure>"
        )

    def _figure(self, figure: Figure) -> str:
        data = base64.b64encode(figure.svg).decode("ascii")
        image = f'<img src="data:image/svg+xml;base64,{data}" alt="{escape(figure.alt)}">'
        caption = self._caption("Figure", figure.caption)
        turnable = ""
        if figure.interactive is not None:
            index = len(self.interactive)
            self.interactive.append(figure.interactive)
            turnable = (
                f'<div class="turn"><div class="interactive" id="interactive-{index}" role="img" '
                f'aria-label="{escape(figure.alt)}"></div>'
                f"<p>{escape(figure.instruction)}</p></div>"
            )
        return (
            f'<figure><div class="card scroll" tabindex="0" role="region" aria-label="Figure '
            f'{self._numbers["Figure"]}">{image}</div>{caption}</figure>{turnable}'
        )


def _rows(table: Table) -> Iterator[str]:
    """Rows of the body, each followed by its note where it has one."""
    cells = table.cells()
    marks = table.marks or (Status.NOTE,) * len(cells)
    notes = table.notes or ("",) * len(cells)
    for mark, note, row in zip(marks, notes, cells, strict=True):
        kind = f"{_MARK_CLASSES[mark]}{' noted' if note else ''}"
        head, *others = row
        shown = "".join(
            f"<td{_number_class(column.numeric)}>{escape(cell)}</td>"
            for column, cell in zip(table.columns[1:], others, strict=True)
        )
        yield f'<tr class="{kind}"><th scope="row">{escape(head)}</th>{shown}</tr>'
        if note:
            yield f'<tr class="note"><td colspan="{len(row)}">{escape(note)}</td></tr>'


def _number_class(numeric: bool) -> str:
    return ' class="number"' if numeric else ""


def _callout(callout: Callout) -> str:
    paragraphs = "".join(f"<p>{_text(text)}</p>" for text in callout.paragraphs)
    return (
        f'<div class="callout {callout.status}" role="note">'
        f"<p><strong>{escape(callout.title)}</strong></p>{paragraphs}</div>"
    )


def _metrics(metrics: Metrics) -> str:
    items = "".join(
        f'<div class="{item.status}"><dt>{escape(item.label)}</dt>'
        f"<dd><b>{escape(item.value)}</b><span>{escape(item.remark)}</span></dd></div>"
        for item in metrics.items
    )
    return f'<dl class="metrics">{items}</dl>'


def _references(references: References) -> str:
    items = "".join(
        f"<li>{escape(work.text)}"
        + (
            f' <a href="https://doi.org/{escape(work.doi)}" rel="noreferrer">'
            f"doi:{escape(work.doi)}</a>"
            if work.doi
            else ""
        )
        + "</li>"
        for work in references.items
    )
    return f'<h3>References</h3><ol class="references">{items}</ol>'


def _text(text: Text) -> str:
    return "".join(_part(part) for part in parts(text))


def _part(part: str) -> str:
    match part:
        case Strong():
            return f"<strong>{escape(part)}</strong>"
        case Symbol():
            base, _, subscript = part.partition("_")
            below = f"<sub>{escape(subscript)}</sub>" if subscript else ""
            return f"<i>{escape(base)}</i>{below}"
        case _:
            return escape(part)


def _scripts(figures: list[dict[str, Any]]) -> str:
    if not figures:
        return ""
    from plotly.offline import get_plotlyjs

    data = json.dumps(figures, ensure_ascii=True, allow_nan=False)
    # The data must not be able to end the script element.
    for character in "<>&":
        data = data.replace(character, f"\\u{ord(character):04x}")
    return (
        f'<script type="application/json" id="interactive-data">{data}</script>\n'
        f"<script>{get_plotlyjs()}</script>\n<script>{_template('report.js')}</script>"
    )


def _template(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text("utf-8").strip()
