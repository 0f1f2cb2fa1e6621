"""Steering in words: laws, boresights, outcomes and effects."""

from __future__ import annotations

import math

import numpy as np

from insar.observe import Boresight, Effect, FixedIncidence, Held, Law, LawCurves, Outcome

from .wording import percent, plain

_LAWS = {
    Law.NONE: "none",
    Law.YAW: "yaw",
    Law.YAW_PITCH_APPROXIMATE: "approximate yaw-pitch",
    Law.YAW_PITCH: "yaw-pitch",
    Law.PITCH_ROLL: "pitch-roll",
}

_OUTCOMES = {
    Outcome.MISSES_EARTH: "the beam misses the Earth",
    Outcome.TOO_NEAR_NADIR: "the pitch needed exceeds the boresight's angle from nadir",
    Outcome.INCIDENCE_UNREACHED: "the incidence is not reached",
}

_EFFECTS = {
    Effect.EARTH_SHAPE: "shape of the Earth",
    Effect.J2: "J2",
    Effect.ECCENTRICITY: "eccentricity",
    Effect.ALL: "all together",
}


def law_name(law: Law) -> str:
    """Steering law in words."""
    return _LAWS[law]


def effect_name(effect: Effect) -> str:
    """Effect that the simplified Doppler model leaves out, in words."""
    return _EFFECTS[effect]


def boresight_text(boresight: Boresight) -> str:
    """What the boresight holds constant."""
    held = Held.INCIDENCE if isinstance(boresight, FixedIncidence) else Held.LOOK
    return held_text(held, boresight.angle)


def held_text(held: Held, angle: float) -> str:
    """The same, given the kind and the angle [rad]."""
    what = "an incidence on the ellipsoid" if held is Held.INCIDENCE else "a look angle"
    return f"{what} of {plain(math.degrees(angle))}°"


def solved(curves: LawCurves) -> float:
    """Share of the samples at which a law has a solution."""
    return float(np.mean(curves.outcome == Outcome.SOLVED))


def unsolved_reason(curves: LawCurves) -> str | None:
    """Why a law has no solution at some samples; None where it has one at all."""
    if solved(curves) == 1.0:
        return None
    missing = curves.outcome[curves.outcome != Outcome.SOLVED]
    reasons = [
        f"{_OUTCOMES[Outcome(value)]} at {percent(count / curves.outcome.size)} of the samples"
        for value, count in zip(*np.unique(missing, return_counts=True), strict=True)
    ]
    return " or ".join(reasons)
