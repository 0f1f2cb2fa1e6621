"""From a study to the objects that compute: units, defaults, the shipped examples."""

from __future__ import annotations

import math

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from configs import (
    STUDIES,
    EvaluateStudy,
    OptimizeStudy,
    StudyError,
    effective_text,
    example_names,
    example_path,
    json_schema,
    load_study,
)
from configs.build import build_evaluate, build_optimize
from formation import drift_per_orbit, equally_spaced, min_separation
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    HeldConstant,
    Scale,
    SharedBy,
    Weighting,
    critical_baseline,
    pair_geometry,
)
from optimize import SearchMethod, assess

MINIMAL = {
    "orbit": {"altitude_km": 514, "inclination_deg": 97.44},
    "radar": {"wavelength_m": 0.031, "slant_range_resolution_m": 3, "snr_db": 10},
    "scene": {"strip": {"look_deg": 23}},
    "errors": {"position_m": 0.001},
    "formation": {"satellites": 3},
}


def study(**blocks):
    return OptimizeStudy.model_validate(MINIMAL | blocks)


def radar(**keys):
    return study(radar=MINIMAL["radar"] | keys)


def built(name):
    loaded = load_study(example_path(name)).study
    return build_evaluate(loaded) if isinstance(loaded, EvaluateStudy) else build_optimize(loaded)


# --- units ---------------------------------------------------------------------------------------


def test_kilometers_and_degrees_become_metres_and_radians():
    setup = build_optimize(study())
    assert setup.orbit.altitude == pytest.approx(514e3, abs=1e-6)
    assert setup.orbit.inclination == math.radians(97.44)
    np.testing.assert_allclose(setup.problem.scene.look_angle, math.radians(23.0))
    # physics.md section 2: 24.97 degrees and 562.5 km on a sphere of 6378.137 km.
    np.testing.assert_allclose(np.degrees(setup.problem.scene.incidence), 24.97, atol=0.01)
    np.testing.assert_allclose(setup.problem.scene.slant_range, 562.5e3, atol=50.0)


def test_decibels_become_power_ratios():
    assert build_optimize(study()).problem.radar.snr == pytest.approx(10.0)
    given_apart = {"snr_db": None, "nesz_db": -19.0, "backscatter_db": -6.0}
    snr = build_optimize(radar(**given_apart)).problem.radar.snr
    assert snr == pytest.approx(10.0**1.3)


def test_an_azimuth_error_on_the_ground_becomes_an_angle_at_the_mean_slant_range():
    table = {
        "times_s": [0, 1],
        "slant_range_km": [500, 700],
        "look_deg": [20, 30],
        "azimuth_deg": [90, 90],
    }
    errors = {"position_m": 0.0, "azimuth_on_ground_m": 1.2}
    setup = build_optimize(study(scene={"table": table}, errors=errors))
    assert setup.problem.errors.azimuth.std == pytest.approx(2e-6)
    errors = {"position_m": 0.0, "azimuth_deg": 0.01}
    setup = build_optimize(study(scene={"table": table}, errors=errors))
    assert setup.problem.errors.azimuth.std == pytest.approx(1.745329e-4, rel=1e-6)


def test_every_error_key_reaches_the_budget():
    errors = {
        "position_m": 0.002,
        "position_shared_by": "pair",
        "position_scale": "pixel",
        "azimuth_deg": 0.02,
        "azimuth_shared_by": "pair",
        "range_m": 0.3,
        "range_scale": "pixel",
        "synchronization_deg": 2.0,
        "synchronization_shared_by": "pair",
        "weighting": "pairs",
        "baseline_decorrelation": "unfiltered",
        "held_constant": "azimuth",
        "phase_std_deg": 12.0,
    }
    budget = build_optimize(study(errors=errors)).problem.errors
    assert budget.position == (0.002, SharedBy.PAIR, Scale.PIXEL)
    assert budget.azimuth == (math.radians(0.02), SharedBy.PAIR, Scale.SCENE)
    assert budget.range == (0.3, SharedBy.ALL, Scale.PIXEL)
    assert budget.synchronization == (math.radians(2.0), SharedBy.PAIR, Scale.SCENE)
    assert budget.weighting is Weighting.PAIRS
    assert budget.baseline_decorrelation is BaselineDecorrelation.UNFILTERED
    assert budget.held_constant is HeldConstant.AZIMUTH
    assert budget.phase_std == math.radians(12.0)


def test_without_other_keys_the_errors_are_those_of_the_error_model():
    budget = build_optimize(study(errors={"position_m": 0})).problem.errors
    assert budget == ErrorBudget()


def test_a_preset_is_overridden_key_by_key():
    setup = build_optimize(study(errors={"preset": "li2009"}))
    assert setup.problem.errors == ErrorBudget.li2009(snr=10.0)
    errors = {"preset": "li2009", "position_m": 0.5, "azimuth_shared_by": "all"}
    budget = build_optimize(study(errors=errors)).problem.errors
    preset = ErrorBudget.li2009()
    assert budget.position.std == 0.5
    assert budget.azimuth == (preset.azimuth.std, SharedBy.ALL, Scale.SCENE)
    assert budget.phase_std == preset.phase_std


def test_segments_lie_in_the_middle_of_equal_parts():
    strip = {"look_deg": 23, "start_s": -2, "duration_s": 8, "segments": 4, "side": "right"}
    scene = build_optimize(study(scene={"strip": strip})).problem.scene
    np.testing.assert_allclose(scene.times, [-1, 1, 3, 5])
    np.testing.assert_allclose(np.degrees(scene.azimuth), -90)


def test_a_table_is_taken_as_it_is():
    table = {
        "times_s": [0, 1],
        "slant_range_km": [560, 561],
        "look_deg": [23, 24],
        "azimuth_deg": [82, -82],
        "incidence_deg": [25, 26],
        "slope_deg": 5,
    }
    scene = build_optimize(study(scene={"table": table})).problem.scene
    np.testing.assert_allclose(scene.slant_range, [560e3, 561e3])
    np.testing.assert_allclose(np.degrees(scene.incidence), [25, 26])
    np.testing.assert_allclose(np.degrees(scene.azimuth), [82, -82])
    np.testing.assert_allclose(np.degrees(scene.slope), 5)
    flat = {key: value for key, value in table.items() if key != "incidence_deg"}
    scene = build_optimize(study(scene={"table": flat})).problem.scene
    np.testing.assert_allclose(np.degrees(scene.incidence), [23, 24])


# --- who transmits and receives ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "images"),
    [
        ({}, ((0, 0), (0, 1), (0, 2))),
        ({"transmitter": "S2"}, ((1, 0), (1, 1), (1, 2))),
        ({"images": "monostatic"}, ((0, 0), (1, 1), (2, 2))),
        ({"images": [["S1", "S1"], ["S2", "S3"]]}, ((0, 0), (1, 2))),
    ],
)
def test_images_refer_to_satellites_by_name(keys, images):
    assert build_optimize(radar(**keys)).problem.radar.images == images


def test_ping_pong_has_an_image_for_each_transmitter_and_receiver():
    assert len(build_optimize(radar(images="ping_pong")).problem.radar.images) == 9


# --- limits, box and start -----------------------------------------------------------------------


def test_the_radius_is_limited_by_the_critical_baseline_of_the_images():
    one_way = build_optimize(study())
    assert one_way.problem.constraints.max_radius == pytest.approx(one_way.critical_baseline / 2)
    # Baselines of monostatic images count twice, so their critical baseline is half as long.
    twice = build_optimize(radar(images="monostatic"))
    assert twice.critical_baseline == pytest.approx(one_way.critical_baseline / 2)


def test_the_smaller_of_two_radius_limits_counts():
    for limit, expected in ((500.0, 500.0), (5000.0, 1353.66)):
        setup = build_optimize(study(constraints={"max_radius_m": limit}))
        assert setup.problem.constraints.max_radius == pytest.approx(expected, abs=0.01)


def test_without_bounds_the_box_holds_the_disc_of_the_radius():
    setup = build_optimize(study(constraints={"max_radius_m": 1000.0}))
    assert setup.space.max_offset == 500.0
    assert setup.space.max_rate == pytest.approx(500.0 * setup.orbit.mean_motion)
    assert setup.problem.constraints.max_offset is None
    bounds = {"max_z0_m": 100.0, "max_zdot0_m_s": 0.2, "max_radius_over_critical_baseline": None}
    setup = build_optimize(study(constraints=bounds))
    assert (setup.space.max_offset, setup.space.max_rate) == (100.0, 0.2)
    assert setup.problem.constraints.max_offset == 100.0
    assert setup.problem.constraints.max_radius is None


def test_null_switches_a_limit_off_and_a_prior_brings_its_limit():
    limits = {"min_separation_m": None, "unwrapping": {"prior_height_std_m": 4}}
    constraints = build_optimize(study(constraints=limits)).problem.constraints
    assert constraints.min_separation is None
    assert (constraints.prior_height_std, constraints.min_unwrapping_probability) == (4.0, 0.99)
    limits = {"unwrapping": {"prior_height_std_m": 4, "min_probability": None}}
    constraints = build_optimize(study(constraints=limits)).problem.constraints
    assert constraints.prior_height_std == 4.0
    assert constraints.min_unwrapping_probability is None
    assert constraints.min_separation == 100.0


def test_the_default_start_is_equally_spaced_on_the_largest_allowed_orbit():
    setup = build_optimize(study())
    n = setup.orbit.mean_motion
    z0, zdot0 = equally_spaced(3, radius=setup.problem.constraints.max_radius, mean_motion=n)
    np.testing.assert_allclose(setup.initial_states[:, 0], z0)
    np.testing.assert_allclose(setup.initial_states[:, 3], zdot0)
    assert setup.initial_design is None
    within_box = build_optimize(study(constraints={"max_z0_m": 100.0}))
    assert within_box.initial_states[0, 0] == pytest.approx(100.0)


def test_a_given_start_joins_the_search_where_it_lies_in_the_box():
    members = [
        {"name": "B", "z0_m": 200, "zdot0_m_s": 0.1},
        {"name": "A", "z0_m": -100, "zdot0_m_s": 0},
    ]
    formation = {"satellites": ["A", "B"], "initial": members}
    setup = build_optimize(study(formation=formation))
    np.testing.assert_array_equal(setup.initial_design, [-100, 0, 200, 0.1, 1])
    np.testing.assert_array_equal(setup.initial_states[:, 0], [-100, 200])
    outside = build_optimize(study(formation=formation, constraints={"max_radius_m": 150}))
    assert outside.initial_design is None
    np.testing.assert_array_equal(outside.initial_states, setup.initial_states)


@pytest.mark.parametrize(
    ("word", "signs"), [("positive", (1,)), ("negative", (-1,)), ("either", (1, -1))]
)
def test_the_cross_track_sign_reaches_the_design_space(word, signs):
    setup = build_optimize(study(formation={"satellites": 2, "cross_track_sign": word}))
    assert setup.space.signs == signs
    assert np.sign(setup.initial_states[0, 2]) == signs[0]


def test_search_settings_are_passed_on():
    block = {"population": 8, "generations": 3, "refinements": 0, "mutation_eta": 7, "elite": 2}
    settings_ = build_optimize(study(search=block)).settings
    assert settings_.refinements == 0
    assert settings_.algorithm[:2] == (8, 3)
    assert (settings_.algorithm.mutation_eta, settings_.algorithm.elite) == (7.0, 2)


@pytest.mark.parametrize("method", list(SearchMethod))
def test_the_method_of_the_search_is_passed_on(method):
    block = {
        "method": str(method),
        "population": 8,
        "generations": 3,
        "islands": 3,
        "migration_interval": 2,
        "restart": False,
        "structured_starts": 5,
    }
    settings_ = build_optimize(study(search=block)).settings
    assert settings_.algorithm.method is method
    assert settings_.algorithm[:2] == (8, 3)
    assert settings_.islands == (3, 2, False)
    assert settings_.structured == 5


# --- given formations ----------------------------------------------------------------------------


def test_compared_formations_take_over_family_and_sign_unless_they_have_their_own():
    members = [{"z0_m": 100, "zdot0_m_s": 0}, {"z0_m": -100, "zdot0_m_s": 0}]
    compare = [
        {"label": "like the study", "satellites": members},
        {
            "label": "another",
            "family": "space_circular",
            "cross_track_sign": "positive",
            "satellites": members,
        },
    ]
    formation = {"satellites": 2, "cross_track_sign": "negative"}
    first, second = build_optimize(study(formation=formation, compare=compare)).compare
    assert first.label == "like the study"
    assert first.names == ("S1", "S2")
    np.testing.assert_allclose(first.states[0, 2], -200.0)
    np.testing.assert_allclose(second.states[0, 2], math.sqrt(3.0) * 100.0)


def test_a_state_is_taken_as_it_is_and_in_the_order_of_the_study():
    n = build_optimize(study()).orbit.mean_motion
    state = {"position_rtn_m": [10, 20, 30], "velocity_rtn_m_s": [0.1, -20 * n, 0.3]}
    satellites = [{"name": "B", **state}, {"name": "A", "z0_m": 0, "zdot0_m_s": 0}]
    compare = [{"label": "x", "satellites": satellites}]
    setup = build_optimize(study(formation={"satellites": ["A", "B"]}, compare=compare))
    np.testing.assert_array_equal(setup.compare[0].states[0], np.zeros(6))
    np.testing.assert_allclose(setup.compare[0].states[1], [10, 20, 30, 0.1, -20 * n, 0.3])


# --- the shipped examples ------------------------------------------------------------------------


def test_the_shipped_examples_are_these():
    assert example_names() == (
        "cartwheel",
        "evaluate_example",
        "four_sat",
        "han2016_spotlight",
        "hongtu_1",
        "li2009_ground_track",
        "li2009_space",
        "liang2018_video",
        "lutan_1",
        "meng2003_yaw",
        "simulate_jacksboro",
        "srtm_x",
        "tandem_l",
        "tandem_x",
        "tandem_x_helix",
        "terrasar_x",
        "three_sat",
        "three_sat_real",
        "three_sat_spotlight",
        "three_sat_video",
        "walker_coverage",
        "zhao2019_geosar",
    )


@pytest.mark.parametrize("name", example_names())
def test_an_example_survives_the_round_trip_through_yaml(name, tmp_path):
    original = load_study(example_path(name)).study
    copy = tmp_path / "copy.yaml"
    copy.write_text(effective_text(original), encoding="utf-8")
    assert load_study(copy).study == original
    assert original.name == name


def test_the_realistic_example_has_the_parameters_of_the_reference():
    setup = built("three_sat")
    problem = setup.problem
    assert problem.radar.wavelength == 0.031
    assert problem.radar.looks == 16.0
    assert problem.errors.position.std == 0.001
    assert problem.errors.range.std == 0.01
    # 1 m along track at 562.5 km.
    assert problem.errors.azimuth.std == pytest.approx(1.0 / 562.5e3, rel=1e-4)
    assert problem.errors.weighting is Weighting.JOINT
    assert problem.constraints.max_radius == pytest.approx(
        0.5
        * critical_baseline(
            wavelength=0.031,
            slant_range=problem.scene.slant_range[0],
            incidence=problem.scene.incidence[0],
            slant_range_resolution=3.0,
        )
    )
    assert setup.space.signs == (1, -1)


def test_the_evaluated_example_is_a_feasible_ladder():
    setup = built("evaluate_example")
    assessment = assess(setup.problem, setup.formation.states, label="ladder", names=setup.names)
    assert assessment.feasible
    baselines = [abs(pair.perpendicular_baseline).max() for pair in assessment.pairs[:2]]
    # The realistic ladder of physics.md section 2, near 315 m and 1350 m with 0.25 m in total, is a
    # little shorter where the exact phase noise counts instead of its bound.
    np.testing.assert_allclose(baselines, [315.0, 1339.0], atol=1.0)
    assert assessment.height_error.region == pytest.approx(0.258, abs=0.005)
    drift = drift_per_orbit(setup.formation.states, mean_motion=setup.orbit.mean_motion)
    assert np.abs(drift).max() < 1.0


@pytest.mark.parametrize(
    ("name", "initial", "optimum", "radii"),
    [
        ("li2009_space", 41.6, 1.50, (3358, 3577, 4153)),
        ("li2009_ground_track", 36.16, 1.30, (2029, 2447, 1737)),
    ],
)
def test_the_paper_is_reproduced_from_its_study(name, initial, optimum, radii):
    setup = built(name)
    names = setup.space.names
    start = assess(setup.problem, setup.initial_states, label="initial", names=names)
    published = assess(setup.problem, setup.compare[0].states, label="optimum", names=names)
    # Half of the last printed digit, and the rounding of Table 2.
    assert start.height_error.region == pytest.approx(initial, abs=0.05)
    assert published.height_error.region == pytest.approx(optimum, abs=0.01)
    assert setup.initial_design is not None
    assert start.feasible
    broken = [report.limit.name for report in published.constraints if not report.satisfied]
    assert broken == ["radius of each relative orbit"]
    radius = next(r.value for r in published.constraints if r.limit.name == broken[0])
    assert radius == pytest.approx(max(radii), abs=1.0)


def test_the_published_ground_track_optimum_has_a_pair_beyond_its_critical_baseline():
    setup = built("li2009_ground_track")
    problem = setup.problem
    published = assess(problem, setup.compare[0].states, label="", names=setup.space.names)
    geometry = pair_geometry(
        published.scene_positions,
        problem.scene,
        radar=problem.radar,
        held_constant=problem.errors.held_constant,
    )
    first_and_third = abs(geometry.perpendicular_baseline[:, 1])
    assert first_and_third.max() == pytest.approx(2469.0, abs=5.0)
    assert first_and_third.max() > setup.critical_baseline


# --- the schema ----------------------------------------------------------------------------------


def _fields(schema):
    for definition in schema["$defs"].values():
        for key, field in definition.get("properties", {}).items():
            yield definition, key, field


def test_every_key_has_a_description_and_every_number_has_bounds():
    for definition, key, field in _fields(json_schema()):
        assert field.get("description"), (definition["title"], key)
        for choice in [field, *field.get("anyOf", [])]:
            entry = choice.get("items", choice)
            if entry.get("type") in ("number", "integer"):
                assert "maximum" in entry, (definition["title"], key)
                assert {"minimum", "exclusiveMinimum"} & set(entry), (definition["title"], key)


def test_no_block_allows_unknown_keys():
    for definition in json_schema()["$defs"].values():
        assert definition["additionalProperties"] is False


def test_the_examples_fit_the_json_schema():
    jsonschema = pytest.importorskip("jsonschema")
    for name in example_names():
        data = yaml.safe_load(example_path(name).read_text(encoding="utf-8"))
        jsonschema.validate(data, json_schema())


def test_the_registry_holds_every_kind_under_its_own_name():
    for kind, model in STUDIES.items():
        assert model.model_json_schema()["properties"]["kind"]["const"] == kind


# --- whatever the schema allows can be computed --------------------------------------------------


def _within(low, high):
    # Bounds are where domain objects are most likely to disagree with the schema.
    return st.one_of(st.sampled_from([float(low), float(high)]), st.floats(low, high))


_RADARS = st.fixed_dictionaries(
    {
        "wavelength_m": _within(0.002, 2),
        "slant_range_resolution_m": _within(0.05, 200),
        "looks": _within(1, 10_000),
        "snr_db": _within(-20, 40),
        "other_coherence": _within(0.001, 1),
        "images": st.sampled_from(["one_transmitter", "monostatic", "ping_pong"]),
    }
)
_STRIPS = st.fixed_dictionaries(
    {
        "look_deg": _within(2, 80),
        "side": st.sampled_from(["left", "right"]),
        "start_s": _within(-1e6, 1e6),
        "duration_s": _within(0.001, 1e5),
        "segments": st.sampled_from([1, 2, 7]),
        "slope_deg": _within(-60, 60),
    }
)
_ROWS = st.lists(
    st.tuples(
        _within(-1e6, 1e6),
        _within(100, 50_000),
        _within(2, 80),
        st.one_of(_within(1, 179), _within(-179, -1), _within(181, 359)),
    ),
    min_size=1,
    max_size=4,
)
_TABLES = _ROWS.map(
    lambda rows: dict(
        zip(
            ("times_s", "slant_range_km", "look_deg", "azimuth_deg"),
            (list(column) for column in zip(*rows, strict=True)),
            strict=True,
        )
    )
)
_SCENES = st.one_of(_STRIPS.map(lambda s: {"strip": s}), _TABLES.map(lambda t: {"table": t}))
_ERRORS = st.one_of(
    st.fixed_dictionaries(
        {
            "position_m": _within(0, 1),
            "azimuth_on_ground_m": _within(0, 10_000),
            "range_m": _within(0, 1000),
            "synchronization_deg": _within(0, 180),
            "weighting": st.sampled_from(["joint", "pairs"]),
            "baseline_decorrelation": st.sampled_from(["filtered", "unfiltered", "none"]),
            "held_constant": st.sampled_from(["doppler", "azimuth"]),
        }
    ),
    st.just({"preset": "li2009"}),
)
_LIMITS = st.fixed_dictionaries(
    {
        "max_radius_over_critical_baseline": _within(0.01, 10),
        "min_separation_m": st.one_of(st.none(), _within(0.1, 40_000)),
        "unwrapping": st.one_of(
            st.none(),
            st.fixed_dictionaries(
                {
                    "prior_height_std_m": _within(0.01, 1000),
                    "min_probability": _within(0.01, 0.999999),
                }
            ),
        ),
        "max_baseline_over_critical_baseline": st.one_of(st.none(), _within(0.001, 10)),
    }
)


@settings(max_examples=150, suppress_health_check=[HealthCheck.filter_too_much])
@given(
    orbit=st.fixed_dictionaries(
        {"altitude_km": _within(150, 36_000), "inclination_deg": _within(0, 180)}
    ),
    radar_block=_RADARS,
    scene=_SCENES,
    errors=_ERRORS,
    constraints=_LIMITS,
    satellites=st.integers(2, 4),
    family=st.sampled_from(["ground_track_circular", "space_circular"]),
)
def test_whatever_the_schema_allows_can_be_built_and_scored(
    orbit, radar_block, scene, errors, constraints, satellites, family
):
    data = {
        "orbit": orbit,
        "radar": radar_block,
        "scene": scene,
        "errors": errors,
        "constraints": constraints,
        "formation": {"satellites": satellites, "family": family},
    }
    try:
        valid = OptimizeStudy.model_validate(data)
    except ValidationError:
        return
    setup = build_optimize(valid)
    rng = np.random.default_rng(1)
    designs = setup.space.upper * rng.uniform(-1, 1, (3, setup.space.dimension))
    evaluation = setup.problem.evaluate(setup.space.states(designs))
    assert not np.any(np.isnan(evaluation.objectives))
    assert np.all(min_separation(setup.initial_states, mean_motion=setup.orbit.mean_motion) >= 0)


def _message(tmp_path, text):
    path = tmp_path / "my.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(StudyError) as error:
        load_study(path)
    return str(error.value)


def test_a_target_above_the_ground_is_refused(tmp_path):
    text = example_path("li2009_space").read_text(encoding="utf-8").replace("[559.11,", "[300.11,")
    message = _message(tmp_path, text)
    assert (
        "scene.table.slant_range_km[#1] = 300.11 is less than the altitude of the orbit, 514"
        in (message)
    )


def test_a_compared_formation_may_not_be_called_like_the_result(tmp_path):
    text = example_path("li2009_space").read_text(encoding="utf-8")
    message = _message(tmp_path, text.replace("label: Published optimum", "label: best"))
    assert "compare[#1].label = 'best' is what the result is called; choose another" in message
