"""What the runs that score formations have in common."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from insar.dem import Judgment
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from insar.observe.scenes.cautions import cautions, orbit_cautions
from optimize import Assessment, DemVerdict

from .outcome import Summary


def formation_summary(
    shown: Sequence[Assessment],
    warnings: tuple[str, ...] = (),
    *,
    dem: DemVerdict | None = None,
) -> Summary:
    """Height error, unwrapping and limits of each formation.

    Parameters
    ----------
    shown : the formations, the one that matters last.
    warnings : of the scene.
    dem : the elevation model of the last formation; its judgment is shown where there is one.
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
    if dem is not None and dem.judgments:
        elsewhere = ("",) * (len(shown) - 1)
        rows += [
            (f"{judgment.specification.name} at 90 %", (*elsewhere, _judged(judgment)))
            for judgment in dem.judgments
        ]
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


def _judged(judgment: Judgment) -> str:
    """Pass or fail, with the demand that is missed by most."""
    if judgment.passed:
        return "pass"
    worst = max(judgment.criteria, key=lambda criterion: criterion.ratio)
    what = {"posting": "posting", "relative_90": "relative", "absolute_90": "absolute"}
    return f"fail: {what[worst.quantity.value]} {meters(worst.value)} > {worst.limit:g} m"


def _limits(assessment: Assessment) -> str:
    broken = sum(not report.satisfied for report in assessment.constraints)
    if broken:
        return f"{broken} of {len(assessment.constraints)} broken"
    return "all kept" if assessment.constraints else "none set"
