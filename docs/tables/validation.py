"""Reference values and how far the code is from them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from formation import (
    ground_track_circular,
    space_circular,
)
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Scene,
    SharedBy,
    Weighting,
    critical_baseline,
    height_of_ambiguity,
    scene_critical_baseline,
    snr_coherence,
    two_baseline_probability,
)
from insar.coherence import (
    PenetratedVolume,
    UniformVolume,
    ambiguity_coherence,
    azimuth_resolution,
    coregistration_coherence,
    doppler_offset,
    quantization_coherence,
    quantization_distortion,
)
from insar.phase_information import pair_phase_variance
from optimize import (
    Constraints,
    DesignSpace,
    GeneticSettings,
    Problem,
)

from .error_model import published_sensitivity, three_image_errors, two_image_optimum
from .li2009 import (
    CASE_LABELS,
    CASES,
    FAMILIES,
    MEAN_MOTION,
    SCENE,
    SHARED,
    best_of,
    paper_optimum,
    paper_radar,
    preset_errors,
    printed_errors,
)
from .markdown import DUMBBELL, LI2009, MODEL, digits, markdown_table


class Check(NamedTuple):
    """A quantity with a value to compare with.

    Attributes
    ----------
    quantity : what is compared, with its unit.
    reference : the value as its source gives it.
    source : where that comes from.
    value : what this code gives.
    shown : significant digits of the value.
    """

    quantity: str
    reference: str
    source: str
    value: float
    shown: int = 4


def check_table(checks: Iterator[Check]) -> str:
    """Table of checks with their relative differences."""
    rows = []
    for check in checks:
        difference = check.value / float(check.reference) - 1
        text = "< 0.01 %" if abs(difference) < 1e-4 else f"{100 * difference:+.2f} %"
        rows.append(
            [
                check.quantity,
                check.reference,
                check.source,
                digits(check.value, check.shown),
                text,
            ]
        )
    table = markdown_table(
        ["quantity", "reference value", "source", "this code", "difference"], rows
    )
    return table.replace("| --- | ---: | ---: |", "| --- | ---: | --- |")


def _geometry_checks() -> Iterator[Check]:
    yield Check("mean motion at 514 km [rad/s]", "1.10341e-3", "√(μ/a³)", MEAN_MOTION, 6)
    rate = abs(LI2009["space_initial"]["along_track_rate_m_s"][0])
    state = space_circular(LI2009["limits"]["z0_m"], 0.0, mean_motion=MEAN_MOTION)
    yield Check("along-track rate, 605.6 m offset [m/s]", f"{rate}", "Li 2009", -state[4], 5)
    critical = float(scene_critical_baseline(SCENE, paper_radar(3)).min())
    printed = str(LI2009["limits"]["critical_baseline_m"])
    yield Check("critical baseline [m]", printed, "Li 2009", critical, 5)
    for held, key, source in [
        (HeldConstant.DOPPLER, "constant_doppler", "brute force: a target moved"),
        (HeldConstant.AZIMUTH, "constant_azimuth", "eqs (1), (2) differentiated by hand"),
    ]:
        yield Check(
            f"path per height at constant {held} [m/m]",
            digits(MODEL["height_sensitivity"][key], 5),
            source,
            published_sensitivity(held),
            5,
        )
    yield from _tandem_x_checks()


def _tandem_x_checks() -> Iterator[Check]:
    case, source = MODEL["tandem_x_like"], "spherical triangle, by hand"
    scene = Scene.broadside_strip(
        times=[0.0],
        look_angle=math.radians(case["look_deg"]),
        altitude=case["altitude_km"] * 1e3,
        earth_radius=case["earth_radius_km"] * 1e3,
    )
    geometry = {
        "wavelength": case["wavelength_m"],
        "slant_range": scene.slant_range[0],
        "incidence": scene.incidence[0],
    }
    resolution = 299_792_458.0 / (2e6 * case["bandwidth_mhz"])
    values = [
        ("incidence at 32.057° look [°]", "incidence_deg", math.degrees(scene.incidence[0])),
        ("slant range [km]", "slant_range_km", scene.slant_range[0] / 1e3),
        (
            "height of ambiguity at 250 m [m]",
            "height_of_ambiguity_m",
            height_of_ambiguity(case["perpendicular_baseline_m"], **geometry),
        ),
        (
            "critical baseline at 150 MHz [m]",
            "critical_baseline_m",
            critical_baseline(**geometry, slant_range_resolution=resolution),
        ),
    ]
    for name, key, value in values:
        yield Check(f"TanDEM-X-like: {name}", str(case[key]), source, float(value), 5)


def _information_checks() -> Iterator[Check]:
    case = MODEL["three_images"]
    labels = ("three images, joint [m]", "three independent pairs [m]", "longest pair alone [m]")
    keys = ("joint_m", "independent_pairs_m", "longest_pair_m")
    for label, key, value in zip(labels, keys, three_image_errors(), strict=True):
        yield Check(label, str(case[key]), "2L(Γ∘Γ⁻¹ − I), by hand", value, 5)
    for decibel, reference in [(10, "0.9091"), (5, "0.7597")]:
        snr = 10 ** (decibel / 10)
        value = float(snr_coherence(snr, snr))
        yield Check(f"coherence at {decibel} dB", reference, "1/(1 + 1/SNR)", value)
    for gamma, looks, reference in [(0.7, 4, "0.3607"), (0.8, 16, "0.1326")]:
        value = math.sqrt(pair_phase_variance(gamma, looks=looks))
        yield Check(f"phase noise, γ = {gamma}, L = {looks} [rad]", reference, "Cramér-Rao", value)
    optimum = two_image_optimum(filtered=True)
    yield Check("two images: best B⊥/B_crit, filtered", "0.6667", "2/3, closed form", optimum)
    optimum = two_image_optimum(filtered=False)
    yield Check("two images: best B⊥/B_crit, unfiltered", "0.42", "by hand, 10 dB", optimum, 2)
    for ratio, key in [(4.0, "0.9889"), (6.0, "0.9149")]:
        value = two_baseline_probability(short_std=0.3, long_std=0.3, covariance=0.0, ratio=ratio)
        yield Check(f"unwrapping, 0.3 rad, ratio {ratio:.0f}", key, "erf(π/√2σ)", float(value))


def _coherence_checks() -> Iterator[Check]:
    for bits, distortion in [(1, "0.3634"), (2, "0.1175"), (3, "0.03454"), (4, "0.009497")]:
        value = quantization_distortion(bits)
        yield Check(
            f"quantization distortion, bits: {bits}", distortion, "Max 1960, Table I", value
        )
    for bits, reference in [(2, "0.8825"), (3, "0.9655"), (4, "0.9905")]:
        value = float(quantization_coherence(bits))
        yield Check(f"coherence left, bits: {bits}", reference, "1 − Max's distortion", value)
    value = float(ambiguity_coherence(rasr=0.01, aasr=0.01))
    yield Check("ambiguities, RASR = AASR = −20 dB", "0.9803", "1/1.01²", value)
    value = float(coregistration_coherence(0.1))
    yield Check("co-registration by 0.1 cell", "0.9836", "sinc 0.1", value)
    kz = 2.0 * math.pi / 80.0
    factor = UniformVolume(height=20.0).coherence(kz, incidence=0.5)
    yield Check("20 m of volume, HoA 80 m", "0.9003", "sinc 1/4", float(np.abs(factor)))
    yield Check("its height bias [m]", "10", "the middle", float(np.angle(factor)) / kz)
    factor = PenetratedVolume(depth=5.0).coherence(kz, incidence=0.5)
    reference = "1/√(1 + (kz d)²), d = 5 m"
    yield Check("exponential, HoA 80 m", "0.9308", reference, float(np.abs(factor)))
    shift = doppler_offset(1201.0, wavelength=0.031, slant_range=557.58e3, azimuth_resolution=3.0)
    yield Check("azimuth bands, 1201 m along track", "0.7916", "1 − Bρ/λr", 1.0 - float(shift))
    speed = {"speed": 7605.0, "look_angle": math.radians(32.057), "incidence": math.radians(35.0)}
    value = float(azimuth_resolution(2765.0, **speed))
    yield Check(
        "azimuth resolution of 2765 Hz, 35° [m]", "2.542", "7605 · 0.92539 · 0.99868/2765", value
    )


def _li2009_checks() -> Iterator[Check]:
    for case, label in zip(CASES, CASE_LABELS, strict=True):
        got = preset_errors(case)
        for key, printed in printed_errors(case).items():
            yield Check(f"{label}: {key} [m]", printed, "Li 2009", got[key])


class _Reach(NamedTuple):
    """What a formation on the paper's orbits can do in each segment, from its geometry alone.

    Attributes
    ----------
    longest : (S,) — longest perpendicular baseline of two satellites [m].
    lever : (S,) — dh/dθ [m/rad].
    range_variance : (S,) — of the height, by the range error [m²].
    """

    longest: np.ndarray
    lever: np.ndarray
    range_variance: np.ndarray


def _reach(family: str, sign: int = 1) -> _Reach:
    """Derive it from R = z0 cos nt + (ż0/n) sin nt, T = 2R', N = kR with |(z0, ż0/n)| ≤ 605.6 m."""
    k = sign * {"space": math.sqrt(3.0), "ground": 2.0}[family]
    theta, gamma, phase = SCENE.look_angle, SCENE.azimuth, MEAN_MOTION * SCENE.times
    in_phase = np.sin(theta) + k * np.sin(gamma) * np.cos(theta)
    quadrature = 2.0 * np.cos(gamma) * np.cos(theta)
    cosine = in_phase * np.cos(phase) - quadrature * np.sin(phase)
    sine = in_phase * np.sin(phase) + quadrature * np.cos(phase)
    return _Reach(
        longest=2.0 * LI2009["limits"]["z0_m"] * np.hypot(cosine, sine),
        lever=SCENE.slant_range * np.sin(theta),
        range_variance=(np.cos(theta) * LI2009["table1"]["range_error_m"]) ** 2,
    )


def _closed_form_bound(family: str, count: int, phase_std: float) -> float:
    """Height error that no formation without decorrelation can beat [m].

    The scatter of N points within ±b/2 on a line is at most (b/2)²(N² − [N odd])/N, and N(N−1)/2
    independent pairs with satellite errors σ_p see it with the variance (λσ_φ/2π)²/N + σ_p².
    """
    reach, table = _reach(family), LI2009["table1"]
    path = table["wavelength_m"] * phase_std / (2.0 * math.pi)
    variance = path**2 / count + table["position_error_m"] ** 2
    scatter = (reach.longest / 2.0) ** 2 * (count**2 - count % 2) / count
    squared = reach.lever**2 * variance / scatter + reach.range_variance
    return math.sqrt(float(squared.mean()))


def _exhaustive_bound(family: str, weighting: Weighting, *, sign: int = 1) -> float:
    """Least error of three satellites if each segment could have its own best baselines [m].

    Tries the projected baselines of the second and third satellite on a grid, with explicit 2 × 2
    covariances; the critical baseline is 2422 m and the azimuth error, which can only hurt, is
    left out.
    """
    reach, table = _reach(family, sign), LI2009["table1"]
    wavenumber = 2.0 * math.pi / table["wavelength_m"]
    shared = (wavenumber * table["position_error_m"]) ** 2
    last = reach.longest * np.linspace(0.2, 1.0, 321)[:, None, None]
    first = last * np.linspace(0.005, 0.5, 200)[:, None]  # the mirror image tells the same
    at_zero = 1.0 / (1.0 + 10 ** (-table["snr_db"] / 10))
    gamma = [at_zero * np.maximum(0.0, 1.0 - b / 2422.0) for b in (first, last, last - first)]
    if weighting is Weighting.PAIRS:
        weight = [2.0 * g**2 / (1.0 - g**2) for g in gamma]
    else:  # −2L Γ∘Γ⁻¹ off the diagonal, the 3 × 3 inverse written out
        one, two, three = gamma
        determinant = 1.0 + 2.0 * one * two * three - one**2 - two**2 - three**2
        cofactors = (two * three - one, one * three - two, one * two - three)
        weight = [-2.0 * g * c / determinant for g, c in zip(gamma, cofactors, strict=True)]
    # Noise of the second and third phase against the first, then the shared errors on top.
    a, b, c = weight[0] + weight[2], weight[1] + weight[2], weight[2]
    noise = np.maximum(a * b - c * c, 1e-12)
    one, two, both = b / noise + 2.0 * shared, a / noise + 2.0 * shared, c / noise + shared
    quadratic = two * first**2 + one * last**2 - 2.0 * both * first * last
    information = (wavenumber / reach.lever) ** 2 * quadratic / (one * two - both**2)
    squared = 1.0 / information.max(axis=(0, 1)) + reach.range_variance
    return math.sqrt(float(squared.mean()))


def _optimum_checks() -> Iterator[Check]:
    quiet = dataclasses.replace(SHARED, phase_std=0.316)
    for (family, count), reference in DUMBBELL.items():
        value = float(paper_optimum(family, quiet, count=count).height_error.region)
        label = f"dumbbell, {family}, N = {count} [m]"
        yield Check(label, f"{reference:.6f}", "convex bound, met", value)
        bound = f"{_closed_form_bound(family, count, 0.316):.4f}"
        yield Check(label, bound, "lower bound, closed form", value)
    ladders = [(family, weighting, 1) for weighting in Weighting for family in FAMILIES]
    for family, weighting, sign in [*ladders, ("ground", Weighting.JOINT, -1)]:
        errors = dataclasses.replace(
            SHARED,
            phase_std=None,
            phase_statistics=PhaseStatistics.CRAMER_RAO,
            weighting=weighting,
            baseline_decorrelation=BaselineDecorrelation.UNFILTERED,
        )
        best = paper_optimum(family, errors, level=True, sign=sign)
        mirrored = ", mirrored" if sign < 0 else ""
        yield Check(
            f"ladder, {family}, {weighting}{mirrored} [m]",
            f"{_exhaustive_bound(family, weighting, sign=sign):.4f}",
            "lower bound, exhaustive",
            float(best.height_error.region),
        )


def _realistic_checks() -> Iterator[Check]:
    radius = 6_378_137.0
    scene = Scene.broadside_strip(
        times=np.linspace(0.0, 10.0, 10),
        look_angle=math.radians(23),
        altitude=514e3,
        earth_radius=radius,
    )
    radar = dataclasses.replace(paper_radar(3), looks=16.0)
    limit = float(scene_critical_baseline(scene, radar).min()) / 2
    problem = Problem(
        mean_motion=MEAN_MOTION,
        scene=scene,
        radar=radar,
        errors=ErrorBudget(
            position=ErrorSource(0.001, SharedBy.SATELLITE),
            azimuth=ErrorSource(1.0 / float(scene.slant_range.mean()), SharedBy.ALL),
            range=ErrorSource(0.01, SharedBy.ALL),
            phase_statistics=PhaseStatistics.CRAMER_RAO,  # the reference's
        ),
        constraints=Constraints(
            max_radius=limit,
            min_separation=100.0,
            min_unwrapping_probability=0.99,
            prior_height_std=4.0,
        ),
    )
    space = DesignSpace(
        names=("S1", "S2", "S3"),
        family=ground_track_circular,
        mean_motion=MEAN_MOTION,
        max_offset=limit / 2,
        max_rate=limit / 2 * MEAN_MOTION,
        signs=(1, -1),
    )
    best = best_of(problem, space, GeneticSettings(population=40, generations=60))
    baselines = sorted(abs(float(p.perpendicular_baseline.mean())) for p in best.pairs)
    case, source = MODEL["realistic_three"], "rough optimum, by hand"
    error = best.height_error
    for name, key, value in [
        ("total [m]", "total_m", float(error.region)),
        ("relative [m]", "relative_m", float(error.relative_region)),
        ("shortest baseline [m]", "short_baseline_m", baselines[0]),
        ("longest baseline [m]", "long_baseline_m", baselines[-1]),
    ]:
        yield Check(f"three satellites, X band: {name}", str(case[key]), source, value, 3)


TABLES: dict[str, Callable[[], str]] = {
    "geometry_checks": lambda: check_table(_geometry_checks()),
    "information_checks": lambda: check_table(_information_checks()),
    "coherence_checks": lambda: check_table(_coherence_checks()),
    "li2009_checks": lambda: check_table(_li2009_checks()),
    "optimum_checks": lambda: check_table(_optimum_checks()),
    "realistic_checks": lambda: check_table(_realistic_checks()),
}
"""Tables by the name that a page calls them."""
