"""A repeat-pass study: one C-band satellite, and what the atmosphere leaves of a height.

    python examples/repeat_pass.py

Every pass is a satellite of its own to the model: it transmits and receives its own image, so
baselines count twice. What differs from pass to pass, above all the delay of the wet troposphere,
is an error of the path of that image, which is what a position error is too. Orbits are taken as
adjusted to control points.
"""

import numpy as np

from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    combine_acquisitions,
    height_error,
    height_error_of,
    monostatic,
    pair_geometry,
    phase_model,
)

scene = Scene.broadside_strip(
    times=[0.0], look_angle=np.deg2rad(33.0), altitude=693e3, earth_radius=6371e3
)
coherence = 0.5  # of 12 days, over land that is not forest
radar = Radar(
    wavelength=0.0555,
    slant_range_resolution=2.7,
    snr=30.0,
    looks=60.0,
    images=monostatic(2),
    other_coherence=coherence,
)
wet_delay = 0.005  # one way, between places some kilometers apart [m]
errors = ErrorBudget(position=ErrorSource(wet_delay, SharedBy.SATELLITE))

up = np.cross(scene.line_of_sight, [0.0, 1.0, 0.0])  # the direction of a perpendicular baseline
baselines = np.array([30.0, 80.0, 150.0, 300.0])
pairs = np.zeros((len(baselines), 1, 2, 3))  # (designs, segments, satellites, RTN)
pairs[:, :, 1] = baselines[:, None, None] * up
ambiguity = pair_geometry(pairs, scene, radar=radar).height_of_ambiguity[:, 0, 0]
error = height_error(pairs, scene, radar=radar, errors=errors)
print("baseline, height of ambiguity, total, relative [m]")
for row in zip(baselines, ambiguity, error.total[:, 0], error.relative[:, 0], strict=True):
    print("".join(f"{value:9.1f}" for value in row))

# Many independent pairs: delays are new in each, so their error falls with the root of the count.
model = phase_model(pairs[1:2], scene, radar=radar, errors=errors)
stack = height_error_of(combine_acquisitions([model] * 25), scene=scene, radar=radar, errors=errors)
print(f"25 independent pairs of 80 m: {stack.total[0, 0]:.1f} m")
