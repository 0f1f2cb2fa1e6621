"""Shared by the tests: the published data, the geometry of Li 2009, and simple orbits."""

from __future__ import annotations

import os

# Before NumPy is imported, as the command does: threads only slow such small matrices down.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import tomllib
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

from formation import Orbit, States
from formation.constants import EARTH_EQUATORIAL_RADIUS, EARTH_ROTATION_RATE
from formation.elements import Elements, states_from_elements
from formation.elements import mean_motion as kepler_rate
from insar import Radar, Scene, one_transmitter

# The same examples on every machine: a red test must be red for everyone.
settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("repeatable")


@pytest.fixture(scope="session")
def li2009() -> dict[str, Any]:
    path = Path(__file__).parent / "published" / "li2009.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def mean_motion() -> float:
    return Orbit.circular(altitude=514e3, inclination=np.deg2rad(97.44)).mean_motion


@pytest.fixture(scope="session")
def li2009_scene(li2009: dict[str, Any]) -> Scene:
    """Table 2; the segments are 1 s apart, the first at 1 s (recovered, not printed)."""
    table = li2009["table2"]
    return Scene.flat_earth(
        times=np.arange(1.0, 11.0),
        slant_range=np.array(table["slant_range_km"]) * 1e3,
        look_angle=np.deg2rad(table["look_deg"]),
        azimuth=np.deg2rad(table["azimuth_deg"]),
    )


@pytest.fixture(scope="session")
def li2009_radar() -> Radar:
    return Radar(
        wavelength=0.031,
        slant_range_resolution=3.0,
        snr=10.0,
        looks=1.0,
        images=one_transmitter(3),
    )


@dataclass(frozen=True)
class TwoBody:
    """Unperturbed orbits over an Earth that turns at a constant rate about the z axis."""

    elements: Elements
    epoch: datetime = datetime(2020, 1, 1, tzinfo=UTC)
    span: tuple[float, float] = (-np.inf, np.inf)
    perturbed: bool = False
    source: str = "the motion of two bodies"

    def inertial(self, times: Any) -> States:
        """Axes: those of the Earth at time zero."""
        rate = kepler_rate(self.elements.semi_major_axis)
        return states_from_elements(
            self.elements._replace(mean_anomaly=self.elements.mean_anomaly + rate * times)
        )

    def earth_fixed(self, times: Any) -> States:
        position, velocity = (self.turned(vector, times) for vector in self.inertial(times))
        return States(position, velocity - np.cross([0.0, 0.0, EARTH_ROTATION_RATE], position))

    @staticmethod
    def turned(vector: Any, times: Any) -> np.ndarray:
        """Earth-fixed components of inertial vectors."""
        angle = EARTH_ROTATION_RATE * np.asarray(times)
        x, y, z = np.moveaxis(vector, -1, 0)
        cosine, sine = np.cos(angle), np.sin(angle)
        return np.stack([cosine * x + sine * y, cosine * y - sine * x, z], axis=-1)


@pytest.fixture(scope="session")
def two_body() -> type[TwoBody]:
    """Orbits whose Earth-fixed states are exact, and independent of `formation.frames`."""
    return TwoBody


@pytest.fixture(scope="session")
def random_orbits() -> TwoBody:
    """500 orbits from 200 km perigee to geosynchronous heights, e ≤ 0.3, of any inclination."""
    rng = np.random.default_rng(2019)
    eccentricity = rng.uniform(0.0, 0.3, 500)
    eccentricity[:20] = 0.0
    perigee = EARTH_EQUATORIAL_RADIUS + np.geomspace(2e5, 3.6e7, 500)
    inclination = np.arccos(rng.uniform(-1.0, 1.0, 500))
    return TwoBody(
        Elements(
            np.minimum(perigee / (1.0 - eccentricity), 42_164e3),
            eccentricity,
            inclination,
            *rng.uniform(-np.pi, np.pi, (3, 500)),
        )
    )
