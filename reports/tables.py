"""The tables behind CSV, HTML and PDF: one frame each, in SI or with the unit in the name."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from insar import HeightStatus
from optimize import Assessment, Problem, SearchResult

from .reading import (
    active,
    decorrelation_neglected,
    pair_name,
    rung_numbers,
    shares,
)
from .wording import Span, source_name

_DECIMALS = {"_deg": 7, "_hz": 6}
"""By the unit: 0.1 µ° is a centimeter on the ground, and a µHz the rounding of a Doppler."""

_STATE_COLUMNS = ("r_m", "t_m", "n_m", "vr_m_s", "vt_m_s", "vn_m_s")


def csv_bytes(frame: pd.DataFrame) -> bytes:
    """Frame as CSV (UTF-8): every digit that means something, empty where there is no number."""
    finite = frame.replace([np.inf, -np.inf], np.nan)
    for name in finite.columns[finite.dtypes == np.float64]:
        for unit, decimals in _DECIMALS.items():
            if name.endswith(unit):
                finite[name] = finite[name].round(decimals) + 0.0  # + 0.0 turns −0 into 0
    text: str = finite.to_csv(index=False, lineterminator="\n", na_rep="")
    return text.encode()


def formation_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """States at t = 0, a row for each satellite of each formation whose orbits are known."""
    rows = [
        {"label": assessment.label, "satellite": name, "z0_m": state[0], "zdot0_m_s": state[3]}
        | dict(zip(_STATE_COLUMNS, state.tolist(), strict=True))
        for assessment in assessments
        if assessment.motion is not None
        for name, state in zip(assessment.names, assessment.motion.states, strict=True)
    ]
    return pd.DataFrame(rows)


def positions_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """Positions at the scene's times: a row for each satellite and segment of each formation."""
    rows = [
        {"label": assessment.label, "satellite": name, "segment": segment}
        | dict(zip(_STATE_COLUMNS[:3], position.tolist(), strict=True))
        for assessment in assessments
        if not assessment.acquisitions
        for index, name in enumerate(assessment.names)
        for segment, position in enumerate(assessment.scene_positions[:, index], 1)
    ]
    return pd.DataFrame(rows)


def placed_frame(assessment: Assessment) -> pd.DataFrame:
    """Positions of the satellites over the scene, what varies as a `Span`."""
    return pd.DataFrame(
        [
            {"satellite": name}
            | {
                key: span(assessment.scene_positions[:, index, axis])
                for axis, key in enumerate(_STATE_COLUMNS[:3])
            }
            for index, name in enumerate(assessment.names)
        ]
    )


def height_error_frame(problem: Problem, assessments: Sequence[Assessment]) -> pd.DataFrame:
    """Height error of each segment of each formation, with the geometry of the segment."""
    return pd.concat([_segments(problem, one) for one in assessments], ignore_index=True)


def _segments(problem: Problem, assessment: Assessment) -> pd.DataFrame:
    scene, error = problem.scene, assessment.height_error
    count = len(scene)
    unwrapping = assessment.unwrapping
    return pd.DataFrame(
        {
            "label": [assessment.label] * count,
            "segment": np.arange(1, count + 1),
            "time_s": scene.times,
            "slant_range_m": scene.slant_range,
            "look_deg": np.rad2deg(scene.look_angle),
            "azimuth_deg": np.rad2deg(scene.azimuth),
            "incidence_deg": np.rad2deg(scene.incidence),
            "total_m": error.total,
            "relative_m": error.relative,
            **{f"{name}_m": term for name, term in error.terms.items()},
            "unwrapping_probability": np.full(count, np.nan)
            if unwrapping is None
            else unwrapping.probability,
            "reason": [
                "" if value == HeightStatus.MEASURED else HeightStatus(value).reason
                for value in error.status
            ],
        }
    )


def region_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """Height error over the scene, a row for each formation."""
    rows = []
    for assessment in assessments:
        error, unwrapping = assessment.height_error, assessment.unwrapping
        rows.append(
            {
                "label": assessment.label,
                "region_rms_m": float(error.region),
                "smallest_m": float(error.total.min()),
                "largest_m": float(error.total.max()),
                "relative_rms_m": float(error.relative_region),
                "unwrapping_probability": math.nan
                if unwrapping is None
                else float(unwrapping.probability.min()),
                "feasible": assessment.feasible,
            }
        )
    return pd.DataFrame(rows)


def comparison_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """Formations side by side."""
    frame = region_frame(assessments)
    frame["baseline_over_critical"] = [
        max(float(pair.baseline_over_critical.max()) for pair in one.pairs) for one in assessments
    ]
    frame["min_separation_m"] = [
        math.nan
        if one.motion is None or not one.motion.separations.size
        else float(one.motion.separations.min())
        for one in assessments
    ]
    return frame


def pairs_frame(problem: Problem, assessment: Assessment) -> pd.DataFrame:
    """Pairs of images; what may vary over the scene as a `Span`."""
    rungs = rung_numbers(assessment)
    beyond = "counted all the same" if decorrelation_neglected(problem) else "not coherent"
    return pd.DataFrame(
        [
            {
                "pair": pair_name(problem, assessment, pair.images),
                "perpendicular_baseline_m": span(pair.perpendicular_baseline),
                "azimuth_baseline_m": span(pair.azimuth_baseline),
                "baseline_over_critical": span(pair.baseline_over_critical),
                "height_of_ambiguity_m": span(pair.height_of_ambiguity),
                "coherence": span(pair.coherence),
                "looks": span(pair.looks),
                "rung": str(rungs.get(pair.images, "")),
                "remark": beyond if np.any(pair.baseline_over_critical >= 1.0) else "",
            }
            for pair in assessment.pairs
        ]
    )


def span(values: NDArray[np.float64]) -> Span:
    """What varies over the scene: the smallest, the middle and the largest value."""
    return Span(float(values.min()), float(values[values.size // 2]), float(values.max()))


def rungs_frame(problem: Problem, assessment: Assessment) -> pd.DataFrame:
    """The unwrapping ladder in the worst segment, a row for each rung; empty without a prior."""
    unwrapping = assessment.unwrapping
    if unwrapping is None:
        return pd.DataFrame()
    return pd.DataFrame(
        [
            {
                "rung": number,
                "pair": pair_name(problem, assessment, rung.images),
                "height_of_ambiguity_m": rung.height_of_ambiguity,
                "phase_std_rad": rung.phase_std,
                "probability": rung.probability,
            }
            for number, rung in enumerate(unwrapping.rungs, 1)
        ]
    )


def shares_frame(assessments: Sequence[Assessment]) -> pd.DataFrame:
    """Contribution of each source: two columns for each formation, numbered from 0."""
    by_source = [{share.source: share for share in shares(one)} for one in assessments]
    order = [share.source for share in shares(assessments[-1])]
    order += [source for found in by_source for source in found if source not in order]
    rows = []
    for source in dict.fromkeys(order):
        row: dict[str, object] = {"source": source_name(source)}
        for index, found in enumerate(by_source):
            share = found.get(source)
            row[f"contribution_m_{index}"] = share.contribution if share else math.nan
            row[f"share_{index}"] = share.variance_share if share else math.nan
        rows.append(row)
    return pd.DataFrame(rows)


def constraints_frame(assessment: Assessment) -> pd.DataFrame:
    """How a formation stands to each limit."""
    return pd.DataFrame(
        [
            {
                "name": report.limit.name,
                "report": report,
                "state": "broken"
                if not report.satisfied
                else "kept, active"
                if active(report)
                else "kept",
            }
            for report in assessment.constraints
        ]
    )


def history_frame(search: SearchResult) -> pd.DataFrame:
    """Convergence history, a row for each generation."""
    return pd.DataFrame(
        {
            "generation": [record.generation for record in search.history],
            "evaluations": [record.evaluations for record in search.history],
            "best_m": [record.best for record in search.history],
            "mean_m": [record.mean for record in search.history],
            "feasible_fraction": [record.feasible_fraction for record in search.history],
        }
    )
