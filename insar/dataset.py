"""The height error as an xarray dataset, with coordinates and units for other programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .height import HeightError, HeightStatus
from .scene import Scene

if TYPE_CHECKING:
    from xarray import Dataset

_STANDARD_NAME = "height_above_reference_ellipsoid standard_error"
"""CF: the standard name of the quantity, with the modifier of its standard error."""


def to_xarray(error: HeightError, scene: Scene, *, lead: Sequence[str] | None = None) -> Dataset:
    """Height error with the geometry of its scene, as a dataset of named dimensions.

    Parameters
    ----------
    error : of (..., S) arrays.
    scene : the S segments that it was computed for.
    lead : names of the leading dimensions; ``design`` for one, ``design_0``, ``design_1``, … for
        several, where None.

    Returns
    -------
    xarray.Dataset — dimensions: the leading ones, ``segment`` and ``source``. Variables with CF
    attributes: ``total_error`` and ``relative_error`` [m], ``error_contribution`` of each source
    [m], ``region_error`` over the segments [m], and ``status`` with its flags. Coordinates of the
    segments: ``time`` [s], ``slant_range`` [m], ``look_angle``, ``azimuth``, ``incidence_angle``
    and ``terrain_slope`` [rad]. An error where no height is measured is NaN, as netCDF has it, and
    ``status`` says why.

    Raises
    ------
    ImportError
        If xarray is not installed.
    ValueError
        If the scene does not fit, or the names do not fit the leading dimensions.

    Examples
    --------
    >>> scene = Scene.broadside_strip(
    ...     times=[0.0, 1.0], look_angle=0.4, altitude=514e3, earth_radius=6378137.0
    ... )
    >>> error = HeightError(
    ...     total=np.array([1.0, 2.0]),
    ...     relative=np.array([0.5, 0.6]),
    ...     terms={"phase": np.array([0.5, 0.6]), "range": np.array([0.8, 1.9])},
    ...     status=np.zeros(2, dtype=np.int8),
    ... )
    >>> data = to_xarray(error, scene)
    >>> data.total_error.attrs["units"], dict(data.sizes)
    ('m', {'segment': 2, 'source': 2})
    """
    try:
        import xarray as xr
    except ImportError as missing:
        raise ImportError(
            "xarray is not installed; it comes with the extra: pip install 'formation-opt[xarray]'"
        ) from missing
    shape = error.total.shape
    if not shape or shape[-1] != len(scene):
        raise ValueError(
            f"the height error has shape {shape}; a scene of {len(scene)} segments needs (..., "
            f"{len(scene)})"
        )
    dims = (*_leading(shape[:-1], lead), "segment")
    sources = list(error.terms)
    contributions = np.stack([error.terms[name] for name in sources], axis=-1)
    flags = [status.value for status in HeightStatus]
    return xr.Dataset(
        {
            "total_error": (dims, _finite(error.total), _meters("total height error")),
            "relative_error": (
                dims,
                _finite(error.relative),
                _meters("height error that varies from pixel to pixel"),
            ),
            "error_contribution": (
                (*dims, "source"),
                _finite(contributions),
                {"long_name": "contribution to the total height error", "units": "m"},
            ),
            "region_error": (
                dims[:-1],
                _finite(np.asarray(error.region)),
                _meters("total height error over the scene")
                | {"cell_methods": "segment: root_mean_square"},
            ),
            "status": (
                dims,
                np.asarray(error.status),
                {
                    "long_name": "why a height is measured, or not",
                    "flag_values": np.array(flags, dtype=np.int8),
                    "flag_meanings": " ".join(one.name.lower() for one in HeightStatus),
                },
            ),
        },
        coords=_coordinates(scene) | {"source": ("source", sources)},
        attrs={"Conventions": "CF-1.11", "title": "Standard deviation of the height measured"},
    )


def _leading(shape: tuple[int, ...], lead: Sequence[str] | None) -> tuple[str, ...]:
    if lead is None:
        several = len(shape) > 1
        return tuple(f"design_{index}" if several else "design" for index in range(len(shape)))
    if len(lead) != len(shape) or len(set(lead) | {"segment", "source"}) != len(shape) + 2:
        raise ValueError(
            f"lead = {list(lead)!r} must be {len(shape)} different names, none of them 'segment' "
            "or 'source'"
        )
    return tuple(lead)


def _finite(values: Any) -> Any:
    return np.where(np.isfinite(values), values, np.nan)


def _meters(long_name: str) -> dict[str, Any]:
    return {"long_name": long_name, "standard_name": _STANDARD_NAME, "units": "m"}


def _coordinates(scene: Scene) -> dict[str, Any]:
    columns = {
        "time": (scene.times, "time since the epoch of the states", "s"),
        "slant_range": (scene.slant_range, "distance to the target", "m"),
        "look_angle": (scene.look_angle, "angle of the line of sight from nadir", "rad"),
        "azimuth": (
            scene.azimuth,
            "angle of the line of sight about nadir, from along track to the left",
            "rad",
        ),
        "incidence_angle": (scene.incidence, "angle of incidence at the target", "rad"),
        "terrain_slope": (scene.slope, "slope in range, positive towards the radar", "rad"),
    }
    found = {
        name: ("segment", np.asarray(values), {"long_name": text, "units": unit})
        for name, (values, text, unit) in columns.items()
    }
    return {"segment": ("segment", np.arange(1, len(scene) + 1))} | found
