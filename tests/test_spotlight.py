"""Spotlight: where the beam falls, how the body turns, what the radar sees, what can't be done."""

from __future__ import annotations

import dataclasses
import math
import tomllib
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from formation import Elements, KeplerianOrbit
from formation.frames import gcrs_to_itrs
from formation.timescales import moments
from insar.observe.agile.agility import Agility
from insar.observe.agile.rotations import (
    EulerSequence,
    attitude_of_quaternion,
    attitude_of_sequence,
    axis_angle,
)
from insar.observe.agile.smooth_orbit import smooth_orbit
from insar.observe.agile.spotlight import spotlight, spotlight_scene
from insar.observe.agile.spotlight_attitude import Antenna, attitude_profile
from insar.observe.agile.spotlight_plan import aim_point, ground_speed, plan_spotlight
from insar.observe.agile.spotlight_results import (
    Pointing,
    SpotlightRequest,
    SpotlightResult,
)
from insar.observe.attitude import angular_rates
from insar.observe.doppler import doppler_centroid
from insar.observe.earth import from_geodetic, intersect, to_geodetic
from insar.observe.frames import orbit_axes
from insar.observe.look import angle_at_look, look_at, zero_doppler_plane
from insar.observe.scenes.passes import Direction
from insar.observe.vectors import rotate
from insar.scene import LookSide

SPEED_OF_LIGHT = 299_792_458.0
AIM = 1e-7
"""Largest aim error: rounding of positions of 7e6 m [m]."""
EPOCH = datetime(2016, 11, 25, 8, 9, 43, tzinfo=UTC)
HAN = tomllib.loads((Path(__file__).parent / "published" / "han2016.toml").read_text("utf-8"))


def request_seen(
    orbit,
    *,
    look: float,
    side: LookSide = LookSide.RIGHT,
    height: float = 0.0,
    **changes,
) -> SpotlightRequest:
    """A request for the point that is at zero Doppler, at a look angle, at time zero."""
    states = orbit.earth_fixed(0.0)
    plane = zero_doppler_plane(states, side=side)
    line = plane.direction(angle_at_look(plane, look))
    place = to_geodetic(intersect(states.position, line, height=height))
    values = {
        "trajectory": orbit,
        "latitude": float(place.latitude),
        "longitude": float(place.longitude),
        "height": height,
        "wavelength": 0.03123,
        "resolution": 0.25,
        "weighting": 1.1,
        "start": -300.0,
        "stop": 300.0,
    }
    return SpotlightRequest(**(values | changes))


def low_orbit(argument: float = 0.6, **changes) -> KeplerianOrbit:
    values = {"altitude": 514e3, "inclination": math.radians(97.44), "epoch": EPOCH} | changes
    return KeplerianOrbit.circular(argument_of_latitude=argument, **values)


@pytest.fixture(scope="module")
def sharp() -> SpotlightResult:
    """Off-axis, off-center, 8 s long, on a J2 orbit."""
    return spotlight(
        request_seen(
            low_orbit(),
            look=math.radians(35.0),
            off_axis=math.radians(-8.0),
            phase_center=(1.2, -0.4, 1.5),
            height=800.0,
        ),
        2001,
    )


# -- aim -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(12))
def test_beam_stays_on_the_aim_point_on_any_orbit(seed, two_body):
    """Random orbits up to e = 0.2, either side, any antenna; closed form and Han's iteration."""
    rng = np.random.default_rng(seed)
    e = rng.uniform(0.0, 0.2)
    orbit = two_body(
        Elements(
            (6_378e3 + rng.uniform(4e5, 1.5e6)) / (1.0 - e),
            e,
            np.arccos(rng.uniform(-1.0, 1.0)),
            *rng.uniform(-np.pi, np.pi, 3),
        )
    )
    request = request_seen(
        orbit,
        look=math.radians(rng.uniform(12.0, 35.0)),
        side=LookSide(rng.choice([-1, 1])),
        height=rng.uniform(-400.0, 8000.0),
        off_axis=math.radians(rng.uniform(-40.0, 40.0)),
        phase_center=tuple(rng.uniform(-4.0, 4.0, 3)),
    )
    result = spotlight(request, 101)
    assert abs(result.plan.time) < 1e-5
    assert np.all(result.profile.outcome == Pointing.SOLVED)
    assert result.aim_error.closed_form.max() < AIM
    assert result.aim_error.iterated.max() < AIM
    # Contraction by |p|/r: three or four steps to rounding.
    assert result.iteration.steps <= 5
    # What is left out is seen: meters, and tens of kilometers.
    assert np.nanmin(result.aim_error.without_phase_center) > 1e-3
    lost = result.aim_error.without_both
    assert np.all(np.isnan(lost) | (lost > 1e3))


def test_closed_form_and_iteration_share_the_line_of_sight(sharp):
    """They differ by a turn about it: the phase center moves by a fraction of the range."""
    request, plan = sharp.request, sharp.plan
    antenna = Antenna.of(request)
    assert 1e-9 < sharp.iteration.turn.max() < 5.0 / plan.slant_range
    relative = sharp.iteration.attitude @ np.swapaxes(sharp.profile.attitude, -1, -2)
    turn = axis_angle(relative)
    line = antenna.phase_center + plan.slant_range * antenna.beam
    cosine = turn.axis @ (line / np.linalg.norm(line))
    # The axis of a turn of 1e-7 rad has lost nine digits.
    np.testing.assert_allclose(np.abs(cosine), 1.0, atol=1e-6)


def test_inertial_quaternions_point_the_beam_in_celestial_axes(sharp):
    """Independent of the Earth-fixed computation: GCRS states of the orbit, GCRS target."""
    request, plan = sharp.request, sharp.plan
    times = plan.time + sharp.times[::100]
    turn = np.swapaxes(attitude_of_quaternion(sharp.profile.quaternion_inertial[::100]), -1, -2)
    antenna = Antenna.of(request)
    position = request.trajectory.inertial(times).position
    target = rotate(
        np.swapaxes(gcrs_to_itrs(moments(EPOCH, times)).matrix, -1, -2), aim_point(request)
    )
    start = position + rotate(turn, antenna.phase_center)
    line = rotate(turn, antenna.beam)
    path = target - start
    miss = np.linalg.norm(np.cross(path, line), axis=-1)
    assert miss.max() < 2e-6  # the Earth's rotation angle is rounded to 6e-14 rad: 4e-7 m


def test_quaternions_are_those_of_the_attitude(sharp):
    profile = sharp.profile
    np.testing.assert_allclose(
        attitude_of_quaternion(profile.quaternion_orbit), profile.attitude, atol=1e-14
    )
    for series in (profile.quaternion_orbit, profile.quaternion_inertial):
        assert np.abs(np.diff(series, axis=0)).max() < 1e-3


# -- rates ---------------------------------------------------------------------------------------


def test_rates_are_the_derivatives_of_the_attitude(sharp):
    """Against fourth-order differences, 4 ms apart."""
    states = smooth_orbit(
        sharp.request.trajectory, sharp.plan.time - 10.0, sharp.plan.time + 10.0
    ).states(sharp.plan.time + sharp.times)
    derivative = angular_rates(sharp.times, sharp.profile.attitude, orbit_axes=orbit_axes(states))
    inside = slice(2, -2)
    for ours, theirs in (
        (sharp.profile.rate_orbit, derivative.orbit),
        (sharp.profile.rate_inertial, derivative.inertial),
    ):
        np.testing.assert_allclose(ours[inside], theirs[inside], rtol=0, atol=1e-10)
    # The orbit's own rate is not negligible: 0.063 °/s.
    difference = np.linalg.norm(sharp.profile.rate_inertial - sharp.profile.rate_orbit, axis=-1)
    np.testing.assert_allclose(np.degrees(difference), 0.0633, atol=5e-4)


def test_accelerations_are_the_derivatives_of_the_rates(sharp):
    """Their own step shrinks the error to 1e-6 of 1e-3 rad/s²."""
    step = sharp.times[1] - sharp.times[0]
    for rate, acceleration in (
        (sharp.profile.rate_orbit, sharp.profile.acceleration_orbit),
        (sharp.profile.rate_inertial, sharp.profile.acceleration_inertial),
    ):
        derivative = (rate[2:] - rate[:-2]) / (2.0 * step)
        np.testing.assert_allclose(acceleration[1:-1], derivative, rtol=0, atol=1e-9)


def test_rates_do_not_depend_on_the_sampling(sharp):
    coarse = spotlight(sharp.request, 21)
    np.testing.assert_allclose(
        coarse.profile.rate_inertial, sharp.profile.rate_inertial[::100], rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(
        coarse.profile.acceleration_inertial,
        sharp.profile.acceleration_inertial[::100],
        rtol=0,
        atol=1e-10,
    )


# -- plan and echo -------------------------------------------------------------------------------


def test_zero_doppler_is_the_middle(sharp):
    """The moment is found to 1e-7 s, at −7 kHz/s; and it is that of the shortest range."""
    plan, request = sharp.plan, sharp.request
    states = request.trajectory.earth_fixed(plan.time)
    doppler = doppler_centroid(states, aim_point(request), wavelength=request.wavelength)
    assert abs(doppler) < 1e-3
    times = plan.time + np.linspace(-2.0, 2.0, 401)
    distance = look_at(request.trajectory.earth_fixed(times), aim_point(request)).slant_range
    assert abs(times[np.argmin(distance)] - plan.time) < 0.011
    assert plan.side is LookSide.RIGHT
    assert sharp.times[1000] == 0.0


@pytest.mark.parametrize("eccentricity", [0.0, 0.25])
def test_ground_speed_is_that_of_the_zero_doppler_line(eccentricity, two_body):
    """Brute force: moments of zero Doppler of two points 200 m apart along the ground track.

    On the ellipse the satellite climbs, and only the horizontal part of its velocity counts.
    """
    axis = 6_978e3 / (1.0 - eccentricity)
    orbit = two_body(Elements(axis, eccentricity, math.radians(97.8), 0.0, 0.3, 0.5))
    request = request_seen(orbit, look=math.radians(30.0))
    plan = plan_spotlight(request)
    velocity = orbit.earth_fixed(plan.time).velocity
    target = aim_point(request)
    up = normal(to_geodetic(target))
    along = velocity - velocity @ up * up
    along /= np.linalg.norm(along)
    times = []
    for shift in (-100.0, 100.0):
        point = to_geodetic(target + shift * along)
        moved = dataclasses.replace(
            request,
            latitude=float(point.latitude),
            longitude=float(point.longitude),
            height=float(point.height),
        )
        times.append(plan_spotlight(moved).time)
    # 1e-7 s of each moment in 29 ms.
    assert plan.ground_speed == pytest.approx(200.0 / (times[1] - times[0]), rel=2e-5)
    assert plan.ground_speed < 0.95 * np.linalg.norm(velocity)


def normal(place) -> np.ndarray:
    return np.array(
        [
            math.cos(place.latitude) * math.cos(place.longitude),
            math.cos(place.latitude) * math.sin(place.longitude),
            math.sin(place.latitude),
        ]
    )


def test_ground_speed_on_a_sphere_that_hardly_turns():
    """A circular polar orbit at the pole: V_g = n Rₑ cos α, but for the Earth's rotation."""
    radius, motion = 7_000e3, math.sqrt(3.986004418e14 / 7_000e3**3)
    orbit = KeplerianOrbit(
        elements=Elements(radius, 0.0, math.pi / 2, 0.0, 0.0, math.pi / 2), epoch=EPOCH, j2=False
    )
    smooth = smooth_orbit(orbit, 0.0, 0.0)
    states, acceleration = smooth.states(0.0), smooth.acceleration(0.0)
    below = states.position * (6_356_752.3142 / radius)
    speed = ground_speed(states, acceleration, below)
    # The pole itself is at rest; 1e-4: the Coriolis acceleration is across the track.
    assert speed == pytest.approx(motion * 6_356_752.3142, rel=1e-4)


def test_doppler_is_the_derivative_of_the_slant_range(sharp):
    """1 mHz, the phase center's own motion included."""
    step = sharp.times[1] - sharp.times[0]
    path = sharp.history.slant_range
    derivative = (path[:-4] - 8.0 * path[1:-3] + 8.0 * path[3:-1] - path[4:]) / (12.0 * step)
    np.testing.assert_allclose(
        sharp.history.doppler[2:-2], -2.0 / 0.03123 * derivative, rtol=0, atol=1e-3
    )


def test_bandwidth_gives_the_resolution(sharp):
    plan, history = sharp.plan, sharp.history
    assert sharp.times[-1] - sharp.times[0] == pytest.approx(plan.aperture_time)
    swept = history.doppler[0] - history.doppler[-1]
    assert history.bandwidth == pytest.approx(swept, rel=1e-9)
    assert history.resolution == pytest.approx(0.25, rel=1e-9)
    assert history.bandwidth == pytest.approx(1.1 * plan.ground_speed / 0.25, rel=1e-9)
    # Han's time takes the rate at zero Doppler, its peak: (v T/2r)²/2 of the bandwidth too short.
    assert plan.first_order_time == pytest.approx(
        1.1 * plan.ground_speed / (0.25 * abs(plan.doppler_rate))
    )
    assert history.first_order_resolution == pytest.approx(0.25, rel=2e-3)
    assert history.first_order_resolution > 0.25
    assert history.range_migration == pytest.approx(np.ptp(history.slant_range), rel=0.1)


@pytest.mark.parametrize("look", [20.0, 45.0])
def test_staring_beam_stays_and_sliding_beam_slides(look):
    """The footprint's speed in the middle is the factor of the zero-Doppler line's."""
    steered = []
    for factor in (0.0, 0.3, 0.9):
        request = request_seen(low_orbit(), look=math.radians(look), sliding_factor=factor)
        result = spotlight(request, 401)
        fallen = from_geodetic(latitude=result.history.latitude, longitude=result.history.longitude)
        velocity = (fallen[210] - fallen[190]) / (result.times[210] - result.times[190])
        axis = request.trajectory.earth_fixed(result.plan.time).velocity
        place = to_geodetic(fallen[200])
        ahead = axis - (axis @ normal(place)) * normal(place)
        speed = velocity @ ahead / np.linalg.norm(ahead)
        # Third order in the 0.4 s of the difference by the 70 s of the geometry.
        assert speed / result.plan.ground_speed == pytest.approx(factor, rel=1e-4, abs=1e-9)
        assert result.aim_error.closed_form.max() < AIM
        steered.append(np.ptp(result.profile.pitch))
    assert steered[0] > steered[1] > steered[2]


def test_sliding_over_a_scene_takes_longer():
    request = request_seen(
        low_orbit(), look=math.radians(30.0), sliding_factor=0.4, scene_length=10e3
    )
    plan = plan_spotlight(request)
    assert plan.imaging_time - plan.aperture_time == pytest.approx(10e3 / (0.4 * plan.ground_speed))
    result = spotlight(request, 11)
    assert result.times[-1] == pytest.approx(plan.imaging_time / 2)
    # The bandwidth of a target is still that of its aperture.
    assert result.history.resolution == pytest.approx(0.25, rel=2e-3)


def test_scene_holds_the_aim_point_from_ahead_to_behind(sharp):
    seen = spotlight_scene(sharp, 9)
    scene = seen.scene
    assert len(scene) == 9
    assert scene.times[0] == 0.0
    assert scene.times[-1] == pytest.approx(sharp.plan.imaging_time)
    assert (sharp.plan.epoch - seen.epoch).total_seconds() == pytest.approx(
        sharp.plan.imaging_time / 2, abs=2e-6
    )
    squint = np.sum(scene.line_of_sight * scene.velocity_direction, axis=-1)
    assert np.all(np.diff(squint) < 0.0)
    assert abs(squint[4]) < 1e-9
    np.testing.assert_allclose(scene.slant_range[4], sharp.plan.slant_range)
    # Right of the flight direction, −90° and the drift of a turning Earth.
    np.testing.assert_allclose(scene.azimuth[4], -math.pi / 2, atol=math.radians(5.0))
    assert seen.orbit.semi_major_axis == pytest.approx(6_378_137.0 + 514e3, abs=100.0)
    assert len(spotlight_scene(sharp, 1).scene) == 1


# -- masks and messages --------------------------------------------------------------------------


def test_target_below_the_horizon_is_masked():
    """A profile longer than the target is in view."""
    result = spotlight(request_seen(low_orbit(), look=math.radians(40.0), duration=1200.0), 601)
    hidden = result.profile.outcome == Pointing.BELOW_HORIZON
    assert hidden[0]
    assert hidden[-1]
    assert not hidden[300]
    for values in (
        result.profile.pitch,
        result.profile.rate_inertial[:, 1],
        result.profile.quaternion_inertial[:, 0],
        result.aim_error.closed_form,
        result.history.doppler,
        result.history.latitude,
    ):
        np.testing.assert_array_equal(np.isnan(values), hidden)
    assert np.nanmax(result.aim_error.closed_form) < 1e-6  # grazing: errors grow by 1/sin
    assert any("horizon" in text and "stays in view" in text for text in result.warnings)


def test_exceeded_agility_is_masked():
    """An overhead pass needs 0.8 °/s; the limit is in the middle of what is needed."""
    request = request_seen(low_orbit(), look=math.radians(12.0), duration=200.0)
    free = spotlight(request, 401)
    assert not free.warnings
    magnitude = np.linalg.norm(free.profile.rate_inertial, axis=-1)
    limit = 0.7 * float(magnitude.max())
    limited = dataclasses.replace(request, agility=Agility(max_rate=limit))
    result = spotlight(limited, 401)
    np.testing.assert_array_equal(result.profile.rate_exceeded, magnitude > limit)
    assert 0 < np.count_nonzero(result.profile.rate_exceeded) < 401
    assert not result.profile.acceleration_exceeded.any()
    assert "faster" in result.warnings[0]
    about_y = dataclasses.replace(
        request, agility=Agility(max_rate=(limit, 10.0, limit), max_acceleration=(1.0, 1e-5, 1.0))
    )
    result = spotlight(about_y, 401)
    assert not result.profile.rate_exceeded.any()
    np.testing.assert_array_equal(
        result.profile.acceleration_exceeded,
        np.abs(result.profile.acceleration_inertial[:, 1]) > 1e-5,
    )
    assert "accelerate" in result.warnings[0]


def test_roll_of_90_degrees_is_flagged(two_body):
    """Where the orbit reaches its greatest latitude, the line of sight has no part along X, and
    the roll is the look angle less the off-axis angle: exactly 90°.
    """
    orbit = two_body(Elements(7_000e3, 0.0, math.radians(97.7), 0.0, 0.0, math.pi / 2))
    look = math.radians(50.0)
    request = request_seen(
        orbit, look=look, side=LookSide.LEFT, off_axis=look - math.pi / 2, phase_center=(0, 0, 0)
    )
    result = spotlight(request, 101)
    np.testing.assert_array_equal(np.flatnonzero(result.profile.singular), [50])
    assert np.isfinite(result.profile.quaternion_orbit).all()
    assert np.isfinite(result.profile.rate_orbit).all()
    assert result.aim_error.closed_form.max() < AIM
    assert any("quaternions" in text for text in result.warnings)


def test_beam_that_would_have_to_turn_by_180_degrees_is_masked():
    orbit = smooth_orbit(low_orbit(), -100.0, 100.0)
    states = orbit.states(0.0)
    target = states.position * 0.9
    times = np.array([-10.0, 0.0, 10.0])
    profile = attitude_profile(
        orbit, times, target, Antenna(np.array([0.0, 0.0, -1.0]), np.zeros(3))
    )
    np.testing.assert_array_equal(
        profile.outcome, [Pointing.SOLVED, Pointing.OPPOSITE, Pointing.SOLVED]
    )
    np.testing.assert_array_equal(np.isnan(profile.pitch), [False, True, False])


def test_target_at_nadir_is_refused_with_the_reason():
    orbit = low_orbit()
    below = to_geodetic(orbit.earth_fixed(0.0).position)
    request = dataclasses.replace(
        request_seen(orbit, look=math.radians(30.0)),
        latitude=float(below.latitude),
        longitude=float(below.longitude),
    )
    with pytest.raises(ValueError, match=r"too near to the satellite's nadir.*search longer"):
        spotlight(request)
    # Asked for all the same, nothing breaks: the body turns, the radar is the user's affair.
    result = spotlight(dataclasses.replace(request, near_incidence=0.0), 51)
    assert result.aim_error.closed_form.max() < AIM


def test_target_that_is_never_seen_is_refused_with_the_reason():
    equatorial = low_orbit(inclination=math.radians(5.0))
    request = request_seen(equatorial, look=math.radians(30.0))
    pole = dataclasses.replace(request, latitude=math.radians(89.0), start=0.0, stop=86400.0)
    with pytest.raises(ValueError, match=r"never sees the satellite.*±5\.\d\d°"):
        spotlight(pole)
    with pytest.raises(ValueError, match=r"too near to the horizon"):
        spotlight(dataclasses.replace(request, far_incidence=math.radians(6.0)))


def test_other_side_and_other_direction_are_named():
    request = request_seen(low_orbit(), look=math.radians(30.0))
    with pytest.raises(ValueError, match=r"on the right of the flight direction; look right"):
        spotlight(dataclasses.replace(request, side=LookSide.LEFT))
    with pytest.raises(ValueError, match=r"only while the satellite flies northward"):
        spotlight(dataclasses.replace(request, direction=Direction.DESCENDING))
    message = r"number = 3: .* on 1 pass in the searched time; take it, or search longer"
    with pytest.raises(ValueError, match=message):
        spotlight(dataclasses.replace(request, number=3))
    assert plan_spotlight(dataclasses.replace(request, side=LookSide.RIGHT)).passes == 1


def test_several_passes_are_numbered_in_order_of_time():
    request = dataclasses.replace(
        request_seen(low_orbit(), look=math.radians(30.0)), start=-3e5, stop=3e5
    )
    plans = [plan_spotlight(dataclasses.replace(request, number=n)) for n in (1, 2, 3)]
    assert plans[0].passes >= 3
    assert plans[0].time < plans[1].time < plans[2].time


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"latitude": 40.0}, r"latitude = 40\.0 must be rad"),
        ({"longitude": math.nan}, "longitude = nan"),
        ({"wavelength": 0.0}, "wavelength = 0.0 must be m: positive"),
        ({"resolution": -1.0}, "resolution = -1.0"),
        ({"weighting": math.inf}, "weighting = inf must be positive"),
        ({"off_axis": 9.0}, "off_axis = 9.0"),
        ({"phase_center": (0.0, 1.0)}, "phase_center"),
        ({"sliding_factor": 1.0}, r"sliding_factor = 1\.0 must be 0 \(staring\) to below 1"),
        ({"scene_length": 1e3}, "give a sliding_factor above 0"),
        ({"duration": 0.0}, "duration = 0.0"),
        ({"near_incidence": 1.5}, "in order between 0 and π/2"),
        ({"number": 0}, "counted from 1"),
        ({"height": 1e6}, "give meters"),
    ],
)
def test_impossible_requests_are_refused(change, message):
    request = request_seen(low_orbit(), look=math.radians(30.0))
    with pytest.raises(ValueError, match=message):
        dataclasses.replace(request, **change)


@pytest.mark.parametrize("limit", [0.0, (1.0, 2.0), (1.0, -1.0, 1.0), math.nan])
def test_impossible_agility_is_refused(limit):
    with pytest.raises(ValueError, match="give radians"):
        Agility(max_rate=limit)


def test_too_few_samples_are_refused(sharp):
    with pytest.raises(ValueError, match="samples = 1"):
        spotlight(sharp.request, 1)
    with pytest.raises(ValueError, match="segments = 0"):
        spotlight_scene(sharp, 0)


# -- published values ----------------------------------------------------------------------------


@pytest.mark.parametrize("side", HAN["inferred"])
def test_han_2016_from_inferred_inputs(side):
    """Each printed figure within half a unit of its last digit; the inputs are not the paper's."""
    printed, table = HAN["printed"], HAN["inferred"][side]
    orbit = KeplerianOrbit.circular(
        altitude=table["altitude_km"] * 1e3,
        inclination=math.radians(table["inclination_deg"]),
        epoch=EPOCH,
        argument_of_latitude=math.radians(table["argument_of_latitude_deg"]),
        j2=False,
    )
    request = request_seen(
        orbit,
        look=math.radians(table["look_deg"]),
        side=LookSide[table["side"].upper()],
        wavelength=SPEED_OF_LIGHT / (table["frequency_ghz"] * 1e9),
        resolution=table["resolution_m"],
        weighting=table["weighting"],
        off_axis=math.radians(table["off_axis_deg"]),
        phase_center=(1.0, 0.5, 1.2),  # no printed figure depends on it
    )
    result = spotlight(request, 1001)
    profile = result.profile
    for name in ("pitch", "yaw", "roll"):
        swing = math.degrees(np.ptp(getattr(profile, name)))
        assert swing == pytest.approx(printed[f"{name}_range_deg"], abs=0.5e-4), name
    assert result.plan.ground_speed == pytest.approx(printed["ground_speed_m_s"], abs=0.5)
    assert result.history.bandwidth == pytest.approx(printed["doppler_bandwidth_hz"], abs=0.5)
    assert result.history.resolution == pytest.approx(printed["resolution_m"], abs=0.05)
    assert result.aim_error.closed_form.max() < 10.0 * printed["aim_error_m"]


def test_han_2016_roll_needs_a_pass_without_drift():
    """A few degrees of latitude from the greatest, the printed roll is already exceeded."""
    table = HAN["inferred"]["left"]
    swings = {}
    for argument in (30.0, 60.0, 85.0):
        orbit = KeplerianOrbit.circular(
            altitude=table["altitude_km"] * 1e3,
            inclination=math.radians(table["inclination_deg"]),
            epoch=EPOCH,
            argument_of_latitude=math.radians(argument),
            j2=False,
        )
        request = request_seen(
            orbit,
            look=math.radians(table["look_deg"]),
            side=LookSide.LEFT,
            resolution=0.6,
            off_axis=math.radians(table["off_axis_deg"]),
        )
        swings[argument] = math.degrees(np.ptp(spotlight(request, 101).profile.roll))
    assert 0.09 < swings[30.0] < 0.11
    assert 0.05 < swings[60.0] < 0.065
    assert 2.0 * HAN["printed"]["roll_range_deg"] < swings[85.0]


# -- the time that a resolution takes ------------------------------------------------------------


def l_band(resolution: float, **changes) -> SpotlightRequest:
    """At L band an aperture is so long that its Doppler bends."""
    changes = {"wavelength": 0.24, "resolution": resolution} | changes
    return request_seen(low_orbit(), look=math.radians(30.0), **changes)


@pytest.mark.parametrize("resolution", [0.07, 0.1, 1.0])
@pytest.mark.parametrize("phase_center", [(0.0, 0.0, 0.0), (3.0, -2.0, 1.0)])
def test_the_imaging_time_gives_the_resolution(resolution, phase_center):
    request = l_band(resolution, phase_center=phase_center)
    result = spotlight(request, 21)
    plan = result.plan
    assert result.history.resolution == pytest.approx(resolution, rel=1e-9)
    assert plan.imaging_time == plan.aperture_time
    # On a straight path the rate at zero Doppler alone gives a time too short by 1/√(1 − x²), x the
    # bandwidth by its limit 4v/λ; the curve of the orbit adds a tenth of that, and more near x = 1.
    speed = np.linalg.norm(request.trajectory.earth_fixed(plan.time).velocity)
    share = result.history.bandwidth * request.wavelength / (4.0 * speed)
    longer = plan.aperture_time / plan.first_order_time
    assert share < 0.9
    assert longer - 1.0 == pytest.approx(
        1.0 / math.sqrt(1.0 - share**2) - 1.0, rel=0.1 + 0.4 * share
    )


def test_the_imaging_time_against_the_range_of_the_trajectory():
    """Independent: differences of the slant range of the trajectory itself, at both ends."""
    request = l_band(0.08)
    plan = plan_spotlight(request)
    doppler = []
    for end in (-0.5, 0.5):
        around = plan.time + end * plan.aperture_time + np.array([-0.05, 0.05])
        position = request.trajectory.earth_fixed(around).position
        range_rate = np.diff(np.linalg.norm(position - aim_point(request), axis=-1)) / 0.1
        doppler.append(-2.0 / request.wavelength * range_rate[0])
    # 1e-4 Hz: the third derivative of the range over 0.05 s; bandwidth 96 kHz.
    assert doppler[0] - doppler[1] == pytest.approx(1.1 * plan.ground_speed / 0.08, rel=1e-7)


def test_the_first_order_time_is_that_of_fine_wavelengths():
    """It is right to (λB/4v)²/2 and so to λ²."""
    errors = []
    for wavelength in (0.0625, 0.125):
        plan = plan_spotlight(l_band(0.25, wavelength=wavelength))
        errors.append(plan.aperture_time / plan.first_order_time - 1.0)
    assert errors[1] / errors[0] == pytest.approx(4.0, rel=0.03)


def test_a_resolution_out_of_reach_is_refused_with_one_that_is_not():
    with pytest.raises(ValueError, match="out of reach") as refused:
        plan_spotlight(l_band(0.05))
    said = str(refused.value)
    assert said.startswith("resolution = 0.05 m: ")
    assert "while the aim point sees the satellite, 348." in said
    offered = float(said.split("ask for ")[1].split(" m")[0])
    plan = plan_spotlight(l_band(offered))
    assert plan.aperture_time < 2.0 * 348.5
    # Half a step finer is out of reach: the offer is no more than rounded.
    with pytest.raises(ValueError, match="out of reach"):
        plan_spotlight(l_band(offered * 0.998))


def test_an_orbit_known_for_too_short_bounds_the_resolution(two_body):
    elements = low_orbit().elements
    long = two_body(elements)
    short = two_body(elements, span=(-40.0, 40.0))
    wanted = request_seen(
        short, look=math.radians(30.0), wavelength=0.24, resolution=0.1, start=-39.0, stop=39.0
    )
    assert plan_spotlight(dataclasses.replace(wanted, trajectory=long)).aperture_time > 80.0
    with pytest.raises(ValueError, match=r"while the orbit is known, 40\.0 s before and after"):
        plan_spotlight(wanted)


# -- turned over ---------------------------------------------------------------------------------


def test_a_body_that_rolls_over_has_the_angles_of_who_steers_it():
    """Beam 80° to the right of the body, target 30° to the left: a roll of 110°, and little else.

    The angles of the sequence with a roll within ±90° are yaw 174°, roll 70°, pitch -173°. The
    plane of zero Doppler is 4° from the orbit frame's, and the long turn doubles that.
    """
    request = request_seen(
        low_orbit(), look=math.radians(30.0), side=LookSide.LEFT, off_axis=math.radians(-80.0)
    )
    result = spotlight(request, 101)
    profile = result.profile
    middle = [math.degrees(getattr(profile, name)[50]) for name in ("yaw", "pitch", "roll")]
    assert abs(middle[2]) == pytest.approx(110.0, abs=0.5)
    assert max(abs(middle[0]), abs(middle[1])) < 8.0
    for name in ("yaw", "pitch", "roll"):
        assert np.abs(np.diff(getattr(profile, name))).max() < 0.05
    angles = {name: getattr(profile, name) for name in ("yaw", "pitch", "roll")}
    np.testing.assert_allclose(
        attitude_of_sequence(sequence=EulerSequence.THREE_ONE_TWO, **angles),
        profile.attitude,
        atol=1e-14,
    )
    assert np.all(profile.upside_down)
    assert any("upside down" in text for text in result.warnings)
    assert not np.any(spotlight(dataclasses.replace(request, off_axis=0.1), 11).profile.upside_down)


def test_old_elements_are_warned_of():
    """By the same words as in a formation study; a fresh orbit is not."""
    orbit = low_orbit()
    aged = dataclasses.replace(
        request_seen(orbit, look=math.radians(30.0)),
        start=400 * 86_400.0,
        stop=411 * 86_400.0,
        near_incidence=math.radians(20.0),
        far_incidence=math.radians(55.0),
    )
    (text,) = spotlight(aged, 11).warnings
    assert "days after the epoch of the" in text
    assert "drag is left out" in text
    assert spotlight(request_seen(orbit, look=math.radians(30.0)), 11).warnings == ()


@pytest.mark.parametrize("factor", [0.7, 0.95])
def test_a_sliding_beam_at_a_large_incidence_sees_its_place(factor):
    """Its rotation center lies far below the ground, where no horizon is to be asked for."""
    request = dataclasses.replace(
        request_seen(low_orbit(), look=math.radians(53.0)), sliding_factor=factor
    )
    profile = spotlight(request).profile
    assert np.all(profile.outcome == Pointing.SOLVED)
    assert np.all(np.isfinite(profile.rate_inertial))
