"""The multi-baseline weighted-least-squares height error."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .atmosphere import (
    ionospheric_gradient_height_error,
    ionospheric_height_error,
    tropospheric_height_error,
)
from .errors import ErrorBudget, Scale
from .phase_model import PhaseModel, phase_model
from .radar import Radar
from .scene import Scene

Array = NDArray[np.float64]

_NO_WAVENUMBER = 1e-15
"""Vertical wavenumber that counts as none [rad/m]: a picometer of baseline at 500 km."""

_NO_INFORMATION = 1e-60
"""Height information that counts as none [1/m²], far from overflow when inverted and squared."""


class HeightStatus(IntEnum):
    """Why a height error is finite, or why it is not."""

    MEASURED = 0
    NO_BASELINE = 1
    NO_COHERENCE = 2

    @property
    def reason(self) -> str:
        """The status in words."""
        return {
            HeightStatus.MEASURED: "the height is measured",
            HeightStatus.NO_BASELINE: "no pair has a perpendicular baseline",
            HeightStatus.NO_COHERENCE: "no pair with a perpendicular baseline is coherent",
        }[self]


@dataclass(frozen=True, eq=False)
class HeightError:
    """Standard deviation of the estimated height, per design and segment.

    Attributes
    ----------
    total : (..., S) — every error counted [m]; `inf` where no height is measured.
    relative : (..., S) — the part that varies from pixel to pixel [m].
    terms : source → (..., S) — contribution of each source at the total's optimal weights [m];
        their squares sum to the square of the total.
    status : (..., S) — a `HeightStatus` each.
    """

    total: Array
    relative: Array
    terms: dict[str, Array]
    status: NDArray[np.int8]

    @property
    def region(self) -> Array:
        """Total error of the region: (...), RMS over the segments [m]. Li 2009 eq. (8)."""
        return _rms(self.total)

    @property
    def relative_region(self) -> Array:
        """Relative error of the region: (...), RMS over the segments [m]."""
        return _rms(self.relative)

    @property
    def region_terms(self) -> dict[str, Array]:
        """Contribution of each source to `region`: (...), RMS over the segments [m]."""
        return {name: _rms(term) for name, term in self.terms.items()}


def height_error(
    positions: ArrayLike, scene: Scene, *, radar: Radar, errors: ErrorBudget
) -> HeightError:
    """Height error of a formation, or of a whole population of them.

    Parameters
    ----------
    positions : (..., S, N, 3) — RTN positions of the satellites at the scene's times [m].
    scene : the S segments.
    radar : the radar and its images.
    errors : the error budget.

    Returns
    -------
    HeightError — of (..., S) arrays.

    Raises
    ------
    ValueError
        If the shape of the positions does not fit the scene and the images.

    Notes
    -----
    The variance of the best linear unbiased estimate, e² = 1/J + cos²θ_inc σ_r² (and the squares of
    the other `common_height_errors`), with the
    information J = kzᵀ(X⁻¹ + FFᵀ)⁻¹kz of the phases (noise X⁻¹, shared errors FFᵀ) in the form
    kzᵀ(X − XF(I + FᵀXF)⁻¹FᵀX)kz, which needs no inverse of X: images without a common band, and
    a zero baseline, are no special case. Li 2009 eqs (5)-(7) state the same estimate with an
    explicit R⁻¹ of the pairs' height errors. Valid while the phase noise is small (Cramér-Rao) and
    the phase is unwrapped rightly: see `unwrapping_probability`.

    Examples
    --------
    >>> import numpy as np
    >>> scene = Scene.broadside_strip(
    ...     times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6378137.0
    ... )
    >>> radar = Radar(wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0,
    ...               images=((0, 0), (0, 1)))
    >>> positions = np.array([[[0.0, 0.0, 0.0], [100.0, 0.0, 300.0]]])  # (S, N, 3) RTN [m]
    >>> height_error(positions, scene, radar=radar, errors=ErrorBudget()).total.round(3)
    array([0.334])
    """
    model = phase_model(positions, scene, radar=radar, errors=errors)
    return height_error_of(model, scene=scene, radar=radar, errors=errors)


def height_error_of(
    model: PhaseModel, *, scene: Scene, radar: Radar, errors: ErrorBudget
) -> HeightError:
    """Height error of a phase model that is already built.

    Parameters
    ----------
    model : the phase model of the designs.
    scene, radar, errors : what the model was built from.

    Returns
    -------
    HeightError — of (..., S) arrays.
    """
    kz = model.vertical_wavenumber
    residual, shared = _residual_and_amplitudes(model)
    # J = kzᵀX(kz − Fa) as the sum of what each source leaves, (kz − Fa)ᵀX(kz − Fa) + aᵀa: the same
    # number, without the cancellation where shared errors exceed the noise by far.
    variance = _noise_variances(model, residual, radar)
    variance |= {name: np.sum(part**2, axis=-1) for name, part in shared.items()}
    fisher = sum(variance.values(), start=np.zeros(()))

    status = np.where(
        np.max(np.abs(kz), axis=-1) < _NO_WAVENUMBER,
        HeightStatus.NO_BASELINE,
        np.where(fisher < _NO_INFORMATION, HeightStatus.NO_COHERENCE, HeightStatus.MEASURED),
    ).astype(np.int8)
    measured = status == HeightStatus.MEASURED
    inverse = 1.0 / np.where(measured, fisher, 1.0)

    squared = {
        name: np.where(measured, value * inverse**2, np.inf) for name, value in variance.items()
    }
    common = common_height_errors(scene, radar=radar, errors=errors)
    squared |= {name: np.broadcast_to(error**2, fisher.shape) for name, error in common.items()}
    shifts = sum((error**2 for error in common.values()), start=np.zeros(len(scene)))
    total = np.where(measured, inverse + shifts, np.inf)
    relative = sum(
        (value for name, value in squared.items() if model.scale[name] is Scale.PIXEL),
        start=np.zeros_like(total),
    )
    return HeightError(
        total=np.sqrt(total),
        relative=np.sqrt(relative),
        terms={name: np.sqrt(value) for name, value in squared.items()},
        status=status,
    )


def common_height_errors(scene: Scene, *, radar: Radar, errors: ErrorBudget) -> dict[str, Array]:
    """Errors that move the height directly, whatever the formation.

    Parameters
    ----------
    scene : the S segments.
    radar : the radar.
    errors : the error budget.

    Returns
    -------
    source → (S,) — height by one standard deviation of the source, signed [m]: always ``range``;
    ``troposphere``, ``ionosphere`` and ``ionosphere_gradient`` where the budget has them. Their
    squares add to 1/J.
    """
    # A target moved along û at a fixed direction rises by û·up = −cos θ_inc.
    rise = np.sum(scene.line_of_sight * scene.vertical, axis=-1)
    common = {"range": np.asarray(rise * errors.range.std)}
    if errors.troposphere.std > 0.0:
        common["troposphere"] = tropospheric_height_error(
            errors.troposphere.std, incidence=scene.incidence
        )
    ionosphere = errors.ionosphere
    if ionosphere is not None:
        wavelength, shell = radar.wavelength, ionosphere.shell_height
        if ionosphere.electrons > 0.0:
            common["ionosphere"] = ionospheric_height_error(
                ionosphere.electrons,
                wavelength=wavelength,
                incidence=scene.incidence,
                shell_height=shell,
            )
        if ionosphere.gradient > 0.0:
            common["ionosphere_gradient"] = ionospheric_gradient_height_error(
                ionosphere.gradient,
                wavelength=wavelength,
                incidence=scene.incidence,
                shell_height=shell,
            )
    return common


def shared_height_responses(model: PhaseModel) -> dict[str, Array]:
    """Height by one standard deviation of each error that images share, at the total's weights.

    Parameters
    ----------
    model : the phase model of the designs.

    Returns
    -------
    source → (..., S, R) — dh/dε_s, signed [m], of the R independent components of the source;
    NaN where no height is measured. The root of the sum of squares is `HeightError.terms`, and
    the signs tell how the errors of two points are correlated.
    """
    residual, shared = _residual_and_amplitudes(model)
    noise = np.sum(residual * _product(model.information, residual), axis=-1)
    fisher = sum((np.sum(part**2, axis=-1) for part in shared.values()), start=noise)
    inverse = 1.0 / np.where(fisher < _NO_INFORMATION, np.nan, fisher)
    return {name: part * inverse[..., None] for name, part in shared.items()}


def _residual_and_amplitudes(model: PhaseModel) -> tuple[Array, dict[str, Array]]:
    """Solve for kz − Fa and, source by source, a = (I + FᵀXF)⁻¹FᵀXkz."""
    kz, information = model.vertical_wavenumber, model.information
    sources = list(model.nuisance)
    if not sources:
        return kz, {}
    factor = np.concatenate([model.nuisance[name] for name in sources], axis=-1)
    transposed = np.swapaxes(factor, -1, -2)
    normal = transposed @ (information @ factor)
    index = np.arange(factor.shape[-1])
    normal[..., index, index] += 1.0
    weighted = _product(transposed, _product(information, kz))
    amplitude = np.linalg.solve(normal, weighted[..., None])[..., 0]
    splits = np.cumsum([model.nuisance[name].shape[-1] for name in sources])[:-1]
    shared = dict(zip(sources, np.split(amplitude, splits, axis=-1), strict=True))
    return kz - _product(factor, amplitude), shared


def _noise_variances(model: PhaseModel, residual: Array, radar: Radar) -> dict[str, Array]:
    """Contributions, times J², of the errors inside the information matrix."""
    if not model.pair_variance:
        product = _product(model.information, residual)
        # Rounding can leave a tiny negative number where shared errors dominate by far.
        return {"phase": np.maximum(np.sum(residual * product, axis=-1), 0.0)}
    first, second = radar.image_pairs.T
    weight = 1.0 / sum(model.pair_variance.values(), start=np.zeros(()))
    scaled = weight * (residual[..., second] - residual[..., first])
    return {
        # A pair without information has weight 0 and variance inf: its product is 0, not NaN.
        name: np.sum(scaled**2 * np.where(weight > 0.0, value, 0.0), axis=-1)
        for name, value in model.pair_variance.items()
    }


def _product(matrix: Array, vector: Array) -> Array:
    product: Array = (matrix @ vector[..., None])[..., 0]
    return product


def _rms(values: Array) -> Array:
    mean_square: Array = np.mean(values**2, axis=-1)
    return np.sqrt(mean_square)
