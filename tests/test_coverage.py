"""Walker constellations: sizing, simulation, long-run cover, and the proof of continuous cover."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from formation.constants import EARTH_EQUATORIAL_RADIUS, EARTH_ROTATION_RATE
from insar import LookSide
from insar.observe.coverage.continuity import prove_continuous
from insar.observe.coverage.long_run import long_run_counts, longest_run, track_slope
from insar.observe.coverage.results import Verdict
from insar.observe.coverage.simulation import simulate_coverage, symmetric_longitudes
from insar.observe.coverage.sizing import sizing_shortfall, walker_sizing
from insar.observe.coverage.walker import (
    MAX_ALTITUDE,
    Visibility,
    Walker,
    central_angle,
    circular_rates,
    ground_points,
)
from insar.observe.coverage.walker_search import smallest_walker
from insar.observe.earth import from_geodetic, sphere, vertical

DAY = 86400.0
SASEBO = math.radians(33.16)
SUN_SYNCHRONOUS = math.radians(97.6)
BALL = sphere(EARTH_EQUATORIAL_RADIUS)
EDGE = 1e-6  # s: edges are exact to rounding, 1e-9 s; a pass that grazes an edge magnifies it


def walker_of(total=6, planes=3, phasing=1, *, inclination=97.6, altitude=600e3, **start):
    return Walker(
        total=total,
        planes=planes,
        phasing=phasing,
        inclination=math.radians(inclination),
        altitude=altitude,
        **start,
    )


def annulus_of(largest, least=0.0, side=None):
    return Visibility(
        max_incidence=math.radians(largest), min_incidence=math.radians(least), side=side
    )


def seen_at(walker, latitude, longitude, visibility, times):
    """Whether any satellite sees the target: inertial vectors, straight from the definitions."""
    rates = walker.rates
    target = from_geodetic(latitude=latitude, longitude=longitude)
    turn = EARTH_ROTATION_RATE * times
    x = np.cos(turn) * target[0] - np.sin(turn) * target[1]
    y = np.sin(turn) * target[0] + np.cos(turn) * target[1]
    ground = np.stack([x, y, np.full_like(x, target[2])], axis=-1)
    seen = np.zeros(times.shape, dtype=bool)
    for node, argument in zip(*walker.pattern(), strict=True):
        raan, u = node + rates.node * times, argument + rates.argument_of_latitude * times
        tilt = walker.inclination
        position = walker.semi_major_axis * np.stack(
            [
                np.cos(raan) * np.cos(u) - np.sin(raan) * np.sin(u) * np.cos(tilt),
                np.sin(raan) * np.cos(u) + np.cos(raan) * np.sin(u) * np.cos(tilt),
                np.sin(u) * np.sin(tilt),
            ],
            axis=-1,
        )
        normal = np.stack(
            [
                np.sin(raan) * np.sin(tilt),
                -np.cos(raan) * np.sin(tilt),
                np.full_like(raan, np.cos(tilt)),
            ],
            axis=-1,
        )
        up = ground / np.linalg.norm(ground, axis=-1, keepdims=True)
        ray = position - ground
        incidence = np.arccos(np.vecdot(ray, up) / np.linalg.norm(ray, axis=-1))
        good = (incidence >= visibility.min_incidence) & (incidence <= visibility.max_incidence)
        if visibility.side is not None:
            good &= np.sign(np.vecdot(ground, normal)) == visibility.side
        seen |= good
    return seen


# -- the sizing of the paper -----------------------------------------------------------------------


@given(st.floats(200e3, 5000e3), st.floats(1.0, 89.0))
def test_sizing_solves_the_paper_equation_14(altitude, incidence):
    sizing = walker_sizing(altitude=altitude, max_incidence=math.radians(incidence))
    radius = EARTH_EQUATORIAL_RADIUS + altitude
    left = radius * math.cos(sizing.half_angle)
    left -= radius * math.sin(sizing.half_angle) / math.tan(sizing.max_incidence)
    assert left == pytest.approx(EARTH_EQUATORIAL_RADIUS, rel=1e-12 / math.radians(incidence))


def test_sizing_by_hand():
    # 600 km, β = 60°: sin η = 6378.137/6978.137·sin 60°, η = 52.332°, α = 7.668°;
    # period 96.687 min: S = ⌈180/7.668⌉ = ⌈23.5⌉, P = ⌈1436.07/96.687⌉ = ⌈14.85⌉.
    sizing = walker_sizing(altitude=600e3, max_incidence=math.radians(60))
    assert math.degrees(sizing.half_angle) == pytest.approx(7.668, abs=5e-4)
    assert sizing.period / 60 == pytest.approx(96.687, abs=5e-4)
    assert (sizing.satellites_per_plane, sizing.planes, sizing.total) == (24, 15, 360)
    assert sizing.view_time == pytest.approx(sizing.period * sizing.half_angle / math.pi)


def test_published_verdict_the_sizing_gives_80_to_86_percent():
    # The verdict names 500–700 km and 97.6°, but neither β nor latitude. The mean over latitudes up
    # to 60° is there for β = 57°; single latitudes lie anywhere between 50 % and 100 %.
    latitudes = np.radians(np.arange(0.0, 61.0, 5.0))
    for altitude in (500e3, 600e3, 700e3):
        sizing = walker_sizing(altitude=altitude, max_incidence=math.radians(57))
        walker = sizing.walker(inclination=SUN_SYNCHRONOUS)
        cover = [
            np.mean(long_run_counts(walker, latitude=x, visibility=annulus_of(57)) > 0)
            for x in latitudes
        ]
        assert 0.76 < np.mean(cover) < 0.90
        assert min(cover) < 0.80


def test_each_reason_takes_its_share():
    sizing = walker_sizing(altitude=600e3, max_incidence=math.radians(60))
    found = sizing_shortfall(
        sizing,
        latitude=SASEBO,
        inclination=SUN_SYNCHRONOUS,
        visibility=annulus_of(60, 20, LookSide.RIGHT),
    )
    assert found.in_plane == 1.0
    # Over an Earth that does not turn one longitude is always seen, another never.
    assert (found.held_least, found.held_most) == (0.0, 1.0)
    assert found.spacing == pytest.approx(0.76, abs=0.01)
    assert found.all_reasons < found.spacing_and_side < found.spacing
    assert found.all_reasons < found.spacing_and_nadir <= found.spacing
    # Half the view on one side of the planes, on average: the annulus of 20–60° itself.
    assert found.seen_by < 0.5 * sizing.total * (1 - math.cos(sizing.half_angle))


# -- orbits and geometry ---------------------------------------------------------------------------


def test_rates_against_a_repeating_sun_synchronous_orbit():
    # TerraSAR-X: 167 revolutions in 11 nodal days, the node with the mean Sun, at its published
    # mean semi-major axis 6883.513 km and inclination 97.4401°. 0.1 km are 2e-5 of the period.
    altitude = 6883.513e3 - EARTH_EQUATORIAL_RADIUS
    rates = circular_rates(altitude=altitude, inclination=math.radians(97.4401))
    revolutions = rates.argument_of_latitude / (EARTH_ROTATION_RATE - rates.node)
    assert revolutions == pytest.approx(167 / 11, rel=2e-5)
    assert rates.node * DAY == pytest.approx(2 * math.pi / 365.2422, rel=2e-3)


@given(st.floats(1.0, 85.0), st.floats(200e3, 3000e3))
def test_central_angle_against_vectors(incidence, altitude):
    orbit = EARTH_EQUATORIAL_RADIUS + altitude
    angle = central_angle(
        math.radians(incidence), orbit_radius=orbit, target_radius=EARTH_EQUATORIAL_RADIUS
    )
    across, up = orbit * np.sin(angle), orbit * np.cos(angle) - EARTH_EQUATORIAL_RADIUS
    assert math.degrees(np.arctan2(across, up)) == pytest.approx(incidence, abs=1e-9)


def test_altitudes_allowed_have_one_closest_approach_a_pass():
    # Concave wherever a satellite may be in view, and half a sample farther.
    rates = circular_rates(altitude=MAX_ALTITUDE, inclination=0.0)
    ratio = EARTH_ROTATION_RATE / rates.argument_of_latitude
    horizon = math.acos(EARTH_EQUATORIAL_RADIUS / (EARTH_EQUATORIAL_RADIUS + MAX_ALTITUDE))
    assert math.cos(horizon + math.pi / 24 * (1 + ratio)) > 2 * ratio + ratio**2


def test_geocentric_vertical_costs_at_most_a_fifth_of_a_degree():
    latitude = np.radians(np.linspace(-90, 90, 181))
    point = from_geodetic(latitude=latitude, longitude=0.0)
    geocentric = point / np.linalg.norm(point, axis=-1, keepdims=True)
    error = np.arccos(np.clip(np.vecdot(geocentric, vertical(point)), -1, 1))
    assert math.degrees(error.max()) == pytest.approx(0.19, abs=0.005)


def test_the_pattern_maps_to_itself_from_plane_to_plane():
    walker = walker_of(24, 6, 5, first_node=0.3, first_argument=1.1)
    node, argument = walker.pattern()
    shift = 2 * math.pi * 5 / 24
    before = np.exp(1j * np.stack([node, argument]))
    after = np.exp(1j * np.stack([node + 2 * math.pi / 6, argument + shift]))
    distance = np.abs(before[:, :, None] - after[:, None, :]).sum(axis=0)
    assert_allclose(distance.min(axis=0), 0.0, atol=1e-12)


# -- simulation ------------------------------------------------------------------------------------


@pytest.mark.parametrize("retrograde", [False, True])
def test_equatorial_pass_in_closed_form(retrograde):
    # Satellite and target run on one circle: 2α at the difference of their rates.
    walker = walker_of(1, 1, 0, inclination=180.0 if retrograde else 0.0)
    sign = -1 if retrograde else 1
    rates = walker.rates
    relative = rates.argument_of_latitude - sign * (EARTH_ROTATION_RATE - rates.node)
    inner, outer = central_angle(
        np.radians([20.0, 60.0]),
        orbit_radius=walker.semi_major_axis,
        target_radius=EARTH_EQUATORIAL_RADIUS,
    )
    revisit = 2 * math.pi / relative
    for least, expected, count in ((0.0, 2 * outer, 1), (20.0, 2 * (outer - inner), 2)):
        found = simulate_coverage(
            walker,
            latitude=0.0,
            longitude=sign * math.pi / 2,
            visibility=annulus_of(60, least),
            duration=10 * revisit,
        )
        assert found.accesses == 10 * count
        assert found.mean_access * count == pytest.approx(expected / relative, abs=EDGE)
        assert found.cover == pytest.approx(expected / (2 * math.pi), rel=1e-9)
        longest = 2 * math.pi - 2 * outer
        assert found.longest_gap == pytest.approx(longest / relative, abs=EDGE)


def test_a_polar_orbit_sees_the_pole_once_a_revolution():
    walker = walker_of(1, 1, 0, inclination=90.0)
    visibility = annulus_of(45)
    found = simulate_coverage(
        walker, latitude=math.pi / 2, longitude=1.0, visibility=visibility, duration=DAY
    )
    radius = float(ground_points(math.pi / 2, 0.0).radius)
    angle = central_angle(
        visibility.max_incidence, orbit_radius=walker.semi_major_axis, target_radius=radius
    )
    motion = walker.rates.argument_of_latitude
    assert found.mean_access == pytest.approx(2 * angle / motion, abs=EDGE)
    assert found.accesses == round(motion * DAY / (2 * math.pi))
    assert found.longest_gap == pytest.approx((2 * math.pi - 2 * angle) / motion, abs=EDGE)


@pytest.mark.parametrize("side", [None, LookSide.LEFT, LookSide.RIGHT])
@pytest.mark.parametrize("inclination", [35.0, 97.6])
def test_intervals_against_every_second_of_a_day(side, inclination):
    walker = walker_of(6, 3, 1, inclination=inclination, first_node=0.2, first_argument=0.7)
    visibility = annulus_of(55, 20, side)
    latitudes = np.radians([-34.9, -5.0, 20.0, 34.0, 48.0])
    found = simulate_coverage(
        walker, latitude=latitudes, longitude=2.0, visibility=visibility, duration=DAY
    )
    times = np.arange(0.5, DAY, 1.0)
    for index, latitude in enumerate(latitudes):
        start, end = found.intervals.of(index)
        expected = seen_at(walker, latitude, 2.0, visibility, times)
        number = np.searchsorted(start, times) - 1
        inside = (number >= 0) & (times <= np.append(end, -1.0)[number])
        # Where the two differ, the edge itself must lie.
        differ = times[inside != expected]
        edges = np.append(np.concatenate([start, end]), np.inf)
        assert all(np.abs(edges - moment).min() < EDGE for moment in differ)
        assert found.cover[index] == pytest.approx(expected.mean(), abs=start.size / DAY + 1e-12)


def test_a_pass_that_only_grazes_is_not_missed():
    # The least incidence of the day, by brute force: an annulus that ends there has one access.
    walker = walker_of(1, 1, 0, first_argument=0.1)
    times = np.arange(0.0, DAY, 0.5)
    low, high = math.radians(5), math.radians(85)
    for _ in range(40):
        middle = (low + high) / 2
        seen = seen_at(walker, 0.6, 1.0, Visibility(max_incidence=middle), times)
        low, high = (low, middle) if seen.any() else (middle, high)
    views = [
        simulate_coverage(
            walker,
            latitude=0.6,
            longitude=1.0,
            visibility=Visibility(max_incidence=incidence),
            duration=DAY,
        )
        # A sample is up to 0.25 s from the closest approach, 2e-5 rad of incidence at 600 km.
        for incidence in (low - 2e-5, high + 1e-9)
    ]
    assert [int(view.accesses) for view in views] == [0, 1]
    assert views[1].mean_access < 1.0


def test_a_target_never_seen_has_one_gap_as_long_as_the_window():
    found = simulate_coverage(
        walker_of(inclination=20.0),
        latitude=math.radians(60),
        longitude=0.0,
        visibility=annulus_of(50),
        duration=DAY,
    )
    assert (found.cover, found.accesses, found.gaps) == (0.0, 0, 1)
    assert (found.longest_gap, found.mean_wait) == (DAY, DAY / 2)
    assert np.isnan(found.mean_access)


def test_overlapping_views_of_several_satellites_merge():
    visibility = annulus_of(70)
    walker = walker_of(60, 6, 1, altitude=800e3)
    found = simulate_coverage(
        walker, latitude=0.9, longitude=[0.0, 1.0], visibility=visibility, duration=DAY
    )
    start, end = found.intervals.of(1)
    assert np.all(start[1:] > end[:-1])
    assert found.cover[1] == pytest.approx(np.sum(end - start) / DAY, abs=1e-9)
    assert np.all(found.seen_by > found.cover)
    gaps = np.diff(np.stack([np.append(0.0, end), np.append(start, DAY)]), axis=0)
    assert found.longest_gap[1] == pytest.approx(gaps.max(), abs=EDGE)
    assert found.mean_wait[1] == pytest.approx((gaps**2).sum() / 2 / DAY, rel=1e-9)
    assert found.mean_gap[1] == pytest.approx(gaps[gaps > EDGE].mean(), rel=1e-9)


@given(st.floats(30.0, 70.0), st.floats(0.0, 25.0), st.floats(-80.0, 80.0), st.integers(0, 3))
def test_a_wider_annulus_never_covers_less(largest, least, latitude, phasing):
    covers = [
        simulate_coverage(
            walker_of(8, 4, phasing),
            latitude=math.radians(latitude),
            longitude=0.4,
            visibility=annulus_of(largest + wider, max(0.0, least - wider), side),
            duration=DAY / 4,
        ).cover
        for wider, side in ((0.0, LookSide.LEFT), (0.0, None), (3.0, None))
    ]
    assert covers[0] <= covers[1] + 1e-12
    assert covers[1] <= covers[2] + 1e-12


# -- the long run ----------------------------------------------------------------------------------


@pytest.mark.parametrize("side", [None, LookSide.RIGHT])
@pytest.mark.parametrize("latitude", [0.0, 0.58, -1.2])
def test_long_run_against_a_simulation_of_ten_days(side, latitude):
    walker = walker_of(20, 5, 2)
    visibility = annulus_of(55, 20, side)
    found = simulate_coverage(
        walker,
        latitude=latitude,
        longitude=symmetric_longitudes(walker, 12),
        visibility=visibility,
        duration=10 * DAY,
    )
    counts = long_run_counts(walker, latitude=latitude, visibility=visibility, least_cells=720)
    # 12 longitudes and 10 days sample the torus by 1800 revolutions: to 2 %.
    assert found.cover.mean() == pytest.approx(np.mean(counts > 0), rel=0.02)
    assert found.seen_by.mean() == pytest.approx(np.mean(counts), rel=0.02)


def test_longest_gap_of_the_long_run_against_a_simulation():
    # Hours long, from plane to plane; the fine grid leaves no view's tip between its lines.
    walker = walker_of(6, 3, 1, inclination=60, altitude=1200e3)
    found = simulate_coverage(
        walker,
        latitude=0.5,
        longitude=symmetric_longitudes(walker, 20),
        visibility=annulus_of(70),
        duration=20 * DAY,
    )
    covered = long_run_counts(walker, latitude=0.5, visibility=annulus_of(70), least_cells=2880) > 0
    steps = longest_run(covered, planes=3, phasing=1, slope=track_slope(walker), limit=30_000)
    step = 2 * math.pi / walker.rates.argument_of_latitude / 2880
    assert steps * step == pytest.approx(found.longest_gap.max(), abs=3 * step)


def test_satellites_in_view_are_as_many_for_every_phasing():
    means = [
        np.mean(long_run_counts(walker_of(24, 8, f), latitude=0.5, visibility=annulus_of(60)))
        for f in range(8)
    ]
    assert_allclose(means, means[0], rtol=1e-12)


def test_the_mean_over_all_latitudes_is_the_area_seen():
    # Σ over the sphere of the satellites in view = T times the solid angle of the view.
    walker = walker_of(6, 3, 1)
    latitude = np.arcsin((np.arange(200) + 0.5) / 200)
    mean = np.mean(
        [
            np.mean(long_run_counts(walker, latitude=x, visibility=annulus_of(60), ellipsoid=BALL))
            for x in latitude
        ]
    )
    angle = walker_sizing(altitude=600e3, max_incidence=math.radians(60)).half_angle
    assert mean == pytest.approx(6 * (1 - math.cos(angle)) / 2, rel=2e-3)


@given(st.floats(0.0, 85.0), st.integers(0, 5))
def test_hemispheres_mirror_each_other_with_sides_exchanged(latitude, phasing):
    walker = walker_of(12, 6, phasing)
    for side, mirrored in ((None, None), (LookSide.LEFT, LookSide.RIGHT)):
        north, south = (
            np.mean(long_run_counts(walker, latitude=x, visibility=annulus_of(60, 20, s)) > 0)
            for x, s in ((math.radians(latitude), side), (-math.radians(latitude), mirrored))
        )
        # Cells whose middle is on an edge to rounding may fall on either side.
        assert north == pytest.approx(south, abs=1e-3)


def test_longitudes_repeat_from_plane_to_plane():
    walker = walker_of(12, 4, 1)
    longitude = symmetric_longitudes(walker, 6)
    covers = [
        simulate_coverage(
            walker,
            latitude=0.6,
            longitude=longitude + k * math.pi / 2,
            visibility=annulus_of(60, 20),
            duration=20 * DAY,
        ).cover.mean()
        for k in range(4)
    ]
    assert_allclose(covers, covers[0], rtol=2e-3)


# -- continuous cover ------------------------------------------------------------------------------

WIDE = annulus_of(70)


@pytest.fixture(scope="module")
def search():
    return smallest_walker(
        altitude=2000e3,
        inclinations=[math.radians(55)],
        totals=range(1, 40),
        latitudes=(SASEBO, SASEBO),
        visibility=WIDE,
    )


def test_the_smallest_walker_has_no_gap_in_a_simulation(search):
    assert search.best is not None
    assert (search.best.total, search.best.planes, search.best.phasing) == (23, 23, 18)
    found = simulate_coverage(
        search.best,
        latitude=SASEBO,
        longitude=np.linspace(0, 2 * math.pi, 40),
        visibility=WIDE,
        duration=5 * DAY,
    )
    assert np.all(found.gaps == 0)
    assert_allclose(found.cover, 1.0)


def test_smaller_candidates_have_the_gaps_that_the_search_says(search):
    table = search.candidates
    smaller = np.nonzero(table.total == search.best.total - 1)[0]
    # Every pattern of 22: 1, 2, 11 and 22 planes.
    assert smaller.size == 1 + 2 + 11 + 22
    assert np.all(table.verdict[smaller] == Verdict.GAPS)
    for row in smaller[np.argsort(-table.cover[smaller])][:3]:
        walker = walker_of(
            22, int(table.planes[row]), int(table.phasing[row]), inclination=55, altitude=2000e3
        )
        found = simulate_coverage(
            walker,
            latitude=SASEBO,
            longitude=symmetric_longitudes(walker, 12),
            visibility=WIDE,
            duration=10 * DAY,
        )
        # The simulation meets gaps up to the longest, which the search knows to its resolution.
        slack = search.gap_resolution
        assert table.longest_gap[row] - 2 * slack < found.longest_gap.max()
        assert found.longest_gap.max() < table.longest_gap[row] + slack
        assert found.cover.mean() == pytest.approx(table.cover[row], abs=0.005)


def test_nothing_below_the_area_bound_is_searched(search):
    assert search.candidates.total.min() == search.least_total
    assert search.least_total < search.best.total


def test_the_proof_finds_gaps_that_the_grid_does_not_see():
    # 47/47/29 covers every cell of the grid at five latitudes of the band, yet has gaps.
    visibility = annulus_of(70, 20)
    band = (math.radians(20), math.radians(45))
    good, bad = (walker_of(47, 47, f, inclination=55, altitude=2000e3) for f in (5, 29))
    assert prove_continuous(good, latitudes=band, visibility=visibility) is Verdict.CONTINUOUS
    assert prove_continuous(bad, latitudes=band, visibility=visibility) is Verdict.GAPS
    for latitude in np.linspace(*band, 5):
        assert np.all(long_run_counts(bad, latitude=latitude, visibility=visibility) > 0)
    found = simulate_coverage(
        good,
        latitude=np.linspace(*band, 9)[:, None],
        longitude=symmetric_longitudes(good, 4),
        visibility=visibility,
        duration=2 * DAY,
    )
    assert np.all(found.gaps == 0)


def test_the_proof_knows_the_side():
    visibility = annulus_of(70, side=LookSide.LEFT)
    latitudes = (SASEBO, SASEBO)
    walker = walker_of(60, 20, 7, inclination=55, altitude=2000e3)
    verdict = prove_continuous(walker, latitudes=latitudes, visibility=visibility)
    gaps = simulate_coverage(
        walker,
        latitude=SASEBO,
        longitude=symmetric_longitudes(walker, 30),
        visibility=visibility,
        duration=3 * DAY,
    ).gaps
    assert (verdict is Verdict.CONTINUOUS) == bool(np.all(gaps == 0))
    assert prove_continuous(walker, latitudes=latitudes, visibility=WIDE) is Verdict.CONTINUOUS


def test_the_proof_knows_the_gap_between_the_sides():
    # Seen from the left only; the middles of the first boxes are all covered, their rims are not.
    walker = walker_of(50, 50, 20, inclination=55, altitude=2000e3)
    visibility = annulus_of(70, side=LookSide.LEFT)
    verdict = prove_continuous(walker, latitudes=(SASEBO, SASEBO), visibility=visibility)
    assert verdict is Verdict.GAPS
    found = simulate_coverage(
        walker,
        latitude=SASEBO,
        longitude=symmetric_longitudes(walker, 40),
        visibility=visibility,
        duration=10 * DAY,
    )
    assert found.gaps.sum() > 0


def test_cover_without_any_margin_is_undecided():
    # Two satellites over the equator, with half the circle each, to rounding: on a sphere whose
    # annulus is set to reach a quarter of a turn, neither gap nor overlap can be shown.
    altitude = 2000e3
    orbit = EARTH_EQUATORIAL_RADIUS + altitude
    count = 6
    half = math.pi / count
    incidence = math.atan2(orbit * math.sin(half), orbit * math.cos(half) - BALL.semi_major_axis)
    walker = walker_of(count, 1, 0, inclination=0.0, altitude=altitude)
    verdicts = [
        prove_continuous(
            walker,
            latitudes=(0.0, 0.0),
            visibility=Visibility(max_incidence=incidence + change),
            ellipsoid=BALL,
        )
        for change in (-0.01, 1e-7, 0.01)
    ]
    assert verdicts == [Verdict.GAPS, Verdict.UNDECIDED, Verdict.CONTINUOUS]


def test_no_pattern_of_the_range_is_said_so():
    found = smallest_walker(
        altitude=2000e3,
        inclinations=[math.radians(55)],
        totals=[18, 19],
        latitudes=(SASEBO, SASEBO),
        visibility=WIDE,
        planes=[1, 3],
    )
    assert found.best is None
    assert found.candidates.total.tolist() == [18, 18, 18, 18, 19]
    assert np.all(found.candidates.verdict == Verdict.GAPS)


def test_the_same_search_gives_the_same_table(search):
    again = smallest_walker(
        altitude=2000e3,
        inclinations=[math.radians(55)],
        totals=range(1, 40),
        latitudes=(SASEBO, SASEBO),
        visibility=WIDE,
    )
    for one, other in zip(search.candidates, again.candidates, strict=True):
        assert np.array_equal(one, other)


# -- bad input -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"planes": 4}, "must divide total = 6"),
        ({"phasing": 3}, "between 0 and planes − 1 = 2"),
        ({"altitude": 600.0}, "give meters"),
        ({"altitude": 36e6}, "6000 km"),
        ({"inclination": 97.6}, "give radians"),
    ],
)
def test_impossible_patterns_are_refused(change, words):
    with pytest.raises(ValueError, match=words):
        dataclasses.replace(walker_of(), **change)


@pytest.mark.parametrize(("least", "largest"), [(0.0, 60.0), (0.5, 0.4), (-0.1, 0.4)])
def test_impossible_incidences_are_refused(least, largest):
    with pytest.raises(ValueError, match="0 ≤ min < max < π/2"):
        Visibility(max_incidence=largest, min_incidence=least)


def test_impossible_windows_and_targets_are_refused():
    for duration, latitude, words in (
        (0.0, 0.5, "duration"),
        (math.nan, 0.5, "duration"),
        (DAY, 33.0, "latitude"),
    ):
        with pytest.raises(ValueError, match=words):
            simulate_coverage(
                walker_of(),
                latitude=latitude,
                longitude=0.0,
                visibility=WIDE,
                duration=duration,
            )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"inclinations": []}, "at least one inclination"),
        ({"totals": [3, 2]}, "ascending"),
        ({"latitudes": (0.5, 0.4)}, "south to north"),
        ({"latitudes": (20.0, 45.0)}, "give radians"),
        ({"inclinations": [0.1]}, "inclination nearer to 90°"),
    ],
)
def test_impossible_searches_are_refused(change, words):
    usual = {
        "altitude": 600e3,
        "inclinations": [1.0],
        "totals": [20],
        "latitudes": (1.0, 1.0),
        "visibility": annulus_of(40),
    }
    with pytest.raises(ValueError, match=words):
        smallest_walker(**{**usual, **change})


def test_sizing_refuses_degrees():
    with pytest.raises(ValueError, match="give radians"):
        walker_sizing(altitude=600e3, max_incidence=60.0)
