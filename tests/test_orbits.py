"""Keplerian elements, the Earth's flattening, two-line elements, the reference orbit."""

from __future__ import annotations

import math
import tomllib
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import astropy_iers_data
import erfa
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from skyfield.api import EarthSatellite
from skyfield.data import iers
from skyfield.framelib import itrs
from skyfield.timelib import Timescale

from formation import (
    ElementKind,
    Elements,
    KeplerianOrbit,
    Orbit,
    States,
    TwoLineOrbit,
    elements_from_states,
    mean_elements_at,
    raan_from_local_time,
    raan_from_longitude,
    reference_orbit,
    states_from_elements,
)
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
    EARTH_J2,
)
from formation.elements import eccentric_anomaly
from formation.frames import gcrs_to_itrs, teme_to_gcrs
from formation.j2 import drifted, mean_elements, osculating_states, secular_rates
from formation.timescales import moments

EPOCH = datetime(2026, 3, 1, tzinfo=UTC)
DAY = 86_400.0
LINES = (
    "1 25544U 98067A   19343.69339541  .00001764  00000-0  38792-4 0  9991",
    "2 25544  51.6439 211.2001 0007417  17.6667  85.6398 15.50103472202482",
)

angles = st.floats(0.0, 2.0 * math.pi, exclude_max=True)


@pytest.fixture(scope="module")
def published() -> dict[str, Any]:
    path = Path(__file__).parent / "published" / "orbits.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))


def integrate(states: States, times: np.ndarray, *, j2: float = EARTH_J2) -> States:
    """Motion in the field of a flattened Earth, step by step."""

    def acceleration(_: float, y: np.ndarray) -> np.ndarray:
        position = y[:3]
        r = np.linalg.norm(position)
        central = -EARTH_GRAVITATIONAL_PARAMETER / r**3
        k = 1.5 * j2 * (EARTH_EQUATORIAL_RADIUS / r) ** 2
        z2 = 5.0 * (position[2] / r) ** 2
        return np.concatenate([y[3:], central * position * (1.0 - k * (z2 - [1.0, 1.0, 3.0]))])

    start = np.concatenate([states.position, states.velocity])
    solution = solve_ivp(
        acceleration, (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-6
    )
    return States(solution.y[:3].T, solution.y[3:].T)


def distance(one: States, other: States) -> float:
    return float(np.linalg.norm(one.position - other.position, axis=-1).max())


# -- elements ------------------------------------------------------------------------------------


def test_elements_of_vallado(published):
    row = published["elements"]
    found = elements_from_states(
        States(np.array(row["position_km"]) * 1e3, np.array(row["velocity_km_s"]) * 1e3)
    )
    # Half a unit of the last digit of the velocity is 25 m of this long axis.
    assert found.semi_major_axis == pytest.approx(row["semi_major_axis_km"] * 1e3, abs=25.0)
    assert found.eccentricity == pytest.approx(row["eccentricity"], abs=1e-6)
    for name in ("inclination", "raan", "argument_of_perigee"):
        degrees = np.rad2deg(getattr(found, name))
        assert degrees == pytest.approx(row[f"{name}_deg"], abs=0.006)
    eccentric = eccentric_anomaly(found.mean_anomaly, found.eccentricity)
    ratio = math.sqrt((1.0 + found.eccentricity) / (1.0 - found.eccentricity))
    true = 2.0 * math.atan(ratio * math.tan(eccentric / 2.0))
    assert math.degrees(true) == pytest.approx(row["true_anomaly_deg"], abs=6e-4)


@given(
    e=st.floats(0.0, 0.99),
    i=st.floats(0.0, math.pi),
    raan=angles,
    perigee=angles,
    mean=angles,
)
def test_elements_come_back_as_the_same_state(e, i, raan, perigee, mean):
    start = states_from_elements(Elements(7e6 / (1.0 - e), e, i, raan, perigee, mean))
    back = states_from_elements(elements_from_states(start))
    # Rounding of 1e-16 grows by 1/(1 − e)² near the end of a long ellipse.
    growth = 1.0 / (1.0 - e) ** 2
    assert_allclose(back.position, start.position, rtol=0, atol=2e-7 * growth)
    assert_allclose(back.velocity, start.velocity, rtol=0, atol=2e-10 * growth)


@given(e=st.floats(0.0, 0.9999), mean=st.floats(-50.0, 50.0))
def test_kepler_equation_is_solved_to_rounding(e, mean):
    eccentric = eccentric_anomaly(mean, e)
    assert eccentric - e * np.sin(eccentric) == pytest.approx(mean, abs=2e-14)


def test_circle_over_the_equator_has_elements():
    found = elements_from_states(States(np.array([0.0, 7e6, 0.0]), np.array([-7546.05, 0.0, 0.0])))
    assert found.inclination == 0.0
    latitude = found.argument_of_perigee + found.mean_anomaly + found.raan
    assert math.remainder(float(latitude) - math.pi / 2, 2 * math.pi) == pytest.approx(0, abs=1e-5)


def test_hyperbola_has_no_elements():
    found = elements_from_states(States(np.array([7e6, 0.0, 0.0]), np.array([0.0, 12e3, 0.0])))
    assert np.isnan(found.semi_major_axis)
    assert np.isnan(found.eccentricity)
    assert np.isnan(found.mean_anomaly)


def test_elements_broadcast():
    states = states_from_elements(Elements(7e6, np.zeros((4, 1)), 1.0, 0.0, 0.0, np.zeros(3)))
    assert states.position.shape == (4, 3, 3)
    assert elements_from_states(states).inclination.shape == (4, 3)


# -- the flattening ------------------------------------------------------------------------------

POLAR, SUN_SYNCHRONOUS, CRITICAL, NEAR_EQUATORIAL = 90.0, 97.44, 63.4349, 5.0
ORBITS = [
    (e, i)
    for e in (0.0, 0.001, 0.1, 0.3)
    for i in (POLAR, SUN_SYNCHRONOUS, CRITICAL, NEAR_EQUATORIAL, 0.0)
]


def low_orbit(e: float, inclination_deg: float) -> Elements:
    """Perigee at a height of 600 km, where the flattening is felt most."""
    axis = (EARTH_EQUATORIAL_RADIUS + 600e3) / (1.0 - e)
    return Elements(axis, e, np.deg2rad(inclination_deg), 1.0, 0.7, 0.4)


@pytest.mark.parametrize(("e", "inclination"), ORBITS)
def test_mean_elements_follow_the_integrated_orbit(e, inclination):
    mean = low_orbit(e, inclination)
    times = np.linspace(0.0, DAY, 1000)
    exact = integrate(osculating_states(mean), times)
    # J2² of the radius is 8 m; near the equator its factors add up to some 25 m, and the elements
    # of a nearly equatorial circle to 45 m after a day. First order alone would give 0.3 to 6 km.
    tolerance = 15.0 if inclination > 10.0 else 50.0
    assert distance(osculating_states(drifted(mean, times)), exact) < tolerance


@pytest.mark.parametrize(("e", "inclination"), ORBITS)
def test_mean_elements_hardly_change_along_an_integrated_orbit(e, inclination):
    start = osculating_states(low_orbit(e, inclination))
    along = integrate(start, np.linspace(0.0, 6000.0, 200))
    found = mean_elements(along)
    # From kilometers (osculating) to what is left at second order.
    assert np.ptp(found.semi_major_axis) < 0.02
    assert np.ptp(found.eccentricity) * 7e6 < 40.0
    assert np.ptp(found.inclination) * 7e6 < 15.0
    if inclination > 60.0:
        assert np.ptp(elements_from_states(along).semi_major_axis) > 15e3


@given(
    e=st.floats(0.0, 0.3),
    i=st.floats(0.0, math.pi),
    perigee=angles,
    mean=angles,
)
def test_mean_and_osculating_are_inverse(e, i, perigee, mean):
    start = osculating_states(Elements(7e6 / (1.0 - e), e, i, 1.0, perigee, mean))
    back = osculating_states(mean_elements(start))
    assert_allclose(back.position, start.position, rtol=0, atol=1e-6)
    assert_allclose(back.velocity, start.velocity, rtol=0, atol=1e-9)


def test_apsides_turn_as_known():
    # A figure of the trade: there, the relative e-vector turns by −3.478° in a day.
    mean = Elements(EARTH_EQUATORIAL_RADIUS + 514.8e3, 0.0, np.deg2rad(97.44), 0.0, 0.0, 0.0)
    rates = secular_rates(mean)
    assert np.rad2deg(rates.argument_of_perigee) * DAY == pytest.approx(-3.478, abs=0.01)


@pytest.mark.parametrize(("e", "inclination"), [(0.03, 97.44), (0.1, 30.0), (0.3, 120.0)])
def test_rates_are_derivatives_of_the_energy(e, inclination):
    """Hamilton's equations in Delaunay's variables L, G, H."""
    mean = low_orbit(e, inclination)
    root = math.sqrt(EARTH_GRAVITATIONAL_PARAMETER * mean.semi_major_axis)
    delaunay = root * np.array(
        [1.0, math.sqrt(1.0 - e * e), math.sqrt(1.0 - e * e) * math.cos(mean.inclination)]
    )

    def energy(large: float, middle: float, small: float) -> float:
        shape = math.sqrt(1.0 - (middle / large) ** 2), math.acos(small / middle)
        axis = large**2 / EARTH_GRAVITATIONAL_PARAMETER
        position, velocity = osculating_states(Elements(axis, *shape, 1.0, 0.7, 0.4))
        r = np.linalg.norm(position)
        oblate = 0.5 * EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / r) ** 2
        potential = 1.0 - oblate * (3.0 * (position[2] / r) ** 2 - 1.0)
        return velocity @ velocity / 2.0 - EARTH_GRAVITATIONAL_PARAMETER / r * potential

    step = 1e-5 * root * np.eye(3)
    found = [
        (energy(*(delaunay + each)) - energy(*(delaunay - each))) / (2.0 * each.max())
        for each in step
    ]
    rates = secular_rates(mean)
    expected = [rates.mean_anomaly, rates.argument_of_perigee, rates.raan]
    # Second order is 1e-9 rad/s; truncation of the difference and rounding are 1e-12.
    assert_allclose(found, expected, rtol=0, atol=5e-12)


def test_apsides_stand_at_the_critical_inclination():
    rates = secular_rates(low_orbit(0.1, CRITICAL))
    # Second order, a thousandth of the first, is left.
    assert abs(np.rad2deg(rates.argument_of_perigee)) * DAY < 0.02


# -- Keplerian orbits ----------------------------------------------------------------------------


def test_fixed_ellipse_is_the_integrated_one():
    orbit = KeplerianOrbit(elements=low_orbit(0.3, 50.0), epoch=EPOCH, j2=False)
    times = np.linspace(0.0, DAY, 50)
    exact = integrate(orbit.inertial(0.0), times, j2=0.0)
    assert distance(orbit.inertial(times), exact) < 1e-2  # of the integration


@pytest.mark.parametrize("e", [0.0, 0.3])
def test_osculating_elements_are_met_at_the_epoch(e):
    elements = low_orbit(e, 97.44)
    orbit = KeplerianOrbit(elements=elements, epoch=EPOCH, kind=ElementKind.OSCULATING)
    start, given_state = orbit.inertial(0.0), states_from_elements(elements)
    assert_allclose(start.position @ orbit.axes, given_state.position, rtol=0, atol=1e-5)
    # The derivative of a theory of first order: J2² of the speed is 8 mm/s.
    assert_allclose(start.velocity @ orbit.axes, given_state.velocity, rtol=0, atol=0.02)


def test_osculating_orbit_follows_the_integrated_one():
    elements = low_orbit(0.001, 97.44)
    orbit = KeplerianOrbit(elements=elements, epoch=EPOCH, kind=ElementKind.OSCULATING)
    times = np.linspace(0.0, DAY, 500)
    exact = integrate(states_from_elements(elements), times)
    found = orbit.inertial(times)
    assert distance(States(found.position @ orbit.axes, exact.velocity), exact) < 15.0


@pytest.mark.parametrize("j2", [True, False])
def test_velocities_are_derivatives(j2):
    orbit = KeplerianOrbit(elements=low_orbit(0.3, 97.44), epoch=EPOCH, j2=j2)
    times, step = np.linspace(0.0, 3 * DAY, 100), 4.0
    for states in (orbit.inertial, orbit.earth_fixed):
        p = [states(times + k * step).position for k in (-2, -1, 1, 2)]
        difference = (8.0 * (p[2] - p[1]) - (p[3] - p[0])) / (12.0 * step)
        # Truncation of this difference at perigee is 2e-7 m/s.
        assert_allclose(states(times).velocity, difference, rtol=0, atol=2e-6)


def test_circular_orbit_starts_where_it_is_told():
    longitude = np.deg2rad(15.0)
    orbit = KeplerianOrbit.circular(
        altitude=514e3,
        inclination=np.deg2rad(97.44),
        epoch=EPOCH,
        raan=raan_from_longitude(longitude, epoch=EPOCH),
    )
    x, y, z = orbit.earth_fixed(0.0).position
    # The pole's motion, 0.4 arcseconds, is 13 m; the periodic terms stay in the orbit plane here.
    assert math.atan2(y, x) == pytest.approx(longitude, abs=3e-5)
    assert z == pytest.approx(0.0, abs=150.0)


def test_dusk_orbit_sees_the_sun_a_quarter_turn_behind():
    epoch = datetime(2026, 6, 10, 14, 23, tzinfo=UTC)
    raan = raan_from_local_time(18 * 3600.0, epoch=epoch)
    at = moments(epoch)
    earth = erfa.epv00(2_400_000.5 + at.day, at.fraction)[0]["p"]
    x, y, _ = -earth
    ahead = math.remainder(raan - math.atan2(y, x), 2 * math.pi)
    # True and mean sun differ by the equation of time: under 17 minutes of time, 4.2°.
    assert math.degrees(ahead) == pytest.approx(90.0, abs=4.2)


def test_sun_synchronous_orbit_keeps_its_local_time():
    node = raan_from_local_time(18 * 3600.0, epoch=EPOCH)
    # 2π in a tropical year, by the first-order rate: −1.5 n J2 (R/a)² cos i.
    axis = EARTH_EQUATORIAL_RADIUS + 514.8e3
    flattening = 1.5 * EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / axis) ** 2
    rate = math.sqrt(EARTH_GRAVITATIONAL_PARAMETER / axis**3) * flattening
    inclination = math.acos(-2.0 * math.pi / (365.2422 * DAY) / rate)
    orbit = KeplerianOrbit.circular(
        altitude=514.8e3, inclination=inclination, epoch=EPOCH, raan=node
    )
    month = 30 * DAY
    later = EPOCH + timedelta(seconds=month)
    drift = drifted(orbit.mean, np.array(month)).raan - raan_from_local_time(
        18 * 3600.0, epoch=later
    )
    assert math.degrees(math.remainder(float(drift), 2 * math.pi)) == pytest.approx(0, abs=0.05)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"eccentricity": 1.2}, "eccentricity = 1.2 must be 0 or more and below 1"),
        ({"eccentricity": -0.1}, "eccentricity = -0.1 must be 0 or more"),
        ({"semi_major_axis": 6.4e6}, r"height of 21\.9 km, below 100 km, where the orbit decays"),
        ({"eccentricity": 0.2}, "raise the semi-major axis"),
        ({"semi_major_axis": math.nan}, "semi_major_axis = nan must be a finite number"),
        ({"inclination": 97.4}, r"inclination = 97\.4 rad must lie within 0 and π; give radians"),
    ],
)
def test_impossible_orbits_are_refused(change, message):
    elements = Elements(7e6, 0.0, 1.0, 0.0, 0.0, 0.0)._replace(**change)
    with pytest.raises(ValueError, match=message):
        KeplerianOrbit(elements=elements, epoch=EPOCH)


def test_epoch_needs_a_time_zone():
    with pytest.raises(ValueError, match="has no time zone; give UTC"):
        KeplerianOrbit.circular(altitude=514e3, inclination=1.0, epoch=datetime(2026, 3, 1))


# -- two-line elements ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def skyfield_time() -> Timescale:
    with Path(astropy_iers_data.IERS_A_FILE).open("rb") as file:
        finals = iers.parse_x_y_dut1_from_finals_all(file)
    arrays = iers.build_timescale_arrays(finals["utc_mjd"], finals["dut1"])
    scale = Timescale((arrays[0], arrays[1]), arrays[2], arrays[3])
    iers.install_polar_motion_table(scale, finals)
    return scale


def test_two_lines_of_the_verification_run(published):
    row = published["sgp4"]
    orbit = TwoLineOrbit.from_lines(row["line1"], row["line2"])
    times = np.array(row["minutes"]) * 60.0
    teme = teme_to_gcrs(moments(orbit.epoch, times)).inverse().apply(orbit.inertial(times))
    # Printed to 10 µm; to the GCRS and back loses 0.1 µm.
    assert_allclose(teme.position, np.array(row["position_km"]) * 1e3, rtol=0, atol=2e-4)


def test_two_lines_as_skyfield_has_them(skyfield_time):
    orbit = TwoLineOrbit.from_lines(*LINES)
    satellite = EarthSatellite(*LINES, ts=skyfield_time)
    times = np.linspace(0.0, DAY, 50)
    theirs = satellite.at(
        skyfield_time.utc(2019, 12, 9, 16, 38, times + 29.363424)
    ).frame_xyz_and_velocity(itrs)
    found = orbit.earth_fixed(times)
    assert_allclose(found.position, theirs[0].m.T, rtol=0, atol=0.03)  # UT1 by straight lines
    # SGP4's velocities, which Skyfield hands on, are centimeters per second off.
    assert_allclose(found.velocity, theirs[1].m_per_s.T, rtol=0, atol=0.1)


def test_two_line_velocities_are_derivatives():
    orbit = TwoLineOrbit.from_lines(*LINES)
    times, step = np.linspace(0.0, DAY, 100), 4.0
    p = [orbit.earth_fixed(times + k * step).position for k in (-2, -1, 1, 2)]
    difference = (8.0 * (p[2] - p[1]) - (p[3] - p[0])) / (12.0 * step)
    assert_allclose(orbit.earth_fixed(times).velocity, difference, rtol=0, atol=5e-6)


def test_two_lines_with_a_name():
    text = "\n0 ISS (ZARYA)\n" + "\n".join(LINES) + "\n\n"
    orbit = TwoLineOrbit.from_text(text)
    assert orbit.name == "ISS (ZARYA)"
    assert orbit == TwoLineOrbit.from_lines(*LINES, name="ISS (ZARYA)")
    assert orbit.epoch == datetime(2019, 12, 9, 16, 38, 29, 363424, tzinfo=UTC)
    assert TwoLineOrbit.from_text("\n".join(LINES)).name is None


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (LINES[::-1], "line 1 of the two-line elements begins with '2': the lines are swapped"),
        (
            (LINES[0].replace("19343", "19344"), LINES[1]),
            r"line 1 .* ends with checksum 1, but its digits add up to 2; it is damaged",
        ),
        ((LINES[0][:60], LINES[1]), r"must begin with '1 ' and have 69 ASCII characters; .* 60"),
        (
            (LINES[0], "2 25545  51.6439 211.2001 0007417  17.6667  85.6398 15.50103472202483"),
            "line 1 is of satellite 25544, line 2 of 25545; give the two lines of one satellite",
        ),
    ],
)
def test_damaged_lines_are_refused(lines, message):
    with pytest.raises(ValueError, match=message):
        TwoLineOrbit.from_lines(*lines)


@pytest.mark.parametrize("text", ["", LINES[0]])
def test_text_of_another_number_of_lines_is_refused(text):
    with pytest.raises(ValueError, match="have 2 lines, or 3 with the name first; found"):
        TwoLineOrbit.from_text(text)


def test_decayed_satellite_says_so():
    orbit = TwoLineOrbit.from_lines(*LINES, name="ISS")
    with pytest.raises(ValueError, match=r"ISS \(25544\), .* days from their epoch 2019-12-09"):
        orbit.earth_fixed(np.linspace(0.0, 20_000 * DAY, 100))


def test_satellite_that_decayed_before_its_epoch_is_refused():
    # Perigee at 300 km below the ground.
    line = "2 25544  51.6439 211.2001 1500000  17.6667   0.0000 16.5000000020248"
    with pytest.raises(ValueError, match=r"decayed|eccentricity|semi-latus"):
        TwoLineOrbit.from_lines(LINES[0], line + str(_checksum(line)))


def _checksum(line: str) -> int:
    return sum(int(c) if c.isdigit() else c == "-" for c in line) % 10


# -- reference orbit -----------------------------------------------------------------------------


def test_reference_orbit_of_mean_elements():
    orbit = KeplerianOrbit.circular(altitude=514e3, inclination=np.deg2rad(97.44), epoch=EPOCH)
    for time in np.linspace(0.0, 6000.0, 7):
        found = reference_orbit(orbit, time)
        # A velocity that is the derivative of a theory of first order: J2² of the radius.
        assert found.semi_major_axis == pytest.approx(6_892_137.0, abs=20.0)
        assert found.inclination == pytest.approx(np.deg2rad(97.44), abs=1e-5)


def test_reference_orbit_of_two_lines():
    orbit = TwoLineOrbit.from_lines(*LINES)
    # Kozai's mean motion is that of the anomaly between nodes; its axis is 1 J2 shorter or so.
    found = [reference_orbit(orbit, time) for time in np.linspace(0.0, 5500.0, 12)]
    axes = np.array([each.semi_major_axis for each in found])
    kozai = Orbit(semi_major_axis=axes.mean(), inclination=0.9).mean_motion * DAY / (2 * math.pi)
    assert kozai == pytest.approx(15.501, rel=1e-3)
    assert np.ptp(axes) < 200.0  # other harmonics; the osculating axis swings by 18 km


def test_mean_elements_at_a_later_time():
    orbit = KeplerianOrbit(elements=low_orbit(0.1, 97.44), epoch=EPOCH)
    found, expected = mean_elements_at(orbit, DAY), drifted(orbit.mean, np.array(DAY))
    assert found.raan == pytest.approx(float(expected.raan), abs=1e-5)
    assert found.eccentricity == pytest.approx(0.1, abs=1e-5)


def test_elements_refer_to_the_equator_of_the_time():
    years = 20 * 365.25 * DAY
    elements = Elements(7e6, 0.0, np.deg2rad(97.44), math.pi / 2.0, 0.0, 0.0)
    orbit = KeplerianOrbit(elements=elements, epoch=EPOCH, j2=False)
    position, velocity = orbit.inertial(years)
    pole = gcrs_to_itrs(moments(EPOCH, years)).matrix[2]
    normal = np.cross(position, velocity)
    tilt = math.acos(normal @ pole / np.linalg.norm(normal))
    # In 20 years the equator turns by 2e-3 rad; the periodic terms are 2e-4 at this inclination.
    assert mean_elements_at(orbit, years).inclination == pytest.approx(tilt, abs=2e-4)
    assert abs(tilt - elements.inclination) > 1.5e-3


def test_an_orbit_of_two_bodies_keeps_its_elements():
    """Without J2 there is nothing to free the elements from: 5 km at this height."""
    orbit = KeplerianOrbit(elements=low_orbit(0.003, 97.44), epoch=EPOCH, j2=False)
    for time in (0.0, 1500.0, 4000.0):
        found = mean_elements_at(orbit, time)
        assert found.semi_major_axis == pytest.approx(orbit.elements.semi_major_axis, abs=1e-3)
        assert found.eccentricity == pytest.approx(0.003, abs=1e-9)


# -- source --------------------------------------------------------------------------------------


def test_sources_in_words():
    epoch = datetime(2026, 3, 1, tzinfo=UTC)
    circle = {"altitude": 514e3, "inclination": 1.7, "epoch": epoch}
    assert KeplerianOrbit.circular(**circle).source == "mean elements with J2"
    elements = Elements(6.9e6, 0.01, 1.7, 0.0, 0.0, 0.0)
    osculating = KeplerianOrbit(
        elements=elements, epoch=epoch, kind=ElementKind.OSCULATING, j2=False
    )
    assert osculating.source == "osculating elements, two bodies"
    assert TwoLineOrbit.from_lines(*LINES).source == "two-line elements of satellite 25544"
    named = TwoLineOrbit.from_lines(*LINES, name="SAR 1")
    assert named.source == "two-line elements of SAR 1 (25544)"


def test_two_line_elements_that_dip_into_the_earth_say_so():
    line = LINES[1][:26] + "9500000" + LINES[1][33:68]
    with pytest.raises(
        ValueError, match=r"at their epoch .*: the perigee is at a height of -\d+ km, decayed; they"
    ):
        TwoLineOrbit.from_lines(LINES[0], line + str(_checksum(line)))


def test_two_satellites_in_one_text_are_counted():
    with pytest.raises(
        ValueError, match=r"of 2 satellites or dates \(catalog numbers 25544, 25544\); keep"
    ):
        TwoLineOrbit.from_text("\n".join(("A", *LINES, "B", *LINES)))
