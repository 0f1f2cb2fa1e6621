"""Results of a study of kind ``coverage``; targets and candidates are in the CSV files."""

from __future__ import annotations

import numpy as np

from insar.observe.coverage.results import Coverage, CoverageResult, SizingShortfall, WalkerSearch
from insar.observe.coverage.walker import Visibility, Walker

from .agile_words import side_name, verdict_name
from .json_claims import claims_json
from .json_numbers import Json, finite, finite_list


def coverage_json(result: CoverageResult) -> Json:
    """Sizing and its shortfall, simulations, and what the search found."""
    return {
        "coverage": {
            "sizing": None if result.shortfall is None else _sizing(result.shortfall),
            "simulations": [_simulation(one) for one in result.simulations],
            "search": None if result.search is None else _search(result.search),
            "claims": claims_json(result.claims),
        },
        "warnings": list(result.warnings),
    }


def _walker(walker: Walker) -> Json:
    return {
        "altitude_m": finite(walker.altitude),
        "inclination_rad": finite(walker.inclination),
        "satellites": walker.total,
        "planes": walker.planes,
        "phasing": walker.phasing,
    }


def _visibility(visibility: Visibility) -> Json:
    return {
        "min_incidence_rad": finite(visibility.min_incidence),
        "max_incidence_rad": finite(visibility.max_incidence),
        "side": "either" if visibility.side is None else side_name(visibility.side),
    }


def _sizing(found: SizingShortfall) -> Json:
    sizing = found.sizing
    return {
        "walker": _walker(found.walker),
        "visibility": _visibility(found.visibility),
        "latitude_rad": finite(found.latitude),
        "max_incidence_rad": finite(sizing.max_incidence),
        "half_angle_rad": finite(sizing.half_angle),
        "period_s": finite(sizing.period),
        "view_time_s": finite(sizing.view_time),
        "node_shift_rad": finite(sizing.node_shift),
        "satellites_per_plane": sizing.satellites_per_plane,
        "cover": {
            "in_plane": finite(found.in_plane),
            "held_least": finite(found.held_least),
            "held_most": finite(found.held_most),
            "spacing": finite(found.spacing),
            "spacing_and_nadir": finite(found.spacing_and_nadir),
            "spacing_and_side": finite(found.spacing_and_side),
            "all_reasons": finite(found.all_reasons),
        },
        "seen_by": finite(found.seen_by),
    }


def _simulation(one: Coverage) -> Json:
    never = bool(np.any(one.accesses == 0))
    latitudes, rows = np.unique(one.latitude, return_inverse=True)
    groups = [rows.ravel() == index for index in range(latitudes.size)]
    return {
        "walker": _walker(one.walker),
        "visibility": _visibility(one.visibility),
        "duration_s": finite(one.duration),
        "targets": one.cover.size,
        "min_cover": finite(one.cover.min()),
        "mean_cover": finite(one.cover.mean()),
        "max_gap_s": finite(one.longest_gap.max()),
        "latitudes_rad": finite_list(latitudes),
        "cover": finite_list(one.cover.ravel()[group].mean() for group in groups),
        "longest_gaps_s": finite_list(one.longest_gap.ravel()[group].max() for group in groups),
        "reason": "a place is never seen: its gap is the whole window" if never else None,
    }


def _search(search: WalkerSearch) -> Json:
    verdicts, counts = np.unique(search.candidates.verdict, return_counts=True)
    return {
        "altitude_m": finite(search.altitude),
        "visibility": _visibility(search.visibility),
        "latitudes_rad": finite_list(search.latitudes),
        "least_satellites": search.least_total,
        "gap_resolution_s": finite(search.gap_resolution),
        "candidates": int(search.candidates.total.size),
        "verdicts": {
            verdict_name(int(verdict)): int(count)
            for verdict, count in zip(verdicts, counts, strict=True)
        },
        "best": None if search.best is None else _walker(search.best),
        "reason": None
        if search.best is not None
        else "no pattern of the range searched is continuous",
    }
