"""Video mode: frames, staring attitude, yaw laws, footprints, and the film of Sasebo."""

from __future__ import annotations

import dataclasses
import math
import tomllib
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from formation import Elements, KeplerianOrbit, States
from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar import LookSide
from insar.observe.agile.agility import Agility
from insar.observe.agile.rotations import EulerSequence, euler_sequence
from insar.observe.agile.smooth_orbit import smooth_orbit
from insar.observe.agile.video import video, video_scene
from insar.observe.agile.video_attitude import hold, stare, staring_profile
from insar.observe.agile.video_footprint import footprint_map, footprints, horizontal_axes
from insar.observe.agile.video_frames import effective_speed, frame_length, overlap, rate_limit
from insar.observe.agile.video_request import VideoRequest, YawLaw
from insar.observe.agile.video_results import Staring, VideoResult
from insar.observe.agile.video_yaw import Beam, Held
from insar.observe.attitude import angular_rates
from insar.observe.earth import from_geodetic, intersect, to_geodetic, vertical
from insar.observe.frames import inertial_velocity, orbit_axes
from insar.observe.look import look_at
from insar.observe.vectors import unit

LIANG: dict[str, Any] = tomllib.loads(
    (Path(__file__).parent / "published" / "liang2018.toml").read_text(encoding="utf-8")
)
RATE = 1e-10  # rad/s, against differences: the requirement
TRACE = np.deg2rad(1e-9)  # rotation of the direction that is held: the requirement
AIM = 1e-7  # m
HELD = {
    YawLaw.AZIMUTH_TRACE: "azimuth_trace",
    YawLaw.RANGE_TRACE: "range_trace",
    YawLaw.MAJOR_AXIS: "major_axis",
}
every_law = pytest.mark.parametrize("law", list(YawLaw))
holding_laws = pytest.mark.parametrize("law", list(HELD))


def sasebo(orbit: str = "equatorial", **changes: Any) -> VideoRequest:
    """The film of Liang 2018 with the inferred inputs."""
    inferred, elements = LIANG["inferred"], LIANG["orbits"][orbit]
    trajectory = KeplerianOrbit.circular(
        altitude=elements["altitude_m"],
        inclination=math.radians(inferred["inclination_deg"]),
        epoch=LIANG["printed"]["zero_doppler"],
        raan=math.radians(elements["raan_deg"]),
        argument_of_latitude=math.radians(elements["argument_of_latitude_deg"]),
    )
    request = VideoRequest(
        trajectory=trajectory,
        latitude=math.radians(inferred["latitude_deg"]),
        longitude=math.radians(inferred["longitude_deg"]),
        wavelength=inferred["wavelength_m"],
        resolution=inferred["resolution_m"],
        frame_rate=inferred["frame_rate_hz"],
        duration=(LIANG["printed"]["stop"] - LIANG["printed"]["start"]).total_seconds(),
        start=-300.0,
        stop=300.0,
        azimuth_beamwidth=math.radians(inferred["azimuth_beamwidth_deg"]),
        elevation_beamwidth=math.radians(inferred["elevation_beamwidth_deg"]),
        pointing_error=(1e-4, 1e-4, 1e-4),
    )
    return dataclasses.replace(request, **changes)


@pytest.fixture(scope="module")
def film() -> VideoResult:
    return video(sasebo(), 401, 41)


def target_of(request: VideoRequest) -> np.ndarray:
    return from_geodetic(
        latitude=request.latitude, longitude=request.longitude, height=request.height
    )


def earth_fixed(result: VideoResult) -> States:
    """States at the samples, straight from the trajectory."""
    return result.request.trajectory.earth_fixed(result.plan.time + result.times)


def body_axes(result: VideoResult) -> np.ndarray:
    """Earth-fixed body axes at the samples, (S, 3, 3)."""
    return result.profile.attitude @ orbit_axes(earth_fixed(result))


def films(**changes: Any) -> list[VideoRequest]:
    """Films from an eccentric low orbit, a medium one, and a retrograde one that looks left."""
    epoch = datetime(2024, 3, 1, tzinfo=UTC)

    def orbit(height: float, e: float, inclination: float) -> KeplerianOrbit:
        axis = (EARTH_EQUATORIAL_RADIUS + height) / (1.0 - e)
        angles = np.deg2rad([inclination, 40.0, 70.0, 0.0])
        return KeplerianOrbit(elements=Elements(axis, e, *angles), epoch=epoch)

    common = {
        "wavelength": 0.056,
        "resolution": 2.0,
        "frame_rate": 2.0,
        "start": 0.0,
        "azimuth_beamwidth": 0.004,
        "elevation_beamwidth": 0.02,
        **changes,
    }
    cases = [
        (orbit(500e3, 0.1, 63.4), 35.0, -20.0, 120.0, LookSide.RIGHT, 250.0),
        (orbit(8000e3, 0.05, 45.0), -30.0, 100.0, 600.0, None, -30.0),
        (orbit(620e3, 0.001, 140.0), 20.0, 10.0, 150.0, LookSide.LEFT, 2000.0),
    ]
    return [
        VideoRequest(
            trajectory=trajectory,
            latitude=math.radians(latitude),
            longitude=math.radians(longitude),
            height=height,
            duration=duration,
            stop=6 * 86400.0,
            side=side,
            **common,
        )
        for trajectory, latitude, longitude, duration, side, height in cases
    ]


# -- frames --------------------------------------------------------------------------------------

lengths = st.floats(0.1, 50.0)


@given(lengths, lengths, st.floats(0.0, 60.0))
def test_overlap_is_what_brute_force_intervals_share(length, previous, spacing):
    """Midpoints of 20 000 slices of the frame that lie in the one before, with its center at 0."""
    slices = (np.arange(20_000) + 0.5) / 20_000
    path = spacing + length * (slices - 0.5)
    counted = np.mean(np.abs(path) <= 0.5 * previous)
    # Two edges, each within half a slice.
    assert abs(overlap(length, previous, spacing=spacing) - counted) <= 1.0001 / 20_000


def test_overlap_is_the_printed_equation_where_frames_meet():
    """Liang 2018 eq. (5) letter by letter, with ρ = V_r/B in the lengths as printed."""
    wavelength, closest, speed, resolution, interval = 0.031, 615e3, 7360.0, 1.0, 0.5
    t = np.linspace(-100.0, 100.0, 301)
    before = closest**2 + speed**2 * (t - interval) ** 2
    printed = 0.5 + (
        wavelength * before**1.5 - 4.0 * interval * speed * closest**2 * resolution
    ) / (2.0 * wavelength * (closest**2 + speed**2 * t**2) ** 1.5)
    lengths = [
        frame_length(
            time,
            closest_range=closest,
            effective_speed=speed,
            ground_speed=speed,
            wavelength=wavelength,
            resolution=resolution,
        )
        for time in (t, t - interval)
    ]
    assert np.all((printed > 0.0) & (printed < 1.0))
    assert_allclose(overlap(*lengths, spacing=interval * speed), printed, rtol=1e-13)


@pytest.mark.parametrize("time", [0.0, 40.0, -90.0])
def test_frame_length_resolves_what_it_says_on_a_hyperbola(time):
    """The Doppler of the hyperbola runs through V_g/ρ, to the square of half the aperture angle."""
    wavelength, closest, speed, ground, resolution = 0.031, 615e3, 7360.0, 7060.0, 1.0

    def doppler(t):
        return -2.0 * speed**2 * t / (wavelength * math.hypot(closest, speed * t))

    def missing(half):
        return doppler(time - half) - doppler(time + half) - ground / resolution

    half = brentq(missing, 0.01, 20.0, xtol=1e-12)
    length = frame_length(
        time,
        closest_range=closest,
        effective_speed=speed,
        ground_speed=ground,
        wavelength=wavelength,
        resolution=resolution,
    )
    angle = length / closest
    assert_allclose(length, 2.0 * half * speed, rtol=angle**2)


def test_effective_speed_is_between_ground_and_orbit(film):
    inertial = np.linalg.norm(film.request.trajectory.inertial(film.plan.time).velocity)
    assert film.plan.ground_speed < film.frames.effective_speed < inertial
    speed = effective_speed(slant_range=600e3, doppler_rate=-5500.0, wavelength=0.03)
    assert_allclose(2.0 * speed**2 / (0.03 * 600e3), 5500.0, rtol=1e-14)


def test_exact_duration_against_differences_of_range(film):
    """Doppler from ranges 2 ms apart on the trajectory itself; the bandwidth by bisection."""
    request, plan, frames = film.request, film.plan, film.frames
    target, step = target_of(request), 1e-3

    def doppler(time):
        ends = plan.time + time + np.array([-step, step])
        ranges = np.linalg.norm(target - request.trajectory.earth_fixed(ends).position, axis=-1)
        return -(ranges[1] - ranges[0]) / step / request.wavelength

    for k in (0, 60, 100, 170, 200):
        center = frames.times[k]

        def missing(length, center=center):
            run = doppler(center - 0.5 * length) - doppler(center + 0.5 * length)
            return run - plan.ground_speed / request.resolution

        expected = brentq(missing, 0.1, 20.0, xtol=1e-9)
        # 1e-7 m of rounding in ranges is 7e-3 Hz of 7 kHz.
        assert_allclose(frames.exact.duration[k], expected, rtol=3e-6)


def test_hyperbola_is_good_at_zero_doppler_and_a_percent_off_at_the_ends(film):
    difference = film.frames.exact.length / film.frames.hyperbolic.length - 1.0
    middle = len(difference) // 2
    assert film.frames.times[middle] == 0.0
    # There only the small-angle form of eq. (2) is left: (L/R)²/8 = 2.8e-5.
    angle = film.frames.hyperbolic.length[middle] / film.plan.slant_range
    assert_allclose(difference[middle], angle**2 / 8.0, rtol=0.02)
    assert 0.005 < difference[0] < 0.015
    assert 0.005 < difference[-1] < 0.015


def test_printed_frames_are_longer_by_effective_over_ground_speed(film):
    ratio = film.frames.printed_length / film.frames.hyperbolic.length
    assert_allclose(ratio, film.frames.effective_speed / film.plan.ground_speed, rtol=1e-13)
    assert 1.03 < ratio[0] < 1.06


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9])
def test_at_the_rate_limit_frames_share_just_the_overlap_allowed(share):
    def duration(time):
        return 1.25 * (1.0 + (time / 80.0) ** 2) ** 1.5

    times = np.linspace(-100.0, 100.0, 41)
    limit = rate_limit(times, duration=duration, max_overlap=share)
    for rate, sign in ((limit, 0.0), (0.99 * limit, -1.0), (1.01 * limit, 1.0)):
        common = 0.5 * (duration(times) + duration(times - 1.0 / rate)) - 1.0 / rate
        excess = common / duration(times) - share
        assert_allclose(excess, 0.0, atol=1e-10) if sign == 0.0 else None
        assert np.all(np.sign(np.round(excess, 9)) == sign)
        if share > 0.0:
            shared = overlap(duration(times), duration(times - 1.0 / rate), spacing=1.0 / rate)
            assert_allclose(shared, common / duration(times), atol=1e-14)


def test_rate_limits_of_a_film_keep_its_overlap():
    slow = video(sasebo(max_overlap=0.5), 21, 3)
    assert any("take a frame rate of at most" in text for text in slow.warnings)
    limit = float(np.nanmin(slow.frames.exact.rate_limit))
    kept = video(sasebo(max_overlap=0.5, frame_rate=0.98 * limit), 21, 3)
    assert not any("in common" in text for text in kept.warnings)
    assert np.nanmax(kept.frames.exact.overlap) <= 0.5
    # Without common data, half the rate would do at the least.
    assert np.all(slow.frames.exact.independent_rate < slow.frames.exact.rate_limit)


def test_ground_resolution_is_where_the_frame_tells_points_apart(film):
    """A point displaced by it, in the best direction, changes the path by a wave over the frame."""
    request, frames = film.request, film.frames
    target, axes = target_of(request), horizontal_axes(target_of(request))
    around = np.linspace(0.0, np.pi, 721)
    directions = np.cos(around)[:, None] * axes[0] + np.sin(around)[:, None] * axes[1]
    for k in (0, 100, 160):
        ends = film.plan.time + frames.times[k] + np.array([-0.5, 0.5]) * frames.exact.duration[k]
        start, stop = request.trajectory.earth_fixed(ends).position

        def change(offset, start=start, stop=stop):
            point = target + offset
            return np.linalg.norm(point - stop, axis=-1) - np.linalg.norm(point - start, axis=-1)

        moved = 2.0 * np.abs(change(frames.ground_resolution[k] * directions) - change(0.0))
        # Half a step of 0.25°, and the curvature of the wave over a meter.
        assert_allclose(np.max(moved), request.wavelength, rtol=1e-5)
    assert_allclose(frames.ground_resolution[100], request.resolution, rtol=1e-4)
    assert np.all(frames.ground_resolution <= request.resolution * (1.0 + 1e-4))


def test_frames_of_a_film_are_centered_and_complete_inside(film):
    frames = film.frames
    assert len(frames.times) == 201
    assert_allclose(np.diff(frames.times), 1.0 / film.request.frame_rate)
    assert frames.complete[100]
    assert not frames.complete[0]
    assert any("reach beyond the film" in text for text in film.warnings)
    squint = np.rad2deg(frames.squint[[0, 100, 200]])
    assert_allclose(squint, [47.3, 0.0, -47.2], atol=0.05)


def test_unreachable_resolution_is_a_mask_with_a_remedy():
    result = video(sasebo(resolution=0.005), 21, 3)
    assert np.all(np.isnan(result.frames.exact.duration))
    assert not np.any(result.frames.complete)
    assert any("coarser resolution" in text for text in result.warnings)


# -- staring -------------------------------------------------------------------------------------


@every_law
@pytest.mark.parametrize("case", range(3))
def test_beam_stays_on_the_aim_point(law, case):
    result = video(films(yaw_law=law)[case], 101, 3)
    request, states = result.request, earth_fixed(result)
    assert np.all(result.profile.outcome == Staring.SOLVED)
    hit = intersect(states.position, body_axes(result)[:, 2], height=request.height)
    distance = np.linalg.norm(hit - target_of(request), axis=-1)
    # The trajectory's own rounding, of the Earth's angle, goes into the axes and the position.
    assert np.max(distance) < AIM + 10.0 * result.orbit_misfit
    first, last = result.plan.time + result.times[[0, -1]]
    orbit = smooth_orbit(request.trajectory, first, last)
    beam = Beam(request.azimuth_beamwidth, request.elevation_beamwidth)
    times = np.linspace(first, last, 57)
    smooth = orbit.states(times)
    held = hold(law, orbit, result.plan.time, target_of(request), beam)
    beams = (stare(orbit, times, held).attitude @ orbit_axes(smooth))[:, 2]
    hit = intersect(smooth.position, beams, height=request.height)
    assert np.max(np.linalg.norm(hit - target_of(request), axis=-1)) < AIM


@holding_laws
@pytest.mark.parametrize("case", range(3))
def test_chosen_direction_does_not_rotate(law, case):
    result = video(films(yaw_law=law)[case], 101, 3)
    rotation = getattr(result.distortion, HELD[law])
    assert np.nanmax(np.abs(rotation)) < TRACE
    others = [getattr(result.distortion, name) for key, name in HELD.items() if key is not law]
    assert all(np.nanmax(np.abs(other)) > 1e6 * TRACE for other in others)


@pytest.mark.parametrize(("law", "row"), [(YawLaw.AZIMUTH_TRACE, 0), (YawLaw.RANGE_TRACE, 1)])
def test_trace_held_is_where_the_antenna_plane_cuts_the_ground(law, row):
    """Planes cut along the product of their normals; no projection along the line of sight."""
    result = video(sasebo(yaw_law=law), 201, 3)
    body, up = body_axes(result), vertical(target_of(result.request))
    cut = unit(np.cross(np.cross(body[:, row], body[:, 2]), up))
    assert np.max(np.linalg.norm(cut - cut[100], axis=-1)) < TRACE * 10
    assert abs(result.profile.yaw[100]) < 1e-12


def literal_liang(result: VideoResult) -> tuple[np.ndarray, ...]:
    """Roll, pitch and yaw by eqs (8)-(12), corrected, from elements in Earth-fixed axes."""
    states = earth_fixed(result)
    momentum = unit(np.cross(states.position, inertial_velocity(states)))
    inclination = np.arccos(momentum[:, 2])
    node = np.arctan2(momentum[:, 0], -momentum[:, 1])
    latitude = np.arctan2(
        states.position[:, 2] / np.sin(inclination),
        states.position[:, 0] * np.cos(node) + states.position[:, 1] * np.sin(node),
    )

    def turn(axis, angle):
        c, s, o, e = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
        rows = {
            1: ((e, o, o), (o, c, s), (o, -s, c)),
            2: ((c, o, -s), (o, e, o), (s, o, c)),
            3: ((c, s, o), (-s, c, o), (o, o, e)),
        }[axis]
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    exchange = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])
    to_orbit = exchange @ turn(3, latitude) @ turn(1, inclination) @ turn(3, node)  # eq. (8)
    radius = np.linalg.norm(states.position, axis=-1)
    target = target_of(result.request)
    path = to_orbit @ target + radius[:, None] * np.array([0.0, 0.0, 1.0])
    x, y, z = unit(path).T
    roll, pitch = -np.arctan(y / z), np.arcsin(x)  # eq. (11)
    pointed = turn(2, pitch) @ turn(1, roll)
    middle = len(x) // 2
    ground = np.linalg.solve((pointed @ to_orbit)[middle], [1.0, 0.0, 0.0])
    up = vertical(target)
    line = (target - states.position[middle]) / np.linalg.norm(target - states.position[middle])
    reference = ground - line * (ground @ up) / (line @ up)  # on the ground
    v = np.einsum("sij,sjk,k->si", pointed, to_orbit, reference)  # eq. (12) with M2(θ)M1(φ)
    return roll, pitch, np.arctan2(v[:, 1], v[:, 0])


def test_attitude_is_liang_corrected_letter_by_letter():
    result = video(sasebo(), 4001, 3)
    roll, pitch, yaw = literal_liang(result)
    profile = result.profile
    assert_allclose(profile.roll, roll, atol=1e-12)
    assert_allclose(profile.pitch, pitch, atol=1e-12)
    assert_allclose(profile.yaw, yaw, atol=1e-12)
    roll_rate, pitch_rate, yaw_rate = (
        np.gradient(angle, result.times, edge_order=2) for angle in (roll, pitch, yaw)
    )
    rate = np.stack(  # eq. (13)
        [
            roll_rate * np.cos(yaw) * np.cos(pitch) + pitch_rate * np.sin(yaw),
            -roll_rate * np.sin(yaw) * np.cos(pitch) + pitch_rate * np.cos(yaw),
            yaw_rate + roll_rate * np.sin(pitch),
        ],
        axis=-1,
    )
    # Second order differences of 0.05 s: (0.0124/s · 0.05 s)²/6 of 0.012 rad/s.
    assert_allclose(profile.rate_orbit[1:-1], rate[1:-1], atol=1e-9)


@holding_laws
@pytest.mark.parametrize("reference", [0.0, -70.0, 35.0])
def test_yaw_and_distortion_vanish_at_the_reference_time(law, reference):
    result = video(sasebo(yaw_law=law, reference_time=reference), 201, 3)
    sample = int(np.argmin(np.abs(result.times - reference)))
    assert abs(result.profile.yaw[sample]) < 1e-9
    for change in (result.distortion.azimuth_trace, result.distortion.range_trace):
        assert abs(change[sample]) < 1e-9
        # No turn by half a circle from one sample to the next.
        assert np.max(np.abs(np.diff(change))) < np.deg2rad(1.0)


@every_law
def test_rates_against_differences(law):
    """Against the orbit frame, and inertially from the GCRS states: the requirement is 1e-10."""
    request = sasebo(yaw_law=law)
    plan = video(request, 3, 3).plan
    orbit = smooth_orbit(request.trajectory, plan.time - 105.0, plan.time + 105.0)
    beam = Beam(0.5 * request.azimuth_beamwidth, 0.5 * request.elevation_beamwidth)
    held = hold(law, orbit, plan.time, target_of(request), beam)
    for middle in (-99.0, -30.0, 0.0, 99.0):
        times = plan.time + middle + 0.2 * np.arange(-4, 5)
        profile = staring_profile(orbit, times, held)
        differences = angular_rates(
            times, profile.attitude, orbit_axes=orbit_axes(orbit.states(times))
        )
        assert_allclose(profile.rate_orbit[2:-2], differences.orbit[2:-2], atol=RATE)
        assert_allclose(profile.rate_inertial[2:-2], differences.inertial[2:-2], atol=RATE)
        position, velocity = request.trajectory.inertial(times)
        radial, normal = unit(position), unit(np.cross(position, velocity))
        frame = np.stack([np.cross(normal, radial), -normal, -radial], axis=-2)
        still = np.broadcast_to(np.eye(3), frame.shape)
        inertially = angular_rates(times, profile.attitude @ frame, orbit_axes=still).orbit
        # The Earth is taken to turn about the ITRS z axis: 0.3″ of polar motion are 1e-10 rad/s,
        # and tilt the orbit frame by 1e-7 rad.
        assert_allclose(profile.rate_inertial[2:-2], inertially[2:-2], atol=3.0 * RATE)
        accelerations = np.gradient(profile.rate_inertial, times, axis=0)
        # Differences over 0.4 s here, 0.16 s there.
        assert_allclose(profile.acceleration_inertial[4], accelerations[4], atol=1e-8)


def test_quaternions_go_with_the_attitude(film):
    profile = film.profile
    jumps = np.linalg.norm(np.diff(profile.quaternion_inertial, axis=0), axis=-1)
    assert np.max(jumps) < 0.01
    assert_allclose(np.linalg.norm(profile.quaternion_orbit, axis=-1), 1.0, atol=1e-12)


def test_shortest_rotation_turns_about_an_axis_across_the_beam():
    profile = video(sasebo(yaw_law=YawLaw.SHORTEST_ROTATION), 101, 3).profile
    assert_allclose(profile.attitude[:, 0, 1], profile.attitude[:, 1, 0], atol=1e-14)


def test_pitch_of_90_degrees_is_flagged_and_has_rates():
    """A point straight ahead, level with the satellite: only the Euler angles suffer.

    No point of the Earth is there: what sees the satellite is below its horizontal.
    """
    request = sasebo()
    orbit = smooth_orbit(request.trajectory, -10.0, 10.0)
    states = orbit.states(np.array([0.0]))
    ahead = states.position[0] + 1e6 * orbit_axes(states)[0, 0]
    times = 0.1 * np.arange(-4, 5)
    held = Held(YawLaw.AZIMUTH_TRACE, ahead, vertical(ahead), vertical(ahead), Beam(0.01, 0.02))
    now = stare(orbit, times, held)
    differences = angular_rates(times, now.attitude, orbit_axes=orbit_axes(orbit.states(times)))
    assert_allclose(now.rate_orbit, differences.orbit, atol=RATE)
    assert euler_sequence(now.attitude[4], EulerSequence.ONE_TWO_THREE).singular
    assert np.all(staring_profile(orbit, times, held).outcome == Staring.BELOW_HORIZON)


def test_film_of_the_nadir():
    """Straight overhead nothing is singular, once the incidence may be so small."""
    trajectory = KeplerianOrbit.circular(
        altitude=600e3, inclination=math.pi / 2, epoch=datetime(2024, 1, 1, tzinfo=UTC)
    )
    below = to_geodetic(trajectory.earth_fixed(500.0).position)
    request = sasebo(
        trajectory=trajectory,
        latitude=float(below.latitude),
        longitude=float(below.longitude),
        start=400.0,
        stop=600.0,
        duration=60.0,
        pointing_error=(0.0, 0.0, 0.0),
    )
    with pytest.raises(ValueError, match="too near to the satellite's nadir"):
        video(request)
    for law in YawLaw:
        result = video(dataclasses.replace(request, near_incidence=0.0, yaw_law=law), 101, 3)
        assert np.all(result.profile.outcome == Staring.SOLVED)
        assert np.all(np.isfinite(result.profile.rate_inertial))
        assert np.all(np.isfinite(result.distortion.shear))


# -- footprints ----------------------------------------------------------------------------------


def outline_about_the_target(result: VideoResult, beam: Beam) -> np.ndarray:
    """East and north of a small outline, exactly intersected, at the samples, (S, V, 2)."""
    target = target_of(result.request)
    seen = footprints(result.times, earth_fixed(result), result.profile.attitude, target, beam=beam)
    corners = from_geodetic(
        latitude=seen.latitude, longitude=seen.longitude, height=result.request.height
    )
    return (corners - target) @ horizontal_axes(target).T


@every_law
def test_distortion_against_intersected_outlines(law):
    """Small beams, so that the ground is flat: 1e-5 rad is 6 m."""
    result = video(sasebo(yaw_law=law), 41, 3)
    ratio = result.request.elevation_beamwidth / result.request.azimuth_beamwidth
    beam = Beam(1e-5, 1e-5 * ratio)
    outlines = outline_about_the_target(result, beam)
    quarter = outlines.shape[1] // 4
    forward, side = outlines[:, 0], outlines[:, quarter]  # corners on the X and on the Y plane
    left = result.distortion

    def turned(vector):
        angle = np.unwrap(np.arctan2(vector[:, 1], vector[:, 0]))
        return angle - angle[20]

    assert_allclose(left.azimuth_trace, turned(forward), atol=1e-4)
    assert_allclose(left.range_trace, turned(side), atol=1e-4)
    assert_allclose(left.shear, turned(side) - turned(forward), atol=2e-4)
    stretch = np.linalg.norm(forward, axis=-1) / np.linalg.norm(forward[20])
    assert_allclose(left.azimuth_stretch, stretch, rtol=1e-4)
    covariance = np.swapaxes(outlines, 1, 2) @ outlines
    axis = np.linalg.eigh(covariance).eigenvectors[:, :, 1]
    along = np.abs(np.sum(axis * axis[20], axis=-1))
    assert_allclose(np.cos(left.major_axis), along, atol=1e-4)


def test_area_of_outlines_is_that_of_the_ellipse(film):
    beam = Beam(1e-4, 3e-4)
    target = target_of(film.request)
    states = earth_fixed(film)
    seen = footprints(film.times, states, film.profile.attitude, target, beam=beam)
    ground = footprint_map(states, film.profile.attitude, target)
    polygon = 72 / 2 * math.sin(math.tau / 72)  # of 72 corners on the unit circle, instead of π
    expected = polygon * beam.azimuth * beam.elevation * np.abs(np.linalg.det(ground))
    assert_allclose(seen.area, expected, rtol=1e-3)
    # Slanted by the incidence: R² cos⁻¹ of what the beam cuts from a sphere.
    look = look_at(states, target)
    assert_allclose(
        np.abs(np.linalg.det(ground)), look.slant_range**2 / np.cos(look.incidence), rtol=1e-9
    )
    assert_allclose(film.distortion.area[200], 1.0, atol=1e-12)


def test_common_area_lies_within_every_footprint(film):
    seen = film.footprints
    target = target_of(film.request)
    axes = horizontal_axes(target)

    def level(latitude, longitude):
        return (from_geodetic(latitude=latitude, longitude=longitude) - target) @ axes.T

    common = level(seen.common_latitude, seen.common_longitude)
    assert 0.0 < seen.common_area <= np.min(seen.area) * (1.0 + 1e-9)
    for latitude, longitude in zip(seen.latitude, seen.longitude, strict=True):
        outline = level(latitude, longitude)
        edge = np.roll(outline, -1, axis=0) - outline
        gap = common[:, None] - outline
        side = edge[:, 0] * gap[..., 1] - edge[:, 1] * gap[..., 0]
        inward = np.sign(np.sum(edge[:, 0] * outline[:, 1] - edge[:, 1] * outline[:, 0])) * -1.0
        distance = inward * side / np.linalg.norm(edge, axis=-1)
        # The surface bends away from the tangent plane, and back: meters at 20 km.
        assert np.min(distance) > -1.0


def test_what_the_laws_leave_over_sasebo(film):
    """A beam four times longer in range: to hold the azimuth trace sees less than no yaw at all."""
    left = {summary.law: summary for summary in film.laws}
    assert list(left) == list(YawLaw)
    shares = {law: summary.common_area for law, summary in left.items()}
    assert shares[YawLaw.AZIMUTH_TRACE] < shares[YawLaw.NONE] < 0.65
    assert shares[YawLaw.RANGE_TRACE] > 0.99
    assert shares[YawLaw.MAJOR_AXIS] > 0.99
    assert np.rad2deg(left[YawLaw.AZIMUTH_TRACE].range_trace) == pytest.approx(38.2, abs=0.1)
    assert np.rad2deg(left[YawLaw.RANGE_TRACE].azimuth_trace) == pytest.approx(20.5, abs=0.1)
    assert all(summary.solved == 1.0 for summary in film.laws)


# -- pointing errors -----------------------------------------------------------------------------


def disturbed(result: VideoResult, sample: int, turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Center [m, east and north] and azimuth of the X trace after turns (T, 3), by intersection."""
    target = target_of(result.request)
    up, axes = vertical(target), horizontal_axes(target)
    states, body = earth_fixed(result), body_axes(result)[sample]
    about = turns @ body
    moved = body + np.cross(about[:, None, :], body)
    path = target - states.position[sample]
    reach = (path @ up) / (moved[:, 2] @ up)
    center = (states.position[sample] + reach[:, None] * moved[:, 2] - target) @ axes.T
    cut = np.cross(np.cross(moved[:, 0], moved[:, 2]), up) @ axes.T
    cut *= np.sign(cut @ cut[0])[:, None]
    return center, np.arctan2(cut[:, 1], cut[:, 0])


@pytest.mark.parametrize("sample", [0, 130, 200, 400])
def test_pointing_effect_against_differences(film, sample):
    step = 1e-6
    turns = step * np.concatenate([np.eye(3), -np.eye(3)])
    center, azimuth = disturbed(film, sample, turns)
    per_turn = (center[:3] - center[3:]).T / (2.0 * step)
    assert_allclose(film.pointing.center_per_turn[sample], per_turn, rtol=1e-7, atol=0.5)
    rotation = (azimuth[:3] - azimuth[3:]) / (2.0 * step)
    assert_allclose(film.pointing.rotation_per_turn[sample], rotation, atol=1e-7)


@pytest.mark.parametrize("sample", [0, 200])
def test_pointing_effect_against_monte_carlo(film, sample):
    rng = np.random.default_rng(2018)
    turns = rng.normal(size=(40_000, 3)) * np.array(film.request.pointing_error)
    center, azimuth = disturbed(film, sample, turns)
    # Standard deviations from 40 000 draws: 0.35 %, one sigma.
    distance = math.sqrt(np.mean(np.sum(center**2, axis=-1)))
    assert_allclose(film.pointing.center[sample], distance, rtol=0.015)
    assert_allclose(film.pointing.rotation[sample], np.std(azimuth), rtol=0.015)


def test_yaw_error_rotates_and_at_a_slant_so_does_roll(film):
    """Liang gives all rotation to the yaw; at the ends of this film roll rotates as much."""
    assert np.all(film.pointing.center_per_turn[..., 2] == 0.0)
    rotation = np.abs(film.pointing.rotation_per_turn)
    assert rotation[200, 0] < 0.05 * rotation[200, 2]
    assert rotation[0, 0] > rotation[0, 2]


# -- the film of Sasebo --------------------------------------------------------------------------


@pytest.mark.parametrize("orbit", list(LIANG["orbits"]))
def test_sasebo_with_inferred_inputs(orbit):
    result = video(sasebo(orbit), 2001, 3)
    computed, plan = LIANG["orbits"][orbit]["computed"], result.plan
    # Elements are given to 1e-6°, 0.1 m along track.
    assert abs((plan.epoch - LIANG["printed"]["zero_doppler"]).total_seconds()) < 1e-3
    assert math.degrees(plan.look_angle) == pytest.approx(LIANG["inferred"]["look_deg"], abs=1e-4)
    assert plan.side is LookSide.RIGHT
    assert plan.ascending
    pitch = np.rad2deg(result.profile.pitch)
    assert pitch[0] == pytest.approx(computed["pitch_start_deg"], abs=0.005)
    assert pitch[-1] == pytest.approx(computed["pitch_stop_deg"], abs=0.005)
    about_y = [
        math.degrees(np.max(np.abs(rate[:, 1])))
        for rate in (result.profile.rate_orbit, result.profile.rate_inertial)
    ]
    assert about_y[0] == pytest.approx(computed["pitch_rate_orbit_deg_s"], abs=5e-5)
    assert about_y[1] == pytest.approx(computed["pitch_rate_inertial_deg_s"], abs=5e-5)
    # "mainly by large pitch, the roll maneuver is small": section 4 of the paper.
    assert np.ptp(np.rad2deg(result.profile.roll)) < 7.0


def test_figures_of_the_mean_radius_round_to_those_expected():
    computed = LIANG["orbits"]["mean_radius"]["computed"]
    assert round(computed["pitch_start_deg"]) == 49
    assert round(computed["pitch_rate_orbit_deg_s"], 2) == 0.67
    assert round(computed["pitch_rate_inertial_deg_s"], 2) == 0.72


# -- messages and masks --------------------------------------------------------------------------


def test_point_that_is_never_seen_says_why():
    with pytest.raises(ValueError, match=r"is not imaged from .* search longer"):
        video(sasebo(latitude=math.radians(-60.0)))
    with pytest.raises(ValueError, match="on the right of the flight direction"):
        video(sasebo(side=LookSide.LEFT))


def test_film_longer_than_the_view_is_masked():
    result = video(sasebo(duration=900.0, frame_rate=0.2), 181, 31)
    hidden = result.profile.outcome == Staring.BELOW_HORIZON
    assert 0 < np.count_nonzero(hidden) < 100
    visible = look_at(earth_fixed(result), target_of(result.request)).visible
    assert np.array_equal(hidden, ~visible)
    assert np.all(np.isnan(result.profile.attitude[hidden]))
    assert np.all(np.isfinite(result.profile.rate_inertial[~hidden]))
    assert any("above its horizon" in text for text in result.warnings)
    assert np.all(np.isnan(result.frames.exact.duration[[0, -1]]))
    with pytest.raises(ValueError, match="take a shorter time"):
        video_scene(result)


def test_round_beam_has_no_major_axis_to_hold():
    wide = math.radians(1.0)
    result = video(
        sasebo(yaw_law=YawLaw.MAJOR_AXIS, azimuth_beamwidth=wide, elevation_beamwidth=wide), 21, 3
    )
    assert np.all(result.profile.outcome == Staring.AXIS_LOST)
    assert any("hold the azimuth or the range trace" in text for text in result.warnings)
    nearly = video(
        sasebo(yaw_law=YawLaw.MAJOR_AXIS, azimuth_beamwidth=wide, elevation_beamwidth=1.3 * wide),
        201,
        3,
    )
    lost = nearly.profile.outcome == Staring.AXIS_LOST
    assert 0 < np.count_nonzero(lost) < 201
    assert np.nanmax(np.abs(nearly.distortion.major_axis)) < TRACE


def test_major_axis_is_lost_where_the_slant_makes_it_the_minor_one():
    """Straight overhead on the equator: the slant stretches along the track, the beam across it."""
    epoch = datetime(2024, 1, 1, tzinfo=UTC)
    trajectory = KeplerianOrbit.circular(altitude=600e3, inclination=0.0, epoch=epoch)
    below = to_geodetic(trajectory.earth_fixed(500.0).position)
    request = sasebo(
        trajectory=trajectory,
        latitude=0.0,
        longitude=float(below.longitude),
        start=400.0,
        stop=600.0,
        near_incidence=0.0,
        yaw_law=YawLaw.MAJOR_AXIS,
        azimuth_beamwidth=0.010,
        elevation_beamwidth=0.013,
    )
    result = video(request, 201, 3)
    incidence = look_at(earth_fixed(result), target_of(request)).incidence
    solved = result.profile.outcome == Staring.SOLVED
    assert np.array_equal(solved, 1.0 / np.cos(incidence) < 1.3)
    assert 20 < np.count_nonzero(solved) < 180
    assert np.nanmax(np.abs(result.distortion.major_axis)) < TRACE


def test_direction_along_the_line_of_sight_leaves_the_turn_open():
    request = sasebo()
    orbit = smooth_orbit(request.trajectory, -10.0, 10.0)
    target = target_of(request)
    line = unit(target - orbit.states(0.0).position)
    held = Held(YawLaw.AZIMUTH_TRACE, target, vertical(target), line, Beam(0.01, 0.01))
    profile = staring_profile(orbit, np.array([0.0, 5.0]), held)
    assert list(profile.outcome) == [Staring.UNDEFINED, Staring.SOLVED]
    assert np.all(np.isnan(profile.rate_orbit[0]))


def test_agility_that_would_not_do_is_masked():
    limits = Agility(max_rate=math.radians(0.6), max_acceleration=math.radians(0.003))
    result = video(sasebo(agility=limits), 201, 3)
    profile = result.profile
    speed = np.linalg.norm(profile.rate_inertial, axis=-1)
    assert np.array_equal(profile.rate_exceeded, speed > math.radians(0.6))
    assert 0 < np.count_nonzero(profile.rate_exceeded) < 201
    assert np.any(profile.acceleration_exceeded)
    assert any("turn faster" in text for text in result.warnings)
    assert any("accelerate more" in text for text in result.warnings)
    by_axis = Agility(max_rate=(1.0, math.radians(0.6), 1.0))
    about_y = video(sasebo(agility=by_axis), 201, 3).profile
    expected = np.abs(about_y.rate_inertial[:, 1]) > math.radians(0.6)
    assert np.array_equal(about_y.rate_exceeded, expected)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("frame_rate", 0.0, "1/s"),
        ("duration", math.nan, "positive"),
        ("azimuth_beamwidth", 2.0, "radians"),
        ("max_overlap", 1.0, "below 1"),
        ("reference_time", 101.0, "at most half"),
        ("pointing_error", (0.1, 0.0), "about X, Y and Z"),
        ("latitude", 33.0, "π/2"),
        ("resolution", -1.0, "positive"),
    ],
)
def test_bad_request_says_what_is_needed(name, value, said):
    with pytest.raises(ValueError, match=said):
        sasebo(**{name: value})


def test_too_few_samples():
    with pytest.raises(ValueError, match="outlines = 1"):
        video(sasebo(), 11, 1)


def test_orbit_that_ends_within_the_film_says_so():
    @dataclasses.dataclass(frozen=True)
    class Ending:
        """The same orbit, known until 50 s after zero Doppler."""

        orbit: KeplerianOrbit
        span: tuple[float, float] = (-1000.0, 50.0)

        @property
        def epoch(self):
            return self.orbit.epoch

        @property
        def source(self):
            return self.orbit.source

        @property
        def perturbed(self):
            return self.orbit.perturbed

        def inertial(self, times):
            return self.orbit.inertial(times)

        def earth_fixed(self, times):
            return self.orbit.earth_fixed(times)

    with pytest.raises(ValueError, match=r"the orbit is needed from .* to 100\.\d+ s"):
        video(sasebo(trajectory=Ending(sasebo().trajectory)))


# -- scene ---------------------------------------------------------------------------------------


def test_scene_of_a_film(film):
    found = video_scene(film, 9)
    scene, states = (
        found.scene,
        film.request.trajectory.earth_fixed(film.plan.time + np.linspace(-100.0, 100.0, 9)),
    )
    assert_allclose(scene.times, np.arange(0.0, 201.0, 25.0))
    assert (film.plan.epoch - found.epoch).total_seconds() == pytest.approx(100.0, abs=1e-5)
    distance = np.linalg.norm(target_of(film.request) - states.position, axis=-1)
    assert_allclose(scene.slant_range, distance, rtol=1e-12)
    assert scene.azimuth[0] > -np.pi / 2 > scene.azimuth[-1]  # ahead to behind, on the right
    assert scene.incidence[4] == pytest.approx(film.plan.incidence)
    assert len(video_scene(film, 1).scene) == 1
    with pytest.raises(ValueError, match="segments = 0"):
        video_scene(film, 0)
