"""Which problems the compiled loops know."""

from __future__ import annotations

from formation import ground_track_circular, space_circular

from ..design_space import DesignSpace
from ..problem import Problem


def supported(problem: Problem, space: DesignSpace) -> bool:
    """Whether the compiled loops know every part of a problem.

    Parameters
    ----------
    problem : what is minimized, and within which limits.
    space : the designs.
    """
    if type(problem) is not Problem or type(space) is not DesignSpace:
        return False  # a subclass may score otherwise, or count what is scored
    return (
        space.family in (space_circular, ground_track_circular)
        and problem.errors.coherence.spectral
        and space.satellites == problem.radar.satellite_count
    )
