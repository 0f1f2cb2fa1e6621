"""Terrain as a radar sees it, and its heights measured end to end."""

from __future__ import annotations

import dataclasses
import io
import json
import math
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from configs import StudyError, load_study
from formation import Orbit, ground_track_circular, relative_positions
from formation.constants import EARTH_EQUATORIAL_RADIUS
from formation_opt.cli import main
from insar import (
    ErrorBudget,
    ErrorSource,
    LookSide,
    Radar,
    Scale,
    Scene,
    SharedBy,
    one_transmitter,
    phase_model,
)
from insar.simulation import TerrainRequest, simulate_terrain
from insar.simulation.synthesis import at_range, path_phase
from insar.terrain import Terrain, view_terrain
from reports.json_result import result_schema

ORBIT = Orbit.circular(altitude=514e3, inclination=np.deg2rad(97.44))
LOOK, HEADING = np.deg2rad(34.0), np.deg2rad(350.0)


def hills(rows=40, columns=50, relief=60.0):
    """Smooth hills whose standard deviation is given."""
    noise = gaussian_filter(np.random.default_rng(5).standard_normal((rows, columns)), 4.0)
    return 500.0 + relief * noise / noise.std()


def seen(heights, *, side=LookSide.LEFT, heading=HEADING, posting=90.0, look=LOOK):
    return view_terrain(
        Terrain(heights=heights, posting_north=posting, posting_east=posting),
        orbit_radius=ORBIT.semi_major_axis,
        earth_radius=EARTH_EQUATORIAL_RADIUS,
        look_angle=look,
        side=side,
        heading=heading,
    )


def radar_of(count, looks=32.0):
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=looks,
        images=one_transmitter(count),
    )


def flown(z0, **changes):
    """A request whose satellites fly the ground-track family with these radial offsets."""
    n = ORBIT.mean_motion
    states = np.array([ground_track_circular(z, 0.0, mean_motion=n, sign=1) for z in z0])
    request = TerrainRequest(
        view=seen(hills()),
        radar=radar_of(len(z0)),
        errors=ErrorBudget(
            position=ErrorSource(0.001, SharedBy.SATELLITE),
            azimuth=ErrorSource(1.6e-6, SharedBy.ALL),
            range=ErrorSource(0.01, SharedBy.ALL),
        ),
        relative_positions=lambda times: relative_positions(states, times, mean_motion=n),
        mean_motion=n,
        prior_height_std=4.0,
        prior_correlation=200.0,
        acquisitions=4,
    )
    return dataclasses.replace(request, **changes)


# -- terrain -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"heights": np.zeros((2, 5))}, r"shape \(2, 5\).*3 rows"),
        ({"heights": np.full((3, 3), np.nan)}, "no finite value"),
        ({"heights": np.full((3, 3), -32768.0)}, "-32768 .*mark gaps"),
        ({"posting_east": 0.0}, "posting_east = 0.0 m"),
    ],
)
def test_wrong_terrain_is_refused(changes, message):
    good = {"heights": np.zeros((3, 3)), "posting_north": 90.0, "posting_east": 90.0}
    with pytest.raises(ValueError, match=message):
        Terrain(**(good | changes))


def test_flat_terrain_is_the_broadside_strip():
    """The middle of a flat terrain has the geometry of `Scene.broadside_strip`, to a millimeter."""
    view = seen(np.zeros((5, 5)))
    middle = np.zeros((5, 5), dtype=bool)
    middle[2, 2] = True
    scene = view.scene(middle, mean_motion=ORBIT.mean_motion)
    strip = Scene.broadside_strip(
        times=[0.0],
        look_angle=LOOK,
        altitude=ORBIT.altitude,
        earth_radius=EARTH_EQUATORIAL_RADIUS,
    )
    assert scene.slant_range == pytest.approx(strip.slant_range, abs=1e-3)
    assert scene.look_angle == pytest.approx(strip.look_angle, abs=1e-9)
    assert scene.incidence == pytest.approx(strip.incidence, abs=1e-9)
    assert scene.times == pytest.approx([0.0], abs=1e-9)
    assert view.seen.all()


@pytest.mark.parametrize("side", LookSide)
@pytest.mark.parametrize("heading", [0.0, 90.0, 190.0, 350.0])
def test_slope_is_positive_towards_the_radar(side, heading):
    """A plane that rises away from the radar by 10° faces it: at a range that grows with x."""
    flat = seen(np.zeros((21, 21)), side=side, heading=np.deg2rad(heading))
    view = seen(
        500.0 + flat.across * math.tan(math.radians(10.0)),
        side=side,
        heading=np.deg2rad(heading),
    )
    assert np.degrees(view.slope) == pytest.approx(np.full((21, 21), 10.0), abs=1e-9)
    scene = view.scene(view.seen, mean_motion=ORBIT.mean_motion)
    assert np.corrcoef(scene.slant_range, view.across[view.seen])[0, 1] > 0.99


def test_times_grow_along_the_flight():
    """At the ground speed of the line of zero Doppler: R n cos ψ = 7027 m/s (37 km: 5.25 s)."""
    view = seen(np.zeros((411, 3)), heading=0.0)
    times = view.times(view.seen, mean_motion=ORBIT.mean_motion).reshape(411, 3)
    assert times[0, 1] - times[-1, 1] == pytest.approx(36_900.0 / 7027.0, rel=0.001)


def test_layover_and_shadow_of_a_wall():
    """A wall of 1 km: layover towards the radar by H cot θ, shadow behind by H tan θ (4 %)."""
    heights = np.zeros((9, 801))
    heights[:, 400:405] = 1000.0
    # Flying south and looking left is looking east.
    view = seen(heights, heading=np.pi, posting=10.0)
    assert np.all(np.diff(view.across[4]) > 0.0)
    incidence = math.asin(ORBIT.semi_major_axis / EARTH_EQUATORIAL_RADIUS * math.sin(LOOK))
    before = np.count_nonzero(view.layover[4, :400]) * 10.0
    behind = np.count_nonzero(view.shadow[4, 405:]) * 10.0
    assert before == pytest.approx(1000.0 / math.tan(incidence), rel=0.04)
    assert behind == pytest.approx(1000.0 * math.tan(incidence), rel=0.04)


def test_gaps_are_not_seen():
    heights = hills()
    heights[10:12, 5] = np.nan
    view = seen(heights)
    assert not view.seen[9:13, 5].any()
    assert view.seen[20:].all()


@pytest.mark.parametrize(
    ("look", "posting", "message"),
    [(80.0, 90.0, "misses the Earth"), (2.0, 3000.0, "beyond nadir or the horizon")],
)
def test_terrain_that_is_not_seen_is_refused(look, posting, message):
    with pytest.raises(ValueError, match=message):
        seen(hills(), look=np.deg2rad(look), posting=posting)


# -- paths ---------------------------------------------------------------------------------------


def test_true_paths_have_the_vertical_wavenumber_of_the_model():
    """Raise each point at constant range by 1 m: the phases change by kz, to 0.3 % (one line of
    sight serves all satellites of the model, and 1 km of baseline at 600 km turns it by 0.2 %)."""
    request = flown((0.0, 141.0, 605.0))
    view = request.view
    scene = view.scene(view.seen, mean_motion=request.mean_motion)
    positions = request.relative_positions(scene.times)
    model = phase_model(positions, scene, radar=request.radar, errors=ErrorBudget())
    target, height = view.targets(view.seen), view.terrain.heights[view.seen]
    assert at_range(view, height, scene.slant_range) == pytest.approx(target, abs=1e-5)
    low, high = (
        path_phase(at_range(view, height + rise, scene.slant_range), positions, radar=request.radar)
        for rise in (-0.5, 0.5)
    )
    largest = np.abs(model.vertical_wavenumber).max()
    assert high - low == pytest.approx(model.vertical_wavenumber, abs=0.003 * largest)


# -- end to end ----------------------------------------------------------------------------------


def test_heights_without_errors_are_the_terrain():
    """No shared errors and nearly no noise: millimeters, so that geometry and signs are right."""
    request = flown(
        (0.0, 141.0, 605.0),
        radar=dataclasses.replace(radar_of(3, looks=400.0), snr=1e6),
        errors=ErrorBudget(),
        acquisitions=1,
    )
    result = simulate_terrain(request, rng=np.random.default_rng(1))
    clear = result.maps.clear
    assert np.abs(result.maps.least_squares_error[clear]).max() < 0.01
    assert np.abs(result.maps.likely_error[clear]).max() < 0.01
    assert result.wrong.simulated.value == 0.0


def test_terrain_agrees_with_the_model_point_by_point():
    """Random error within 5 %; total within three of its sampling errors."""
    request = flown((0.0, 141.0, 605.0), acquisitions=12)
    result = simulate_terrain(request, rng=np.random.default_rng(2))
    assert result.points > 1900
    assert result.random.simulated.value == pytest.approx(result.random.predicted, rel=0.05)
    assert abs(result.total.deviation) < 3.0
    assert result.wrong.simulated.value < result.wrong.predicted + 0.01
    assert result.prior == pytest.approx(4.0, rel=1e-6)
    assert result.most_likely < 1.0


def test_a_range_error_moves_all_heights_alike():
    """−cos θ_inc δr: an error of 5 m in range, and no other."""
    request = flown(
        (0.0, 141.0, 605.0),
        radar=dataclasses.replace(radar_of(3, looks=400.0), snr=1e5),
        errors=ErrorBudget(range=ErrorSource(5.0, SharedBy.ALL)),
        acquisitions=1,
    )
    result = simulate_terrain(request, rng=np.random.default_rng(3))
    clear = result.maps.clear
    incidence = math.asin(ORBIT.semi_major_axis / EARTH_EQUATORIAL_RADIUS * math.sin(LOOK))
    error = result.maps.least_squares_error[clear]
    assert np.ptp(error) < 0.05 * abs(error.mean())
    drawn = -error.mean() / math.cos(incidence)
    assert result.total.predicted == pytest.approx(5.0 * math.cos(incidence), rel=0.01)
    assert 0.01 < abs(drawn) < 20.0


def test_terrain_has_the_same_bytes_from_the_same_seed():
    one, same, other = (
        simulate_terrain(flown((0.0, 300.0), acquisitions=1), rng=np.random.default_rng(seed))
        for seed in (4, 4, 5)
    )
    assert one.maps.likely_error.tobytes() == same.maps.likely_error.tobytes()
    assert one.maps.likely_error.tobytes() != other.maps.likely_error.tobytes()


def test_errors_of_the_pixel_are_refused():
    position = ErrorSource(0.001, SharedBy.SATELLITE, Scale.PIXEL)
    request = flown((0.0, 300.0), errors=ErrorBudget(position=position))
    with pytest.raises(ValueError, match="position has the scale pixel"):
        simulate_terrain(request, rng=np.random.default_rng(1))


def test_baselines_beyond_critical_measure_no_terrain():
    with pytest.raises(ValueError, match="no point of the terrain is measured"):
        simulate_terrain(flown((0.0, 15_000.0)), rng=np.random.default_rng(1))


# -- studies -------------------------------------------------------------------------------------

STUDY = """
kind: simulate
orbit: {{altitude_km: 514, inclination_deg: 97.44}}
radar: {{wavelength_m: 0.031, slant_range_resolution_m: 3, snr_db: 10, looks: 16}}
terrain: {{look_deg: 34, {terrain}}}
errors: {{position_m: 0.001}}
formation:
  satellites:
    - {{z0_m: 0, zdot0_m_s: 0}}
    - {{z0_m: 141, zdot0_m_s: 0}}
simulation: {{acquisitions: 1}}
"""


def write(folder: Path, terrain: str) -> Path:
    study = folder / "study.yaml"
    study.write_text(STUDY.format(terrain=terrain), "utf-8")
    return study


def arrays(folder: Path) -> None:
    np.save(folder / "hills.npy", hills().astype(np.float32))
    np.savez(folder / "two.npz", dem=hills(), other=hills())
    np.save(folder / "line.npy", np.zeros(5))
    (folder / "broken.npy").write_bytes(b"no array")


def test_a_study_writes_maps_and_a_valid_result(tmp_path):
    arrays(tmp_path)
    study = write(tmp_path, "file: hills.npy, posting_m: 90")
    out = tmp_path / "out"
    assert main([str(study), "--out", str(out), "--format", "html", "--quiet"]) == 0
    result = json.loads((out / "result.json").read_text("utf-8"))
    jsonschema.validate(result, result_schema())
    assert result["study"]["inputs"][0]["file"] == "hills.npy"
    maps = np.load(io.BytesIO((out / "maps.npz").read_bytes()))
    assert maps["height_m"].shape == maps["most_likely_error_m"].shape == (40, 50)
    assert maps["phase_rad"].shape == (1, 40, 50)
    assert "Height errors, predicted and simulated" in (out / "report.html").read_text("utf-8")


def test_the_sample_is_read_without_matplotlib(tmp_path):
    from configs.terrain_files import build_terrain

    study = write(tmp_path, "sample: jacksboro, crop: {rows: [0, 100], columns: [3, 403]}")
    terrain = build_terrain(load_study(study).study.terrain)
    assert terrain.shape == (100, 400)
    # 3 arc seconds: 92.8 m, and cos 36.6° of it eastward.
    assert terrain.posting_north == pytest.approx(92.8, abs=0.1)
    assert terrain.posting_east == pytest.approx(74.5, abs=0.1)


@pytest.mark.parametrize(
    ("terrain", "message"),
    [
        ("file: hills.npy", "posting_m"),
        ("file: nothing.npy, posting_m: 90", "is not a file beside the study"),
        ("file: line.npy, posting_m: 90", "rows from north to south"),
        ("file: broken.npy, posting_m: 90", "cannot be read as a NumPy file"),
        ("file: two.npz, posting_m: 90", "must name the heights among the arrays"),
        ("file: study.yaml, posting_m: 90", "is no .tif, .npy or .npz file"),
        ("sample: jacksboro, posting_m: 90", "the sample brings its own"),
        ("sample: jacksboro, file: hills.npy", "exactly one of sample and file"),
        ("sample: jacksboro, crop: {rows: [0, 400]}", "has 344 rows"),
        ("sample: jacksboro, crop: {rows: [5, 6]}", "fewer than 3"),
        ("file: hills.npy, posting_m: 9000, heading_deg: 350, look_deg: 2", "look_deg"),
    ],
)
def test_wrong_terrain_of_a_study_is_refused(terrain, message, tmp_path, capsys):
    arrays(tmp_path)
    study = write(tmp_path, terrain)
    assert main([str(study), "--out", str(tmp_path / "out"), "--check"]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert "study.yaml" in error


@pytest.mark.parametrize(
    ("old", "new", "messages"),
    [
        ("z0_m: 141", "z0_m: 0", ["formation", "no point of the terrain is measured"]),
        ("position_m: 0.001", "position_m: 0.001, position_scale: pixel", ["position_scale"]),
        ("looks: 16", "looks: 10000", ["acquisitions", "crop the terrain"]),
        ("acquisitions: 1", "acquisitions: 0", ["acquisitions", "from 1"]),
    ],
)
def test_wrong_simulation_is_refused_in_one_message(old, new, messages, tmp_path, capsys):
    study = write(tmp_path, "sample: jacksboro, crop: {rows: [0, 200], columns: [0, 300]}")
    study.write_text(study.read_text("utf-8").replace(old, new), "utf-8")
    assert main([str(study), "--out", str(tmp_path / "out"), "--quiet"]) == 2
    error = capsys.readouterr().err
    assert all(message in error for message in messages)
    assert "Traceback" not in error


def geotiff(path: Path, heights: np.ndarray, *, model: int, scale: float) -> None:
    tifffile = pytest.importorskip("tifffile")
    directory = (1, 1, 0, 2, 1024, 0, 1, model, 1025, 0, 1, 1)
    tifffile.imwrite(
        path,
        heights.astype(np.float32),
        extratags=[
            (33550, "d", 3, (scale, scale, 0.0), True),
            (33922, "d", 6, (0.0, 0.0, 0.0, -84.0, 60.0, 0.0), True),
            (34735, "H", len(directory), directory, True),
            (42113, "s", 0, "-9999", True),
        ],
    )


@pytest.mark.parametrize(
    ("model", "scale", "north", "east"), [(1, 30.0, 30.0, 30.0), (2, 1e-3, 111.32, 55.66)]
)
def test_geotiff_of_meters_and_of_degrees(model, scale, north, east, tmp_path):
    """Degrees at 60° north: half as far apart eastward; no-data values are gaps."""
    from configs.terrain_files import build_terrain

    heights = hills()
    heights[3, 4] = -9999.0
    geotiff(tmp_path / "dem.tif", heights, model=model, scale=scale)
    terrain = build_terrain(load_study(write(tmp_path, "file: dem.tif")).study.terrain)
    assert terrain.posting_north == pytest.approx(north, rel=1e-3)
    assert terrain.posting_east == pytest.approx(east, rel=2e-3)
    assert np.isnan(terrain.heights[3, 4])
    assert np.nanmax(np.abs(terrain.heights - hills())[heights > 0]) < 1e-4


def test_geotiff_without_its_reader_says_what_to_install(tmp_path, monkeypatch):
    import sys

    from configs.terrain_files import build_terrain

    (tmp_path / "dem.tif").write_bytes(b"II*\0")
    monkeypatch.setitem(sys.modules, "tifffile", None)
    study = load_study(write(tmp_path, "file: dem.tif")).study
    with pytest.raises(Exception, match="pip install"):
        build_terrain(study.terrain)


def test_unknown_sample_names_the_one_there_is(tmp_path):
    with pytest.raises(StudyError, match="jacksboro"):
        load_study(write(tmp_path, "sample: everest"))
