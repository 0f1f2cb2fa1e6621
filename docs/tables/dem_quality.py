"""Published figures of elevation models beside those of the code."""

from __future__ import annotations

import numpy as np

from insar import Calibration, ErrorBudget, ErrorSource, Radar, Scene, SharedBy, height_accuracy
from insar.atmosphere import (
    TEC_UNIT,
    ionospheric_gradient_height_error,
    ionospheric_height_error,
    tropospheric_height_error,
)
from insar.calibration import (
    area_variance,
    baseline_offset,
    baseline_tilt,
    calibrated_covariance,
    synchronization_height_error,
)

from .markdown import markdown_table

SCENE = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(32.057), altitude=514e3, earth_radius=6371e3
)
WAVELENGTH = 0.031066


def figures() -> list[tuple[str, str, float, str]]:
    """Quantity, printed value, value of the code and its unit."""
    tilt = 1e6 * baseline_tilt(1e-3, perpendicular_baseline=260.0)
    offset = baseline_offset(1e-3, height_of_ambiguity=35.0, wavelength=0.0311)
    low, high = tropospheric_height_error(2.4, incidence=np.deg2rad([30.0, 45.0]))
    phase = synchronization_height_error(np.deg2rad(1.0), height_of_ambiguity=45.0)
    return [
        ("tilt by 1 mm of baseline, B⊥ 260 m", "3.85", float(tilt), "mm/km"),
        ("offset by 1 mm of baseline, HoA 35 m", "1.1", float(offset), "m"),
        ("2.4 m of zenith delay at 30°", "0.8", float(low), "m"),
        ("2.4 m of zenith delay at 45°", "2.4", float(high), "m"),
        ("synchronization of 1°, HoA 45 m", "HoA/360", float(phase), "m"),
    ]


def published_figures() -> str:
    """Printed figures and those of the code."""
    rows = [[name, printed, f"{value:.2f}", unit] for name, printed, value, unit in figures()]
    return markdown_table(["quantity", "printed", "computed", "unit"], rows)


def ionosphere_by_band() -> str:
    """Height bias by 10 TEC units, and by a gradient, at 35° incidence."""
    incidence = np.deg2rad(35.0)
    rows = []
    for band, wavelength in (("X", 0.031), ("C", 0.0555), ("L", 0.2384)):
        bias = ionospheric_height_error(10 * TEC_UNIT, wavelength=wavelength, incidence=incidence)
        slope = ionospheric_gradient_height_error(
            TEC_UNIT / 100e3, wavelength=wavelength, incidence=incidence
        )
        rows.append([f"{band}, {wavelength:g} m", f"{float(bias):.3f}", f"{float(slope):.3f}"])
    return markdown_table(
        ["band", "10 TECU, uniform [m]", "gradient of 1 TECU in 100 km [m]"], rows
    )


def calibration_residuals() -> str:
    """What an adjustment leaves of 1 mm of baseline, by the spacing of its control points."""
    normal = np.array([np.sin(SCENE.look_angle[0]), 0.0, np.cos(SCENE.look_angle[0])])
    positions = np.stack([np.zeros(3), 250.0 * normal])[None]
    radar = Radar(
        wavelength=WAVELENGTH,
        slant_range_resolution=1.0,
        snr=10.0,
        looks=16.0,
        images=((0, 0), (0, 1)),
    )
    errors = ErrorBudget(position=ErrorSource(1e-3 / np.sqrt(2.0), SharedBy.SATELLITE))
    accuracy = height_accuracy(positions, SCENE, radar=radar, errors=errors)
    prior, noise = accuracy.sources["position"].covariance, accuracy.random
    before = float(np.sqrt(area_variance(prior, swath=30e3, length=0.0))[0])
    rows = [["none", f"{before:.2f}", f"{1e6 * np.sqrt(prior[0, 1, 1]):.2f}"]]
    for spacing in (25.0, 10.0, 5.0, 2.0):
        calibration = Calibration(
            swath=30e3,
            length=100e3,
            spacing_across=spacing * 1e3,
            spacing_along=spacing * 1e3,
            accuracy=1.0,
        )
        left = calibrated_covariance(prior, calibration, noise_std=noise)
        after = float(np.sqrt(area_variance(left, swath=30e3, length=0.0))[0])
        rows.append([f"{spacing:g} km", f"{after:.2f}", f"{1e6 * np.sqrt(left[0, 1, 1]):.2f}"])
    return markdown_table(
        ["control points every", "error over the swath [m]", "tilt [mm/km]"], rows
    )


TABLES = {
    "dem_published": published_figures,
    "dem_ionosphere": ionosphere_by_band,
    "dem_calibration": calibration_residuals,
}
