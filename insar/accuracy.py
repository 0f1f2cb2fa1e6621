"""Relative and absolute height error, by the scales of the errors and what calibration leaves.

Definitions, those of the elevation-model community (HRTI, DTED):

- *absolute*: error of a height against the datum, everything counted that calibration leaves; as
  LE90 it is the bound that 90 % of heights keep.
- *relative*: error of the difference of two heights of one cell (1° × 1°, about 100 km). Random
  errors of the two points add; what both have in common drops out, so that of an error of a whole
  scene only its tilt remains. If the cell is wider than the swath, the two points may belong to
  different scenes and share nothing that is not the same over both.

Both are of the worst pair: opposite edges of the swath, or different data takes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .acquisitions import combine_acquisitions
from .calibration import area_variance, calibrated_covariance
from .errors import ErrorBudget
from .height import common_height_errors, height_error_of, shared_height_responses
from .image_model import pair_coherence
from .phase_model import PhaseModel, phase_model
from .point_to_point import point_to_point_factor
from .radar import Radar
from .scale import Scale
from .scene import Scene
from .statistics.quick import quick_difference_quantile
from .swath import across_swath

Array = NDArray[np.float64]

NORMAL_90 = 1.6448536269514722
"""90 % of normal errors are below this many standard deviations."""


@dataclass(frozen=True, kw_only=True)
class Cell:
    """Where two points may lie whose heights are compared.

    Parameters
    ----------
    size : scalar — extent of the cell; a degree of latitude is 111 km, and 100 km is customary
        [m].
    swath : scalar — extent across track of a scene on the ground [m].
    """

    size: float = 100e3
    swath: float = 30e3

    def __post_init__(self) -> None:
        for name in ("size", "swath"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and positive")

    @property
    def crosses_scenes(self) -> bool:
        """Whether two points of the cell may belong to different scenes."""
        return self.size > self.swath


class SystematicError(NamedTuple):
    """What one source does to a whole scene.

    Attributes
    ----------
    scale : how far it stays the same.
    covariance : (..., S, 3, 3) — of offset [m], tilt across and tilt along track [m/m].
    removed : whether the calibration adjusts it.
    """

    scale: Scale
    covariance: Array
    removed: bool

    @property
    def offset(self) -> Array:
        """Standard deviation in the middle of the swath, before any calibration, (..., S) [m]."""
        return np.sqrt(self.covariance[..., 0, 0])

    @property
    def tilt(self) -> Array:
        """Standard deviation of the tilt across the swath, before any calibration [m/m]."""
        return np.sqrt(self.covariance[..., 1, 1])


@dataclass(frozen=True, eq=False, kw_only=True)
class HeightAccuracy:
    """Height error of one or more formations, relative and absolute.

    Attributes
    ----------
    cell : what the relative error refers to.
    random : (..., S) — standard deviation from pixel to pixel, of one point [m].
    random_pair_90 : (..., S) — bound of 90 % of the differences of two points by it alone [m].
    sources : what every other source does to a scene, before calibration.
    residual : (..., S, 3, 3) — covariance of offset and tilts after the calibration, of the
        sources that it adjusts; None without one.
    relative, absolute : (..., S) — standard deviations [m]; `inf` where no height is measured.
    relative_90, absolute_90 : (..., S) — bounds of 90 % of the errors [m].
    """

    cell: Cell
    random: Array
    random_pair_90: Array
    sources: dict[str, SystematicError]
    residual: Array | None
    relative: Array
    absolute: Array
    relative_90: Array
    absolute_90: Array

    def systematic(self, scale: Scale, *, removed: bool | None = None) -> Array:
        """Error of all sources of a scale over the swath, before calibration, (..., S) [m].

        Parameters
        ----------
        scale : the scale; the pixel has no systematic error.
        removed : count only those that the calibration adjusts (or does not); None counts all.
        """
        return np.sqrt(
            sum(
                (
                    area_variance(source.covariance, swath=self.cell.swath, length=0.0)
                    for source in self.sources.values()
                    if source.scale is scale and removed in (None, source.removed)
                ),
                start=np.zeros_like(self.random),
            )
        )


def height_accuracy(
    positions: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    errors: ErrorBudget,
    cell: Cell | None = None,
    combined: bool = False,
) -> HeightAccuracy:
    """Relative and absolute height error of a formation, after the budget's calibration.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments, in the middle of the swath.
    radar, errors : the radar, and the budget with its calibration.
    cell : what the relative error refers to; by default 100 km and a swath of 30 km.
    combined : whether the first axis of the positions counts acquisitions of the same scene, with
        errors of their own, that are combined to one height (`combine_acquisitions`); it is then
        not an axis of the result.

    Returns
    -------
    HeightAccuracy — of (..., S) arrays.

    Raises
    ------
    ValueError
        If the shape of the positions does not fit, or the swath reaches nadir or the horizon.

    Notes
    -----
    Offset and tilt of each source are not formulas for two satellites: the estimate is evaluated at
    the middle and both edges of the swath, and the errors of the same source at different places
    are correlated as they are: fully, except a position error, of which û sees another component
    (û₁·û₂). At the edges the weights are those of their own geometry. For two satellites and a
    baseline perpendicular to the line of sight this is h = y δB∥/B⊥ (`calibration.baseline_tilt`).
    What is left of the swath's curvature is neglected (a millimeter for 1 mm over 30 km).

    At 90 %, systematic errors are normal and count 1.645 standard deviations. Phase noise is not:
    it counts the exact quantile of the difference of two multilook phases (`point_to_point_factor`,
    within 1e-3), and 1/√2 of that for one point. Bounds of independent parts add as squares: exact
    where one part dominates or all are normal, else within 3 %.
    """
    cell = Cell() if cell is None else cell
    scenes = _swath_scenes(scene, cell)
    models = {
        place: _model(positions, where, radar, errors, combined=combined)
        for place, where in scenes.items()
    }
    middle = height_error_of(models[0], scene=scene, radar=radar, errors=errors)
    responses = {
        place: _responses(model, scenes[place], radar, errors) for place, model in models.items()
    }
    calibration = errors.calibration
    sources: dict[str, SystematicError] = {}
    for name, scale in models[0].scale.items():
        if scale is Scale.PIXEL or name not in middle.terms:
            continue
        if name in responses[0]:
            tilt = (responses[1][name] - responses[-1][name]) / cell.swath
            covariance = _covariance(responses[0][name], tilt)
        else:  # independent from pair to pair: its sign at the edges is anybody's guess
            term = middle.terms[name][..., None]
            covariance = _covariance(term, np.zeros_like(term))
        removed = calibration is not None and calibration.removes(scale)
        sources[name] = SystematicError(scale, covariance, removed)
    factor = _pair_factor(positions, models[0], scene, radar, errors, combined=combined)
    return _combine(sources, middle.relative, factor, np.isfinite(middle.total), errors, cell)


def _model(
    positions: ArrayLike, scene: Scene, radar: Radar, errors: ErrorBudget, *, combined: bool
) -> PhaseModel:
    if not combined:
        return phase_model(positions, scene, radar=radar, errors=errors)
    return combine_acquisitions(
        [phase_model(one, scene, radar=radar, errors=errors) for one in np.asarray(positions)]
    )


def _pair_factor(
    positions: ArrayLike,
    model: PhaseModel,
    scene: Scene,
    radar: Radar,
    errors: ErrorBudget,
    *,
    combined: bool,
) -> Array:
    """Bound of 90 % of the differences of two random errors, over the deviation of one."""
    if errors.phase_std is not None:  # given, as a normal deviation
        return np.full(model.vertical_wavenumber.shape[:-1], math.sqrt(2.0) * NORMAL_90)
    coherence, looks = pair_coherence(positions, scene, radar=radar, errors=errors)
    pairs = radar.image_pairs
    if combined:  # the pairs of each acquisition, their images numbered through
        count, others = len(np.asarray(positions)), len(radar.images) - 1
        shift = others * np.arange(count)[:, None, None]
        pairs = np.where(pairs > 0, pairs + shift, 0).reshape(-1, 2)
        coherence, looks = (np.concatenate(list(value), axis=-1) for value in (coherence, looks))
    return point_to_point_factor(
        model,
        coherence=coherence,
        looks=looks,
        pairs=pairs,
        phase_statistics=errors.phase_statistics,
        quantile=quick_difference_quantile,
    )


def _swath_scenes(scene: Scene, cell: Cell) -> dict[int, Scene]:
    """The near edge (−1), the middle (0) and the far edge (1) of the swath."""
    half = cell.swath / 2.0
    return {-1: across_swath(scene, -half), 0: scene, 1: across_swath(scene, half)}


def _responses(
    model: PhaseModel, scene: Scene, radar: Radar, errors: ErrorBudget
) -> dict[str, Array]:
    """Height by unit independent errors that are the same at every place: (..., S, R)."""
    shared = shared_height_responses(model)
    if "position" in shared:
        # û·δp: three components for each, of which every line of sight takes its own.
        split = shared["position"][..., None] * scene.line_of_sight[:, None, :]
        shared["position"] = split.reshape(*split.shape[:-2], -1)
    common = common_height_errors(scene, radar=radar, errors=errors)
    batch = model.vertical_wavenumber.shape[:-1]
    return shared | {
        name: np.broadcast_to(error, batch)[..., None] for name, error in common.items()
    }


def _covariance(offset: Array, tilt: Array) -> Array:
    """Covariance of offset, tilt across and tilt along, of unit independent errors."""
    parameters = np.stack([offset, tilt, np.zeros_like(tilt)], axis=-2)
    return np.asarray(parameters @ np.swapaxes(parameters, -1, -2))


def _combine(
    sources: dict[str, SystematicError],
    random: Array,
    pair_factor: Array,
    measured: NDArray[np.bool_],
    errors: ErrorBudget,
    cell: Cell,
) -> HeightAccuracy:
    nothing = np.zeros((*random.shape, 3, 3))
    left: dict[Scale, Array] = dict.fromkeys(Scale, nothing)
    adjusted = nothing
    for source in sources.values():
        if source.removed:
            adjusted = adjusted + source.covariance
        else:
            left[source.scale] = left[source.scale] + source.covariance
    calibration, residual, bias = errors.calibration, None, 0.0
    if calibration is not None:
        noise = np.where(measured, random, np.nan)
        residual = calibrated_covariance(adjusted, calibration, noise_std=noise)
        left[calibration.over] = left[calibration.over] + residual
        bias = calibration.bias

    everything = sum(left.values(), start=nothing)
    absolute = area_variance(everything, swath=cell.swath, length=0.0) + bias**2
    # Two points at the edges of one swath: the offset is common, and the tilt parts them.
    relative = everything[..., 1, 1] * min(cell.size, cell.swath) ** 2
    if cell.crosses_scenes:
        apart = sum((left[scale] for scale in (Scale.SCENE, Scale.DATA_TAKE)), start=nothing)
        common = sum((left[scale] for scale in (Scale.ORBIT, Scale.MISSION)), start=nothing)
        between = 2.0 * area_variance(apart, swath=cell.swath, length=0.0)
        relative = np.maximum(relative, between + common[..., 1, 1] * cell.swath**2)

    def finished(value: Array) -> Array:
        return np.where(measured & np.isfinite(value), value, np.inf)

    pair = math.sqrt(2.0) * random
    return HeightAccuracy(
        cell=cell,
        random=random,
        random_pair_90=finished(pair_factor * random),
        sources=sources,
        residual=residual,
        relative=finished(np.hypot(pair, np.sqrt(relative))),
        absolute=finished(np.hypot(random, np.sqrt(absolute))),
        relative_90=finished(np.hypot(pair_factor * random, NORMAL_90 * np.sqrt(relative))),
        absolute_90=finished(
            np.hypot(pair_factor / math.sqrt(2.0) * random, NORMAL_90 * np.sqrt(absolute))
        ),
    )
