"""Builds what is computed with from what a study says."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Orbit, equally_spaced
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from optimize import (
    CertificateSettings,
    CovarianceSettings,
    DemRequest,
    DesignSpace,
    DifferentialSettings,
    FormationClaim,
    GeneticSettings,
    IslandSettings,
    OpenNumber,
    Problem,
    RefutationSettings,
    SearchSettings,
)
from optimize.islands import Algorithm

from .base import Block
from .domain import build_problem, build_refutation
from .flying import (
    FAMILIES,
    SIGNS,
    NamedStates,
    compared_formations,
    evaluated_formation,
    flown_formations,
    in_order,
)
from .formations import Sign
from .limits import SearchBlock
from .mission_claims import corners, with_value
from .observing import View, build_view
from .placing import NamedPositions, build_claims
from .studies import EvaluateStudy, OptimizeStudy

Array = NDArray[np.float64]


class OptimizeSetup(NamedTuple):
    """Everything that a study of kind `optimize` computes with.

    Attributes
    ----------
    problem : what is minimized, and within which limits.
    space : the designs that are searched.
    settings : of the search.
    initial_states : (N, 6) — the formation given, or satellites equally spaced on the largest
        allowed orbit.
    initial_design : (D,) — the formation given, if it lies in the searched box; else None.
    compare : formations to show beside the result.
    refutation : how they are simulated; None if they are not.
    certificate : how the result is proved; None if it is not.
    critical_baseline : the smallest over the segments [m].
    dem : what is asked of the elevation model.
    orbit : the reference orbit.
    observation : where the scene comes from; None if the study gives it.
    """

    problem: Problem
    space: DesignSpace
    settings: SearchSettings
    initial_states: Array
    initial_design: Array | None
    compare: tuple[NamedStates, ...]
    refutation: RefutationSettings | None
    certificate: CertificateSettings | None
    critical_baseline: float
    dem: DemRequest
    orbit: Orbit
    observation: Observation | StaringScene | None


class EvaluateSetup(NamedTuple):
    """Everything that a study of kind `evaluate` computes with.

    Attributes
    ----------
    problem : scene, radar, errors and limits.
    names : name of each satellite.
    formation : its states; or positions, in one acquisition or several.
    compare : formations to show beside it.
    refutation : how they are simulated; None if they are not.
    critical_baseline : the smallest over the segments [m].
    dem : what is asked of the elevation model.
    orbit : the reference orbit.
    observation : where the scene comes from; None if the study gives it.
    claims : printed figures; may be empty.
    opened : what the source of the claims does not publish.
    corners : the same setup at every combination of the ends of what is open.
    """

    problem: Problem
    names: tuple[str, ...]
    formation: NamedStates | tuple[NamedPositions, ...]
    compare: tuple[NamedStates | NamedPositions, ...]
    refutation: RefutationSettings | None
    critical_baseline: float
    dem: DemRequest
    orbit: Orbit
    observation: Observation | StaringScene | None
    claims: tuple[FormationClaim, ...] = ()
    opened: tuple[OpenNumber, ...] = ()
    corners: tuple[EvaluateSetup, ...] = ()


def build_optimize(study: OptimizeStudy) -> OptimizeSetup:
    """Build what a study of kind `optimize` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If its targets are never seen, or a file that it names does not serve.
    """
    names, formation = study.formation.names, study.formation
    view = build_view(study)
    problem, critical, dem = build_problem(study, names, study.constraints, view)
    constraints, n = problem.constraints, problem.mean_motion
    amplitude = math.inf if constraints.max_radius is None else constraints.max_radius / 2.0
    offset, rate = constraints.max_offset, constraints.max_rate
    space = DesignSpace(
        names=names,
        family=FAMILIES[formation.family],
        mean_motion=n,
        max_offset=amplitude if offset is None else offset,
        max_rate=amplitude * n if rate is None else rate,
        signs=SIGNS[formation.cross_track_sign],
    )
    largest = 2.0 * min(amplitude, space.max_offset, space.max_rate / n)
    design = None
    if formation.initial is None:
        z0, zdot0 = equally_spaced(len(names), radius=largest, mean_motion=n)
        initial = space.encode(z0, zdot0)
    else:
        members = in_order(formation.initial, names)
        initial = space.encode([m.z0_m for m in members], [m.zdot0_m_s for m in members])
        design = initial if bool(np.all(np.abs(initial) <= space.upper)) else None
    sign: Sign = "negative" if formation.cross_track_sign == "negative" else "positive"
    return OptimizeSetup(
        problem=problem,
        space=space,
        settings=_settings(study.search),
        initial_states=space.states(initial),
        initial_design=design,
        compare=flown_formations(study.compare, names, problem, family=formation.family, sign=sign),
        refutation=build_refutation(study, problem),
        certificate=None
        if study.certificate is None
        else CertificateSettings(
            max_boxes=study.certificate.max_boxes,
            target=study.certificate.target_height_error_m,
        ),
        critical_baseline=critical,
        dem=dem,
        orbit=view.orbit,
        observation=view.observation,
    )


def build_evaluate(study: EvaluateStudy) -> EvaluateSetup:
    """Build what a study of kind `evaluate` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If its targets are never seen, or a file that it names does not serve.
    """
    view = build_view(study)
    setup = _build_evaluate(study, view)
    others = []
    for values in corners(study.open):
        other: Block = study
        for one, value in zip(study.open, values, strict=True):
            other = with_value(other, one.path, value)
        if isinstance(other, EvaluateStudy):
            others.append(_build_evaluate(other, view))
    opened = tuple(OpenNumber(one.key, one.least, one.most, one.why) for one in study.open)
    return setup._replace(claims=build_claims(study.claims), opened=opened, corners=tuple(others))


def _build_evaluate(study: EvaluateStudy, view: View) -> EvaluateSetup:
    names, formation = study.formation.names, study.formation
    problem, critical, dem = build_problem(study, names, study.constraints, view)
    family, sign = formation.family, formation.cross_track_sign
    return EvaluateSetup(
        problem=problem,
        names=names,
        formation=evaluated_formation(formation, names, problem),
        compare=compared_formations(study.compare, names, problem, family=family, sign=sign),
        refutation=build_refutation(study, problem),
        critical_baseline=critical,
        dem=dem,
        orbit=view.orbit,
        observation=view.observation,
    )


def _settings(block: SearchBlock) -> SearchSettings:
    algorithm: Algorithm
    if block.method == "differential_evolution":
        algorithm = DifferentialSettings(block.population, block.generations)
    elif block.method == "cma_es":
        algorithm = CovarianceSettings(block.population, block.generations)
    else:
        algorithm = GeneticSettings(
            population=block.population,
            generations=block.generations,
            crossover_probability=block.crossover_probability,
            mutation_probability=block.mutation_probability,
            crossover_eta=block.crossover_eta,
            mutation_eta=block.mutation_eta,
            tournament=block.tournament,
            elite=block.elite,
        )
    return SearchSettings(
        algorithm=algorithm,
        refinements=block.refinements,
        islands=IslandSettings(block.islands, block.migration_interval, block.restart),
        structured=block.structured_starts,
    )
