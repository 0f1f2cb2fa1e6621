"""Offset and tilts of a height model, and what an adjustment to control points leaves of them.

An error of the baseline, of the synchronization or of the atmosphere does not scatter heights; it
shifts and tilts a whole data take: h(x, y) = h₀ + a y + b x with y across and x along track, from
the middle. Control points or altimeter tracks of known height tell the three numbers, as well as
their count and accuracy allow.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .scale import Scale

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """A least-squares adjustment of offset and tilts to a regular grid of known heights.

    Parameters
    ----------
    swath, length : scalar — extent across and along track of what one adjustment covers [m].
    spacing_across, spacing_along : scalar — of the control points; of altimeter tracks the
        distance between tracks, and between independent shots along them [m].
    accuracy : scalar — standard deviation of a control height, independent from point to point,
        with what the comparison itself adds (footprint, vegetation, interpolation) [m].
    bias : scalar — standard deviation of an error that all control heights share [m].
    over : what one adjustment is for. Errors that stay the same over all of it are removed, those
        of a shorter scale stay.

    Raises
    ------
    ValueError
        If a number is not positive (accuracy and bias: negative), no control point falls into the
        area, or `over` is the pixel.
    """

    swath: float
    length: float
    spacing_across: float
    spacing_along: float
    accuracy: float
    bias: float = 0.0
    over: Scale = Scale.SCENE

    def __post_init__(self) -> None:
        for name in ("swath", "length", "spacing_across", "spacing_along"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and positive")
        for name in ("accuracy", "bias"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f"{name} = {value!r} must be finite and not negative")
        for spacing, extent in (("spacing_across", "swath"), ("spacing_along", "length")):
            if getattr(self, spacing) > getattr(self, extent):
                raise ValueError(
                    f"{spacing} = {getattr(self, spacing)!r} m exceeds the {extent} of "
                    f"{getattr(self, extent)!r} m: no control point need fall into it"
                )
        if self.over is Scale.PIXEL:
            raise ValueError("over = 'pixel': a calibration is of a scene at least")

    @property
    def count(self) -> float:
        """Control points of one adjustment; need not be whole, as a mean over many areas."""
        return self.swath / self.spacing_across * self.length / self.spacing_along

    def removes(self, scale: Scale) -> bool:
        """Whether errors of a scale are the same for everything that one adjustment covers."""
        return scale.covers(self.over)

    def normal_matrix(self) -> Array:
        """Normal matrix of offset, tilt across and tilt along, for points of unit accuracy.

        Returns
        -------
        (3, 3) — n diag(1, (w² − s_y²)/12, (l² − s_x²)/12) for a grid that is centered in the area,
        w and l its extents, s the spacings and n = wl/(s_y s_x) the count [1, m², m²]: the sum
        over the points where the counts are whole, and a smooth function of the spacing between.
        One line of points alone tells no tilt across it.
        """
        across = (self.swath**2 - self.spacing_across**2) / 12.0
        along = (self.length**2 - self.spacing_along**2) / 12.0
        return np.diag([1.0, across, along]) * self.count

    def points(self) -> Array:
        """Places of the control points, (n, 2): across and along track from the middle [m]."""
        counts = (self.swath / self.spacing_across, self.length / self.spacing_along)
        y, x = (
            spacing * (np.arange(round(count)) - (round(count) - 1) / 2.0)
            for spacing, count in zip(
                (self.spacing_across, self.spacing_along), counts, strict=True
            )
        )
        grid = np.meshgrid(y, x, indexing="ij")
        return np.stack([axis.ravel() for axis in grid], axis=-1)


def calibrated_covariance(
    prior: ArrayLike, calibration: Calibration, *, noise_std: ArrayLike = 0.0
) -> Array:
    """Covariance of offset and tilts after the adjustment.

    Parameters
    ----------
    prior : (..., 3, 3) — covariance of offset [m], tilt across and tilt along [m/m] before it,
        from the error budget; may be singular.
    calibration : the control points.
    noise_std : (...) — random error of the heights that are compared, beside the accuracy of the
        control itself [m].

    Returns
    -------
    (..., 3, 3) — (I + PM)⁻¹P with M = GᵀG/(σ_c² + σ_n²): the least-squares adjustment with the
    budget as prior information, never worse than no adjustment, and the ordinary one, M⁻¹, where
    the budget is loose. The bias of the control is not in it.

    Raises
    ------
    ValueError
        If control and heights are both without error, where nothing would be left.
    """
    covariance = np.asarray(prior, dtype=np.float64)
    variance = calibration.accuracy**2 + np.asarray(noise_std, dtype=np.float64) ** 2
    if np.any(variance == 0.0):
        raise ValueError(
            "accuracy = 0 and heights without noise: an adjustment to perfect control leaves "
            "nothing; state the accuracy of the control points"
        )
    # Tilts are 1e-6, extents 1e5: scaled to edge heights the matrices are well conditioned.
    scale = np.array([1.0, 2.0 / calibration.swath, 2.0 / calibration.length])
    normal = calibration.normal_matrix() * np.outer(scale, scale) / variance[..., None, None]
    scaled = covariance / np.outer(scale, scale)
    posterior = np.linalg.solve(np.eye(3) + scaled @ normal, scaled)
    return np.asarray(0.5 * (posterior + np.swapaxes(posterior, -1, -2)) * np.outer(scale, scale))


def area_variance(covariance: ArrayLike, *, swath: float, length: float) -> Array:
    """Height variance by offset and tilts, mean over an area.

    Parameters
    ----------
    covariance : (..., 3, 3) — of offset [m], tilt across and tilt along [m/m].
    swath, length : scalar — extent of the area across and along track, about its middle [m].

    Returns
    -------
    (...) — P₀₀ + P₁₁ swath²/12 + P₂₂ length²/12 [m²]; at the corners the tilts count threefold.
    """
    matrix = np.asarray(covariance, dtype=np.float64)
    tilts = matrix[..., 1, 1] * swath**2 + matrix[..., 2, 2] * length**2
    return np.asarray(matrix[..., 0, 0] + tilts / 12.0)


def baseline_tilt(baseline_error: ArrayLike, *, perpendicular_baseline: ArrayLike) -> Array:
    """Tilt across track that an error of the baseline parallel to the line of sight draws.

    Parameters
    ----------
    baseline_error : (...) — δB∥, along the line of sight [m].
    perpendicular_baseline : (...) — B⊥ of the pair [m].

    Returns
    -------
    (...) — δB∥/B⊥ [m/m]. The heights turn about the track: on a flat Earth and for a baseline
        perpendicular to the line of sight h = y δB∥/B⊥, y from nadir.

    References
    ----------
    González et al. 2010, doi:10.1109/TGRS.2009.2034980.

    Examples
    --------
    1 mm at 260 m, in mm/km:

    >>> print((1e6 * baseline_tilt(1e-3, perpendicular_baseline=260.0)).round(2))
    3.85
    """
    return np.asarray(baseline_error) / np.asarray(perpendicular_baseline, dtype=np.float64)


def baseline_offset(
    baseline_error: ArrayLike,
    *,
    height_of_ambiguity: ArrayLike,
    wavelength: float,
    multiplicity: float = 1.0,
) -> Array:
    """Height offset by an error of the baseline parallel to the line of sight.

    Parameters
    ----------
    baseline_error : (...) — δB∥ [m].
    height_of_ambiguity : (...) — of the pair [m].
    wavelength : scalar — of the carrier [m].
    multiplicity : scalar — how often the pair counts its baseline, 1 or 2.

    Returns
    -------
    (...) — m HoA δB∥/λ [m].

    References
    ----------
    Krieger et al. 2007, doi:10.1109/TGRS.2007.900693.

    Examples
    --------
    1 mm at a height of ambiguity of 35 m:

    >>> print(baseline_offset(1e-3, height_of_ambiguity=35.0, wavelength=0.0311).round(2))
    1.13
    """
    error = np.asarray(baseline_error, dtype=np.float64)
    return np.asarray(multiplicity * np.asarray(height_of_ambiguity) * error / wavelength)


def synchronization_height_error(
    phase_error: ArrayLike, *, height_of_ambiguity: ArrayLike
) -> Array:
    """Height error by a residual phase between transmitter and receiver of a bistatic pair.

    Parameters
    ----------
    phase_error : (...) — residual phase [rad].
    height_of_ambiguity : (...) — of the pair [m].

    Returns
    -------
    (...) — HoA δφ/2π [m].

    Examples
    --------
    1° at 45 m:

    >>> print(synchronization_height_error(np.deg2rad(1.0), height_of_ambiguity=45.0).round(3))
    0.125
    """
    phase = np.asarray(phase_error, dtype=np.float64)
    return np.asarray(np.asarray(height_of_ambiguity) * phase / (2.0 * np.pi))
