"""The section of a formation that is given by positions instead of orbits."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from optimize import Assessment, Problem

from ..document import Block, Column, Figure, Paragraph, Section, Table
from ..figures.placed import placed_figure
from ..reading import Shown
from ..tables import placed_frame
from ..wording import counted, fixed, formation_name, to_span


def placed_section(problem: Problem, formations: Sequence[Shown]) -> Section:
    """Where the satellites are in the segments of the scene.

    Parameters
    ----------
    problem : scene and radar.
    formations : the formation; or each of its acquisitions.
    """
    text = (
        "The study places the satellites in the segments of the scene, as positions or baselines: "
        "R radially outward, T along the flight, N along the orbit normal. No orbit is known that "
        "leads them there, so neither their way, nor their closest approach, nor the passive "
        "safety of the formation is assessed."
    )
    if len(formations) > 1:
        text += (
            f" The {counted(len(formations), 'acquisition')} have errors of their own, "
            "independent of each other; only the range error is common to all. Together they are "
            "weighted as their covariances ask for, and help to unwrap each other."
        )
    blocks: list[Block] = [Paragraph(text)]
    blocks += [placed_table(shown.assessment) for shown in formations]
    blocks.append(
        Figure(
            placed_figure(formations, problem.scene),
            "(a) The satellites seen along the flight in the middle of the scene, with their "
            "course over the segments and the direction of view. (b) Heights of ambiguity of the "
            "pairs of images over the scene.",
            "Left, positions in the plane across the flight; right, heights of ambiguity.",
        )
    )
    return Section("formation", "The formation", tuple(blocks))


def placed_table(assessment: Assessment) -> Table:
    """Positions of satellites that follow no known orbit."""
    tenths = to_span(partial(fixed, decimals=1))
    return Table(
        placed_frame(assessment),
        (
            Column("satellite", "Satellite"),
            Column("r_m", "R", "m", tenths),
            Column("t_m", "T", "m", tenths),
            Column("n_m", "N", "m", tenths),
        ),
        f"Positions of the {formation_name(assessment.label)} in the middle segment; of one that "
        "changes over the scene, the smallest and the largest (every segment: positions.csv).",
    )
