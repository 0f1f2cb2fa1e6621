"""Section on the coherence budget: each pair, factor by factor."""

from __future__ import annotations

from functools import partial

import pandas as pd

from insar import BaselineDecorrelation
from optimize import Assessment, ImagePair, Problem

from ..document import Block, Column, Figure, Paragraph, Section, Table
from ..figures.coherence import coherence_figure
from ..reading import listed_pairs, pair_name
from ..tables import span
from ..wording import fixed, formation_name, to_span

_NAMES = {
    "noise": "Noise",
    "quantization": "Quantization",
    "ambiguities": "Ambiguities",
    "coregistration": "Co-registration",
    "processing": "Processing",
    "other": "Other",
    "volume": "Volume",
    "temporal": "Time",
}

_SIDE_BY_SIDE = 7
"""Columns beside the pair's name that one table holds."""

_tenths = partial(fixed, decimals=1)
_hundredths, _thousandths = partial(fixed, decimals=2), partial(fixed, decimals=3)


def coherence_section(problem: Problem, assessment: Assessment) -> Section | None:
    """The coherence of each pair, factor by factor; None of several acquisitions at once.

    Parameters
    ----------
    problem : scene, radar and errors.
    assessment : the formation.
    """
    pairs = [assessment.pairs[index] for index in listed_pairs(assessment)]
    if not pairs:
        return None
    names = [name for name in _NAMES if _counted(name, pairs)]
    frame = _frame(problem, assessment, pairs, names)
    pair = Column("pair", "Pair")
    factors = [Column(key, _NAMES[key], "", to_span(_thousandths)) for key in names]
    factors.append(Column("coherence", "Coherence", "", to_span(_thousandths)))
    bands = [Column("common_range", "Common range band", "", to_span(_thousandths))]
    if problem.radar.azimuth_resolution is not None and not problem.radar.pursuit:
        bands.append(Column("common_azimuth", "Common azimuth band", "", to_span(_thousandths)))
    bands.append(Column("looks", "Looks", "", to_span(_tenths)))
    if pairs[0].volume_bias is not None:
        bands.append(Column("volume_bias_m", "Volume bias", "m", to_span(_hundredths)))
    name = formation_name(assessment.label)
    budget = f"Coherence budget of the {name}"
    kept = "shares of the bands that the images of a pair have in common"
    tables = [
        Table(frame, (pair, *factors, *bands), f"{budget}: factors of each pair, and {kept}.")
    ]
    if len(factors) + len(bands) > _SIDE_BY_SIDE:
        tables = [
            Table(frame, (pair, *factors), f"{budget}: factors of each pair."),
            Table(frame, (pair, *bands), f"{budget}: {kept}."),
        ]
    blocks: list[Block] = [
        Paragraph(_text(problem, names)),
        *tables,
        Figure(
            coherence_figure(problem, assessment, pairs, {name: _NAMES[name] for name in names}),
            "What each factor takes, in the segment that loses most: −ln γ adds up over the "
            "factors, a loss of 0.1 being nearly 10 % of the coherence. Hatched: the share of the "
            "bands that two images do not have in common.",
            "Stacked bars of the loss of coherence by factor, one for each pair of images.",
        ),
    ]
    return Section("coherence", "Coherence budget", tuple(blocks))


def _counted(name: str, pairs: list[ImagePair]) -> bool:
    return any(name in pair.factors and bool((pair.factors[name] < 1.0).any()) for pair in pairs)


def _frame(
    problem: Problem, assessment: Assessment, pairs: list[ImagePair], names: list[str]
) -> pd.DataFrame:
    rows = []
    for pair in pairs:
        row: dict[str, object] = {"pair": pair_name(problem, assessment, pair.images)}
        row |= {name: span(pair.factors[name]) for name in names}
        row |= {
            "common_range": span(pair.common_range),
            "common_azimuth": span(pair.common_azimuth),
            "coherence": span(pair.coherence),
            "looks": span(pair.looks),
        }
        if pair.volume_bias is not None:
            row["volume_bias_m"] = span(pair.volume_bias)
        rows.append(row)
    return pd.DataFrame(rows)


def _text(problem: Problem, names: list[str]) -> str:
    radar, errors = problem.radar, problem.errors
    text = "The coherence of a pair is the product of its factors; one that is not shown is 1. "
    text += {
        BaselineDecorrelation.FILTERED: "Bands are filtered to their common part, which costs "
        "looks and no coherence.",
        BaselineDecorrelation.UNFILTERED: "Bands are not filtered: their common part is one more "
        "factor.",
        BaselineDecorrelation.NONE: "What baselines cost is neglected in this study.",
    }[errors.baseline_decorrelation]
    if radar.pursuit:
        text += (
            " Every image is monostatic, taken at zero Doppler when its satellite passes: "
            "separations along track cost time and no azimuth band."
        )
    elif radar.azimuth_resolution is None:
        text += (
            " The study gives no azimuth resolution: separations along track are taken to cost "
            "nothing."
        )
    if "volume" in names:
        text += (
            " The bias is the height above the ground that a pair reports of the volume; it "
            "differs between pairs, and is no part of the height error."
        )
    if errors.phase_std is not None:
        text += " The phase noise of this study is given, so that the coherence does not enter it."
    return text
