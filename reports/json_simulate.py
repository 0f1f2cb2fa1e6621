"""A simulated terrain in the machine-readable result."""

from __future__ import annotations

import numpy as np

from insar.simulation import Comparison, TerrainSimulation

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
            "random": _height(result.random),
            "total": _height(result.total),
            "wrong_cycles": {
                "predicted": finite(result.wrong.predicted),
                "simulated": finite(result.wrong.simulated.value),
                "sampling_error": finite(result.wrong.simulated.sampling_error),
                "deviation": finite(result.wrong.deviation),
            },
            "least_squares_rms_m": finite(result.least_squares),
            "most_likely_rms_m": finite(result.most_likely),
            "prior_rms_m": finite(result.prior),
            "offsets_m": finite_list(result.offsets),
            "departures": list(result.departures),
        },
        "warnings": [],
    }


def _height(comparison: Comparison) -> Json:
    return {
        "predicted_m": finite(comparison.predicted),
        "simulated_m": finite(comparison.simulated.value),
        "sampling_error_m": finite(comparison.simulated.sampling_error),
        "deviation": finite(comparison.deviation),
    }
