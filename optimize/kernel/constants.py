"""What the compiled loops are given: every number of a problem, in arrays of fixed meaning."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import ground_track_circular, space_circular
from insar import BaselineDecorrelation, ErrorBudget, SharedBy, Weighting
from insar.baselines import scene_critical_baseline
from insar.coherence import doppler_offset, image_amplitude
from insar.height import common_height_errors
from insar.statistics import efficiency_curves

from ..design_space import DesignSpace
from ..problem import Problem
from ..projection import projection

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
    satellites, pairs : numbers N of satellites and K of pairs of images.
    signs : sign of the cross-track motion; 0 where the last variable of a design holds it.
    mean_motion : scalar [rad/s].
    transmitter, receiver : (M,) — satellites of each image.
    height, azimuth : (2, S, 2) — projections of (z0, ż0) for either sign, negative first.
    per_height : (S,) — kz by projected phase center [rad/m²].
    range_rate, doppler_rate : (S,) — shift of the bands by projected phase center [1/m].
    per_critical : (S,) — share of the critical baseline by kz [m/rad].
    has_doppler, has_eta, pairs_weighting : which parts are on.
    decorrelation : 0 none, 1 filtered, 2 unfiltered.
    looks : L.
    weight : (S, M) — u_i.
    pair_coherence : (S, K) — γ_i γ_j.
    phase_std : given deviation of each pair [rad]; 0 without.
    pair_variance : (K,) — what pairs have apart from their phase noise [rad²].
    pair_azimuth : variance by squared azimuth baseline [rad²/m²].
    factor : (M, R) — constant columns of F, relative to the first image [rad].
    shared : (M, M) — their FFᵀ [rad²].
    azimuth_factor : column of the azimuth error by projected phase center [rad/m]; 0 without.
    eta_cubics, eta_first, eta_rate, eta_contrast, eta_intervals : curves of the efficiency, a row
        for each segment and pair.
    alike : (S,) — variance of a phase, noise and shared errors, where all images are alike and
        nothing but the azimuth error depends on the design; 0 otherwise [rad²].
    scatter : how often each image counts the place of its satellite, where the information is
        that of the fleet's scatter alone and no limit looks at pairs of images; 0 otherwise.
    shift : (S,) — squares of the errors that move the height directly [m²].
    max_radius, min_separation, failure_limit, prior, max_fraction, max_offset, max_rate : limits.
    """

    satellites: int
    pairs: int
    signs: int
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
    has_eta: bool
    pairs_weighting: bool
    decorrelation: int
    looks: float
    weight: Array
    pair_coherence: Array
    phase_std: float
    pair_variance: Array
    pair_azimuth: float
    factor: Array
    shared: Array
    azimuth_factor: float
    eta_cubics: Array
    eta_first: Indices
    eta_rate: Array
    eta_contrast: Array
    eta_intervals: int
    alike: Array
    scatter: float
    shift: Array
    max_radius: float
    min_separation: float
    failure_limit: float
    prior: float
    max_fraction: float
    max_offset: float
    max_rate: float


class Scratch(NamedTuple):
    """Room for one formation in one segment; every element is written before it is read."""

    order: Indices
    ends: Array
    low: Indices
    high: Indices
    dop_ends: Array
    dop_low: Indices
    dop_high: Indices
    cumulative: Array
    table: Array
    height: Array
    azimuth: Array
    kz: Array
    along: Array
    offset: Array
    doppler: Array
    edges: Array
    left: Array
    product: Array
    column: Array
    factor: Array
    amplitude: Array
    normal: Array
    noise: Array
    covariance: Array
    variance: Array
    gain: Array


def scratch(k: Constants) -> Scratch:
    """Room for the formations of a problem.

    Parameters
    ----------
    k : its constants.
    """
    images, satellites, sources = len(k.transmitter), k.satellites, k.factor.shape[1] + 1
    ends = 2 * images
    vector, square = np.empty((9, images)), np.empty((4, images, images))
    index, axis = np.empty((5, images), dtype=np.int64), np.empty((3, ends))
    square[0] = 0.0  # no edge of an image to itself
    return Scratch(
        order=index[0],
        low=index[1],
        high=index[2],
        dop_low=index[3],
        dop_high=index[4],
        ends=axis[0],
        dop_ends=axis[1],
        cumulative=axis[2],
        table=np.empty((ends, ends)),
        height=np.empty(satellites),
        azimuth=np.empty(satellites),
        kz=vector[0],
        along=vector[1],
        offset=vector[2],
        doppler=vector[3],
        left=vector[4],
        product=vector[5],
        column=vector[6],
        gain=vector[7],
        edges=square[0],
        noise=square[1],
        covariance=square[2],
        variance=square[3],
        factor=np.empty((images, sources)),
        amplitude=np.empty(sources),
        normal=np.empty((sources, sources)),
    )


def supported(problem: Problem, space: DesignSpace) -> bool:
    """Whether the compiled loops know every part of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    """
    errors = problem.errors
    joint_unfiltered = (
        errors.weighting is Weighting.JOINT
        and errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED
    )
    unfiltered = errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED
    if _exact(errors) and unfiltered:  # the efficiency then depends on coherence and looks both
        return False
    return (
        space.family in (space_circular, ground_track_circular)
        and errors.coherence.spectral
        and not joint_unfiltered
        and space.satellites == problem.radar.satellite_count
    )


def constants(problem: Problem, space: DesignSpace) -> Constants:
    """Collect the numbers of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits; `supported`.
    space : the designs.
    """
    scene, radar, errors, limits = problem.scene, problem.radar, problem.errors, problem.constraints
    count, segments = len(radar.images), len(scene)
    wavenumber = 2.0 * math.pi / radar.wavelength
    planes = [
        projection(space, scene, held_constant=errors.held_constant, sign=sign) for sign in (-1, 1)
    ]
    rate = np.array([1.0, 1.0 / space.mean_motion])
    per_height = wavenumber / planes[0].lever
    critical = scene_critical_baseline(scene, radar)
    doppler = np.zeros(segments)
    if radar.azimuth_resolution is not None and not radar.pursuit:
        doppler += doppler_offset(
            1.0,
            wavelength=radar.wavelength,
            slant_range=scene.slant_range,
            azimuth_resolution=radar.azimuth_resolution,
        )
    amplitude = np.broadcast_to(
        image_amplitude(scene, radar=radar, errors=errors), (segments, count)
    )
    first, second = radar.image_pairs.T
    pair_coherence = amplitude[:, first] * amplitude[:, second]
    efficiency = _efficiency(pair_coherence, errors)
    curves = efficiency or _NO_EFFICIENCY
    factor, pair_variance = _constant_errors(problem)
    alike = _alike(problem, amplitude, factor, pair_variance)
    in_pairs = errors.azimuth.shared_by is SharedBy.PAIR
    azimuth = wavenumber * errors.azimuth.std
    probability = limits.min_unwrapping_probability
    return Constants(
        satellites=space.satellites,
        pairs=len(first),
        signs=0 if space.dimension > 2 * space.satellites else space.signs[0],
        mean_motion=space.mean_motion,
        transmitter=np.array([image[0] for image in radar.images], dtype=np.int64),
        receiver=np.array([image[1] for image in radar.images], dtype=np.int64),
        height=np.stack([plane.height * rate for plane in planes]),
        azimuth=np.stack([plane.azimuth * rate for plane in planes]),
        per_height=per_height,
        range_rate=1.0 / critical,
        doppler_rate=doppler,
        per_critical=1.0 / (critical * per_height),
        has_doppler=bool(np.any(doppler)),
        has_eta=efficiency is not None,
        pairs_weighting=errors.weighting is Weighting.PAIRS,
        decorrelation=_DECORRELATION[errors.baseline_decorrelation],
        looks=float(radar.looks),
        weight=amplitude**2 / (1.0 - amplitude**2),
        pair_coherence=pair_coherence,
        phase_std=errors.phase_std or 0.0,
        pair_variance=pair_variance,
        pair_azimuth=azimuth**2 if in_pairs else 0.0,
        factor=factor,
        shared=factor @ factor.T,
        azimuth_factor=0.0 if in_pairs else azimuth,
        eta_cubics=curves.cubics,
        eta_first=curves.first,
        eta_rate=curves.rate,
        eta_contrast=curves.contrast,
        eta_intervals=curves.intervals,
        alike=alike,
        scatter=_scatter(problem) if np.all(alike > 0.0) else 0.0,
        shift=_height_shift(problem),
        max_radius=limits.max_radius or 0.0,
        min_separation=limits.min_separation or 0.0,
        failure_limit=1.0 if probability is None else math.log10(1.0 - probability),
        prior=limits.prior_height_std or 0.0,
        max_fraction=limits.max_baseline_fraction or 0.0,
        max_offset=limits.max_offset or 0.0,
        max_rate=limits.max_rate or 0.0,
    )


def _constant_errors(problem: Problem) -> tuple[Array, Array]:
    """Columns of F that no design changes, (M, R), and the variances of pairs (K,)."""
    radar, errors = problem.radar, problem.errors
    first, second = radar.image_pairs.T
    wavenumber = 2.0 * math.pi / radar.wavelength
    bistatic = np.diag([float(tx != rx) for tx, rx in radar.images])
    sources = (
        (errors.position, wavenumber * errors.position.std * radar.relative_incidence),
        (errors.synchronization, errors.synchronization.std * bistatic),
    )
    columns, variance = [np.zeros((len(radar.images), 0))], np.zeros(len(first))
    for source, factor in sources:
        if source.std == 0.0:
            continue
        if source.shared_by is SharedBy.PAIR:
            variance += np.sum((factor[second] - factor[first]) ** 2, axis=-1)
        else:
            columns.append(factor - factor[:1])
    return np.concatenate(columns, axis=-1), variance


def _alike(problem: Problem, amplitude: Array, factor: Array, pair_variance: Array) -> Array:
    """Variance of each segment's phases, all with the same independent errors; 0 if they have not.

    With a Laplacian of equal edges x, and shared errors whose covariance relative to the first
    image is p²(I + 11ᵀ), both act on centered phases as multiples of the identity: 1/(Mx) + p².
    """
    radar, errors = problem.radar, problem.errors
    segments, count = amplitude.shape
    covariance = (factor @ factor.T)[1:, 1:]
    own = covariance[0, 0] / 2.0
    same = np.allclose(covariance, own * (np.eye(count - 1) + 1.0), rtol=1e-12, atol=1e-14 * own)
    same = same and np.ptp(amplitude) == 0.0 and np.ptp(pair_variance) == 0.0
    same = same and errors.azimuth.shared_by is not SharedBy.PAIR
    if not same or errors.baseline_decorrelation is not BaselineDecorrelation.NONE:
        return np.zeros(segments)
    gamma = amplitude[:, 0] ** 2
    efficiency = np.ones(segments)
    if _exact(errors):
        looks = np.full((segments, 1), radar.looks)
        efficiency = efficiency_curves(gamma[:, None])(looks)[:, 0]
    if errors.weighting is Weighting.JOINT:
        weight = gamma / (1.0 - gamma)
        edge = 2.0 * radar.looks * weight**2 / (1.0 + count * weight)
        return np.asarray(1.0 / (count * edge * efficiency) + own)
    variance = (1.0 - gamma**2) / (2.0 * radar.looks * gamma**2) / efficiency
    if errors.phase_std is not None:
        variance = np.full(segments, errors.phase_std**2)
    return np.asarray((variance + pair_variance[0]) / count + own)


def _scatter(problem: Problem) -> float:
    radar, limits = problem.radar, problem.constraints
    if limits.min_unwrapping_probability is not None or limits.max_baseline_fraction is not None:
        return 0.0
    transmitters = {image[0] for image in radar.images}
    receivers = {image[1] for image in radar.images}
    if len(radar.images) != radar.satellite_count or len(receivers) != radar.satellite_count:
        return 0.0
    if len(transmitters) == 1:
        return 1.0
    return 2.0 if all(transmitter == receiver for transmitter, receiver in radar.images) else 0.0


def _height_shift(problem: Problem) -> Array:
    scene = problem.scene
    common = common_height_errors(scene, radar=problem.radar, errors=problem.errors)
    return np.asarray(sum((error**2 for error in common.values()), start=np.zeros(len(scene))))


class Efficiency(NamedTuple):
    """Curves of the efficiency of each segment and pair, a row each; of one value without."""

    cubics: Array
    first: Indices
    rate: Array
    contrast: Array
    intervals: int


def _efficiency(coherence: Array, errors: ErrorBudget) -> Efficiency | None:
    """Curves of pairs (S, K) of constant coherence; None where the Cramér-Rao bound counts."""
    if not _exact(errors):
        return None
    curves = efficiency_curves(coherence)
    return Efficiency(
        cubics=np.ascontiguousarray(curves.coefficients),
        first=curves.first.astype(np.int64).ravel(),
        rate=curves.rate.ravel(),
        contrast=curves.contrast.ravel(),
        intervals=int(np.diff(np.unique(np.append(curves.first, len(curves.coefficients))))[0]),
    )


def _exact(errors: ErrorBudget) -> bool:
    exact = getattr(errors, "phase_statistics", "cramer_rao") == "exact"
    return exact and errors.phase_std is None


_NO_EFFICIENCY = Efficiency(
    np.zeros((1, 4)), np.zeros(1, dtype=np.int64), np.zeros(1), np.zeros(1), 1
)
