"""Sections that the pages of all formation studies share."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from optimize import Assessment, Problem

from ..document import (
    Block,
    Callout,
    Column,
    Document,
    Figure,
    Paragraph,
    Section,
    Status,
    Table,
)
from ..figures.attribution import attribution_figure
from ..figures.height_error import height_error_figure, moves_little
from ..figures.orbits import orbits_figure
from ..figures.orbits_interactive import interactive_orbits
from ..reading import (
    ACTIVE_FAILURE_MARGIN,
    ACTIVE_MARGIN,
    Baselines,
    Shown,
    drawn_baselines,
    measured,
    unmeasured_reason,
)
from ..study import Provenance, StudyInfo
from ..tables import (
    constraints_frame,
    formation_frame,
    region_frame,
    shares_frame,
)
from ..wording import (
    counted,
    formation_name,
    percent,
    significant,
    to_decimals,
    to_digits,
    to_probabilities,
)
from .limits import limit_text, margin_text, value_text

_EPOCH = "t\u00a0=\u00a00"


def document(study: StudyInfo, provenance: Provenance, *parts: Section | None) -> Document:
    """Document of the sections that there are."""
    return Document(
        title=study.name,
        subtitle=f"{study.kind} · formation-opt {provenance.version} · {provenance.started[:10]}",
        description=study.description,
        producer=f"formation-opt {provenance.version}",
        sections=tuple(part for part in parts if part is not None),
    )


def inferred_blocks(study: StudyInfo) -> tuple[Block, ...]:
    """Which inputs are not the source's, beside the result that rests on them."""
    if not study.inferred:
        return ()
    named = "; ".join(f"{key} = {value}" for key, value in study.inferred)
    return (
        Callout(
            Status.NOTE,
            "Inferred inputs",
            (
                "The source does not print these; they were chosen or solved for here, others may "
                f"do as well, and the result rests on them: {named}.",
            ),
        ),
    )


def warning_blocks(warnings: Sequence[str]) -> tuple[Block, ...]:
    """What a reader must know before using the result, in one callout."""
    if not warnings:
        return ()
    return (Callout(Status.WARNING, "Before using this result", tuple(warnings)),)


def formation_section(problem: Problem, formations: Sequence[Shown]) -> Section:
    """States and relative orbits."""
    blocks: list[Block] = [
        Paragraph(
            f"Positions and velocities are relative to the reference orbit at {_EPOCH}, the epoch "
            "of the scene's times: R radially outward, T along the flight, N along the orbit "
            "normal. R and Ṙ are the design variables z₀ and ż₀."
        )
    ]
    blocks += [formation_table(shown.assessment) for shown in formations]
    middle = problem.scene.line_of_sight[len(problem.scene) // 2]
    baselines = [drawn_baselines(problem, shown.assessment) for shown in formations]
    assessments = [shown.assessment for shown in formations]
    for index, (assessment, drawn) in enumerate(zip(assessments, baselines, strict=True)):
        name = formation_name(assessment.label)
        blocks.append(
            Figure(
                orbits_figure(assessment, baselines=drawn.ends, line_of_sight=middle),
                f"Relative orbits of the {name} over one revolution, all to one scale. Marks are "
                f"the satellites at {_EPOCH}{_lines(drawn)}; arrows give the flight direction and "
                "the line of sight in the middle of the scene, ⊙ one that points at the viewer. "
                "Of orbits that coincide one is dashed.",
                f"Three projections and a view in space of the {name}'s orbits.",
                interactive=interactive_orbits(assessments, [b.ends for b in baselines], middle)
                if index == 0
                else None,
                instruction="The same orbits: drag to turn them, scroll to come closer.",
            )
        )
    return Section("formation", "The formation", tuple(blocks))


def _lines(baselines: Baselines) -> str:
    """The gray lines of an orbit figure in its caption."""
    if not baselines.words:
        return "; the baselines between so many are not drawn"
    return f", gray lines {baselines.words}"


def formation_table(assessment: Assessment) -> Table:
    """States of satellites at t = 0."""
    meters_, rates = to_decimals(2), to_decimals(4)
    return Table(
        formation_frame([assessment]),
        (
            Column("satellite", "Satellite"),
            Column("r_m", "R = z₀", "m", meters_),
            Column("t_m", "T", "m", meters_),
            Column("n_m", "N", "m", meters_),
            Column("vr_m_s", "Ṙ = ż₀", "m/s", rates),
            Column("vt_m_s", "Ṫ", "m/s", rates),
            Column("vn_m_s", "Ṅ", "m/s", rates),
        ),
        f"States of the {formation_name(assessment.label)} at {_EPOCH} (every digit: "
        "formation.csv).",
    )


def height_error_section(problem: Problem, formations: Sequence[Shown]) -> Section:
    """Error over the scene."""
    frame = region_frame([shown.assessment for shown in formations])
    numbers = to_digits(4)
    frame["feasible"] = ["yes" if feasible else "no" for feasible in frame["feasible"]]
    limited = any(shown.assessment.constraints for shown in formations)
    blocks: list[Block] = [
        Table(
            frame,
            (
                Column("label", "Formation"),
                Column("region_rms_m", "Total, RMS", "m", numbers),
                Column("smallest_m", "min", "m", numbers),
                Column("largest_m", "max", "m", numbers),
                Column("relative_rms_m", "Relative, RMS", "m", numbers),
                *unwrapping_column(frame),
                *((Column("feasible", "Keeps all limits"),) if limited else ()),
            ),
            f"Height error over the {counted(len(problem.scene), 'segment')} of the scene. The "
            "relative error is the part that varies from pixel to pixel"
            + (
                ", and unwrapping the probability in the worst segment."
                if unwrapping_column(frame)
                else "."
            ),
        )
    ]
    blocks += _unmeasured([shown.assessment for shown in formations])
    drawn = [s for s in formations if not s.assessment.height_error.status.all()]
    if drawn:
        blocks.append(
            Figure(
                height_error_figure(drawn, problem.scene),
                "Height error of each segment; dashed, the RMS over the scene."
                + (
                    " Below, how it moves over the scene: its change against the RMS, which above "
                    "is too small to be seen."
                    if moves_little(drawn, problem.scene)
                    else ""
                ),
                "Line charts of the height error against scene time: total and relative.",
            )
        )
    return Section("height-error", "Height error", tuple(blocks))


def unwrapping_column(frame: pd.DataFrame) -> tuple[Column, ...]:
    """The probability of unwrapping in the worst segment, where it was assessed."""
    if frame["unwrapping_probability"].isna().all():
        return ()
    return (Column("unwrapping_probability", "Unwrapping", "", to_probabilities),)


def _unmeasured(assessments: Sequence[Assessment]) -> list[Block]:
    return [
        Paragraph(f"The {formation_name(one.label)} measures no height: {unmeasured_reason(one)}.")
        for one in assessments
        if not measured(one)
    ]


def attribution_section(formations: Sequence[Shown]) -> Section | None:
    """Contribution of each source; None where no formation measures a height."""
    drawn = [shown for shown in formations if measured(shown.assessment)]
    if not drawn:
        return None
    assessments = [shown.assessment for shown in drawn]
    columns = [Column("source", "Source")]
    for index, one in enumerate(assessments):
        columns += [
            Column(f"contribution_m_{index}", one.label, "m", _contributions),
            Column(f"share_{index}", "of variance", "", _percents),
        ]
    return Section(
        "attribution",
        "Where the error comes from",
        (
            Figure(
                attribution_figure(drawn),
                "Contribution of each source to the region's height error, and its part of the "
                "variance. Contributions add up as squares: their root sum square is the total. "
                "The scales differ where one error is more than four times the other.",
                "Bar charts of the contribution of each error source.",
            ),
            Table(
                shares_frame(assessments),
                tuple(columns),
                "Contributions at the optimal weights of the total error, RMS over the scene.",
            ),
        ),
    )


def _contributions(values: Sequence[float]) -> list[str]:
    return [significant(float(value)) for value in values]


def _percents(values: Sequence[float]) -> list[str]:
    return [percent(float(value)) for value in values]


def constraints_section(assessments: Sequence[Assessment]) -> Section:
    """How formations stand to the limits."""
    tables = tuple(_constraints_table(one) for one in assessments if one.constraints)
    if not tables:
        return Section("limits", "Limits", (Paragraph("The study sets no limits."),))
    text = (
        "The value is that of the worst satellite, pair or segment. A limit that is kept with less "
        f"than {100.0 * ACTIVE_MARGIN:g} % to spare, or a probability with less than "
        f"{100.0 * ACTIVE_FAILURE_MARGIN:g} % of the failure that its limit allows, is active: it "
        "holds the design back."
    )
    return Section("limits", "Limits", (Paragraph(text), *tables))


def _constraints_table(assessment: Assessment) -> Table:
    frame = constraints_frame(assessment)
    for key, word in (("value", value_text), ("limit", limit_text), ("margin", margin_text)):
        frame[key] = [word(report) for report in frame["report"]]
    marks = {"broken": Status.BAD, "kept, active": Status.WARNING, "kept": Status.NOTE}
    return Table(
        frame,
        (
            Column("name", "Limit on"),
            Column("value", "Value", "", list),
            Column("limit", "Required", "", list),
            Column("margin", "Margin", "", list),
            Column("state", "State"),
        ),
        f"Limits and the {formation_name(assessment.label)}.",
        tuple(marks[state] for state in frame["state"]),
    )
