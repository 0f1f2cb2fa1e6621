"""Sections on when to take which law, and on what the simplified law compensates."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from insar.observe import Compensation, Selection

from ..document import Block, Callout, Column, Figure, Paragraph, Section, Status, Table
from ..figures.compensation import effects_figure, sweep_figure
from ..figures.selection import selection_figure
from ..reading_steering import ROUNDING
from ..steering_words import effect_name, held_text, law_name
from ..tables_steering import crossover_frame, effects_frame
from ..wording import MISSING, fixed, joined, once, or_zero, plain, significant, to_decimals

Array = NDArray[np.float64]


def selection_section(selections: Sequence[Selection]) -> Section | None:
    """Which law to take; None where the study asks for no selection."""
    if not selections:
        return None
    blocks: list[Block] = [
        Paragraph(
            "Both laws bring the boresight to zero Doppler. Which of them costs less depends on "
            "altitude and inclination, and on what is held constant while these vary: at a "
            "constant incidence the boresight comes closer to nadir the higher the satellite, at "
            "a constant look angle it does not."
        )
    ]
    blocks += [
        _selection_figure(one) if np.any(np.isfinite(one.steering_angle)) else _unsolved(one)
        for one in selections
    ]
    blocks.append(_crossover_table(selections))
    return Section("selection", "Which law to take", tuple(blocks))


def _unsolved(selection: Selection) -> Callout:
    """Why there is nothing to draw."""
    laws = " nor ".join(law_name(law) for law in selection.laws)
    text = (
        f"At {held_text(selection.held, selection.boresight_angle)} and an eccentricity of "
        f"{plain(selection.eccentricity)}, neither {laws} "
        "has a solution all around any of these orbits: somewhere the beam misses the Earth, or "
        "the pitch that zero Doppler needs exceeds the boresight's angle from nadir. A boresight "
        "nearer to nadir, lower altitudes or a smaller eccentricity may have one."
    )
    return Callout(Status.WARNING, "No law can be taken", (text,))


def _selection_figure(selection: Selection) -> Figure:
    zero = [
        law_name(law)
        for law, values in zip(selection.laws, selection.swath_doppler, strict=True)
        if np.nanmax(values, initial=0.0) < ROUNDING
    ]
    caption = (
        f"{joined([law_name(law) for law in selection.laws])} at "
        f"{held_text(selection.held, selection.boresight_angle)}, eccentricity "
        f"{plain(selection.eccentricity)}: largest values over a revolution against the altitude "
        "of the semi-major axis. (a) Sum of the steered angles; circles: where both laws need the "
        "same. (b) Time to turn by the largest single angle. (c) Rate of the steered angles. "
        "(d) Doppler for a beam turned by 0.01°. (e) Doppler off the boresight, both ways"
    )
    if zero:
        caption += f"; that of {joined(zero)} is zero (below {plain(ROUNDING)}\u00a0Hz), not drawn"
    if np.any(np.isnan(selection.steering_angle)):
        caption += ". A line ends where the law has no solution all around the orbit"
    return Figure(
        selection_figure(selection),
        caption[:1].upper() + caption[1:] + ".",
        "Line charts of five costs of two steering laws against altitude.",
    )


def _crossover_table(selections: Sequence[Selection]) -> Table:
    frame = crossover_frame(selections)
    frame["held"] = once(
        [
            f"{one.held.value} {plain(math.degrees(one.boresight_angle))}°"
            for one in frame["selection"]
        ]
    )
    frame["altitude"] = [
        joined([f"{fixed(value / 1e3, 0)} km" for value in found])
        if found
        else _without_crossover(selection)
        for selection, found in zip(frame["selection"], frame["crossovers"], strict=True)
    ]
    return Table(
        frame,
        (
            Column("held", "Held constant"),
            Column("inclination_deg", "Inclination", "°", to_decimals(1)),
            Column("altitude", "Altitude of equal steered angles"),
        ),
        "Below the altitude of equal angles yaw-pitch steering turns less, above it pitch-roll "
        "steering.",
    )


def _without_crossover(selection: Selection) -> str:
    if not np.any(np.isfinite(selection.steering_angle)):
        return "neither law has a solution"
    low, high = (fixed(float(f(selection.altitudes)) / 1e3, 0) for f in (np.min, np.max))
    return f"none between {low} and {high} km"


def compensation_section(compensation: Compensation | None) -> Section | None:
    """How much of the Doppler the simplified model compensates; None if it is not asked."""
    if compensation is None:
        return None
    frame = effects_frame(compensation)
    frame["effect"] = once([effect_name(curve.effect) for curve in frame["curve"]])
    frame["perigee"] = [
        f"{fixed(math.degrees(curve.argument_of_perigee), 0)}°" if curve.eccentricity else MISSING
        for curve in frame["curve"]
    ]
    blocks: list[Block] = [
        Paragraph(
            "The simplified model takes the Earth for a sphere and the orbit for a circle. What "
            "yaw steering by it leaves is the difference of the exact and the simplified Doppler "
            "of the radar that is not steered. Doppler is given as a range rate, λf/2, which "
            "depends on no wavelength."
        ),
        Figure(
            effects_figure(compensation),
            "Exact and simplified Doppler over a revolution, with one effect at a time and with "
            "all of them; right, the difference (Meng 2003, figures 3 to 5).",
            "Line charts of exact and simplified Doppler, and of their difference.",
        ),
        Table(
            frame,
            (
                Column("effect", "Effect"),
                Column("eccentricity", "Eccentricity", "", _plains),
                Column("perigee", "Perigee at"),
                Column("exact_m_s", "Largest Doppler", "m/s", to_decimals(2)),
                Column("deviation_m_s", "Largest difference", "m/s", _meters_per_second),
                Column("compensation", "Compensated, maximum", "%", _percents),
                Column("compensation_rms", "Compensated, RMS", "%", _percents),
            ),
            "What the simplified model compensates: one minus the norm of the difference over "
            "that of the Doppler.",
        ),
        Figure(
            sweep_figure(compensation),
            "Compensation against the eccentricity, with no other effect (Meng 2003, figure 6). "
            f"{_where_sought(compensation)}",
            "Line chart of the compensation against the eccentricity.",
        ),
    ]
    return Section("compensation", "What the simplified law compensates", tuple(blocks))


def _plains(values: Sequence[float]) -> list[str]:
    return [plain(float(value)) for value in values]


def _percents(values: Sequence[float]) -> list[str]:
    return [fixed(100.0 * float(value), 2) for value in values]


def _meters_per_second(values: Sequence[float]) -> list[str]:
    return [or_zero(float(value), 1e-6) for value in values]


def _where_sought(compensation: Compensation) -> str:
    """Eccentricity at which each norm falls to 95 %."""
    found = [
        f"{significant(float(at))} in the {name} norm"
        for name, values in (
            ("maximum", compensation.sweep),
            ("root-mean-square", compensation.sweep_rms),
        )
        if (at := _crossing(compensation.eccentricities, values, 0.95)) is not None
    ]
    if not found:
        return "Neither norm falls to 95 % in this range."
    return f"It falls to 95 % at an eccentricity of {joined(found)}."


def _crossing(abscissa: Array, values: Array, level: float) -> float | None:
    below = np.flatnonzero((values[:-1] >= level) & (values[1:] < level))
    if below.size == 0:
        return None
    first, last = below[0], below[0] + 1
    part = (values[first] - level) / (values[first] - values[last])
    return float(abscissa[first] + part * (abscissa[last] - abscissa[first]))
