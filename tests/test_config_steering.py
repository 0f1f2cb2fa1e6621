"""Studies of steering: what they compute, the shipped ones, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from configs import (
    SteeringStudy,
    StudyError,
    effective_text,
    example_path,
    example_text,
    load_study,
)
from configs.steered import build_steering
from formation.constants import EARTH_EQUATORIAL_RADIUS
from insar import LookSide, Relation, Verdict
from insar.observe import (
    Effect,
    FixedIncidence,
    FixedLook,
    Held,
    Law,
    Quantity,
    assess_case,
    compensate,
    judge,
    select,
)

CIRCLE = {"altitude_km": 514, "inclination_deg": 97.44}
MINIMAL = {
    "kind": "steering",
    "radar": {"wavelength_m": 0.031},
    "boresight": {"incidence_deg": 35},
    "cases": [{"name": "A", "orbit": CIRCLE}],
}


def built(**keys):
    return build_steering(SteeringStudy.model_validate(MINIMAL | keys))


def case(**keys):
    return built(cases=[{"name": "A", "orbit": CIRCLE} | keys]).cases[0]


# --- cases ---------------------------------------------------------------------------------------


def test_a_case_takes_what_it_does_not_say_from_the_study():
    made = built().cases[0]
    assert (made.name, made.wavelength, made.side) == ("A", 0.031, LookSide.RIGHT)
    assert made.boresight == FixedIncidence(math.radians(35))
    assert made.laws == tuple(Law)
    np.testing.assert_allclose(np.degrees(made.swath_offsets), [-0.5, -0.25, 0, 0.25, 0.5])


def test_a_case_may_differ_from_the_study():
    made = case(side="left", boresight={"look_deg": 30}, laws=["pitch_roll", "none"])
    assert made.side is LookSide.LEFT
    assert made.boresight == FixedLook(math.radians(30))
    assert made.laws == (Law.PITCH_ROLL, Law.NONE)


def test_samples_span_the_revolutions_from_the_node_on():
    made = built(samples=361, revolutions=2).cases[0]
    period = 2 * math.pi * math.sqrt((EARTH_EQUATORIAL_RADIUS + 514e3) ** 3 / 3.986004418e14)
    assert len(made.times) == 721
    np.testing.assert_allclose(made.times[[0, 360, 720]], [0, period, 2 * period], rtol=1e-12)
    result = assess_case(made)
    # J2 makes a revolution from node to node 0.1 % shorter than Kepler's.
    assert np.degrees(result.argument_of_latitude[0]) == pytest.approx(0.0, abs=0.05)
    assert np.degrees(result.argument_of_latitude[-1]) == pytest.approx(720.0, rel=2e-3)


# --- selections, compensation, claims ------------------------------------------------------------


def test_a_selection_reaches_its_request():
    block = {
        "held": "look",
        "angle_deg": 7.5,
        "altitudes_km": [1000, 2000],
        "altitude_samples": 3,
        "inclinations_deg": [30, 80],
        "eccentricity": 0.003,
        "argument_of_perigee_deg": 45,
        "side": "left",
        "samples": 91,
        "slew_rate_deg_s": 0.03,
        "swath_offset_deg": 0.4,
    }
    (request,) = built(selections=[block]).selections
    np.testing.assert_allclose(request.altitudes, [1e6, 1.5e6, 2e6])
    np.testing.assert_allclose(np.degrees(request.inclinations), [30, 80])
    assert (request.held, request.side, request.samples) == (Held.LOOK, LookSide.LEFT, 91)
    assert (request.eccentricity, request.wavelength) == (0.003, 0.031)
    angles = (
        request.boresight_angle,
        request.argument_of_perigee,
        request.slew_rate,
        request.swath_offset,
    )
    np.testing.assert_allclose(np.degrees(angles), [7.5, 45, 0.03, 0.4])


@pytest.mark.parametrize(
    ("size", "axis"),
    [
        ({"altitude_km": 532}, 6_910_137.0),
        ({"semi_major_axis_km": 6910.5}, 6_910_500.0),
        ({"period_min": 95.278}, 6_910_168.0),  # √(a³/μ)·2π = 5716.68 s
    ],
)
def test_a_compensation_reaches_its_request(size, axis):
    block = {"inclination_deg": 97.5, "look_deg": 35, "eccentricity_samples": 6, **size}
    request = built(compensation=block).compensation
    assert request.semi_major_axis == pytest.approx(axis, abs=1.0)
    np.testing.assert_allclose(np.degrees([request.inclination, request.look_angle]), [97.5, 35])
    np.testing.assert_allclose(np.degrees(request.arguments_of_perigee), [0, 90])
    np.testing.assert_allclose(request.eccentricities, np.arange(6) * 1e-3, atol=1e-15)
    assert (request.eccentricity, request.side) == (0.002, LookSide.RIGHT)


COMPENSATION = {"period_min": 95.278, "inclination_deg": 97.5, "look_deg": 35}
SELECTION = {"held": "look", "angle_deg": 7.5, "inclinations_deg": [30]}


@pytest.mark.parametrize(
    ("keys", "value", "unit"),
    [
        ({"quantity": "largest_yaw", "case": "A", "law": "yaw"}, math.radians(2), "°"),
        ({"quantity": "largest_residual_doppler", "case": "A", "law": "none"}, 2.0, "Hz"),
        (
            {"quantity": "slew_time", "case": "A", "law": "yaw", "rate_deg_s": 0.01},
            120.0,
            "min",
        ),
        ({"quantity": "slew_ratio", "case": "A", "law": "yaw", "other_law": "none"}, 2.0, ""),
        ({"quantity": "crossover_altitude", "held": "look", "inclination_deg": 30}, 2e3, "km"),
        ({"quantity": "compensation", "effect": "all"}, 0.02, "%"),
        ({"quantity": "deviation_slope"}, 2.0, "m/s"),
    ],
)
def test_a_claim_is_counted_in_the_unit_of_its_quantity(keys, value, unit):
    claim = {"text": "t", "printed": "p", "value": 2, "tolerance": 1, "note": "n"} | keys
    (made,) = built(claims=[claim], compensation=COMPENSATION, selections=[SELECTION]).claims
    assert made.value == pytest.approx(value)
    assert made.tolerance == pytest.approx(value / 2)
    assert made.scale == pytest.approx(value / 2)
    assert made.unit == unit
    assert made.quantity is Quantity(keys["quantity"])
    assert (made.text, made.printed, made.note) == ("t", "p", "n")
    assert made.relation is Relation.EQUALS


def test_every_key_of_a_claim_reaches_it():
    claims = [
        {
            "quantity": "slew_time",
            "case": "A",
            "law": "pitch_roll",
            "rate_deg_s": 0.03,
            "relation": "at_most",
        },
        {"quantity": "compensation", "effect": "j2", "argument_of_perigee_deg": 90},
        {"quantity": "compensation", "eccentricity": 0.003},
        {"quantity": "crossover_altitude", "held": "look", "inclination_deg": 30},
    ]
    text = {"text": "t", "printed": "p", "value": 1}
    made = built(
        claims=[text | claim for claim in claims],
        compensation=COMPENSATION,
        selections=[SELECTION],
    ).claims
    assert (made[0].case, made[0].law, made[0].relation) == ("A", Law.PITCH_ROLL, Relation.AT_MOST)
    assert made[0].rate == pytest.approx(math.radians(0.03))
    assert made[1].effect is Effect.J2
    assert made[1].argument_of_perigee == pytest.approx(math.pi / 2)
    assert made[2].eccentricity == 0.003
    assert made[3].held is Held.LOOK
    assert made[3].inclination == pytest.approx(math.radians(30))


# --- the shipped examples ------------------------------------------------------------------------


def verdicts(name):
    """Text and verdict of every claim of a shipped example."""
    setup = build_steering(load_study(example_path(name)).study)
    cases = tuple(assess_case(each) for each in setup.cases)
    selections = tuple(select(each) for each in setup.selections)
    compensation = None if setup.compensation is None else compensate(setup.compensation)
    return [
        judge(claim, cases=cases, selections=selections, compensation=compensation)
        for claim in setup.claims
    ]


def test_terrasar_x_is_steered_as_published():
    found = [claim.verdict is Verdict.HOLDS for claim in verdicts("terrasar_x")]
    # The pitch is within the published ±0.07° on the ellipse, and not under J2.
    assert found == [True, True, False, True]


def test_the_claims_of_meng_have_the_verdicts_of_the_reference():
    """physics.md section 4: 1.59 m/s, 93.5 %, 95.2 to 95.4 %, 18.5 kHz."""
    found = {claim.text: claim for claim in verdicts("meng2003_yaw")}
    assert {text for text, claim in found.items() if claim.verdict is not Verdict.HOLDS} == {
        "Eccentricity that leaves 95 % compensated",
        "Doppler of an unsteered X-band radar",
    }
    expected = {
        "Effect of the Earth's shape": 1.59,
        "Eccentricity that leaves 95 % compensated": 93.5,
        "All effects together, eccentricity 0.002": 95.2,
        "Doppler of an unsteered X-band radar": 18_500,
    }
    computed = {text: found[text].computed for text in expected}
    assert computed == pytest.approx(expected, rel=2e-3)  # the last digits of the reference


def test_the_claims_of_zhao_have_the_verdicts_of_the_reference():
    """physics.md section 4: what does not hold, and what the stated inputs give instead."""
    failed = {
        claim.text: claim.computed
        for claim in verdicts("zhao2019_geosar")
        if claim.verdict is not Verdict.HOLDS
    }
    assert failed == pytest.approx(
        {
            "Yaw of yaw-pitch steering, MEO": 13.35,
            "Yaw of yaw-pitch steering, GEO": 75.04,
            "Time to turn at 0.01 °/s, pitch-roll steering": 12.56,
            "Time to turn at 0.03 °/s, yaw-pitch steering": 41.69,
            "Rate of yaw-pitch against pitch-roll steering at 60°": 7.99,
            "Crossover at an inclination of 30°, incidence held": 14_886,
            "Crossover at an inclination of 80°, incidence held": 12_401,
        },
        rel=2e-3,  # of the crossovers, whose altitudes are interpolated; the others to 1e-3
    )


# --- what is refused -----------------------------------------------------------------------------

TERRASAR_X = example_text("terrasar_x")
ZHAO = example_text("zhao2019_geosar")
MENG = example_text("meng2003_yaw")

# (example, old, new, where the message points, what it says)
WRONG = {
    "unknown law": (
        TERRASAR_X,
        "laws: [none, yaw, ",
        "laws: [none, raney, ",
        "raney",
        "laws[#2] = 'raney' must be one of none, yaw, yaw_pitch_approximate, yaw_pitch, "
        "pitch_roll; correct the text",
    ),
    "law listed twice": (
        TERRASAR_X,
        "laws: [none, yaw, ",
        "laws: [none, none, ",
        "none, yaw_pitch_app",
        "laws[#2] = 'none' is listed twice; list each law once",
    ),
    "law listed twice in a case": (
        ZHAO,
        "incidence_deg: 15}, laws: [yaw_pitch, pitch_roll]",
        "incidence_deg: 15}, laws: [yaw, yaw]",
        "yaw]",
        "cases[#4].laws[#2] = 'yaw' is listed twice; list each law once",
    ),
    "claim of an unknown case": (
        TERRASAR_X,
        "    case: TerraSAR-X\n    law: yaw_pitch\n    value",
        "    case: TerraSAR\n    law: yaw_pitch\n    value",
        "TerraSAR\n",
        "claims[#1].case = 'TerraSAR' is no case of this study; did you mean 'TerraSAR-X'? the "
        "cases are TerraSAR-X, the ellipse",
    ),
    "claim of a law that is not compared": (
        TERRASAR_X,
        "yaw_pitch_approximate, yaw_pitch, pitch_roll]",
        "yaw_pitch_approximate, pitch_roll]",
        "yaw_pitch\n    value",
        "claims[#1].law = 'yaw_pitch' is not compared in the case 'TerraSAR-X'; add it to the laws "
        "of the case, which are none, yaw, yaw_pitch_approximate, pitch_roll",
    ),
    "claim without what it needs": (
        ZHAO,
        "    rate_deg_s: 0.01\n    value: 125\n",
        "    value: 125\n",
        "text: Time to turn at 0.01 °/s, yaw-pitch",
        "claims[#12] lacks rate_deg_s, which slew_time needs; add case and law and rate_deg_s",
    ),
    "claim with what it does not need": (
        TERRASAR_X,
        "    relation: at_most\n    value: 50",
        "    rate_deg_s: 3\n    value: 50",
        "3\n    value: 50",
        "claims[#4].rate_deg_s = 3 has no meaning for largest_residual_doppler; remove it",
    ),
    "ratio of a law to itself": (
        ZHAO,
        "    other_law: pitch_roll\n    value: 10",
        "    other_law: yaw_pitch\n    value: 10",
        "yaw_pitch\n    value: 10",
        "claims[#18].other_law = 'yaw_pitch' is also the law 'yaw_pitch'; compare it with another",
    ),
    "claim of a selection that is not there": (
        ZHAO,
        "- held: look  ",
        "- held: incidence  ",
        "look\n    inclination_deg: 30",
        "claims[#23].held = 'look' is held by no selection; add the selection that is meant",
    ),
    "claim of an inclination that is not there": (
        ZHAO,
        "    held: look\n    inclination_deg: 30",
        "    held: look\n    inclination_deg: 35",
        "35\n",
        "claims[#23].inclination_deg = 35 is in no selection that holds the look; add it to its "
        "inclinations_deg, which are 30, 80",
    ),
    "claim of a compensation that is not there": (
        TERRASAR_X,
        "quantity: largest_yaw\n    case: TerraSAR-X\n    law: yaw_pitch\n",
        "quantity: deviation_slope\n",
        "deviation_slope",
        "claims[#1].quantity = 'deviation_slope' needs the block compensation; add it, or remove "
        "the claim",
    ),
    "claim beyond the sweep": (
        MENG,
        "    eccentricity: 0.003\n",
        "    eccentricity: 0.006\n",
        "0.006",
        "claims[#3].eccentricity = 0.006 lies outside compensation.eccentricities, 0 to 0.005; "
        "widen the sweep",
    ),
    "claim of another perigee": (
        MENG,
        "    effect: all\n",
        "    effect: all\n    argument_of_perigee_deg: 45\n",
        "45\n    value",
        "claims[#4].argument_of_perigee_deg = 45 is none of compensation.arguments_of_perigee_deg; "
        "add it there, or choose of 0, 90",
    ),
    "claim of two compensations": (
        MENG,
        "    effect: all\n",
        "    effect: all\n    eccentricity: 0.001\n",
        "text: All effects",
        "claims[#4] needs exactly one of effect and eccentricity; remove one of them",
    ),
    "missing block": (
        TERRASAR_X,
        "radar:\n  wavelength_m: 0.031\n",
        "",
        "kind:",
        "radar is missing (The radar); add this block as in the example that formation-opt --new "
        "terrasar_x prints",
    ),
    "two cases of one name": (
        ZHAO,
        "name: MEO",
        "name: LEO",
        "LEO\n    orbit:\n      altitude_km: 12000",
        "cases[#2].name = 'LEO' is used twice; choose another name",
    ),
    "no boresight": (
        TERRASAR_X,
        "boresight:\n  incidence_deg: 35  ",
        "boresight: {}  ",
        "boresight: {}",
        "boresight needs exactly one of incidence_deg and look_deg; add incidence_deg: 35",
    ),
    "beam that misses the Earth": (
        TERRASAR_X,
        "  incidence_deg: 35  ",
        "  look_deg: 70  ",
        "70  ",
        "boresight.look_deg = 70 misses the Earth in the case 'TerraSAR-X': from 506.666 km it "
        "must be below 67.88; choose a smaller look angle, or give the case a boresight of its own",
    ),
    "beam of a case that misses the Earth": (
        ZHAO,
        "boresight: {incidence_deg: 15}",
        "boresight: {look_deg: 15}",
        "15}, laws",
        "cases[#4].boresight.look_deg = 15 misses the Earth: from 35665.5 km it must be below "
        "8.73; choose a smaller look angle",
    ),
    "held look angle that misses the Earth": (
        ZHAO,
        "    angle_deg: 7.53\n",
        "    angle_deg: 75.3\n",
        "75.3",
        "selections[#1].angle_deg = 75.3 misses the Earth at all of the altitudes_km: from the "
        "lowest, 500 km, it must be below 67.60; choose a smaller look angle, or hold the "
        "incidence",
    ),
    "inclination listed twice": (
        ZHAO,
        "    altitude_samples: 143\n    inclinations_deg: [30, 80]\n    eccentricity: 0.003\n"
        "    argument_of_perigee_deg: 90\n    slew",
        "    inclinations_deg: [80, 30, 80]\n    slew",
        "80]",
        "selections[#1].inclinations_deg[#3] = 80 is listed twice; list each inclination once",
    ),
    "altitudes downward": (
        ZHAO,
        "altitudes_km: [500, 36000]\n    altitude_samples: 143\n    inclinations_deg: [30, 80]\n"
        "    eccentricity: 0.003\n    argument_of_perigee_deg: 90\n    slew",
        "altitudes_km: [36000, 500]\n    inclinations_deg: [30, 80]\n    slew",
        "[36000, 500]",
        "selections[#1].altitudes_km = [36000, 500] must grow: from, to; check that the two are "
        "not swapped",
    ),
    "compensation without a size": (
        MENG,
        "  period_min: 95.278 ",
        "  #",
        "compensation:",
        "compensation.altitude_km is missing; add a number from 150 to 50000 km (Height above the "
        "equatorial radius of the Earth, 6378.137 km)",
    ),
    "compensation of two sizes": (
        MENG,
        "  period_min: 95.278 ",
        "  altitude_km: 532\n  period_min: 95.278 ",
        "95.278 ",
        "compensation.period_min = 95.278 excludes altitude_km, which says the same; keep one",
    ),
    "sweep into the air": (
        MENG,
        "eccentricities: [0, 0.005] ",
        "eccentricities: [0, 0.1] ",
        "[0, 0.1]",
        "compensation.eccentricities = [0, 0.1] brings the perigee to -159 km, and below 100 km an "
        "orbit decays at once; choose a smaller eccentricity or a higher orbit",
    ),
    "period in seconds": (
        MENG,
        "period_min: 95.278 ",
        "period_min: 6310.5 ",
        "6310",
        "compensation.period_min = 6310.5 must be a number from 86 to 6000 minutes; if it is in "
        "seconds, write 105.175",
    ),
    "more samples than memory": (
        TERRASAR_X,
        "samples: 721              # default; of a revolution: every half degree\nrevolutions: 1 ",
        "samples: 100001\nrevolutions: 100 ",
        "100001",
        "samples = 100001 times revolutions, swath_offsets_deg, laws and cases makes 6.0e+08 "
        "values, and 2e+07 is the limit; take fewer of one of them",
    ),
    "decayed orbit of a case": (
        TERRASAR_X,
        "eccentricity: 0.00118 ",
        "eccentricity: 0.2 ",
        "0.2 ",
        "cases[#1].orbit.eccentricity = 0.2 brings the perigee to -864 km, and below 100 km an "
        "orbit decays at once; choose a smaller eccentricity or a higher orbit",
    ),
    "key of another kind": (
        TERRASAR_X,
        "side: right ",
        "scene: right ",
        "scene: right",
        "scene is not a known key; the keys of the study are kind, name, description, radar, side, "
        "boresight, laws, samples, revolutions, swath_offsets_deg, cases, selections, "
        "compensation, claims",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_study_of_steering_is_named_with_place_limit_and_remedy(
    tmp_path, monkeypatch, name
):
    base, old, new, where, says = WRONG[name]
    assert base.count(old) == 1, old
    text = base.replace(old, new)
    monkeypatch.chdir(tmp_path)
    Path("my.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(StudyError) as error:
        load_study(Path("my.yaml"))
    start = base.index(old)
    before = text[: text.index(where, start) if where in text[start:] else text.index(where)]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    assert str(error.value) == f"my.yaml:{line}:{column}: {says}"


@pytest.mark.parametrize("name", ["terrasar_x", "meng2003_yaw", "zhao2019_geosar"])
def test_the_effective_text_says_everything(tmp_path, name):
    original = load_study(example_path(name)).study
    text = effective_text(original)
    (tmp_path / "copy.yaml").write_text(text, encoding="utf-8")
    assert load_study(tmp_path / "copy.yaml").study == original
    assert "swath_offsets_deg" in text
    assert "revolutions: 1" in text
