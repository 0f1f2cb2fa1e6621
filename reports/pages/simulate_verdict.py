"""What a simulated terrain says of the error model, before all details."""

from __future__ import annotations

import numpy as np

from insar.simulation import TerrainSimulation

from ..document import Block, Callout, Metric, Metrics, Status, Strong, Text
from ..wording import joined, meters, percent


def simulate_verdict(result: TerrainSimulation) -> tuple[Block, ...]:
    """Whether the error model holds, and the key figures.

    Parameters
    ----------
    result : of the simulation.
    """
    return (_verdict(result), _metrics(result))


def _disagreements(result: TerrainSimulation) -> list[str]:
    """What the error model misses by more than chance and more than matters."""
    missed = (
        ("random error", result.random.height_differs),
        ("total error", result.total.height_differs),
        ("share of wrong cycles", result.wrong.share_differs),
    )
    return [name for name, differs in missed if differs]


def _verdict(result: TerrainSimulation) -> Callout:
    wrong = result.wrong
    differing = _disagreements(result)
    nothing = result.least_squares >= result.prior
    if nothing:
        status, title = Status.BAD, "The heights are no better than those known beforehand"
    elif differing:
        status, title = Status.WARNING, f"The error model misses the {joined(differing)}"
    else:
        status, title = Status.GOOD, "The error model holds over this terrain"
    paragraphs: list[Text] = [
        (
            "With every cycle right, heights are wrong by ",
            Strong(meters(result.total.simulated.value)),
            f" (predicted {meters(result.total.predicted)}), of which noise makes ",
            Strong(meters(result.random.simulated.value)),
            f" (predicted {meters(result.random.predicted)}). A cycle is wrong in ",
            Strong(percent(wrong.simulated.value)),
            f" of the points (predicted {percent(wrong.predicted)}).",
        ),
        f"All points together, wrong cycles included, least squares is wrong by "
        f"{meters(result.least_squares)} (maximum likelihood, in the first acquisition, by "
        f"{meters(result.most_likely)}); "
        f"the elevation model known beforehand was by {meters(result.prior)}.",
        _measured(result),
    ]
    if result.departures:
        paragraphs.append(
            "The study takes more for granted than nature gives. Here "
            f"{joined(list(result.departures))}."
        )
    return Callout(status, title, tuple(paragraphs))


def _measured(result: TerrainSimulation) -> str:
    view, maps = result.request.view, result.maps
    total = view.layover.size
    text = (
        f"{np.count_nonzero(maps.clear)} of the "
        f"{total} points are clear; all figures are of these. "
        f"{percent(np.count_nonzero(view.layover) / total)} lie in layover, "
        f"{percent(np.count_nonzero(view.shadow) / total)} in shadow"
    )
    dark = np.count_nonzero(view.seen & ~maps.clear) / total
    return f"{text}, and {percent(dark)} on slopes where some image has next to no common band."


def _metrics(result: TerrainSimulation) -> Metrics:
    return Metrics(
        (
            Metric(
                "Total error",
                meters(result.total.simulated.value),
                f"predicted {meters(result.total.predicted)}",
            ),
            Metric(
                "Random error",
                meters(result.random.simulated.value),
                f"predicted {meters(result.random.predicted)}",
            ),
            Metric(
                "Wrong cycles",
                percent(result.wrong.simulated.value),
                f"predicted {percent(result.wrong.predicted)}",
            ),
            Metric("All points", meters(result.least_squares), f"prior {meters(result.prior)}"),
            Metric("Clear points", str(result.points), f"of {result.maps.clear.size}"),
        )
    )
