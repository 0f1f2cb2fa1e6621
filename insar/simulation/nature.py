"""What is really there in one segment: images that hang together, and errors that they share.

A study may count on things that nature does not offer (pairs that are measured apart, baselines
that cost no coherence). The simulation never does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import (
    BaselineDecorrelation,
    ErrorBudget,
    HeldConstant,
    Scale,
    SharedBy,
    Weighting,
)
from ..height import common_height_errors
from ..image_model import image_model, segment_cells
from ..phase_model import phase_model
from ..radar import Radar
from ..scene import Scene
from .speckle import Speckle

Array = NDArray[np.float64]


class NaturalErrors(NamedTuple):
    """An error budget that nature can keep.

    Attributes
    ----------
    errors : the budget.
    departures : where it differs from the study's, in words.
    """

    errors: ErrorBudget
    departures: tuple[str, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class Nature:
    """One segment as it is simulated, for M images.

    Attributes
    ----------
    vertical_wavenumber : (M,) — kz, relative to the first image [rad/m].
    speckle : how the images hang together.
    scene_factor : (M, R) — what unit errors that stay the same over the scene, or longer, do to the
        phases, relative to the first image [rad].
    pixel_factor : (M, R) — likewise of errors that are drawn anew for each pixel [rad].
    scene_height_std : scalar — of errors that move the height and no phase (slant range,
        atmosphere) and stay the same over the scene, or longer [m].
    pixel_height_std : scalar — of those that are drawn anew for each pixel [m].
    information : (M, M) — by which the estimators weigh the phases; nothing is drawn from it
        [1/rad²].
    further : speckle of further acquisitions, which share the first image as their reference; see
        `combining`.
    """

    vertical_wavenumber: Array
    speckle: Speckle
    scene_factor: Array
    pixel_factor: Array
    scene_height_std: float
    pixel_height_std: float
    information: Array
    further: tuple[Speckle, ...] = ()

    @property
    def factor(self) -> Array:
        """Factor of all shared errors, (M, R) [rad]."""
        return np.concatenate([self.scene_factor, self.pixel_factor], axis=-1)


def natural_errors(errors: ErrorBudget) -> NaturalErrors:
    """Replace what nature does not offer by what it does.

    Parameters
    ----------
    errors : the budget of a study.

    Returns
    -------
    NaturalErrors — the same budget, and no departures, if it is natural.
    """
    departures = []
    changes: dict[str, object] = {}
    physical = {
        "position": SharedBy.SATELLITE,
        "azimuth": SharedBy.ALL,
        "synchronization": SharedBy.IMAGE,
    }
    for name, owner in physical.items():
        source = getattr(errors, name)
        if source.shared_by is SharedBy.PAIR:
            changes[name] = source._replace(shared_by=owner)
            if source.std > 0.0:
                departures.append(f"the {name} error is drawn once for each {_owner(owner)}")
    if errors.weighting is Weighting.PAIRS:
        changes |= {"weighting": Weighting.JOINT, "phase_std": None}
        departures.append("phases are those of speckle in images, not of pairs measured apart")
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        changes["baseline_decorrelation"] = BaselineDecorrelation.FILTERED
        departures.append("images share only the common part of their bands")
    if errors.held_constant is HeldConstant.AZIMUTH:
        changes["held_constant"] = HeldConstant.DOPPLER
        departures.append("height is sensed at constant range and Doppler")
    return NaturalErrors(replace(errors, **changes), tuple(departures))  # type: ignore[arg-type]


def segment_nature(
    positions: ArrayLike, scene: Scene, *, segment: int, radar: Radar, errors: ErrorBudget
) -> Nature:
    """What is simulated in one segment.

    Parameters
    ----------
    positions : (S, N, 3) — RTN positions at the scene's times [m].
    scene : the S segments.
    segment : index of the segment.
    radar : the radar and its M images.
    errors : a natural budget.
    """
    model = phase_model(positions, scene, radar=radar, errors=errors)
    images = image_model(positions, scene, radar=radar, errors=errors)
    coherence, cells = segment_cells(images, segment, errors=errors)
    count = len(radar.images)
    none = np.zeros((count, 0))
    lasting, own = [none], [none]
    for name, factor in model.nuisance.items():
        (own if model.scale[name] is Scale.PIXEL else lasting).append(factor[segment])
    moved = {True: 0.0, False: 0.0}
    for name, error in common_height_errors(scene, radar=radar, errors=errors).items():
        moved[model.scale[name] is Scale.PIXEL] += float(error[segment]) ** 2
    return Nature(
        vertical_wavenumber=model.vertical_wavenumber[segment],
        speckle=Speckle(coherence, cells, radar.looks),
        scene_factor=np.concatenate(lasting, axis=-1),
        pixel_factor=np.concatenate(own, axis=-1),
        scene_height_std=math.sqrt(moved[False]),
        pixel_height_std=math.sqrt(moved[True]),
        information=model.information[segment],
    )


def _owner(shared_by: SharedBy) -> str:
    return "scene and all images" if shared_by is SharedBy.ALL else str(shared_by)
