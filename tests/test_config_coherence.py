"""The coherence budget, beams and backscatter of a study: what they build and refuse."""

import math

import numpy as np
import pytest
import yaml
from pydantic import ValidationError

from configs import OptimizeStudy, StudyError
from configs.build import build_optimize
from insar import image_amplitude, one_transmitter, snr_coherence
from insar.coherence import (
    AttenuatedVolume,
    TemporalDecorrelation,
    at_incidence,
    image_snr,
    quantization_coherence,
)

STUDY = {
    "orbit": {"altitude_km": 514, "inclination_deg": 97.44},
    "radar": {
        "wavelength_m": 0.031,
        "slant_range_resolution_m": 1,
        "azimuth_resolution_m": 3,
        "beams": [
            {"incidence_deg": 20, "nesz_db": -24, "rasr_db": -25},
            {"incidence_deg": 40, "nesz_db": -20, "rasr_db": -20},
        ],
    },
    "scene": {
        "strip": {"look_deg": 23, "segments": 2, "slope_deg": 5},
        "backscatter": {
            "incidence_deg": [10, 50],
            "sigma0_quantiles_db": {"p10": [-12, -17], "p50": [-6, -14]},
            "quantile": "p50",
        },
    },
    "errors": {
        "position_m": 0.001,
        "coherence": {
            "quantization_bits": 3,
            "aasr_db": -20,
            "coregistration_range_cells": 0.1,
            "volume": {"height_m": 8, "extinction_db_m": 0.3},
            "temporal": {"time_constant_s": 86400, "image_times_s": [0, 60]},
        },
    },
    "formation": {"satellites": 2},
}


def changed(**changes):
    study = yaml.safe_load(yaml.safe_dump(STUDY))
    for path, value in changes.items():
        *blocks, key = path.split("__")
        block = study
        for name in blocks:
            block = block[name]
        if value is None:
            block.pop(key, None)
        else:
            block[key] = value
    return study


def test_tables_are_read_at_the_incidence_of_the_segment():
    """Noise at the incidence on flat ground, 24.97°; backscatter at the local one, 5° less."""
    problem = build_optimize(OptimizeStudy.model_validate(STUDY)).problem
    flat = math.degrees(problem.scene.incidence[0])
    snr_db = (-6 - 8 * (flat - 5 - 10) / 40) - (-24 + 4 * (flat - 20) / 20)
    snr = image_snr(problem.scene, radar=problem.radar, errors=problem.errors)
    np.testing.assert_allclose(10 * np.log10(snr), snr_db, rtol=1e-9)
    rasr = 10 ** ((-25 + 5 * (flat - 20) / 20) / 10)
    amplitude = image_amplitude(problem.scene, radar=problem.radar, errors=problem.errors)
    expected = snr_coherence(10 ** (snr_db / 10), 10 ** (snr_db / 10)) * np.sinc(0.1)
    expected *= quantization_coherence(3) / (1.01 * (1 + rasr))
    np.testing.assert_allclose(amplitude.prod(axis=-1), expected, rtol=1e-9)
    assert problem.radar.azimuth_resolution == 3.0


def test_azimuth_resolution_of_a_doppler_bandwidth():
    """The speed of the zero-Doppler line, by turning the orbit a little over a sphere."""
    given = changed(radar__azimuth_resolution_m=None, radar__doppler_bandwidth_hz=2000)
    problem = build_optimize(OptimizeStudy.model_validate(given)).problem
    scene, turn = problem.scene, 1e-6
    central = scene.incidence[0] - scene.look_angle[0]
    # A ground point at the central angle off the orbit plane runs on a smaller circle.
    circle = 6378.137e3 * math.cos(central)
    speed = circle * turn / (turn / problem.mean_motion)
    assert problem.radar.azimuth_resolution == pytest.approx(speed / 2000, rel=1e-6)
    assert speed == pytest.approx(7020, abs=15)  # of 7605 m/s on the orbit


def test_swath_of_the_beams_where_nothing_else_gives_one():
    study = changed()
    for beam, swath in zip(study["radar"]["beams"], (40, 20), strict=True):
        beam["swath_km"] = swath
    study["dem"] = {}
    study["errors"]["calibration"] = {
        "length_km": 100,
        "spacing_across_km": 10,
        "spacing_along_km": 10,
        "accuracy_m": 1,
    }
    built = build_optimize(OptimizeStudy.model_validate(study))
    flat = math.degrees(built.problem.scene.incidence[0])
    swath = 40e3 - 20e3 * (flat - 20) / 20
    assert built.problem.errors.calibration.swath == pytest.approx(swath)
    assert built.dem.cell.swath == pytest.approx(swath)
    study["errors"]["calibration"]["swath_km"] = 25
    assert build_optimize(OptimizeStudy.model_validate(study)).dem.cell.swath == 25e3
    del study["errors"]["calibration"]["swath_km"]
    study["errors"]["calibration"]["spacing_across_km"] = 39
    with pytest.raises(StudyError, match="exceeds the swath of the beams"):
        build_optimize(OptimizeStudy.model_validate(study))
    del study["radar"]["beams"][0]["swath_km"]
    with pytest.raises(StudyError, match="gives swath_km at some incidences only"):
        build_optimize(OptimizeStudy.model_validate(study))
    del study["radar"]["beams"][1]["swath_km"]
    with pytest.raises(StudyError, match=r"errors\.calibration lacks swath_km"):
        build_optimize(OptimizeStudy.model_validate(study))


def test_azimuth_resolution_is_given_once():
    with pytest.raises(ValidationError, match="excludes azimuth_resolution_m"):
        OptimizeStudy.model_validate(changed(radar__doppler_bandwidth_hz=2000))


def test_volume_and_time_in_si():
    problem = build_optimize(OptimizeStudy.model_validate(STUDY)).problem
    budget = problem.errors.coherence
    # 0.3 dB/m is a factor 10^0.03 in power each meter.
    assert budget.volume == AttenuatedVolume(height=8.0, extinction=0.03 * math.log(10.0))
    assert isinstance(budget.temporal, TemporalDecorrelation)
    assert budget.temporal.image_times == (0.0, 60.0)
    assert budget.temporal.speed == pytest.approx(7605.0, abs=2.0)  # √(μ/a) at 514 km
    assert problem.radar.images == one_transmitter(2)


def test_table_is_linear_in_decibels_and_ends():
    table = np.radians([20.0, 40.0])
    assert at_incidence(np.radians(30.0), table=table, values=[1.0, 0.01]) == pytest.approx(0.1)
    with pytest.raises(ValueError, match=r"41° lies outside the table, 20° to 40°"):
        at_incidence(np.radians(41.0), table=table, values=[1.0, 0.01])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"scene__backscatter": None}, "needs the backscatter of the ground, once"),
        ({"radar__backscatter_db": -8}, "keep one"),
        ({"errors__coherence__rasr_db": -20}, "is given by radar.beams too"),
        ({"errors__coherence__image_snr_db": [0, 0, 0]}, "holds 3 numbers for 2 images"),
        ({"scene__strip": {"look_deg": 50}}, "lies outside the table"),
    ],
)
def test_what_does_not_fit_is_refused_when_it_is_built(changes, message):
    study = OptimizeStudy.model_validate(changed(**changes))
    with pytest.raises(StudyError, match=message):
        build_optimize(study)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"radar__snr_db": 10}, "excludes snr_db and nesz_db"),
        ({"scene__backscatter__quantile": "p70"}, "lacks the quantile to count with"),
        ({"errors__coherence__volume": {}}, "needs exactly one of height_m, penetration_m"),
        ({"errors__coherence__quantization_bits": 9}, "less than or equal to 8"),
        (
            {"errors__weighting": "pairs", "errors__phase_std_deg": 5},
            "has no effect where the phase noise itself is given",
        ),
    ],
)
def test_what_contradicts_itself_is_refused(changes, message):
    with pytest.raises(ValidationError, match=message):
        OptimizeStudy.model_validate(changed(**changes))
