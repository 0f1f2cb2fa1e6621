"""One page for each type of result; a new kind of study adds a module and a line here."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import pandas as pd
from numpy.typing import NDArray

from insar.observe import SteeringResult
from insar.observe.agile.spotlight_results import SpotlightResult
from insar.observe.agile.video_results import VideoResult
from insar.observe.coverage.results import CoverageResult
from insar.simulation import TerrainSimulation
from optimize import EvaluateResult, OptimizeResult

from ..document import Document
from ..study import Provenance, StudyInfo
from . import coverage, evaluate, optimize, simulate, spotlight, steering, video


class Page(NamedTuple):
    """How a type of result is reported.

    Attributes
    ----------
    document : result, study and provenance → the report.
    json : result → its part of ``result.json``.
    csv : result → file name → table.
    arrays : result → name → array, for ``maps.npz``; none for most.
    """

    document: Callable[[Any, StudyInfo, Provenance], Document]
    json: Callable[[Any], dict[str, Any]]
    csv: Callable[[Any], dict[str, pd.DataFrame]]
    arrays: Callable[[Any], dict[str, NDArray[Any]]] = lambda _: {}


_PAGES: dict[type, Page] = {
    OptimizeResult: Page(optimize.document, optimize.json, optimize.csv),
    EvaluateResult: Page(evaluate.document, evaluate.json, evaluate.csv),
    SteeringResult: Page(steering.document, steering.json, steering.csv),
    SpotlightResult: Page(spotlight.document, spotlight.json, spotlight.csv),
    VideoResult: Page(video.document, video.json, video.csv),
    TerrainSimulation: Page(simulate.document, simulate.json, simulate.csv, simulate.arrays),
    CoverageResult: Page(coverage.document, coverage.json, coverage.csv),
}


def page_of(result: object) -> Page:
    """Page for a result.

    Parameters
    ----------
    result : of a registered type.

    Raises
    ------
    TypeError
        If the type is not registered.
    """
    page = _PAGES.get(type(result))
    if page is None:
        known = ", ".join(kind.__name__ for kind in _PAGES)
        raise TypeError(f"no report page for {type(result).__name__}; there are pages for {known}")
    return page
