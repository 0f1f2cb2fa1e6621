"""Two drones 100 m above the ground: the same model at a millionth of the range.

    python examples/drone.py

Nothing in `insar` is about space. Axes are those of the flight: R up, T forward, N to the left.
"""

import numpy as np

from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    height_error,
    one_transmitter,
    unwrapping_probability,
)

altitude, look = 100.0, np.deg2rad([30.0, 45.0, 60.0])  # near, middle and far of the swath
scene = Scene.flat_earth(
    times=np.zeros(3),
    slant_range=altitude / np.cos(look),
    look_angle=look,
    azimuth=np.full(3, np.pi / 2),
)
radar = Radar(
    wavelength=0.031,
    slant_range_resolution=0.30,  # 500 MHz
    snr=100.0,
    looks=9.0,
    images=one_transmitter(2),
)
errors = ErrorBudget(position=ErrorSource(0.005, SharedBy.SATELLITE))  # 5 mm: carrier-phase GNSS

baselines = np.array([0.5, 1.0, 2.0, 4.0])
positions = np.zeros((len(baselines), 3, 2, 3))  # the second drone flies beside the first
positions[:, :, 1, 2] = baselines[:, None]
error = height_error(positions, scene, radar=radar, errors=errors)
right = unwrapping_probability(positions, scene, radar=radar, errors=errors, prior_height_std=0.5)
print("baseline [m]; total [m] and probability of unwrapping, near, middle and far")
for baseline, total, probability in zip(baselines, error.total, right, strict=True):
    cells = "".join(f"{t:7.3f} ({p:.3f})" for t, p in zip(total, probability, strict=True))
    print(f"{baseline:5.1f}{cells}")
