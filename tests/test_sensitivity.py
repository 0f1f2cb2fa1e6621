"""What limits an elevation model: elasticities and values that pass, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from formation import ground_track_circular
from insar import (
    Calibration,
    Cell,
    CoherenceBudget,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    Ionosphere,
    PhaseStatistics,
    Radar,
    Scale,
    Scene,
    SharedBy,
    height_error,
    pair_critical_baseline,
    pair_geometry,
)
from insar.coherence import (
    PenetratedVolume,
    ProfileVolume,
    TemporalDecorrelation,
    UniformVolume,
    quantization_coherence,
)
from insar.dem import HRTI3, HRTI4, Resolution, Specification
from insar.dem import Quantity as Demand
from optimize import Constraints, DemRequest, Problem, dem_verdict, looks_for
from optimize.budget import budget_items
from optimize.sensitivity import Quantity, Study, quantities, remedies, sensitivities

MEAN_MOTION = 1.1e-3
SCENE = Scene.broadside_strip(
    times=[0.0, 5.0], look_angle=np.deg2rad(32.0), altitude=514e3, earth_radius=6371e3
)
RADAR = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0, images=((0, 0), (0, 1))
)
CALIBRATION = Calibration(
    swath=30e3, length=100e3, spacing_across=10e3, spacing_along=10e3, accuracy=1.0, bias=0.2
)


def _study(radius=150.0, *, radar=RADAR, prior=4.0, **errors):
    states = np.stack(
        [
            ground_track_circular(z0, 0.0, mean_motion=MEAN_MOTION)
            for z0 in (-radius / 2, radius / 2)
        ]
    )
    problem = Problem(
        mean_motion=MEAN_MOTION,
        scene=SCENE,
        radar=radar,
        # Closed forms are of the Cramér-Rao bound.
        errors=ErrorBudget(phase_statistics=PhaseStatistics.CRAMER_RAO, **errors),
        constraints=Constraints(prior_height_std=prior),
    )
    positions = problem.population(states[None]).positions[0]
    return Study(problem=problem, positions=positions, cell=Cell())


FULL = {
    "position": ErrorSource(1e-3, SharedBy.SATELLITE),
    "range": ErrorSource(0.3, SharedBy.ALL),
    "synchronization": ErrorSource(0.05, SharedBy.IMAGE),
    "troposphere": ErrorSource(0.5, SharedBy.ALL, Scale.DATA_TAKE),
}


def test_elasticity_of_a_source_is_its_share_of_the_variance():
    """The weights are optimal, so only the direct change counts (envelope theorem)."""
    study = _study(**FULL)
    error = height_error(study.positions, SCENE, radar=RADAR, errors=study.problem.errors)
    total = np.sum(error.total**2)
    found = {one.item: one.elasticities[Quantity.TOTAL] for one in sensitivities(study)}
    for name in FULL:
        assert found[name] == pytest.approx(np.sum(error.terms[name] ** 2) / total, abs=1e-5)
    assert found["looks"] == pytest.approx(
        -0.5 * np.sum(error.terms["phase"] ** 2) / total, abs=1e-5
    )


def test_elasticities_without_systematic_errors_in_closed_form():
    found = {one.item: one.elasticities for one in sensitivities(_study())}
    assert found["looks"][Quantity.TOTAL] == pytest.approx(-0.5, abs=1e-6)
    for quantity in (Quantity.RELATIVE, Quantity.ABSOLUTE):
        # At 90 % a little more, since more looks also bring the noise nearer to normal.
        assert found["looks"][quantity] == pytest.approx(-0.52, abs=0.03)
    # Phase noise of two images at SNR s: (1 − γ²)/2γ² with γ = s/(1 + s) is (1 + 2s)/2s².
    snr = RADAR.snr
    assert found["snr"][Quantity.TOTAL] == pytest.approx(-(1 + snr) / (1 + 2 * snr), abs=1e-5)
    # Filtering leaves 1 − s of the looks, s = B⊥/B_crit: the error goes as 1/(s √(1 − s)).
    study = _study()
    geometry = pair_geometry(
        study.positions, SCENE, radar=RADAR, held_constant=HeldConstant.DOPPLER
    )
    share = (
        np.abs(geometry.perpendicular_baseline[:, 0]) / pair_critical_baseline(SCENE, RADAR)[:, 0]
    )
    expected = np.mean(-1.0 + share / (2.0 * (1.0 - share)))
    assert found["baselines"][Quantity.TOTAL] == pytest.approx(expected, abs=1e-4)
    assert found["prior_height"][Quantity.TOTAL] == 0.0


def test_what_is_not_there_is_no_item():
    names = {item.name for item in budget_items(_study().problem, _study().positions)}
    assert names == {"snr", "looks", "slant_range_resolution", "prior_height", "baselines"}
    everything = _study(
        radar=replace(RADAR, azimuth_resolution=3.0),
        **FULL,
        azimuth=ErrorSource(1e-6, SharedBy.ALL),
        ionosphere=Ionosphere(electrons=1e16),
        calibration=CALIBRATION,
    )
    names |= {*FULL, "azimuth", "ionosphere", "azimuth_resolution"}
    names |= {"calibration_spacing", "calibration_accuracy", "calibration_bias"}
    found = {item.name for item in budget_items(everything.problem, everything.positions)}
    assert found == names


COHERENCE = CoherenceBudget(
    quantization_bits=2,
    rasr=(0.01, 0.02),
    aasr=0.005,
    range_shift=0.1,
    azimuth_shift=0.05,
    processing=0.98,
    volume=UniformVolume(height=4.0),
    temporal=TemporalDecorrelation(time_constant=100.0, image_times=(0.0, 5.0)),
)


def test_elasticities_of_the_coherence_in_closed_form():
    """The error of two images goes as √(1 − γ²)/γ: d ln e/d ln γ = −1/(1 − γ²)."""
    budget = replace(COHERENCE, volume=None, temporal=None, rasr=0.02)
    radar = replace(RADAR, other_coherence=0.97)
    study = _study(radar=radar, coherence=budget)
    found = {one.item: one.elasticities[Quantity.TOTAL] for one in sensitivities(study)}
    shifts = np.sinc(0.1) * np.sinc(0.05)
    noise = 1.0 / (1.0 + 1.0 / radar.snr)
    coherence = noise * 0.97 * quantization_coherence(2) * shifts * 0.98 / (1.02 * 1.005)
    answer = -1.0 / (1.0 - coherence**2)

    def of_shift(shift):  # d ln sinc(x)/d ln x
        return np.pi * shift / np.tan(np.pi * shift) - 1.0

    expected = {
        "rasr": -0.02 / 1.02,
        "aasr": -0.005 / 1.005,
        "range_shift": of_shift(0.1),
        "azimuth_shift": of_shift(0.05),
        "processing_loss": -0.02 / 0.98,
        "other_loss": -0.03 / 0.97,
    }
    for name, of_coherence in expected.items():
        assert found[name] == pytest.approx(answer * of_coherence, rel=1e-4), name
    assert np.isnan(found["quantization_bits"])  # there is no half a bit


@pytest.mark.parametrize(
    ("volume", "value"),
    [
        (UniformVolume(height=4.0), 4.0),
        (PenetratedVolume(depth=2.0), 2.0),
        (ProfileVolume(heights=(1.0, 6.0), powers=(1.0, 2.0)), 5.0),
    ],
)
def test_volume_and_time_are_items(volume, value):
    study = _study(coherence=replace(COHERENCE, volume=volume))
    found = {one.item: one for one in sensitivities(study)}
    assert found["volume_height"].value == pytest.approx(value)
    assert found["rasr"].value == 0.02  # the largest of the segments
    assert found["volume_height"].elasticities[Quantity.TOTAL] > 0.0
    assert found["time_constant"].elasticities[Quantity.TOTAL] < 0.0


def test_bits_that_pass_are_whole_and_one_less_fails():
    study = _study(coherence=replace(COHERENCE, quantization_bits=1))

    def relative(bits):
        coherence = replace(COHERENCE, quantization_bits=bits)
        problem = replace(study.problem, errors=replace(study.problem.errors, coherence=coherence))
        return quantities(problem, study.positions, study.cell)[Quantity.RELATIVE].max()

    found = remedies(study, Quantity.RELATIVE, 1.0001 * relative(3))
    assert _of(found, "quantization_bits").needed == pytest.approx(3.0, abs=1e-5)
    assert relative(2) > 1.0001 * relative(3)
    assert (
        _of(remedies(study, Quantity.RELATIVE, 0.5 * relative(8)), "quantization_bits").needed
        is None
    )


def test_two_like_acquisitions_answer_like_one_and_need_half_the_looks():
    one = _study()
    two = replace(one, positions=np.stack([one.positions] * 2), combined=True, known={})
    alone, both = (
        quantities(study.problem, study.positions, study.cell, combined=study.combined)
        for study in (one, two)
    )
    np.testing.assert_allclose(both[Quantity.TOTAL], alone[Quantity.TOTAL] / np.sqrt(2.0))
    found = {item.item: item.elasticities[Quantity.TOTAL] for item in sensitivities(two)}
    expected = {item.item: item.elasticities[Quantity.TOTAL] for item in sensitivities(one)}
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, abs=1e-6), name
    limit = alone[Quantity.TOTAL].max() / 2.0
    needed = [_of(remedies(study, Quantity.TOTAL, limit), "looks").needed for study in (one, two)]
    assert needed[1] == pytest.approx(needed[0] / 2.0, rel=0.06)  # exact at many looks


def test_ambiguities_that_pass_in_closed_form():
    """From −10 dB to where the coherence is that of −20 dB, by any other road the same."""
    study = _study(coherence=CoherenceBudget(rasr=0.1))
    better = _study(coherence=CoherenceBudget(rasr=0.01))
    limit = quantities(better.problem, better.positions, better.cell)[Quantity.ABSOLUTE].max()
    needed = _of(remedies(study, Quantity.ABSOLUTE, limit), "rasr").needed
    assert needed == pytest.approx(0.01, rel=1e-6)


def test_a_single_look_has_a_one_sided_elasticity():
    study = _study(radar=replace(RADAR, looks=1.0))
    looks = next(one for one in sensitivities(study) if one.item == "looks")
    assert looks.elasticities[Quantity.TOTAL] == pytest.approx(-0.5, abs=1e-3)


def _of(found, name):
    return next(remedy for remedy in found if remedy.item == name)


def test_needed_looks_of_phase_noise_in_closed_form():
    study = _study()
    worst = quantities(study.problem, study.positions, study.cell)[Quantity.RELATIVE].max()
    found = remedies(study, Quantity.RELATIVE, worst / 3.0)
    # Nine times, but for the few percent by which 16 looks fall short of their bound.
    assert _of(found, "looks").needed == pytest.approx(9.0 * RADAR.looks, rel=0.1)
    total = quantities(study.problem, study.positions, study.cell)[Quantity.TOTAL].max()
    exact = _of(remedies(study, Quantity.TOTAL, total / 3.0), "looks").needed
    assert exact == pytest.approx(9.0 * RADAR.looks, rel=0.1)
    # The prior height does not change the error and is no remedy at all.
    assert "prior_height" not in {remedy.item for remedy in found}


@pytest.mark.parametrize("quantity", [Quantity.RELATIVE, Quantity.ABSOLUTE])
def test_needed_values_pass_and_a_little_less_does_not(quantity):
    study = _study(**FULL, calibration=replace(CALIBRATION, over=Scale.SCENE))
    worst = quantities(study.problem, study.positions, study.cell)[quantity].max()
    limit = 0.93 * worst
    found = remedies(study, quantity, limit)
    suffices = [remedy for remedy in found if remedy.needed is not None]
    assert len(suffices) >= 3
    items = {item.name: item for item in study.items}
    for remedy in suffices:
        factor = remedy.needed / remedy.value
        passing = quantities(*items[remedy.item].changed(factor), study.cell)[quantity].max()
        assert passing <= limit * (1 + 1e-6)
        halfway = factor**0.5  # between what is and what is needed
        short = quantities(*items[remedy.item].changed(halfway), study.cell)[quantity].max()
        assert short > limit
        assert 0.0 <= remedy.probability <= 1.0
    changes = [abs(np.log(remedy.needed / remedy.value)) for remedy in suffices]
    assert changes == sorted(changes)


def test_no_item_alone_suffices_where_two_errors_are_too_large():
    study = _study(
        range=ErrorSource(1.0, SharedBy.ALL, Scale.SCENE),
        troposphere=ErrorSource(1.0, SharedBy.ALL, Scale.SCENE),
    )
    found = remedies(study, Quantity.ABSOLUTE, 0.5)
    assert found
    assert all(remedy.needed is None for remedy in found)
    assert {"range", "troposphere", "looks"} <= {remedy.item for remedy in found}


def test_longer_baselines_pass_and_cost_unwrapping():
    study = _study(radius=30.0)
    worst = quantities(study.problem, study.positions, study.cell)[Quantity.RELATIVE].max()
    remedy = _of(remedies(study, Quantity.RELATIVE, worst / 4.0), "baselines")
    before = 1.0 - study.changed(study.items[-1], 1.0)[Quantity.FAILURE].max()
    assert remedy.needed == pytest.approx(4.0, rel=0.1)
    assert remedy.probability < before


REQUEST = DemRequest(
    posting=12.0,
    resolution=Resolution(slant_range=3.0, azimuth=3.0),
    specifications=(HRTI3, HRTI4),
)


def test_looks_of_a_posting_are_those_of_the_worst_segment():
    incidence = np.deg2rad([30.0, 35.0])
    looks = looks_for(REQUEST, incidence=incidence, slope=[0.0, 0.0])
    assert looks == pytest.approx(144.0 * np.sin(incidence[0]) / 9.0)
    with pytest.raises(ValueError, match=r"finer than the radar resolves.*at least 4"):
        looks_for(replace(REQUEST, posting=2.0), incidence=incidence, slope=0.0)


def test_verdict_says_what_passes_what_fails_and_why():
    study = _study(radius=300.0, **FULL, calibration=CALIBRATION)
    verdict = dem_verdict(study.problem, study.positions, label="best", request=REQUEST)
    third, fourth = verdict.judgments
    assert third.passed
    assert not fourth.passed
    failed = {one.criterion.quantity: one for one in verdict.failed}
    assert failed[Demand.POSTING].remedies == ()
    assert {one.specification for one in verdict.failed} == {"HRTI-4"}
    assert verdict.posting == 12.0
    text = " ".join(verdict.notes)
    assert "HRTI-4" in text  # unconfirmed
    assert "not those of its posting" in text  # 16 looks are stated
    agreed = looks_for(REQUEST, incidence=SCENE.incidence, slope=SCENE.slope)
    fitting = replace(study.problem, radar=replace(RADAR, looks=agreed))
    verdict = dem_verdict(fitting, study.positions, label="best", request=REQUEST)
    assert verdict.posting_of_looks == pytest.approx(12.0)
    assert "not those of its posting" not in " ".join(verdict.notes)


def test_verdict_without_azimuth_resolution_does_not_judge_the_posting():
    study = _study()
    request = DemRequest(specifications=(HRTI3,))
    verdict = dem_verdict(study.problem, study.positions, label="best", request=request)
    assert verdict.posting is None
    assert "posting is not judged" in verdict.notes[0]
    assert {c.quantity for c in verdict.judgments[0].criteria} == {Demand.RELATIVE, Demand.ABSOLUTE}


def test_verdict_on_a_formation_that_measures_nothing():
    study = _study(radius=0.0, **FULL)
    mine = Specification(name="mine", relative_90=1.0)
    request = DemRequest(specifications=(mine,))
    verdict = dem_verdict(study.problem, study.positions, label="best", request=request)
    assert not verdict.judgments[0].passed
    assert verdict.failed[0].remedies == ()
    assert all(np.isnan(one.elasticities[Quantity.TOTAL]) for one in verdict.sensitivities)
