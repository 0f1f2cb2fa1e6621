"""The errors that do not depend on the formation, and those drawn anew for every pair."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from insar import ErrorBudget, Radar, SharedBy, Weighting

Array = NDArray[np.float64]

TABLE = 5e-5
"""Part by which a tabulated efficiency may be off, with room to spare."""


def shared_factor(radar: Radar, errors: ErrorBudget) -> Array:
    """Factor of the errors that images share and that do not depend on the formation.

    Parameters
    ----------
    radar, errors : what the phases tell.

    Returns
    -------
    (M, R) — as in `PhaseModel.nuisance`, without the azimuth error [rad].
    """
    parts = [np.zeros((len(radar.images), 1))]
    if errors.position.std > 0.0 and errors.position.shared_by is SharedBy.SATELLITE:
        scale = 2.0 * math.pi / radar.wavelength * errors.position.std
        parts.append(scale * radar.relative_incidence)
    if errors.synchronization.std > 0.0 and errors.synchronization.shared_by is SharedBy.IMAGE:
        bistatic = np.diag([float(tx != rx) for tx, rx in radar.images])
        parts.append(errors.synchronization.std * bistatic)
    return np.concatenate(parts, axis=-1)


def pair_variance(radar: Radar, errors: ErrorBudget) -> Array:
    """Variance of errors drawn anew for every pair, without the azimuth error: (K,) [rad²].

    Parameters
    ----------
    radar, errors : what the phases tell.
    """
    variance = np.zeros(len(radar.image_pairs))
    if errors.weighting is not Weighting.PAIRS:
        return variance
    first, second = radar.image_pairs.T
    if errors.position.std > 0.0 and errors.position.shared_by is SharedBy.PAIR:
        factor = 2.0 * math.pi / radar.wavelength * errors.position.std * radar.relative_incidence
        variance += np.sum((factor[second] - factor[first]) ** 2, axis=-1)
    if errors.synchronization.std > 0.0 and errors.synchronization.shared_by is SharedBy.PAIR:
        bistatic = np.array([float(tx != rx) for tx, rx in radar.images])
        variance += errors.synchronization.std**2 * (bistatic[first] + bistatic[second])
    return variance
