"""Scenes from orbits: when targets are seen, how, and what is said when they are not."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from formation import Elements, Ephemeris, KeplerianOrbit, States, raan_from_local_time
from formation.constants import EARTH_GRAVITATIONAL_PARAMETER, EARTH_ROTATION_RATE
from insar import HeldConstant, LookSide
from insar.baselines import sensitivity
from insar.observe.boresight import FixedIncidence, FixedLook
from insar.observe.doppler import doppler_centroid, doppler_rate
from insar.observe.earth import from_geodetic, to_geodetic, vertical
from insar.observe.frames import rtn_axes
from insar.observe.look import look_at
from insar.observe.scenes.crossings import (
    nearest_crossings,
    refine_root,
    sample_blocks,
    zero_doppler,
)
from insar.observe.scenes.observation import Reference
from insar.observe.scenes.observing import observe, observe_arc
from insar.observe.scenes.passes import Direction
from insar.observe.scenes.targets import Targets
from insar.observe.scenes.windows import Window
from insar.observe.steering import Law, steer

EPOCH = datetime(2025, 6, 21, tzinfo=UTC)
DAY = 86400.0
WAVELENGTH = 0.031
ETNA = Path(__file__).parent.parent / "configs" / "areas" / "etna.geojson"
SUMMIT = Targets.from_points(
    latitude=np.radians(37.751), longitude=np.radians(14.994), height=3357.0
)


@dataclass(frozen=True)
class Simple:
    """A circle about a point mass over an Earth that turns evenly: nothing of this project."""

    altitude: float
    inclination: float
    node: float = 0.0
    start: float = 0.0
    first: float = -np.inf
    last: float = np.inf

    epoch = EPOCH
    source = "a circle"
    perturbed = False

    @property
    def span(self):
        return self.first, self.last

    def inertial(self, times):
        t = np.asarray(times, dtype=float)
        radius = 6378137.0 + self.altitude
        rate = np.sqrt(EARTH_GRAVITATIONAL_PARAMETER / radius**3)
        node = np.array([np.cos(self.node), np.sin(self.node), 0.0])
        pole = np.array([0.0, 0.0, 1.0])
        ahead = np.cos(self.inclination) * np.cross(pole, node) + np.sin(self.inclination) * pole
        u = (self.start + rate * t)[..., None]
        return States(
            radius * (np.cos(u) * node + np.sin(u) * ahead),
            radius * rate * (np.cos(u) * ahead - np.sin(u) * node),
        )

    def earth_fixed(self, times):
        t = np.asarray(times, dtype=float)
        assert np.all((t >= self.first) & (t <= self.last)), "asked beyond the span"
        angle = EARTH_ROTATION_RATE * t
        position, velocity = self.inertial(t)

        def turn(vector):
            x, y, z = np.moveaxis(vector, -1, 0)
            c, s = np.cos(angle), np.sin(angle)
            return np.stack([c * x + s * y, c * y - s * x, z], axis=-1)

        fixed = turn(position)
        spin = np.cross([0.0, 0.0, EARTH_ROTATION_RATE], fixed)
        return States(fixed, turn(velocity) - spin)


SIMPLE = Simple(altitude=514e3, inclination=np.radians(97.44), node=5.6)


@pytest.fixture(scope="module")
def orbit():
    """The dusk-dawn orbit of 514 km, slightly eccentric and with J2."""
    node = raan_from_local_time(18 * 3600.0, epoch=EPOCH)
    elements = Elements(6892137.0, 0.0012, np.radians(97.44), node, np.pi / 2, 0.0)
    return KeplerianOrbit(elements=elements, epoch=EPOCH)


@pytest.fixture(scope="module")
def etna():
    return Targets.from_geojson(ETNA.read_text(encoding="utf-8"), height=1000.0)


def seen(trajectory, targets, **changes):
    options = {"wavelength": WAVELENGTH, "side": LookSide.RIGHT, "stop": 11 * DAY} | changes
    return observe(trajectory, targets, **options)


def swept(trajectory, **changes):
    options = {
        "wavelength": WAVELENGTH,
        "side": LookSide.RIGHT,
        "stop": DAY,
        "boresight": FixedIncidence(np.radians(35)),
    } | changes
    return observe_arc(trajectory, **options)


def points_of(observation):
    return from_geodetic(
        latitude=observation.latitude, longitude=observation.longitude, height=observation.height
    )


def times_of(observation, trajectory):
    """Seconds since the trajectory's epoch, to the microsecond of a datetime."""
    return (observation.epoch - trajectory.epoch) / timedelta(seconds=1) + observation.scene.times


# -- the moment ----------------------------------------------------------------------------------


@pytest.mark.parametrize("law", list(Law))
@pytest.mark.parametrize("side", list(LookSide))
def test_targets_are_on_the_center_line_of_the_beam_on_the_look_side(orbit, etna, law, side):
    observation = seen(orbit, etna, law=law, side=side, reference=Reference.AS_OBSERVED)
    states = orbit.earth_fixed(times_of(observation, orbit))
    steering = steer(law, states, boresight=observation.boresight, side=side)
    line = look_at(states, points_of(observation)).line_of_sight
    # A microsecond of the epoch is 8 mm at 600 km: 1.3e-8 rad.
    assert_allclose(np.vecdot(line, steering.antenna[:, 0]), 0.0, atol=2e-8)
    assert np.all(np.sign(observation.scene.azimuth) == side)
    assert len(observation.scene) == 25
    assert observation.missed_reasons == ()


@pytest.mark.parametrize("law", list(Law))
@pytest.mark.parametrize("reference", list(Reference))
def test_the_beam_is_aimed_at_a_single_target_of_any_height(orbit, law, reference):
    observation = seen(orbit, SUMMIT, law=law, reference=reference)
    # The incidence of the boresight is on the ellipsoid; 1e-7 rad is 6 cm on the ground.
    assert_allclose(observation.off_boresight, 0.0, atol=1e-7)
    assert isinstance(observation.boresight, FixedIncidence)


def test_a_boresight_that_is_given_is_kept(orbit, etna):
    boresight = FixedLook(np.radians(25))
    observation = seen(orbit, etna, boresight=boresight)
    assert observation.boresight is boresight
    look = observation.scene.look_angle
    assert_allclose(observation.off_boresight, look - boresight.angle, atol=2e-4)


def test_the_moment_of_zero_doppler_is_that_of_closest_approach(orbit, etna):
    """Found by minimizing the range, which never uses a velocity."""
    observation = seen(orbit, etna, law=Law.NONE)
    for moment, point, slant_range in zip(
        times_of(observation, orbit), points_of(observation), observation.scene.slant_range,
        strict=True,
    ):  # fmt: skip

        def distance(t, point=point):
            return np.linalg.norm(orbit.earth_fixed(t).position - point)

        best = minimize_scalar(
            distance, bounds=(moment - 20, moment + 20), method="bounded", options={"xatol": 1e-6}
        )
        # Range is flat at its minimum: rounding of 1e-10 m hides 0.1 ms.
        assert_allclose(moment, best.x, atol=2e-3)
        assert_allclose(slant_range, best.fun, atol=1e-4)


@pytest.mark.parametrize("law", [Law.NONE, Law.YAW, Law.PITCH_ROLL])
def test_the_moment_as_observed_is_found_by_sampling_too(orbit, law):
    boresight = FixedIncidence(np.radians(35))
    observation = seen(orbit, SUMMIT, law=law, boresight=boresight, reference=Reference.AS_OBSERVED)
    moment = times_of(observation, orbit)[0]
    times = moment + np.linspace(-30, 30, 6001)
    states = orbit.earth_fixed(times)
    steering = steer(law, states, boresight=boresight, side=LookSide.RIGHT)
    line = look_at(states, SUMMIT.position).line_of_sight
    # Nothing but the angle off the plane, at 10 ms, and the line through its sign change.
    angle = np.arcsin(np.vecdot(line, steering.antenna[:, 0]))
    after = int(np.argmax(angle < 0.0))
    crossing = np.interp(0.0, angle[[after, after - 1]], times[[after, after - 1]])
    assert_allclose(moment, crossing, atol=2e-6)


def test_exact_steering_observes_at_zero_doppler(orbit, etna):
    one, other = (seen(orbit, etna, reference=reference) for reference in Reference)
    assert_allclose(one.doppler, 0.0, atol=1e-3)  # 1e-7 s of 7 kHz/s
    assert one.epoch - other.epoch <= timedelta(microseconds=1)
    assert_allclose(one.scene.azimuth, other.scene.azimuth, atol=1e-10)


def test_the_reference_matters_for_a_beam_that_is_not_steered(orbit, etna):
    observed, focused = (
        seen(orbit, etna, law=Law.NONE, reference=reference)
        for reference in (Reference.AS_OBSERVED, Reference.ZERO_DOPPLER)
    )
    # The target's Doppler falls to zero at its rate; 5 % for the change of the rate meanwhile.
    states = orbit.earth_fixed(times_of(observed, orbit))
    rate = doppler_rate(states, points_of(observed), wavelength=WAVELENGTH)
    delay = (focused.epoch - observed.epoch).total_seconds()
    assert_allclose(delay, (-observed.doppler / rate)[0], rtol=0.05)
    assert 3.0 < delay < 4.0
    assert_allclose(np.abs(observed.scene.azimuth), np.pi / 2, atol=1e-9)
    assert np.all(np.abs(np.abs(focused.scene.azimuth) - np.pi / 2) > np.radians(2))
    # The Doppler as observed does not depend on the reference.
    assert_allclose(np.sort(observed.doppler), np.sort(focused.doppler), atol=1e-3)
    assert np.all(np.abs(focused.doppler) > 1e4)


# -- the passes ----------------------------------------------------------------------------------


def test_no_pass_is_missed():
    """Against every 2 s of three days, by closest approach: which revolutions see the target."""
    near, far = np.radians([20, 55])
    observation = seen(SIMPLE, SUMMIT, stop=3 * DAY)
    times = np.arange(0.0, 3 * DAY, 2.0)
    states = SIMPLE.earth_fixed(times)
    look = look_at(states, SUMMIT.position)
    nearest = np.flatnonzero(
        (look.slant_range[1:-1] < look.slant_range[:-2])
        & (look.slant_range[1:-1] < look.slant_range[2:])
        & look.visible[1:-1]
        & (look.azimuth[1:-1] < 0)
    )
    incidence = look.incidence[1:-1][nearest]
    assert observation.passes == np.count_nonzero((incidence > near) & (incidence < far)) > 1
    first = times[1:-1][nearest][(incidence > near) & (incidence < far)][0]
    assert_allclose(times_of(observation, SIMPLE)[0], first, atol=2.0)


def test_passes_are_numbered_in_time_and_any_can_be_taken():
    observations = [seen(SIMPLE, SUMMIT, stop=4 * DAY, number=n + 1) for n in range(4)]
    assert [o.pass_number for o in observations] == [1, 2, 3, 4]
    assert all(o.passes == observations[0].passes for o in observations)
    epochs = [o.epoch for o in observations]
    assert epochs == sorted(epochs)
    with pytest.raises(ValueError, match=r"number = 99: the search finds \d+ passes; take 1 to"):
        seen(SIMPLE, SUMMIT, stop=4 * DAY, number=99)


@pytest.mark.parametrize("direction", [Direction.ASCENDING, Direction.DESCENDING])
def test_only_the_wanted_direction_is_taken(direction):
    observation = seen(SIMPLE, SUMMIT, direction=direction)
    assert observation.ascending == (direction is Direction.ASCENDING)
    both = seen(SIMPLE, SUMMIT)
    assert observation.passes < both.passes


def test_the_pass_that_sees_most_targets_is_taken_and_the_rest_have_reasons():
    """A line across the track: under it, near it, in the strip, and beyond."""
    center = seen(SIMPLE, SUMMIT, direction=Direction.DESCENDING)
    targets = Targets.from_points(
        latitude=np.radians([37.75, 37.75, 37.75, 37.75, 37.75, -37.75]),
        longitude=np.degrees(SUMMIT.longitude) * np.pi / 180
        + np.radians([0.0, -0.3, -14.0, 20.0, 4.5, 180.0]),
    )
    options = {
        "boresight": center.boresight,
        "near_incidence": np.radians(30),
        "far_incidence": np.radians(50),
        "start": times_of(center, SIMPLE)[0] - 600.0,
        "stop": times_of(center, SIMPLE)[0] + 600.0,
    }
    observation = seen(SIMPLE, targets, **options)
    total = len(observation.scene) + len(observation.missed_reasons)
    assert total == 6
    assert len(observation.missed_latitude) == len(observation.missed_reasons)
    text = " | ".join(observation.missed_reasons)
    assert "on the left of the track, at incidence" in text
    assert "is above the strip's 50.00°" in text
    assert "not in view of the beam during the pass" in text


def test_a_later_pass_that_sees_more_is_preferred():
    second = seen(SIMPLE, SUMMIT, stop=4 * DAY, number=2)
    middle = np.array([second.near_latitude, second.far_latitude]).mean(axis=0)[60]
    longitude = np.array([second.near_longitude, second.far_longitude]).mean(axis=0)[60]
    both = Targets.from_points(
        latitude=[SUMMIT.latitude[0], middle], longitude=[SUMMIT.longitude[0], longitude]
    )
    first = seen(SIMPLE, both, stop=4 * DAY, number=1)
    best = seen(SIMPLE, both, stop=4 * DAY)
    assert len(first.scene) == 1
    assert len(best.scene) == 2
    assert best.pass_number > 1
    assert abs(best.epoch - second.epoch) < timedelta(seconds=60)


def test_a_target_too_near_the_track_has_its_incidence_as_the_reason():
    """The near edge of the strip is 20° here; the strip of the second search begins at 21°."""
    first = seen(SIMPLE, SUMMIT)
    targets = Targets.from_points(
        latitude=[first.latitude[0], first.near_latitude[60]],
        longitude=[first.longitude[0], first.near_longitude[60]],
    )
    moment = times_of(first, SIMPLE)[0]
    observation = seen(
        SIMPLE, targets, near_incidence=np.radians(21), start=moment - 600, stop=moment + 600
    )
    assert len(observation.scene) == 1
    assert observation.missed_reasons == ("incidence 20.00° is below the strip's 21.00°",)


def test_targets_a_quarter_of_the_orbit_apart_are_two_passes():
    arc = swept(SIMPLE, argument_of_latitude=(0.2, 0.2 + 0.8), segments=2)
    targets = Targets.from_points(latitude=arc.latitude, longitude=arc.longitude)
    assert len(seen(SIMPLE, targets, stop=6000.0).scene) == 2
    arc = swept(SIMPLE, argument_of_latitude=(0.2, 0.2 + 1.7), segments=2)
    targets = Targets.from_points(latitude=arc.latitude, longitude=arc.longitude)
    apart = seen(SIMPLE, targets, stop=6000.0)
    assert (len(apart.scene), apart.passes) == (1, 2)
    assert apart.missed_reasons == ("not in view of the beam during the pass",)


# -- the geometry --------------------------------------------------------------------------------


@pytest.mark.parametrize("reference", list(Reference))
@pytest.mark.parametrize("law", [Law.NONE, Law.YAW_PITCH])
@pytest.mark.parametrize("side", list(LookSide))
def test_sensitivity_is_that_of_a_target_raised_at_constant_range_and_doppler(
    orbit, etna, law, reference, side
):
    """The raised target is solved for on the real ellipsoid, from range, Doppler and height."""
    observation = seen(orbit, etna, law=law, reference=reference, side=side)
    scene, times = observation.scene, times_of(observation, orbit)
    baseline = np.array([300.0, 1201.0, 500.0])
    rise = sensitivity(scene, HeldConstant.DOPPLER)
    predicted = -(rise.height_direction @ baseline) / rise.height_lever
    for index in (0, 12, 24):
        states = orbit.earth_fixed(times[index])
        point = points_of(observation)[index]
        offset = baseline @ rtn_axes(states)
        up, down = (raised(states, point, height) for height in (50.0, -50.0))

        def path(target, states=states, offset=offset):
            """Component of the baseline along the line of sight: no curvature of the wavefront."""
            return -offset @ look_at(states, target).line_of_sight

        brute = (path(up) - path(down)) / 100.0
        # The scene takes the vertical in the plane of the line of sight, 0.1° off. At zero Doppler
        # that is of second order; 4° from it, 0.1° × 4°.
        squinted = law is Law.NONE and reference is Reference.AS_OBSERVED
        assert_allclose(brute, predicted[index], rtol=3e-4 if squinted else 2e-6)


def raised(states, point, height):
    """Target at another height with the same range and Doppler, by Newton's method."""
    wanted = range_doppler_height(states, point) + np.array([0.0, 0.0, height])
    target = point
    for _ in range(6):
        path = target - states.position
        line = path / np.linalg.norm(path)
        across = (states.velocity - line * (line @ states.velocity)) / np.linalg.norm(path)
        slopes = np.stack([line, across, vertical(target)])
        target = target + np.linalg.solve(slopes, wanted - range_doppler_height(states, target))
    # 1 µm of range and height; 1e-9 m/s of range rate, a millionth of what 1 m of height does.
    assert_allclose(range_doppler_height(states, target), wanted, rtol=0, atol=1e-6)
    return target


def range_doppler_height(states, target):
    path = target - states.position
    distance = np.linalg.norm(path)
    return np.array([distance, path @ states.velocity / distance, to_geodetic(target).height])


def test_the_scene_has_the_true_range_incidence_and_velocity(orbit, etna):
    observation = seen(orbit, etna)
    states = orbit.earth_fixed(times_of(observation, orbit))
    path = points_of(observation) - states.position
    scene = observation.scene
    assert_allclose(scene.slant_range, np.linalg.norm(path, axis=-1), atol=1e-2)
    # Back from RTN: the line of sight and the velocity are those of the Earth-fixed axes.
    axes = rtn_axes(states)
    back = np.einsum("sij,si->sj", axes, scene.line_of_sight)
    assert_allclose(back, path / scene.slant_range[:, None], atol=3e-8)
    back = np.einsum("sij,si->sj", axes, scene.velocity_direction)
    speed = np.linalg.norm(states.velocity, axis=-1, keepdims=True)
    assert_allclose(back, states.velocity / speed, atol=3e-8)
    up = vertical(points_of(observation))
    cosine = -np.vecdot(up, path) / scene.slant_range
    assert_allclose(np.cos(scene.incidence), cosine, atol=3e-8)
    assert scene.times[0] == 0.0
    assert np.all(np.diff(scene.times) >= 0.0)


def test_the_reference_orbit_is_the_mean_one(orbit, etna):
    observation = seen(orbit, etna)
    # Mean elements drift in angles only; 1 m covers J2's second order.
    assert_allclose(observation.orbit.semi_major_axis, 6892137.0, atol=30.0)
    assert_allclose(observation.orbit.inclination, np.radians(97.44), atol=1e-5)
    assert_allclose(observation.eccentricity, 0.0012, atol=2e-5)


def test_slope_reaches_the_scene_and_layover_is_refused(orbit, etna):
    assert_allclose(seen(orbit, etna, slope=0.1).scene.slope, 0.1)
    with pytest.raises(ValueError, match=r"slope = 1\.2 in segment 1 rad must leave a local"):
        seen(orbit, etna, slope=1.2)


def test_near_nadir_the_incidence_may_be_below_the_look_angle():
    """North of its target at 46°, where the normal leans 0.19° north of the geocentric radius."""
    observation = swept(
        Simple(514e3, np.radians(46)),
        boresight=FixedLook(np.radians(0.6)),
        argument_of_latitude=(np.radians(80), np.radians(100)),
        law=Law.NONE,
        reference=Reference.AS_OBSERVED,
    )
    below = observation.scene.look_angle - observation.scene.incidence
    # The deflection, less the central angle of 514 km × tan 0.6° on the ground.
    assert_allclose(np.degrees(below), 0.192 - 0.048, atol=6e-3)


@given(st.floats(-np.pi, np.pi))
def test_nothing_changes_when_node_and_targets_turn_together(turn):
    """Over the date line too: the simple Earth is the same all around."""
    targets = Targets.from_points(
        latitude=np.radians([37.6, 37.8, 38.0]), longitude=np.radians([14.8, 15.0, 15.2])
    )
    turned = Targets.from_points(latitude=targets.latitude, longitude=targets.longitude + turn)
    moved = Simple(SIMPLE.altitude, SIMPLE.inclination, SIMPLE.node + turn)
    one, other = seen(SIMPLE, targets, stop=4 * DAY), seen(moved, turned, stop=4 * DAY)
    for name in ("times", "slant_range", "look_angle", "azimuth", "incidence"):
        assert_allclose(getattr(one.scene, name), getattr(other.scene, name), rtol=1e-9, atol=1e-7)
    assert np.all(np.abs(other.longitude) <= np.pi)
    gap = np.exp(1j * (other.track_longitude - one.track_longitude - turn))
    assert_allclose(gap, 1.0, atol=1e-9)


def test_left_and_right_are_mirror_images():
    """Mirrored in the equator, an orbit keeps its node and starts from it southward."""
    north = Targets.from_points(latitude=SUMMIT.latitude, longitude=SUMMIT.longitude)
    south = Targets.from_points(latitude=-SUMMIT.latitude, longitude=SUMMIT.longitude)
    # Southward from the node at 5.6 rad is half a turn past the node opposite.
    mirrored = Simple(SIMPLE.altitude, SIMPLE.inclination, SIMPLE.node + np.pi, start=np.pi)
    right = seen(SIMPLE, north)
    left = seen(mirrored, south, side=LookSide.LEFT)
    assert left.epoch == right.epoch
    assert left.ascending is not right.ascending
    assert_allclose(left.scene.azimuth, -right.scene.azimuth, atol=1e-9)
    assert_allclose(left.scene.slant_range, right.scene.slant_range, atol=1e-3)
    assert_allclose(left.scene.incidence, right.scene.incidence, atol=1e-9)


@pytest.mark.parametrize(("latitude", "side"), [(90.0, LookSide.RIGHT), (-90.0, LookSide.LEFT)])
def test_a_pole_is_seen_every_revolution_on_one_side(latitude, side):
    """The orbit passes 7.44° from the poles; the triangle with the polar radius says the rest."""
    pole = Targets.from_points(latitude=np.radians(latitude), longitude=1.0)
    options = {"far_incidence": np.radians(70), "stop": DAY}
    observation = seen(SIMPLE, pole, side=side, **options)
    assert observation.passes == 15
    radius, polar, central = 6378137.0 + 514e3, 6356752.3142, np.radians(7.44)
    slant = np.sqrt(radius**2 + polar**2 - 2 * radius * polar * np.cos(central))
    assert_allclose(observation.scene.slant_range, slant, atol=1e-2)
    incidence = np.arcsin(radius * np.sin(central) / slant)
    assert_allclose(observation.scene.incidence, incidence, atol=1e-8)
    other = LookSide(-side)
    with pytest.raises(
        ValueError, match=f"15 crossings in reach are on the {side.name.lower()}; look there"
    ):
        seen(SIMPLE, pole, side=other, **options)


@pytest.mark.parametrize("law", [Law.YAW_PITCH, Law.PITCH_ROLL])
def test_a_geosynchronous_radar_sees_its_targets_too(law):
    targets = Targets.from_points(latitude=np.radians([34, 35]), longitude=np.radians([100, 101]))
    geosar = Simple(35_786e3, np.radians(60), node=np.radians(95))
    observation = seen(geosar, targets, law=law, stop=2 * DAY)
    assert len(observation.scene) == 2
    assert np.all(observation.scene.slant_range > 35_786e3)
    states = geosar.earth_fixed(times_of(observation, geosar))
    assert_allclose(doppler_centroid(states, points_of(observation), wavelength=0.24), 0, atol=1e-4)


def test_only_the_boresight_of_pitch_roll_steering_is_at_zero_doppler(orbit, etna):
    observation = seen(orbit, etna, law=Law.PITCH_ROLL)
    outward = observation.off_boresight > 0
    assert np.all(np.abs(observation.doppler[np.abs(observation.off_boresight) > 0.01]) > 100.0)
    assert len(set(np.sign(observation.doppler[outward]))) == 1


# -- the map -------------------------------------------------------------------------------------


def test_the_map_surrounds_the_segments(orbit, etna):
    observation = seen(orbit, etna)
    assert observation.track_latitude.shape == observation.near_latitude.shape
    assert observation.track_latitude.min() < etna.latitude.min()
    assert observation.track_latitude.max() > etna.latitude.max()
    edges = {}
    for edge in ("near", "far"):
        point = from_geodetic(
            latitude=getattr(observation, f"{edge}_latitude"),
            longitude=getattr(observation, f"{edge}_longitude"),
        )
        edges[edge] = np.min(np.linalg.norm(point - etna.position[:1], axis=-1))
    assert max(edges.values()) < 600e3
    assert len(observation.outlines) == 1


# -- the window ----------------------------------------------------------------------------------


def test_a_search_is_clipped_to_the_span_of_the_orbit():
    whole = seen(SIMPLE, SUMMIT, stop=2 * DAY)
    moment = times_of(whole, SIMPLE)[0]
    ends = {"first": moment - 40.0, "last": moment + 40.0}
    short = Simple(SIMPLE.altitude, SIMPLE.inclination, SIMPLE.node, **ends)
    clipped = seen(short, SUMMIT, start=-DAY, stop=9 * DAY)
    assert abs(clipped.epoch - whole.epoch) < timedelta(microseconds=2)
    assert_allclose(clipped.scene.slant_range, whole.scene.slant_range, atol=1e-2)
    with pytest.raises(
        ValueError,
        match="the searched time, 2025-06-29 00:00:00 UTC to 2025-06-30 00:00:00 UTC, lies outside",
    ):
        seen(short, SUMMIT, start=8 * DAY, stop=9 * DAY)


def test_an_ephemeris_is_searched_in_its_span(orbit):
    """A message of three hours around a pass; its states are interpolated."""
    whole = seen(orbit, SUMMIT)
    middle = times_of(whole, orbit)[0]
    times = middle + np.arange(-5400.0, 5401.0, 60.0)
    states = orbit.inertial(times)
    rows = np.hstack([states.position, states.velocity]) / 1e3
    stamps = [f"{EPOCH + timedelta(seconds=float(t)):%Y-%m-%dT%H:%M:%S.%f}" for t in times]
    lines = [
        f"{stamp} " + " ".join(f"{number:.9f}" for number in row)
        for stamp, row in zip(stamps, rows, strict=True)
    ]
    header = (
        "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2025-06-01T00:00:00\nORIGINATOR = TEST\n"
        "META_START\nOBJECT_NAME = SAR\nOBJECT_ID = 2025-001A\nCENTER_NAME = EARTH\n"
        f"REF_FRAME = GCRF\nTIME_SYSTEM = UTC\nSTART_TIME = {stamps[0]}\n"
        f"STOP_TIME = {stamps[-1]}\nMETA_STOP\n"
    )
    ephemeris = Ephemeris.from_oem(header + "\n".join(lines) + "\n")
    observation = seen(ephemeris, SUMMIT, start=-DAY, stop=30 * DAY)
    assert abs(observation.epoch - whole.epoch) < timedelta(microseconds=10)
    # The lines are rounded to a micrometer and interpolated to a millimeter or so.
    assert_allclose(observation.scene.slant_range, whole.scene.slant_range, atol=0.05)
    with pytest.raises(ValueError, match="lies outside that of the orbit, 2025-06-2"):
        seen(ephemeris, SUMMIT, start=30 * DAY, stop=31 * DAY)


def test_a_search_that_the_orbit_cuts_short_advises_no_longer_one():
    short = Simple(SIMPLE.altitude, SIMPLE.inclination, first=0.0, last=600.0)
    with pytest.raises(
        ValueError,
        match=r"take an ephemeris that reaches farther \(the search was cut to its span\)",
    ):
        seen(short, SUMMIT)


def test_the_start_counts():
    first = seen(SIMPLE, SUMMIT)
    later = seen(SIMPLE, SUMMIT, start=times_of(first, SIMPLE)[0] + 1.0)
    assert later.epoch > first.epoch


def test_a_long_search_is_fast(orbit, etna):
    """11 days of 15 revolutions and 25 targets."""
    start = time.perf_counter()
    seen(orbit, etna)
    # 0.15 s on an idle core; the bound leaves room for a busy machine.
    assert time.perf_counter() - start < 2.0


def test_blocks_of_a_search_leave_no_gap():
    blocks = list(sample_blocks(Window(0.0, 1e6, 100.0), 120))
    assert len(blocks) > 2
    assert all(one[-1] == other[0] for one, other in pairwise(blocks))
    assert (blocks[0][0], blocks[-1][-1]) == (0.0, 1e6)


def test_the_nearest_of_several_crossings_is_taken():
    """The pole is crossed in each revolution; 94.7 minutes apart."""
    pole = from_geodetic(latitude=[np.pi / 2] * 2, longitude=[0.0, 0.0])
    period = 2 * np.pi / np.sqrt(EARTH_GRAVITATIONAL_PARAMETER / (6378137.0 + 514e3) ** 3)
    northernmost = period / 4
    times = northernmost + period * np.array([1.0, 3.0]) + [200.0, -200.0]
    found = nearest_crossings(SIMPLE, pole, zero_doppler, times, period=period)
    assert_allclose(found, northernmost + period * np.array([1.0, 3.0]), atol=1.0)


def test_a_root_is_found_where_the_function_is_far_from_straight():
    shift = np.array([0.1, 0.5, 0.9])
    root = refine_root(lambda t: np.expm1(8 * (t - shift)), np.zeros(3), np.ones(3))
    assert_allclose(root, shift, atol=1e-9)
    hit = refine_root(lambda t: t - 1.0, np.zeros(1), np.ones(1))
    assert hit == 1.0


# -- targets that are not seen -------------------------------------------------------------------


def test_a_target_beyond_the_orbit_is_said_to_be_so():
    flat = Simple(514e3, np.radians(10))
    with pytest.raises(
        ValueError,
        match=r"the target is not seen from 2025-06-21 00:00:00 UTC to 2025-06-22 00:00:00 UTC "
        r"\(1 day\) by a radar that looks right at incidences of 20.00° to 55.00°: the beam never "
        r"passes over a target in view; the satellite itself reaches latitudes of ±10\.\d\d°",
    ):
        seen(flat, SUMMIT, stop=DAY)


def test_the_nearest_miss_is_named_with_its_incidence(etna):
    with pytest.raises(
        ValueError,
        match=r"none of the 25 targets is seen .* the nearest miss is target \d+ \(37.\d\d°N, "
        r"1[45].\d\d°E\) at incidence [\d.]+° on the right, 2025-06-2\d .* UTC; search longer",
    ):
        seen(SIMPLE, etna, near_incidence=0.5, far_incidence=0.5001, stop=2 * DAY)


def test_the_other_direction_is_proposed():
    first = seen(SIMPLE, SUMMIT)
    wanted = Direction.DESCENDING if first.ascending else Direction.ASCENDING
    moment = times_of(first, SIMPLE)[0]
    with pytest.raises(ValueError, match="the one crossing in reach is flown in the other"):
        seen(SIMPLE, SUMMIT, direction=wanted, start=moment - 60, stop=moment + 60)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"near_incidence": 0.9}, "near_incidence = 0.9 rad and far_incidence = 0.5 rad must"),
        ({"stop": 0.0}, "start = 0.0 s and stop = 0.0 s must be finite and in order"),
        ({"stop": np.inf}, "must be finite"),
        ({"wavelength": 0.0}, "wavelength = 0.0 m must be a finite positive number"),
    ],
)
def test_impossible_requests_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        seen(SIMPLE, SUMMIT, **({"far_incidence": 0.5} | changes))


def test_a_beam_far_from_zero_doppler_cannot_be_referred_to_it():
    """The search may end before the satellite comes to zero Doppler."""
    squinted = seen(SIMPLE, SUMMIT, law=Law.NONE, reference=Reference.AS_OBSERVED)
    moment = times_of(squinted, SIMPLE)[0]
    ends = {"first": moment - 600.0, "last": moment + 0.1}
    if squinted.doppler[0] < 0:
        ends = {"first": moment - 0.1, "last": moment + 600.0}
    short = Simple(SIMPLE.altitude, SIMPLE.inclination, SIMPLE.node, **ends)
    options = {"law": Law.NONE, "start": ends["first"], "stop": ends["last"]}
    seen(short, SUMMIT, reference=Reference.AS_OBSERVED, **options)
    with pytest.raises(ValueError, match=r"1 of 1 targets have no moment of zero Doppler .* none"):
        seen(short, SUMMIT, **options)


# -- arcs ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("side", list(LookSide))
@pytest.mark.parametrize("direction", [Direction.ASCENDING, Direction.DESCENDING])
def test_a_band_of_latitudes_is_swept_from_edge_to_edge(orbit, side, direction):
    band = np.radians([30.0, 50.0])
    observation = swept(orbit, latitude=tuple(band), side=side, direction=direction)
    ends = band if direction is Direction.ASCENDING else band[::-1]
    assert_allclose(observation.latitude[[0, -1]], ends, atol=1e-9)
    assert observation.ascending == (direction is Direction.ASCENDING)
    assert len(observation.scene) == 10
    assert_allclose(np.diff(observation.scene.times), observation.scene.times[1], atol=1e-2)
    assert_allclose(observation.scene.incidence, np.radians(35), atol=1e-9)
    assert_allclose(observation.off_boresight, 0.0, atol=1e-9)
    assert np.all(np.sign(observation.scene.azimuth) == side)
    assert observation.passes in (14, 15, 16)


def test_the_order_of_the_edges_does_not_matter(orbit):
    one = swept(orbit, latitude=(0.2, 0.6))
    other = swept(orbit, latitude=(0.6, 0.2))
    assert one.epoch == other.epoch
    assert_allclose(one.latitude, other.latitude)


TURNS = [(start, start + 2 * np.pi) for start in np.arange(-3.0, 3.0, 0.7)]


@pytest.mark.parametrize("argument", [(0.3, 0.9), (-0.5, 0.5), (5.0, 7.0), *TURNS])
def test_a_stretch_of_the_orbit_has_the_wanted_arguments_of_latitude(argument):
    observation = swept(SIMPLE, argument_of_latitude=argument, reference=Reference.AS_OBSERVED)
    times = times_of(observation, SIMPLE)
    rate = np.sqrt(EARTH_GRAVITATIONAL_PARAMETER / (6378137.0 + 514e3) ** 3)
    assert_allclose(np.exp(1j * rate * times[0]), np.exp(1j * argument[0]), atol=2e-9)
    assert_allclose(times[-1] - times[0], (argument[1] - argument[0]) / rate, atol=1e-5)


@pytest.mark.parametrize("latitude", [0.0, 1.2])
def test_an_arc_that_begins_where_the_satellite_is_at_its_epoch_begins_then(latitude):
    orbit = KeplerianOrbit.circular(
        altitude=514e3, inclination=1.7, epoch=EPOCH, argument_of_latitude=latitude, j2=False
    )
    observation = swept(
        orbit, argument_of_latitude=(latitude, latitude + 0.5), reference=Reference.AS_OBSERVED
    )
    # Polar motion moves the node by 10 m, 1.4 ms.
    assert abs(observation.epoch - EPOCH) < timedelta(milliseconds=10)


def test_one_segment_is_the_middle():
    ends = swept(SIMPLE, argument_of_latitude=(0.3, 0.9), segments=3)
    middle = swept(SIMPLE, argument_of_latitude=(0.3, 0.9), segments=1)
    assert_allclose(middle.latitude, ends.latitude[1:2])
    assert middle.scene.times.tolist() == [0.0]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({}, "exactly one of latitude and argument_of_latitude"),
        ({"latitude": (0, 1), "argument_of_latitude": (0, 1)}, "exactly one of"),
        ({"latitude": (0.5, 0.5)}, "must be two different values"),
        ({"latitude": (30.0, 50.0)}, r"latitude = \(30.0, 50.0\) rad must .* give radians"),
        ({"latitude": (1.2, 1.55)}, r"68.75° to 88.81° from edge .* it reaches -8\d.\d\d° to 7"),
        ({"argument_of_latitude": (1.0, 0.5)}, "must be in order and at most 2π apart; add 2π"),
        ({"argument_of_latitude": (0.0, 7.0)}, "must be in order and at most 2π apart"),
        (
            {"argument_of_latitude": (0.0, 1.0), "direction": Direction.ASCENDING},
            "an argument of latitude already says",
        ),
        (
            {"argument_of_latitude": (5.0, 6.0), "stop": 600.0},
            r"from argument of latitude 286.48° to 343.77° .* a revolution takes 94.9 min",
        ),
        ({"argument_of_latitude": (0.0, 1.0), "segments": 0}, "segments = 0 must be at least 1"),
        (
            {"argument_of_latitude": (0.0, 1.0), "boresight": FixedLook(1.3)},
            r"no point on the Earth in 10 of 10 segments, the first at 2025-06-2\d",
        ),
        ({"latitude": (0.0, 0.5), "boresight": FixedLook(1.3)}, "it never meets the Earth"),
    ],
)
def test_impossible_arcs_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        swept(SIMPLE, **({"side": LookSide.LEFT} | changes))


def test_the_etna_area_is_geojson():
    assert json.loads(ETNA.read_text(encoding="utf-8"))["type"] == "Feature"
