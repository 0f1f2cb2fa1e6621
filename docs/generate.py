"""Recompute the tables of the documentation and write them into its pages.

Run ``python docs/generate.py`` after a change of the model; the tables are computed in ``tables``,
and ``tests/test_docs.py`` compares the committed pages with a fresh run. A table stands between
``<!-- generated: name -->`` and ``<!-- end -->``. Everything else on the pages is written by hand.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))

from tables import (  # noqa: E402 — found beside this file
    coverage,
    dem_quality,
    error_model,
    li2009,
    missions,
    orbits,
    phase_statistics,
    simulation,
    spotlight,
    steering,
    steering_papers,
    validation,
    video,
)

_MODULES = (
    coverage,
    error_model,
    dem_quality,
    phase_statistics,
    li2009,
    validation,
    steering,
    steering_papers,
    orbits,
    spotlight,
    video,
    missions,
    simulation,
)
TABLES = {name: table for module in _MODULES for name, table in module.TABLES.items()}

_BLOCK = re.compile(r"(<!-- generated: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def regenerate(text: str) -> str:
    """Replace every generated block of a page.

    Parameters
    ----------
    text : a page in Markdown.

    Raises
    ------
    KeyError
        If a block has a name that `TABLES` lacks.
    """
    return _BLOCK.sub(lambda found: f"{found[1]}{TABLES[found[2]]()}\n{found[3]}", text)


def pages() -> list[Path]:
    """Pages that hold a generated block."""
    return [page for page in sorted(DOCS.glob("*.md")) if _BLOCK.search(page.read_text("utf-8"))]


def main() -> None:
    """Rewrite the pages."""
    for page in pages():
        page.write_text(regenerate(page.read_text("utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
