"""Checks of formations that are evaluated or compared with, on orbits or by a table."""

from __future__ import annotations

from collections.abc import Sequence

from formation import Orbit

from .base import wrong
from .blocks import ErrorsBlock
from .checks import RESULT_LABELS, check_drift, check_members
from .formations import ComparedFormation, EvaluatedFormation
from .limits import LimitsBlock
from .messages import KeyPath
from .tables import PlacedSatellite

COMBINED = "combined"
"""Label of the acquisitions of a study together."""


def check_compared(
    compared: ComparedFormation, names: Sequence[str], orbit: Orbit, at: KeyPath
) -> None:
    """A formation to compare with is of the study's satellites and does not drift apart."""
    if compared.table is not None:
        check_table_members(compared.table, names, (*at, "table"))
    else:
        satellites = compared.satellites or ()
        check_members(satellites, names, (*at, "satellites"))
        check_drift(satellites, orbit, (*at, "satellites"))


def check_evaluated(formation: EvaluatedFormation, orbit: Orbit) -> None:
    """The formation is of the same satellites throughout, and does not drift apart."""
    at: KeyPath = ("formation",)
    if formation.satellites is not None:
        check_members(formation.satellites, formation.names, (*at, "satellites"))
        check_drift(formation.satellites, orbit, (*at, "satellites"))
    if formation.table is not None:
        check_table_members(formation.table, formation.names, (*at, "table"))
    labels: list[str] = []
    for index, acquisition in enumerate(formation.acquisitions or ()):
        where = (*at, "acquisitions", index)
        check_table_members(acquisition.table, formation.names, (*where, "table"))
        if acquisition.label in (*labels, *RESULT_LABELS, COMBINED):
            raise wrong((*where, "label"), "is used otherwise", "choose another label")
        labels.append(acquisition.label)


def check_table_members(
    table: Sequence[PlacedSatellite], names: Sequence[str], at: KeyPath
) -> None:
    """A table places the satellites of the study, from one that others count from."""
    check_members(table, names, at)
    first = table[0]
    if not first.at_origin and first.position_rtn_m is None:
        raise wrong(
            (*at, 0),
            "is the satellite that baselines start from, so it has none itself",
            "give it a name only, or position_rtn_m",
        )
    for index, satellite in enumerate(table[1:], start=1):
        if satellite.at_origin:
            raise wrong(
                (*at, index),
                "lacks its place",
                "add position_rtn_m, perpendicular_baseline_m or height_of_ambiguity_m",
            )


def check_flown(compared: Sequence[ComparedFormation]) -> None:
    """A search compares with formations on orbits only."""
    for index, one in enumerate(compared):
        if one.table is not None:
            raise wrong(
                ("compare", index, "table"),
                "places satellites without orbits, which the limits of a search are on",
                "give satellites with their states, or use kind: evaluate",
            )


def check_joint(errors: ErrorsBlock) -> None:
    """Acquisitions are combined by their images, not by pairs of them."""
    if errors.preset is not None or errors.weighting == "pairs":
        raise wrong(
            ("errors", "weighting" if errors.weighting else "preset"),
            "weighs pairs of images, and several acquisitions are combined by their images",
            "use weighting: joint without a preset, or evaluate one acquisition at a time",
        )


def check_no_orbit_limits(limits: LimitsBlock) -> None:
    """No limit is on orbits, of which positions say nothing."""
    keys = (
        "max_radius_over_critical_baseline",
        "max_radius_m",
        "min_separation_m",
        "max_z0_m",
        "max_zdot0_m_s",
    )
    for key in keys:
        if getattr(limits, key) is not None:
            raise wrong(
                ("constraints", key),
                "limits the orbits, and a formation given by positions has none that are known",
                "remove it, or give the formation's satellites by their states",
            )
