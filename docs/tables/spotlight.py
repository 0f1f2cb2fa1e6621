"""Tables on Han 2016."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from datetime import UTC, datetime
from functools import cache
from typing import Any

import numpy as np

from configs import load_study
from configs.staring import build_spotlight
from formation import (
    KeplerianOrbit,
)
from insar import (
    LookSide,
)
from insar.observe.agile.spotlight import spotlight
from insar.observe.agile.spotlight_claims import judge_spotlight
from insar.observe.agile.spotlight_results import SpotlightRequest, SpotlightResult
from insar.observe.earth import intersect, to_geodetic
from insar.observe.look import angle_at_look, zero_doppler_plane

from .markdown import DOCS, PUBLISHED, markdown_table
from .verdicts import verdict_table

HAN2016: dict[str, Any] = tomllib.loads((PUBLISHED / "han2016.toml").read_text(encoding="utf-8"))


@cache
def han2016(side: str) -> SpotlightResult:
    """Han's example from the inferred inputs of one side, phase center 2 m off the center."""
    table = HAN2016["inferred"][side]
    orbit = KeplerianOrbit.circular(
        altitude=table["altitude_km"] * 1e3,
        inclination=math.radians(table["inclination_deg"]),
        epoch=datetime(2016, 1, 1, tzinfo=UTC),
        argument_of_latitude=math.radians(table["argument_of_latitude_deg"]),
        j2=False,
    )
    states = orbit.earth_fixed(0.0)
    plane = zero_doppler_plane(states, side=LookSide[side.upper()])
    elevation = angle_at_look(plane, math.radians(table["look_deg"]))
    place = to_geodetic(intersect(states.position, plane.direction(elevation)))
    request = SpotlightRequest(
        trajectory=orbit,
        latitude=float(place.latitude),
        longitude=float(place.longitude),
        wavelength=299_792_458.0 / (table["frequency_ghz"] * 1e9),
        resolution=table["resolution_m"],
        weighting=table["weighting"],
        start=-100.0,
        stop=100.0,
        off_axis=math.radians(table["off_axis_deg"]),
        phase_center=(1.2, 0.0, 1.6),
    )
    return spotlight(request)


def han2016_figures() -> str:
    """Printed figures of Han 2016 from two sets of inferred inputs."""
    printed = HAN2016["printed"]

    def row(
        name: str, key: str, places: int, value: Callable[[SpotlightResult], float]
    ) -> list[str]:
        values = (value(han2016(side)) for side in ("left", "right"))
        return [name, *(f"{number:.{places}f}" for number in (printed[key], *values))]

    def swing(angle: str) -> Callable[[SpotlightResult], float]:
        return lambda result: math.degrees(float(np.ptp(getattr(result.profile, angle))))

    rows = [
        row("pitch [°]", "pitch_range_deg", 4, swing("pitch")),
        row("yaw [°]", "yaw_range_deg", 4, swing("yaw")),
        row("roll [°]", "roll_range_deg", 4, swing("roll")),
        row("ground speed [m/s]", "ground_speed_m_s", 0, lambda r: r.plan.ground_speed),
        row("Doppler bandwidth [Hz]", "doppler_bandwidth_hz", 0, lambda r: r.history.bandwidth),
        row("resolution [m]", "resolution_m", 1, lambda r: r.history.resolution),
    ]
    return markdown_table(["figure", "printed", "inferred, left", "inferred, right"], rows)


def han2016_aim() -> str:
    """Largest aim errors of Han's example, by what the attitude knows of."""
    names = {
        "without_both": "neither off-axis angle nor phase center",
        "without_phase_center": "off-axis angle, no phase center",
        "iterated": "both, by the iteration",
        "closed_form": "both, in closed form",
    }
    rows = []
    for name, text in names.items():
        largest = (float(getattr(han2016(s).aim_error, name).max()) for s in ("left", "right"))
        texts = (
            f"{e / 1e3:.0f} km" if e > 1e3 else f"{e:.2f} m" if e > 1e-3 else "below 1e-7 m"
            for e in largest
        )
        rows.append([text, *texts])
    return markdown_table(["the attitude considers", "left", "right"], rows)


def han2016_verdicts() -> str:
    """The claims of the shipped study, judged."""
    setup = build_spotlight(load_study(DOCS.parent / "configs" / "han2016_spotlight.yaml").study)
    result = spotlight(setup.request, setup.samples)
    claims = [judge_spotlight(claim, result) for claim in setup.claims]
    return verdict_table(claims, "from inferred inputs")


TABLES: dict[str, Callable[[], str]] = {
    "han2016_verdicts": han2016_verdicts,
    "han2016_figures": han2016_figures,
    "han2016_aim": han2016_aim,
}
"""Tables by the name that a page calls them."""
