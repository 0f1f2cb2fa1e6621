"""Margins of the limits on orbits and baselines, in the order of `Constraints.limits`."""

from __future__ import annotations

from .lanes import jit, keep, lanes, magnitude, number, root, smaller


@jit
def note(r, limit, row, margin, detailed):
    """Count a margin of a limit."""
    keep(r.worst, limit, smaller(margin, lanes(r.worst, limit)))
    if detailed:
        keep(r.items, row, margin)


@jit
def radius(k, r, limit, row, detailed):
    """Radius of each relative orbit."""
    for n in range(k.satellites):
        z, y = lanes(r.radial, n), lanes(r.rate, n) / k.mean_motion
        share = 2.0 * root(z * z + y * y) / k.max_radius
        note(r, limit, row + n, 1.0 - share, detailed)


@jit
def separation(k, r, limit, row, detailed):
    """Closest approach of each pair: twice the distance in the plane, in both circular families."""
    for i in range(k.satellites):
        for j in range(i + 1, k.satellites):
            z = lanes(r.radial, j) - lanes(r.radial, i)
            y = (lanes(r.rate, j) - lanes(r.rate, i)) / k.mean_motion
            share = 2.0 * root(z * z + y * y) / k.min_separation
            note(r, limit, row, share - 1.0, detailed)
            row += 1


@jit
def baseline_fraction(k, r, s, limit, row, detailed):
    """Perpendicular baseline of each pair of images in a segment, in parts of the critical one."""
    scale = number(k.per_critical, s) / k.max_fraction
    for i in range(k.images):
        for j in range(i + 1, k.images):
            share = magnitude(lanes(r.kz, j) - lanes(r.kz, i)) * scale
            note(r, limit, row, 1.0 - share, detailed)
            row += 1


@jit
def box(k, r, values, most, limit, row, detailed):
    """Size of a design variable of each satellite."""
    for n in range(k.satellites):
        note(r, limit, row + n, 1.0 - magnitude(lanes(values, n)) / most, detailed)
