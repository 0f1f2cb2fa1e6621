"""Tables and numbers in Markdown, and the published values that tables compare with."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

DOCS = Path(__file__).parent.parent
PUBLISHED = DOCS.parent / "tests" / "published"
LI2009: dict[str, Any] = tomllib.loads((PUBLISHED / "li2009.toml").read_text(encoding="utf-8"))
MODEL: dict[str, Any] = tomllib.loads((PUBLISHED / "error_model.toml").read_text(encoding="utf-8"))

# Least errors of the paper's problem without decorrelation, by family and number of satellites: a
# convex lower bound that is met to 1e-6 (docs/validation.md).
DUMBBELL = {
    ("space", 3): 1.117366,
    ("ground", 3): 0.996068,
    ("space", 4): 0.912008,
    ("ground", 4): 0.813011,
}
Rows = Sequence[Sequence[str]]


def markdown_table(head: Sequence[str], rows: Rows) -> str:
    """Table in Markdown, the first column left and the others right aligned."""
    align = ["---", *["---:"] * (len(head) - 1)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (head, align, *rows))


def digits(value: float, count: int) -> str:
    """Number with a fixed count of significant digits."""
    if abs(value) < 0.01:
        mantissa, exponent = f"{value:.{count - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    decimals = max(0, count - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{decimals}f}"
