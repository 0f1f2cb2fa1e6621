"""The section that tells how far from the best possible the result is."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from optimize import OptimizeResult
from optimize.certificate import Certificate, Infeasibility, TargetVerdict

from ..certificate_words import METHODS, gap_text, target_text, verdict_text
from ..document import Block, Callout, Column, Figure, Paragraph, Section, Status, Table
from ..figures.certificate import certificate_figure
from ..wording import meters, to_digits

_EXHAUSTION = (
    "In a segment, height error and unwrapping depend on the formation only through the distances "
    "of its satellites along the direction in which height is sensed. Those few numbers were "
    "divided into boxes. In each box the most was assumed that any formation of it can have: the "
    "widest common bands, the longest baselines for the height error, the shortest for the "
    "unwrapping. A box whose assumed error is above what is known already, or which can't be "
    "unwrapped even so, holds no better formation; the others were divided further. Common bands "
    "only add information, so no formation can be better than assumed."
)


def certificate_section(result: OptimizeResult) -> Section:
    """Lower bound, its gap, what it rests on, or the proof that nothing is feasible."""
    certificate = result.certificate
    title = "How far from the best possible?"
    if certificate is None:
        text = verdict_text(None, result.certificate_reason)
        return Section("certificate", title, (Paragraph(text),))
    blocks: list[Block] = []
    if certificate.infeasibility is not None:
        blocks += _infeasible(certificate.infeasibility, "No formation keeps these limits, proven")
    else:
        blocks.append(Paragraph(verdict_text(certificate, "")))
        blocks += _target(certificate.target)
    if certificate.boxes:
        blocks.append(Paragraph(_EXHAUSTION))
    progress = certificate.convergence
    if progress is not None and np.isfinite(progress.best).any():
        blocks.append(
            Figure(
                certificate_figure(certificate),
                "The proof: lower bound of the height error, and the best formation met, as the "
                "boxes become smaller, for all segments or, where each has a proof of its own, for "
                "the largest group of like ones. Between the two lies what is not known yet.",
                "Line chart of the lower bound and the best height error against the number of "
                "boxes, closing in on each other.",
            )
        )
    if certificate.infeasibility is None:
        blocks.append(_bounds(certificate))
    if certificate.assumptions:
        blocks.append(Paragraph(" ".join(certificate.assumptions)))
    return Section("certificate", title, tuple(blocks))


def _target(target: TargetVerdict | None) -> list[Block]:
    if target is None:
        return []
    if target.impossible is None:
        return [Paragraph(target_text(target))]
    wanted = f"A height error of {meters(target.height_error, 4)} can't be reached, proven"
    return _infeasible(target.impossible, wanted)


def _infeasible(proof: Infeasibility, title: str) -> list[Block]:
    blocks: list[Block] = [Callout(Status.BAD, title, (proof.statement,))]
    if not proof.reliefs:
        blocks.append(Paragraph("No single limit or error, eased alone, was found to be enough."))
        return blocks
    frame = pd.DataFrame(
        [
            {
                "name": relief.name + (f" [{relief.unit}]" if relief.unit else ""),
                "limit": relief.limit,
                "blocks": relief.blocks_to,
                "passes": relief.passes_at,
            }
            for relief in proof.reliefs
        ]
    )
    digits = to_digits(4)
    blocks.append(
        Table(
            frame,
            (
                Column("name", "Limit or error"),
                Column("limit", "As it is", "", digits),
                Column("blocks", "Proven to block to", "", digits),
                Column("passes", "A formation passes at", "", digits),
            ),
            "What would help, each limit or error eased alone.",
        )
    )
    return blocks


def _bounds(certificate: Certificate) -> Table:
    strongest = certificate.strongest
    frame = pd.DataFrame(
        [
            {
                "method": METHODS[bound.method],
                "bound": bound.value,
                "gap": gap_text(certificate.objective / bound.value - 1.0)
                if math.isfinite(bound.value) and math.isfinite(certificate.objective)
                else "",
                "remark": bound.reason,
            }
            for bound in certificate.bounds
        ]
    )
    marks = tuple(
        Status.GOOD if strongest is not None and bound.method is strongest.method else Status.NOTE
        for bound in certificate.bounds
    )
    return Table(
        frame,
        (
            Column("method", "Bound"),
            Column("bound", "No formation below", "m", to_digits(5)),
            Column("gap", "Ours is above by"),
            Column("remark", "Remark"),
        ),
        "Lower bounds of the height error of the region. Each holds; the largest counts. "
        + (f"{certificate.boxes} boxes were looked at." if certificate.boxes else ""),
        marks,
    )
