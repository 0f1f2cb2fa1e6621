"""Exact phase statistics beside the Cramér-Rao bound."""

from __future__ import annotations

from collections.abc import Callable

from insar.statistics import cramer_rao_std, difference_quantile, phase_quantile, phase_std

from .markdown import digits, markdown_table

_CASES = ((0.6, 1), (0.9, 1), (0.7, 4), (0.9, 4), (0.8, 16), (0.9, 16), (0.4, 64), (0.8, 64))


def phase_statistics() -> str:
    """Deviations and 90 % quantiles of the phase error."""
    rows = []
    for gamma, looks in _CASES:
        exact = float(phase_std(gamma, looks=looks))
        bound = float(cramer_rao_std(gamma, looks=looks))
        rows.append(
            [
                f"γ = {gamma}, L = {looks}",
                digits(exact, 4),
                digits(bound, 4),
                f"{100 * (exact / bound - 1):.0f} %",
                digits(float(phase_quantile(gamma, looks=looks)), 4),
                digits(float(difference_quantile(gamma, looks=looks)), 4),
                digits(float(difference_quantile(gamma, looks=looks)) / (2.3262 * exact), 3),
            ]
        )
    head = [
        "coherence, looks",
        "exact σ [rad]",
        "Cramér-Rao [rad]",
        "exact above it",
        "90 % of one [rad]",
        "90 % of a difference [rad]",
        "the same, Gaussian of the exact σ = 1",
    ]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {"phase_statistics": phase_statistics}
