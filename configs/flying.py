"""Builds formations of a study: states of satellites on orbits, positions of those in a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from formation import CircularFamily, ground_track_circular, space_circular
from optimize import Problem

from .formations import ComparedFormation, EvaluatedFormation, Family, RadialStart, Satellite, Sign
from .messages import KeyPath
from .placing import NamedPositions, build_positions
from .simulate_study import FlownFormation

Array = NDArray[np.float64]

FAMILIES: dict[Family, CircularFamily] = {
    "ground_track_circular": ground_track_circular,
    "space_circular": space_circular,
}
"""By the name that a study gives them."""

SIGNS = {"positive": (1,), "negative": (-1,), "either": (1, -1)}
"""Signs of the cross-track motion that a study allows."""

_Member = TypeVar("_Member", RadialStart, Satellite)


class NamedStates(NamedTuple):
    """A formation with what a report calls it.

    Attributes
    ----------
    label : what it is called.
    names : name of each satellite.
    states : (N, 6) — RTN states at t = 0 [m, m/s].
    """

    label: str
    names: tuple[str, ...]
    states: Array


def evaluated_formation(
    formation: EvaluatedFormation, names: tuple[str, ...], problem: Problem
) -> NamedStates | tuple[NamedPositions, ...]:
    """The formation of a study of kind `evaluate`.

    Parameters
    ----------
    formation : of the study.
    names : name of each satellite.
    problem : its scene and mean motion.

    Returns
    -------
    NamedStates, or positions for each acquisition where the study has a table or several.
    """
    at: KeyPath = ("formation",)
    if formation.acquisitions is not None:
        return tuple(
            NamedPositions(
                one.label,
                names,
                build_positions(one.table, names, problem, (*at, "acquisitions", index, "table")),
            )
            for index, one in enumerate(formation.acquisitions)
        )
    if formation.table is not None:
        positions = build_positions(formation.table, names, problem, (*at, "table"))
        return (NamedPositions("formation", names, positions),)
    states = _states(
        formation.satellites or (),
        names,
        problem.mean_motion,
        family=formation.family,
        sign=formation.cross_track_sign,
    )
    return NamedStates("formation", names, states)


def compared_formations(
    formations: Sequence[ComparedFormation],
    names: tuple[str, ...],
    problem: Problem,
    *,
    family: Family,
    sign: Sign,
) -> tuple[NamedStates | NamedPositions, ...]:
    """Formations to compare with; family and sign are the study's, for those that give none."""
    return tuple(
        NamedStates(
            formation.label,
            names,
            _states(
                formation.satellites or (),
                names,
                problem.mean_motion,
                family=formation.family or family,
                sign=formation.cross_track_sign or sign,
            ),
        )
        if formation.table is None
        else NamedPositions(
            formation.label,
            names,
            build_positions(formation.table, names, problem, ("compare", index, "table")),
        )
        for index, formation in enumerate(formations)
    )


def flown_formations(
    formations: Sequence[ComparedFormation],
    names: tuple[str, ...],
    problem: Problem,
    *,
    family: Family,
    sign: Sign,
) -> tuple[NamedStates, ...]:
    """The same of a study whose formations are all on orbits."""
    found = compared_formations(formations, names, problem, family=family, sign=sign)
    return tuple(one for one in found if isinstance(one, NamedStates))


def formation_states(formation: FlownFormation, names: Sequence[str], mean_motion: float) -> Array:
    """States of a given formation, (N, 6) RTN at t = 0 [m, m/s].

    Parameters
    ----------
    formation : of the study.
    names : name of each satellite.
    mean_motion : scalar — of the reference orbit [rad/s].
    """
    return _states(
        formation.satellites,
        names,
        mean_motion,
        family=formation.family,
        sign=formation.cross_track_sign,
    )


def _states(
    satellites: Sequence[Satellite],
    names: Sequence[str],
    mean_motion: float,
    *,
    family: Family,
    sign: Sign,
) -> Array:
    generate, (k, *_) = FAMILIES[family], SIGNS[sign]
    rows = [
        generate(*satellite.radial_start, mean_motion=mean_motion, sign=k)
        if satellite.state is None
        else np.array(satellite.state)
        for satellite in in_order(satellites, names)
    ]
    return np.array(rows)


def in_order(members: Sequence[_Member], names: Sequence[str]) -> list[_Member]:
    """The members in the order of the study's satellites; unnamed ones are in it already."""
    by_name = {member.name: member for member in members}
    return list(members) if None in by_name else [by_name[name] for name in names]
