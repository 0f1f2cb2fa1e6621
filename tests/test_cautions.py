"""What a user is warned of when a scene comes from an orbit."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from formation import KeplerianOrbit
from insar import LookSide
from insar.observe.scenes.cautions import cautions
from insar.observe.scenes.observing import observe
from insar.observe.scenes.targets import Targets


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
    assert "2 % of their size" in text


def test_a_date_beyond_the_table_of_the_earth_s_rotation(observation):
    (text,) = cautions(replace(observation, epoch=observation.epoch + timedelta(days=20 * 365)))
    assert "ground track may be off" in text
    assert "astropy-iers-data" in text
