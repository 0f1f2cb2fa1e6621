"""Runs a study of kind `coverage`: sizing, simulation, and search of the smallest constellation."""

from __future__ import annotations

import dataclasses

import numpy as np

from configs import BuildError, CoverageStudy
from configs.covered import CoverageSetup, SearchTask
from insar.observe.coverage.claims import judge_coverage
from insar.observe.coverage.results import Coverage, CoverageResult, Verdict, WalkerSearch
from insar.observe.coverage.simulation import simulate_coverage, symmetric_longitudes
from insar.observe.coverage.sizing import sizing_shortfall
from insar.observe.coverage.walker import Visibility, Walker
from insar.observe.coverage.walker_search import smallest_walker

from .outcome import Options, Outcome, Summary


def run(study: CoverageStudy, setup: CoverageSetup, options: Options) -> Outcome:
    """Size, search and simulate what a study asks for.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line; nothing here is random.

    Raises
    ------
    BuildError
        If no orbit of the search ever sees the band.
    """
    search = None if setup.search is None else _search(setup.search, setup.visibility)
    walkers = list(setup.walkers)
    if setup.sizing is not None:
        walkers.insert(0, setup.sizing.walker)
    if search is not None and search.best is not None:
        walkers.append(search.best)
    simulations = tuple(_simulate(walker, setup) for walker in walkers)
    shortfall = None
    if setup.sizing is not None:
        shortfall = sizing_shortfall(
            setup.sizing.sizing,
            latitude=setup.sizing.latitude,
            inclination=setup.sizing.inclination,
            visibility=setup.visibility,
            phasing=setup.sizing.phasing,
        )
    result = CoverageResult(
        shortfall=shortfall,
        simulations=simulations,
        search=search,
        warnings=() if search is None or setup.search is None else _warnings(search, setup.search),
    )
    claims = tuple(judge_coverage(claim, result) for claim in setup.claims)
    result = dataclasses.replace(result, claims=claims)
    return Outcome(result=result, summary=_summary(simulations)._replace(warnings=result.warnings))


def _search(task: SearchTask, visibility: Visibility) -> WalkerSearch:
    try:
        return smallest_walker(
            altitude=task.altitude,
            inclinations=task.inclinations,
            totals=task.totals,
            latitudes=task.latitudes,
            visibility=visibility,
            planes=task.planes,
            samples=task.samples,
        )
    except ValueError as error:
        raise BuildError(("search",), f"cannot succeed: {error}") from None


def _simulate(walker: Walker, setup: CoverageSetup) -> Coverage:
    return simulate_coverage(
        walker,
        latitude=setup.latitudes[:, None],
        longitude=symmetric_longitudes(walker, setup.longitudes)[None, :],
        visibility=setup.visibility,
        duration=setup.duration,
    )


def _warnings(search: WalkerSearch, task: SearchTask) -> tuple[str, ...]:
    """What the search leaves open."""
    found = []
    if search.candidates.total.size == 0:
        found.append(
            f"Nothing was searched: by the time that one satellite sees a place, fewer than "
            f"{search.least_total} satellites cannot keep the band in view, and the range ends at "
            f"{task.totals[-1]}; search from {search.least_total} on, or allow wider incidences."
        )
    elif search.best is None:
        found.append(
            f"No pattern of up to {task.totals[-1]} satellites keeps the whole band in view; "
            "allow more satellites or planes, other inclinations, or wider incidences."
        )
    if search.best is not None and task.totals.step > 1:
        found.append(
            f"Only every {task.totals.step}th number of satellites was tried: a constellation of "
            f"up to {task.totals.step - 1} satellites fewer may do; take satellite_step: 1 to know."
        )
    undecided = int(np.count_nonzero(search.candidates.verdict == Verdict.UNDECIDED))
    if undecided:
        found.append(
            f"{undecided} patterns cover so narrowly that neither a gap nor its absence was "
            "proven; they are not taken."
        )
    return tuple(found)


def _summary(simulations: tuple[Coverage, ...]) -> Summary:
    """What each constellation keeps in view."""
    return Summary(
        headings=("satellites", "least cover", "mean cover", "longest gap"),
        rows=tuple(
            (
                f"{each.walker.altitude / 1e3:g} km, {each.walker.name}",
                (
                    f"{each.walker.total}",
                    f"{100.0 * each.cover.min():.1f} %",
                    f"{100.0 * each.cover.mean():.1f} %",
                    f"{each.longest_gap.max() / 60.0:.1f} min",
                ),
            )
            for each in simulations
        ),
    )
