"""Tables on Li 2009."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.stats import multivariate_normal

from formation import (
    Orbit,
    ground_track_circular,
    min_separation,
    orbit_radius,
    relative_positions,
    space_circular,
)
from insar import (
    BaselineDecorrelation,
    ErrorBudget,
    ErrorSource,
    HeldConstant,
    PhaseStatistics,
    Radar,
    Scene,
    SharedBy,
    Weighting,
    height_error,
    one_transmitter,
    pair_geometry,
    phase_model,
    scene_critical_baseline,
    unwrapping_ladder,
)
from insar.baselines import sensitivity
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

from .markdown import LI2009, digits, markdown_table

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
JOINT = dataclasses.replace(
    DOPPLER,
    phase_std=None,
    phase_statistics=PhaseStatistics.CRAMER_RAO,
    weighting=Weighting.JOINT,
)
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
    return best_of(problem, space, GeneticSettings(population=40, generations=40))


def best_of(problem: Problem, space: DesignSpace, genetic: GeneticSettings) -> Assessment:
    """Assessment of what a search with one seed finds."""
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


TABLES: dict[str, Callable[[], str]] = {
    "li2009_figures": li2009_figures,
    "li2009_steps": li2009_steps,
    "li2009_pairs": li2009_pairs,
    "li2009_limits": li2009_limits,
    "li2009_optima": li2009_optima,
    "li2009_unwrapping": li2009_unwrapping,
    "li2009_wrapped": li2009_wrapped,
}
"""Tables by the name that a page calls them."""
