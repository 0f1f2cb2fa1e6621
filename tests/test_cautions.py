"""What a user is warned of in scenes from orbits and in studies of steering."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from formation import KeplerianOrbit
from insar import LookSide
from insar.observe import FixedLook, Law, SteeringCase, assess_case
from insar.observe.scenes.cautions import cautions
from insar.observe.scenes.observing import observe
from insar.observe.scenes.targets import Targets
from insar.observe.studies.cautions import cautions as steering_cautions


@pytest.fixture(scope="module")
def observation():
    orbit = KeplerianOrbit.circular(
        altitude=514e3, inclination=np.radians(97.44), epoch=datetime(2024, 6, 21, tzinfo=UTC)
    )
    target = Targets.from_points(latitude=np.radians(37.75), longitude=np.radians(15.0))
    return observe(orbit, target, wavelength=0.031, side=LookSide.RIGHT, stop=5 * 86400.0)


def test_a_measured_pass_over_all_targets_of_a_circular_orbit_needs_no_warning(observation):
    assert cautions(observation) == ()


def test_targets_left_out_are_counted(observation):
    partial = replace(observation, missed_reasons=("too far", "too near"))
    assert cautions(partial)[0].startswith("The pass sees 1 of 3 targets")


def test_an_eccentric_orbit_is_named_with_its_cost(observation):
    (text,) = cautions(replace(observation, eccentricity=0.02))
    assert "0.02" in text
    assert "6 % of their size" in text


def test_a_date_beyond_the_table_of_the_earth_s_rotation(observation):
    later = timedelta(days=20 * 365)
    moved = {name: getattr(observation, name) + later for name in ("epoch", "orbit_epoch")}
    (text,) = cautions(replace(observation, **moved))
    assert "ground track may be off" in text
    assert "astropy-iers-data" in text


@pytest.mark.parametrize(
    ("source", "days", "text"),
    [
        (
            "two-line elements of SENTINEL-1A (39634)",
            20,
            "The pass is 20 days after the epoch of the two-line elements of SENTINEL-1A (39634): "
            "the satellite may be 20 to 60 km from there along its orbit, and more if it "
            "maneuvers. Take elements of a date nearer to the pass.",
        ),
        (
            "two-line elements of satellite 39634",
            -15,
            "The pass is 15 days before the epoch of the two-line elements of satellite 39634: the "
            "satellite may be 15 to 45 km from there along its orbit, and more if it maneuvers. "
            "Take elements of a date nearer to the pass.",
        ),
        (
            "osculating elements, two bodies",
            400,
            "The pass is 400 days after the epoch of the osculating elements, two bodies: drag is "
            "left out, so that a low satellite will be elsewhere on its orbit, and on another "
            "pass, unless it is kept on station. Give elements of a date nearer to the pass.",
        ),
        ("two-line elements of satellite 39634", 13, None),
        ("mean elements with J2", 300, None),
        ("ephemeris of X", 3000, None),
    ],
)
def test_elements_of_another_date_are_named_with_their_age(observation, source, days, text):
    epoch = observation.epoch - timedelta(days=days)
    aged = replace(observation, orbit_source=source, orbit_epoch=epoch)
    assert cautions(aged) == (() if text is None else (text,))


def test_an_observation_says_where_its_orbit_comes_from(observation):
    assert observation.orbit_source == "mean elements with J2"
    assert observation.orbit_epoch == datetime(2024, 6, 21, tzinfo=UTC)


def steered(*, altitude, inclination, look_deg, laws):
    orbit = KeplerianOrbit.circular(
        altitude=altitude,
        inclination=np.radians(inclination),
        epoch=datetime(2024, 6, 21, tzinfo=UTC),
        j2=False,
    )
    return assess_case(
        SteeringCase(
            name="case",
            trajectory=orbit,
            times=np.linspace(0.0, 86164.0, 25),
            wavelength=0.031,
            side=LookSide.RIGHT,
            boresight=FixedLook(np.radians(look_deg)),
            laws=laws,
            swath_offsets=np.array([0.0]),
        )
    )


def test_a_low_orbit_that_is_solved_everywhere_needs_no_warning():
    case = steered(altitude=514e3, inclination=97.4, look_deg=30, laws=(Law.YAW_PITCH,))
    assert steering_cautions([case]) == ()


def test_a_beam_that_misses_the_earth_is_named():
    case = steered(altitude=35786e3, inclination=30.0, look_deg=9.0, laws=(Law.NONE,))
    (text,) = steering_cautions([case])
    assert text.startswith("case: none has a solution on 0 % of the orbit only")
    assert "misses the Earth" in text


def test_a_satellite_that_stands_above_the_equator_has_no_direction_of_zero_doppler():
    case = steered(altitude=35786.0e3, inclination=0.0, look_deg=5.0, laws=(Law.YAW,))
    (text,) = steering_cautions([case])
    assert "direction of zero Doppler" in text
