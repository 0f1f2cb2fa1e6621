"""Scores designs in compiled loops where numba is installed and the problem is one they know."""

from __future__ import annotations

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from ..constraints import FEASIBILITY_TOLERANCE
from ..design_space import DesignSpace
from ..problem import Evaluation, Problem
from .constants import by_address, constants
from .rooms import Space, rooms
from .support import supported

Array = NDArray[np.float64]

_PARALLEL_FROM = 512
"""Designs from which a second thread takes less time than it costs to wake it."""

_SAME = 1e-6
"""Difference of the two forms that is rounding, not another model."""


class CompiledEvaluator:
    """`Problem.evaluate` of a space's designs, in compiled loops.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    compiled : the module of the loops.
    """

    def __init__(self, problem: Problem, space: DesignSpace, compiled: ModuleType) -> None:
        self._compiled = compiled
        self._constants = constants(problem, space)  # holds what the addresses point to
        self._record = by_address(self._constants)
        self._limits = len(problem.limits)
        probe = problem.population(space.states(np.zeros((1, space.dimension))))
        self._items = sum(limit.margins(probe).shape[-1] for limit in problem.limits)
        self._spaces = threading.local()

    def evaluate(self, designs: Array) -> Evaluation:
        """Score designs.

        Parameters
        ----------
        designs : (P, D) — design vectors.

        Returns
        -------
        Evaluation — that of `Problem.evaluate` up to rounding, for any number of threads the same.
        """
        objectives, worst, _ = self._score(designs, items=0)
        return Evaluation(objectives, np.where(worst < -FEASIBILITY_TOLERANCE, -worst, 0.0))

    def objectives_and_margins(self, designs: Array) -> tuple[Array, Array]:
        """Score designs, with the margin of every single limited item.

        Parameters
        ----------
        designs : (P, D) — design vectors.

        Returns
        -------
        (P,) and (P, items) — as `Problem.objectives_and_margins` has them, all limits in a row.
        """
        objectives, _, items = self._score(designs, items=self._items)
        return objectives, items

    def _score(self, designs: Array, *, items: int) -> tuple[Array, Array, Array]:
        vectors = np.ascontiguousarray(designs, dtype=np.float64)
        count = len(vectors)
        objectives = np.empty(count)
        worst, every = np.empty((count, self._limits)), np.empty((count, items))
        source, constants = vectors.ctypes.data, self._record.ctypes.data
        scores, margins, details = objectives.ctypes.data, worst.ctypes.data, every.ctypes.data

        def score(begin: int, end: int) -> None:
            space = self._space(items)
            self._compiled.score_range(
                source,
                begin,
                end,
                constants,
                space.address,
                scores,
                margins,
                details,
                items,
            )

        if count < _PARALLEL_FROM:
            score(0, count)
            return objectives, worst, every
        # The loops hold no lock of the interpreter. Each thread writes rows of its own.
        parts = np.linspace(0, count, _threads() + 1).astype(int).tolist()
        for done in [_pool().submit(score, begin, end) for begin, end in pairwise(parts)]:
            done.result()
        return objectives, worst, every

    def _space(self, items: int) -> Space:
        """Memory of this thread, with room for items or without."""
        name = "detailed" if items else "plain"
        space: Space | None = getattr(self._spaces, name, None)
        if space is None:
            space = Space(rooms(self._constants, items=items))
            setattr(self._spaces, name, space)
        return space


def _threads() -> int:
    return os.cpu_count() or 1


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(_threads(), thread_name_prefix="formations")


if hasattr(os, "register_at_fork"):
    # A forked process has none of the threads that it believes to have, and would wait for ever.
    os.register_at_fork(after_in_child=_pool.cache_clear)


def compiled_evaluator(problem: Problem, space: DesignSpace) -> CompiledEvaluator | None:
    """Return the compiled form of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.

    Returns
    -------
    CompiledEvaluator; None where numba is not installed, is told to compile nothing
    (NUMBA_DISABLE_JIT) or can keep nothing of what it compiles, or the problem has a part that the
    compiled loops do not know: volume or temporal decorrelation, a family or a kind of problem of
    your own.
    """
    if not supported(problem, space):
        return None
    try:
        from . import score as compiled
    except (ImportError, RuntimeError):  # RuntimeError: no folder to keep the compiled code in
        return None
    evaluator = CompiledEvaluator(problem, space, compiled)
    return evaluator if _agree(evaluator, problem, space) else None


def _agree(evaluator: CompiledEvaluator, problem: Problem, space: DesignSpace) -> bool:
    """Whether both forms score some designs alike: a model that grew is left to the arrays."""
    # Close formations: images that share no band leave matrices of condition 1e12.
    shares = np.random.default_rng(0).uniform(-0.1, 0.1, (8, space.dimension))
    designs = shares * space.upper
    scored, known = evaluator.evaluate(designs), problem.evaluate(space.states(designs))
    return np.allclose(scored.objectives, known.objectives, rtol=_SAME) and np.allclose(
        scored.violations, known.violations, rtol=_SAME, atol=_SAME
    )
