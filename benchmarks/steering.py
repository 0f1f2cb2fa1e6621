"""Steering of 10 000 samples of an orbit: every law, by part, and against a plain loop.

    python benchmarks/steering.py [--quick]

1. `steer` for each law at a fixed look angle and at a fixed incidence, and `assess_case` with all
   five laws (attitude, rates, incidence, Doppler at the boresight and at nine elevations).
2. `steer` against the number of samples: what one call costs, and what one sample costs.
3. The peer: the laws as a reader of the papers would write them, one sample at a time with NumPy
   vectors of three and SciPy's Brent root for the incidence. Both give the same beams to 1e-9 rad,
   which is checked.

The orbit is an unperturbed ellipse over a turning Earth, so that the time of the trajectory itself
does not count. Times are CPU times, the best of several repetitions; they are of one machine:
compare the ratios.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from time import process_time

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from formation import Elements, States, states_from_elements
from formation.constants import EARTH_GRAVITATIONAL_PARAMETER, EARTH_ROTATION_RATE
from insar import LookSide
from insar.observe import (
    WGS84,
    Boresight,
    FixedIncidence,
    FixedLook,
    Law,
    SteeringCase,
    assess_case,
    steer,
)

Array = NDArray[np.float64]

SAMPLES = 10_000
BORESIGHTS: dict[str, Boresight] = {
    "fixed look": FixedLook(np.deg2rad(40.0)),
    "fixed incidence": FixedIncidence(np.deg2rad(45.0)),
}
AXIS, ECCENTRICITY, INCLINATION = 6_892_137.0, 0.003, np.deg2rad(97.42)
PERIOD = 2.0 * np.pi * np.sqrt(AXIS**3 / EARTH_GRAVITATIONAL_PARAMETER)


@dataclass(frozen=True)
class Ellipse:
    """The low orbit of Zhao 2019, table 1, over an Earth that turns about the z axis."""

    epoch: datetime = datetime(2020, 1, 1, tzinfo=UTC)
    span: tuple[float, float] = (-np.inf, np.inf)
    perturbed: bool = False

    def inertial(self, times: ArrayLike) -> States:
        anomaly = 2.0 * np.pi / PERIOD * np.asarray(times)
        return states_from_elements(
            Elements(AXIS, ECCENTRICITY, INCLINATION, 0.0, np.pi / 2, anomaly)
        )

    def earth_fixed(self, times: ArrayLike) -> States:
        angle = EARTH_ROTATION_RATE * np.asarray(times)
        cosine, sine, zero = np.cos(angle), np.sin(angle), np.zeros_like(angle)
        turn = np.stack([cosine, sine, zero, -sine, cosine, zero, zero, zero, zero + 1.0], -1)
        turn = turn.reshape(*angle.shape, 3, 3)
        position, velocity = (np.einsum("...ij,...j->...i", turn, v) for v in self.inertial(times))
        return States(position, velocity - np.cross([0.0, 0.0, EARTH_ROTATION_RATE], position))


def orbit_states(samples: int) -> States:
    return Ellipse().earth_fixed(np.linspace(0.0, PERIOD, samples))


def best_time(function: Callable[[], object], *, seconds: float) -> float:
    """Shortest CPU time of one call among those that fit into `seconds`, three at least [s]."""
    function()  # fills caches
    times: list[float] = []
    while len(times) < 3 or sum(times) < seconds:
        start = process_time()
        function()
        times.append(process_time() - start)
    return min(times)


def by_law(states: States, *, seconds: float) -> None:
    print(f"\nsteer, {SAMPLES} samples: ms")
    print(f"{'':>24}", *(f"{name:>16}" for name in BORESIGHTS))
    for law in Law:
        cells = (
            best_time(
                lambda: steer(law, states, boresight=held, side=LookSide.RIGHT),  # noqa: B023
                seconds=seconds,
            )
            for held in BORESIGHTS.values()
        )
        print(f"{law.value:>24}", *(f"{time * 1e3:16.1f}" for time in cells))
    whole = []
    for held in BORESIGHTS.values():
        case = SteeringCase(
            name="low orbit",
            trajectory=Ellipse(),
            times=np.linspace(0.0, PERIOD, SAMPLES),
            wavelength=0.031,
            side=LookSide.RIGHT,
            boresight=held,
            laws=tuple(Law),
            swath_offsets=np.deg2rad(np.linspace(-1.0, 1.0, 9)),
        )
        whole.append(best_time(lambda: assess_case(case), seconds=seconds))  # noqa: B023
    print(f"{'assess_case, all laws':>24}", *(f"{time * 1e3:16.1f}" for time in whole))


def against_samples(sizes: Sequence[int], *, seconds: float) -> None:
    print("\nsteer, all laws at fixed incidence, against the number of samples")
    print(f"{'samples':>8} {'ms':>9} {'µs/sample':>10}")
    for size in sizes:
        states = orbit_states(size)

        def every_law() -> None:
            for law in Law:
                steer(law, states, boresight=BORESIGHTS["fixed incidence"], side=LookSide.RIGHT)  # noqa: B023

        time = best_time(every_law, seconds=seconds)
        print(f"{size:8} {time * 1e3:9.2f} {time / size * 1e6:10.2f}")


# -- the peer ------------------------------------------------------------------------------------


def plain_target(position: Array, beam: Array) -> Array:
    """First intersection with the ellipsoid, by the quadratic formula in scaled coordinates."""
    scale = np.array([WGS84.semi_major_axis, WGS84.semi_major_axis, WGS84.semi_minor_axis])
    p, d = position / scale, beam / scale
    a, b, c = d @ d, 2.0 * (p @ d), p @ p - 1.0
    root = b * b - 4.0 * a * c
    return position + (-b - np.sqrt(root)) / (2.0 * a) * beam if root > 0.0 else np.full(3, np.nan)


def plain_incidence(position: Array, beam: Array) -> float:
    target = plain_target(position, beam)
    axes = np.array([WGS84.semi_major_axis, WGS84.semi_major_axis, WGS84.semi_minor_axis])
    normal = target / axes**2
    cosine = -(beam @ normal) / np.linalg.norm(normal)
    return float(np.arccos(cosine)) if np.isfinite(cosine) else np.pi / 2


def plain_angles(law: Law, r: Array, v: Array) -> tuple[float, float]:
    """Yaw and pitch of a sample from its osculating elements, as the papers write them."""
    mu = EARTH_GRAVITATIONAL_PARAMETER
    radius = np.linalg.norm(r)
    h = np.cross(r, v)
    momentum = np.linalg.norm(h)
    inclination = np.arccos(h[2] / momentum)
    node = np.cross([0.0, 0.0, 1.0], h)
    u = np.arctan2(r @ np.cross(h, node) / momentum, r @ node)
    axis = 1.0 / (2.0 / radius - v @ v / mu)
    parameter = momentum**2 / mu
    radial = r @ v / radius
    e_sin, e_cos = radial * momentum / mu, parameter / radius - 1.0
    rate = momentum / radius**2 if law is Law.YAW_PITCH else np.sqrt(mu / axis**3)
    ratio = rate / EARTH_ROTATION_RATE
    forward, across = ratio - np.cos(inclination), np.sin(inclination) * np.cos(u)
    yaw = np.arctan2(-across, forward)
    if law is Law.YAW_PITCH_APPROXIMATE:
        return yaw, np.arctan2(e_sin, 1.0 + e_cos)
    if law is Law.YAW_PITCH:
        ground = EARTH_ROTATION_RATE * radius * np.hypot(forward, across)
        return yaw, np.arctan2(radial, ground)
    return (yaw, 0.0) if law is Law.YAW else (0.0, 0.0)


def plain_beam(law: Law, position: Array, velocity: Array, held: Boresight) -> Array:
    """Boresight of a sample, right-looking."""
    inertial = velocity + np.cross([0.0, 0.0, EARTH_ROTATION_RATE], position)
    nadir = -position / np.linalg.norm(position)
    right = -np.cross(position, inertial)
    right = right / np.linalg.norm(right)
    forward = np.cross(right, nadir)
    # The exact pitch-roll law points the beam of the exact yaw-pitch law.
    yaw, pitch = plain_angles(Law.YAW_PITCH if law is Law.PITCH_ROLL else law, position, inertial)
    level = np.cos(yaw) * forward + np.sin(yaw) * right
    aside = np.cos(yaw) * right - np.sin(yaw) * forward
    down = np.cos(pitch) * nadir + np.sin(pitch) * level
    if isinstance(held, FixedLook):
        angle = np.arccos(np.cos(held.angle) / np.cos(pitch))
    else:
        angle = brentq(
            lambda x: plain_incidence(position, np.cos(x) * down + np.sin(x) * aside) - held.angle,
            1e-3,
            np.pi / 2,
            xtol=1e-12,
        )
    return np.cos(angle) * down + np.sin(angle) * aside


def against_plain_loop(*, seconds: float) -> None:
    print("\nBoresights, right-looking: µs per sample")
    print(f"{'':>24} {'':>16} {'plain loop':>12} {'ours':>8} {'ratio':>7}")
    few, many = orbit_states(200), orbit_states(SAMPLES)
    for law in Law:
        for name, held in BORESIGHTS.items():

            def plain() -> Array:
                return np.array([plain_beam(law, *state, held) for state in zip(*few, strict=True)])  # noqa: B023

            ours = steer(law, few, boresight=held, side=LookSide.RIGHT).boresight
            np.testing.assert_allclose(plain(), ours, atol=1e-9)
            loop = best_time(plain, seconds=seconds) / 200
            vectorized = best_time(
                lambda: steer(law, many, boresight=held, side=LookSide.RIGHT),  # noqa: B023
                seconds=seconds,
            )
            each = vectorized / SAMPLES
            numbers = f"{loop * 1e6:12.1f} {each * 1e6:8.2f} {loop / each:7.0f}"
            print(f"{law.value:>24} {name:>16} {numbers}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few and short repetitions, in 10 s")
    quick = parser.parse_args().quick
    seconds = 0.05 if quick else 0.5
    by_law(orbit_states(SAMPLES), seconds=seconds)
    against_samples([1, 10, 100, 1000, 10_000, 100_000], seconds=seconds)
    against_plain_loop(seconds=seconds)


if __name__ == "__main__":
    main()
