"""What each steering law leaves."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import UTC, datetime

import numpy as np

from formation import (
    Elements,
    KeplerianOrbit,
)
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
)
from insar import (
    LookSide,
)
from insar.observe import (
    CaseResult,
    FixedIncidence,
    Law,
    SteeringCase,
    assess_case,
)

from .markdown import markdown_table

# Altitude [m], inclination [deg], eccentricity, incidence [deg], J2: Zhao 2019 Table 1, TerraSAR-X.
STEERED_ORBITS = {
    "LEO": (514e3, 97.42, 0.003, 45.0, False),
    "MEO": (12_000e3, 40.0, 0.003, 45.0, False),
    "GEO": (35_792e3, 30.0, 0.003, 45.0, False),
    "TerraSAR-X": (514.8e3, 97.44, 0.00118, 35.0, False),
    "TerraSAR-X, J2": (514.8e3, 97.44, 0.00118, 35.0, True),
}


def steered(name: str) -> CaseResult:
    """Every law over one revolution of an orbit, right-looking at 0.031 m."""
    altitude, inclination, eccentricity, incidence, j2 = STEERED_ORBITS[name]
    axis = EARTH_EQUATORIAL_RADIUS + altitude
    elements = Elements(axis, eccentricity, math.radians(inclination), 0.0, math.pi / 2, 0.0)
    epoch = datetime(2020, 1, 1, tzinfo=UTC)
    period = 2.0 * math.pi * math.sqrt(axis**3 / EARTH_GRAVITATIONAL_PARAMETER)
    return assess_case(
        SteeringCase(
            name=name,
            trajectory=KeplerianOrbit(elements=elements, epoch=epoch, j2=j2),
            times=np.linspace(0.0, period, 1441),
            wavelength=0.031,
            side=LookSide.RIGHT,
            boresight=FixedIncidence(math.radians(incidence)),
            laws=tuple(Law),
            swath_offsets=np.deg2rad([-0.5, 0.5]),
        )
    )


def steering_laws() -> str:
    """Largest angles, rates and Doppler of each law on each orbit."""
    rows = []
    for name in STEERED_ORBITS:
        for curves in steered(name).curves:
            angles = np.rad2deg([curves.yaw, curves.pitch, curves.roll])
            rate = np.rad2deg(np.linalg.norm(curves.rate_orbit, axis=-1))
            doppler = (curves.residual_doppler, curves.swath_doppler)
            rows.append(
                [
                    f"{name}, {curves.law.value}",
                    *(f"{np.max(np.abs(angle)):.2f}" for angle in angles),
                    f"{np.max(rate):.4f}",
                    *(f"{np.max(np.abs(f)):.0f}" for f in doppler),
                ]
            )
    head = ["", "yaw [°]", "pitch [°]", "roll [°]", "rate [°/s]", "boresight [Hz]", "±0.5° [Hz]"]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {
    "steering_laws": steering_laws,
}
"""Tables by the name that a page calls them."""
