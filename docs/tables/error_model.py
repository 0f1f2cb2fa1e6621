"""Examples of the error model."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import minimize_scalar

from insar import (
    HeldConstant,
    Scene,
    fisher_information,
    snr_coherence,
)
from insar.baselines import sensitivity
from insar.phase_information import independent_pairs_information, pair_phase_variance

from .markdown import MODEL, digits, markdown_table


def published_sensitivity(held: HeldConstant) -> float:
    """Path change per meter of height of the published example."""
    case = MODEL["height_sensitivity"]
    scene = Scene.flat_earth(
        times=[0.0],
        slant_range=[case["slant_range_km"] * 1e3],
        look_angle=[math.radians(case["look_deg"])],
        azimuth=[math.radians(case["azimuth_deg"])],
    )
    direction = sensitivity(scene, held)
    projected = direction.height_direction[0] @ np.array(case["baseline_rtn_m"])
    return float(projected / direction.height_lever[0])


def sensitivity_example() -> str:
    """Path change per meter of height by both forms."""
    baseline = ", ".join(str(b) for b in MODEL["height_sensitivity"]["baseline_rtn_m"])
    held = (HeldConstant.DOPPLER, HeldConstant.AZIMUTH)
    values = [published_sensitivity(one) for one in held]
    rows = [
        ["range and Doppler", f"{1e3 * values[0]:.4f}", "1"],
        [
            "range and azimuth angle (Li 2009)",
            f"{1e3 * values[1]:.4f}",
            digits(values[1] / values[0], 3),
        ],
    ]
    head = ["held constant", f"path per height, baseline ({baseline}) m RTN [mm/m]", "ratio"]
    return markdown_table(head, rows)


def _filtering_gain(share: float) -> float:
    gamma = snr_coherence(10.0, 10.0)
    unfiltered = pair_phase_variance(gamma * (1 - share), looks=1.0)
    return float(unfiltered / pair_phase_variance(gamma, looks=1.0 - share))


def two_image_optimum(*, filtered: bool) -> float:
    """Baseline, in critical ones, of the smallest height noise of two images at 10 dB."""
    gamma = snr_coherence(10.0, 10.0)

    def height_variance(share: float) -> float:
        coherence, looks = (gamma, 1 - share) if filtered else (gamma * (1 - share), 1.0)
        return float(pair_phase_variance(coherence, looks=looks)) / share**2

    return float(minimize_scalar(height_variance, bounds=(0.05, 0.95), method="bounded").x)


def filtering() -> str:
    """What range spectral filtering gains at 10 dB."""
    shares = (0.1, 0.25, 0.5, 0.75)
    rows = [
        [
            "phase information, filtered over unfiltered",
            *(f"{_filtering_gain(s):.1f}" for s in shares),
        ]
    ]
    return markdown_table(["baseline over critical", *(f"{s}" for s in shares)], rows)


def three_image_errors() -> tuple[float, float, float]:
    """Height error by joint information, three independent pairs, and the longest pair [m]."""
    case = MODEL["three_images"]
    gamma, looks = case["coherence"], float(case["looks"])
    kz = np.array(case["vertical_wavenumber_rad_m"])
    joint = fisher_information(np.full((3, 3), gamma) + (1 - gamma) * np.eye(3), looks=looks)
    variance = pair_phase_variance(gamma, looks=looks)
    pairs = independent_pairs_information(
        np.full(3, variance), pairs=np.array([[0, 1], [0, 2], [1, 2]]), count=3
    )
    return (
        float(1 / np.sqrt(kz @ joint @ kz)),
        float(1 / np.sqrt(kz @ pairs @ kz)),
        float(np.sqrt(variance) / kz[2]),
    )


def three_images() -> str:
    """Joint information against independent pairs."""
    joint, pairs, longest = (digits(value, 4) for value in three_image_errors())
    rows = [
        ["joint Fisher information of three images", joint],
        ["three pairs counted as independent", pairs],
        ["longest pair alone", longest],
    ]
    return markdown_table(["information", "height error [m]"], rows)


TABLES: dict[str, Callable[[], str]] = {
    "sensitivity": sensitivity_example,
    "filtering": filtering,
    "three_images": three_images,
}
"""Tables by the name that a page calls them."""
