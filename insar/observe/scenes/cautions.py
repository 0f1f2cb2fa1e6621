"""What a user must know of an observation before relying on it."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import timedelta

from formation.earth_orientation import Coverage, orientation_coverage, orientation_span

from .observation import Observation

NEARLY_CIRCULAR = 0.005
"""Eccentricity above which relative motion about a circle is off by more than half a percent."""


def cautions(observation: Observation) -> tuple[str, ...]:
    """Warnings of an observation, one sentence or two each.

    Parameters
    ----------
    observation : of a formation study.
    """
    return tuple(_cautions(observation))


def _cautions(observation: Observation) -> Iterator[str]:
    missed = len(observation.missed_reasons)
    if missed:
        total = missed + len(observation.scene)
        yield (
            f"The pass sees {len(observation.scene)} of {total} targets: the height error is that "
            "of these. Widen the strip's incidences, or choose another pass or side."
        )
    if observation.eccentricity > NEARLY_CIRCULAR:
        yield (
            f"The orbit has an eccentricity of {observation.eccentricity:.3g}, and the satellites "
            "move about a circle: relative positions are wrong by about "
            f"{100 * observation.eccentricity:.2g} % of their size."
        )
    last = observation.epoch + timedelta(seconds=float(observation.scene.times[-1]))
    if orientation_coverage(observation.epoch, last) is Coverage.HELD:
        span = orientation_span()
        yield (
            f"The table of the Earth's rotation covers {span.first:%Y-%m-%d} to "
            f"{span.last_predicted:%Y-%m-%d}, and the pass is on {observation.epoch:%Y-%m-%d}: the "
            "ground track may be off by 0.1 km within a year and 1 km within five. A newer "
            "astropy-iers-data mends it."
        )
