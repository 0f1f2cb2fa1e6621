"""Tables on Zhao 2019 and Meng 2003."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from configs import load_study
from configs.steered import SteeringSetup, build_steering
from insar import (
    LookSide,
)
from insar.observe import (
    CaseResult,
    Compensation,
    Held,
    Law,
    LawCurves,
    SelectionRequest,
    assess_case,
    compensate,
    judge,
    select,
)
from insar.observe.studies.claims import largest_angle, largest_rate

from .markdown import DOCS, digits, markdown_table


@cache
def steering_study(name: str) -> SteeringSetup:
    """A shipped study of steering."""
    study = load_study(DOCS.parent / "configs" / f"{name}.yaml").study
    return build_steering(study)


@cache
def steering_cases(name: str) -> tuple[CaseResult, ...]:
    """The cases of a shipped study of steering, assessed."""
    return tuple(assess_case(case) for case in steering_study(name).cases)


@cache
def compensation() -> Compensation:
    """What the study of Meng 2003 compensates."""
    return compensate(steering_study("meng2003_yaw").compensation)


def verdicts(name: str) -> str:
    """The claims of a shipped study, judged."""
    study = steering_study(name)
    selections = tuple(select(request) for request in study.selections)
    found = compensation() if study.compensation else None
    rows = []
    for spec in study.claims:
        claim = judge(spec, cases=steering_cases(name), selections=selections, compensation=found)
        # What rounding leaves of a Doppler that is zero differs between platforms.
        shown = "0" if abs(claim.computed) < 1e-6 else digits(claim.computed, 4)
        unit = claim.unit if claim.unit in ("°", "") else f" {claim.unit}"
        rows.append([claim.text, claim.printed, shown + unit, claim.verdict.value, claim.note])
    head = ["figure", "printed", "from the stated inputs", "verdict", "why"]
    return markdown_table(head, rows)


def zhao2019_incidences() -> str:
    """Pitch-roll steering of the geosynchronous orbit at the incidences of figure 4."""
    cases = {case.name: case for case in steering_cases("zhao2019_geosar")}
    rows = []
    for incidence, name in [
        ("15°", "GEO at 15°"),
        ("30°", "GEO at 30°"),
        ("45°", "GEO"),
        ("60°", "GEO at 60°"),
    ]:
        yawed, rolled = cases[name].of(Law.YAW_PITCH), cases[name].of(Law.PITCH_ROLL)
        angles = [np.rad2deg(np.abs(angle).max()) for angle in (rolled.pitch, rolled.roll)]
        ratios = [measure(yawed) / measure(rolled) for measure in (largest_angle, largest_rate)]
        off_nadir = np.rad2deg(rolled.off_nadir.max())
        rows.append([incidence, *(digits(v, 3) for v in (off_nadir, *angles, *ratios))])
    head = ["incidence", "look [°]", "pitch [°]", "roll [°]", "angle ratio", "rate ratio"]
    return markdown_table(head, rows)


def zhao2019_price() -> str:
    """What both laws leave over the swath, and what they cost."""
    rows = []
    for case in steering_cases("zhao2019_geosar")[:3]:
        for law in (Law.YAW_PITCH, Law.PITCH_ROLL):
            rows.append([f"{case.name}, {law.value}", *_price(case.of(law))])
    head = [
        "",
        "total angle [°]",
        "rate [°/s]",
        "boresight [Hz]",
        "0.25° off it [Hz]",
        "0.5° off it [Hz]",
    ]
    return markdown_table(head, rows)


def _price(curves: LawCurves) -> list[str]:
    doppler = np.abs(curves.swath_doppler).max(axis=0)  # at −0.5°, −0.25°, 0°, 0.25°, 0.5°
    return [
        f"{np.rad2deg(curves.steering_angle.max()):.2f}",
        f"{np.rad2deg(largest_rate(curves)):.4f}",
        *(f"{value:.0f}" for value in doppler[2:]),
    ]


def zhao2019_crossovers() -> str:
    """Where the total steering angles are equal, by what figure 6 does not say."""
    perigee = math.pi / 2
    variants = [
        ("circular", 0.0, LookSide.RIGHT),
        ("e = 0.003, right", 0.003, LookSide.RIGHT),
        ("e = 0.003, left", 0.003, LookSide.LEFT),
    ]
    rows = []
    for held, angle in [(Held.LOOK, 7.53), (Held.INCIDENCE, 45.0)]:
        for name, eccentricity, side in variants:
            found = select(
                SelectionRequest(
                    altitudes=np.linspace(500e3, 36_000e3, 143),
                    inclinations=np.deg2rad([30.0, 80.0]),
                    held=held,
                    boresight_angle=math.radians(angle),
                    slew_rate=math.radians(0.02),
                    swath_offset=math.radians(0.5),
                    wavelength=0.031,
                    side=side,
                    eccentricity=eccentricity,
                    argument_of_perigee=perigee,
                )
            )
            cells = [" / ".join(f"{h / 1e3:.0f}" for h in each) for each in found.crossovers]
            rows.append([f"{held.value} {angle:g}°, {name}", *cells])
    return markdown_table(["held, orbit", "i = 30° [km]", "i = 80° [km]"], rows)


def meng2003_effects() -> str:
    """The deviation of the simplified model, effect by effect."""
    rows = []
    for curve in compensation().curves:
        name = curve.effect.value.replace("_", " ")
        if curve.eccentricity > 0.0:
            perigee = math.degrees(curve.argument_of_perigee)
            name += f", e = {curve.eccentricity:g}, perigee at {perigee:.0f}°"
        exact, left = np.abs(curve.exact).max(), np.abs(curve.exact - curve.simplified).max()
        shares = (f"{100 * s:.2f} %" for s in (curve.compensation, curve.compensation_rms))
        rows.append([name, f"{exact:.1f}", f"{left:.2f}", *shares])
    head = ["effect", "exact [m/s]", "deviation [m/s]", "compensated, maximum", "RMS"]
    return markdown_table(head, rows)


def meng2003_sweep() -> str:
    """Compensation against eccentricity."""
    found = compensation()
    rows = []
    for eccentricity in (0.001, 0.002, 0.0023, 0.003, 0.004, 0.005):
        values = (
            float(np.interp(eccentricity, found.eccentricities, each))
            for each in (found.sweep_deviation, found.sweep, found.sweep_rms)
        )
        deviation, largest, rms = values
        shares = (f"{100 * s:.1f} %" for s in (largest, rms))
        rows.append([f"{eccentricity:g}", f"{deviation:.2f}", *shares])
    head = ["eccentricity", "deviation [m/s]", "compensated, maximum", "RMS"]
    return markdown_table(head, rows)


TABLES: dict[str, Callable[[], str]] = {
    "zhao2019_verdicts": lambda: verdicts("zhao2019_geosar"),
    "zhao2019_incidences": zhao2019_incidences,
    "zhao2019_price": zhao2019_price,
    "zhao2019_crossovers": zhao2019_crossovers,
    "meng2003_verdicts": lambda: verdicts("meng2003_yaw"),
    "meng2003_effects": meng2003_effects,
    "meng2003_sweep": meng2003_sweep,
}
"""Tables by the name that a page calls them."""
