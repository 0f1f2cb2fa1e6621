"""CCSDS Orbit Ephemeris Messages: frames, time systems, interpolation, gaps, damage."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from itertools import pairwise

import erfa
import numpy as np
import pytest
from numpy.testing import assert_allclose

from formation import ElementKind, Elements, Ephemeris, KeplerianOrbit, States
from formation.elements import elements_from_states
from formation.frames import gcrs_to_itrs, teme_to_gcrs, true_of_date_to_gcrs
from formation.timescales import moments

EPOCH = datetime(2026, 3, 1, tzinfo=UTC)
ELEMENTS = Elements(6.9e6, 0.01, np.deg2rad(97.44), 1.0, 0.7, 0.4)
ORBIT = KeplerianOrbit(elements=ELEMENTS, epoch=EPOCH, kind=ElementKind.MEAN)
HEADER = "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-01-01T00:00:00\nORIGINATOR = TEST\n"
STEP = 120.0


def lines(states: States, times: np.ndarray, *, offset: float = 0.0) -> str:
    """Ephemeris lines, in a time system that is ahead of UTC by an offset."""
    return "".join(
        f"{EPOCH + timedelta(seconds=float(time) + offset):%Y-%m-%dT%H:%M:%S.%f} "
        + " ".join(f"{value / 1e3:.12f}" for value in (*position, *velocity))
        + "\n"
        for time, position, velocity in zip(times, *states, strict=True)
    )


def header(first: float, last: float, **changes: str) -> str:
    keys = {
        "OBJECT_NAME": "SAR 1",
        "OBJECT_ID": "2026-001A",
        "CENTER_NAME": "EARTH",
        "REF_FRAME": "GCRF",
        "TIME_SYSTEM": "UTC",
        "START_TIME": f"{EPOCH + timedelta(seconds=first):%Y-%m-%dT%H:%M:%S.%f}",
        "STOP_TIME": f"{EPOCH + timedelta(seconds=last):%Y-%m-%dT%H:%M:%S.%f}",
    } | changes
    body = "".join(f"{key} = {value}\n" for key, value in keys.items() if value)
    return f"META_START\n{body}META_STOP\n"


def segment(first: float, last: float, *, step: float = STEP, **changes: str) -> str:
    times = np.arange(first, last + step / 2, step)
    return header(first, last, **changes) + lines(ORBIT.inertial(times), times)


def differences(ephemeris: Ephemeris, orbit: KeplerianOrbit = ORBIT) -> tuple[float, float]:
    """Largest differences between ephemeris and orbit, Earth-fixed [m, m/s]."""
    times = np.linspace(*ephemeris.span, 2001)
    shift = (ephemeris.epoch - orbit.epoch).total_seconds()
    found, expected = ephemeris.earth_fixed(times), orbit.earth_fixed(times + shift)
    return tuple(float(np.abs(a - b).max()) for a, b in zip(found, expected, strict=True))


# -- frames and time systems ---------------------------------------------------------------------


def in_frame(name: str) -> Callable[[np.ndarray], States]:
    def turned(times: np.ndarray) -> States:
        at = moments(EPOCH, times)
        if name.startswith("ITRF"):
            return gcrs_to_itrs(at).apply(ORBIT.inertial(times))
        if name == "EME2000":
            bias = erfa.bp06(2_400_000.5, 51_544.5)[0]
            return States(*(value @ bias.T for value in ORBIT.inertial(times)))
        turn = {"TEME": teme_to_gcrs, "TOD": true_of_date_to_gcrs}[name]
        return turn(at).inverse().apply(ORBIT.inertial(times))

    return turned


@pytest.mark.parametrize("frame", ["EME2000", "ITRF2020", "ITRF", "ITRF-97", "TEME", "TOD"])
def test_frames(frame):
    times = np.arange(0.0, 6001.0, STEP)
    text = HEADER + header(0.0, 6000.0, REF_FRAME=frame) + lines(in_frame(frame)(times), times)
    position, velocity = differences(Ephemeris.from_oem(text))
    assert position < 1e-4
    assert velocity < 1e-5


@pytest.mark.parametrize("frame", ["GCRF", "ICRF", "gcrf"])
def test_celestial_frames_are_one(frame):
    position, velocity = differences(
        Ephemeris.from_oem(HEADER + segment(0.0, 6000.0, REF_FRAME=frame))
    )
    assert position < 1e-4
    assert velocity < 1e-5


def test_axes_of_a_frame_can_be_those_of_one_epoch():
    times = np.arange(0.0, 6001.0, STEP)
    axes = true_of_date_to_gcrs(moments(EPOCH)).matrix
    still = States(*(value @ axes for value in ORBIT.inertial(times)))
    text = header(0.0, 6000.0, REF_FRAME="TOD", REF_FRAME_EPOCH="2026-03-01T00:00:00")
    position, velocity = differences(Ephemeris.from_oem(HEADER + text + lines(still, times)))
    assert position < 1e-4
    assert velocity < 1e-5


@pytest.mark.parametrize(
    ("system", "offset"), [("UTC", 0.0), ("TAI", 37.0), ("TT", 69.184), ("GPS", 18.0)]
)
def test_time_systems(system, offset):
    times = np.arange(0.0, 3001.0, STEP)
    text = header(0.0, 3000.0, TIME_SYSTEM=system)
    text = HEADER + text + lines(ORBIT.inertial(times), times, offset=offset)
    ephemeris = Ephemeris.from_oem(text)
    assert ephemeris.epoch == EPOCH
    assert differences(ephemeris)[0] < 1e-4  # 0.1 µs of time is 1 mm


def test_epochs_by_day_of_year_with_zone_and_leap_second():
    rows = "".join(
        f"{epoch} 7000.0 {y:.6f} 0.0 0.0 7.5 0.0\n"
        for epoch, y in [
            ("2016-366T23:59:58Z", 0.0),
            ("2016-366T23:59:59Z", 7.5),
            ("2016-12-31T23:59:60Z", 15.0),
            ("2017-01-01T00:00:00", 22.5),
        ]
    )
    ephemeris = Ephemeris.from_oem(HEADER + header(0.0, 0.0) + rows)
    assert ephemeris.epoch == datetime(2016, 12, 31, 23, 59, 58, tzinfo=UTC)
    assert ephemeris.span == pytest.approx((0.0, 3.0), abs=1e-9)
    assert ephemeris.inertial(1.5).position == pytest.approx([7e6, 11_250.0, 0.0], abs=1e-6)


# -- interpolation -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("step", "position_limit", "velocity_limit"),
    # Twelve conditions: a step of an eighth of a revolution costs a decimeter, shorter ones nothing
    # (velocities of this orbit are rounded to 0.5 µm/s).
    [(10.0, 1e-4, 1e-5), (60.0, 1e-4, 1e-5), (240.0, 1e-3, 1e-5), (480.0, 0.5, 5e-3)],
)
def test_error_of_the_default(step, position_limit, velocity_limit):
    position, velocity = differences(
        Ephemeris.from_oem(HEADER + segment(0.0, 40 * step, step=step))
    )
    assert position < position_limit
    assert velocity < velocity_limit


@pytest.mark.parametrize("method", ["HERMITE", "LAGRANGE"])
def test_higher_degrees_are_nearer(method):
    errors = []
    for degree in ("3", "5", "7", "9"):
        text = segment(0.0, 9000.0, INTERPOLATION=method, INTERPOLATION_DEGREE=degree)
        ephemeris = Ephemeris.from_oem(HEADER + text)
        times = np.linspace(1000.0, 8000.0, 1001)  # away from the ends
        found, expected = ephemeris.inertial(times), ORBIT.inertial(times)
        errors.append(np.abs(found.position - expected.position).max())
    assert all(later < earlier / 20.0 for earlier, later in pairwise(errors))


def test_lagrange_ignores_velocities_and_hermite_meets_them():
    times = np.arange(0.0, 3001.0, STEP)
    wrong = States(ORBIT.inertial(times).position, ORBIT.inertial(times).velocity + 1.0)
    for method, met in (("LAGRANGE", False), ("HERMITE", True)):
        text = header(0.0, 3000.0, INTERPOLATION=method, INTERPOLATION_DEGREE="9")
        ephemeris = Ephemeris.from_oem(HEADER + text + lines(wrong, times))
        found = ephemeris.inertial(times)
        expected = wrong if met else ORBIT.inertial(times)
        assert_allclose(found.position, expected.position, rtol=0, atol=1e-5)
        # Lagrange's polynomial is poorest at the ends of the table.
        assert_allclose(found.velocity[4:-4], expected.velocity[4:-4], rtol=0, atol=1e-3)


@pytest.mark.parametrize("method", ["HERMITE", "LAGRANGE"])
def test_velocity_is_the_derivative(method):
    text = segment(0.0, 6000.0, INTERPOLATION=method, INTERPOLATION_DEGREE="7")
    ephemeris = Ephemeris.from_oem(HEADER + text)
    # Not over a node, where one polynomial follows another.
    times, h = np.arange(60.0, 5940.0, STEP), 4.0
    p = [ephemeris.earth_fixed(times + k * h).position for k in (-2, -1, 1, 2)]
    difference = (8.0 * (p[2] - p[1]) - (p[3] - p[0])) / (12.0 * h)
    assert_allclose(ephemeris.earth_fixed(times).velocity, difference, rtol=0, atol=1e-6)


def test_shapes_broadcast():
    ephemeris = Ephemeris.from_oem(HEADER + segment(0.0, 3000.0))
    assert ephemeris.earth_fixed(np.zeros((2, 3))).position.shape == (2, 3, 3)
    assert ephemeris.inertial(5.0).velocity.shape == (3,)


# -- segments and gaps ---------------------------------------------------------------------------


def test_segments_join():
    text = HEADER + segment(0.0, 3000.0) + segment(3000.0, 6000.0)
    ephemeris = Ephemeris.from_oem(text)
    assert ephemeris.name == "SAR 1"
    assert ephemeris.span == (0.0, 6000.0)
    assert differences(ephemeris)[0] < 1e-4


def test_accelerations_covariances_comments_and_blank_lines_are_passed_over():
    body = segment(0.0, 3000.0).splitlines()
    body = [line + " 0.0 0.0 0.0" if line.startswith("2026") else line for line in body]
    covariance = "COVARIANCE_START\nEPOCH = 2026-03-01T00:00:00\n1.0\n0.0 1.0\nCOVARIANCE_STOP\n"
    text = "COMMENT first\n" + HEADER.replace("2.0", "3.0") + "\n\nCOMMENT made by hand\n"
    text += "\r\n".join(body) + "\n\n" + covariance
    assert differences(Ephemeris.from_oem(text))[0] < 1e-4


def test_gap_between_segments_is_named():
    ephemeris = Ephemeris.from_oem(HEADER + segment(0.0, 2400.0) + segment(3600.0, 6000.0))
    ephemeris.inertial([0.0, 2400.0, 3600.0, 6000.0])
    message = (
        r"2026-03-01T00:50:00Z lies in a gap from 2026-03-01T00:40:00Z to 2026-03-01T01:00:00Z of "
        r"the ephemeris of SAR 1; choose other times"
    )
    for states in (ephemeris.inertial, ephemeris.earth_fixed):
        with pytest.raises(ValueError, match=message):
            states([0.0, 3000.0])


def test_missing_lines_are_a_gap():
    body = segment(0.0, 7200.0).splitlines(keepends=True)
    at = next(n for n, line in enumerate(body) if line.startswith("2026-03-01T01:00"))
    ephemeris = Ephemeris.from_oem(HEADER + "".join(body[:at] + body[at + 8 :]))
    with pytest.raises(ValueError, match=r"gap from 2026-03-01T00:58:00Z to 2026-03-01T01:16:00Z"):
        ephemeris.earth_fixed(3700.0)


def test_unusable_ends_are_not_used():
    usable = {
        "USEABLE_START_TIME": "2026-03-01T00:10:00",
        "USEABLE_STOP_TIME": "2026-03-01T00:40:00",
    }
    ephemeris = Ephemeris.from_oem(HEADER + segment(0.0, 3000.0, **usable))
    assert ephemeris.epoch == EPOCH + timedelta(minutes=10)
    assert ephemeris.span == (0.0, 1800.0)
    with pytest.raises(
        ValueError,
        match=r"2026-03-01T00:09:00Z is not within 2026-03-01T00:10:00Z to 2026-03-01T00:40:00Z",
    ):
        ephemeris.inertial(-60.0)


def test_time_that_is_no_number_is_refused():
    ephemeris = Ephemeris.from_oem(HEADER + segment(0.0, 3000.0))
    with pytest.raises(ValueError, match="time = nan s must be finite"):
        ephemeris.inertial([0.0, np.nan])


# -- damaged messages ----------------------------------------------------------------------------

GOOD = HEADER + segment(0.0, 3000.0)
FIRST = "2026-03-01T00:00:00.000000"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "OEM line 1: must be CCSDS_OEM_VERS = 2.0"),
        ("<?xml version='1.0'?>", "OEM line 1: this is XML; only the keyword-value notation"),
        (GOOD.replace("OEM", "OPM", 1), r"line 1: must be CCSDS_OEM_VERS .* is it an OEM\?"),
        (GOOD.replace("2.0", "4.0", 1), r"CCSDS_OEM_VERS = 4\.0; versions 1\.0, 2\.0 and 3\.0"),
        (HEADER, "there is no META_START"),
        (GOOD.split("META_STOP")[0], "line 4: the header that follows is never closed"),
        (GOOD.replace("META_STOP\n", ""), r"line 12: expected KEYWORD = value, or META_STOP"),
        (GOOD.replace("= GCRF", "= MOON_ME"), "REF_FRAME = MOON_ME is not known; read are EME2000"),
        (GOOD.replace("= EARTH", "= MARS"), "CENTER_NAME = MARS; only orbits about EARTH"),
        (GOOD.replace("= UTC", "= TDB"), "TIME_SYSTEM = TDB; read are UTC, TAI, TT, GPS"),
        (GOOD.replace("REF_FRAME = GCRF\n", ""), "line 4: the segment .* lacks REF_FRAME; add it"),
        (GOOD.replace(FIRST + " ", FIRST + " x"), "line 13: a coordinate is no number"),
        (GOOD.replace(FIRST + " ", FIRST + " nan "), "line 13: expected an epoch, 3 km"),
        (GOOD.replace(FIRST + " ", "2026-02-30T00:00:00 "), "line 13: .* no date of the calendar"),
        (GOOD.replace(FIRST + " ", "1/3/2026 "), "line 13: epoch '1/3/2026' must look like"),
        (GOOD.replace(FIRST + " ", "2027-03-01T00:00:00 "), "line 14: epoch .* is not after that"),
        (GOOD + "META_STOP\n", "line 39: META_STOP stands in the lines of a segment"),
        (HEADER + header(0.0, 0.0), "line 4: the segment that begins here has no ephemeris lines"),
        (
            HEADER + segment(0.0, 600.0, INTERPOLATION="LAGRANGE", INTERPOLATION_DEGREE="7"),
            "line 4: 6 lines without a gap follow, but the interpolation needs 8",
        ),
        (
            HEADER + segment(0.0, 600.0, INTERPOLATION="LINEAR"),
            "INTERPOLATION = LINEAR is not known; state HERMITE or LAGRANGE",
        ),
        (
            HEADER + segment(0.0, 600.0, INTERPOLATION_DEGREE="7.5"),
            r"INTERPOLATION_DEGREE = 7\.5 must be a whole number from 1 to 25",
        ),
        (
            HEADER + segment(0.0, 600.0, USEABLE_START_TIME="2026-03-01T05:00:00"),
            "line 4: the segment covers no time",
        ),
        (
            GOOD + segment(3000.0, 6000.0, OBJECT_ID="2026-001B"),
            "line 39: this segment is of object 2026-001B, the first of 2026-001A",
        ),
    ],
)
def test_damage_is_located(text, message):
    with pytest.raises(ValueError, match=message):
        Ephemeris.from_oem(text)


# -- states of no satellite ----------------------------------------------------------------------


def rows(text):
    return text.splitlines(keepends=True)


def changed(text, line, change):
    """A message with other numbers in one line, numbered from 1."""
    lines_ = rows(text)
    epoch, *numbers = lines_[line - 1].split()
    values = change(np.array([float(value) for value in numbers]))
    lines_[line - 1] = f"{epoch} {' '.join(f'{value:.9f}' for value in values)}\n"
    return "".join(lines_)


def slip(kilometers):
    return lambda values: values + np.array([0.0, kilometers, 0.0, 0.0, 0.0, 0.0])


@pytest.mark.parametrize("frame", ["GCRF", "ITRF", "TEME"])
@pytest.mark.parametrize("line", [13, 20, 38])
def test_a_slip_of_one_coordinate_is_found_in_its_line(frame, line):
    times = np.arange(0.0, 3001.0, STEP)
    states = ORBIT.inertial(times) if frame == "GCRF" else in_frame(frame)(times)
    text = HEADER + header(0.0, 3000.0, REF_FRAME=frame) + lines(states, times)
    Ephemeris.from_oem(changed(text, line, slip(0.5)))  # below 0.1 km + 5 m/s · 120 s
    first, second = (13, 14) if line == 13 else (line - 1, line)
    with pytest.raises(ValueError, match="OEM line") as error:
        Ephemeris.from_oem(changed(text, line, slip(5.0)))
    assert str(error.value) == (
        f"OEM line {line}: the position is 5 km from where the velocities of lines {first} and "
        f"{second} lead, and 0.8 km are allowed; correct the line, or begin a new segment after a "
        "maneuver"
    )


def test_a_maneuver_is_no_slip():
    """One of 5 m/s, with a line missing in the middle of it: a new ellipse from there on."""
    before = np.arange(0.0, 1201.0, STEP)
    states = ORBIT.inertial(1260.0)
    along = states.velocity / np.linalg.norm(states.velocity)
    axes = ORBIT.axes
    pushed = States(states.position @ axes, (states.velocity + 5.0 * along) @ axes)
    after = np.arange(1320.0, 3001.0, STEP)
    other = KeplerianOrbit(
        elements=elements_from_states(pushed), epoch=EPOCH, kind=ElementKind.OSCULATING
    )
    flown = [ORBIT.inertial(before), other.inertial(after - 1260.0)]
    joined = States(*(np.concatenate(pair) for pair in zip(*flown, strict=True)))
    text = header(0.0, 3000.0) + lines(joined, np.concatenate([before, after]))
    assert Ephemeris.from_oem(HEADER + text).span == (0.0, 3000.0)


@pytest.mark.parametrize(
    ("scale", "message"),
    [
        ((1e3, 1e3), "OEM line 13: the position is 6.8.*e.06 km from the center of the Earth, and"),
        ((1e-3, 1e-3), "OEM line 13: the position is 6.8.* km from the center of the Earth, and"),
        (
            (1.0, 1e3),
            r"OEM line 13: from here on .* move at 7.\d+ km/s, but the velocities are 7\d+",
        ),
        (
            (1.0, -1.0),
            "OEM line 13: from here on the positions move at .* or point elsewhere; give",
        ),
    ],
)
def test_other_units_are_recognized(scale, message):
    times = np.arange(0.0, 3001.0, STEP)
    states = ORBIT.inertial(times)
    other = States(states.position * scale[0], states.velocity * scale[1])
    with pytest.raises(ValueError, match=message):
        Ephemeris.from_oem(HEADER + header(0.0, 3000.0) + lines(other, times))


def test_inertial_velocities_in_a_turning_frame_are_refused():
    times = np.arange(0.0, 3001.0, STEP)
    fixed, inertial = ORBIT.earth_fixed(times), ORBIT.inertial(times)
    turn = gcrs_to_itrs(moments(EPOCH, times)).matrix
    mixed = States(fixed.position, np.einsum("sij,sj->si", turn, inertial.velocity))
    text = HEADER + header(0.0, 3000.0, REF_FRAME="ITRF") + lines(mixed, times)
    with pytest.raises(ValueError, match="give km and km/s, the velocities as seen in REF_FRAME"):
        Ephemeris.from_oem(text)


@pytest.mark.parametrize("eccentricity", [0.0, 0.1, 0.5, 0.9])
@pytest.mark.parametrize("step", [0.1, 1.0, 30.0, 300.0, 900.0])
def test_true_orbits_pass_whatever_their_shape_and_step(eccentricity, step):
    """The remainder of the corrected trapezoid is bounded, with J2, from perigee to apogee."""
    elements = Elements(6.6e6 / (1.0 - eccentricity), eccentricity, 1.2, 0.3, 1.5, -0.4)
    orbit = KeplerianOrbit(elements=elements, epoch=EPOCH)
    times = np.arange(0.0, 60.5 * step, step)
    text = HEADER + header(0.0, 60 * step) + lines(orbit.inertial(times), times)
    assert Ephemeris.from_oem(text).name == "SAR 1"


@pytest.mark.parametrize(
    "clock", ["25:00:00", "24:00:00", "12:60:00", "00:65:00", "12:00:60", "23:59:61"]
)
def test_times_of_no_day_are_refused(clock):
    text = GOOD.replace(f"{FIRST} ", f"2026-03-01T{clock} ")
    with pytest.raises(ValueError, match="OEM line") as error:
        Ephemeris.from_oem(text)
    assert str(error.value) == (
        f"OEM line 13: epoch '2026-03-01T{clock}' is no time of the day: hours run to 23, minutes "
        "and seconds to 59; correct it"
    )
