"""The smallest Walker constellation that keeps a band of latitudes in view, with a proof.

A grid on the torus of `long_run` rejects nearly every candidate: one place without cover is enough.
What passes is put to the proof of `continuity`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..earth import WGS84, Ellipsoid
from .continuity import prove_continuous
from .long_run import CELLS, cells_for, fold, longest_run, single_view, track_slope
from .results import Candidates, Verdict, WalkerSearch
from .walker import Visibility, Walker

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_GAP_LIMIT_REVOLUTIONS = 30
"""Gaps longer than about two days count as infinite."""
_AREA_TOLERANCE = 0.01
"""Relative error allowed to the area of the single view on the grid."""


def smallest_walker(
    *,
    altitude: float,
    inclinations: Sequence[float],
    totals: Sequence[int],
    latitudes: tuple[float, float],
    visibility: Visibility,
    planes: Sequence[int] | None = None,
    samples: int = 5,
    ellipsoid: Ellipsoid = WGS84,
) -> WalkerSearch:
    """Search the smallest T/P/F that covers a band of latitudes at all times and longitudes.

    Parameters
    ----------
    altitude : scalar — above the equatorial radius [m].
    inclinations : to be tried [rad].
    totals : T to be tried, in ascending order.
    latitudes : geodetic, from and to; the same twice for one latitude [rad].
    visibility : what a satellite sees.
    planes : P allowed; None for every divisor of T.
    samples : latitudes of the band at which cover and gaps are counted.
    ellipsoid : on which the targets lie.

    Returns
    -------
    WalkerSearch — every pattern up to the first total with a continuous one; of those of that
    total, the one with the fewest planes, then the first inclination and the smallest F, is best.

    Raises
    ------
    ValueError
        If the lists are empty or not ascending, or no satellite ever sees some latitude.

    Notes
    -----
    `Verdict.CONTINUOUS` is proved for circular orbits: no step of time or of longitude is involved,
    so no gap is missed. A constellation locked to a repeating ground track may keep **one**
    longitude in view with fewer satellites, as long as the lock is held; that is not searched.
    """
    _check(inclinations, totals, latitudes)
    band = np.linspace(latitudes[0], latitudes[1], samples if latitudes[1] > latitudes[0] else 1)
    task = _Task(altitude, band, visibility, ellipsoid)
    least = {inclination: task.least_total(inclination) for inclination in inclinations}
    if not math.isfinite(min(least.values())):
        raise ValueError(
            "no satellite of the given inclinations ever sees every latitude from "
            f"{math.degrees(latitudes[0]):g}° to {math.degrees(latitudes[1]):g}°; give an "
            "inclination nearer to 90° or wider incidences"
        )
    rows: list[tuple[Walker, float, float, Verdict]] = []
    best: Walker | None = None
    for total in totals:
        tried = [i for i in inclinations if total >= least[i]]
        found = [row for i in tried for row in task.candidates(total, i, planes)]
        rows += found
        best = _fewest_planes(
            [walker for walker, _, _, verdict in found if verdict is Verdict.CONTINUOUS]
        )
        if best is not None:
            break
    return WalkerSearch(
        altitude=altitude,
        visibility=visibility,
        latitudes=band,
        candidates=_table(rows),
        best=best,
        least_total=int(min(least.values())),
        gap_resolution=2 * _step(task.walker(1, 1, 0, inclinations[0]), CELLS),
    )


class _Task(NamedTuple):
    """What is the same for all candidates."""

    altitude: float
    band: Array
    visibility: Visibility
    ellipsoid: Ellipsoid

    def walker(self, total: int, planes: int, phasing: int, inclination: float) -> Walker:
        """The pattern at the altitude of the search."""
        return Walker(
            total=total,
            planes=planes,
            phasing=phasing,
            inclination=inclination,
            altitude=self.altitude,
        )

    def views(self, total: int, inclination: float) -> list[Mask]:
        """What a single satellite sees, at each latitude of the band."""
        return [
            single_view(
                orbit_radius=self.walker(1, 1, 0, inclination).semi_major_axis,
                inclination=inclination,
                latitude=float(latitude),
                visibility=self.visibility,
                cells=cells_for(total),
                ellipsoid=self.ellipsoid,
            )
            for latitude in self.band
        ]

    def least_total(self, inclination: float) -> float:
        """Satellites without which the views can't fill the torus; infinite if one sees nothing."""
        part = min(float(view.mean()) for view in self.views(1, inclination))
        return math.ceil((1 - _AREA_TOLERANCE) / part) if part else math.inf

    def candidates(
        self, total: int, inclination: float, planes: Sequence[int] | None
    ) -> Iterator[tuple[Walker, float, float, Verdict]]:
        """Every P and F of a total, with cover, longest gap and verdict."""
        views = self.views(total, inclination)
        for count in range(1, total + 1):
            if total % count or not (planes is None or count in planes):
                continue
            for phasing in range(count):
                yield self.assess(views, self.walker(total, count, phasing, inclination))

    def assess(self, views: list[Mask], walker: Walker) -> tuple[Walker, float, float, Verdict]:
        """Least cover over the latitudes, longest gap [s], and what is proved of a pattern."""
        covers = [
            fold(
                view,
                planes=walker.planes,
                slots=walker.satellites_per_plane,
                phasing=walker.phasing,
            )
            > 0
            for view in views
        ]
        gap = max(self.gap(cover, walker, views[0].shape[0]) for cover in covers)
        verdict = Verdict.GAPS
        if gap == 0.0:
            verdict = prove_continuous(
                walker,
                latitudes=(float(self.band[0]), float(self.band[-1])),
                visibility=self.visibility,
                ellipsoid=self.ellipsoid,
            )
        return walker, min(float(cover.mean()) for cover in covers), gap, verdict

    def gap(self, cover: Mask, walker: Walker, cells: int) -> float:
        """Longest gap of one latitude [s]."""
        limit = _GAP_LIMIT_REVOLUTIONS * cells
        steps = longest_run(
            cover,
            planes=walker.planes,
            phasing=walker.phasing,
            slope=track_slope(walker),
            limit=limit,
        )
        return math.inf if steps >= limit else steps * _step(walker, cells)


def _step(walker: Walker, cells: int) -> float:
    """Time of one cell of u [s]."""
    return 2 * math.pi / walker.rates.argument_of_latitude / cells


def _fewest_planes(walkers: list[Walker]) -> Walker | None:
    """The first of those with the fewest planes."""
    return min(walkers, key=lambda walker: walker.planes, default=None)


def _table(rows: list[tuple[Walker, float, float, Verdict]]) -> Candidates:
    return Candidates(
        total=np.array([walker.total for walker, *_ in rows], dtype=int),
        planes=np.array([walker.planes for walker, *_ in rows], dtype=int),
        phasing=np.array([walker.phasing for walker, *_ in rows], dtype=int),
        inclination=np.array([walker.inclination for walker, *_ in rows], dtype=float),
        cover=np.array([row[1] for row in rows], dtype=float),
        longest_gap=np.array([row[2] for row in rows], dtype=float),
        verdict=np.array([row[3] for row in rows], dtype=int),
    )


def _check(
    inclinations: Sequence[float], totals: Sequence[int], latitudes: tuple[float, float]
) -> None:
    if not inclinations:
        raise ValueError("inclinations must name at least one inclination")
    if not totals or list(totals) != sorted(set(totals)) or totals[0] < 1:
        raise ValueError(
            "totals must be whole numbers of satellites, at least one, in ascending order"
        )
    if not -math.pi / 2 <= latitudes[0] <= latitudes[1] <= math.pi / 2:
        raise ValueError(
            f"latitudes = {latitudes!r} rad must go from south to north within ±π/2; give radians"
        )
