"""The search: populations over the whole space, then local refinement of the best designs.

Refined are the best, mutually distant designs that the populations found, and then structured
designs (dumbbells and ladders), so that the result depends on the seed as little as possible.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .design_space import DesignSpace
from .genetic import GeneticSettings
from .islands import Algorithm, Generation, IslandSettings, SearchMethod, generations
from .kernel import CompiledEvaluator, compiled_evaluator
from .problem import Problem
from .progress import Candidate, Forgetful, GenerationRecord, Keeper, Step
from .refinement import refine
from .scoring import Evaluator, Scorer
from .structured import structured_designs

Array = NDArray[np.float64]

_DISTANCE = 0.3
"""Distance of designs that are refined, in parts of the box, largest coordinate: starts 5 % apart
end in the same optimum, and the evaluations of all but one are wasted (docs/performance.md)."""

_COMPILED_FROM = 1000
"""Formations of the populations from which compiled loops earn back the half second that they take
to load (docs/performance.md). Whether they are compiled already must not matter: their results
differ from those of the arrays in the last digits."""


class SearchSettings(NamedTuple):
    """Settings of `search`.

    Attributes
    ----------
    algorithm : of the populations: genetic, differential evolution or CMA-ES.
    refinements : how many of their best, mutually distant designs are refined; 0 for none.
    islands : how many populations search side by side.
    structured : how many structured designs are refined besides; 0 for none.
    """

    algorithm: Algorithm = GeneticSettings()
    refinements: int = 6
    islands: IslandSettings = IslandSettings()
    structured: int = 8


@dataclass(frozen=True, eq=False)
class SearchResult:
    """What `search` found.

    Attributes
    ----------
    design : (D,) — the best design; of the least violation if none is feasible.
    objective : its region height error [m].
    feasible : whether it keeps every limit.
    population_objective : region height error of the best that the populations found by
        themselves [m]; `inf` if none was feasible.
    refined_objective : the same after the refinement of their best, before structured designs [m].
    evaluations : formations scored.
    history : a line each generation.
    interrupted : whether the search was stopped before its end.
    settings : that it was run with.
    compiled : whether compiled loops scored the formations, instead of arrays.
    """

    design: Array
    objective: float
    feasible: bool
    population_objective: float
    refined_objective: float
    evaluations: int
    history: tuple[GenerationRecord, ...]
    interrupted: bool
    settings: SearchSettings
    compiled: bool = False

    @property
    def method(self) -> SearchMethod:
        """Algorithm of the populations."""
        return self.settings.algorithm.method

    @property
    def refined(self) -> bool:
        """Whether the best designs were refined locally: the history's last line then says so."""
        return bool(self.history) and self.history[-1].refinement


def search(
    problem: Problem,
    space: DesignSpace,
    *,
    settings: SearchSettings,
    rng: np.random.Generator,
    start: Array | None = None,
    on_generation: Callable[[GenerationRecord], None] | None = None,
    should_stop: Callable[[], bool] = lambda: False,
    keeper: Keeper | None = None,
    evaluator: Evaluator | None = None,
) -> SearchResult:
    """Search the design space for the smallest region height error within the limits.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs that are searched.
    settings : of the search.
    rng : the only source of randomness.
    start : (P0, D) — designs that join the first generation, at most the population; clipped to
        the box of the space.
    on_generation : called after each generation.
    should_stop : asked after each generation and step of the refinement; True ends the search.
    keeper : keeps every generation and every refined candidate; where it holds those of an earlier
        run with the same arguments, the search goes on after them, to the same result. None keeps
        nothing.
    evaluator : scores the designs; None: the arrays, or compiled loops where they are known for the
        problem and the search is long.

    Returns
    -------
    SearchResult — never worse than a feasible `start` within the box. Stopped by `should_stop` or
    by a KeyboardInterrupt, it is the best so far, marked `interrupted`.
    """
    if evaluator is None:
        evaluator = compiled_loops(problem, space, settings)
    scorer = Scorer(problem, space, should_stop, evaluator)
    run = _Search(scorer, on_generation, keeper or Forgetful())
    state, refined = run.restore()
    interrupted = False
    try:
        for generation in generations(
            scorer.evaluate,
            lower=-space.upper,
            upper=space.upper,
            algorithm=settings.algorithm,
            islands=settings.islands,
            rng=rng,
            start=start,
            state=state,
        ):
            run.record(generation)
            if should_stop():
                raise KeyboardInterrupt
    except KeyboardInterrupt:
        interrupted = True
    if not interrupted:
        interrupted = run.refine_best(settings, refined)
    return run.result(settings, interrupted=interrupted)


def compiled_loops(
    problem: Problem, space: DesignSpace, settings: SearchSettings
) -> CompiledEvaluator | None:
    """Return the compiled loops that a search takes if it is given no evaluator.

    Parameters
    ----------
    problem, space, settings : of the search.

    Returns
    -------
    CompiledEvaluator; None where arrays score the designs: the search is too short, or see
    `compiled_evaluator`.
    """
    algorithm = settings.algorithm
    length = algorithm.population * algorithm.generations * settings.islands.number
    return compiled_evaluator(problem, space) if length >= _COMPILED_FROM else None


@dataclass
class _Search:
    """The best design so far, and how it was reached."""

    scorer: Scorer
    on_generation: Callable[[GenerationRecord], None] | None
    keeper: Keeper
    history: list[GenerationRecord] = field(default_factory=list)
    candidates: list[Candidate] = field(default_factory=list)
    population_objective: float = math.inf
    refined_objective: float = math.inf
    _best: Candidate | None = None
    _polished: Candidate | None = None

    @property
    def best_feasible(self) -> bool:
        return self._best is not None and self._best[0] == 0.0 and math.isfinite(self._best[1])

    @property
    def best_objective(self) -> float:
        return np.inf if self._best is None else self._best[1]

    def restore(self) -> tuple[dict[str, Any] | None, list[Step]]:
        """Take over what the keeper holds; return the last generation, and the refined after it."""
        steps, state = self.keeper.restore()
        refined = []
        for step in map(Step.from_plain, steps):
            if step.record is None:
                refined.append(step)
            else:
                self._take(step)
        return state, refined

    def record(self, generation: Generation) -> None:
        evaluation = generation.evaluation
        violation, objective = evaluation.total_violation, evaluation.objectives
        order = np.lexsort((objective, violation))
        candidates = tuple(
            Candidate(float(violation[i]), float(objective[i]), generation.designs[i])
            for i in order[:5]
        )
        feasible = evaluation.feasible
        best = min(
            self.best_objective if self.best_feasible else np.inf,
            float(np.min(objective[feasible], initial=np.inf)),
        )
        record = GenerationRecord(
            generation=generation.number,
            evaluations=self.scorer.evaluations,
            best=best,
            mean=float(objective[feasible].mean()) if feasible.any() else np.nan,
            feasible_fraction=float(feasible.mean()),
        )
        step = Step(self.scorer.evaluations, candidates, record)
        self.keeper.keep(step.plain(), generation.state)
        self._take(step)

    def refine_best(self, settings: SearchSettings, refined: list[Step]) -> bool:
        """Refine the best designs and structured ones; return whether that was interrupted.

        The first are already `refined` where the search goes on after an earlier run.
        """
        known = iter(refined)
        candidates = self._distant_candidates(settings.refinements)
        interrupted = self._refine_all(candidates, known)
        self.refined_objective = self.best_objective if self.best_feasible else np.inf
        structured = self._structured(0 if interrupted else settings.structured)
        interrupted = interrupted or self._refine_all(structured, known)
        if len(candidates) + len(structured):
            self._append(
                GenerationRecord(
                    generation=self.history[-1].generation + 1,
                    evaluations=self.scorer.evaluations,
                    best=self.best_objective if self.best_feasible else np.inf,
                    mean=np.nan,
                    feasible_fraction=np.nan,
                    refinement=True,
                )
            )
        return interrupted

    def _refine_all(self, designs: Sequence[Array] | Array, known: Iterator[Step]) -> bool:
        """Refine designs, then polish a new best; return whether that was interrupted."""
        if any(self._refine(design, next(known, None)) for design in designs):
            return True
        if len(designs) == 0 or self._best is None or self._best is self._polished:
            return False
        # The cross-track sign is a choice, which no descent crosses: the best is tried with the
        # other one too.
        mirrored = self.scorer.space.mirrored(self._best[2])
        if mirrored is not None and self._refine(mirrored, next(known, None)):
            return True
        interrupted = self._refine(self._best[2], next(known, None), rough=False)
        self._polished = self._best
        return interrupted

    def _structured(self, count: int) -> Array:
        """The best dumbbells and ladders, (≤ count, D)."""
        if count == 0:
            return np.empty((0, self.scorer.space.dimension))
        return structured_designs(
            self.scorer.problem, self.scorer.space, count=count, evaluate=self.scorer.evaluate
        )

    def _refine(self, start: Array, known: Step | None, *, rough: bool = True) -> bool:
        """Refine one design, unless its outcome is known; return whether that was interrupted."""
        if known is not None:
            self._take(known)
            return False
        outcome = refine(
            self.scorer.score,
            start,
            upper=self.scorer.space.upper,
            free=2 * self.scorer.space.satellites,
            differentiate=self.scorer.differentiate,
            rough=rough,
        )
        evaluation = self.scorer.evaluate(outcome.design[None])
        violation, objective = evaluation.total_violation, evaluation.objectives
        candidate = Candidate(float(violation[0]), float(objective[0]), outcome.design)
        step = Step(self.scorer.evaluations, (candidate,))
        if not outcome.interrupted:
            self.keeper.keep(step.plain(), None)
        self._take(step)
        return outcome.interrupted

    def result(self, settings: SearchSettings, *, interrupted: bool) -> SearchResult:
        if self._best is None:  # interrupted before the first generation
            raise KeyboardInterrupt
        _, objective, design = self._best
        return SearchResult(
            design=design,
            objective=objective,
            feasible=self.best_feasible,
            population_objective=self.population_objective,
            refined_objective=self.refined_objective,
            evaluations=self.scorer.evaluations,
            history=tuple(self.history),
            interrupted=interrupted,
            settings=settings,
            compiled=isinstance(self.scorer.evaluator, CompiledEvaluator),
        )

    def _take(self, step: Step) -> None:
        """Count a step that is finished, in this run or in an earlier one."""
        self.scorer.evaluations = step.evaluations
        for candidate in step.candidates:
            if self._best is None or candidate[:2] < self._best[:2]:
                self._best = candidate
        if step.record is not None:
            self.candidates += step.candidates
            self.population_objective = step.record.best
            self._append(step.record)

    def _append(self, record: GenerationRecord) -> None:
        self.history.append(record)
        if self.on_generation is not None:
            self.on_generation(record)

    def _distant_candidates(self, count: int) -> list[Array]:
        """The best designs seen, each well away from the better ones: another basin, perhaps."""
        chosen: list[Array] = []
        for _, _, design in sorted(self.candidates, key=lambda c: c[:2]):
            if len(chosen) == count:
                break
            scaled = design / self.scorer.space.upper
            if all(
                np.max(np.abs(scaled - other / self.scorer.space.upper)) > _DISTANCE
                for other in chosen
            ):
                chosen.append(design)
        return chosen
