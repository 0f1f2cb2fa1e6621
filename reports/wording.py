"""Numbers and names as people read them. The only place where a report rounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from datetime import datetime, timedelta
from typing import NamedTuple

MISSING = "—"
"""Shown where there is no finite number."""

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

_SOURCES = {
    "phase": "phase noise",
    "position": "satellite position",
    "azimuth": "azimuth",
    "range": "slant range",
    "synchronization": "synchronization",
    "troposphere": "troposphere",
    "ionosphere": "ionosphere",
    "ionosphere_gradient": "gradient of the ionosphere",
}


def fixed(value: float, decimals: int) -> str:
    """Number with a given count of decimals.

    >>> fixed(-0.00001, 2), fixed(-1.5, 2), fixed(float("inf"), 2)
    ('0.00', '−1.50', '—')
    """
    if not math.isfinite(value):
        return MISSING
    rounded = round(value, decimals) + 0.0  # + 0.0 turns −0 into 0
    return f"{rounded:.{decimals}f}".replace("-", "−")


def significant(value: float, digits: int = 3) -> str:
    """Number with a given count of significant digits, powers of ten only below 0.0001.

    >>> significant(0.25290), significant(9.999), significant(1353.66), significant(-7.5e-11)
    ('0.253', '10.0', '1354', '−7.50 × 10⁻¹¹')
    """
    if not math.isfinite(value) or value == 0.0:
        return MISSING if value != 0.0 else "0"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")  # rounded before it is measured
    exponent = int(power)
    if exponent < -4:
        return f"{mantissa} × 10{str(exponent).translate(_SUPERSCRIPTS)}".replace("-", "−")
    return fixed(value, max(digits - 1 - exponent, 0))


def plain(value: float) -> str:
    """Number with at most five significant digits and no trailing zeros.

    >>> plain(100.0), plain(1353.6601), plain(0.66821), plain(1e-6)
    ('100', '1353.7', '0.66821', '10⁻⁶')
    """
    number, times, power = significant(value, 5).partition(" × ")
    if "." in number:
        number = number.rstrip("0").rstrip(".")
    return power if times and number == "1" else f"{number}{times}{power}"


def probability(value: float) -> str:
    """Probability to four decimals, never rounded up to certainty.

    >>> probability(0.99), probability(0.9999999), probability(1e-9)
    ('0.9900', '> 0.9999', '< 0.0001')
    """
    if not math.isfinite(value):
        return MISSING
    if value > 0.9999:
        return "> 0.9999"
    return "< 0.0001" if value < 0.0001 else f"{value:.4f}"


def percent(share: float) -> str:
    """Share in per cent.

    >>> percent(0.8794), percent(0.0000657), percent(1.0)
    ('88 %', '< 0.1 %', '100 %')
    """
    if not math.isfinite(share):
        return MISSING
    if share < 0.001:
        return "< 0.1 %"
    return f"{100.0 * share:.{0 if share >= 0.0995 else 1}f} %"


def quantity(text: str, unit: str) -> str:
    """Number and unit, kept on one line."""
    return f"{text}\u00a0{unit}" if unit else text


def meters(value: float, digits: int = 3) -> str:
    """Length with a given count of significant digits and its unit."""
    return quantity(significant(value, digits), "m") if math.isfinite(value) else MISSING


def to_decimals(decimals: int) -> Callable[[Sequence[float]], list[str]]:
    """Formatter of a column: the same count of decimals throughout."""
    return lambda values: [fixed(float(value), decimals) for value in values]


def to_digits(digits: int) -> Callable[[Sequence[float]], list[str]]:
    """Formatter of a column whose values may differ by orders: so many digits of each."""
    return lambda values: [significant(float(value), digits) for value in values]


def to_probabilities(values: Sequence[float]) -> list[str]:
    """Format a column of probabilities."""
    return [probability(float(value)) for value in values]


class Span(NamedTuple):
    """A value over the scene: the smallest, that of the middle segment, the largest."""

    low: float
    middle: float
    high: float


def to_span(show: Callable[[float], str]) -> Callable[[Sequence[Span]], list[str]]:
    """Formatter of a column of spans, given that of a number."""
    return lambda values: [span(value, show) for value in values]


def span(value: Span, show: Callable[[float], str]) -> str:
    """Middle of a span, or both its ends where they differ by more than 1 %.

    >>> span(Span(999.0, 1000.0, 1001.0), plain), span(Span(-2.0, 0.0, 2.0), plain)
    ('1000', '−2 … 2')
    """
    low, high = show(value.low), show(value.high)
    if low == high or value.high - value.low <= 0.01 * max(abs(value.low), abs(value.high)):
        return show(value.middle)
    return f"{low} … {high}"


def ambiguity(value: float) -> str:
    """Height of ambiguity; one above 100 km is that of next to no baseline.

    >>> ambiguity(23.2941), ambiguity(math.inf)
    ('23.29', '> 10⁵')
    """
    return "> 10⁵" if value > 1e5 else significant(value, 4)


def method_name(method: str) -> str:
    """Search algorithm in words.

    >>> method_name("genetic"), method_name("cma_es")
    ('genetic algorithm', 'CMA-ES')
    """
    return {
        "genetic": "genetic algorithm",
        "differential_evolution": "differential evolution",
        "cma_es": "CMA-ES",
    }[method]


def source_name(source: str) -> str:
    """Error source in words."""
    return _SOURCES.get(source, source.replace("_", " "))


def formation_name(label: str) -> str:
    """Formation by its label.

    >>> formation_name("best"), formation_name("formation")
    ('best formation', 'formation')
    """
    return label if label == "formation" else f"{label} formation"


def joined(items: Sequence[str]) -> str:
    """List in words.

    >>> joined(["a"]), joined(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def counted(count: int, noun: str) -> str:
    """Count with its noun.

    >>> counted(1, "segment"), counted(10, "segment")
    ('1 segment', '10 segments')
    """
    return f"{count} {noun}{'' if count == 1 else 's'}"


def latitude_text(degrees: float, decimals: int = 2) -> str:
    """Latitude with its hemisphere.

    >>> latitude_text(37.751), latitude_text(-0.5, 1), latitude_text(0.0, 0)
    ('37.75° N', '0.5° S', '0°')
    """
    return _hemisphere(degrees, decimals, "NS")


def longitude_text(degrees: float, decimals: int = 2) -> str:
    """Longitude within half a turn, with its hemisphere.

    >>> longitude_text(15.0), longitude_text(181.5, 1), longitude_text(-540.0, 0)
    ('15.00° E', '178.5° W', '180°')
    """
    return _hemisphere((degrees + 180.0) % 360.0 - 180.0, decimals, "EW")


def _hemisphere(degrees: float, decimals: int, names: str) -> str:
    number = f"{abs(degrees):.{decimals}f}"
    if float(number) in (0.0, 180.0):
        return f"{float(number):.0f}°"
    return f"{number}° {names[0] if degrees > 0.0 else names[1]}"


def sentences(texts: Sequence[str]) -> tuple[str, ...]:
    """Texts that begin with a capital and end with a period.

    >>> sentences(["the beam is lost; take care", "Known."])
    ('The beam is lost; take care.', 'Known.')
    """
    return tuple(
        f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}" for text in texts
    )


def moment_text(moment: datetime) -> str:
    """Moment to the nearest millisecond.

    >>> moment_text(datetime(2016, 11, 25, 8, 9, 42, 999_994))
    '2016-11-25 08:09:43.000'
    """
    rounded = moment + timedelta(microseconds=500)
    return f"{rounded:%Y-%m-%d %H:%M:%S}.{rounded.microsecond // 1000:03d}"


def power_of_ten(value: float) -> str:
    """Label of a logarithmic axis.

    >>> power_of_ten(1e-9), power_of_ten(1.0), power_of_ten(1e4)
    ('10⁻⁹', '1', '10⁴')
    """
    exponent = round(math.log10(value))
    return "1" if exponent == 0 else f"10{str(exponent).translate(_SUPERSCRIPTS)}"


def frequency(value: float, digits: int = 3) -> str:
    r"""Frequency with a given count of significant digits and its unit.

    >>> frequency(370.66), frequency(2.5e-10)
    ('371\xa0Hz', '2.50 × 10⁻¹⁰\xa0Hz')
    """
    return quantity(significant(value, digits), "Hz") if math.isfinite(value) else MISSING


def or_zero(value: float, least: float) -> str:
    """Number with three digits; 0 for one that is smaller than what counts.

    >>> or_zero(3e-12, 1e-6), or_zero(0.25, 1e-6)
    ('0', '0.250')
    """
    return "0" if abs(value) < least else significant(value)


def once(names: Sequence[str]) -> list[str]:
    """Names, of which one that repeats the one above is left out.

    >>> once(["LEO", "LEO", "GEO"])
    ['LEO', '', 'GEO']
    """
    return ["" if index and names[index - 1] == name else name for index, name in enumerate(names)]
