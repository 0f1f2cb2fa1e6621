"""The scores of formations in compiled loops: what `optimize.problem` computes with arrays.

Each formation is computed alone, from its design variables to its objective and its margins, with a
scratch of a few kilobytes that stays in the innermost cache. Nothing is summed across formations,
so the results are the same for any batch and any number of threads. Importing this module imports
numba: only `optimize.kernel.evaluator` does, when a search is long enough to pay for it.

Against the array form, two things are done differently to the same end. Overlaps of bands in range
and azimuth are read from a table of cumulative sums over the cells of the spectrum, O(M²) for all
pairs together. And the closest approach of a pair is twice the distance in the plane (z0, ż0/n), as
both circular families have it.
"""

from __future__ import annotations

import math

import numba
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

_jit = numba.njit(cache=True, nogil=True, error_model="numpy")
_TWO_PI = 2.0 * math.pi
_NOTHING = 1e-60
_NO_WAVENUMBER = 1e-15
_UNMEASURED = 1e-12


@intrinsic
def _pointer(_context, address):
    """An address as a pointer."""

    def generate(_target, builder, _signature, arguments):
        return builder.inttoptr(arguments[0], cgutils.voidptr_t)

    return types.voidptr(address), generate


@_jit
def _bare(array):
    """A view of an array that counts no references to it."""
    return numba.carray(_pointer(array.ctypes.data), array.shape, array.dtype)


@_jit
def _rank_ends(offset, order, ends, low, high):
    """Sort the 2M ends of the bands; `low` and `high` say where each band begins and ends."""
    count = offset.size
    for i in range(count):
        j = i
        while j > 0 and offset[order[j - 1]] > offset[i]:
            order[j] = order[j - 1]
            j -= 1
        order[j] = i
    lower, upper = 0, 0
    for place in range(2 * count):
        if lower < count and offset[order[lower]] <= offset[order[upper]] + 1.0:
            ends[place] = offset[order[lower]]
            low[order[lower]] = place
            lower += 1
        else:
            ends[place] = offset[order[upper]] + 1.0
            high[order[upper]] = place
            upper += 1


@_jit
def _range_integrals(weight, ends, low, high, cumulative):
    """Cumulative ∫ df/(1 + U) at each end of the range axis."""
    places = ends.size
    for place in range(places):
        cumulative[place] = 0.0
    for i in range(weight.size):
        cumulative[low[i]] += weight[i]
        cumulative[high[i]] -= weight[i]
    seen, total = 0.0, 0.0
    for place in range(places):
        change = cumulative[place]
        cumulative[place] = total
        seen += change
        if place + 1 < places:
            total += (ends[place + 1] - ends[place]) / (1.0 + seen)


@_jit
def _cell_integrals(weight, ends, low, high, dop_ends, dop_low, dop_high, table):
    """Cumulative ∬ df/(1 + U) over range and azimuth: table[r, c] from the origin to (r, c)."""
    places = ends.size
    for r in range(places):
        for c in range(places):
            table[r, c] = 0.0
    for i in range(weight.size):  # U by its differences at the corners of the rectangles
        table[low[i], dop_low[i]] += weight[i]
        table[high[i], dop_low[i]] -= weight[i]
        table[low[i], dop_high[i]] -= weight[i]
        table[high[i], dop_high[i]] += weight[i]
    for r in range(places):
        row = 0.0
        for c in range(places):
            row += table[r, c]
            table[r, c] = row + (table[r - 1, c] if r > 0 else 0.0)
    for r in range(places - 1, 0, -1):  # U of the cell before each corner → its integral
        for c in range(places - 1, 0, -1):
            area = (ends[r] - ends[r - 1]) * (dop_ends[c] - dop_ends[c - 1])
            table[r, c] = area / (1.0 + table[r - 1, c - 1])
    for place in range(places):
        table[place, 0] = 0.0
        table[0, place] = 0.0
    for r in range(1, places):
        row = 0.0
        for c in range(1, places):
            row += table[r, c]
            table[r, c] = row + table[r - 1, c]


@_jit
def _efficiency(row, area, looks, eta_rate, eta_intervals, eta_cubics, eta_first, eta_contrast):
    looks = looks * area
    share = 1.0 / (1.0 + eta_rate[row] * looks)
    position = share * eta_intervals
    interval = min(int(position), eta_intervals - 1)
    t = position - interval
    c = eta_cubics[eta_first[row] + interval]
    scaled = ((c[3] * t + c[2]) * t + c[1]) * t + c[0]
    return min(scaled / (max(2.0 * looks * eta_contrast[row], 1e-300) * share), 1.0)


@_jit
def _joint_edges(
    s,
    offset,
    doppler,
    x,
    weight,
    decorrelation,
    has_doppler,
    looks,
    has_eta,
    pairs,
    eta_rate,
    eta_intervals,
    eta_cubics,
    eta_first,
    eta_contrast,
    order,
    ends,
    low,
    high,
    dop_ends,
    dop_low,
    dop_high,
    table,
    cumulative,
):
    """Information between each two images by their joint coherence."""
    count = offset.size
    weight = weight[s]
    if decorrelation == 0:
        total = 0.0
        for i in range(count):
            total += weight[i]
    else:
        _rank_ends(offset, order, ends, low, high)
        if has_doppler:
            _rank_ends(doppler, order, dop_ends, dop_low, dop_high)
            _cell_integrals(weight, ends, low, high, dop_ends, dop_low, dop_high, table)
        else:
            _range_integrals(weight, ends, low, high, cumulative)
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            area = 1.0
            if decorrelation == 0:
                common = 1.0 / (1.0 + total)
            else:
                area = max(0.0, 1.0 - abs(offset[i] - offset[j]))
                begin, end = max(low[i], low[j]), min(high[i], high[j])
                if has_doppler:
                    area *= max(0.0, 1.0 - abs(doppler[i] - doppler[j]))
                    first = max(dop_low[i], dop_low[j])
                    last = min(dop_high[i], dop_high[j])
                    common = 0.0
                    if begin < end and first < last:
                        common = table[end, last] - table[begin, last]
                        common -= table[end, first] - table[begin, first]
                else:
                    common = cumulative[end] - cumulative[begin]
                common = max(common, 0.0)
            edge = 2.0 * looks * weight[i] * weight[j] * common
            if has_eta and edge > 0.0:
                edge *= _efficiency(
                    s * pairs + pair,
                    area,
                    looks,
                    eta_rate,
                    eta_intervals,
                    eta_cubics,
                    eta_first,
                    eta_contrast,
                )
            x[i, j] = edge
            x[j, i] = edge
            pair += 1


@_jit
def _pair_edges(
    s,
    offset,
    doppler,
    along,
    x,
    decorrelation,
    has_doppler,
    phase_std,
    pair_coherence,
    looks,
    has_eta,
    pairs,
    pair_variance,
    pair_azimuth,
    eta_rate,
    eta_intervals,
    eta_cubics,
    eta_first,
    eta_contrast,
):
    """Information of each pair, as if it were measured apart from all others."""
    count = offset.size
    pair = 0
    for i in range(count):
        for j in range(i + 1, count):
            area = 1.0
            if decorrelation != 0:
                area = max(0.0, 1.0 - abs(offset[i] - offset[j]))
                if has_doppler:
                    area *= max(0.0, 1.0 - abs(doppler[i] - doppler[j]))
            edge = 0.0
            if area > 0.0:
                if phase_std > 0.0:
                    variance = phase_std**2
                else:
                    gamma = pair_coherence[s, pair]
                    seen = looks
                    if decorrelation == 2:
                        gamma *= area
                    else:
                        seen *= area
                    variance = (1.0 - gamma**2) / (2.0 * seen * gamma**2)
                    if has_eta:
                        variance /= _efficiency(
                            s * pairs + pair,
                            area,
                            looks,
                            eta_rate,
                            eta_intervals,
                            eta_cubics,
                            eta_first,
                            eta_contrast,
                        )
                variance += pair_variance[pair] + pair_azimuth * (along[j] - along[i]) ** 2
                edge = 1.0 / variance
            x[i, j] = edge
            x[j, i] = edge
            pair += 1


@_jit
def _laplacian_product(x, v, out):
    """X v of the Laplacian with edges x, without cancellation: Σ_j x_ij (v_i − v_j)."""
    for i in range(v.size):
        total = 0.0
        for j in range(v.size):
            if j != i:
                total += x[i, j] * (v[i] - v[j])
        out[i] = total


@_jit
def _height_information(
    kz, along, x, factor, azimuth_factor, left, factor_room, product, amplitude, column, normal
):
    """J = gᵀXg + aᵀa with (I + FᵀXF) a = FᵀXkz, g = kz − Fa."""
    count, sources = kz.size, factor.shape[1]
    if azimuth_factor > 0.0:
        sources += 1
    for i in range(count):
        left[i] = kz[i]
    information = 0.0
    if sources > 0:
        for i in range(count):
            for r in range(factor.shape[1]):
                factor_room[i, r] = factor[i, r]
            if azimuth_factor > 0.0:
                factor_room[i, sources - 1] = azimuth_factor * along[i]
        _laplacian_product(x, kz, product)
        for r in range(sources):
            total = 0.0
            for i in range(count):
                total += factor_room[i, r] * product[i]
            amplitude[r] = total
        for r in range(sources):
            for i in range(count):
                total = 0.0
                for j in range(count):
                    if j != i:
                        total += x[i, j] * (factor_room[i, r] - factor_room[j, r])
                column[i] = total
            for q in range(r + 1):
                total = 0.0
                for i in range(count):
                    total += factor_room[i, q] * column[i]
                normal[r, q] = total
            normal[r, r] += 1.0
        _cholesky(normal, sources)
        _solve(normal, sources, amplitude)
        for r in range(sources):
            information += amplitude[r] ** 2
            for i in range(count):
                left[i] -= factor_room[i, r] * amplitude[r]
    for i in range(count):
        for j in range(i + 1, count):
            information += x[i, j] * (left[i] - left[j]) ** 2
    return information


@_jit
def _scatter(design, satellites):
    """Scatter matrix of the fleet in the plane (z0, ż0) and its determinant, O(N)."""
    z, y = 0.0, 0.0
    for n in range(satellites):
        z += design[2 * n]
        y += design[2 * n + 1]
    z /= satellites
    y /= satellites
    zz, zy = 0.0, 0.0
    for n in range(satellites):
        zz += (design[2 * n] - z) ** 2
        zy += (design[2 * n] - z) * (design[2 * n + 1] - y)
    slope = zy / zz if zz > 0.0 else 0.0
    yy, rest = 0.0, 0.0
    for n in range(satellites):
        yy += (design[2 * n + 1] - y) ** 2
        rest += (design[2 * n + 1] - y - slope * (design[2 * n] - z)) ** 2
    return zz, zy, yy, zz * rest  # a determinant without cancellation


@_jit
def _scatter_error(zz, zy, yy, determinant, height, azimuth, per_height, variance, factor, shift):
    """Mean square error of the segments from the scatter matrix M alone.

    J = (A β/f² + AD − B²)/(β(β/f² + D)) with A = kᵀMk, B = kᵀMc, D = cᵀMc; and AD − B² is
    det M times the square of k × c, which does not cancel.
    """
    total = 0.0
    for s in range(shift.size):
        k0, k1 = height[s, 0] * per_height[s], height[s, 1] * per_height[s]
        own = k0 * k0 * zz + 2.0 * k0 * k1 * zy + k1 * k1 * yy
        beta = variance[s]
        information = own / beta
        if factor > 0.0:
            c0, c1 = azimuth[s, 0] * factor, azimuth[s, 1] * factor
            across = c0 * c0 * zz + 2.0 * c0 * c1 * zy + c1 * c1 * yy
            both = determinant * (k0 * c1 - k1 * c0) ** 2
            information = (own * beta + both) / (beta * (beta + across))
        if own < _NO_WAVENUMBER**2 or information < _NOTHING:
            return math.inf
        total += 1.0 / information + shift[s]
    return total


@_jit
def _alike_information(variance, azimuth_factor, kz, along):
    """J where all images are alike: the information of the fleet's scatter, O(M).

    Σ(kz_c − t c_c)²/β + t²/f² of centered kz and azimuth projections c, with
    t = Σkz_c c_c/(β/f² + Σc_c²): what the azimuth error leaves, a sum without cancellation.
    """
    count = kz.size
    mean_kz, mean_along = 0.0, 0.0
    for i in range(count):
        mean_kz += kz[i]
        mean_along += along[i]
    mean_kz /= count
    mean_along /= count
    if azimuth_factor == 0.0:
        own = 0.0
        for i in range(count):
            own += (kz[i] - mean_kz) ** 2
        return own / variance
    mixed, across = 0.0, 0.0
    for i in range(count):
        mixed += (kz[i] - mean_kz) * (along[i] - mean_along)
        across += (along[i] - mean_along) ** 2
    slope = mixed / (variance / azimuth_factor**2 + across)
    left = 0.0
    for i in range(count):
        left += (kz[i] - mean_kz - slope * (along[i] - mean_along)) ** 2
    return left / variance + (slope / azimuth_factor) ** 2


@_jit
def _cholesky(a, size):
    """Lower factor in place of a symmetric positive-definite matrix."""
    for i in range(size):
        for j in range(i + 1):
            total = a[i, j]
            for m in range(j):
                total -= a[i, m] * a[j, m]
            a[i, j] = math.sqrt(max(total, 1e-300)) if i == j else total / a[j, j]


@_jit
def _solve(lower, size, b):
    for i in range(size):
        total = b[i]
        for m in range(i):
            total -= lower[i, m] * b[m]
        b[i] = total / lower[i, i]
    for i in range(size - 1, -1, -1):
        total = b[i]
        for m in range(i + 1, size):
            total -= lower[m, i] * b[m]
        b[i] = total / lower[i, i]


@_jit
def _unwrapping_failure(
    kz, along, x, prior, azimuth_factor, shared, noise, covariance, column, variance, gain
):
    """Failure of bootstrapping, the surest pair first: `insar.unwrapping_ladder`."""
    count = kz.size
    last = count - 1
    for i in range(1, count):  # the information of the phases relative to the first
        total = 0.0
        for j in range(count):
            if j != i:
                total += x[i, j]
        for j in range(1, i):
            noise[i - 1, j - 1] = -x[i, j]
        noise[i - 1, i - 1] = total + _UNMEASURED
    _cholesky(noise, last)
    for i in range(count):
        covariance[i, 0] = 0.0
        covariance[0, i] = 0.0
    for i in range(last):
        for j in range(last):
            column[j] = 1.0 if i == j else 0.0
        _solve(noise, last, column)
        for j in range(last):
            covariance[i + 1, j + 1] = column[j]
    prior, azimuth = prior**2, azimuth_factor**2
    largest = 0.0
    for i in range(count):
        for j in range(count):
            value = covariance[i, j] + shared[i, j] + prior * kz[i] * kz[j]
            value += azimuth * along[i] * along[j]
            covariance[i, j] = value / (_TWO_PI * _TWO_PI)
        largest = max(largest, covariance[i, i])
    for i in range(count):
        for j in range(count):
            if j != i:
                variance[i, j] = covariance[i, i] + covariance[j, j] - 2.0 * covariance[i, j]
    return _climb(variance, gain, count, 1e-14 * largest)


@_jit
def _climb(variance, gain, count, rounding):
    success = 0.0
    for rung in range(count - 1):
        last = count - 1 - rung
        first, second, smallest = 0, 1, math.inf
        for i in range(last + 1):
            for j in range(last + 1):
                if j != i and variance[i, j] < smallest:
                    first, second, smallest = i, j, variance[i, j]
        deviation = math.sqrt(max(smallest, 0.0))
        if deviation > 0.0:
            success += math.log1p(-math.erfc(1.0 / (2.0 * math.sqrt(2.0) * deviation)))
        if last == 1:
            break
        scale = 0.5 / math.sqrt(smallest) if smallest > rounding else 0.0
        for i in range(last + 1):
            to_first = 0.0 if i == first else variance[first, i]
            to_second = 0.0 if i == second else variance[second, i]
            gain[i] = scale * (to_first - to_second)
        for i in range(last + 1):
            for j in range(last + 1):
                if j != i:
                    variance[i, j] -= (gain[i] - gain[j]) ** 2
        for j in range(last + 1):
            if j not in (second, last):
                variance[second, j] = variance[last, j]
                variance[j, second] = variance[j, last]
    return -math.expm1(success)


@_jit
def score_range(designs, begin, end, k, w, objectives, worst, items):
    """Region height error, worst margin of each limit and, where there is room, every margin.

    Of the designs from `begin` to `end`, one after the other. The fields of the two tuples are
    taken out once, without their counts of references: handed from function to function, those
    would cost more than the physics. The caller holds what they refer to.
    """
    satellites, images, segments = k.satellites, k.transmitter.size, k.shift.size
    k_alike = _bare(k.alike)
    k_azimuth = _bare(k.azimuth)
    k_azimuth_factor = k.azimuth_factor
    k_decorrelation = k.decorrelation
    k_doppler_rate = _bare(k.doppler_rate)
    k_eta_contrast = _bare(k.eta_contrast)
    k_eta_cubics = _bare(k.eta_cubics)
    k_eta_first = _bare(k.eta_first)
    k_eta_intervals = k.eta_intervals
    k_eta_rate = _bare(k.eta_rate)
    k_factor = _bare(k.factor)
    k_failure_limit = k.failure_limit
    k_has_doppler = k.has_doppler
    k_has_eta = k.has_eta
    k_height = _bare(k.height)
    k_looks = k.looks
    k_max_fraction = k.max_fraction
    k_max_offset = k.max_offset
    k_max_radius = k.max_radius
    k_max_rate = k.max_rate
    k_mean_motion = k.mean_motion
    k_min_separation = k.min_separation
    k_pair_azimuth = k.pair_azimuth
    k_pair_coherence = _bare(k.pair_coherence)
    k_pair_variance = _bare(k.pair_variance)
    k_pairs = k.pairs
    k_pairs_weighting = k.pairs_weighting
    k_per_critical = _bare(k.per_critical)
    k_per_height = _bare(k.per_height)
    k_phase_std = k.phase_std
    k_prior = k.prior
    k_range_rate = _bare(k.range_rate)
    k_receiver = _bare(k.receiver)
    k_scatter = k.scatter
    k_shared = _bare(k.shared)
    k_shift = _bare(k.shift)
    k_signs = k.signs
    k_transmitter = _bare(k.transmitter)
    k_weight = _bare(k.weight)
    w_along = _bare(w.along)
    w_amplitude = _bare(w.amplitude)
    w_azimuth = _bare(w.azimuth)
    w_column = _bare(w.column)
    w_covariance = _bare(w.covariance)
    w_cumulative = _bare(w.cumulative)
    w_dop_ends = _bare(w.dop_ends)
    w_dop_high = _bare(w.dop_high)
    w_dop_low = _bare(w.dop_low)
    w_doppler = _bare(w.doppler)
    w_edges = _bare(w.edges)
    w_ends = _bare(w.ends)
    w_factor = _bare(w.factor)
    w_gain = _bare(w.gain)
    w_height = _bare(w.height)
    w_high = _bare(w.high)
    w_kz = _bare(w.kz)
    w_left = _bare(w.left)
    w_low = _bare(w.low)
    w_noise = _bare(w.noise)
    w_normal = _bare(w.normal)
    w_offset = _bare(w.offset)
    w_order = _bare(w.order)
    w_product = _bare(w.product)
    w_table = _bare(w.table)
    w_variance = _bare(w.variance)
    for p in range(begin, end):
        side = 1
        if k_signs == 0:
            side = 1 if designs[p, 2 * satellites] >= 0.0 else 0
        elif k_signs < 0:
            side = 0
        for c in range(worst.shape[1]):
            worst[p, c] = math.inf
        detailed = items.shape[1] > 0
        row, limit = 0, 0
        if k_max_radius > 0.0:
            for n in range(satellites):
                radius = 2.0 * math.hypot(designs[p, 2 * n], designs[p, 2 * n + 1] / k_mean_motion)
                margin = -(radius / k_max_radius - 1.0)
                worst[p, limit] = min(worst[p, limit], margin)
                if detailed:
                    items[p, row + n] = margin
            row += satellites
            limit += 1
        if k_min_separation > 0.0:
            for i in range(satellites):
                for j in range(i + 1, satellites):
                    offset = designs[p, 2 * j] - designs[p, 2 * i]
                    rate = (designs[p, 2 * j + 1] - designs[p, 2 * i + 1]) / k_mean_motion
                    margin = 2.0 * math.hypot(offset, rate) / k_min_separation - 1.0
                    worst[p, limit] = min(worst[p, limit], margin)
                    if detailed:
                        items[p, row] = margin
                    row += 1
            limit += 1
        unwrapping, unwrapping_row = limit, row
        if k_failure_limit < 0.0:
            row += segments
            limit += 1
        fraction = limit
        total, information = 0.0, 0.0
        if k_scatter > 0.0:
            zz, zy, yy, determinant = _scatter(designs[p], satellites)
            scale = k_scatter**2
            total = _scatter_error(
                zz * scale,
                zy * scale,
                yy * scale,
                determinant * scale**2,
                k_height[side],
                k_azimuth[side],
                k_per_height,
                k_alike,
                k_azimuth_factor,
                k_shift,
            )
        for s in range(segments if k_scatter == 0.0 else 0):
            for n in range(satellites):
                offset = designs[p, 2 * n] - designs[p, 0]
                rate = designs[p, 2 * n + 1] - designs[p, 1]
                w_height[n] = k_height[side, s, 0] * offset + k_height[side, s, 1] * rate
                w_azimuth[n] = k_azimuth[side, s, 0] * offset + k_azimuth[side, s, 1] * rate
            across = w_height[k_transmitter[0]] + w_height[k_receiver[0]]
            along = w_azimuth[k_transmitter[0]] + w_azimuth[k_receiver[0]]
            largest = 0.0
            for i in range(images):
                projected = w_height[k_transmitter[i]] + w_height[k_receiver[i]] - across
                w_along[i] = w_azimuth[k_transmitter[i]] + w_azimuth[k_receiver[i]] - along
                w_kz[i] = projected * k_per_height[s]
                w_offset[i] = projected * k_range_rate[s]
                w_doppler[i] = w_along[i] * k_doppler_rate[s]
                largest = max(largest, abs(w_kz[i]))
            if k_alike[s] > 0.0:
                information = _alike_information(k_alike[s], k_azimuth_factor, w_kz, w_along)
            if k_alike[s] == 0.0 or k_failure_limit < 0.0:
                if k_pairs_weighting:
                    _pair_edges(
                        s,
                        w_offset,
                        w_doppler,
                        w_along,
                        w_edges,
                        k_decorrelation,
                        k_has_doppler,
                        k_phase_std,
                        k_pair_coherence,
                        k_looks,
                        k_has_eta,
                        k_pairs,
                        k_pair_variance,
                        k_pair_azimuth,
                        k_eta_rate,
                        k_eta_intervals,
                        k_eta_cubics,
                        k_eta_first,
                        k_eta_contrast,
                    )
                else:
                    _joint_edges(
                        s,
                        w_offset,
                        w_doppler,
                        w_edges,
                        k_weight,
                        k_decorrelation,
                        k_has_doppler,
                        k_looks,
                        k_has_eta,
                        k_pairs,
                        k_eta_rate,
                        k_eta_intervals,
                        k_eta_cubics,
                        k_eta_first,
                        k_eta_contrast,
                        w_order,
                        w_ends,
                        w_low,
                        w_high,
                        w_dop_ends,
                        w_dop_low,
                        w_dop_high,
                        w_table,
                        w_cumulative,
                    )
            if k_alike[s] == 0.0:
                information = _height_information(
                    w_kz,
                    w_along,
                    w_edges,
                    k_factor,
                    k_azimuth_factor,
                    w_left,
                    w_factor,
                    w_product,
                    w_amplitude,
                    w_column,
                    w_normal,
                )
            if largest < _NO_WAVENUMBER or information < _NOTHING:
                total = math.inf
            else:
                total += 1.0 / information + k_shift[s]
            if k_failure_limit < 0.0:
                failure = _unwrapping_failure(
                    w_kz,
                    w_along,
                    w_edges,
                    k_prior,
                    k_azimuth_factor,
                    k_shared,
                    w_noise,
                    w_covariance,
                    w_column,
                    w_variance,
                    w_gain,
                )
                margin = k_failure_limit - math.log10(max(failure, 1e-16))
                worst[p, unwrapping] = min(worst[p, unwrapping], margin)
                if detailed:
                    items[p, unwrapping_row + s] = margin
            if k_max_fraction > 0.0:
                for i in range(images):
                    for j in range(i + 1, images):
                        share = abs(w_kz[j] - w_kz[i]) * k_per_critical[s]
                        margin = -(share / k_max_fraction - 1.0)
                        worst[p, fraction] = min(worst[p, fraction], margin)
                        if detailed:
                            items[p, row] = margin
                        row += 1
        if k_max_fraction > 0.0:
            limit += 1
        for value, first in ((k_max_offset, 0), (k_max_rate, 1)):
            if value > 0.0:
                for n in range(satellites):
                    margin = -(abs(designs[p, 2 * n + first]) / value - 1.0)
                    worst[p, limit] = min(worst[p, limit], margin)
                    if detailed:
                        items[p, row + n] = margin
                row += satellites
                limit += 1
        objectives[p] = math.sqrt(total / segments)
