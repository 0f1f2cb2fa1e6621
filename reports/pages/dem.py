"""Sections on the elevation model that a formation makes, and on what limits it."""

from __future__ import annotations

import math

from insar import Calibration
from optimize import DemVerdict, FailedDemand, Problem
from optimize.sensitivity import REACH, Quantity

from ..dem_words import DEMANDS, QUANTITIES, SCALES, item_name, item_value
from ..document import (
    Block,
    Callout,
    Column,
    Figure,
    Metric,
    Metrics,
    Paragraph,
    Section,
    Status,
    Table,
)
from ..figures.sensitivity import sensitivity_figure, telling
from ..tables_dem import criteria_frame, elasticities_frame, remedies_frame, scales_frame
from ..wording import formation_name, meters, plain, quantity, sentences, to_decimals, to_digits

_FEW = 3
"""Remedies named in the verdict."""


def dem_section(problem: Problem, dem: DemVerdict | None) -> Section | None:
    """Relative and absolute error, by scale, and the classes that they make; None without one."""
    if dem is None:
        return None
    accuracy = dem.accuracy
    blocks: list[Block] = [_verdict(dem)] if dem.judgments else []
    blocks.append(_metrics(dem))
    blocks.append(Paragraph(_definitions(dem)))
    if dem.judgments:
        frame = criteria_frame(dem)
        blocks.append(
            Table(
                frame,
                (
                    Column("specification", "Class"),
                    Column("quantity", "Demand"),
                    Column("value_m", "Model", "m", to_digits(3)),
                    Column("limit_m", "Limit", "m", to_digits(3)),
                    Column("segment", "Segment"),
                    Column("verdict", "Verdict"),
                ),
                "Demands of each class and the model's values, in the segment where it stands "
                "worst to the limit of that terrain's slope.",
                tuple(Status.GOOD if text == "pass" else Status.BAD for text in frame["verdict"]),
            )
        )
    if math.isfinite(float(accuracy.absolute.max())):
        blocks.append(_scales(dem, problem.errors.calibration))
    blocks += [Paragraph(text) for text in sentences(dem.notes)]
    return Section("dem", "Elevation model", tuple(blocks))


def limits_section(problem: Problem, dem: DemVerdict | None) -> Section | None:
    """What the errors answer to, and what would have to improve; None if nothing is measured."""
    if dem is None:
        return None
    found = telling(dem.sensitivities)
    if not found:
        return None
    prior = problem.constraints.prior_height_std is not None
    blocks: list[Block] = [
        Paragraph(
            f"Elasticities of the {formation_name(dem.label)}: by how many percent an error "
            "changes if one item of the budget changes by one percent and all else stays, the "
            "formation too. An item without a bar does not limit the elevation model."
        ),
        Figure(
            sensitivity_figure(found),
            "What the relative and the absolute error at 90 % answer to, in the worst segment; "
            "the item's value in parentheses.",
            "Bar chart of the elasticities of the relative and the absolute height error.",
        ),
    ]
    shown = [one for one in Quantity if one is not Quantity.FAILURE or prior]
    blocks.append(
        Table(
            elasticities_frame(dem),
            (
                Column("item", "Item"),
                Column("value", "Value"),
                *(Column(str(one), QUANTITIES[one], "", to_decimals(2)) for one in shown),
            ),
            "Elasticities. The total is that of the search: RMS over the scene, before any "
            "calibration"
            + (
                "; a wrong cycle is the probability that unwrapping fails in the worst segment."
                if prior
                else "."
            ),
        )
    )
    blocks += [_remedies(failed, prior) for failed in dem.failed if failed.remedies]
    return Section("improvements", "What limits it", tuple(blocks))


def _verdict(dem: DemVerdict) -> Callout:
    passed = [one.specification.name for one in dem.judgments if one.passed]
    failed = [one.specification.name for one in dem.judgments if not one.passed]
    parts = []
    if passed:
        parts.append(f"passes {', '.join(passed)}")
    if failed:
        parts.append(f"fails {', '.join(failed)}")
    status = Status.GOOD if not failed else Status.BAD if not passed else Status.WARNING
    return Callout(status, f"The elevation model {' and '.join(parts)}", tuple(_lines(dem)))


def _lines(dem: DemVerdict) -> list[str]:
    """One sentence for each demand that fails, with the nearest remedies."""
    lines = []
    for failed in dem.failed:
        one = failed.criterion
        text = (
            f"{failed.specification}: {DEMANDS[one.quantity]} {meters(one.value)}, more than the "
            f"{meters(one.limit)} allowed."
        )
        enough = [remedy for remedy in failed.remedies if remedy.needed is not None][:_FEW]
        if enough:
            each = [
                f"{item_name(remedy.item)} {item_value(remedy.item, remedy.needed)} instead of "
                f"{item_value(remedy.item, remedy.value)}"
                for remedy in enough
            ]
            text += f" It would pass with {', or '.join(each)}, all else as it is."
        elif failed.remedies:
            text += (
                f" No single item of the budget brings it there, within a factor of {REACH:g}: "
                "several must improve."
            )
        lines.append(text)
    return lines


def _metrics(dem: DemVerdict) -> Metrics:
    accuracy = dem.accuracy
    items = [
        Metric(
            "Relative, 90 %",
            meters(float(accuracy.relative_90.max())),
            f"point to point in {_km(accuracy.cell.size)}, worst segment",
        ),
        Metric(
            "Absolute, 90 %",
            meters(float(accuracy.absolute_90.max())),
            "after calibration, worst segment"
            if accuracy.residual is not None
            else "not calibrated, worst segment",
        ),
    ]
    if dem.posting is not None:
        stated = "asked for" if dem.request.posting is not None else "of the looks"
        items.append(Metric("Posting", meters(dem.posting), stated))
    return Metrics(tuple(items))


def _definitions(dem: DemVerdict) -> str:
    cell = dem.accuracy.cell
    text = (
        "Absolute is the error of a height against the datum, everything counted that calibration "
        "leaves. Relative is the error of the difference of two heights within a cell of "
        f"{_km(cell.size)}: random errors of the two points add, and of what both have in common "
        "only the tilt remains."
    )
    if cell.crosses_scenes:
        text += (
            f" The cell is wider than the swath of {_km(cell.swath)}, so that the two points may "
            "belong to different scenes, which share neither errors of a scene nor of a data take."
        )
    return (
        f"{text} Both are of the worst pair and segment. Phase noise counts with the exact "
        "quantile of its multilook distribution, everything else with 1.645 standard deviations."
    )


def _scales(dem: DemVerdict, calibration: Calibration | None) -> Table:
    columns = [
        Column("source", "Error"),
        Column("scale", "Same over"),
        Column("offset_m", "Offset", "m", to_digits(3)),
        Column("tilt_mm_km", "Tilt", "mm/km", to_digits(3)),
    ]
    caption = (
        "Errors by scale, 1σ: the offset in the middle of the swath and the tilt across it, RMS "
        "over the segments."
    )
    if calibration is not None:
        columns.append(Column("calibrated", "Calibration"))
        caption += (
            f" The calibration adjusts offset and tilts of each {SCALES[calibration.over]} to "
            f"{calibration.count:.4g} control points, {plain(calibration.spacing_across / 1e3)} by "
            f"{plain(calibration.spacing_along / 1e3)} km apart and accurate to "
            f"{quantity(plain(calibration.accuracy), 'm')}"
        )
        bias = quantity(plain(calibration.bias), "m")
        caption += f", with a common bias of {bias}." if calibration.bias > 0.0 else "."
    return Table(scales_frame(dem), tuple(columns), caption)


def _remedies(failed: FailedDemand, prior: bool) -> Table:
    columns = [
        Column("item", "Item"),
        Column("value", "Value"),
        Column("needed", "Needed"),
        Column("change", "Change"),
    ]
    caption = (
        f"{failed.specification}, {DEMANDS[failed.criterion.quantity]}: value of each item at "
        f"which {meters(failed.criterion.limit)} would be kept, all else as it is; the smallest "
        f"change first, tried up to a factor of {REACH:g}."
    )
    if prior:
        columns.append(Column("probability", "Unwrapped"))
        caption += " The last column is the probability of right unwrapping there."
    return Table(remedies_frame(failed, prior=prior), tuple(columns), caption)


def _km(length: float) -> str:
    return quantity(plain(length / 1e3), "km")
