"""Shared by the tests: the published data, and the geometry of Li 2009."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

from formation import Orbit
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
