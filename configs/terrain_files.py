"""Reads elevation models: Matplotlib's sample, NumPy files, GeoTIFF."""

from __future__ import annotations

import io
import math
import zipfile
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar.terrain import Terrain

from .files import InputFile
from .messages import BuildError, KeyPath, printable, show
from .terrain import CropBlock, TerrainBlock

Array = NDArray[np.float64]

MAX_POINTS = 4_000_000
"""Points of the largest terrain that is simulated: minutes, and about 4 GB."""

_AT: KeyPath = ("terrain",)
_SAMPLE = "mpl-data/sample_data/jacksboro_fault_dem.npz"
_PROJECTED, _GEOGRAPHIC = 1, 2


class _Raster(NamedTuple):
    """Heights and the distance of rows and of columns [m], if it is known."""

    heights: Array
    posting: tuple[float, float] | None


def build_terrain(block: TerrainBlock) -> Terrain:
    """Read the terrain of a study.

    Parameters
    ----------
    block : of the study.

    Raises
    ------
    BuildError
        If a file is no elevation model, or its posting is not known.
    """
    raster = _sample() if block.file is None else _from_file(block, block.file)
    posting = raster.posting
    if block.posting_m is not None:
        given = block.posting_m
        posting = given if isinstance(given, tuple) else (given, given)
    if posting is None:
        raise BuildError(
            (*_AT, "file"),
            "does not say how far apart its rows and columns are; add posting_m",
        )
    heights = _cropped(raster.heights, block.crop)
    if heights.size > MAX_POINTS:
        raise BuildError(
            _AT, f"has {heights.size} points, more than {MAX_POINTS}; cut it down with crop"
        )
    try:
        return Terrain(heights=heights, posting_north=posting[0], posting_east=posting[1])
    except ValueError as error:
        raise BuildError((*_AT, "file" if block.file else "sample"), f"{error}") from None


def _cropped(heights: Array, crop: CropBlock | None) -> Array:
    if crop is None:
        return heights
    for axis, key in enumerate(("rows", "columns")):
        ends = getattr(crop, key)
        if ends is None:
            continue
        if ends[1] > heights.shape[axis]:
            raise BuildError(
                (*_AT, "crop", key),
                f"ends beyond the terrain, which has {heights.shape[axis]} {key}; end it there",
            )
        heights = np.take(heights, np.arange(*ends), axis=axis)
    return heights


def _sample() -> _Raster:
    """The Jacksboro fault: 3 arc seconds; its ymin and ymax are swapped, so neither is used.

    Matplotlib's own example draws its first row at the top and its north there too.
    """
    spec = find_spec("matplotlib")  # found, not imported
    if spec is None or not spec.submodule_search_locations:
        raise BuildError((*_AT, "sample"), "needs Matplotlib, which is not installed; install it")
    path = Path(spec.submodule_search_locations[0]) / _SAMPLE
    try:
        with np.load(path) as data:
            heights = np.asarray(data["elevation"], dtype=np.float64)
            step = math.radians(float(data["dy"])), math.radians(float(data["dx"]))
            latitude = math.radians(0.5 * float(data["ymin"] + data["ymax"]))
    except (OSError, KeyError, ValueError) as error:
        raise BuildError(
            (*_AT, "sample"),
            f"cannot be read from this Matplotlib ({printable(str(error))}); name a file instead",
        ) from None
    return _Raster(heights, _on_sphere(step, latitude))


def _on_sphere(step: tuple[float, float], latitude: float) -> tuple[float, float]:
    """Meters of steps in latitude and longitude [rad]."""
    radius = EARTH_EQUATORIAL_RADIUS
    return step[0] * radius, step[1] * radius * math.cos(latitude)


def _from_file(block: TerrainBlock, file: InputFile) -> _Raster:
    suffix = Path(file.name).suffix.lower()
    if suffix in (".tif", ".tiff"):
        return _geotiff(file)
    if suffix not in (".npy", ".npz"):
        raise BuildError(
            (*_AT, "file"), "is no .tif, .npy or .npz file; save the heights as one of them"
        )
    try:
        loaded: Any = np.load(io.BytesIO(file.content), allow_pickle=False)
        heights = loaded if isinstance(loaded, np.ndarray) else _named(block, loaded)
    except (ValueError, OSError, EOFError, zipfile.BadZipFile) as error:
        raise BuildError(
            (*_AT, "file"),
            f"cannot be read as a NumPy file ({printable(str(error))}); save it with numpy.save",
        ) from None
    return _Raster(_numbers(heights), None)


def _named(block: TerrainBlock, arrays: Any) -> Any:
    names = [str(name) for name in arrays.files]
    two_dimensional = [name for name in names if arrays[name].ndim == 2]
    name = block.array
    if name is None and len(two_dimensional) == 1:
        name = two_dimensional[0]
    if name not in names:
        raise BuildError(
            (*_AT, "array"),
            f"must name the heights among the arrays of the file: {', '.join(map(show, names))}; "
            "add or correct it",
        )
    return arrays[name]


def _numbers(heights: Any) -> Array:
    values = np.asarray(heights)
    if values.ndim != 2 or values.dtype.kind not in "iuf":
        raise BuildError(
            (*_AT, "file"),
            f"holds {values.dtype} numbers of shape {values.shape}; a terrain is a grid of "
            "heights, rows from north to south",
        )
    return values.astype(np.float64)


def _geotiff(file: InputFile) -> _Raster:
    try:
        import tifffile
    except ImportError:
        raise BuildError(
            (*_AT, "file"),
            "is a GeoTIFF, which needs the package tifffile; install it: pip install "
            "'formation-opt[geotiff]', or save the heights with numpy.save",
        ) from None
    try:
        with tifffile.TiffFile(io.BytesIO(file.content)) as tiff:
            page: Any = tiff.pages[0]
            heights = _numbers(page.asarray())
            keys = dict(page.geotiff_tags or {})
            nodata = page.tags.get("GDAL_NODATA")
    except BuildError:
        raise
    except Exception as error:  # what a broken file makes a reader raise is not to be foreseen
        raise BuildError(
            (*_AT, "file"),
            f"cannot be read as a GeoTIFF ({printable(str(error))}); save it uncompressed, or with "
            "deflate",
        ) from None
    if nodata is not None:
        heights[heights == float(nodata.value)] = np.nan
    return _Raster(heights, _geotiff_posting(keys, heights.shape[0]))


def _geotiff_posting(keys: dict[str, Any], rows: int) -> tuple[float, float] | None:
    """Distance of rows and columns; None where the file is not placed on the Earth."""
    scale, tie = keys.get("ModelPixelScale"), keys.get("ModelTiepoint")
    kind = int(keys.get("GTModelTypeGeoKey", 0))
    if scale is None:
        return None
    east, north = float(scale[0]), float(scale[1])
    if kind == _GEOGRAPHIC and tie is not None:
        latitude = float(tie[4]) + north * (float(tie[1]) - 0.5 * rows)
        return _on_sphere((math.radians(north), math.radians(east)), math.radians(latitude))
    return (north, east) if kind == _PROJECTED else None
