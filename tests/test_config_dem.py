"""The blocks on atmosphere, calibration and elevation model: what they build and refuse."""

import numpy as np
import pytest
import yaml
from pydantic import ValidationError

from configs import OptimizeStudy, StudyError, effective_text, load_study
from configs.build import build_optimize
from insar import Calibration, Scale
from insar.atmosphere import TEC_UNIT
from insar.dem import HRTI3

STUDY = {
    "orbit": {"altitude_km": 514, "inclination_deg": 97.44},
    "radar": {
        "wavelength_m": 0.24,
        "slant_range_resolution_m": 3,
        "azimuth_resolution_m": 4,
        "snr_db": 10,
    },
    "scene": {"strip": {"look_deg": 30}},
    "errors": {
        "position_m": 0.001,
        "position_scale": "data_take",
        "range_m": 0.05,
        "range_scale": "mission",
        "troposphere": {"residual_zenith_delay_m": 0.03},
        "ionosphere": {"electrons_tecu": 20, "gradient_tecu_100km": 1, "scale": "orbit"},
        "calibration": {
            "over": "data_take",
            "swath_km": 40,
            "length_km": 500,
            "spacing_across_km": 10,
            "spacing_along_km": 5,
            "accuracy_m": 0.8,
            "bias_m": 0.1,
        },
    },
    "dem": {
        "posting_m": 12,
        "resolution_over_posting": 1.5,
        "specifications": [
            "hrti3",
            {"name": "mine", "relative_90_m": 1, "relative_90_steep_m": 2, "posting_m": 10},
        ],
    },
    "formation": {"satellites": 2},
}


def _changed(**changes):
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


def _refused(tmp_path, **changes):
    path = tmp_path / "my.yaml"
    path.write_text(yaml.safe_dump(_changed(**changes)), "utf-8")
    with pytest.raises(StudyError) as error:
        _build(path)
    return str(error.value)


def _build(path):
    return build_optimize(load_study(path).study)


def test_everything_arrives_in_si_units():
    setup = build_optimize(OptimizeStudy.model_validate(STUDY))
    errors = setup.problem.errors
    assert errors.position.scale is Scale.DATA_TAKE
    assert errors.range.scale is Scale.MISSION
    assert (errors.troposphere.std, errors.troposphere.scale) == (0.03, Scale.DATA_TAKE)
    assert errors.ionosphere.electrons == 20 * TEC_UNIT
    assert errors.ionosphere.gradient == pytest.approx(TEC_UNIT / 100e3)
    assert (errors.ionosphere.shell_height, errors.ionosphere.scale) == (350e3, Scale.ORBIT)
    assert errors.calibration == Calibration(
        swath=40e3,
        length=500e3,
        spacing_across=10e3,
        spacing_along=5e3,
        accuracy=0.8,
        bias=0.1,
        over=Scale.DATA_TAKE,
    )
    request = setup.dem
    assert request.cell.swath == 40e3  # the calibration's
    assert request.cell.size == 100e3
    third, mine = request.specifications
    assert third is HRTI3
    assert (mine.relative_90, mine.relative_90_steep, mine.absolute_90) == (1.0, 2.0, None)
    assert mine.steep == 0.2
    incidence = setup.problem.scene.incidence
    expected = ((1.5 * 12.0) ** 2 * np.sin(incidence) / 12.0).min()
    assert setup.problem.radar.looks == pytest.approx(expected)


def test_stated_looks_count_and_the_default_judges_nothing():
    setup = build_optimize(OptimizeStudy.model_validate(_changed(radar__looks=20, dem=None)))
    assert setup.problem.radar.looks == 20
    assert setup.dem.specifications == ()
    assert setup.dem.resolution.azimuth == 4.0


def test_swath_that_nobody_states_stays_clear_of_nadir():
    near = _changed(errors__calibration=None, scene={"strip": {"look_deg": 2}}, dem=None)
    setup = build_optimize(OptimizeStudy.model_validate(near))
    # As wide as nadir is away: the near edge lies halfway.
    assert setup.dem.cell.swath == pytest.approx(514e3 * np.tan(np.deg2rad(2.0)), rel=0.01)


def test_round_trip_through_yaml(tmp_path):
    study = OptimizeStudy.model_validate(STUDY)
    path = tmp_path / "again.yaml"
    path.write_text(effective_text(study), "utf-8")
    assert load_study(path).study == study


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"errors__calibration__spacing_across_km": 50},
            "spacing_across_km = 50 exceeds swath_km = 40",
        ),
        ({"errors__calibration__accuracy_m": 0}, "accuracy_m = 0 must be"),
        ({"errors__calibration__over": "pixel"}, "over = 'pixel' must be one of"),
        ({"errors__range_scale": "month"}, "range_scale = 'month' must be one of"),
        (
            {"errors__troposphere__zenith_delay_m": 2.4},
            "exactly one of zenith_delay_m and residual_zenith_delay_m; remove zenith_delay_m",
        ),
        ({"errors__troposphere": {}}, "add residual_zenith_delay_m: 0.03"),
        ({"errors__ionosphere__shell_height_km": 600}, "is not below the orbit at 514 km"),
        ({"radar__azimuth_resolution_m": None}, "add radar.azimuth_resolution_m: 3"),
        ({"dem__specifications": ["hrti5"]}, "hrti5"),
        ({"dem__specifications": ["hrti3", "hrti3"]}, "is listed twice"),
        ({"dem__specifications": [{"name": "mine"}]}, "asks nothing"),
        (
            {
                "dem__specifications": [
                    {"name": "mine", "absolute_90_m": 1, "relative_90_steep_m": 1}
                ]
            },
            "needs relative_90_m",
        ),
        ({"dem__posting_m": 2}, "finer than the radar resolves"),
        ({"dem__swath_km": 900}, "lies at nadir, beyond the horizon"),
        ({"errors__calibration__swath_km": 900}, "lies at nadir, beyond the horizon"),
    ],
)
def test_wrong_input_is_named_with_its_remedy(tmp_path, changes, said):
    assert said in _refused(tmp_path, **changes)


def test_a_specification_of_another_kind_is_refused():
    with pytest.raises(ValidationError):
        OptimizeStudy.model_validate(_changed(dem__specifications=[3]))
