"""Section that sets formations side by side."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from optimize import Assessment

from ..document import Column, Section, Status, Table
from ..reading import broken
from ..tables import comparison_frame
from ..wording import to_decimals, to_digits
from .interferometry import OVER_CRITICAL
from .limits import limit_text, value_text
from .placed import placed_table
from .sections import formation_table, unwrapping_column


def comparison_section(best: Assessment, others: Sequence[Assessment]) -> Section | None:
    """Formations beside the result; None without any."""
    if not others:
        return None
    frame = comparison_frame([best, *others])
    failures = [broken(one) for one in (best, *others)]
    kept = "all kept" if best.constraints else "none set"
    frame["limits"] = [
        "; ".join(f"{r.limit.name} {value_text(r)}, {limit_text(r)}" for r in reports) or kept
        for reports in failures
    ]
    numbers = to_digits(4)
    table = Table(
        frame,
        (
            Column("label", "Formation"),
            Column("region_rms_m", "Total", "m", numbers),
            Column("relative_rms_m", "Relative", "m", numbers),
            *unwrapping_column(frame),
            Column("baseline_over_critical", ("largest ", *OVER_CRITICAL), "", to_decimals(3)),
            *_separation_column(frame),
            Column("limits", "Limits"),
        ),
        "Formations side by side, all assessed with the same model and limits.",
        tuple(Status.BAD if reports else Status.NOTE for reports in failures),
    )
    shown = [formation_table(one) if one.motion else placed_table(one) for one in others]
    return Section("comparison", "Comparison", (table, *shown))


def _separation_column(frame: pd.DataFrame) -> tuple[Column, ...]:
    """The closest approach, where the orbits of some formation are known."""
    if frame["min_separation_m"].isna().all():
        return ()
    return (Column("min_separation_m", "Closest approach", "m", to_decimals(1)),)
