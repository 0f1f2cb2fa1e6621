"""Information between each two images by their phase noise: the edges of a graph Laplacian."""

from __future__ import annotations

from .algebra import factorize, invert
from .lanes import (
    every,
    exponential,
    floor,
    integer,
    jit,
    keep,
    lanes,
    larger,
    logarithm,
    number,
    pick,
    smaller,
    where_less,
)
from .spectrum import by_cells, by_sets, overlap

NONE, FILTERED, UNFILTERED = 0, 1, 2
"""Values of `Constants.decorrelation`."""


@jit
def edges(k, r, s):
    """Edges of all pairs of images in a segment."""
    if k.pairs_weighting:
        _apart(k, r, s)
    elif k.decorrelation == NONE:
        for pair in range(k.pairs):
            keep(r.edges, pair, number(k.steady, s * k.pairs + pair))
    elif k.decorrelation == UNFILTERED:
        _unfiltered(k, r, s)
    else:
        if k.sets:
            by_sets(k, r, s)
        else:
            by_cells(k, r, s)
        if k.has_efficiency:
            _lessen(k, r, s)


@jit
def _lessen(k, r, s):
    """Take from each edge what exact phase statistics take from its pair."""
    pair = 0
    for i in range(k.images):
        for j in range(i + 1, k.images):
            looks = k.looks * overlap(k, r, i, j)
            keep(r.edges, pair, lanes(r.edges, pair) * _efficiency(k, s * k.pairs + pair, looks))
            pair += 1


@jit
def _efficiency(k, row, looks):
    """`insar.statistics.EfficiencyCurves` of a pair of constant coherence."""
    rate, contrast = number(k.eta_rate, row), number(k.eta_contrast, row)
    bend = 1.0 + rate * looks
    position = k.eta_intervals / bend
    interval = smaller(floor(position), k.eta_intervals - 1.0)
    t = position - interval
    first = integer(k.eta_first, row)
    scaled = pick(k.eta_cubics, first, interval, 4, 3)
    for order in range(2, -1, -1):
        scaled = scaled * t + pick(k.eta_cubics, first, interval, 4, order)
    return smaller(scaled * bend / larger(2.0 * looks * contrast, 1e-300), 1.0)


@jit
def _efficiency_at(k, coherence, bound):
    """Efficiency of pairs whose coherence varies, all with the radar's looks.

    `insar.statistics.phase_efficiency`: the table of the logarithm of the exact variance, along
    its column of that number of looks.
    """
    contrast = 2.0 * logarithm(coherence) - logarithm((1.0 - coherence) * (1.0 + coherence))
    row = larger((contrast - k.line_start) * k.line_per_unit, 0.0)
    row = smaller(row, k.line_rows - 1.0)
    start = smaller(larger(floor(row) - 1.0, 0.0), k.line_rows - 4.0)
    t = row - start
    a, b, c = t - 1.0, t - 2.0, t - 3.0
    ab, tc = a * b, t * c
    value = ab * c * (-1.0 / 6.0) * pick(k.line, 0, start, 1, 0)
    value += tc * b * 0.5 * pick(k.line, 0, start, 1, 1)
    value -= tc * a * 0.5 * pick(k.line, 0, start, 1, 2)
    value += t * ab * (1.0 / 6.0) * pick(k.line, 0, start, 1, 3)
    return smaller(bound / exponential(value), 1.0)


@jit
def _apart(k, r, s):
    """Each pair as if it were measured apart from all others."""
    pair = 0
    for i in range(k.images):
        for j in range(i + 1, k.images):
            area = every(1.0)
            if k.decorrelation != NONE:
                area = overlap(k, r, i, j)
            variance = every(number(k.pair_noise, s * k.pairs + pair))
            if not k.given_noise and k.decorrelation == FILTERED:
                variance = variance / area
                if k.has_efficiency:
                    variance = variance / _efficiency(k, s * k.pairs + pair, k.looks * area)
            elif not k.given_noise and k.decorrelation == UNFILTERED:
                coherence = number(k.pair_coherence, s * k.pairs + pair) * area
                squared = coherence * coherence
                variance = (1.0 - squared) / (2.0 * k.looks * squared)
                if k.has_efficiency:
                    variance = variance / _efficiency_at(k, coherence, variance)
            apart = lanes(r.along, j) - lanes(r.along, i)
            variance += number(k.pair_variance, pair) + k.pair_azimuth * apart * apart
            keep(r.edges, pair, where_less(0.0, area, 1.0 / variance, 0.0))
            pair += 1


@jit
def _unfiltered(k, r, s):
    """Joint information of images whose bands differ: −2L Γ∘Γ⁻¹ off the diagonal."""
    count = k.images
    pair = 0
    for i in range(count):
        keep(r.matrix, i * count + i, 1.0)
        for j in range(i + 1, count):
            gamma = number(k.pair_coherence, s * k.pairs + pair) * overlap(k, r, i, j)
            keep(r.matrix, j * count + i, gamma)
            keep(r.variance, pair, gamma)  # free until the ladder
            pair += 1
    factorize(r.matrix, count)
    invert(r.matrix, count, r.inverse, r.column)
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            gamma = lanes(r.variance, pair)
            edge = -2.0 * k.looks * gamma * lanes(r.inverse, j * count + i)
            if k.has_efficiency:
                squared = gamma * gamma
                bound = (1.0 - squared) / (2.0 * k.looks * squared)
                edge *= where_less(0.0, gamma, _efficiency_at(k, gamma, bound), 1.0)
            keep(r.edges, pair, edge)
            pair += 1
