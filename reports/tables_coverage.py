"""Tables of a study of coverage."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from insar.observe.coverage.results import Coverage, CoverageResult, WalkerSearch

from .agile_words import verdict_name, walker_name
from .tables_steering import claims_frame

MINUTE = 60.0
DAY = 86400.0


def coverage_frame(simulations: tuple[Coverage, ...]) -> pd.DataFrame:
    """Cover and gaps, a row for each target of each constellation."""
    return pd.concat([_targets(one, number) for number, one in enumerate(simulations, 1)])


def _targets(one: Coverage, number: int) -> pd.DataFrame:
    walker, count = one.walker, one.cover.size
    return pd.DataFrame(
        {
            "constellation": [number] * count,
            "altitude_m": walker.altitude,
            "inclination_deg": math.degrees(walker.inclination),
            "satellites": walker.total,
            "planes": walker.planes,
            "phasing": walker.phasing,
            "latitude_deg": np.rad2deg(one.latitude).ravel(),
            "longitude_deg": np.rad2deg(one.longitude).ravel(),
            "cover": one.cover.ravel(),
            "seen_by": one.seen_by.ravel(),
            "longest_gap_s": one.longest_gap.ravel(),
            "mean_gap_s": one.mean_gap.ravel(),
            "mean_wait_s": one.mean_wait.ravel(),
            "gaps": one.gaps.ravel(),
            "accesses": one.accesses.ravel(),
            "mean_access_s": one.mean_access.ravel(),
        }
    )


def constellations_frame(simulations: tuple[Coverage, ...]) -> pd.DataFrame:
    """What each constellation keeps in view, a row for each."""
    return pd.DataFrame(
        [
            {
                "number": number,
                "name": walker_name(one.walker),
                "satellites": one.walker.total,
                "least": 100.0 * float(one.cover.min()),
                "mean": 100.0 * float(one.cover.mean()),
                "seen_by": float(one.seen_by.mean()),
                "longest": float(one.longest_gap.max()) / MINUTE,
                "wait": float(one.mean_wait.max()) / MINUTE,
                "accesses": float(one.accesses.mean()) * DAY / one.duration,
                "access": float(np.nanmean(one.mean_access)) / MINUTE
                if np.any(np.isfinite(one.mean_access))
                else math.nan,
            }
            for number, one in enumerate(simulations, 1)
        ]
    )


def candidates_frame(search: WalkerSearch) -> pd.DataFrame:
    """Every pattern searched, a row for each."""
    found = search.candidates
    return pd.DataFrame(
        {
            "satellites": found.total,
            "planes": found.planes,
            "phasing": found.phasing,
            "inclination_deg": np.rad2deg(found.inclination),
            "cover": found.cover,
            "longest_gap_s": np.where(np.isfinite(found.longest_gap), found.longest_gap, np.nan),
            "verdict": [verdict_name(value) for value in found.verdict],
        }
    )


def best_frame(search: WalkerSearch, most: int) -> pd.DataFrame:
    """The last totals searched and what comes nearest to continuous cover with each."""
    frame = candidates_frame(search)
    frame["order"] = (frame["verdict"] != "continuous").astype(int)
    frame = frame.sort_values(
        ["order", "cover", "longest_gap_s", "planes", "inclination_deg", "phasing"],
        ascending=[True, False, True, True, True, True],
        kind="stable",
    )
    best = frame.groupby("satellites", sort=True).head(1).sort_values("satellites")
    return best.tail(most).drop(columns="order").reset_index(drop=True)


def coverage_tables(result: CoverageResult) -> dict[str, pd.DataFrame]:
    """Tables by the name of their file."""
    tables = {}
    if result.simulations:
        tables["coverage.csv"] = coverage_frame(result.simulations)
    if result.search is not None:
        tables["candidates.csv"] = candidates_frame(result.search)
    if result.claims:
        tables["claims.csv"] = claims_frame(result.claims)
    return tables
