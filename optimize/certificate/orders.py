"""In which orders the satellites of a formation may stand, up to those that are equally good."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from insar import ErrorBudget, Radar

Array = NDArray[np.float64]

MAX_ORDERS = 400
"""Orders above which a branch and bound is not tried."""


def relevant_satellites(radar: Radar) -> tuple[int, ...]:
    """Satellites whose place some phase difference depends on.

    Parameters
    ----------
    radar : for its images; a transmitter that all of them share, and that does not receive,
        cancels.
    """
    differences = radar.incidence_matrix - radar.incidence_matrix[0]
    return tuple(np.flatnonzero(np.any(differences != 0.0, axis=0)).tolist())


def satellite_classes(radar: Radar, errors: ErrorBudget) -> tuple[int, ...]:
    """Class of each relevant satellite; those of one class can be exchanged at no cost.

    Parameters
    ----------
    radar, errors : what the phases tell.

    Returns
    -------
    Classes in the order of `relevant_satellites`.

    Notes
    -----
    Receivers of one transmitter differ in nothing but their place, and so does the transmitter if
    it receives too and bistatic links have no phase error of their own: its position is common to
    all images. The same holds where every satellite has its own monostatic image.
    """
    relevant = relevant_satellites(radar)
    transmitters = {tx for tx, _ in radar.images}
    receivers = [rx for _, rx in radar.images]
    each_once = len(set(receivers)) == len(receivers)
    monostatic = all(tx == rx for tx, rx in radar.images)
    if each_once and monostatic:
        return (0,) * len(relevant)
    if each_once and len(transmitters) == 1:
        alike = errors.synchronization.std == 0.0
        return tuple(0 if alike else int(satellite in transmitters) for satellite in relevant)
    return tuple(range(len(relevant)))


def order_count(classes: tuple[int, ...]) -> int:
    """How many orders of classes there are, mirror images included.

    Parameters
    ----------
    classes : from `satellite_classes`.
    """
    count = math.factorial(len(classes))
    for name in set(classes):
        count //= math.factorial(classes.count(name))
    return count


def orders(radar: Radar, errors: ErrorBudget) -> Iterator[tuple[int, ...]]:
    """Orders of the relevant satellites, one of each set of equally good ones.

    Parameters
    ----------
    radar, errors : what the phases tell.

    Notes
    -----
    A formation turned by half a turn, v → −v, has the opposite order and the same height error.
    """
    relevant, classes = relevant_satellites(radar), satellite_classes(radar, errors)
    seen: set[tuple[int, ...]] = set()
    for order in permutations(range(len(relevant))):
        signature = tuple(classes[index] for index in order)
        if signature in seen or signature[::-1] in seen:
            continue
        seen.add(signature)
        yield tuple(relevant[index] for index in order)


def is_palindrome(order: tuple[int, ...], radar: Radar, errors: ErrorBudget) -> bool:
    """Whether an order and its mirror image are one and the same up to exchanges.

    Parameters
    ----------
    order : from `orders`.
    radar, errors : what the phases tell.
    """
    signature = order_signature(order, radar, errors)
    return signature == signature[::-1]


def order_signature(order: tuple[int, ...], radar: Radar, errors: ErrorBudget) -> tuple[int, ...]:
    """Classes of satellites in a given order.

    Parameters
    ----------
    order : relevant satellites by increasing coordinate.
    radar, errors : what the phases tell.
    """
    of = dict(zip(relevant_satellites(radar), satellite_classes(radar, errors), strict=True))
    return tuple(of[satellite] for satellite in order)


def known_gaps(
    coordinates: Array, radar: Radar, errors: ErrorBudget, sequences: list[tuple[int, ...]]
) -> list[tuple[int, Array]]:
    """A formation as gaps, in the order that stands for its own.

    Parameters
    ----------
    coordinates : (N,) or (N, C) — of the satellites; sorted by the first.
    radar, errors : what the phases tell.
    sequences : orders of the satellites.

    Returns
    -------
    (index of the order, (N − 1,) or (N − 1, C)) — one, or none.
    """
    first = coordinates if coordinates.ndim == 1 else coordinates[:, 0]
    order = sorted(sorted(sequences[0]), key=lambda satellite: first[satellite])
    gaps = np.diff(coordinates[order], axis=0)
    signature = order_signature(tuple(order), radar, errors)
    for index, sequence in enumerate(sequences):
        candidate = order_signature(sequence, radar, errors)
        if candidate == signature:
            return [(index, gaps)]
        if candidate == signature[::-1]:
            return [(index, gaps[::-1])]
    return []
