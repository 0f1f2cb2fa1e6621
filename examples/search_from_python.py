"""A search through the API, as the command runs it: three X-band satellites within limits.

python examples/search_from_python.py
"""

import numpy as np

from formation import Orbit, ground_track_circular
from insar import (
    ErrorBudget,
    ErrorSource,
    Radar,
    Scene,
    SharedBy,
    one_transmitter,
    scene_critical_baseline,
)
from optimize import Constraints, DesignSpace, Problem, SearchSettings, assess, search

orbit = Orbit.circular(altitude=514e3, inclination=np.deg2rad(97.44))
scene = Scene.broadside_strip(
    times=np.arange(0.5, 10.0), look_angle=np.deg2rad(23), altitude=514e3, earth_radius=6_378_137.0
)
radar = Radar(
    wavelength=0.031, slant_range_resolution=3.0, snr=10.0, looks=16.0, images=one_transmitter(3)
)
errors = ErrorBudget(
    position=ErrorSource(0.001, SharedBy.SATELLITE), range=ErrorSource(0.01, SharedBy.ALL)
)
radius = 0.5 * float(scene_critical_baseline(scene, radar).min())
problem = Problem(
    mean_motion=orbit.mean_motion,
    scene=scene,
    radar=radar,
    errors=errors,
    constraints=Constraints(
        max_radius=radius,
        min_separation=100.0,
        min_unwrapping_probability=0.99,
        prior_height_std=4.0,
    ),
)
space = DesignSpace(
    names=("Chief", "Near", "Far"),
    family=ground_track_circular,
    mean_motion=orbit.mean_motion,
    max_offset=radius / 2,
    max_rate=radius / 2 * orbit.mean_motion,
    signs=(1, -1),  # the search chooses the mirror image
)
found = search(problem, space, settings=SearchSettings(), rng=np.random.default_rng(1))
best = assess(problem, space.states(found.design), label="best", names=space.names)

print(space.pretty(found.design))
print(f"{found.evaluations} formations scored, {'all limits kept' if best.feasible else 'blocked'}")
error = best.height_error
print(f"height error: total {error.region:.3f} m, relative {error.relative_region:.3f} m")
for report in best.constraints:
    print(f"  {report.limit.name}: {report.value:.4g} (limit {report.limit.value:.4g})")
