"""Recompute the tables of the documentation and write them into its pages.

Run ``python docs/generate.py`` after a change of the model; ``tests/test_docs.py`` compares the
committed pages with a fresh run. A table stands between ``<!-- generated: name -->`` and
``<!-- end -->``. Everything else on the pages is written by hand.
"""

from __future__ import annotations

import dataclasses
import math
import re
import tomllib
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar
from scipy.stats import multivariate_normal

from configs import load_study
from configs.build import SteeringSetup, build_steering
from formation import (
    Elements,
    KeplerianOrbit,
    Orbit,
    ground_track_circular,
    min_separation,
    orbit_radius,
    relative_positions,
    space_circular,
)
from formation.constants import (
    EARTH_EQUATORIAL_RADIUS,
    EARTH_GRAVITATIONAL_PARAMETER,
    EARTH_J2,
)
from formation.j2 import drifted, osculating_states
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    LookSide,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    critical_baseline,
    fisher_information,
    height_error,
    height_of_ambiguity,
    one_transmitter,
    pair_geometry,
    phase_model,
    scene_critical_baseline,
    snr_coherence,
    two_baseline_probability,
    unwrapping_ladder,
)
from insar.baselines import sensitivity
from insar.observe import (
    CaseResult,
    Compensation,
    FixedIncidence,
    Held,
    Law,
    LawCurves,
    SelectionRequest,
    SteeringCase,
    assess_case,
    compensate,
    judge,
    select,
)
from insar.observe.earth import intersect, to_geodetic
from insar.observe.look import angle_at_look, zero_doppler_plane
from insar.observe.spotlight import spotlight
from insar.observe.spotlight_results import SpotlightRequest, SpotlightResult
from insar.observe.studies.claims import largest_angle, largest_rate
from insar.phase_information import independent_pairs_information, pair_phase_variance
from optimize import (
    Assessment,
    Constraints,
    DesignSpace,
    GeneticSettings,
    Problem,
    SearchSettings,
    assess,
    search,
)

DOCS = Path(__file__).parent
_PUBLISHED = DOCS.parent / "tests" / "published"
LI2009: dict[str, Any] = tomllib.loads((_PUBLISHED / "li2009.toml").read_text(encoding="utf-8"))
MODEL: dict[str, Any] = tomllib.loads((_PUBLISHED / "error_model.toml").read_text(encoding="utf-8"))

# Least errors of the paper's problem without decorrelation, by family and number of satellites: a
# convex lower bound that is met to 1e-6 (docs/validation.md).
DUMBBELL = {
    ("space", 3): 1.117366,
    ("ground", 3): 0.996068,
    ("space", 4): 0.912008,
    ("ground", 4): 0.813011,
}
Rows = Sequence[Sequence[str]]


def markdown_table(head: Sequence[str], rows: Rows) -> str:
    """Table in Markdown, the first column left and the others right aligned."""
    align = ["---", *["---:"] * (len(head) - 1)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (head, align, *rows))


def digits(value: float, count: int) -> str:
    """Number with a fixed count of significant digits."""
    if abs(value) < 0.01:
        mantissa, exponent = f"{value:.{count - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    decimals = max(0, count - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{decimals}f}"


# -- Li 2009 -------------------------------------------------------------------------------------

FAMILIES = {"space": space_circular, "ground": ground_track_circular}
CASES = ("space_initial", "space_optimum", "ground_initial", "ground_optimum")
CASE_LABELS = ("space, initial", "space, published", "ground, initial", "ground, published")
MEAN_MOTION = Orbit.circular(altitude=514e3, inclination=math.radians(97.44)).mean_motion
SCENE = Scene.flat_earth(
    times=np.arange(1.0, 11.0),
    slant_range=1e3 * np.array(LI2009["table2"]["slant_range_km"]),
    look_angle=np.deg2rad(LI2009["table2"]["look_deg"]),
    azimuth=np.deg2rad(LI2009["table2"]["azimuth_deg"]),
)

PRESET = ErrorBudget.li2009()
PRINTED_AZIMUTH = math.radians(LI2009["table1"]["azimuth_error_deg"])
INDEPENDENT = dataclasses.replace(PRESET, azimuth=ErrorSource(PRINTED_AZIMUTH, SharedBy.PAIR))
SHARED = dataclasses.replace(PRESET, azimuth=ErrorSource(PRINTED_AZIMUTH, SharedBy.ALL))
DOPPLER = dataclasses.replace(SHARED, held_constant=HeldConstant.DOPPLER)
JOINT = dataclasses.replace(DOPPLER, phase_std=None, weighting=Weighting.JOINT)
UNFILTERED = dataclasses.replace(JOINT, baseline_decorrelation=BaselineDecorrelation.UNFILTERED)
FILTERED = dataclasses.replace(JOINT, baseline_decorrelation=BaselineDecorrelation.FILTERED)


def paper_radar(count: int) -> Radar:
    """Radar of Table 1, single look, one transmitter."""
    table = LI2009["table1"]
    return Radar(
        wavelength=table["wavelength_m"],
        slant_range_resolution=table["slant_range_resolution_m"],
        snr=10 ** (table["snr_db"] / 10),
        looks=1.0,
        images=one_transmitter(count),
    )


def paper_states(case: str) -> np.ndarray:
    """States at t = 0 of a printed formation, (3, 6)."""
    printed = LI2009[case]
    family = FAMILIES[printed["family"]]
    return family(printed["z0_m"], printed["zdot0_m_s"], mean_motion=MEAN_MOTION)


def paper_positions(case: str) -> np.ndarray:
    """Positions of a printed formation at the times of Table 2, (10, 3, 3)."""
    return relative_positions(paper_states(case), SCENE.times, mean_motion=MEAN_MOTION)


def printed_errors(case: str) -> dict[str, str]:
    """Errors that the paper prints of a formation, with its digits."""
    decimals = 1 if case == "space_initial" else 2
    return {key: f"{value:.{decimals}f}" for key, value in LI2009[case]["error_m"].items()}


def preset_errors(case: str) -> dict[str, float]:
    """The same errors by the preset."""
    error = height_error(paper_positions(case), SCENE, radar=paper_radar(3), errors=PRESET)
    values = {"rms": error.region, "min": error.total.min(), "max": error.total.max()}
    return {key: float(value) for key, value in values.items()}


def region_errors(errors: ErrorBudget) -> list[float]:
    """Region error of the four printed formations, in the order of `CASES`."""
    radar = paper_radar(3)
    return [
        float(height_error(paper_positions(case), SCENE, radar=radar, errors=errors).region)
        for case in CASES
    ]


@cache
def paper_optimum(
    family: str, errors: ErrorBudget, *, count: int = 3, level: bool = False, sign: int = 1
) -> Assessment:
    """Best formation within the paper's radius and separation, by the search.

    Parameters
    ----------
    family : ``space`` or ``ground``.
    errors : the error budget.
    count : number of satellites.
    level : whether one critical baseline, 2422 m, holds in every segment.
    sign : of the cross-track motion.
    """
    scene = _level_scene() if level else SCENE
    problem = Problem(
        mean_motion=MEAN_MOTION,
        scene=scene,
        radar=paper_radar(count),
        errors=errors,
        constraints=Constraints(
            max_radius=LI2009["limits"]["radius_m"], min_separation=100.0, prior_height_std=2.0
        ),
    )
    offset = LI2009["limits"]["z0_m"]
    space = DesignSpace(
        names=tuple(f"S{i + 1}" for i in range(count)),
        family=FAMILIES[family],
        mean_motion=MEAN_MOTION,
        max_offset=offset,
        max_rate=offset * MEAN_MOTION,
        signs=(sign,),
    )
    return _best(problem, space, GeneticSettings(population=40, generations=40))


def _best(problem: Problem, space: DesignSpace, genetic: GeneticSettings) -> Assessment:
    found = search(problem, space, settings=SearchSettings(genetic), rng=np.random.default_rng(1))
    return assess(problem, space.states(found.design), label="best", names=space.names)


def _level_scene() -> Scene:
    """Table 2 with slopes (0.4° at most) that give 2422 m of critical baseline everywhere."""
    radar = paper_radar(3)
    tangent = 2422.0 * radar.slant_range_resolution / (radar.wavelength * SCENE.slant_range)
    return dataclasses.replace(SCENE, slope=SCENE.incidence - np.arctan(tangent))


def li2009_figures() -> str:
    """The twelve printed figures and what the preset gives."""
    rows = []
    for case, label in zip(CASES, CASE_LABELS, strict=True):
        printed, got = printed_errors(case), preset_errors(case)
        worst = max(abs(got[key] / float(text) - 1) for key, text in printed.items())
        shown = {key: digits(value, 4) for key, value in got.items()}
        cells = ["{rms} ({min}–{max})".format(**values) for values in (printed, shown)]
        rows.append([label, *cells, f"{100 * worst:.1f} %"])
    head = ["formation", "printed RMS (min–max) [m]", "this code [m]", "largest difference"]
    return markdown_table(head, rows)


def li2009_steps() -> str:
    """The region error as the paper's assumptions are replaced one after the other."""
    steps = [
        ("preset `li2009`", PRESET),
        ("1. azimuth error 0.01°, as printed", INDEPENDENT),
        ("2. one azimuth error, shared by all images", SHARED),
        ("3. sensitivity at constant range and Doppler", DOPPLER),
        ("4. joint Cramér-Rao information, one look", JOINT),
        ("5a. decorrelation, filtered", FILTERED),
        ("5b. decorrelation, unfiltered (instead of 5a)", UNFILTERED),
    ]
    rows = [[label, *(digits(v, 4) for v in region_errors(errors))] for label, errors in steps]
    return markdown_table(["model, changes cumulative", *CASE_LABELS], rows)


def li2009_pairs() -> str:
    """Baselines of each pair, and what the preset's azimuth error alone does to its height."""
    radar, rows = paper_radar(3), []
    for case, label in zip(CASES, CASE_LABELS, strict=True):
        pairs = pair_geometry(
            paper_positions(case), SCENE, radar=radar, held_constant=HeldConstant.AZIMUTH
        )
        height, azimuth = np.abs(pairs.perpendicular_baseline), np.abs(pairs.azimuth_baseline)
        lever = sensitivity(SCENE, HeldConstant.AZIMUTH).height_lever[:, None]
        error = PRESET.azimuth.std * azimuth / height * lever
        cells = [
            " / ".join(f"{value:.{decimals}f}" for value in column.mean(axis=0))
            for column, decimals in ((height, 0), (azimuth, 0), (error, 1))
        ]
        rows.append([label, *cells])
    head = ["pairs 1-2 / 1-3 / 2-3", "baseline, height [m]", "baseline, azimuth [m]", "error [m]"]
    return markdown_table(head, rows)


def li2009_limits() -> str:
    """What the published optima do to the paper's limits."""
    radar, limits = paper_radar(3), LI2009["limits"]
    critical = scene_critical_baseline(SCENE, radar)[:, None]
    coherent_only = dataclasses.replace(
        PRESET, baseline_decorrelation=BaselineDecorrelation.FILTERED
    )
    coherent_errors = dict(zip(CASES, region_errors(coherent_only), strict=True))
    preset = dict(zip(CASES, region_errors(PRESET), strict=True))
    columns = []
    for case in ("space_optimum", "ground_optimum"):
        states = paper_states(case)
        radius = orbit_radius(states[:, 0], states[:, 3], mean_motion=MEAN_MOTION)
        cells = [
            " / ".join(f"{r:.0f}" for r in radius),
            f"{np.abs(states[:, 0]).max():.1f}",
            f"{np.abs(states[:, 3]).max():.3f}",
            f"{min_separation(states, mean_motion=MEAN_MOTION).min():.0f}",
        ]
        for held in (HeldConstant.AZIMUTH, HeldConstant.DOPPLER):
            pairs = pair_geometry(paper_positions(case), SCENE, radar=radar, held_constant=held)
            share = np.abs(pairs.perpendicular_baseline) / critical
            cells.append(" / ".join(f"{s:.2f}" for s in share.max(axis=0)))
        cells += [digits(error[case], 3) for error in (preset, coherent_errors)]
        columns.append(cells)
    names = [
        ("radius of each satellite [m]", f"≤ {limits['radius_m']}"),
        ("largest offset, radial [m]", f"≤ {limits['z0_m']}"),
        ("largest rate, radial [m/s]", f"≤ {limits['zdot0_m_s']}"),
        ("closest approach [m]", "≥ 100"),
        ("pairs 1-2 / 1-3 / 2-3 over critical, paper's form", "< 1"),
        ("the same at constant Doppler", "< 1"),
        ("height error, preset `li2009` [m]", ""),
        ("the same without the pairs that cannot cohere [m]", ""),
    ]
    rows = [
        [name, limit, space, ground]
        for (name, limit), space, ground in zip(names, *columns, strict=True)
    ]
    return markdown_table(["quantity", "limit", "space, published", "ground, published"], rows)


def li2009_optima() -> str:
    """Initial, published and best formation under four models."""
    models = [
        ("preset `li2009`", PRESET),
        ("shared errors (step 2)", SHARED),
        ("filtered decorrelation (step 5a)", FILTERED),
        ("unfiltered decorrelation (step 5b)", UNFILTERED),
    ]
    rows = []
    for label, errors in models:
        given = region_errors(errors)
        cells = [label]
        for index, family in enumerate(FAMILIES):
            best = float(paper_optimum(family, errors).height_error.region)
            values = [*given[2 * index : 2 * index + 2], best]
            cells += [digits(value, 3) for value in values]
        rows.append(cells)
    kinds = ("initial", "published", "best")
    head = ["model", *(f"{family}, {kind}" for family in FAMILIES for kind in kinds)]
    return markdown_table(head, rows)


def li2009_unwrapping() -> str:
    """Whether the phase of the best formations can be unwrapped."""
    rows = []
    for name, errors in [
        ("shared errors", SHARED),
        ("filtered", FILTERED),
        ("unfiltered", UNFILTERED),
    ]:
        for family in FAMILIES:
            best = paper_optimum(family, errors)
            baselines = sorted(abs(float(p.perpendicular_baseline.mean())) for p in best.pairs)
            model = phase_model(best.scene_positions, SCENE, radar=paper_radar(3), errors=errors)
            shown = " / ".join(f"{baseline / 1e3:.1f}" for baseline in baselines)
            rows.append([f"{family}, {name}", shown])
            for prior in (1.0, 2.0, 4.0):
                ladder = unwrapping_ladder(model, prior_height_std=prior)
                rows[-1].append(digits(float(ladder.probability.min()), 1))
    head = [
        "best formation",
        "baselines of the pairs [km]",
        "prior 1 m",
        "prior 2 m",
        "prior 4 m",
    ]
    return markdown_table(head, rows)


def li2009_wrapped() -> str:
    """Maximum likelihood on wrapped phases, against the prediction and against guessing."""
    best = paper_optimum("ground", UNFILTERED)
    model = phase_model(best.scene_positions, SCENE, radar=paper_radar(3), errors=UNFILTERED)
    segment = 5
    order = np.argsort(model.vertical_wavenumber[segment])
    lower, middle, upper = order
    to_middle = np.zeros((2, 3))
    to_middle[0, [lower, middle]], to_middle[1, [middle, upper]] = (-1, 1), (-1, 1)
    reference = np.concatenate([-np.ones((2, 1)), np.eye(2)], axis=1)
    factor = model.nuisance["position"][segment]
    noise = np.linalg.inv(model.information[segment][1:, 1:])
    covariance = noise + reference @ factor @ factor.T @ reference.T
    step = to_middle @ np.linalg.pinv(reference)
    covariance = step @ covariance @ step.T
    kz = (to_middle @ model.vertical_wavenumber[segment]).mean()  # two steps of equal length
    ambiguity = 2 * np.pi / kz

    # The likelihood of the two wrapped phases on a grid; a height shifts it along the diagonal.
    count = 72
    axis = 2 * np.pi * np.arange(count) / count
    turns = 2 * np.pi * np.arange(-4, 5)
    fine = (axis[:, None] + turns).ravel()
    density = multivariate_normal(cov=covariance).pdf(np.stack(np.meshgrid(fine, fine), axis=-1))
    density = density.reshape(count, 9, count, 9).sum(axis=(1, 3))
    density /= density.sum()
    shifted = np.stack([np.roll(density, (s, s), axis=(0, 1)) for s in range(count)])
    offset = np.argmax(shifted, axis=0) / count
    error = ambiguity * ((offset + 0.5) % 1.0 - 0.5)
    likeliest = math.sqrt(float(np.sum(density * error**2)))
    predicted = float(best.height_error.total[segment])
    rows = [
        ["predicted by the error model", digits(predicted, 3)],
        ["maximum likelihood, within the right ambiguity", digits(likeliest, 3)],
        ["guessing, within the right ambiguity", digits(ambiguity / math.sqrt(12), 3)],
    ]
    return markdown_table(["height error [m]", f"segment {segment + 1}"], rows)


# -- the error model -----------------------------------------------------------------------------


def _published_sensitivity(held: HeldConstant) -> float:
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
    values = [_published_sensitivity(one) for one in held]
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


def _two_image_optimum(*, filtered: bool) -> float:
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


def _three_images() -> tuple[float, float, float]:
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
    joint, pairs, longest = (digits(value, 4) for value in _three_images())
    rows = [
        ["joint Fisher information of three images", joint],
        ["three pairs counted as independent", pairs],
        ["longest pair alone", longest],
    ]
    return markdown_table(["information", "height error [m]"], rows)


# -- validation ----------------------------------------------------------------------------------


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
            _published_sensitivity(held),
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
    for label, key, value in zip(labels, keys, _three_images(), strict=True):
        yield Check(label, str(case[key]), "2L(Γ∘Γ⁻¹ − I), by hand", value, 5)
    for decibel, reference in [(10, "0.9091"), (5, "0.7597")]:
        snr = 10 ** (decibel / 10)
        value = float(snr_coherence(snr, snr))
        yield Check(f"coherence at {decibel} dB", reference, "1/(1 + 1/SNR)", value)
    for gamma, looks, reference in [(0.7, 4, "0.3607"), (0.8, 16, "0.1326")]:
        value = math.sqrt(pair_phase_variance(gamma, looks=looks))
        yield Check(f"phase noise, γ = {gamma}, L = {looks} [rad]", reference, "Cramér-Rao", value)
    optimum = _two_image_optimum(filtered=True)
    yield Check("two images: best B⊥/B_crit, filtered", "0.6667", "2/3, closed form", optimum)
    optimum = _two_image_optimum(filtered=False)
    yield Check("two images: best B⊥/B_crit, unfiltered", "0.42", "by hand, 10 dB", optimum, 2)
    for ratio, key in [(4.0, "0.9889"), (6.0, "0.9149")]:
        value = two_baseline_probability(short_std=0.3, long_std=0.3, covariance=0.0, ratio=ratio)
        yield Check(f"unwrapping, 0.3 rad, ratio {ratio:.0f}", key, "erf(π/√2σ)", float(value))


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
    best = _best(problem, space, GeneticSettings(population=40, generations=60))
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


# -- steering ------------------------------------------------------------------------------------

# Altitude [m], inclination [deg], eccentricity, incidence [deg], J2: Zhao 2019 Table 1, TerraSAR-X.
STEERED_ORBITS = {
    "LEO": (514e3, 97.42, 0.003, 45.0, False),
    "MEO": (12_000e3, 40.0, 0.003, 45.0, False),
    "GEO": (35_792e3, 30.0, 0.003, 45.0, False),
    "TerraSAR-X": (514.8e3, 97.44, 0.00118, 35.0, False),
    "TerraSAR-X, J2": (514.8e3, 97.44, 0.00118, 35.0, True),
}


def steered(name: str) -> CaseResult:
    """Every law over one revolution of an orbit, right-looking at 0.031 m."""
    altitude, inclination, eccentricity, incidence, j2 = STEERED_ORBITS[name]
    axis = EARTH_EQUATORIAL_RADIUS + altitude
    elements = Elements(axis, eccentricity, math.radians(inclination), 0.0, math.pi / 2, 0.0)
    epoch = datetime(2020, 1, 1, tzinfo=UTC)
    period = 2.0 * math.pi * math.sqrt(axis**3 / EARTH_GRAVITATIONAL_PARAMETER)
    return assess_case(
        SteeringCase(
            name=name,
            trajectory=KeplerianOrbit(elements=elements, epoch=epoch, j2=j2),
            times=np.linspace(0.0, period, 1441),
            wavelength=0.031,
            side=LookSide.RIGHT,
            boresight=FixedIncidence(math.radians(incidence)),
            laws=tuple(Law),
            swath_offsets=np.deg2rad([-0.5, 0.5]),
        )
    )


def steering_laws() -> str:
    """Largest angles, rates and Doppler of each law on each orbit."""
    rows = []
    for name in STEERED_ORBITS:
        for curves in steered(name).curves:
            angles = np.rad2deg([curves.yaw, curves.pitch, curves.roll])
            rate = np.rad2deg(np.linalg.norm(curves.rate_orbit, axis=-1))
            doppler = (curves.residual_doppler, curves.swath_doppler)
            rows.append(
                [
                    f"{name}, {curves.law.value}",
                    *(f"{np.max(np.abs(angle)):.2f}" for angle in angles),
                    f"{np.max(rate):.4f}",
                    *(f"{np.max(np.abs(f)):.0f}" for f in doppler),
                ]
            )
    head = ["", "yaw [°]", "pitch [°]", "roll [°]", "rate [°/s]", "boresight [Hz]", "±0.5° [Hz]"]
    return markdown_table(head, rows)


# -- orbits --------------------------------------------------------------------------------------


def _flattened(_: float, state: np.ndarray) -> np.ndarray:
    """Rate of a state in the field of a flattened Earth."""
    position = state[:3]
    radius = float(np.linalg.norm(position))
    flattening = 1.5 * EARTH_J2 * (EARTH_EQUATORIAL_RADIUS / radius) ** 2
    factors = 1.0 - flattening * (5.0 * (position[2] / radius) ** 2 - np.array([1.0, 1.0, 3.0]))
    pull = -EARTH_GRAVITATIONAL_PARAMETER / radius**3 * position * factors
    return np.concatenate([state[3:], pull])


def _theory_error(eccentricity: float, inclination: float, duration: float) -> float:
    """Largest distance of the theory from the integrated orbit [m]."""
    axis = (EARTH_EQUATORIAL_RADIUS + 600e3) / (1.0 - eccentricity)
    mean = Elements(axis, eccentricity, math.radians(inclination), 1.0, 0.7, 0.4)
    times = np.linspace(0.0, duration, 1000)
    start = np.concatenate(osculating_states(mean))
    integrated = solve_ivp(
        _flattened, (0.0, duration), start, "DOP853", times, rtol=1e-12, atol=1e-6
    ).y[:3]
    theory = osculating_states(drifted(mean, times)).position
    return float(np.linalg.norm(theory - integrated.T, axis=-1).max())


def mean_elements() -> str:
    """Mean elements with secular drift against numerical integration."""
    inclinations = (90.0, 97.44, 63.43, 5.0)
    rows = [
        [
            f"e = {eccentricity:g}",
            *(
                " / ".join(
                    f"{_theory_error(eccentricity, inclination, duration):.0f}"
                    for duration in (6000.0, 86_400.0)
                )
                for inclination in inclinations
            ),
        ]
        for eccentricity in (0.0, 0.001, 0.1, 0.3)
    ]
    head = ["6000 s / 1 day [m]", *(f"i = {inclination:g}°" for inclination in inclinations)]
    return markdown_table(head, rows)


# -- Zhao 2019 and Meng 2003 ---------------------------------------------------------------------


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


# -- spotlight -----------------------------------------------------------------------------------

HAN2016: dict[str, Any] = tomllib.loads((_PUBLISHED / "han2016.toml").read_text(encoding="utf-8"))


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


TABLES: dict[str, Callable[[], str]] = {
    "sensitivity": sensitivity_example,
    "filtering": filtering,
    "three_images": three_images,
    "li2009_figures": li2009_figures,
    "li2009_steps": li2009_steps,
    "li2009_pairs": li2009_pairs,
    "li2009_limits": li2009_limits,
    "li2009_optima": li2009_optima,
    "li2009_unwrapping": li2009_unwrapping,
    "li2009_wrapped": li2009_wrapped,
    "geometry_checks": lambda: check_table(_geometry_checks()),
    "information_checks": lambda: check_table(_information_checks()),
    "li2009_checks": lambda: check_table(_li2009_checks()),
    "optimum_checks": lambda: check_table(_optimum_checks()),
    "realistic_checks": lambda: check_table(_realistic_checks()),
    "steering_laws": steering_laws,
    "zhao2019_verdicts": lambda: verdicts("zhao2019_geosar"),
    "zhao2019_incidences": zhao2019_incidences,
    "zhao2019_price": zhao2019_price,
    "zhao2019_crossovers": zhao2019_crossovers,
    "meng2003_verdicts": lambda: verdicts("meng2003_yaw"),
    "meng2003_effects": meng2003_effects,
    "meng2003_sweep": meng2003_sweep,
    "mean_elements": mean_elements,
    "han2016_figures": han2016_figures,
    "han2016_aim": han2016_aim,
}

_BLOCK = re.compile(r"(<!-- generated: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def regenerate(text: str) -> str:
    """Replace every generated block of a page.

    Parameters
    ----------
    text : a page in Markdown.

    Raises
    ------
    KeyError
        If a block has a name that `TABLES` lacks.
    """
    return _BLOCK.sub(lambda found: f"{found[1]}{TABLES[found[2]]()}\n{found[3]}", text)


def pages() -> list[Path]:
    """Pages that hold a generated block."""
    return [page for page in sorted(DOCS.glob("*.md")) if _BLOCK.search(page.read_text("utf-8"))]


def main() -> None:
    """Rewrite the pages."""
    for page in pages():
        page.write_text(regenerate(page.read_text("utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
