"""Builds what a study of coverage computes with: km and degrees end here."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import LookSide, Relation
from insar.observe.coverage.claims import CoverageClaim, CoverageQuantity
from insar.observe.coverage.results import WalkerSizing
from insar.observe.coverage.sizing import walker_sizing
from insar.observe.coverage.walker import Visibility, Walker

from .agile_claims import COVERAGE_UNITS
from .agile_studies import CoverageStudy
from .coverage import SizingBlock, VisibilityBlock, WalkerBlock, WalkerSearchBlock
from .messages import BuildError

Array = NDArray[np.float64]

MAX_WATCHED = 2_000_000
"""Satellites x places x days of one simulation: about a minute."""

_SIDES = {"either": None, "left": LookSide.LEFT, "right": LookSide.RIGHT}
_DAY = 86_400.0


class SizingTask(NamedTuple):
    """A sizing whose shortfall is explained.

    Attributes
    ----------
    sizing : what was sized.
    latitude, inclination : scalars [rad].
    phasing : of the sized pattern.
    """

    sizing: WalkerSizing
    latitude: float
    inclination: float
    phasing: int

    @property
    def walker(self) -> Walker:
        """The sized constellation."""
        return self.sizing.walker(inclination=self.inclination, phasing=self.phasing)


class SearchTask(NamedTuple):
    """What is searched for the smallest constellation.

    Attributes
    ----------
    altitude : scalar [m].
    inclinations : to be tried [rad].
    totals : numbers of satellites to be tried.
    planes : numbers of planes to be tried; None for all.
    latitudes : of the band, from and to [rad].
    samples : latitudes at which cover is counted.
    """

    altitude: float
    inclinations: tuple[float, ...]
    totals: range
    planes: range | None
    latitudes: tuple[float, float]
    samples: int


class CoverageSetup(NamedTuple):
    """Everything that a study of kind `coverage` computes with.

    Attributes
    ----------
    visibility : what a satellite sees.
    sizing : None if the study sizes nothing.
    walkers : constellations to simulate, without the sized one and the one to be found.
    search : None if the study searches nothing.
    latitudes : (L,) — geodetic, of the places that are simulated [rad].
    longitudes : places at each latitude.
    duration : of the simulations [s].
    claims : printed figures; may be empty.
    """

    visibility: Visibility
    sizing: SizingTask | None
    walkers: tuple[Walker, ...]
    search: SearchTask | None
    latitudes: Array
    longitudes: int
    duration: float
    claims: tuple[CoverageClaim, ...]


def build_coverage(study: CoverageStudy) -> CoverageSetup:
    """Build what a study of kind `coverage` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If a simulation would take too long.
    """
    simulation, visibility = study.simulation, _visibility(study.visibility)
    south, north = simulation.latitudes_deg
    setup = CoverageSetup(
        visibility=visibility,
        sizing=None if study.sizing is None else _sizing(study.sizing, visibility),
        walkers=tuple(_walker(block) for block in study.constellations),
        search=None if study.search is None else _search(study.search),
        latitudes=np.radians(np.linspace(south, north, simulation.latitude_samples)),
        longitudes=simulation.longitudes,
        duration=_DAY * simulation.duration_days,
        claims=tuple(
            CoverageClaim(
                quantity=CoverageQuantity(claim.quantity),
                relation=Relation(claim.relation),
                **claim.figure(COVERAGE_UNITS[claim.quantity]),
            )
            for claim in study.claims
        ),
    )
    _check_size(setup)
    return setup


def _visibility(block: VisibilityBlock) -> Visibility:
    return Visibility(
        max_incidence=math.radians(block.max_incidence_deg),
        min_incidence=math.radians(block.min_incidence_deg),
        side=_SIDES[block.side],
    )


def _sizing(block: SizingBlock, visibility: Visibility) -> SizingTask:
    sizing = walker_sizing(altitude=1e3 * block.altitude_km, max_incidence=visibility.max_incidence)
    if block.phasing >= sizing.planes:
        raise BuildError(
            ("sizing", "phasing"),
            f"must be less than the planes that are sized, {sizing.planes}; the same pattern has "
            f"{block.phasing % sizing.planes}",
        )
    return SizingTask(
        sizing=sizing,
        latitude=math.radians(block.latitude_deg),
        inclination=math.radians(block.inclination_deg),
        phasing=block.phasing,
    )


def _walker(block: WalkerBlock) -> Walker:
    return Walker(
        total=block.satellites,
        planes=block.planes,
        phasing=block.phasing,
        inclination=math.radians(block.inclination_deg),
        altitude=1e3 * block.altitude_km,
    )


def _search(block: WalkerSearchBlock) -> SearchTask:
    south, north = block.latitudes_deg
    return SearchTask(
        altitude=1e3 * block.altitude_km,
        inclinations=tuple(math.radians(angle) for angle in block.inclinations_deg),
        totals=block.totals,
        planes=None if block.max_planes is None else range(1, block.max_planes + 1),
        latitudes=(math.radians(south), math.radians(north)),
        samples=block.latitude_samples,
    )


def _check_size(setup: CoverageSetup) -> None:
    """No simulation takes more than about a minute."""
    totals = [walker.total for walker in setup.walkers]
    if setup.sizing is not None:
        totals.append(setup.sizing.sizing.total)
    if setup.search is not None:
        totals.append(setup.search.totals[-1])
    watched = max(totals) * setup.latitudes.size * setup.longitudes * setup.duration / _DAY
    if watched > MAX_WATCHED:
        raise BuildError(
            ("simulation",),
            f"watches {setup.latitudes.size * setup.longitudes} places for "
            f"{setup.duration / _DAY:g} days with up to {max(totals)} satellites, and the product "
            f"of these may reach {MAX_WATCHED:.0e}; take fewer places or days",
        )
