"""Atmospheric height errors against printed values and against rays traced through a layer."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insar.atmosphere import (
    TEC_UNIT,
    Ionosphere,
    ionospheric_gradient_height_error,
    ionospheric_height_error,
    ionospheric_path,
    repeat_pass_path_std,
    tropospheric_height_error,
)

EARTH = 6_371_000.0


def _traced_height(incidence, path_of, *, baseline=300.0, slant_range=600e3):
    """Height by the difference of a path over two rays to one target, by finite difference.

    The satellites lie in the plane of incidence; one is displaced perpendicular to the line of
    sight, along e_h, which lowers the incidence of its ray by B⊥/r.
    """
    other = incidence - baseline / slant_range
    difference = path_of(other) - path_of(incidence)
    # Range difference −B⊥ dθ of a target raised by dh = r sinθ dθ.
    return -difference * slant_range * np.sin(incidence) / baseline


def _pierce(incidence, height):
    """Angle from the vertical and ground distance of the point where a ray meets a shell."""
    angle = np.arcsin(EARTH / (EARTH + height) * np.sin(incidence))
    return angle, (EARTH + height) * (incidence - angle)


@pytest.mark.parametrize(("degrees", "published"), [(30.0, 0.8), (45.0, 2.4)])
def test_uncorrected_troposphere_as_published(degrees, published):
    assert tropospheric_height_error(2.4, incidence=np.deg2rad(degrees)) == pytest.approx(published)


@given(degrees=st.floats(15.0, 60.0))
def test_troposphere_by_two_rays(degrees):
    incidence = np.deg2rad(degrees)
    traced = _traced_height(incidence, lambda angle: 2.4 / np.cos(angle))
    # The finite baseline leaves B⊥/r = 5e-4 of curvature, a few times that at 60°.
    assert tropospheric_height_error(2.4, incidence=incidence) == pytest.approx(traced, rel=5e-3)


@given(degrees=st.floats(15.0, 60.0), height=st.floats(50e3, 500e3))
def test_uniform_ionosphere_by_two_rays(degrees, height):
    incidence = np.deg2rad(degrees)
    zenith = float(ionospheric_path(20 * TEC_UNIT, wavelength=0.24))

    def advance(angle):
        return -zenith / np.cos(_pierce(angle, height)[0])

    computed = ionospheric_height_error(
        20 * TEC_UNIT, wavelength=0.24, incidence=incidence, shell_height=height
    )
    assert computed == pytest.approx(_traced_height(incidence, advance), rel=5e-3)


@given(degrees=st.floats(15.0, 60.0), height=st.floats(50e3, 500e3))
def test_gradient_of_the_ionosphere_by_two_rays(degrees, height):
    incidence = np.deg2rad(degrees)
    gradient = 2.0 * TEC_UNIT / 100e3
    middle = _pierce(incidence, height)[1]

    def advance(angle):
        pierce, towards_nadir = _pierce(angle, height)
        electrons = -gradient * (towards_nadir - middle)  # fewer towards nadir
        # The slant factor of the middle ray: its change is the uniform layer's part.
        del pierce
        return -ionospheric_path(electrons, wavelength=0.24) / np.cos(_pierce(incidence, height)[0])

    computed = ionospheric_gradient_height_error(
        gradient, wavelength=0.24, incidence=incidence, shell_height=height
    )
    assert computed == pytest.approx(_traced_height(incidence, advance), rel=5e-3)


def test_low_shell_is_a_troposphere_of_the_other_sign():
    incidence = np.deg2rad(40.0)
    zenith = float(ionospheric_path(10 * TEC_UNIT, wavelength=0.24))
    ionosphere = ionospheric_height_error(
        10 * TEC_UNIT, wavelength=0.24, incidence=incidence, shell_height=0.0
    )
    assert ionosphere == pytest.approx(-tropospheric_height_error(zenith, incidence=incidence))


def test_ionosphere_falls_with_the_square_of_the_frequency():
    path = ionospheric_path(TEC_UNIT, wavelength=np.array([0.03, 0.24]))
    assert path[1] / path[0] == pytest.approx(64.0)
    # 40.3e16/(1.25 GHz)², the textbook's 0.26 m for a TEC unit at L band.
    assert path[1] == pytest.approx(0.2583, abs=1e-3)


def test_repeat_pass_error_is_another_order():
    path = repeat_pass_path_std(0.01, incidence=0.0)
    assert path * np.sqrt(2.0) * 50.0 / 0.031 == pytest.approx(45.6, abs=0.1)


@pytest.mark.parametrize("name", ["electrons", "gradient", "shell_height"])
def test_impossible_ionosphere_is_refused(name):
    given_values = {"electrons": 1e16, name: -1.0}
    with pytest.raises(ValueError, match=name):
        Ionosphere(**given_values)
