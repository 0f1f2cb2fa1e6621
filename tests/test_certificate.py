"""Lower bounds of the height error: never above what a design reaches, and close to the best."""

from __future__ import annotations

import builtins
import dataclasses
import math
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from configs import example_path, load_study
from configs.build import build_optimize
from formation import ground_track_circular, min_separation, space_circular
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    one_transmitter,
    unwrapping_ladder,
)
from insar.coherence import common_band
from insar.phase_information import filtered_information
from insar.phase_noise import lessen_information, pair_efficiency
from optimize import Constraints, DesignSpace, Problem
from optimize.certificate import CertificateSettings, Method, certify
from optimize.certificate.infeasible import infeasibility, packing_proof
from optimize.certificate.information import InformationBound
from optimize.certificate.joint import joint_model, seen_gaps
from optimize.certificate.orders import known_gaps
from optimize.certificate.packing import scatter_support
from optimize.certificate.plane import plane_frame
from optimize.certificate.projected import projected_bound
from optimize.certificate.realize import realize
from optimize.certificate.reduction import reduction, scatter_of
from optimize.certificate.segment import Boxes, PlaneBoxes, SegmentModel
from optimize.certificate.separable import line_of_satellites, separable_bound, why_not_separable
from optimize.projection import projection
from optimize.refinement import refine
from optimize.structured import structured_designs

sys.path.insert(0, str(Path(__file__).parent))
from random_problems import random_designs, random_problem
from test_structured import li_problem

QUICK = CertificateSettings(max_boxes=20_000, tolerance=0.01)
FEW = CertificateSettings(max_boxes=4_000, tolerance=0.01)


def polished(problem, space, *, count=2):
    """The best design that the structured starts refine to."""

    def score(designs):
        objectives, margins = problem.objectives_and_margins(space.states(designs))
        return objectives, np.concatenate([np.empty((len(designs), 0)), *margins], axis=-1)

    designs = np.array(
        [
            refine(score, start, upper=space.upper, free=2 * space.satellites).design
            for start in structured_designs(problem, space, count=count)
        ]
    )
    evaluation = problem.evaluate(space.states(designs))
    return designs[np.lexsort((evaluation.objectives, evaluation.total_violation))[0]]


def example(name):
    setup = build_optimize(load_study(example_path(name)).study)
    return setup.problem, setup.space


# --- Soundness: no design is better than a bound.


@given(seed=st.integers(0, 2**32 - 1), satellites=st.integers(2, 5))
@settings(max_examples=40)
def test_no_formation_of_a_box_is_better_than_its_bound(seed, satellites):
    rng = np.random.default_rng(seed)
    problem, space = random_problem(rng, satellites, segments=1)
    sign = int(space.signs[0])
    bound = projected_bound(
        problem, space, sign=sign, start=None, tolerance=0.5, max_boxes=1
    )  # for its groups and orders
    order = bound.orders[rng.integers(len(bound.orders))]
    group = bound.groups[0]
    model = SegmentModel(
        radar=problem.radar,
        errors=problem.errors,
        order=order,
        wavenumbers=group.wavenumbers,
        shifts=group.shifts,
        amplitude=group.amplitude,
        alike=group.alike,
        range_variance=group.range_variance,
        prior_height_std=problem.constraints.prior_height_std,
    )
    # Formations along the direction of the height, sorted as the order says.
    seen = projection(space, problem.scene, held_constant=problem.errors.held_constant, sign=sign)
    a = seen.height[0]
    gaps = rng.dirichlet(np.ones(satellites), size=30)[:, : satellites - 1] * 2.0
    width = gaps.max() * 10.0 ** rng.uniform(-3.0, 0.0, (30, 1))
    lower = np.maximum(0.0, gaps - width * rng.random(gaps.shape))
    upper = gaps + width * rng.random(gaps.shape)
    box = model.bounds(Boxes(lower, upper))
    along = np.concatenate([np.zeros((30, 1)), np.cumsum(gaps, axis=-1)], axis=-1)
    reach = group.wavenumbers[0] * problem.radar.wavelength * seen.lever[0] / (2.0 * np.pi)
    plane = np.zeros((30, satellites, 2))
    # Anything across the direction of the height must not help, not even azimuth bands that part.
    beside = rng.normal(0.0, 1.0, (30, satellites)) * 10.0 ** rng.uniform(-1.0, 4.0, (30, 1))
    across = np.array([-a[1], a[0]]) / np.linalg.norm(a)
    plane[:, list(order)] = along[..., None] * reach * a / (a @ a)
    plane += beside[..., None] * across
    states = space.family(
        plane[..., 0], plane[..., 1] * space.mean_motion, mean_motion=space.mean_motion, sign=sign
    )
    population = problem.population(states)
    error = problem.height_error(population).total[:, 0]
    # 1e-9 is the rounding of 30 small matrices with condition numbers below 1e6.
    assert np.all(box.squared_error.min(axis=-1) <= error**2 * (1.0 + 1e-9))
    failure = unwrapping_ladder(
        population.model, prior_height_std=problem.constraints.prior_height_std
    ).failure[:, 0]
    assert np.all(box.failure.min(axis=-1) <= failure * (1.0 + 1e-6) + 1e-12)
    # Both hold in one and the same case of the azimuth bands.
    for index in range(5):
        one = Boxes(lower[index : index + 1], upper[index : index + 1])
        limit = failure[index] * (1.0 + 1e-6) + 1e-12
        within = model.feasible_error(one, failure=limit, enough=math.inf)
        assert within[0] <= error[index] ** 2 * (1.0 + 1e-9)


@given(seed=st.integers(0, 2**32 - 1), satellites=st.integers(2, 8))
@settings(max_examples=12)
def test_no_feasible_design_is_better_than_the_certificate(seed, satellites):
    rng = np.random.default_rng(seed)
    problem, space = random_problem(rng, satellites)
    designs = random_designs(rng, problem, space, 300)
    evaluation = problem.evaluate(space.states(designs))
    best = int(np.lexsort((evaluation.objectives, evaluation.total_violation))[0])
    proof = certify(
        problem,
        space,
        design=designs[best],
        settings=CertificateSettings(max_boxes=1_500, tolerance=0.02),
    )
    if evaluation.feasible.any():
        assert proof.infeasibility is None
        reached = evaluation.objectives[evaluation.feasible].min()
        for bound in proof.bounds:
            assert not bound.value > reached * (1.0 + 1e-9), bound


@given(seed=st.integers(0, 2**32 - 1), satellites=st.integers(2, 4))
@settings(max_examples=40)
def test_no_formation_is_better_than_the_boxes_of_the_plane_it_is_in(seed, satellites):
    rng = np.random.default_rng(seed)
    problem, space = random_problem(rng, satellites, segments=3)
    sign = int(space.signs[0])
    separate = projected_bound(problem, space, sign=sign, start=None, tolerance=0.5, max_boxes=1)
    seen = projection(space, problem.scene, held_constant=problem.errors.held_constant, sign=sign)
    frame = plane_frame(problem, space, seen)
    designs = random_designs(rng, problem, space, 8)
    if space.dimension > 2 * space.satellites:
        designs[:, -1] = sign
    population = problem.population(space.states(designs))
    squared = problem.height_error(population).region ** 2
    apart = min_separation(population.states, mean_motion=space.mean_motion).min(axis=-1)
    failure = unwrapping_ladder(
        population.model, prior_height_std=problem.constraints.prior_height_std
    ).failure.max(axis=-1)
    z0, rate, _ = space.decode(designs)
    points = np.stack([z0, rate / space.mean_motion], axis=-1) @ frame.axes.T / frame.radius
    for index in range(8):
        ((order, gaps),) = known_gaps(
            points[index], problem.radar, problem.errors, list(separate.orders)
        )
        at = np.concatenate([gaps[:, 0], gaps[:, 1] * frame.tilt])
        width = 10.0 ** rng.uniform(-4.0, 0.5, at.shape)
        part = rng.random(at.shape) if rng.random() < 0.5 else rng.integers(0, 2, at.shape)
        lower = at - width * part * np.abs(at)
        upper = at + width * (1.0 - part) * np.abs(at)
        model = dataclasses.replace(
            joint_model(problem, frame, separate, separate.orders[order]),
            failure=float(failure[index]) * (1.0 + 1e-6) + 1e-12,
            separation=0.5 * float(apart[index]) / frame.radius * (1.0 - 1e-9),
            floors=np.zeros(3),  # those of the study hold for feasible designs only
        )
        bound = model.feasible_error(Boxes(lower[None], upper[None]), math.inf)
        # 1e-9 is the rounding of small matrices with condition numbers below 1e6.
        assert bound[0] <= squared[index] * (1.0 + 1e-9)


def test_a_segment_sees_gaps_between_the_ends_that_are_told():
    rng = np.random.default_rng(3)
    ends = np.sort(rng.normal(size=(2, 40, 6)), axis=0)
    inside = ends[0] + rng.integers(0, 2, (40, 6)) * (ends[1] - ends[0])
    for height in rng.normal(size=(8, 2)):
        lower, upper = seen_gaps(PlaneBoxes(*ends, height, np.zeros(2)))
        seen = height[0] * inside[:, :3] + height[1] * inside[:, 3:]
        assert np.all((lower <= seen + 1e-12) & (seen <= upper + 1e-12))


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, 5))
@settings(max_examples=60)
def test_no_azimuth_bands_tell_more_than_the_bound(seed, count):
    # Exact statistics of few looks: a third image that leaves a part of the band raises the weight
    # of a pair that is known better than those with the third.
    rng = np.random.default_rng(seed)
    radar = Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0 ** rng.uniform(0.0, 2.0),
        looks=float(rng.integers(1, 32)),
        images=one_transmitter(count),
        azimuth_resolution=3.0,
    )
    amplitude = math.sqrt(radar.snr / (1.0 + radar.snr))
    above = np.tril(np.ones((count, count)), -1)[:, :-1]
    bound = InformationBound(
        radar=radar, errors=ErrorBudget(), amplitude=amplitude, alike=True, offsets=above
    )
    gaps = rng.uniform(0.0, rng.choice([0.2, 1.0]), count - 1)
    width = gaps * 10.0 ** rng.uniform(-4.0, -0.5)
    cases = bound.upper((gaps - width)[None], (gaps + width)[None])
    samples = 400
    offset = above @ (gaps + width * rng.uniform(-1.0, 1.0, (samples, count - 1)))[..., None]
    doppler = rng.uniform(-1.0, 1.0, (samples, count)) * 10.0 ** rng.uniform(-3, 0.3, (samples, 1))
    # Most worth trying: groups a whole band apart, or nearly so.
    grouped = rng.integers(0, 3, (samples, count)) + 0.01 * doppler
    doppler = np.where(rng.random((samples, 1)) < 0.4, grouped, doppler)
    information = filtered_information(
        offset[..., 0], image_coherence=amplitude, looks=radar.looks, doppler_offset=doppler
    )
    first, second = radar.image_pairs.T
    shared = common_band(offset[:, first, 0], offset[:, second, 0])
    shared = shared * common_band(doppler[:, first], doppler[:, second])
    efficiency = pair_efficiency(amplitude**2, radar.looks * shared)
    information = lessen_information(information, efficiency, pairs=radar.image_pairs)[:, 1:, 1:]
    # The cases hold every spread.
    assert (cases[0].shares[0], cases[-1].shares[1]) == (0.0, 1.0)
    assert all(one.shares[1] == two.shares[0] for one, two in pairwise(cases))
    spread = np.ptp(doppler, axis=-1)
    case = np.searchsorted([one.shares[0] for one in cases], spread, side="right") - 1
    direction = rng.normal(size=(samples, count - 1))
    told = np.einsum("si,sij,sj->s", direction, information, direction)
    for index, one in enumerate(cases):
        here = case == index
        ceiling = one.ceiling()[0]
        size = float(np.trace(ceiling))
        assert np.linalg.eigvalsh(ceiling - information[here]).min(initial=0.0) > -1e-9 * size
        # In every direction, no more than some way to part the images.
        along = direction[here]
        whole = np.einsum("si,ij,sj->s", along, one.whole[0], along)
        parted = np.einsum("si,pij,sj->sp", along, one.parted[0], along).max(axis=-1)
        most = [(1.0 - share) * whole + share * parted for share in one.shares]
        assert np.all(told[here] <= np.max(most, axis=0) * (1.0 + 1e-9))


@given(gamma=st.floats(0.02, 0.9999))
@settings(max_examples=30)
def test_efficiency_falls_and_then_rises_with_the_looks(gamma):
    # So it is largest at an end of an interval; 1e-5 is the interpolation of its table.
    efficiency = pair_efficiency(gamma, np.geomspace(1e-3, 1e4, 500))
    turn = int(np.argmin(efficiency))
    falling, rising = efficiency[: turn + 1], efficiency[turn:]
    assert np.all(falling - np.minimum.accumulate(falling) < 1e-5)
    assert np.all(np.maximum.accumulate(rising) - rising < 1e-5)


@given(seed=st.integers(0, 2**32 - 1), satellites=st.integers(2, 8))
@settings(max_examples=12)
def test_no_formation_is_better_than_the_sum_over_its_satellites(seed, satellites):
    rng = np.random.default_rng(seed)
    problem, space = random_problem(
        rng,
        satellites,
        segments=2,
        weighting=Weighting.JOINT,
        position=ErrorSource(10.0 ** rng.uniform(-5.0, -2.0), SharedBy.SATELLITE),
        azimuth=ErrorSource(0.0, SharedBy.ALL),
        synchronization=ErrorSource(0.0, SharedBy.IMAGE),
        baseline_decorrelation=BaselineDecorrelation.FILTERED,
    )
    if why_not_separable(problem):
        return
    designs = random_designs(rng, problem, space, 300)
    reached = problem.evaluate(space.states(designs)).objectives.min()
    bound = min(separable_bound(problem, space, sign=sign) for sign in space.signs)
    assert bound <= reached**2 * (1.0 + 1e-9)


@pytest.mark.parametrize("edge", [1e-6, 0.05, 0.5, 0.77, 1.0, 1.37, 6.0, 20.0])
def test_the_line_of_the_satellites_is_cut_at_every_end_of_a_band(edge):
    line = line_of_satellites(edge, 1.0, math.inf)
    assert_allclose(line.at[[0, -1]], [-1.0, 1.0], rtol=0.0)
    assert np.all(np.diff(line.at) > 0.0)
    # Over a cell an image loses one part of the band and gains one, at most.
    change = np.diff(line.sees, axis=0) * (line.width > 1e-9)
    assert np.all(np.sum(change < 0.0, axis=-1) <= 1)
    assert np.all(np.sum(change > 0.0, axis=-1) <= 1)
    assert_allclose(line.sees @ line.width, 1.0, atol=1e-8)
    # However long the line is, there is memory for it.
    assert line.sees.size < 400_000


def test_satellites_that_may_stand_anywhere_are_not_summed_up():
    problem, space = convex(6)
    errors = dataclasses.replace(
        problem.errors,
        weighting=Weighting.JOINT,
        baseline_decorrelation=BaselineDecorrelation.FILTERED,
        phase_std=None,
    )
    anywhere = dataclasses.replace(problem, errors=errors, constraints=Constraints())
    wide = dataclasses.replace(space, max_offset=1e6, max_rate=1e6 * space.mean_motion)
    assert separable_bound(anywhere, wide, sign=1) == 0.0
    proof = certify(anywhere, wide, design=np.ones(wide.dimension), settings=FEW)
    (bound,) = [one for one in proof.bounds if one.method is Method.SEPARABLE]
    assert math.isnan(bound.value)
    assert "too far apart" in bound.reason


# --- Tightness.


@pytest.mark.parametrize(("name", "expected"), [("three_sat", 0.2560), ("four_sat", 0.1189)])
def test_the_shipped_studies_are_proved_to_half_a_percent(name, expected):
    problem, space = example(name)
    assert problem.errors.phase_statistics is PhaseStatistics.EXACT
    assert problem.radar.azimuth_resolution is not None
    design = polished(problem, space, count=3)
    proof = certify(problem, space, design=design)
    assert proof.strongest.method is Method.BRANCH_AND_BOUND
    assert_allclose(proof.objective, expected, rtol=2e-3)
    assert 0.0 <= proof.gap < 0.005


def test_one_formation_for_segments_that_differ_is_proved_to_a_percent():
    problem, space = example("three_sat_real")
    every = problem.scene
    ends = [int(np.argmin(every.slant_range)), int(np.argmax(every.slant_range))]
    scene = Scene(
        **{
            field.name: np.broadcast_to(value, (len(every), *value.shape[1:]))[ends]
            if (value := getattr(every, field.name)).ndim and len(value) == len(every)
            else value
            for field in dataclasses.fields(Scene)
        }
    )
    problem = dataclasses.replace(problem, scene=scene)
    design = polished(problem, space, count=3)
    proof = certify(problem, space, design=design, settings=CertificateSettings(max_boxes=10_000))
    assert 0.0 <= proof.gap < 0.01
    # Each segment with a formation of its own would do much better.
    separate = [
        projected_bound(problem, space, sign=sign, start=None, tolerance=1e-2, max_boxes=10_000)
        for sign in space.signs
    ]
    assert min(bound.value for bound in separate) < 0.97 * proof.lower_bound


def convex(satellites, family=space_circular):
    """The paper's radar and limits over a broadside strip, coherence the same everywhere."""
    n = 1.10341e-3
    scene = Scene.broadside_strip(
        times=np.linspace(0.0, 10.0, 4),
        look_angle=np.deg2rad(23.0),
        altitude=514e3,
        earth_radius=6378137.0,
    )
    problem = Problem(
        mean_motion=n,
        scene=scene,
        radar=Radar(
            wavelength=0.031,
            slant_range_resolution=3.0,
            snr=10.0,
            looks=1.0,
            images=one_transmitter(satellites),
        ),
        errors=ErrorBudget(
            position=ErrorSource(0.01, SharedBy.SATELLITE),
            azimuth=ErrorSource(np.deg2rad(0.01), SharedBy.ALL),
            range=ErrorSource(0.01, SharedBy.ALL),
            weighting=Weighting.PAIRS,
            baseline_decorrelation=BaselineDecorrelation.NONE,
            held_constant=HeldConstant.DOPPLER,
            phase_std=0.316,
        ),
        constraints=Constraints(max_radius=1211.2, min_separation=100.0),
    )
    space = DesignSpace(
        names=tuple(f"S{index}" for index in range(satellites)),
        family=family,
        mean_motion=n,
        max_offset=605.6,
        max_rate=605.6 * n,
    )
    return problem, space


@pytest.mark.parametrize(
    ("satellites", "family"),
    [(2, space_circular), (3, ground_track_circular), (4, space_circular)],
)
def test_the_convex_case_is_proved_to_a_millionth(li2009_scene, li2009_radar, satellites, family):
    problem, space = li_problem(li2009_scene, li2009_radar, family=family, satellites=satellites)
    proof = certify(problem, space, design=polished(problem, space, count=1), settings=QUICK)
    assert 0.0 <= proof.gap < 1e-6
    values = {bound.method: bound.value for bound in proof.bounds}
    # Each step is at least as strong as the one before.
    assert values[Method.CLOSED_FORM] <= values[Method.SEMIDEFINITE] * (1.0 + 1e-9)
    assert values[Method.SEMIDEFINITE] <= values[Method.ONE_SHOT] * (1.0 + 1e-9)


def test_many_satellites_with_decorrelation_are_proved_to_a_few_percent():
    problem, space = convex(6)
    errors = dataclasses.replace(
        problem.errors,
        weighting=Weighting.JOINT,
        azimuth=ErrorSource(2e-6, SharedBy.ALL),
        baseline_decorrelation=BaselineDecorrelation.FILTERED,
        phase_statistics=PhaseStatistics.CRAMER_RAO,
        phase_std=None,
    )
    problem = dataclasses.replace(problem, errors=errors)
    proof = certify(problem, space, design=polished(problem, space, count=2), settings=QUICK)
    assert proof.strongest.method is Method.SEPARABLE
    assert 0.0 <= proof.gap < 0.02  # the closed form leaves 11 %


# --- The reduction, and the scatter that can be attained.


def test_the_scatter_says_all_where_the_reduction_holds():
    problem, space = convex(5)
    rng = np.random.default_rng(5)
    designs = random_designs(rng, problem, space, 8)
    error = problem.evaluate(space.states(designs)).objectives
    reduced = reduction(problem, space, sign=1)
    z0, rate, _ = space.decode(designs)
    points = np.stack([z0, rate / space.mean_motion], axis=-1) / 605.6
    ours = [math.sqrt(reduced.squared_error(scatter_of(one))) for one in points]
    # The disc is widened by 1e-9 for the rounding of the limit.
    assert_allclose(ours, error, rtol=1e-8)


def test_the_slope_is_the_gradient():
    problem, space = convex(4)
    reduced = reduction(problem, space, sign=1)
    rng = np.random.default_rng(1)
    scatter = scatter_of(rng.normal(size=(4, 2)))
    step = rng.normal(size=(2, 2))
    step = 1e-6 * (step + step.T)
    change = reduced.squared_error(scatter + step) - reduced.squared_error(scatter - step)
    assert_allclose(change / 2.0, -np.sum(reduced.slope(scatter) * step), rtol=1e-6)


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, 7))
@settings(max_examples=15)
def test_no_points_scatter_more_than_the_support(seed, count):
    rng = np.random.default_rng(seed)
    separation, weight = rng.uniform(0.0, 0.4), rng.uniform(0.0, 1.0)
    support = scatter_support(count, separation=separation, weight=weight, tolerance=1e-2)
    # Points thrown at the edge of the disc and thinned until they keep the distance.
    for _ in range(200):
        angle = rng.normal(0.0, 0.4, count) + np.pi * rng.integers(0, 2, count)
        radius = np.sqrt(1.0 - rng.random(count) * rng.choice([0.0, 0.3]))
        points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
        distance = np.linalg.norm(points[:, None] - points, axis=-1)[np.triu_indices(count, 1)]
        if distance.min() >= separation:
            variance = points.var(axis=0)
            assert count * (variance[0] + weight * variance[1]) <= support.upper
    assert support.attained <= support.upper


def test_more_satellites_than_fit_are_proved_impossible():
    problem, space = convex(6)
    close = dataclasses.replace(
        problem, constraints=Constraints(max_radius=100.0, min_separation=99.9)
    )
    small = dataclasses.replace(space, max_offset=50.0, max_rate=50.0 * space.mean_motion)
    assert packing_proof(close, small) is None  # six fit, one in the middle
    wide = dataclasses.replace(
        problem, constraints=Constraints(max_radius=100.0, min_separation=101.0)
    )
    proof = packing_proof(wide, small)
    assert proof is not None
    assert_allclose(proof.reliefs[0].passes_at, 100.0, rtol=1e-6)


# --- Infeasibility.


def test_a_proof_names_every_limit_that_it_counts_on():
    problem, space = example("three_sat")
    limits = Constraints(max_radius=1350.0, min_separation=120.0, max_baseline_fraction=0.2)
    limited = dataclasses.replace(problem, constraints=limits)
    apart = projected_bound(limited, space, sign=1, start=None, tolerance=0.5, max_boxes=1)
    shown = [
        bound._replace(value=math.inf) for bound in (apart, apart._replace(joint=apart.trees[0]))
    ]
    of_each, together = (infeasibility(limited, space, [bound], 1).statement for bound in shown)
    for limit in ("1350 m", "0.2 of the critical"):
        assert limit in of_each
        assert limit in together
    # Segments on their own know nothing of how far apart satellites stand.
    assert "120 m apart" in together
    assert "apart" not in of_each


def test_a_prior_that_is_too_coarse_is_proved_to_block():
    problem, space = example("three_sat")
    coarse = dataclasses.replace(
        problem,
        constraints=dataclasses.replace(
            problem.constraints,
            prior_height_std=60.0,
            max_radius=2000.0,
            min_separation=1900.0,
            max_baseline_fraction=0.9,
        ),
    )
    # Satellites may still stand side by side across the direction of the height: feasible.
    design = np.zeros(space.dimension)
    assert certify(coarse, space, design=design, settings=FEW).infeasibility is None
    noisy = dataclasses.replace(
        problem,
        errors=dataclasses.replace(
            problem.errors, position=ErrorSource(0.0045, SharedBy.SATELLITE)
        ),
    )
    proof = certify(noisy, space, design=design, settings=FEW)
    # With 4.5 mm a satellite the phases of a pair are off by 1.3 rad, whatever the baseline.
    assert proof.infeasibility is not None
    assert "0.99" in proof.infeasibility.statement
    relief = {one.name: one for one in proof.infeasibility.reliefs}["probability of unwrapping"]
    assert relief.passes_at < relief.blocks_to < 0.99
    # A formation at the value that passes exists, and the value that blocks has none.
    for value, possible in ((relief.passes_at, True), (relief.blocks_to, False)):
        eased = dataclasses.replace(
            noisy,
            constraints=dataclasses.replace(noisy.constraints, min_unwrapping_probability=value),
        )
        bounds = [
            projected_bound(eased, space, sign=sign, start=None, tolerance=0.999, max_boxes=20_000)
            for sign in space.signs
        ]
        assert any(math.isfinite(bound.value) for bound in bounds) is possible


# --- What it rests on.


def test_the_best_baselines_are_realized_by_satellites():
    problem, space = example("three_sat")
    bound = projected_bound(problem, space, sign=1, start=None, tolerance=1e-3, max_boxes=20_000)
    design = realize(problem, space, bound)
    evaluation = problem.evaluate(space.states(design[None]))
    assert evaluation.feasible[0]
    # The azimuth baseline is zero in the middle of the scene only.
    assert_allclose(evaluation.objectives[0], bound.best, rtol=1e-3)


def test_without_the_solver_the_other_bounds_stand(monkeypatch):
    real = builtins.__import__

    def refuse(name, *args, **kwargs):
        if name == "cvxpy":
            raise ImportError(name)
        return real(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", refuse)
    problem, space = convex(3)
    proof = certify(problem, space, design=polished(problem, space, count=1), settings=QUICK)
    bounds = {bound.method: bound for bound in proof.bounds}
    assert math.isnan(bounds[Method.SEMIDEFINITE].value)
    assert "not installed" in bounds[Method.SEMIDEFINITE].reason
    assert math.isfinite(bounds[Method.CLOSED_FORM].value)
    assert proof.gap < 0.01


def test_two_proofs_are_the_same_to_the_last_bit():
    problem, space = example("three_sat")
    design = np.zeros(space.dimension)
    first = certify(problem, space, design=design, settings=QUICK)
    second = certify(problem, space, design=design, settings=QUICK)
    assert first.lower_bound == second.lower_bound
    assert math.isinf(first.objective)
    assert math.isnan(first.gap)
