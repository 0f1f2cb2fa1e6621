"""What a mission prints of itself beside what the study gives, and what it leaves open."""

from __future__ import annotations

import pandas as pd

from optimize import EvaluateResult

from ..document import Column, Paragraph, Section, Table
from ..wording import plain
from .claims import claims_section
from .verdict import INPUTS


def mission_claims_section(result: EvaluateResult) -> Section | None:
    """Printed figures of a mission; None without any.

    Parameters
    ----------
    result : of the evaluation.
    """
    section = claims_section(result.claims, INPUTS, digits=4)
    if section is None or not result.opened:
        return section
    text = (
        "Some numbers on which the figures depend are not published. Every figure is also computed "
        "at all combinations of the ends of what is possible; where it holds at some of them only, "
        "the public numbers do not determine it."
    )
    frame = pd.DataFrame(
        [
            {
                "name": one.name,
                "range": f"{plain(one.least)} … {plain(one.most)}",
                "why": one.why,
            }
            for one in result.opened
        ]
    )
    table = Table(
        frame,
        (Column("name", "Key of the study"), Column("range", "Possible"), Column("why", "Why")),
        "What the source leaves open, in the unit of the key.",
    )
    return section._replace(blocks=(*section.blocks, Paragraph(text), table))
