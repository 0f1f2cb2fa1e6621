"""The report of a study of kind `simulate`: heights of a terrain, end to end."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd
from numpy.typing import NDArray

from insar.simulation import TerrainSimulation

from ..document import (
    Column,
    Document,
    Figure,
    Paragraph,
    Section,
    Table,
)
from ..figures.terrain import error_histogram_figure, error_maps_figure, terrain_figure
from ..json_simulate import simulate_json
from ..study import Provenance, StudyInfo
from ..wording import counted, fixed, plain, quantity, to_decimals
from . import sections
from .closing import closing_sections, facts
from .simulate_verdict import simulate_verdict


def document(result: TerrainSimulation, study: StudyInfo, provenance: Provenance) -> Document:
    """Report of a simulated terrain."""
    return sections.document(
        study,
        provenance,
        Section("result", "Result", simulate_verdict(result)),
        _terrain_section(result),
        _error_section(result),
        _methods_section(result),
        *closing_sections(_setting(result, study), study, provenance),
    )


def json(result: TerrainSimulation) -> dict[str, Any]:
    """Part of ``result.json`` that belongs to a simulated terrain."""
    return simulate_json(result)


def csv(result: TerrainSimulation) -> dict[str, pd.DataFrame]:
    """Tables of a simulated terrain: predicted against simulated."""
    return {"simulation.csv": _frame(result)}


def arrays(result: TerrainSimulation) -> dict[str, NDArray[Any]]:
    """Maps of a simulated terrain, SI units, for ``maps.npz``."""
    view, maps = result.request.view, result.maps
    return {
        "east_m": view.terrain.east,
        "north_m": view.terrain.north,
        "height_m": view.terrain.heights,
        "slope_rad": view.slope,
        "layover": view.layover,
        "shadow": view.shadow,
        "clear": maps.clear,
        "phase_rad": maps.phase,
        "residual_phase_rad": maps.residual_phase,
        "coherence": maps.coherence,
        "predicted_total_m": maps.predicted_total,
        "predicted_relative_m": maps.predicted_relative,
        "predicted_wrong_cycles": maps.predicted_failure,
        "prior_error_m": maps.prior_error,
        "random_error_m": maps.random_error,
        "least_squares_error_m": maps.least_squares_error,
        "most_likely_error_m": maps.likely_error,
        "wrong_cycle": maps.wrong,
    }


def _frame(result: TerrainSimulation) -> pd.DataFrame:
    rows = [
        ("random error, right cycles [m]", result.random),
        ("total error, right cycles [m]", result.total),
        ("share of points with a wrong cycle", result.wrong),
    ]
    return pd.DataFrame(
        [
            {
                "quantity": name,
                "predicted": comparison.predicted,
                "simulated": comparison.simulated.value,
                "sampling_error": comparison.simulated.sampling_error,
                "deviation": comparison.deviation,
            }
            for name, comparison in rows
        ]
    )


def _terrain_section(result: TerrainSimulation) -> Section:
    radar = result.request.radar
    names = tuple(f"1–{number}" for number in range(2, len(radar.images) + 1))
    return Section(
        "terrain",
        "The terrain as it is seen",
        (
            Figure(
                terrain_figure(result, names),
                "(a) Terrain, north up, with the directions of flight and look; red: layover, "
                "black: shadow, orange: slopes where some image has next to no common band with "
                "the others. (b) Interferogram of the images closest to each other, less what the "
                "mean height would give; steep slopes turn it faster than the posting can follow. "
                "(c) The one of the images furthest apart, less what the heights known beforehand "
                "would give: what is unwrapped. (d) Coherence of the latter images, before "
                "filtering to the common band.",
                "Four maps: terrain, two interferograms, coherence.",
            ),
        ),
    )


def _error_section(result: TerrainSimulation) -> Section:
    frame = _frame(result)
    decimals = to_decimals(4)
    return Section(
        "errors",
        "Height errors, predicted and simulated",
        (
            Table(
                frame,
                (
                    Column("quantity", "Quantity"),
                    Column("predicted", "Predicted", "", decimals),
                    Column("simulated", "Simulated", "", decimals),
                    Column("sampling_error", "Sampling error", "", decimals),
                    Column("deviation", "z", "", to_decimals(1)),
                ),
                f"Over {counted(result.points, 'clear point')} and "
                f"{counted(len(result.offsets), 'acquisition')}. Noise is drawn for each "
                "point, the errors of the scene once for each acquisition: few of them know the "
                "total badly.",
            ),
            Figure(
                error_maps_figure(result),
                "Height errors of the first acquisition: (a) weighted least squares with the "
                "cycles that bootstrapping finds, (b) maximum likelihood with the prior, (c) the "
                "elevation model known beforehand, (d) the total error as predicted.",
                "Four maps of height errors.",
            ),
            Figure(
                error_histogram_figure(result),
                "(a) Height errors of the first acquisition against the prediction for right "
                "cycles; wrong cycles stand apart. (b) Error by noise in bins of equal numbers of "
                "points, with three sampling errors, against the prediction.",
                "Histogram of height errors; random error against the slope of the terrain.",
            ),
        ),
    )


def _methods_section(result: TerrainSimulation) -> Section:
    request = result.request
    return Section(
        "methods",
        "How it was computed",
        (
            Paragraph(
                "Each point of the terrain lies on a sphere, at its height, in the plane of zero "
                "Doppler of the reference orbit. Its phase in an image is −2π/λ times the exact "
                "path from the transmitter to the point and on to the receiver, where both "
                "satellites really are; the processor thinks them elsewhere, by errors drawn once "
                "an acquisition. Speckle and noise are drawn look by look, each image in the band "
                "of the ground's spectrum that the local slope gives it."
            ),
            Paragraph(
                "The processor knows range and zero-Doppler time of a pixel, and an elevation "
                f"model with smooth errors of {quantity(plain(request.prior_height_std), 'm')}. It "
                "subtracts the phases that this height would have at that range, unwraps what is "
                "left along the ladder of the error model, and turns it into a height by weighted "
                "least squares and by maximum likelihood; both then take one more step by the "
                "exact paths. The prediction is the error model's, point by point, for the local "
                "incidence and slope."
            ),
            Paragraph(
                "Not simulated: focusing, co-registration, geocoding with the wrong height, the "
                "rotation of the Earth, backscatter that varies with the slope."
            ),
        ),
    )


def _setting(result: TerrainSimulation, study: StudyInfo) -> Table:
    request = result.request
    view, radar = request.view, request.radar
    rows, columns = view.terrain.shape
    facts_ = [
        ("terrain", f"{rows} × {columns} points"),
        (
            "posting, north and east",
            f"{fixed(view.terrain.posting_north, 1)} m, {fixed(view.terrain.posting_east, 1)} m",
        ),
        ("look at the middle", f"{fixed(math.degrees(view.look_angle), 2)}°"),
        ("heading", f"{fixed(math.degrees(view.heading), 1)}° from north"),
        ("side", view.side.name.lower()),
        ("images", str(len(radar.images))),
        ("wavelength", quantity(plain(radar.wavelength), "m")),
        ("slant-range resolution", quantity(plain(radar.slant_range_resolution), "m")),
        ("looks", plain(radar.looks)),
        ("acquisitions", str(len(result.offsets))),
    ]
    if study.orbit_altitude is not None:
        facts_.insert(0, ("orbit altitude", f"{fixed(study.orbit_altitude / 1e3, 1)} km"))
    return facts(facts_, "The setting: orbit, radar and terrain.")
