"""One acquisition of a terrain: phases by the true paths, and heights from them, chunk by chunk."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import BaselineDecorrelation, ErrorBudget
from ..height import common_height_errors, height_error_of
from ..image_model import ImageModel, image_model, unfiltered_coherence
from ..phase_model import phase_model
from ..scene import Scene
from ..terrain.view import Mask
from ..unwrapping import unwrapping_ladder
from .estimators import Processor, along_ladder, bootstrapped, likely_heights
from .linking import Complex, linked_phases
from .synthesis import SceneErrors, at_range, path_phase
from .terrain_results import TerrainRequest
from .varied import unfiltered_link_matrices, varied_link_matrices

Array = NDArray[np.float64]

_POINTS = 4096
"""Points of a chunk."""


class Points(NamedTuple):
    """P points, with what is the same in every acquisition.

    Attributes
    ----------
    mask : (rows, columns) — which of the terrain.
    target : (P, 3) — where they are, RTN of the satellite that is broadside [m].
    height, slant_range : (P,) [m].
    positions : (P, N, 3) — of the satellites then [m].
    scene : the points as segments.
    images : their amplitudes, bands and pair factors.
    processor : what is known beforehand.
    predicted : (3, P) — total and relative height error [m], and probability of a wrong cycle.
    clear : (P,) — whether every image has a phase worth the name: of 1 rad or better to the others.
    """

    mask: Mask
    target: Array
    height: Array
    slant_range: Array
    positions: Array
    scene: Scene
    images: ImageModel
    processor: Processor
    predicted: Array
    clear: NDArray[np.bool_]


class Flown(NamedTuple):
    """One acquisition of P points.

    Attributes
    ----------
    noise : (P,) — height error by noise, with right cycles [m].
    systematic : (P,) — by the errors of the scene, with right cycles [m].
    least_squares : (P,) — with the cycles that bootstrapping finds [m].
    likely : (P,) — of maximum likelihood; NaN where it was not asked for [m].
    wrong : (P,) — whether a cycle is.
    phase : (P, M) — wrapped, less what the prior height gives at the same range [rad].
    """

    noise: Array
    systematic: Array
    least_squares: Array
    likely: Array
    wrong: NDArray[np.bool_]
    phase: Array


def chunks(request: TerrainRequest, errors: ErrorBudget) -> Iterator[Points]:
    """Cut the points that are seen into chunks.

    Parameters
    ----------
    request : what is simulated.
    errors : its budget as nature keeps it.
    """
    seen = np.flatnonzero(request.view.seen)
    for start in range(0, seen.size, _POINTS):
        mask = np.zeros(request.view.terrain.shape, dtype=bool)
        mask.flat[seen[start : start + _POINTS]] = True
        yield _points(request, errors, mask)


def _points(request: TerrainRequest, errors: ErrorBudget, mask: Mask) -> Points:
    view, radar, prior = request.view, request.radar, request.prior_height_std
    scene = view.scene(mask, mean_motion=request.mean_motion)
    positions = request.relative_positions(scene.times)
    model = phase_model(positions, scene, radar=radar, errors=errors)
    ladder = unwrapping_ladder(model, prior_height_std=prior)
    stated = phase_model(positions, scene, radar=radar, errors=request.errors)
    error = height_error_of(stated, scene=scene, radar=radar, errors=request.errors)
    failure = unwrapping_ladder(stated, prior_height_std=prior).failure
    none = np.zeros((*model.vertical_wavenumber.shape, 0))
    return Points(
        mask=mask,
        target=view.targets(mask),
        height=view.terrain.heights[mask],
        slant_range=scene.slant_range,
        positions=positions,
        scene=scene,
        images=image_model(positions, scene, radar=radar, errors=errors),
        processor=Processor(
            vertical_wavenumber=model.vertical_wavenumber,
            information=model.information,
            factor=np.concatenate([none, *model.nuisance.values()], axis=-1),
            pairs=ladder.pairs,
            prior_height_std=prior,
        ),
        predicted=np.stack([error.total, error.relative, failure]),
        clear=_clear(model.information) & np.isfinite(error.total),
    )


def _clear(information: Array) -> NDArray[np.bool_]:
    own = np.diagonal(information, axis1=-2, axis2=-1)
    return np.asarray(own.min(axis=-1) >= 1.0)


def fly(
    request: TerrainRequest,
    errors: ErrorBudget,
    points: Points,
    *,
    wrongly: SceneErrors,
    prior_error: Array,
    rng: np.random.Generator,
    likely: bool,
) -> Flown:
    """Fly over a chunk once.

    Parameters
    ----------
    request : what is simulated.
    errors : its budget as nature keeps it.
    points : the chunk.
    wrongly : the errors of the scene.
    prior_error : (P,) — of the height known beforehand [m].
    rng : source of random numbers.
    likely : whether heights of maximum likelihood are asked for.
    """
    view, radar, processor = request.view, request.radar, points.processor
    data = _speckle(request, errors, points, rng)
    linked = linked_phases(data, rng=rng)
    noise = along_ladder(linked, pairs=processor.pairs)

    def expected(height: Array) -> Array:
        target = at_range(
            view,
            height,
            points.slant_range + wrongly.slant_range,
            azimuth_error=wrongly.azimuth,
        )
        return path_phase(target, points.positions, radar=radar)

    true = path_phase(points.target, points.positions + wrongly.position, radar=radar)
    true += wrongly.synchronization - wrongly.synchronization[0]
    prior = points.height + prior_error
    at_prior = expected(prior)
    truth = true - at_prior
    wrapped = np.angle(np.exp(1j * (truth + linked)))
    found = bootstrapped(processor, wrapped, truth=truth, noise=noise)

    def error(rise: Array) -> Array:
        """Of prior + rise, after one more step by the exact paths."""
        left = expected(prior + rise) - at_prior - processor.vertical_wavenumber * rise[:, None]
        return np.asarray(prior_error + rise - processor.height(left))

    systematic = error(processor.height(truth))
    heights = np.full(prior.shape, np.nan)
    if likely:
        estimate = likely_heights(processor, wrapped, data=data, true_phase=truth)
        heights = error(estimate.most_likely)
    return Flown(
        noise=processor.height(noise),
        systematic=systematic,
        least_squares=error(processor.height(found.phase)),
        likely=heights,
        wrong=~found.right,
        phase=wrapped,
    )


def common_shift(
    request: TerrainRequest, errors: ErrorBudget, points: Points, draws: dict[str, float]
) -> Array:
    """Height error of what moves heights and no phases, but for the slant range, (P,) [m].

    Parameters
    ----------
    request : what is simulated.
    errors : its budget as nature keeps it.
    points : the chunk.
    draws : source → its error in standard deviations.
    """
    common = common_height_errors(points.scene, radar=request.radar, errors=errors)
    shift = np.zeros(points.height.shape)
    for name, error in common.items():
        shift += draws.get(name, 0.0) * error
    return shift


def coherence_with_first(points: Points) -> Array:
    """Magnitude of the coherence of every image with the first, before filtering, (P, M)."""
    return np.asarray(np.abs(unfiltered_coherence(points.images)[:, 0]))


def _speckle(
    request: TerrainRequest, errors: ErrorBudget, points: Points, rng: np.random.Generator
) -> Complex:
    images, looks = points.images, request.radar.looks
    if errors.baseline_decorrelation is BaselineDecorrelation.UNFILTERED:
        return unfiltered_link_matrices(unfiltered_coherence(images), looks=looks, rng=rng)
    return varied_link_matrices(
        images.range_offset,
        np.broadcast_to(images.amplitude, images.range_offset.shape),
        looks=looks,
        rng=rng,
        doppler_offset=images.doppler_offset,
        pair_factor=images.pair_factor,
    )
