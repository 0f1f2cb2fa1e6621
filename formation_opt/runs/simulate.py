"""Runs a study of kind `simulate`: heights of a terrain, end to end."""

from __future__ import annotations

import numpy as np

from configs import BuildError, SimulateStudy
from configs.simulated import SimulateSetup
from insar.simulation import Comparison, TerrainSimulation, simulate_terrain

from .formation_summary import meters
from .outcome import Options, Outcome, Summary


def run(study: SimulateStudy, setup: SimulateSetup, options: Options) -> Outcome:
    """Fly over the terrain of a study.

    Parameters
    ----------
    study : the validated study.
    setup : what it is computed with.
    options : of the command line.

    Raises
    ------
    BuildError
        If the formation measures no point of the terrain.
    """
    seed = setup.seed if options.seed is None else options.seed
    try:
        result = simulate_terrain(
            setup.request, rng=np.random.default_rng(seed), should_stop=options.should_stop
        )
    except ValueError as error:
        raise BuildError(("formation",), f"cannot be simulated: {error}") from None
    return Outcome(
        result=result,
        summary=_summary(result),
        seed=seed,
        orbit=setup.orbit,
        interrupted=len(result.offsets) < setup.request.acquisitions,
    )


def _summary(result: TerrainSimulation) -> Summary:
    wrong = result.wrong
    rows = (
        ("random error, right cycles", _both(result.random)),
        ("total error, right cycles", _both(result.total)),
        (
            "points with a wrong cycle",
            (
                f"{100.0 * wrong.predicted:.2f} %",
                f"{100.0 * wrong.simulated.value:.2f} ± "
                f"{100.0 * wrong.simulated.sampling_error:.2f} %",
            ),
        ),
        ("least squares, all points", ("", meters(result.least_squares))),
        ("maximum likelihood, all points", ("", meters(result.most_likely))),
        ("height known beforehand", ("", meters(result.prior))),
    )
    return Summary(headings=("predicted", "simulated"), rows=rows)


def _both(comparison: Comparison) -> tuple[str, str]:
    simulated = comparison.simulated
    return (
        meters(comparison.predicted),
        f"{simulated.value:.3f} ± {meters(simulated.sampling_error)}",
    )
