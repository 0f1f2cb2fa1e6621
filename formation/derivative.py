"""Velocities of analytic theories that give good positions: the derivative of those positions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .trajectory import States

Array = NDArray[np.float64]

_STEP: Final = 2.0
"""Spacing of the differences [s]: truncation and rounding both stay near 1 µm/s from LEO up."""


def states_from_positions(position: Callable[[Array], Array], times: ArrayLike) -> States:
    """States whose velocity is the derivative of the position.

    Theories that are cut off at some order give velocities of their own, which differ from that
    derivative by millimeters per second and more; a Doppler shift must agree with the change of
    range.

    Parameters
    ----------
    position : positions (..., 3) at times (...) [m].
    times : (...) [s].

    Returns
    -------
    States (..., 3), the velocity by central differences of fourth order [m, m/s].
    """
    time = np.asarray(times, dtype=np.float64)
    steps = _STEP * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    before2, before, now, after, after2 = np.moveaxis(position(time[..., None] + steps), -2, 0)
    velocity = (8.0 * (after - before) - (after2 - before2)) / (12.0 * _STEP)
    return States(now, velocity)
