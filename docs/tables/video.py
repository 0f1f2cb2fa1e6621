"""Tables on Liang 2018."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from configs import load_study
from configs.staring import build_video
from formation import (
    KeplerianOrbit,
)
from insar.observe.agile.video import video
from insar.observe.agile.video_claims import judge_video
from insar.observe.agile.video_request import VideoRequest
from insar.observe.agile.video_results import VideoResult

from .markdown import DOCS, PUBLISHED, markdown_table
from .verdicts import verdict_table

LIANG2018: dict[str, Any] = tomllib.loads(
    (PUBLISHED / "liang2018.toml").read_text(encoding="utf-8")
)


@cache
def liang2018(*, orbit: str = "equatorial", wide: bool = False) -> VideoResult:
    """The film of Sasebo from inferred inputs; `wide` exchanges the two widths of the beam."""
    table, elements = LIANG2018["inferred"], LIANG2018["orbits"][orbit]
    trajectory = KeplerianOrbit.circular(
        altitude=elements["altitude_m"],
        inclination=math.radians(table["inclination_deg"]),
        epoch=LIANG2018["printed"]["zero_doppler"],
        raan=math.radians(elements["raan_deg"]),
        argument_of_latitude=math.radians(elements["argument_of_latitude_deg"]),
    )
    widths = [math.radians(table[f"{name}_beamwidth_deg"]) for name in ("azimuth", "elevation")]
    azimuth, elevation = reversed(widths) if wide else widths
    request = VideoRequest(
        trajectory=trajectory,
        latitude=math.radians(table["latitude_deg"]),
        longitude=math.radians(table["longitude_deg"]),
        wavelength=table["wavelength_m"],
        resolution=table["resolution_m"],
        frame_rate=table["frame_rate_hz"],
        duration=200.0,
        start=-300.0,
        stop=300.0,
        azimuth_beamwidth=azimuth,
        elevation_beamwidth=elevation,
        max_overlap=0.5,
    )
    return video(request)


def liang2018_rates() -> str:
    """Angles and rates of the film, from the two readings of its altitude."""
    films = [liang2018(orbit=name) for name in ("equatorial", "mean_radius")]

    def row(name: str, value: Callable[[VideoResult], str]) -> list[str]:
        return [name, *(value(film) for film in films)]

    def ends(name: str) -> Callable[[VideoResult], str]:
        def text(film: VideoResult) -> str:
            angles = np.rad2deg(getattr(film.profile, name))
            return " / ".join(f"{angles[k]:.1f}" for k in (0, len(angles) // 2, -1))

        return text

    def peak(name: str) -> Callable[[VideoResult], str]:
        return lambda film: f"{np.rad2deg(np.abs(getattr(film.profile, name)[:, 1]).max()):.3f}"

    rows = [
        row("slant range at zero Doppler [km]", lambda film: f"{film.plan.slant_range / 1e3:.1f}"),
        row("pitch, start / middle / end [°]", ends("pitch")),
        row("roll [°]", ends("roll")),
        row("yaw, azimuth trace held [°]", ends("yaw")),
        row("pitch rate, orbit frame [°/s]", peak("rate_orbit")),
        row("pitch rate, inertial [°/s]", peak("rate_inertial")),
    ]
    return markdown_table(["inferred: 514 km above", "6378.137 km", "6371 km"], rows)


def liang2018_laws() -> str:
    """What each yaw law leaves, for the beam of the example and for one turned by 90°."""
    rows = []
    for law, turned in zip(liang2018().laws, liang2018(wide=True).laws, strict=True):
        traces = np.rad2deg([law.azimuth_trace, law.range_trace, law.major_axis, law.shear])
        rows.append(
            [
                f"`{law.law.value}`",
                *(f"{angle:.1f}" for angle in (*traces, math.degrees(law.yaw))),
                f"{math.degrees(law.rate_inertial):.2f}",
                f"{law.common_area:.0%}".replace("%", " %"),
                f"{turned.common_area:.0%}".replace("%", " %"),
            ]
        )
    head = ["law", "azimuth [°]", "range [°]", "major axis [°]", "shear [°]", "yaw [°]"]
    return markdown_table(
        [*head, "rate, inertial [°/s]", "common area", "common area, 1.5° by 0.4°"], rows
    )


def liang2018_frames() -> str:
    """Frames of the example over the film."""
    frames = liang2018().frames
    rows = []
    for time in (-100.0, -50.0, 0.0, 50.0, 100.0):
        k = int(np.argmin(np.abs(frames.times - time)))
        lengths = (frames.printed_length[k], frames.hyperbolic.length[k], frames.exact.length[k])
        rows.append(
            [
                f"{time:.0f}",
                f"{abs(math.degrees(frames.squint[k])):.1f}",
                *(f"{length / 1e3:.3f}" for length in lengths),
                f"{frames.exact.duration[k]:.3f}",
                f"{frames.exact.overlap[k]:.3f}",
                f"{frames.exact.independent_rate[k]:.3f}",
                f"{frames.exact.rate_limit[k]:.3f}",
                f"{frames.ground_resolution[k]:.2f}",
            ]
        )
    head = ["t [s]", "squint [°]", "printed [km]", "hyperbola [km]", "exact [km]", "exact [s]"]
    tail = ["overlap at 1 Hz", "rate, none [Hz]", "rate, half [Hz]", "resolution [m]"]
    return markdown_table([*head, *tail], rows)


def liang2018_pointing() -> str:
    """What small turns of the body do, at both ends and in the middle."""
    pointing = liang2018().pointing
    samples = (0, len(pointing.center) // 2, -1)
    moved = np.linalg.norm(pointing.center_per_turn, axis=1)
    rows = []
    for axis, name in enumerate(("X (roll)", "Y (pitch)", "Z (yaw)")):
        center = " / ".join(f"{moved[k, axis] * 1e-3:.0f}" for k in samples)
        turned = " / ".join(f"{abs(pointing.rotation_per_turn[k, axis]):.2f}" for k in samples)
        rows.append([f"1 mrad about {name}", center, turned])
    return markdown_table(["turn", "center moves by [m]", "azimuth trace rotates by [mrad]"], rows)


def liang2018_verdicts() -> str:
    """The claims of the shipped study, judged."""
    setup = build_video(load_study(DOCS.parent / "configs" / "liang2018_video.yaml").study)
    result = video(setup.request, 201, 11)
    claims = [judge_video(claim, result) for claim in setup.claims]
    return verdict_table(claims, "from inferred inputs")


TABLES: dict[str, Callable[[], str]] = {
    "liang2018_verdicts": liang2018_verdicts,
    "liang2018_rates": liang2018_rates,
    "liang2018_laws": liang2018_laws,
    "liang2018_frames": liang2018_frames,
    "liang2018_pointing": liang2018_pointing,
}
"""Tables by the name that a page calls them."""
