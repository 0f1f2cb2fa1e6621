"""The items of a formation's budget, each of which can be changed alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from insar import Ionosphere

from .budget_coherence import Change, coherence_changes, quantization_change
from .problem import Problem

Array = NDArray[np.float64]


class BudgetItem(NamedTuple):
    """One number of the budget, and how to change it alone.

    Attributes
    ----------
    name : of the item.
    unit : of its value; empty for a pure number.
    value : as it is.
    better : +1 if more of it is better, −1 if less, 0 if either may be.
    changed : problem and positions with the item multiplied by a factor; raises ValueError where it
        can't be.
    continuous : whether it can be changed by a little; bits can't.
    """

    name: str
    unit: str
    value: float
    better: int
    changed: Callable[[float], tuple[Problem, Array]]
    continuous: bool = True


def budget_items(problem: Problem, positions: ArrayLike) -> tuple[BudgetItem, ...]:
    """Items of a budget that are not zero, and the scale of the baselines.

    Parameters
    ----------
    problem : scene, radar, errors and limits.
    positions : (S, N, 3) — of the formation, RTN at the scene's times [m].
    """
    place = np.asarray(positions, dtype=np.float64)

    def of_problem(make: Callable[[float], Problem]) -> Callable[[float], tuple[Problem, Array]]:
        return lambda factor: (make(factor), place)

    items = [
        BudgetItem(name, unit, value, better, of_problem(make))
        for name, unit, value, better, make in (
            *_of_radar(problem),
            *_of_errors(problem),
            *_of_calibration(problem),
            *coherence_changes(problem),
        )
        if value > 0.0
    ]
    bits = quantization_change(problem)
    if bits is not None:
        name, unit, value, better, make = bits
        items.append(BudgetItem(name, unit, value, better, of_problem(make), continuous=False))
    prior = problem.constraints.prior_height_std
    if prior is not None:
        items.append(
            BudgetItem(
                "prior_height",
                "m",
                prior,
                -1,
                of_problem(
                    lambda f: replace(
                        problem,
                        constraints=replace(problem.constraints, prior_height_std=f * prior),
                    )
                ),
            )
        )
    items.append(BudgetItem("baselines", "", 1.0, 0, lambda factor: (problem, factor * place)))
    return tuple(items)


def _of_radar(problem: Problem) -> list[Change]:
    radar = problem.radar
    changes: list[Change] = [
        ("snr", "", radar.snr, 1, lambda f: _with_radar(problem, snr=f * radar.snr)),
        ("looks", "", radar.looks, 1, lambda f: _with_radar(problem, looks=f * radar.looks)),
        (
            "slant_range_resolution",
            "m",
            radar.slant_range_resolution,
            0,
            lambda f: _with_radar(problem, slant_range_resolution=f * radar.slant_range_resolution),
        ),
    ]
    azimuth = radar.azimuth_resolution
    if azimuth is not None:
        changes.append(
            (
                "azimuth_resolution",
                "m",
                azimuth,
                0,
                lambda f: _with_radar(problem, azimuth_resolution=f * azimuth),
            )
        )
    return changes


def _with_radar(problem: Problem, **changes: float) -> Problem:
    return replace(problem, radar=replace(problem.radar, **changes))  # type: ignore[arg-type]


def _of_errors(problem: Problem) -> list[Change]:
    errors = problem.errors
    units = {
        "position": "m",
        "azimuth": "rad",
        "range": "m",
        "synchronization": "rad",
        "troposphere": "m",
    }

    def scaled(name: str) -> Callable[[float], Problem]:
        source = getattr(errors, name)
        return lambda f: _with_errors(problem, **{name: source._replace(std=f * source.std)})

    changes: list[Change] = [
        (name, unit, getattr(errors, name).std, -1, scaled(name)) for name, unit in units.items()
    ]
    ionosphere = errors.ionosphere
    if ionosphere is not None:
        changes.append(
            (
                "ionosphere",
                "1/m2",
                ionosphere.electrons,
                -1,
                lambda f: _with_errors(problem, ionosphere=_thinner(ionosphere, f)),
            )
        )
    return changes


def _thinner(ionosphere: Ionosphere, factor: float) -> Ionosphere:
    return replace(
        ionosphere,
        electrons=factor * ionosphere.electrons,
        gradient=factor * ionosphere.gradient,
    )


def _with_errors(problem: Problem, **changes: object) -> Problem:
    return replace(problem, errors=replace(problem.errors, **changes))  # type: ignore[arg-type]


def _of_calibration(problem: Problem) -> list[Change]:
    calibration = problem.errors.calibration
    if calibration is None:
        return []

    def scaled(*names: str) -> Callable[[float], Problem]:
        return lambda f: _with_errors(
            problem,
            calibration=replace(
                calibration, **{name: f * getattr(calibration, name) for name in names}
            ),
        )

    return [
        (
            "calibration_spacing",
            "m",
            calibration.spacing_across,
            -1,
            scaled("spacing_across", "spacing_along"),
        ),
        ("calibration_accuracy", "m", calibration.accuracy, -1, scaled("accuracy")),
        ("calibration_bias", "m", calibration.bias, -1, scaled("bias")),
    ]
