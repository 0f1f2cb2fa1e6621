"""Height noise of two images against their baseline, with and without spectral filtering.

    python examples/two_image_optimum.py [--plot FILE.svg]

All baselines are one population: `height_error` scores them in one call.
"""

import argparse

import numpy as np

from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    PhaseStatistics,
    Radar,
    Scene,
    height_error,
    one_transmitter,
    scene_critical_baseline,
)

parser = argparse.ArgumentParser(description="Optimal baseline of two images.")
parser.add_argument("--plot", metavar="FILE", help="draw the curves (needs matplotlib)")
arguments = parser.parse_args()

scene = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6_378_137.0
)
radar = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0, images=one_transmitter(2)
)
critical = float(scene_critical_baseline(scene, radar)[0])
share = np.linspace(0.01, 0.99, 981)  # baseline in parts of the critical one

# Broadside: the height direction is perpendicular to the line of sight and to the flight direction.
across = np.cross(scene.line_of_sight[0], [0.0, 1.0, 0.0])
baselines = share[:, None] * critical * across
positions = np.stack([np.zeros_like(baselines), baselines], axis=1)[:, None]  # (P, S, N, 3)

BOUND, curves = PhaseStatistics.CRAMER_RAO, {}
for decorrelation in (BaselineDecorrelation.FILTERED, BaselineDecorrelation.UNFILTERED):
    # Phase noise alone, by the bound, whose optima closed forms know.
    errors = ErrorBudget(baseline_decorrelation=decorrelation, phase_statistics=BOUND)
    noise = curves[decorrelation] = height_error(
        positions, scene, radar=radar, errors=errors
    ).total[:, 0]
    best = int(np.argmin(noise))
    print(f"{decorrelation:10}: best at {share[best]:.3f} B_crit, {1e3 * noise[best]:.1f} mm")

if arguments.plot:
    from matplotlib.figure import Figure

    axes = Figure(figsize=(6, 4), layout="constrained").subplots()
    for decorrelation, noise in curves.items():
        axes.semilogy(share, noise, label=str(decorrelation))
    axes.set(xlabel="perpendicular over critical baseline", ylabel="height noise [m]")
    axes.legend()
    axes.figure.savefig(arguments.plot)
