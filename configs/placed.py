"""Trajectories that know their place in a study, and blame it for what they do not know."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from numpy.typing import ArrayLike

from formation import States, Trajectory
from formation.timescales import seconds_between

from .base import utc
from .messages import BuildError, KeyPath
from .orbits import OrbitBlock, build_trajectory

DAY = 86_400.0


@dataclass(frozen=True)
class PlacedTrajectory:
    """A trajectory of a study, which blames its place in the study for what it does not know.

    Parameters
    ----------
    trajectory : the orbit.
    at : its place in the study.
    """

    trajectory: Trajectory
    at: KeyPath

    @property
    def epoch(self) -> datetime:
        """Time zero (UTC)."""
        return self.trajectory.epoch

    @property
    def span(self) -> tuple[float, float]:
        """First and last time at which the states are known [s]."""
        return self.trajectory.span

    @property
    def start(self) -> float:
        """Time zero, or the first time known after it [s]."""
        return max(0.0, self.trajectory.span[0])

    @property
    def source(self) -> str:
        """What the orbit is known from."""
        return self.trajectory.source

    @property
    def perturbed(self) -> bool:
        """Whether the states contain the periodic terms of J2."""
        return self.trajectory.perturbed

    def since(self, moment: str | None) -> float:
        """Time of a moment (ISO 8601, UTC) since the epoch; the start for none [s]."""
        return self.start if moment is None else seconds_between(self.epoch, utc(moment))

    def inertial(self, times: ArrayLike) -> States:
        """States in the GCRS; a time that is not known raises a BuildError."""
        try:
            return self.trajectory.inertial(times)
        except ValueError as error:
            raise refusal(self.at, error) from None

    def earth_fixed(self, times: ArrayLike) -> States:
        """States in the ITRS; a time that is not known raises a BuildError."""
        try:
            return self.trajectory.earth_fixed(times)
        except ValueError as error:
            raise refusal(self.at, error) from None


def placed_trajectory(block: OrbitBlock, at: KeyPath) -> PlacedTrajectory:
    """Build the orbit on the real Earth.

    Parameters
    ----------
    block : the orbit.
    at : its place in the study.
    """
    return PlacedTrajectory(build_trajectory(block), (*at, *block.blamed))


def refusal(at: KeyPath, error: ValueError) -> BuildError:
    """Error of what computes with a study, at a place of the study.

    Parameters
    ----------
    at : path of the value to blame.
    error : "what is wrong; remedy".
    """
    return BuildError(at, f"cannot be used: {' '.join(str(error).split())}")
