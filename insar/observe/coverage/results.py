"""What the study of coverage finds: a sizing, why it falls short, simulations, and a search."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...claims import Claim
from .walker import Visibility, Walker

Array = NDArray[np.float64]
Integers = NDArray[np.int_]


@dataclass(frozen=True, kw_only=True)
class WalkerSizing:
    """The constellation that Liang (2018) eqs. 14–20 ask for; see `walker_sizing`.

    Attributes
    ----------
    altitude : scalar — above the equatorial radius [m].
    max_incidence : scalar — β, zenith angle at the target [rad].
    half_angle : scalar — α, at the Earth's center, of the arc that sees the target [rad].
    period : scalar — T, of a revolution [s].
    view_time : scalar — T_v, of a pass through the zenith [s].
    satellites_per_plane : S = ⌈T/T_v⌉.
    node_shift : scalar — |Δφ|, the Earth's turn in one revolution [rad].
    planes : P = ⌈2π/|Δφ|⌉.
    """

    altitude: float
    max_incidence: float
    half_angle: float
    period: float
    view_time: float
    satellites_per_plane: int
    node_shift: float
    planes: int

    @property
    def total(self) -> int:
        """N = P·S (eq. 20)."""
        return self.planes * self.satellites_per_plane

    def walker(self, *, inclination: float, phasing: int = 0) -> Walker:
        """Build the constellation; the paper leaves inclination [rad] and phasing open."""
        return Walker(
            total=self.total,
            planes=self.planes,
            phasing=phasing,
            inclination=inclination,
            altitude=self.altitude,
        )


@dataclass(frozen=True, kw_only=True)
class SizingShortfall:
    """Fraction of time for which the sized constellation sees a target, one reason at a time.

    From `spacing` on they are long-run fractions for any longitude.

    Attributes
    ----------
    sizing : what was sized.
    walker : the constellation.
    latitude : scalar — geodetic, of the target [rad].
    visibility : what the radar can really see.
    in_plane : scalar — a target that stays in an orbit plane: what the sizing has in mind.
    held_least, held_most : scalars — planes as far apart as sized over an Earth that does not
        turn: the worst and the best longitude.
    spacing : scalar — the same over the turning Earth: every longitude gets the mean of them all.
    spacing_and_nadir : scalar — and no view within the least incidence.
    spacing_and_side : scalar — and a view to one side only, but at any incidence.
    all_reasons : scalar — planes, nadir gap and side together.
    seen_by : scalar — satellites that see the target, on average, with all reasons.
    """

    sizing: WalkerSizing
    walker: Walker
    latitude: float
    visibility: Visibility
    in_plane: float
    held_least: float
    held_most: float
    spacing: float
    spacing_and_nadir: float
    spacing_and_side: float
    all_reasons: float
    seen_by: float


class CoverIntervals(NamedTuple):
    """When a target is seen by any satellite; intervals of all targets in one list.

    Attributes
    ----------
    target : (I,) — index of the target, flattened; ascending.
    start, end : (I,) — since time 0; ascending for a target [s].
    """

    target: Integers
    start: Array
    end: Array

    def of(self, target: int) -> tuple[Array, Array]:
        """Starts and ends of the intervals of one target (its flattened index)."""
        chosen = self.target == target
        return self.start[chosen], self.end[chosen]

    def select(self, chosen: NDArray[np.bool_]) -> CoverIntervals:
        """Keep some of the intervals, chosen by an (I,) mask."""
        return CoverIntervals(self.target[chosen], self.start[chosen], self.end[chosen])


@dataclass(frozen=True, kw_only=True, eq=False)
class Coverage:
    """How a constellation covers targets over a window of time.

    Arrays have the broadcast shape of the targets' latitudes and longitudes. A gap is the time
    between two covered intervals, or between one and an end of the window, which cuts it short. A
    target that is never seen has one gap, as long as the window.

    Attributes
    ----------
    walker : the constellation.
    visibility : what a satellite sees.
    latitude, longitude : (...) — geodetic, of the targets [rad].
    duration : scalar — of the window, from time 0 [s].
    cover : (...) — fraction of the window in which any satellite sees the target.
    seen_by : (...) — satellites that see it, on average.
    longest_gap : (...) — the largest revisit time [s].
    mean_gap : (...) — the mean revisit time; 0 where there is no gap [s].
    mean_wait : (...) — mean time from a random moment to the next cover or the window's end [s].
    gaps : (...) — how many.
    accesses : (...) — unbroken views by single satellites; the nadir gap breaks one in two.
    mean_access : (...) — their mean duration; NaN where there is none [s].
    intervals : when each target is covered.
    """

    walker: Walker
    visibility: Visibility
    latitude: Array
    longitude: Array
    duration: float
    cover: Array
    seen_by: Array
    longest_gap: Array
    mean_gap: Array
    mean_wait: Array
    gaps: Integers
    accesses: Integers
    mean_access: Array
    intervals: CoverIntervals


class Verdict(IntEnum):
    """Whether a candidate covers every target at all times."""

    GAPS = 0
    """A place and moment without cover is known."""
    UNDECIDED = 1
    """None was found, but the proof ran out of resolution or work: treated as not continuous."""
    CONTINUOUS = 2
    """Proved for every longitude, latitude of the band and epoch."""


class Candidates(NamedTuple):
    """The Walker patterns that were searched, (C,) each, in the order of the search.

    Attributes
    ----------
    total, planes, phasing : T, P, F.
    inclination : [rad].
    cover : the least over the latitudes of the long-run covered fraction, on a grid.
    longest_gap : the longest over the latitudes, along lines a degree apart on the same grid: less
        than the truth where only a line between them misses the tip of a view, and 0 for a
        candidate with gaps that the grid does not see; infinite beyond two days. Simulate a
        candidate of interest [s].
    verdict : of `Verdict`: the grid's word for gaps, a proof for their absence.
    """

    total: Integers
    planes: Integers
    phasing: Integers
    inclination: Array
    cover: Array
    longest_gap: Array
    verdict: Integers


@dataclass(frozen=True, kw_only=True, eq=False)
class WalkerSearch:
    """The smallest Walker pattern that keeps a band of latitudes in view; see `smallest_walker`.

    Attributes
    ----------
    altitude : scalar [m].
    visibility : what a satellite sees.
    latitudes : (L,) — geodetic, at which cover and gaps are counted [rad].
    candidates : every pattern searched, up to the first total with a continuous one.
    best : the one chosen; None if none of the range is continuous.
    least_total : no pattern of fewer satellites can cover the band, by the time that a single
        satellite sees a target; patterns below it are not searched.
    gap_resolution : scalar — to which the gaps along the lines of the grid are found [s].
    """

    altitude: float
    visibility: Visibility
    latitudes: Array
    candidates: Candidates
    best: Walker | None
    least_total: int
    gap_resolution: float


@dataclass(frozen=True, kw_only=True, eq=False)
class CoverageResult:
    """What a study of coverage reports.

    Attributes
    ----------
    shortfall : of the paper's sizing, one reason at a time; None if the study sizes none.
    simulations : of constellations, over latitude and longitude.
    search : for the smallest pattern; None if the study asks for none.
    warnings : what a user should know.
    claims : printed figures and their verdicts; empty unless a study adds them.
    """

    shortfall: SizingShortfall | None
    simulations: tuple[Coverage, ...]
    search: WalkerSearch | None
    warnings: tuple[str, ...]
    claims: tuple[Claim, ...] = ()
