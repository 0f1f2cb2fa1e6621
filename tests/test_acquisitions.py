"""Satellites placed by a table, several acquisitions, and the figures that missions print."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml
from numpy.testing import assert_allclose

from configs import EvaluateStudy, StudyError, load_study
from configs.build import build_evaluate
from formation_opt.cli import main
from formation_opt.runs import Options, evaluate
from insar import (
    ErrorBudget,
    ErrorSource,
    PrintedFigure,
    Radar,
    Relation,
    Scene,
    SharedBy,
    Verdict,
    combine_acquisitions,
    height_accuracy,
    height_error_of,
    judged,
    judged_range,
    one_transmitter,
    pair_geometry,
    phase_model,
    simulation,
    unwrapping_ladder,
)
from reports.json_result import result_schema
from reports.reading import pair_name

SCENE = Scene.broadside_strip(
    times=[0.0, 1.0], look_angle=math.radians(32.0), altitude=514e3, earth_radius=6378137.0
)
RADAR = Radar(
    wavelength=0.031,
    slant_range_resolution=1.5,
    snr=6.0,
    looks=20.0,
    images=one_transmitter(3),
)
ERRORS = ErrorBudget(
    position=ErrorSource(0.001, SharedBy.SATELLITE),
    azimuth=ErrorSource(2e-6, SharedBy.ALL),
    synchronization=ErrorSource(0.02, SharedBy.IMAGE),
)


def model_of(seed: int, errors: ErrorBudget = ERRORS):
    positions = np.random.default_rng(seed).uniform(-400.0, 400.0, (4, 2, 3, 3))
    return phase_model(positions, SCENE, radar=RADAR, errors=errors)


def error_of(model, errors: ErrorBudget = ERRORS):
    return height_error_of(model, scene=SCENE, radar=RADAR, errors=errors)


# -- the model of several acquisitions -----------------------------------------------------------


def test_independent_acquisitions_add_their_information():
    first, second = model_of(1), model_of(2)
    together = error_of(combine_acquisitions([first, second]))
    apart = [error_of(model).total for model in (first, second)]
    # Inverse variances add: exact, since no error is common to the acquisitions.
    assert_allclose(together.total**-2.0, apart[0] ** -2.0 + apart[1] ** -2.0, rtol=1e-9)
    assert_allclose(sum(term**2 for term in together.terms.values()), together.total**2, rtol=1e-12)


def test_combination_equals_the_covariance_written_out():
    models = [model_of(3), model_of(4), model_of(5)]
    together = error_of(combine_acquisitions(models))
    for design in range(4):
        total = 0.0
        for model in models:  # drop each acquisition's own reference and invert
            kz = model.vertical_wavenumber[design, 0, 1:]
            covariance = np.linalg.inv(model.information[design, 0, 1:, 1:])
            for factor in model.nuisance.values():
                covariance = covariance + factor[design, 0, 1:] @ factor[design, 0, 1:].T
            total += kz @ np.linalg.solve(covariance, kz)
        assert together.total[design, 0] == pytest.approx(total**-0.5, rel=1e-9)


def test_range_error_is_common_to_all_acquisitions():
    errors = ErrorBudget(range=ErrorSource(0.5, SharedBy.ALL))
    model = model_of(1, errors)
    together = error_of(combine_acquisitions([model] * 50), errors)
    # Repetition averages the noise away, but not a range error that all have.
    limit = 0.5 * np.cos(SCENE.incidence)
    assert np.all(together.total > limit)
    assert_allclose(together.terms["range"], np.broadcast_to(limit, (4, 2)))
    assert np.all(together.terms["phase"] < 0.15 * error_of(model, errors).terms["phase"])


def test_combined_model_is_a_laplacian_with_one_reference():
    model = combine_acquisitions([model_of(1), model_of(2)])
    assert model.vertical_wavenumber.shape == (4, 2, 5)
    assert_allclose(model.information.sum(axis=-1), 0.0, atol=1e-9 * model.information.max())
    assert np.all(model.vertical_wavenumber[..., 0] == 0.0)


def test_two_coverages_unwrap_each_other():
    """Heights of ambiguity of 45 and 30 m: their difference has 90 m."""
    radar = Radar(
        wavelength=0.031, slant_range_resolution=1.5, snr=6.0, looks=20.0, images=((0, 0), (0, 1))
    )
    lever = radar.wavelength * SCENE.slant_range * np.sin(SCENE.incidence)
    up = np.cross(SCENE.line_of_sight, [0.0, 1.0, 0.0])
    models = []
    for ambiguity in (45.0, 30.0):
        positions = np.zeros((1, 2, 2, 3))
        positions[0, :, 1] = (lever / ambiguity)[:, None] * up
        models.append(phase_model(positions, SCENE, radar=radar, errors=ErrorBudget()))
    combined = combine_acquisitions(models)
    ladder = unwrapping_ladder(combined, prior_height_std=12.0)
    alone = [unwrapping_ladder(model, prior_height_std=12.0) for model in models]
    first = ladder.pairs[0, 0, 0]
    kz = combined.vertical_wavenumber[0, 0]
    assert 2.0 * np.pi / abs(kz[first[0]] - kz[first[1]]) == pytest.approx(90.0, rel=1e-9)
    assert np.all(ladder.probability > alone[0].probability)
    assert alone[1].probability.max() < 0.8 < 0.98 < ladder.probability.min()


def test_ladder_of_two_coverages_against_a_simulation():
    """Integer bootstrapping drawn by hand succeeds as often as predicted."""
    rng = np.random.default_rng(7)
    radar = Radar(
        wavelength=0.031, slant_range_resolution=1.5, snr=2.0, looks=8.0, images=((0, 0), (0, 1))
    )
    lever = radar.wavelength * SCENE.slant_range * np.sin(SCENE.incidence)
    up = np.cross(SCENE.line_of_sight, [0.0, 1.0, 0.0])
    models = []
    for ambiguity in (45.0, 30.0):
        positions = np.zeros((1, 2, 2, 3))
        positions[0, :, 1] = (lever / ambiguity)[:, None] * up
        models.append(phase_model(positions, SCENE, radar=radar, errors=ErrorBudget()))
    combined = combine_acquisitions(models)
    prior, count = 12.0, 40_000
    predicted = unwrapping_ladder(combined, prior_height_std=prior).probability[0, 0]
    kz = combined.vertical_wavenumber[0, 0, 1:]
    noise = np.sqrt(np.diag(np.linalg.inv(combined.information[0, 0, 1:, 1:])))
    height = rng.normal(0.0, prior, count)
    phase = height[:, None] * kz + rng.normal(size=(count, 2)) * noise
    # First rung: the difference, expected zero by the prior; then the longer height of ambiguity
    # from what the first tells of the height.
    difference = phase[:, 1] - phase[:, 0]
    slope, spread = kz[1] - kz[0], noise @ noise
    good = np.abs(difference) < np.pi
    gain = (prior**2 * kz[0] * slope - noise[0] ** 2) / (prior**2 * slope**2 + spread)
    good &= np.abs(phase[:, 0] - gain * difference) < np.pi
    # Four standard deviations of 40 000 draws.
    assert good.mean() == pytest.approx(
        predicted, abs=4.0 * math.sqrt(predicted * (1.0 - predicted) / count)
    )


def test_combination_refuses_what_does_not_fit():
    with pytest.raises(ValueError, match="models is empty"):
        combine_acquisitions([])
    pairs = ErrorBudget.li2009()
    with pytest.raises(ValueError, match="weighting 'joint'"):
        combine_acquisitions([model_of(1, pairs)])
    other = phase_model(np.zeros((1, 2, 3, 3)), SCENE, radar=RADAR, errors=ERRORS)
    with pytest.raises(ValueError, match="all but the last axis must agree"):
        combine_acquisitions([model_of(1), other])


def test_accuracy_of_one_acquisition_is_that_of_its_formation():
    positions = np.random.default_rng(3).uniform(-400.0, 400.0, (2, 3, 3))
    arguments = {"radar": RADAR, "errors": ERRORS}
    alone = height_accuracy(positions, SCENE, **arguments)
    combined = height_accuracy(positions[None], SCENE, combined=True, **arguments)
    for name in ("random_pair_90", "relative_90", "absolute_90"):
        assert_allclose(getattr(combined, name), getattr(alone, name), rtol=1e-9)


def test_accuracy_of_equal_acquisitions_averages_what_is_theirs():
    """Four of the same: noise and position errors halve, but not the range error."""
    errors = replace(ERRORS, range=ErrorSource(2.0, SharedBy.ALL))
    positions = np.random.default_rng(3).uniform(-400.0, 400.0, (2, 3, 3))
    one = height_accuracy(positions, SCENE, radar=RADAR, errors=errors)
    four = height_accuracy(
        np.stack([positions] * 4), SCENE, radar=RADAR, errors=errors, combined=True
    )
    assert_allclose(four.random, 0.5 * one.random, rtol=1e-9)
    assert_allclose(four.random_pair_90, 0.5 * one.random_pair_90, rtol=1e-9)
    for name in ("position", "synchronization"):
        assert_allclose(four.sources[name].offset, 0.5 * one.sources[name].offset, rtol=1e-9)
        assert_allclose(four.sources[name].tilt, 0.5 * one.sources[name].tilt, rtol=1e-6)
    assert_allclose(four.sources["range"].offset, one.sources["range"].offset, rtol=1e-12)


# -- printed figures -----------------------------------------------------------------------------


def test_verdict_over_a_range():
    figure = PrintedFigure(text="t", printed="2 m", value=2.0, relation=Relation.AT_MOST)
    assert judged(figure, 1.0).verdict is Verdict.HOLDS
    assert judged_range(figure, 1.0, []).verdict is Verdict.HOLDS
    assert math.isnan(judged_range(figure, 1.0, []).lowest)
    inside = judged_range(figure, 1.0, [0.5, 1.9])
    assert (inside.verdict, inside.lowest, inside.highest) == (Verdict.HOLDS, 0.5, 1.9)
    assert judged_range(figure, 1.0, [0.5, 2.1]).verdict is Verdict.OPEN
    assert judged_range(figure, 3.0, [2.1, 4.0]).verdict is Verdict.FAILS
    assert judged_range(figure, math.nan, [math.nan]).verdict is Verdict.UNKNOWN


# -- from a study to a result --------------------------------------------------------------------

TWO = {
    "kind": "evaluate",
    "orbit": {"altitude_km": 514, "inclination_deg": 97.44},
    "radar": {"wavelength_m": 0.031, "slant_range_resolution_m": 1.5, "snr_db": 8, "looks": 20},
    "scene": {"strip": {"look_deg": 32, "side": "right", "segments": 3}},
    "errors": {"position_m": 0.001, "range_m": 0.5},
    "formation": {"table": [{"name": "A"}, {"name": "B", "height_of_ambiguity_m": 45}]},
    "constraints": {"unwrapping": {"prior_height_std_m": 8}},
}


def outcome(**blocks):
    study = EvaluateStudy.model_validate(TWO | blocks)
    return evaluate.run(study, build_evaluate(study), Options()).result


@pytest.mark.parametrize("images", ["one_transmitter", "monostatic"])
def test_height_of_ambiguity_becomes_a_baseline(images):
    result = outcome(radar=TWO["radar"] | {"images": images})
    assert_allclose(result.formation.pairs[0].height_of_ambiguity, 45.0, rtol=1e-12)
    assert result.formation.motion is None


def test_baselines_are_laid_across_the_line_of_sight():
    given = {"perpendicular_baseline_m": [200, 250, 300], "along_track_baseline_m": -80}
    result = outcome(formation={"table": [{}, given]})
    (pair,) = result.formation.pairs
    assert_allclose(pair.perpendicular_baseline, [200, 250, 300], rtol=1e-12)
    assert_allclose(pair.azimuth_baseline, -80.0, rtol=1e-12)


def test_fixed_positions_are_taken_as_they_are():
    """The boom of SRTM: 60 m at 45°, look 51.77° (incidence 54.5°) from 233 km.

    The height of ambiguity by hand: r = 388.4 km, B⊥ = 60 cos(51.77° − 45°) = 59.58 m, so
    0.031 × 388.4e3 × sin 54.51° / 59.58 = 164.5 m; 164 to 175 m are printed.
    """
    half = 60.0 / math.sqrt(2.0)
    result = outcome(
        orbit={"altitude_km": 233, "inclination_deg": 57},
        scene={"strip": {"look_deg": 51.77, "side": "left", "segments": 2}},
        formation={"table": [{"position_rtn_m": [0, 0, 0]}, {"position_rtn_m": [half, 0, half]}]},
    )
    (pair,) = result.formation.pairs
    assert_allclose(pair.perpendicular_baseline, 59.58, atol=0.01)
    assert_allclose(pair.height_of_ambiguity, 164.5, atol=0.1)
    assert_allclose(result.formation.scene_positions[:, 1], [[half, 0.0, half]] * 2)


def test_table_in_another_order_is_the_same_formation():
    images = [["A", "A"], ["A", "B"]]
    radar = TWO["radar"] | {"images": images}
    straight = outcome(radar=radar)
    place = straight.formation.scene_positions
    turned = outcome(
        radar=radar,
        compare=[
            {
                "label": "turned",
                "table": [
                    {"name": "B", "position_rtn_m": place[:, 1].tolist()},
                    {"name": "A", "position_rtn_m": [0, 0, 0]},
                ],
            }
        ],
    )
    assert_allclose(turned.compare[0].scene_positions, place)


ACQUISITIONS = [
    {"label": "long", "table": [{}, {"height_of_ambiguity_m": 45}]},
    {"label": "short", "table": [{}, {"height_of_ambiguity_m": 30}]},
]


def test_acquisitions_are_assessed_apart_and_combined():
    result = outcome(formation={"acquisitions": ACQUISITIONS})
    first, second = result.acquisitions
    assert [one.label for one in result.acquisitions] == ["long", "short"]
    assert result.formation.acquisitions == ("long", "short")
    range_error = 0.5 * np.cos(result.problem.scene.incidence)
    parts = [one.height_error.total**2 - range_error**2 for one in (first, second)]
    both = result.formation.height_error.total**2 - range_error**2
    assert_allclose(1.0 / both, 1.0 / parts[0] + 1.0 / parts[1], rtol=1e-9)
    assert len(result.formation.pairs) == 2
    rungs = result.formation.unwrapping.rungs
    assert rungs[0].height_of_ambiguity == pytest.approx(90.0)


def test_claims_are_judged_over_what_is_open():
    claims = [
        {
            "text": "height of ambiguity",
            "printed": "45 m",
            "quantity": "height_of_ambiguity",
            "value": 45,
            "tolerance": 0.5,
            "formation": "long",
        },
        {
            "text": "baseline",
            "printed": "1.45 m/mm",
            "quantity": "height_per_baseline_error",
            "value": 1.45,
            "tolerance": 0.005,
            "formation": "long",
        },
        {
            "text": "relative",
            "printed": "0.9 m",
            "quantity": "random_error_90",
            "value": 0.9,
            "relation": "at_most",
        },
    ]
    result = outcome(
        formation={"acquisitions": ACQUISITIONS},
        claims=claims,
        open=[{"key": "radar.looks", "least": 10, "most": 40}],
    )
    ambiguity, lever, relative = result.claims
    assert ambiguity.verdict is Verdict.HOLDS
    assert (ambiguity.lowest, ambiguity.highest) == pytest.approx((45.0, 45.0))
    assert lever.computed == pytest.approx(45.0 / 31.0)  # HoA/λ, in meters per millimeter
    assert relative.verdict is Verdict.OPEN
    # The noise falls with the root of the looks: 10 and 40 are a factor of two apart, and 10 looks
    # have heavier tails by some percent.
    assert relative.highest / relative.lowest == pytest.approx(2.0, rel=0.08)
    assert [one.name for one in result.opened] == ["radar.looks"]


def test_report_of_a_table_says_what_is_not_known(tmp_path):
    study = TWO | {
        "formation": {"acquisitions": ACQUISITIONS},
        "claims": [
            {
                "text": "t",
                "printed": "45 m",
                "quantity": "height_of_ambiguity",
                "value": 45,
                "tolerance": 1,
                "formation": "long",
            }
        ],
        "open": [{"key": "radar.looks", "least": 10, "most": 40, "why": "posting"}],
    }
    path = tmp_path / "s.yaml"
    path.write_text(yaml.safe_dump(study), encoding="utf-8")
    assert main([str(path), "--out", str(tmp_path / "o"), "--format", "html", "--quiet"]) == 0
    result = json.loads((tmp_path / "o" / "result.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(result_schema()).validate(result)
    block = result["evaluate"]
    assert block["formation"]["separations"] is None
    assert [one["label"] for one in block["acquisitions"]] == ["long", "short"]
    assert len(block["acquisitions"][0]["satellites"][1]["segment_positions_rtn_m"]) == 3
    assert block["formation"]["unwrapping"]["rungs"][0]["images"] == ["long: S1→S2", "short: S1→S2"]
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    assert "whether the satellites keep apart at other times was not assessed" in page
    assert "Relative orbits of" not in page
    assert "Closest approach" not in page
    assert "Clohessy" not in page
    assert sorted(p.name for p in (tmp_path / "o").iterdir()) == [
        "claims.csv",
        "height_error.csv",
        "positions.csv",
        "report.html",
        "result.json",
    ]


# -- wrong input ---------------------------------------------------------------------------------

TABLE = TWO["formation"]["table"]
CLAIM = {"text": "t", "printed": "p", "quantity": "height_of_ambiguity", "value": 1}
WRONG = {
    "two shapes": (
        {"formation": {"table": TABLE, "acquisitions": ACQUISITIONS}},
        "needs exactly one of satellites, table and acquisitions; keep one of them",
    ),
    "no shape": ({"formation": {}}, "needs exactly one of satellites, table and acquisitions"),
    "two places": (
        {"formation": {"table": [{}, TABLE[1] | {"perpendicular_baseline_m": 2}]}},
        "contradicts perpendicular_baseline_m, the same place",
    ),
    "no place": ({"formation": {"table": [{}, {}]}}, "lacks its place; add position_rtn_m"),
    "baseline of the first": (
        {
            "formation": {
                "table": [{"perpendicular_baseline_m": 1}, {"perpendicular_baseline_m": 2}]
            }
        },
        "is the satellite that baselines start from",
    ),
    "along track of nothing": (
        {"formation": {"table": [{}, {"along_track_baseline_m": 2}]}},
        "belongs to a satellite that is given by its baseline",
    ),
    "family of a table": (
        {"formation": {"table": TABLE, "family": "space_circular"}},
        "makes orbits of z0_m and zdot0_m_s",
    ),
    "limit on orbits": (
        {"constraints": {"min_separation_m": 100}},
        "limits the orbits, and a formation given by positions has none that are known",
    ),
    "pairs": (
        {
            "formation": {"acquisitions": ACQUISITIONS},
            "errors": {"position_m": 0.001, "weighting": "pairs"},
        },
        "several acquisitions are combined by their images",
    ),
    "one label twice": (
        {"formation": {"acquisitions": [ACQUISITIONS[0], ACQUISITIONS[0]]}},
        "is used otherwise; choose another label",
    ),
    "ambiguity of zero": (
        {"formation": {"table": [{}, {"height_of_ambiguity_m": 0}]}},
        "height_of_ambiguity_m = 0 must be a number from 0.1 to 100000",
    ),
    "a place of two numbers": (
        {"formation": {"table": [{}, {"position_rtn_m": [1, 2]}]}},
        "position_rtn_m",
    ),
    "unknown formation": (
        {"claims": [CLAIM | {"formation": "lng"}]},
        "is no formation of this study",
    ),
    "unknown satellite": ({"claims": [CLAIM | {"pair": ["A", "C"]}]}, "is no satellite of this"),
    "segment beyond": ({"claims": [CLAIM | {"segment": 4}]}, "is above the scene's 3"),
    "pair of an error": (
        {"claims": [CLAIM | {"quantity": "height_error", "pair": ["A", "B"]}]},
        "has no meaning for height_error",
    ),
    "open key": ({"open": [{"key": "radar.look", "least": 1, "most": 2}]}, "did you mean 'looks'?"),
    "open block": (
        {"open": [{"key": "scene.strip.look_deg", "least": 1, "most": 2}]},
        "may not be left open",
    ),
    "open order": ({"open": [{"key": "radar.looks", "least": 2, "most": 2}]}, "is not above least"),
    "open value": (
        {"open": [{"key": "radar.looks", "least": 0, "most": 2}]},
        "is not possible there",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_tables_and_claims_are_one_message(name, tmp_path):
    blocks, text = WRONG[name]
    path = tmp_path / "s.yaml"
    path.write_text(yaml.safe_dump(TWO | blocks), encoding="utf-8")
    with pytest.raises(StudyError) as error:
        load_study(path)
    assert text in str(error.value)
    assert f"{path}:" in str(error.value)  # with the line


def test_list_of_another_length_is_refused_with_its_place(tmp_path, capsys):
    path = tmp_path / "s.yaml"
    formation = {"table": [{}, {"perpendicular_baseline_m": [1, 2]}]}
    path.write_text(yaml.safe_dump(TWO | {"formation": formation}), encoding="utf-8")
    assert main([str(path), "--check"]) == 2
    text = capsys.readouterr().err
    assert "has 2 entries and the scene has 3 segments" in text
    assert f"{Path(path)}:" in text


def test_geometry_of_a_placed_pair_is_that_of_its_positions():
    result = outcome()
    one = result.formation
    geometry = pair_geometry(one.scene_positions, result.problem.scene, radar=result.problem.radar)
    assert_allclose(geometry.height_of_ambiguity[:, 0], one.pairs[0].height_of_ambiguity)


def test_names_of_pairs_say_which_acquisition_they_are_of():
    result = outcome(formation={"acquisitions": ACQUISITIONS})
    names = [
        pair_name(result.problem, result.formation, rung.images)
        for rung in result.formation.unwrapping.rungs
    ]
    assert names == ["short − long", "long"]
    three = [
        {"label": one["label"], "table": [*one["table"], {"perpendicular_baseline_m": 100}]}
        for one in ACQUISITIONS
    ]
    result = outcome(formation={"acquisitions": three})
    assert pair_name(result.problem, result.formation, (0, 3)) == "short: S1 · S2"
    assert pair_name(result.problem, result.formation, (1, 2)) == "long: S2 · S3"
    assert pair_name(result.problem, result.formation, (2, 4)) == "short: S1 · S3 − long: S1 · S3"


def test_a_claim_over_a_range_holds_for_any_segment_that_may_be_meant():
    """2 km at incidences of 25° and 45°: what height of ambiguity is meant?"""
    table = {
        "times_s": [0, 0],
        "slant_range_km": [562.5, 701.6],
        "look_deg": [22.9, 40.9],
        "incidence_deg": [24.9, 45.0],
        "azimuth_deg": [-90, -90],
    }
    claim = {
        "text": "t",
        "printed": "3.8 m",
        "quantity": "height_of_ambiguity",
        "over": "range",
        "value": 3.8,
        "tolerance": 0.05,
    }
    formation = {"table": [{}, {"perpendicular_baseline_m": 2000}]}
    blocks = {"scene": {"table": table}, "formation": formation}
    (open_one,) = outcome(**blocks, claims=[claim]).claims
    # λ r sin θ/2000 by hand: 3.671 m and 7.690 m.
    assert (open_one.lowest, open_one.highest) == pytest.approx((3.671, 7.690), abs=2e-3)
    assert open_one.verdict is Verdict.OPEN
    (wide,) = outcome(**blocks, claims=[claim | {"value": 5.5, "tolerance": 2.5}]).claims
    assert wide.verdict is Verdict.HOLDS


# -- the simulation of combined acquisitions -----------------------------------------------------


def test_simulation_of_two_coverages_agrees_with_their_combination():
    result = outcome(
        radar=TWO["radar"] | {"looks": 80},  # so many that the bound is reached within 2 %
        formation={"acquisitions": ACQUISITIONS},
        refutation={"samples": 4000, "seed": 5},
    )
    refutation = result.formation.refutation
    assert refutation.verdict is simulation.Verdict.AGREES
    worst = refutation.segments[0]
    # Three sampling errors of 2000 draws are 5 %.
    assert worst.right_cycles.value == pytest.approx(worst.predicted_total, rel=0.05)
    assert worst.relative.value == pytest.approx(worst.predicted_relative, rel=0.06)
    # Together they unwrap what the shorter height of ambiguity does not.
    apart = result.acquisitions[1].refutation.segments[0]
    assert worst.wrong.value < 0.001 < 0.02 < apart.wrong.value


def test_simulation_of_a_repeated_acquisition_knows_what_is_common():
    """Four times the same: noise halves, the range error of 0.5 m stays."""
    positions = np.zeros((2, 3, 3))
    positions[:, 1:] = np.array([40.0, 120.0])[:, None] * np.cross(
        SCENE.line_of_sight[0], [0.0, 1.0, 0.0]
    )
    errors = ErrorBudget(range=ErrorSource(0.5, SharedBy.ALL))
    arguments = {"radar": RADAR, "errors": errors, "prior_height_std": 4.0, "samples": 3000}
    one = simulation.refute(positions, SCENE, rng=np.random.default_rng(1), **arguments)
    four = simulation.refute(
        np.stack([positions] * 4), SCENE, rng=np.random.default_rng(2), combined=True, **arguments
    )
    ratio = one.segments[0].relative.value / four.segments[0].relative.value
    assert ratio == pytest.approx(2.0, rel=0.1)  # 4 σ of the samples drawn of nine images
    common = 0.5 * math.cos(SCENE.incidence[0])
    shared = four.segments[0].right_cycles.value ** 2 - four.segments[0].relative.value ** 2
    assert math.sqrt(shared) == pytest.approx(common, rel=0.1)
