"""What the runs that score formations have in common."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from insar.observe.scenes.cautions import cautions, orbit_cautions
from optimize import Assessment

from .outcome import Summary


def formation_summary(shown: Sequence[Assessment], warnings: tuple[str, ...] = ()) -> Summary:
    """Height error, unwrapping and limits of each formation.

    Parameters
    ----------
    shown : the formations, the one that matters last.
    warnings : of the scene.
    """
    rows = [
        (
            "height error, total (RMS)",
            tuple(meters(float(a.height_error.region)) for a in shown),
        ),
        (
            "height error, relative",
            tuple(meters(float(a.height_error.relative_region)) for a in shown),
        ),
    ]
    unwrapping = [a.unwrapping for a in shown if a.unwrapping is not None]
    if len(unwrapping) == len(shown):
        rows.append(
            ("unwrapping probability", tuple(f"{u.probability.min():.4f}" for u in unwrapping))
        )
    rows.append(("limits", tuple(_limits(a) for a in shown)))
    return Summary(tuple(a.label for a in shown), tuple(rows), warnings)


def scene_cautions(observation: Observation | StaringScene | None) -> tuple[str, ...]:
    """Warnings of the scene; none for a scene that was given."""
    if observation is None:
        return ()
    if isinstance(observation, Observation):
        return cautions(observation)
    return orbit_cautions(observation)


def meters(value: float) -> str:
    """A length as the terminal shows it; none if it is not finite."""
    return f"{value:.3f} m" if np.isfinite(value) else "none"


def _limits(assessment: Assessment) -> str:
    broken = sum(not report.satisfied for report in assessment.constraints)
    if broken:
        return f"{broken} of {len(assessment.constraints)} broken"
    return "all kept" if assessment.constraints else "none set"
