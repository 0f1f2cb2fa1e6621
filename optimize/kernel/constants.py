"""What the compiled loops are given: every number of a problem, in arrays of fixed meaning."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from insar import BaselineDecorrelation, SharedBy, Weighting
from insar.baselines import scene_critical_baseline
from insar.coherence import doppler_offset, image_amplitude
from insar.height import common_height_errors
from insar.statistics import efficiency_curves

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import projection
from ..scatter import alike_variance
from ..shared_errors import shared_errors
from .efficiency import NO_EFFICIENCY, NO_LINE, efficiency, exact, variance_line
from .parts import MOST_IMAGES, NO_PARTS, parts

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_DECORRELATION = {
    BaselineDecorrelation.NONE: 0,
    BaselineDecorrelation.FILTERED: 1,
    BaselineDecorrelation.UNFILTERED: 2,
}


class Constants(NamedTuple):
    """Numbers of a problem; a limit that is off is 0, and the logarithm of a failure 1.

    Attributes
    ----------
    satellites, images, pairs, segments, limits : numbers N, M, K, S and C.
    sign : of the cross-track motion; 0 where the last variable of a design holds it.
    mean_motion : scalar [rad/s].
    transmitter, receiver : (M,) — satellites of each image.
    height, azimuth : (2, S, 2) — projections of (z0, ż0) for either sign, negative first.
    per_height : (S,) — kz by projected phase center [rad/m²].
    range_rate, doppler_rate : (S,) — shift of the bands by projected phase center [1/m].
    per_critical : (S,) — share of the critical baseline by kz [m/rad].
    has_doppler, has_efficiency, pairs_weighting, given_noise : which parts are on.
    decorrelation : 0 none, 1 filtered, 2 unfiltered.
    looks : L.
    weight : (S, M) — u_i.
    pair_coherence : (S, K) — γ_i γ_j.
    steady : (S, K) — joint information of pairs without decorrelation [1/rad²].
    sets, lowest, members, part_weight, part_stride : `parts.Parts`, where sets of images are used;
        the stride is 0 where all segments have the same weights.
    pair_noise : (S, K) — phase variance of each pair at full band [rad²]; `given_noise` where it
        is the budget's.
    pair_variance : (K,) — what pairs have apart from their phase noise [rad²].
    pair_azimuth : variance by squared azimuth baseline [rad²/m²].
    sources, factor, shared, own_variance : R and `shared_errors.SharedErrors`.
    azimuth_factor : column of the azimuth error by projected phase center [rad/m]; 0 without.
    eta_cubics, eta_first, eta_rate, eta_contrast, eta_intervals : `efficiency.Efficiency`.
    line, line_rows, line_start, line_per_unit : `insar.statistics.table.VarianceLine`.
    scatter, alike : whether the information is that of the fleet's scatter alone, and then the
        variance of the phases (S,) [rad²].
    shift : (S,) — squares of the errors that move the height directly [m²].
    max_radius, min_separation, failure_limit, prior, max_fraction, max_offset, max_rate : limits.
    """

    satellites: int
    images: int
    pairs: int
    segments: int
    limits: int
    sign: float
    mean_motion: float
    transmitter: Indices
    receiver: Indices
    height: Array
    azimuth: Array
    per_height: Array
    range_rate: Array
    doppler_rate: Array
    per_critical: Array
    has_doppler: bool
    has_efficiency: bool
    pairs_weighting: bool
    given_noise: bool
    decorrelation: int
    looks: float
    weight: Array
    pair_coherence: Array
    steady: Array
    sets: bool
    lowest: Indices
    members: Indices
    part_weight: Array
    part_stride: int
    pair_noise: Array
    pair_variance: Array
    pair_azimuth: float
    sources: int
    factor: Array
    shared: Array
    own_variance: float
    azimuth_factor: float
    eta_cubics: Array
    eta_first: Indices
    eta_rate: Array
    eta_contrast: Array
    eta_intervals: float
    line: Array
    line_rows: float
    line_start: float
    line_per_unit: float
    scatter: bool
    alike: Array
    shift: Array
    max_radius: float
    min_separation: float
    failure_limit: float
    prior: float
    max_fraction: float
    max_offset: float
    max_rate: float


def by_address(k: Constants) -> NDArray[np.void]:
    """Return the same as a record of numbers, with the address of its first element for each array.

    Parameters
    ----------
    k : the constants, which have to outlive what is computed with the addresses.

    Returns
    -------
    (1,) — of the type `RECORD`.
    """
    values = tuple(value.ctypes.data if isinstance(value, np.ndarray) else value for value in k)
    return np.array([values], dtype=RECORD)


def constants(problem: Problem, space: DesignSpace) -> Constants:
    """Collect the numbers of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits; `supported`.
    space : the designs.
    """
    radar, errors = problem.radar, problem.errors
    amplitude = np.broadcast_to(
        image_amplitude(problem.scene, radar=radar, errors=errors),
        (len(problem.scene), len(radar.images)),
    )
    azimuth = 2.0 * math.pi / radar.wavelength * errors.azimuth.std
    in_pairs = errors.azimuth.shared_by is SharedBy.PAIR
    shared = shared_errors(radar=radar, errors=errors)
    alike = alike_variance(scene=problem.scene, radar=radar, errors=errors)
    common = common_height_errors(problem.scene, radar=radar, errors=errors)
    numbers: dict[str, Any] = {
        "satellites": space.satellites,
        "images": len(radar.images),
        "pairs": len(radar.image_pairs),
        "segments": len(problem.scene),
        "limits": len(problem.limits),
        "sign": 0.0 if space.dimension > 2 * space.satellites else float(space.signs[0]),
        "mean_motion": space.mean_motion,
        "transmitter": [image[0] for image in radar.images],
        "receiver": [image[1] for image in radar.images],
        "looks": radar.looks,
        "pair_variance": shared.pair_variance,
        "pair_azimuth": azimuth**2 if in_pairs else 0.0,
        "sources": shared.factor.shape[1],
        "factor": shared.factor,
        "shared": shared.shared,
        "own_variance": shared.own_variance,
        "azimuth_factor": 0.0 if in_pairs else azimuth,
        "scatter": alike is not None,
        "alike": np.zeros(len(problem.scene)) if alike is None else alike,
        "shift": np.sum([error**2 for error in common.values()], axis=0),
    }
    numbers |= _plane(problem, space) | _noise(problem, amplitude) | _limits(problem)
    return Constants(**{name: _plain(numbers[name], kind) for name, kind in _KINDS.items()})


_KINDS: dict[str, str] = {
    name: kind.__forward_arg__ for name, kind in Constants.__annotations__.items()
}

RECORD = np.dtype([(name, "f8" if kind == "float" else "i8") for name, kind in _KINDS.items()])
"""The constants with arrays by their addresses."""


def _plain(value: Any, kind: str) -> Any:
    """Return a number of Python's, or an array with its elements in a row."""
    if kind in ("Array", "Indices"):
        return np.ascontiguousarray(value, dtype=np.int64 if kind == "Indices" else np.float64)
    return {"int": int, "float": float, "bool": bool}[kind](value)


def _plane(problem: Problem, space: DesignSpace) -> dict[str, Any]:
    """What each segment sees of the plane (z0, ż0)."""
    scene, radar = problem.scene, problem.radar
    held = problem.errors.held_constant
    planes = [projection(space, scene, held_constant=held, sign=sign) for sign in (-1, 1)]
    rate = np.array([1.0, 1.0 / space.mean_motion])
    per_height = 2.0 * math.pi / radar.wavelength / planes[0].lever
    critical = scene_critical_baseline(scene, radar)
    doppler = np.zeros(len(scene))
    if radar.azimuth_resolution is not None and not radar.pursuit:
        doppler += doppler_offset(
            1.0,
            wavelength=radar.wavelength,
            slant_range=scene.slant_range,
            azimuth_resolution=radar.azimuth_resolution,
        )
    return {
        "height": np.stack([plane.height * rate for plane in planes]),
        "azimuth": np.stack([plane.azimuth * rate for plane in planes]),
        "per_height": per_height,
        "range_rate": 1.0 / critical,
        "doppler_rate": doppler,
        "per_critical": 1.0 / (critical * per_height),
        "has_doppler": np.any(doppler),
    }


def _noise(problem: Problem, amplitude: Array) -> dict[str, Any]:
    """What phase noise follows from."""
    radar, errors = problem.radar, problem.errors
    first, second = radar.image_pairs.T
    coherence = amplitude[:, first] * amplitude[:, second]
    weight = amplitude**2 / (1.0 - amplitude**2)
    joint, counted = errors.weighting is Weighting.JOINT, exact(errors)
    decorrelation = errors.baseline_decorrelation
    filtered = decorrelation is BaselineDecorrelation.FILTERED
    varies = decorrelation is BaselineDecorrelation.UNFILTERED
    curves = efficiency(coherence) if counted and not varies else NO_EFFICIENCY
    line = variance_line(radar.looks) if counted and varies else NO_LINE
    by_sets = joint and filtered and len(radar.images) <= MOST_IMAGES
    sets = parts(weight, looks=radar.looks, pairs=radar.image_pairs) if by_sets else NO_PARTS
    steady = weight[:, first] * weight[:, second] / (1.0 + np.sum(weight, axis=-1, keepdims=True))
    noise = (1.0 - coherence**2) / (2.0 * radar.looks * coherence**2)
    steady = 2.0 * radar.looks * steady
    if counted and decorrelation is BaselineDecorrelation.NONE:
        full = efficiency_curves(coherence)(np.full(coherence.shape, radar.looks))
        steady, noise = steady * full, noise / full
    if errors.phase_std is not None:
        noise = np.full(noise.shape, errors.phase_std**2)
    return {
        "has_efficiency": counted,
        "pairs_weighting": not joint,
        "given_noise": errors.phase_std is not None,
        "decorrelation": _DECORRELATION[decorrelation],
        "weight": weight,
        "pair_coherence": coherence,
        "steady": steady,
        "sets": by_sets,
        "lowest": sets.lowest,
        "members": sets.members,
        "part_weight": sets.weight,
        "part_stride": 0 if len(sets.weight) == 1 else sets.weight[0].size,
        "pair_noise": noise,
        "eta_cubics": curves.cubics,
        "eta_first": curves.first,
        "eta_rate": curves.rate,
        "eta_contrast": curves.contrast,
        "eta_intervals": curves.intervals,
        "line": line.values,
        "line_rows": len(line.values),
        "line_start": line.start,
        "line_per_unit": 1.0 / line.spacing,
    }


def _limits(problem: Problem) -> dict[str, Any]:
    limits = problem.constraints
    probability = limits.min_unwrapping_probability
    return {
        "max_radius": limits.max_radius or 0.0,
        "min_separation": limits.min_separation or 0.0,
        "failure_limit": 1.0 if probability is None else math.log10(1.0 - probability),
        "prior": limits.prior_height_std or 0.0,
        "max_fraction": limits.max_baseline_fraction or 0.0,
        "max_offset": limits.max_offset or 0.0,
        "max_rate": limits.max_rate or 0.0,
    }
