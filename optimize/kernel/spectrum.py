"""Information between images that see parts of the ground's spectrum in common.

Image i sees a rectangle of the spectrum, and where the images of a set see it and no other does,
each two of them have the information 2L u_i u_j/(1 + Σu) of its area (`insar.phase_information`).

Few images, by sets: what all images of a set T see is a rectangle R_T too, its sides the least
upper less the largest lower end. By inclusion and exclusion the information of i and j is a sum
over the sets that hold both, Σ c_ij(T)|R_T|, with constants c (`parts.py`): no ends to sort, no
decision that differs from formation to formation.

Many images, by cells: the ends of all bands cut the spectrum into cells; a table of cumulative sums
over them serves all pairs.
"""

from __future__ import annotations

from .lanes import (
    WIDTH,
    every,
    integer,
    jit,
    keep,
    lanes,
    larger,
    magnitude,
    number,
    put,
    put_integer,
    smaller,
)


@jit
def by_sets(k, r, s):
    """Edges of all pairs from the rectangles that sets of images see."""
    sets = 1 << k.images
    low, high = r.parts, r.parts + 64 * sets
    dop_low, dop_high, area = low + 128 * sets, low + 192 * sets, low + 256 * sets
    for part in range(1, sets):
        image = integer(k.lowest, part)
        offset, doppler = lanes(r.offset, image), lanes(r.doppler, image)
        rest = part & (part - 1)
        if rest == 0:
            keep(low, part, offset)
            keep(high, part, offset)
            keep(dop_low, part, doppler)
            keep(dop_high, part, doppler)
            continue
        first, last = smaller(lanes(low, rest), offset), larger(lanes(high, rest), offset)
        keep(low, part, first)
        keep(high, part, last)
        size = larger(1.0 - (last - first), 0.0)
        if k.has_doppler:
            first = smaller(lanes(dop_low, rest), doppler)
            last = larger(lanes(dop_high, rest), doppler)
            keep(dop_low, part, first)
            keep(dop_high, part, last)
            size *= larger(1.0 - (last - first), 0.0)
        keep(area, part, size)
    shared = 1 << (k.images - 2)
    coefficient = k.part_weight + 8 * s * k.part_stride
    for pair in range(k.pairs):
        first = pair * shared
        one = number(coefficient, first) * lanes(area, integer(k.members, first))
        two = every(0.0)
        if shared > 1:
            two += number(coefficient, first + 1) * lanes(area, integer(k.members, first + 1))
        for t in range(first + 2, first + shared, 2):  # two sums, neither waits for the other
            one += number(coefficient, t) * lanes(area, integer(k.members, t))
            two += number(coefficient, t + 1) * lanes(area, integer(k.members, t + 1))
        keep(r.edges, pair, one + two)


@jit
def by_cells(k, r, s):
    """Edges of all pairs from a table of cumulative sums over the cells of the spectrum."""
    count = k.images
    places = 2 * count
    for lane in range(WIDTH):
        _rank_ends(r.offset, lane, count, r.order, r.ends, r.low, r.high)
    dop_low, dop_high = r.low + 64 * count, r.high + 64 * count
    dop_ends = r.ends + 64 * places
    if k.has_doppler:
        for lane in range(WIDTH):
            _rank_ends(r.doppler, lane, count, r.order, dop_ends, dop_low, dop_high)
        _cell_integrals(k, r, s, dop_ends, dop_low, dop_high)
    else:
        _range_integrals(k, r, s)
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            for lane in range(WIDTH):
                a, b = i * WIDTH + lane, j * WIDTH + lane
                begin = max(integer(r.low, a), integer(r.low, b))
                end = min(integer(r.high, a), integer(r.high, b))
                common = 0.0
                if not k.has_doppler:
                    common = number(r.cells, end * WIDTH + lane)
                    common -= number(r.cells, begin * WIDTH + lane)
                else:
                    first = max(integer(dop_low, a), integer(dop_low, b))
                    last = min(integer(dop_high, a), integer(dop_high, b))
                    if begin < end and first < last:
                        common = number(r.cells, (end * places + last) * WIDTH + lane)
                        common -= number(r.cells, (begin * places + last) * WIDTH + lane)
                        common -= number(r.cells, (end * places + first) * WIDTH + lane)
                        common += number(r.cells, (begin * places + first) * WIDTH + lane)
                put(r.edges, pair * WIDTH + lane, max(common, 0.0))
            weight = number(k.weight, s * count + i) * number(k.weight, s * count + j)
            keep(r.edges, pair, 2.0 * k.looks * weight * lanes(r.edges, pair))
            pair += 1


@jit
def overlap(k, r, i, j):
    """Part of the spectrum that two images have in common."""
    area = larger(1.0 - magnitude(lanes(r.offset, i) - lanes(r.offset, j)), 0.0)
    if k.has_doppler:
        area *= larger(1.0 - magnitude(lanes(r.doppler, i) - lanes(r.doppler, j)), 0.0)
    return area


@jit
def _rank_ends(offset, lane, count, order, ends, low, high):
    """Sort the 2M ends of the bands; `low` and `high` say where each band begins and ends."""
    for i in range(count):
        own = number(offset, i * WIDTH + lane)
        j = i
        while j > 0 and number(offset, integer(order, j - 1) * WIDTH + lane) > own:
            put_integer(order, j, integer(order, j - 1))
            j -= 1
        put_integer(order, j, i)
    lower, upper = 0, 0
    for place in range(2 * count):
        image = integer(order, min(lower, count - 1)) * WIDTH + lane
        other = integer(order, min(upper, count - 1)) * WIDTH + lane
        # All begin, those that are not a number too: their places are read, and must be places.
        ends_first = upper < count and number(offset, other) + 1.0 < number(offset, image)
        if lower < count and not ends_first:
            put(ends, place * WIDTH + lane, number(offset, image))
            put_integer(low, image, place)
            lower += 1
        else:
            put(ends, place * WIDTH + lane, number(offset, other) + 1.0)
            put_integer(high, other, place)
            upper += 1


@jit
def _range_integrals(k, r, s):
    """Cumulative ∫ df/(1 + U) at each end of the range axis."""
    places = 2 * k.images
    for place in range(places):
        keep(r.cells, place, 0.0)
    for i in range(k.images):
        weight = number(k.weight, s * k.images + i)
        for lane in range(WIDTH):
            _add(r.cells, integer(r.low, i * WIDTH + lane) * WIDTH + lane, weight)
            _add(r.cells, integer(r.high, i * WIDTH + lane) * WIDTH + lane, -weight)
    seen, total = every(0.0), every(0.0)
    for place in range(places):
        change = lanes(r.cells, place)
        keep(r.cells, place, total)
        seen += change
        if place + 1 < places:
            total += (lanes(r.ends, place + 1) - lanes(r.ends, place)) / (1.0 + seen)


@jit
def _cell_integrals(k, r, s, dop_ends, dop_low, dop_high):
    """Cumulative ∬ df/(1 + U) over range and azimuth: element (a, b) from the origin to (a, b)."""
    places, table = 2 * k.images, r.cells
    for place in range(places * places):
        keep(table, place, 0.0)
    for i in range(k.images):  # U by its differences at the corners of the rectangles
        weight = number(k.weight, s * k.images + i)
        for lane in range(WIDTH):
            at = i * WIDTH + lane
            below, above = integer(r.low, at) * places, integer(r.high, at) * places
            left, right = integer(dop_low, at), integer(dop_high, at)
            _add(table, (below + left) * WIDTH + lane, weight)
            _add(table, (above + left) * WIDTH + lane, -weight)
            _add(table, (below + right) * WIDTH + lane, -weight)
            _add(table, (above + right) * WIDTH + lane, weight)
    # U of the row before and the integral, both row by row: U of a row is no longer needed when
    # its integral takes its place.
    _sum_up(table, places)
    for a in range(places - 1, 0, -1):
        for b in range(places - 1, 0, -1):
            area = lanes(r.ends, a) - lanes(r.ends, a - 1)
            area *= lanes(dop_ends, b) - lanes(dop_ends, b - 1)
            keep(table, a * places + b, area / (1.0 + lanes(table, (a - 1) * places + b - 1)))
    for place in range(places):
        keep(table, place * places, 0.0)
        keep(table, place, 0.0)
    _sum_up(table, places)


@jit
def _sum_up(table, places):
    """Cumulative sums along both axes, in place."""
    for a in range(places):
        row = lanes(table, a * places)
        if a > 0:
            keep(table, a * places, row + lanes(table, (a - 1) * places))
        for b in range(1, places):
            row += lanes(table, a * places + b)
            above = lanes(table, (a - 1) * places + b) if a > 0 else every(0.0)
            keep(table, a * places + b, row + above)


@jit
def _add(address, index, value):
    put(address, index, number(address, index) + value)
