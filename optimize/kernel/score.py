"""The scores of formations in compiled loops: what `optimize.problem` computes with arrays.

Each formation is computed alone, from its design variables to its objective and its margins, eight
of them side by side (`lanes.py`). Nothing is summed across formations, so the results are the same
for any batch and any number of threads. Importing this module imports numba: only
`optimize.kernel.evaluator` does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numba

from . import constants, rooms
from .edges import edges
from .fingerprint import fingerprint
from .heights import mean_square
from .ladder import unwrapping_failure
from .lanes import (
    WIDTH,
    every,
    integer,
    jit,
    keep,
    lanes,
    larger,
    number,
    put,
    record,
    root,
    where_less,
)
from .limits import baseline_fraction, box, radius, separation
from .scatter import scatter_error

_constants, _room = record(constants.RECORD), record(rooms.RECORD)


@jit
def _take(designs, p, count, k, r):
    """Lay the designs side by side; where there are less than eight, the last one fills up."""
    width = 2 * k.satellites + (1 if k.sign == 0.0 else 0)
    for lane in range(WIDTH):
        row = (p + min(lane, count - 1)) * width
        for n in range(k.satellites):
            put(r.radial, n * WIDTH + lane, number(designs, row + 2 * n))
            put(r.rate, n * WIDTH + lane, number(designs, row + 2 * n + 1))
        side = number(designs, row + 2 * k.satellites) if k.sign == 0.0 else k.sign
        put(r.side, lane, side)
    z, y = lanes(r.radial, 0), lanes(r.rate, 0)
    for i in range(k.images):
        tx, rx = integer(k.transmitter, i), integer(k.receiver, i)
        keep(r.center_radial, i, (lanes(r.radial, tx) - z) + (lanes(r.radial, rx) - z))
        keep(r.center_rate, i, (lanes(r.rate, tx) - y) + (lanes(r.rate, rx) - y))
    z, y = lanes(r.center_radial, 0), lanes(r.center_rate, 0)
    for i in range(k.images):  # relative to the first
        keep(r.center_radial, i, lanes(r.center_radial, i) - z)
        keep(r.center_rate, i, lanes(r.center_rate, i) - y)


@jit
def _project(k, r, s):
    """What a segment sees of the phase centers."""
    side, below, above = lanes(r.side, 0), 2 * s, 2 * (k.segments + s)
    h0 = where_less(side, 0.0, number(k.height, below), number(k.height, above))
    h1 = where_less(side, 0.0, number(k.height, below + 1), number(k.height, above + 1))
    a0 = where_less(side, 0.0, number(k.azimuth, below), number(k.azimuth, above))
    a1 = where_less(side, 0.0, number(k.azimuth, below + 1), number(k.azimuth, above + 1))
    per_height, shift = number(k.per_height, s), number(k.range_rate, s)
    doppler = number(k.doppler_rate, s)
    for i in range(k.images):
        z, y = lanes(r.center_radial, i), lanes(r.center_rate, i)
        across, along = h0 * z + h1 * y, a0 * z + a1 * y
        keep(r.kz, i, across * per_height)
        keep(r.along, i, along)
        keep(r.offset, i, across * shift)
        keep(r.doppler, i, along * doppler)


@jit
def _score_lanes(k, r, detailed):
    """Objectives of eight formations; their margins and failures go to the room."""
    for limit in range(k.limits):
        keep(r.worst, limit, math.inf)
    limit, row = 0, 0
    if k.max_radius > 0.0:
        radius(k, r, limit, row, detailed)
        limit, row = limit + 1, row + k.satellites
    if k.min_separation > 0.0:
        separation(k, r, limit, row, detailed)
        limit, row = limit + 1, row + k.satellites * (k.satellites - 1) // 2
    unwrapped = k.failure_limit < 0.0
    if unwrapped:
        limit, row = limit + 1, row + k.segments
    total = every(0.0)
    matrices = unwrapped or not k.scatter
    if not matrices:
        total = scatter_error(k, r)
    if matrices or k.max_fraction > 0.0:
        for s in range(k.segments):
            _project(k, r, s)
            if matrices:
                edges(k, r, s)
                total += mean_square(k, r, s)
            if unwrapped:
                keep(r.failure, s, unwrapping_failure(k, r))
            if k.max_fraction > 0.0:
                baseline_fraction(k, r, s, limit, row, detailed)
                row += k.pairs
    if k.max_fraction > 0.0:
        limit += 1
    if k.max_offset > 0.0:
        box(k, r, r.radial, k.max_offset, limit, row, detailed)
        limit, row = limit + 1, row + k.satellites
    if k.max_rate > 0.0:
        box(k, r, r.rate, k.max_rate, limit, row, detailed)
    return root(total / float(k.segments))


@jit
def _unwrapping_margins(k, r, detailed):
    """Margins of the unwrapping in decades: logarithms of the worst segment, or of each."""
    limit = (1 if k.max_radius > 0.0 else 0) + (1 if k.min_separation > 0.0 else 0)
    row = k.satellites if k.max_radius > 0.0 else 0
    if k.min_separation > 0.0:
        row += k.satellites * (k.satellites - 1) // 2
    most = lanes(r.failure, 0)
    for s in range(1, k.segments):
        most = larger(most, lanes(r.failure, s))
    keep(r.worst, limit, most)
    for lane in range(WIDTH):
        at = limit * WIDTH + lane
        put(r.worst, at, k.failure_limit - math.log10(max(number(r.worst, at), 1e-16)))
        if detailed:
            for s in range(k.segments):
                failure = max(number(r.failure, s * WIDTH + lane), 1e-16)
                put(r.items, (row + s) * WIDTH + lane, k.failure_limit - math.log10(failure))


@jit
def _give(source, lane, target, size):
    """Write the numbers of one formation in a row."""
    for place in range(size):
        put(target, place, number(source, place * WIDTH + lane))


def _entry(sources: int) -> Callable[..., Any]:
    """The loop over formations; the number stands for the text of this package.

    The compiler keeps its result until this file changes, unless a number of the function does: so
    it does not take what it made of other formulas.
    """

    @numba.njit(cache=True, nogil=True, error_model="numpy")
    def score_range(designs, begin, end, constants, room, objectives, worst, items, item_count):
        _ = sources
        k, r = _constants(constants), _room(room)
        detailed = item_count > 0
        for p in range(begin, end, WIDTH):
            count = min(WIDTH, end - p)
            _take(designs, p, count, k, r)
            found = _score_lanes(k, r, detailed)
            keep(r.side, 0, found)
            if k.failure_limit < 0.0:
                _unwrapping_margins(k, r, detailed)
            for lane in range(count):
                put(objectives, p + lane, number(r.side, lane))
                _give(r.worst, lane, worst + 8 * (p + lane) * k.limits, k.limits)
                _give(r.items, lane, items + 8 * (p + lane) * item_count, item_count)

    return score_range


score_range = _entry(fingerprint())
"""(designs, begin, end, k, r, objectives, worst, items, item_count): see `evaluator`."""
