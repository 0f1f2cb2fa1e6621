"""A tomographic stack: many passes at evenly spaced baselines, and what spacing and span are worth.

    python examples/tomography.py

The height here is that of one scatterer in the cell. What separates two, the Rayleigh resolution
λ r sin θ/(2 span), and the height at which a stack repeats itself, that of the spacing, are printed
beside its error.
"""

import numpy as np

from insar import ErrorBudget, Radar, Scene, height_error, monostatic, pair_geometry

scene = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(35.0), altitude=514e3, earth_radius=6371e3
)
up = np.cross(scene.line_of_sight, [0.0, 1.0, 0.0])
print("passes  spacing    span  repeats after  resolves  height error [m]")
for count, spacing in ((2, 350.0), (8, 50.0), (15, 25.0), (8, 100.0)):
    radar = Radar(
        wavelength=0.031,
        slant_range_resolution=0.6,
        snr=10.0,
        looks=4.0,
        images=monostatic(count),
        other_coherence=0.8,  # between any two passes
    )
    positions = (spacing * np.arange(count))[None, :, None] * up[:, None, :]
    ambiguity = pair_geometry(positions, scene, radar=radar).height_of_ambiguity[0]
    error = height_error(positions, scene, radar=radar, errors=ErrorBudget())
    print(
        f"{count:6d}{spacing:9.0f}{spacing * (count - 1):8.0f}{ambiguity.max():15.1f}"
        f"{ambiguity.min():10.1f}{float(error.region):18.2f}"
    )
