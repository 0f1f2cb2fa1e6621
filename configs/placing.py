"""Builds the positions of satellites that a study places segment by segment."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from insar import Relation
from insar.baselines import sensitivity
from insar.geometry import Sensitivity
from optimize import FormationClaim, FormationQuantity, Over, Problem

from .messages import BuildError, KeyPath
from .mission_claims import MissionClaimBlock
from .tables import PlacedSatellite

Array = NDArray[np.float64]


class NamedPositions(NamedTuple):
    """A formation by its positions, with what a report calls it.

    Attributes
    ----------
    label : what it is called.
    names : name of each satellite.
    positions : (S, N, 3) — RTN positions at the scene's times [m].
    """

    label: str
    names: tuple[str, ...]
    positions: Array


def build_positions(
    table: Sequence[PlacedSatellite], names: Sequence[str], problem: Problem, at: KeyPath
) -> Array:
    """Positions of the satellites of a table, in the order of the study.

    Parameters
    ----------
    table : the satellites; baselines start from the first.
    names : name of each satellite of the study.
    problem : its scene, its radar and what a target holds constant.
    at : path of the table.

    Returns
    -------
    (S, N, 3) — RTN positions [m].

    Raises
    ------
    BuildError
        If a list does not have a value for each segment.

    Notes
    -----
    A baseline B⊥ is laid along the direction e_h in which a rising target moves, one along track
    along the azimuth direction; what a baseline has along the line of sight changes no sensitivity.
    A height of ambiguity becomes λ r (e_h·up)/(m HoA), m the multiplicity of the radar's images.
    """
    direction = sensitivity(problem.scene, problem.errors.held_constant)
    segments = len(problem.scene)
    first = np.broadcast_to(np.zeros(3), (segments, 3))
    rows: list[Array] = []
    for index, satellite in enumerate(table):
        place = _Place(satellite, direction, problem, (*at, index))
        row = place.position(first)
        if index == 0:
            first = row
        rows.append(row)
    placed = [satellite.name for satellite in table]
    order = range(len(names)) if None in placed else [placed.index(name) for name in names]
    return np.stack([rows[index] for index in order], axis=1)


def build_claims(blocks: Sequence[MissionClaimBlock]) -> tuple[FormationClaim, ...]:
    """Printed figures in SI units.

    Parameters
    ----------
    blocks : of the study.
    """
    return tuple(
        FormationClaim(
            text=block.text,
            printed=block.printed,
            value=block.value * block.meaning.scale,
            tolerance=block.tolerance * block.meaning.scale,
            relation=Relation(block.relation),
            unit=block.meaning.unit,
            scale=block.meaning.scale,
            note=block.note,
            quantity=FormationQuantity(block.quantity),
            formation=block.formation,
            pair=block.pair,
            segment=None if block.segment is None else block.segment - 1,
            over=Over(block.over or ("rms" if block.meaning.error else "mean")),
        )
        for block in blocks
    )


class _Place(NamedTuple):
    """One satellite, and what its place is counted in."""

    satellite: PlacedSatellite
    direction: Sensitivity
    problem: Problem
    at: KeyPath

    def position(self, origin: Array) -> Array:
        """Its positions (S, 3), given those of the first satellite [m]."""
        if self.satellite.position_rtn_m is not None:
            return self._values("position_rtn_m", self.satellite.position_rtn_m, 1)
        across = np.zeros(len(origin))
        if self.satellite.perpendicular_baseline_m is not None:
            across = self._values(
                "perpendicular_baseline_m", self.satellite.perpendicular_baseline_m, 0
            )
        if self.satellite.height_of_ambiguity_m is not None:
            ambiguity = self._values(
                "height_of_ambiguity_m", self.satellite.height_of_ambiguity_m, 0
            )
            radar = self.problem.radar
            lever = radar.wavelength * self.direction.height_lever / radar.multiplicity
            across = lever / ambiguity
        along = np.zeros(len(origin))
        if self.satellite.along_track_baseline_m is not None:
            along = self._values("along_track_baseline_m", self.satellite.along_track_baseline_m, 0)
        return np.asarray(
            origin
            + across[:, None] * self.direction.height_direction
            + along[:, None] * self.direction.azimuth_direction
        )

    def _values(self, key: str, given: ArrayLike, axes: int) -> Array:
        """One value for all segments, or one for each: (S, ...)."""
        values = np.asarray(given, dtype=np.float64)
        segments = len(self.problem.scene)
        if values.ndim == axes:
            return np.broadcast_to(values, (segments, *values.shape))
        if len(values) != segments:
            raise BuildError(
                (*self.at, key),
                f"has {len(values)} entries and the scene has {segments} segments; give one value "
                "for all segments, or one for each",
            )
        return values
