"""The height error as an xarray dataset."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from insar import ErrorBudget, ErrorSource, Radar, Scene, SharedBy, height_error, to_xarray

SCENE = Scene.broadside_strip(
    times=[0.0, 1.0, 2.0], look_angle=0.5, altitude=514e3, earth_radius=6378137.0
)
RADAR = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0, images=((0, 0), (0, 1))
)
ERRORS = ErrorBudget(position=ErrorSource(0.001, SharedBy.SATELLITE))


def error_of(*lead: int):
    positions = np.random.default_rng(1).uniform(-500.0, 500.0, (*lead, 3, 2, 3))
    return height_error(positions, SCENE, radar=RADAR, errors=ERRORS)


def test_dataset_holds_what_the_error_holds_with_its_units():
    error = error_of(4)
    data = to_xarray(error, SCENE)
    assert dict(data.sizes) == {"design": 4, "segment": 3, "source": 3}
    assert_array_equal(data.total_error, error.total)
    assert_array_equal(data.region_error, error.region)
    squares = (data.error_contribution**2).sum("source")
    np.testing.assert_allclose(squares, error.total**2, rtol=1e-12)
    for name in ("total_error", "relative_error", "error_contribution", "region_error"):
        assert data[name].attrs["units"] == "m"
    units = {name: data[name].attrs["units"] for name in ("time", "slant_range", "look_angle")}
    assert units == {"time": "s", "slant_range": "m", "look_angle": "rad"}
    assert_array_equal(data.incidence_angle, SCENE.incidence)
    assert data.total_error.attrs["standard_name"].endswith(" standard_error")


def test_selection_by_source_and_by_geometry():
    data = to_xarray(error_of(), SCENE)
    assert data.error_contribution.sel(source="position").dims == ("segment",)
    assert float(data.total_error.where(data.time > 1.5, drop=True).segment[0]) == 3.0


def test_what_is_not_measured_is_missing_and_says_why():
    error = height_error(np.zeros((3, 2, 3)), SCENE, radar=RADAR, errors=ERRORS)
    data = to_xarray(error, SCENE)
    assert np.all(np.isnan(data.total_error))
    meanings = dict(
        zip(
            data.status.attrs["flag_values"].tolist(),
            data.status.attrs["flag_meanings"].split(),
            strict=True,
        )
    )
    assert {meanings[int(value)] for value in data.status} == {"no_baseline"}


def test_names_of_leading_dimensions():
    assert to_xarray(error_of(2, 5), SCENE).total_error.dims == ("design_0", "design_1", "segment")
    named = to_xarray(error_of(2, 5), SCENE, lead=("beam", "baseline"))
    assert named.total_error.dims == ("beam", "baseline", "segment")
    for lead in (("beam",), ("beam", "beam"), ("beam", "segment")):
        with pytest.raises(ValueError, match="must be 2 different names"):
            to_xarray(error_of(2, 5), SCENE, lead=lead)


def test_scene_of_another_length_is_refused():
    with pytest.raises(ValueError, match=r"needs \(\.\.\., 1\)"):
        to_xarray(
            error_of(),
            Scene.broadside_strip(
                times=[0.0], look_angle=0.5, altitude=514e3, earth_radius=6378137.0
            ),
        )


def test_without_xarray_the_message_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"pip install 'formation-opt\[xarray\]'"):
        to_xarray(error_of(), SCENE)
