"""A simulated terrain in the machine-readable result."""

from __future__ import annotations

import numpy as np

from insar.simulation import TerrainSimulation

from .json_comparison import height_comparison, share_comparison
from .json_numbers import Json, finite, finite_list


def simulate_json(result: TerrainSimulation) -> Json:
    """Results of a study of kind ``simulate``."""
    request, maps = result.request, result.maps
    view = request.view
    rows, columns = view.terrain.shape
    total = rows * columns
    return {
        "simulate": {
            "terrain": {
                "rows": rows,
                "columns": columns,
                "posting_north_m": finite(view.terrain.posting_north),
                "posting_east_m": finite(view.terrain.posting_east),
                "min_height_m": finite(np.nanmin(view.terrain.heights)),
                "max_height_m": finite(np.nanmax(view.terrain.heights)),
                "layover_fraction": finite(np.count_nonzero(view.layover) / total),
                "shadow_fraction": finite(np.count_nonzero(view.shadow) / total),
                "clear_fraction": finite(np.count_nonzero(maps.clear) / total),
            },
            "acquisitions": len(result.offsets),
            "points": result.points,
            "prior_height_std_m": finite(request.prior_height_std),
            "random": height_comparison(result.random),
            "total": height_comparison(result.total),
            "wrong_cycles": share_comparison(result.wrong),
            "least_squares_rms_m": finite(result.least_squares),
            "most_likely_rms_m": finite(result.most_likely),
            "prior_rms_m": finite(result.prior),
            "offsets_m": finite_list(result.offsets),
            "departures": list(result.departures),
        },
        "warnings": [],
    }
