"""What the author of a wrong value should write instead."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

from .messages import did_you_mean, show
from .schema import Schema, choices

_SPEED_OF_LIGHT = 299_792_458.0

_Guess = tuple[str, Callable[[float], float]]
_MILLI = ("millimeters", lambda value: value / 1e3)
_GUESSES: dict[str, list[_Guess]] = {
    "wavelength_m": [
        _MILLI,
        ("centimeters", lambda value: value / 1e2),
        ("GHz", lambda value: _SPEED_OF_LIGHT / (1e9 * value)),
        ("Hz", lambda value: _SPEED_OF_LIGHT / value),
    ],
    "_deg_s2": [("radians per second squared", math.degrees)],
    "_deg_s": [("radians per second", math.degrees)],
    "_m_s": [("mm/s", lambda value: value / 1e3)],
    "_km": [("meters", lambda value: value / 1e3)],
    "_m": [_MILLI, ("kilometers", lambda value: value * 1e3)],
    "_deg": [("radians", math.degrees)],
    "_db": [("linear scale", lambda value: 10.0 * math.log10(value))],
    "_s": [("milliseconds", lambda value: value / 1e3)],
    "_min": [
        ("seconds", lambda value: value / 60.0),
        ("hours", lambda value: value * 60.0),
    ],
    "_days": [
        ("hours", lambda value: value / 24.0),
        ("seconds", lambda value: value / 86_400.0),
    ],
    "probability": [("percent", lambda value: value / 1e2 if value >= 2.0 else math.nan)],
    "coherence": [("percent", lambda value: value / 1e2 if value >= 2.0 else math.nan)],
}
"""For the end of a key: what its author may have written in, and the conversion to the key's unit.

The first end that fits counts."""


_UNITS = (
    {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "km": 1e3},
    {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180.0},
    {"ms": 1e-3, "s": 1.0, "min": 60.0, "hours": 3600.0, "days": 86_400.0},
    {"hz": 1.0, "khz": 1e3, "mhz": 1e6, "ghz": 1e9},
)
"""Units of one kind each, by the end of a key, in the first one's SI unit."""


def in_known_unit(key: str, value: Any, known: list[str]) -> tuple[str, float] | None:
    """The known key for a quantity that was given in another unit, and its value; None for none.

    Parameters
    ----------
    key : that is not known, such as ``altitude_m``.
    value : that was given for it.
    known : keys of the block.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    stem, _, unit = key.rpartition("_")
    for units in _UNITS:
        if unit not in units:
            continue
        given = value * units[unit]
        if "frequency" in stem and unit.endswith("hz") and "wavelength_m" in known and given > 0.0:
            return "wavelength_m", _SPEED_OF_LIGHT / given
        for other, scale in units.items():
            if f"{stem}_{other}" in known:
                return f"{stem}_{other}", given / scale
    return None


def remedy(value: Any, key: str, schema: Schema) -> str:
    """What to do about a value that its key does not allow.

    Parameters
    ----------
    value : the value.
    key : its key, which ends in its unit.
    schema : what is allowed, from `schema_at`.
    """
    kinds = {choice.get("type") for choice in choices(schema)}
    numeric = bool(kinds & {"number", "integer"})
    if value is None:
        return "give a value, or remove the key"
    if kinds == {"boolean"}:
        return "write true or false"
    if {"string", "array"} <= kinds and isinstance(value, int | float | dict):
        return "give its two lines, as text or as a list"
    if isinstance(value, list) and "array" in kinds:
        return "add or remove entries"
    if numeric and isinstance(value, bool | list | dict):
        return "write one number"
    if numeric and isinstance(value, int | float):
        return _for_number(value, key, schema)
    if isinstance(value, str) and numeric:
        return _for_number_in_text(value)
    if isinstance(value, str) and "string" in kinds:
        words = [str(word) for choice in choices(schema) for word in choice.get("enum", [])]
        if "one_transmitter" in words and value.lower() in {"bistatic", "single", "single_pass"}:
            return "did you mean 'one_transmitter'?"
        return did_you_mean(value, words).strip() or "correct the text"
    if isinstance(value, int | float) and "string" in kinds:
        return f"as a text it needs quotes: '{show(value)}'"
    if "array" in kinds:
        return "write a list, as in [a, b]"
    return f"indent its keys below '{key}:'" if "object" in kinds else "correct the value"


def _for_number(value: float, key: str, schema: Schema) -> str:
    if not math.isfinite(value):
        return "write a finite number"
    if isinstance(value, float) and value.is_integer() and _allows_whole(value, schema):
        return f"write it without a decimal point: {int(value)}"
    end = next((end for end in _GUESSES if key.endswith(end)), None)
    hints: list[str] = []
    for unit, convert in _GUESSES[end] if end else []:
        try:
            converted = convert(value)
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
        if any(_allows(choice, converted) for choice in choices(schema)):
            hints.append(f"{'if in' if hints else 'if it is in'} {unit}, write {converted:.6g}")
    return "; ".join(hints) or (
        "check the value and its unit" if end else "choose a value within these limits"
    )


def _for_number_in_text(value: str) -> str:
    text = value.strip().replace("\N{MINUS SIGN}", "-")
    if re.fullmatch(r"[-+]?\d+,\d+", text):
        return f"use a decimal point: {text.replace(',', '.')}"
    if re.fullmatch(r"[-+]?\d[\d_']*(\.\d*)?([eE][-+]?\d+)?", text):
        digits = text.replace("_", "").replace("'", "")
        return f"write the number without quotes or separators: {digits}"
    if re.fullmatch(r"[-+]?[\d.,]+(e[-+]?\d+)?\s*[^\d\s.,][^\d]*", text, re.IGNORECASE):
        return "write the number alone; its unit is in the key"
    return "write a number"


def _allows(schema: Schema, value: float) -> bool:
    return (
        schema.get("type") in ("number", "integer")
        and schema.get("minimum", -math.inf) <= value <= schema.get("maximum", math.inf)
        and schema.get("exclusiveMinimum", -math.inf) < value
    )


def _allows_whole(value: float, schema: Schema) -> bool:
    return any(
        choice.get("type") == "integer" and _allows(choice, value) for choice in choices(schema)
    )
