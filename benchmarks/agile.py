"""Attitude profiles of an agile satellite: by part, and against a plain loop.

    python benchmarks/agile.py [--quick]

1. A profile at 100 Hz over 200 s, 20 001 samples: the orbit as a polynomial, attitude with angles,
   quaternions, rates and accelerations, and the whole study with Han's iteration and four aim
   errors.
2. The same against the number of samples.
3. The peer: the attitude as a reader of Han 2016 would compute it, one sample at a time with NumPy
   vectors of three, by the iteration, with rates by differences. Both point the beam alike, to
   1e-14, and the rates agree to 1e-7 rad/s, which is checked.

Times are CPU times, the best of several repetitions; they are of one machine: compare the ratios.
"""

from __future__ import annotations

import os

# Before NumPy is imported: BLAS reads it once, when it is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import math
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from time import process_time

import numpy as np
from numpy.typing import NDArray

from formation import KeplerianOrbit
from insar.observe.agile.rotations import EulerSequence, euler_sequence, quaternion
from insar.observe.agile.smooth_orbit import SmoothOrbit, smooth_orbit
from insar.observe.agile.spotlight import spotlight
from insar.observe.agile.spotlight_attitude import Antenna, attitude_profile, point
from insar.observe.agile.spotlight_plan import plan_spotlight
from insar.observe.agile.spotlight_results import SpotlightPlan, SpotlightRequest
from insar.observe.earth import to_geodetic
from insar.observe.frames import orbit_axes

Array = NDArray[np.float64]

DURATION, RATE = 200.0, 100.0
SAMPLES = round(DURATION * RATE) + 1


def example() -> SpotlightRequest:
    """A point 300 km off the ground track of a low orbit."""
    orbit = KeplerianOrbit.circular(
        altitude=514e3,
        inclination=math.radians(97.44),
        epoch=datetime(2016, 11, 25, 8, 9, 43, tzinfo=UTC),
        argument_of_latitude=0.6,
    )
    below = to_geodetic(orbit.earth_fixed(0.0).position)
    return SpotlightRequest(
        trajectory=orbit,
        latitude=float(below.latitude),
        longitude=float(below.longitude) + 0.06,
        wavelength=0.031,
        resolution=0.25,
        start=-200.0,
        stop=200.0,
        off_axis=math.radians(-8.0),
        phase_center=(1.2, -0.4, 1.5),
        duration=DURATION,
    )


def best_time(function: Callable[[], object], *, seconds: float) -> float:
    """Shortest CPU time of one call among those that fit into `seconds`, three at least [s]."""
    function()  # fills caches
    times: list[float] = []
    while len(times) < 3 or sum(times) < seconds:
        start = process_time()
        function()
        times.append(process_time() - start)
    return min(times)


def by_part(
    request: SpotlightRequest, plan: SpotlightPlan, orbit: SmoothOrbit, *, seconds: float
) -> None:
    times = plan.time + np.linspace(-DURATION / 2, DURATION / 2, SAMPLES)
    antenna = Antenna.of(request)
    attitude = point(orbit, times, plan.rotation_center, antenna).attitude
    parts: dict[str, Callable[[], object]] = {
        "plan: search, imaging time": lambda: plan_spotlight(request),
        "orbit as a polynomial": lambda: smooth_orbit(request.trajectory, times[0], times[-1]),
        "attitude and rates": lambda: point(orbit, times, plan.rotation_center, antenna),
        "Euler angles": lambda: euler_sequence(attitude, EulerSequence.THREE_ONE_TWO),
        "quaternions": lambda: quaternion(attitude),
        "the whole profile": lambda: attitude_profile(
            orbit, times, plan.rotation_center, antenna, agility=request.agility
        ),
        "the whole study": lambda: spotlight(request, SAMPLES),
    }
    print(f"\n{RATE:.0f} Hz over {DURATION:.0f} s, {SAMPLES} samples: ms")
    for name, call in parts.items():
        print(f"{name:>28} {best_time(call, seconds=seconds) * 1e3:8.1f}")


def against_samples(
    request: SpotlightRequest,
    plan: SpotlightPlan,
    orbit: SmoothOrbit,
    sizes: Sequence[int],
    *,
    seconds: float,
) -> None:
    antenna = Antenna.of(request)
    print("\nProfile against the number of samples")
    print(f"{'samples':>10} {'ms':>10} {'µs a sample':>14}")
    for size in sizes:
        times = plan.time + np.linspace(-DURATION / 2, DURATION / 2, size)
        time = best_time(
            lambda: attitude_profile(orbit, times, plan.rotation_center, antenna),  # noqa: B023
            seconds=seconds,
        )
        print(f"{size:10} {time * 1e3:10.2f} {time / size * 1e6:14.2f}")


# -- the peer ------------------------------------------------------------------------------------


def plain_attitudes(axes: Array, position: Array, target: Array, antenna: Antenna) -> Array:
    """Han 2016 eqs (7)-(10): orbit frame to body, one sample after the other."""
    attitudes = np.empty_like(axes)
    for sample in range(len(axes)):
        path = axes[sample] @ (target - position[sample])
        turn = np.eye(3)  # body to orbit frame
        while True:
            wanted = path - turn @ antenna.phase_center
            wanted = wanted / np.linalg.norm(wanted)
            q = np.append(np.cross(antenna.beam, wanted), 1.0 + antenna.beam @ wanted)
            x, y, z, w = q / np.linalg.norm(q)
            improved = np.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                ]
            )
            change = np.abs(improved - turn).max()
            turn = improved
            if change < 1e-14:
                break
        attitudes[sample] = turn.T
    return attitudes


def plain_rates(attitudes: Array, step: float) -> Array:
    """Body rates by central differences of neighboring attitudes."""
    rates = np.full((len(attitudes), 3), np.nan)
    for sample in range(1, len(attitudes) - 1):
        derivative = (attitudes[sample + 1] - attitudes[sample - 1]) / (2.0 * step)
        skew = -derivative @ attitudes[sample].T
        rates[sample] = skew[2, 1], skew[0, 2], skew[1, 0]
    return rates


def against_plain_loop(
    request: SpotlightRequest,
    plan: SpotlightPlan,
    orbit: SmoothOrbit,
    samples: int,
    *,
    seconds: float,
) -> None:
    antenna = Antenna.of(request)
    times = plan.time + np.arange(samples) / RATE
    states = orbit.states(times)
    axes = orbit_axes(states)

    def plain() -> tuple[Array, Array]:
        found = plain_attitudes(axes, states.position, plan.rotation_center, antenna)
        return found, plain_rates(found, 1.0 / RATE)

    def ours() -> tuple[Array, Array]:
        found = point(orbit, times, plan.rotation_center, antenna)
        return found.attitude, found.rate_orbit

    (one, one_rate), (two, two_rate) = plain(), ours()
    # They differ by a turn of 1e-6 about the line of sight: compare the beams.
    beams = (np.swapaxes(each, -1, -2) @ antenna.beam for each in (one, two))
    paths = [
        (plan.rotation_center - states.position)
        - np.einsum("sij,j->si", np.swapaxes(each @ axes, -1, -2), antenna.phase_center)
        for each in (one, two)
    ]
    for beam, path in zip(beams, paths, strict=True):
        line = np.einsum("sij,sj->si", axes, path / np.linalg.norm(path, axis=-1, keepdims=True))
        np.testing.assert_allclose(beam, line, rtol=0, atol=1e-14)
    # Second-order differences over 10 ms, and the slowly changing turn between the attitudes.
    np.testing.assert_allclose(one_rate[1:-1], two_rate[1:-1], rtol=0, atol=1e-7)
    loop, fast = best_time(plain, seconds=seconds), best_time(ours, seconds=seconds)
    print(f"\nAttitude and rates, {samples} samples: µs a sample")
    print(f"{'plain loop':>12} {'ours':>8} {'ratio':>8}")
    print(f"{loop / samples * 1e6:12.1f} {fast / samples * 1e6:8.2f} {loop / fast:8.0f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few and short repetitions, in 10 s")
    quick = parser.parse_args().quick
    seconds = 0.2 if quick else 1.0
    request = example()
    plan = plan_spotlight(request)
    orbit = smooth_orbit(
        request.trajectory, plan.time - DURATION / 2 - 1.0, plan.time + DURATION / 2 + 1.0
    )
    by_part(request, plan, orbit, seconds=seconds)
    against_samples(request, plan, orbit, [101, 1001, 10_001, 100_001], seconds=seconds)
    against_plain_loop(request, plan, orbit, 501 if quick else 2001, seconds=seconds)


if __name__ == "__main__":
    main()
