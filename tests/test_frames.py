"""Time scales, the Earth's orientation, and celestial and terrestrial frames."""

from __future__ import annotations

import tomllib
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import astropy_iers_data
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from skyfield.api import load
from skyfield.data import iers
from skyfield.framelib import itrs
from skyfield.timelib import Timescale

from formation import Coverage, States, orientation_coverage, orientation_span
from formation.earth_orientation import earth_orientation
from formation.frames import (
    gcrs_to_itrs,
    sidereal_angle,
    teme_to_gcrs,
    teme_to_itrs,
    true_of_date_to_gcrs,
    true_of_epoch_to_gcrs,
)
from formation.timescales import moments, seconds_between

LOW, GEOSTATIONARY = 6.9e6, 42.164e6
YEAR = 365.25 * 86_400.0
dates = st.datetimes(datetime(1975, 1, 1), datetime(2035, 1, 1), timezones=st.just(UTC))


@pytest.fixture(scope="module")
def published() -> dict[str, Any]:
    path = Path(__file__).parent / "published" / "orbits.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def skyfield_time() -> Timescale:
    """Skyfield with the same table of IERS, read by its own parser."""
    with Path(astropy_iers_data.IERS_A_FILE).open("rb") as file:
        finals = iers.parse_x_y_dut1_from_finals_all(file)
    arrays = iers.build_timescale_arrays(finals["utc_mjd"], finals["dut1"])
    scale = Timescale((arrays[0], arrays[1]), arrays[2], arrays[3])
    iers.install_polar_motion_table(scale, finals)
    return scale


def states(rng: np.random.Generator, shape: tuple[int, ...] = (), radius: float = LOW) -> States:
    vector = rng.normal(size=(2, *shape, 3))
    unit = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return States(radius * unit[0], 7.5e3 * unit[1])


# -- time ----------------------------------------------------------------------------------------


def test_leap_second_counts():
    before = datetime(2016, 12, 31, 23, 59, 59, tzinfo=UTC)
    assert seconds_between(before, before + timedelta(seconds=1)) == pytest.approx(2.0, abs=1e-9)
    assert seconds_between(before, before - timedelta(days=1)) == pytest.approx(-86_400, abs=1e-9)


def test_time_zones_are_understood():
    utc = datetime(2026, 3, 1, 12, tzinfo=UTC)
    elsewhere = utc.astimezone(timezone(timedelta(hours=5, minutes=30)))
    assert moments(utc) == moments(elsewhere)


def test_epoch_without_time_zone_is_refused():
    with pytest.raises(ValueError, match=r"2026-03-01T12:00:00 has no time zone; give UTC.*00Z"):
        moments(datetime(2026, 3, 1, 12))


def test_epoch_before_modern_utc_is_refused():
    with pytest.raises(ValueError, match="before 1972"):
        moments(datetime(1971, 12, 31, tzinfo=UTC))


def test_a_microsecond_survives_a_century():
    at = moments(datetime(2026, 3, 1, tzinfo=UTC), [3e9, 3e9 + 1e-6])
    assert np.diff(at.fraction)[0] * 86_400 == pytest.approx(1e-6, rel=0.5)


# -- orientation of the Earth --------------------------------------------------------------------


def test_orientation_is_that_of_the_daily_table():
    # finals2000A of 2004 April 6, 0h UTC: x, y in arcseconds and UT1 - UTC in seconds. Issues of
    # the table differ by 0.1 mas and 10 µs, which is 4 mm on the ground.
    at = moments(datetime(2004, 4, 6, tzinfo=UTC))
    orientation = earth_orientation(at)
    arcsecond = np.pi / 648_000
    assert orientation.ut1_minus_tai + 32.0 == pytest.approx(-0.4399, abs=2e-4)
    assert orientation.pole_x == pytest.approx(-0.1407 * arcsecond, abs=1e-3 * arcsecond)
    assert orientation.pole_y == pytest.approx(0.3333 * arcsecond, abs=2e-3 * arcsecond)


def test_orientation_is_continuous_over_a_leap_second():
    at = moments(datetime(2016, 12, 31, 12, tzinfo=UTC), np.arange(0.0, 86_400.0, 100.0))
    # The excess of the day is about 1 ms: 1.2e-8 s per second.
    assert np.abs(np.diff(earth_orientation(at).ut1_minus_tai)).max() < 2e-6


def test_last_values_are_held_beyond_the_table():
    span = orientation_span()
    at = moments(span.last_predicted, [0.0, 86_400.0, 10 * YEAR])
    values = earth_orientation(at)
    for value in (values.ut1_minus_tai, values.pole_x, values.pole_y):
        # The first lies in the table, within a minute of its end: UT1 runs off by 1 µs.
        assert_allclose(value, value[0], rtol=0, atol=1e-6)
    assert_array_equal(values.ut1_rate[1:], 0.0)


def test_coverage():
    span, day = orientation_span(), timedelta(days=1)
    assert span.first < span.last_measured < span.last_predicted
    assert orientation_coverage(span.first, span.last_measured) is Coverage.MEASURED
    assert orientation_coverage(span.first, span.last_measured + day) is Coverage.PREDICTED
    assert orientation_coverage(span.first, span.last_predicted + day) is Coverage.HELD
    assert orientation_coverage(span.first - day, span.last_measured) is Coverage.HELD


# -- frames --------------------------------------------------------------------------------------


def test_sofa_matrix(published):
    row = published["gcrs_to_itrs"]
    turn = gcrs_to_itrs(moments(datetime.fromisoformat(row["epoch"])))
    # 0.3 mas of left-out corrections to the celestial pole is 1.4e-9, and later issues of the table
    # moved the Earth's pole by as much; 5e-9 is 3 cm at a low orbit.
    assert_allclose(turn.matrix, row["matrix"], rtol=0, atol=5e-9)


@pytest.mark.parametrize(
    ("turn", "frame", "tolerance"),
    # They take UT1 of 0h for the whole day; eight hours later it has moved on by 0.5 ms, 0.3 m. On
    # the way to the GCRF that cancels, and what is left is 0.1 mas of the theories: 4 mm.
    [(teme_to_itrs, "itrf", 0.35), (teme_to_gcrs, "gcrf", 4e-3)],
)
def test_teme_of_vallado(published, turn, frame, tolerance):
    row = published["teme_to_itrf"]
    at = moments(datetime.fromisoformat(row["epoch"]))
    teme = States(
        np.array(row["teme_position_km"]) * 1e3, np.array(row["teme_velocity_km_s"]) * 1e3
    )
    found = turn(at).apply(teme)
    position, velocity = (
        np.array(row[f"{frame}_{key}"]) * 1e3 for key in ("position_km", "velocity_km_s")
    )
    assert_allclose(found.position, position, rtol=0, atol=tolerance)
    assert_allclose(found.velocity, velocity, rtol=0, atol=3e-4)


@pytest.mark.parametrize("year", [1980, 1999, 2016, 2026])
def test_earth_fixed_states_of_skyfield(skyfield_time, year):
    rng = np.random.default_rng(year)
    epoch = datetime(year, 7, 1, tzinfo=UTC)
    days = np.sort(rng.uniform(0.0, 100.0, 20))
    theirs = skyfield_time.utc(year, 7, 1, 0, 0, days * 86_400.0)
    matrix = np.moveaxis(itrs.rotation_at(theirs), -1, 0)
    ours = gcrs_to_itrs(moments(epoch, days * 86_400.0)).matrix
    # Skyfield draws straight lines between daily values of UT1: 50 µs of time, 2 cm.
    assert np.linalg.norm(ours - matrix, ord=2, axis=(-2, -1)).max() * LOW < 0.04


def test_true_equator_and_sidereal_time_of_skyfield():
    epoch = datetime(2026, 3, 1, 6, tzinfo=UTC)
    theirs = load.timescale(builtin=True).utc(2026, 3, 1, 6)
    assert_allclose(true_of_epoch_to_gcrs(epoch).T, theirs.M, atol=1e-9)  # 7 mm
    # Their table is of another date; UT1 predicted a year ahead may be off by 10 ms.
    assert sidereal_angle(epoch) == pytest.approx(theirs.gast * np.pi / 12, abs=1e-6)


@given(dates, st.integers(0, 2**32 - 1))
def test_velocity_is_the_derivative_of_position(epoch, seed):
    rng = np.random.default_rng(seed)
    start = states(rng, radius=GEOSTATIONARY)
    step = 4.0
    times = step * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    moving = States(
        start.position + times[:, None] * start.velocity, np.tile(start.velocity, (5, 1))
    )
    for frame in (gcrs_to_itrs, teme_to_itrs, teme_to_gcrs, true_of_date_to_gcrs):
        found = frame(moments(epoch, times)).apply(moving)
        p = found.position
        difference = (8.0 * (p[3] - p[1]) - (p[4] - p[0])) / (12.0 * step)
        # Rounding of the Earth's rotation angle, 1e-14 rad, is 0.4 µm at this radius.
        assert_allclose(found.velocity[2], difference, rtol=0, atol=1e-6)


@given(dates, st.integers(0, 2**32 - 1))
def test_turns_keep_lengths_and_come_back(epoch, seed):
    rng = np.random.default_rng(seed)
    start = states(rng, (3,))
    at = moments(epoch, rng.uniform(0.0, YEAR, 3))
    turn = gcrs_to_itrs(at)
    there = turn.apply(start)
    back = turn.inverse().apply(there)
    # Splines of the celestial pole are orthogonal to their own accuracy.
    assert_allclose(np.linalg.norm(there.position, axis=-1), LOW, rtol=0, atol=1e-5)
    assert_allclose(back.position, start.position, rtol=0, atol=2e-5)
    assert_allclose(back.velocity, start.velocity, rtol=0, atol=2e-8)


def test_splines_agree_with_the_series():
    import erfa

    rng = np.random.default_rng(3)
    at = moments(datetime(2026, 1, 1, tzinfo=UTC), np.sort(rng.uniform(0.0, YEAR, 300)))
    days = at.fraction + 32.184 / 86_400.0
    direct = erfa.pnm06a(2_400_000.5 + at.day, days)
    splined = true_of_date_to_gcrs(at).inverse().matrix
    assert np.abs(splined - direct).max() * GEOSTATIONARY < 1e-4


def test_a_moment_does_not_depend_on_its_company():
    epoch = datetime(2026, 3, 1, tzinfo=UTC)
    times = np.linspace(0.0, 100 * 86_400.0, 7)
    together = gcrs_to_itrs(moments(epoch, times)).matrix
    alone = np.stack([gcrs_to_itrs(moments(epoch, time)).matrix for time in times])
    assert_array_equal(together, alone)


def test_shapes_broadcast():
    at = moments(datetime(2026, 3, 1, tzinfo=UTC), np.zeros((4, 2)))
    turn = gcrs_to_itrs(at)
    assert turn.matrix.shape == turn.rate.shape == (4, 2, 3, 3)
    found = turn.apply(states(np.random.default_rng(1), (4, 2)))
    assert found.position.shape == found.velocity.shape == (4, 2, 3)
