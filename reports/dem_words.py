"""Words and units for elevation models and the items of a budget."""

from __future__ import annotations

import math

from insar import Scale
from insar.dem import Quantity as Demand
from optimize.sensitivity import Quantity

from .wording import MISSING, quantity, significant

ITEMS = {
    "snr": "signal-to-noise ratio, σ⁰/NESZ",
    "looks": "looks",
    "slant_range_resolution": "slant-range resolution (its critical baseline)",
    "azimuth_resolution": "azimuth resolution",
    "position": "satellite position error",
    "azimuth": "azimuth error",
    "range": "slant-range error",
    "synchronization": "synchronization error",
    "troposphere": "zenith delay left",
    "ionosphere": "electron content left",
    "calibration_spacing": "spacing of control, across",
    "calibration_accuracy": "accuracy of control",
    "calibration_bias": "bias of control",
    "rasr": "range ambiguities",
    "aasr": "azimuth ambiguities",
    "range_shift": "co-registration in range",
    "azimuth_shift": "co-registration in azimuth",
    "processing_loss": "coherence lost in processing",
    "other_loss": "other loss of coherence",
    "volume_height": "height of the volume",
    "time_constant": "time constant of the scene",
    "quantization_bits": "bits of the raw data",
    "prior_height": "prior height error",
    "baselines": "all baselines",
}

SCALES = {
    Scale.PIXEL: "pixel",
    Scale.SCENE: "scene",
    Scale.DATA_TAKE: "data take",
    Scale.ORBIT: "orbit",
    Scale.MISSION: "mission",
}

DEMANDS = {
    Demand.POSTING: "posting",
    Demand.RELATIVE: "relative error, 90\u00a0%",
    Demand.ABSOLUTE: "absolute error, 90\u00a0%",
}

QUANTITIES = {
    Quantity.TOTAL: "total, 1σ",
    Quantity.RELATIVE: "relative, 90\u00a0%",
    Quantity.ABSOLUTE: "absolute, 90\u00a0%",
    Quantity.FAILURE: "wrong cycle",
}


def item_name(item: str) -> str:
    """Item of a budget in words."""
    return ITEMS.get(item, item.replace("_", " "))


def item_value(item: str, value: float | None) -> str:
    r"""Value of an item in the unit that people use.

    >>> item_value("snr", 10.0), item_value("position", 0.0015), item_value("baselines", 1.25)
    ('10.0\xa0dB', '1.50\xa0mm', '× 1.25')
    """
    if value is None:
        return MISSING
    if item in ("snr", "rasr", "aasr"):
        return quantity(f"{10.0 * math.log10(value):.1f}".replace("-", "−"), "dB")
    if item == "baselines":
        return f"× {significant(value)}"
    scale, unit = {
        "looks": (1.0, ""),
        "quantization_bits": (1.0, ""),
        "range_shift": (1.0, "cells"),
        "azimuth_shift": (1.0, "cells"),
        "processing_loss": (100.0, "%"),
        "other_loss": (100.0, "%"),
        "time_constant": (1.0, "s"),
        "azimuth": (1e6, "µrad"),
        "synchronization": (180.0 / math.pi, "°"),
        "position": (1e3, "mm"),
        "ionosphere": (1e-16, "TECU"),
        "calibration_spacing": (1e-3, "km"),
    }.get(item, (1.0, "m"))
    text = significant(scale * value)
    return f"{text}°" if unit == "°" else quantity(text, unit)
