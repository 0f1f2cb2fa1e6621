"""The error model on arrays of your own: no orbit, no study, no search.

    python examples/error_model.py

Give `insar` the line of sight and the relative positions of the satellites from any source; here
they are typed in. Vectors are RTN: R radial outward, T along track, N along the orbit normal.
"""

import numpy as np

from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    height_error,
    pair_geometry,
    unwrapping_probability,
)

# Three line-of-sight samples of a squinted pass, left of the flight direction.
scene = Scene(
    times=np.array([0.0, 5.0, 10.0]),
    slant_range=np.array([563.4e3, 562.9e3, 563.1e3]),
    look_angle=np.deg2rad([23.05, 23.01, 23.03]),
    azimuth=np.deg2rad([88.0, 87.9, 87.8]),
    incidence=np.deg2rad([25.03, 24.98, 25.00]),
)
# Satellite 0 transmits; 0, 1 and 2 receive: three images, (transmitter, receiver) each.
radar = Radar(
    wavelength=0.031,
    slant_range_resolution=3.0,
    snr=10.0,
    looks=16.0,
    images=((0, 0), (0, 1), (0, 2)),
)
errors = ErrorBudget(
    position=ErrorSource(0.001, SharedBy.SATELLITE),  # 1 mm per satellite and axis
    azimuth=ErrorSource(1.8e-6, SharedBy.ALL),  # one target, so one angle: 1 m on the ground
    range=ErrorSource(0.01, SharedBy.ALL),  # 1 cm, the same in every image
)
formation = np.array([[0.0, 0.0, 0.0], [141.0, 20.0, 282.0], [605.0, 60.0, 1210.0]])
positions = np.broadcast_to(formation, (3, 3, 3))  # (segments, satellites, RTN) [m]

pairs = pair_geometry(positions, scene, radar=radar)
error = height_error(positions, scene, radar=radar, errors=errors)
probability = unwrapping_probability(
    positions, scene, radar=radar, errors=errors, prior_height_std=4.0
)
for name, baseline in zip(("0-1", "0-2", "1-2"), pairs.perpendicular_baseline.T, strict=True):
    print(f"pair {name}: B⊥ {baseline.mean():8.1f} m")
print(f"height error: total {error.region:.3f} m, relative {error.relative_region:.3f} m")
for name, term in error.region_terms.items():
    print(f"  {name:9} {term:.3f} m")
print("unwrapping probability, segment by segment:", probability.round(3))
