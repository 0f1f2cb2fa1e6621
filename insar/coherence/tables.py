"""Properties of a radar beam and of a scene that are tabulated over the incidence."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def at_incidence(incidence: ArrayLike, *, table: ArrayLike, values: ArrayLike) -> Array:
    """Interpolate a table of power ratios over the incidence.

    Parameters
    ----------
    incidence : (...) — where it is wanted [rad].
    table : (n,) — incidences of the table, increasing [rad].
    values : (n,) — power ratios above zero.

    Returns
    -------
    (...) — linear in decibels between the entries.

    Raises
    ------
    ValueError
        If the table does not increase, a value is not positive, or an incidence lies outside the
        table: nothing is extrapolated.
    """
    wanted = np.asarray(incidence, dtype=np.float64)
    known, power = np.asarray(table, dtype=np.float64), np.asarray(values, dtype=np.float64)
    if known.shape != power.shape or known.ndim != 1 or np.any(np.diff(known) <= 0.0):
        raise ValueError("table must hold increasing incidences, one for each of the values")
    if not np.all(power > 0.0):
        raise ValueError("values must be positive power ratios")
    # Rounding of a conversion from degrees is not outside.
    outside = (wanted < known[0] - 1e-9) | (wanted > known[-1] + 1e-9)
    if np.any(outside):
        worst = float(np.rad2deg(np.ravel(wanted)[np.argmax(np.ravel(outside))]))
        low, high = np.rad2deg(known[[0, -1]])
        raise ValueError(
            f"the incidence {worst:.4g}° lies outside the table, {low:.4g}° to {high:.4g}°; "
            "add entries that reach it, since nothing is extrapolated"
        )
    return np.asarray(np.exp(np.interp(wanted, known, np.log(power))))
