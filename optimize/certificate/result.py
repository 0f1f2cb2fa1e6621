"""What is proved of a design: how far from the best possible it can be at most."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Method(StrEnum):
    """How a lower bound of the height error is proved."""

    CLOSED_FORM = "closed_form"
    """From the largest scatter that the satellites can have."""
    SEMIDEFINITE = "semidefinite"
    """By a convex program over all scatter matrices."""
    ONE_SHOT = "one_shot"
    """From the tangent of the convex program at the design found, and how far it can be reached."""
    SEPARABLE = "separable"
    """From a sum over satellites that their information does not exceed."""
    BRANCH_AND_BOUND = "branch_and_bound"
    """By exhausting the projected baselines."""


class LowerBound(NamedTuple):
    """A lower bound of the region height error, by one method.

    Attributes
    ----------
    method : how it is proved.
    value : scalar — NaN where the method gives none [m].
    reason : why it gives none; empty where it does.
    """

    method: Method
    value: float
    reason: str = ""


class Convergence(NamedTuple):
    """How bound and best of a branch and bound close in.

    Attributes
    ----------
    boxes : (steps,) — boxes bounded so far.
    lower_bound, best : (steps,) — region height error [m]; `inf` before the first of each.
    """

    boxes: Array
    lower_bound: Array
    best: Array


class Relief(NamedTuple):
    """A limit that, relaxed alone, would let a formation pass.

    Attributes
    ----------
    name : of the limit, in words.
    unit : of the values, empty for a ratio.
    limit : as the study has it.
    blocks_to : proved to block as far as this.
    passes_at : here a formation passes; NaN if none was found however far it is relaxed.
    """

    name: str
    unit: str
    limit: float
    blocks_to: float
    passes_at: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Infeasibility:
    """A proof that no formation keeps the limits.

    Attributes
    ----------
    statement : what is proved, in words.
    reliefs : what would help, each on its own.
    """

    statement: str
    reliefs: tuple[Relief, ...]


class TargetVerdict(NamedTuple):
    """Whether a height error that is wanted can be reached.

    Attributes
    ----------
    height_error : scalar — the target [m].
    reached : whether the design reaches it.
    impossible : the proof that no formation does, and what would help; None if there is none.
    """

    height_error: float
    reached: bool
    impossible: Infeasibility | None


@dataclass(frozen=True, kw_only=True, eq=False)
class Certificate:
    """Lower bounds of the region height error within the limits, and what they rest on.

    Attributes
    ----------
    objective : scalar — region height error of the design; `inf` if none is feasible [m].
    bounds : one for each method that was tried.
    assumptions : what the bounds assume or leave out, in words; each makes them looser at most.
    convergence : of the branch and bound; None if it did not run.
    boxes : that the branch and bound looked at.
    infeasibility : the proof that nothing keeps the limits; None if there is none.
    target : whether the height error that the study wants can be reached; None if it wants none.
    """

    objective: float
    bounds: tuple[LowerBound, ...]
    assumptions: tuple[str, ...]
    convergence: Convergence | None
    boxes: int
    infeasibility: Infeasibility | None = None
    target: TargetVerdict | None = None

    @property
    def strongest(self) -> LowerBound | None:
        """The largest of the bounds; None if there is none."""
        known = [bound for bound in self.bounds if np.isfinite(bound.value)]
        return max(known, key=lambda bound: bound.value) if known else None

    @property
    def lower_bound(self) -> float:
        """No design within the limits has a smaller region height error; NaN if unknown [m]."""
        return float("nan") if self.strongest is None else self.strongest.value

    @property
    def gap(self) -> float:
        """How much better, in parts of the bound, a design could be at most; NaN if unknown."""
        if self.strongest is None or not np.isfinite(self.objective):
            return float("nan")
        # The bound is relaxed by rounding; a design may meet it to the last digits.
        return max(0.0, self.objective / self.lower_bound - 1.0)
