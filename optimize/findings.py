"""What a reader must know before using a result: the warnings of a report."""

from __future__ import annotations

import numpy as np

from formation.constants import EARTH_GRAVITATIONAL_PARAMETER
from insar import BaselineDecorrelation, HeightStatus, HeldConstant, SharedBy, Weighting

from .assessment import Assessment
from .noise_excess import noise_excess
from .problem import Problem

_COLLISION = 10.0
"""Closest approach below which a reader is warned where no limit says so [m]."""

_DOPPLER_SHIFT = 300.0
"""Shift of the Doppler spectra of a pair that is worth a warning [Hz]: 10 to 20 % of the band of a
strip-map radar."""

_DOUBTFUL_UNWRAPPING = 0.99
"""Below this probability in a segment, a reader is warned where no limit says so."""


def findings(problem: Problem, assessment: Assessment) -> tuple[str, ...]:
    """Warnings on a formation and on the model that assessed it.

    Parameters
    ----------
    problem : scene, radar, errors and limits.
    assessment : the formation.

    Returns
    -------
    Sentences for an InSAR engineer; none if there is nothing to warn of.
    """
    return (
        *_of_the_formation(problem, assessment),
        *_of_the_model(problem),
        _of_safety(assessment),
    )


def _of_the_formation(problem: Problem, assessment: Assessment) -> list[str]:
    notes = []
    error = assessment.height_error
    for status in (HeightStatus.NO_BASELINE, HeightStatus.NO_COHERENCE):
        count = int(np.sum(error.status == status))
        if count:
            notes.append(
                f"No height is measured in {count} of {len(problem.scene)} segments: "
                f"{status.reason}."
            )
    unwrapping = assessment.unwrapping
    if unwrapping is None:
        notes.append(
            "No prior height is given, so it was not checked whether the phase can be unwrapped: "
            "the height error holds only where it is."
        )
    else:
        worst = float(unwrapping.probability[unwrapping.worst_segment])
        limit = problem.constraints.min_unwrapping_probability
        if limit is None and worst < _DOUBTFUL_UNWRAPPING:
            notes.append(
                f"The phase is unwrapped rightly with a probability of only {worst:.3f} in "
                f"segment {unwrapping.worst_segment + 1}: there the height error means little."
            )
        if error.region >= unwrapping.prior_height_std:
            notes.append(
                f"The height error is not below the prior's {unwrapping.prior_height_std:g} m: the "
                "formation measures nothing that is not known already."
            )
    apart = [pair for pair in assessment.pairs if np.any(pair.common_azimuth == 0.0)]
    if apart:
        notes.append(
            f"{len(apart)} of {len(assessment.pairs)} pairs are so far apart along track that they "
            "share no azimuth band: they have no coherence and carry no information of their own."
        )
    dark = [pair for pair in assessment.pairs if np.any(pair.common_range == 0.0)]
    if dark:
        notes.append(
            f"{len(dark)} of {len(assessment.pairs)} pairs reach their critical baseline: they "
            "have no coherence and carry no information of their own."
        )
    notes += _of_phase_noise(problem, assessment)
    notes += _of_collision(problem, assessment)
    notes += _of_doppler(problem, assessment)
    beyond = [pair for pair in assessment.pairs if np.any(pair.baseline_over_critical >= 1.0)]
    if beyond and not dark:
        notes.append(
            f"{len(beyond)} of {len(assessment.pairs)} pairs reach their critical baseline, where "
            "images have no coherence; the error model of this study counts them all the same."
        )
    return notes


def _of_phase_noise(problem: Problem, assessment: Assessment) -> list[str]:
    """Phase noise above the Cramér-Rao bound, where the study counts the bound only."""
    noise = noise_excess(problem, assessment)
    if noise is None or noise.counted:
        return []
    return [
        f"The phase noise is {100.0 * noise.excess:.0f} % larger than the Cramér-Rao bound that "
        f"this study counts (coherence {noise.coherence:.2f}, {noise.looks:.3g} looks): "
        "errors.phase_statistics: exact counts it."
    ]


def _of_collision(problem: Problem, assessment: Assessment) -> list[str]:
    """Satellites that come close to each other, where the orbits are known."""
    if assessment.motion is None or problem.constraints.min_separation is not None:
        return []
    closest = float(assessment.motion.separations.min())
    if closest >= _COLLISION:
        return []
    return [f"Two satellites come within {closest:.3g} m of each other: they may collide."]


def _of_doppler(problem: Problem, assessment: Assessment) -> list[str]:
    """Along-track baselines long enough to decorrelate, where the model does not count it."""
    radar, lost = problem.radar, problem.errors.baseline_decorrelation
    counted = radar.azimuth_resolution is not None and lost is not BaselineDecorrelation.NONE
    if radar.pursuit or counted:
        return []
    speed = (EARTH_GRAVITATIONAL_PARAMETER * problem.mean_motion) ** (1.0 / 3.0)
    baseline = np.array([np.abs(pair.azimuth_baseline) for pair in assessment.pairs])
    # Seen from two places along track, a target's Doppler frequencies differ by B V/(λ r).
    shift = baseline * speed / (problem.radar.wavelength * problem.scene.slant_range)
    if shift.max() < _DOPPLER_SHIFT:
        return []
    return [
        f"Satellites are up to {baseline.max():.0f} m apart along track, which shifts the Doppler "
        f"spectra of a pair by {shift.max():.0f} Hz: the decorrelation is not counted here; give "
        "radar.azimuth_resolution_m or radar.doppler_bandwidth_hz to count it."
        if lost is not BaselineDecorrelation.NONE
        else f"Satellites are up to {baseline.max():.0f} m apart along track, which shifts the "
        f"Doppler spectra of a pair by {shift.max():.0f} Hz: like all decorrelation by baselines, "
        "it is neglected here."
    ]


def _of_the_model(problem: Problem) -> list[str]:
    notes = []
    errors = problem.errors
    if errors.weighting is Weighting.PAIRS and len(problem.radar.images) > 2:
        notes.append(
            "The weighting 'pairs' counts N images as N(N-1)/2 independent measurements: the "
            "height error is smaller than is possible. The weighting 'joint' is honest."
        )
    drawn_apart = [
        name
        for name in ("position", "azimuth", "synchronization")
        if getattr(errors, name).shared_by is SharedBy.PAIR and getattr(errors, name).std > 0.0
    ]
    if drawn_apart:
        notes.append(
            f"The {' and '.join(drawn_apart)} error is drawn anew for every pair, although the "
            "images share it: formations can look tens of times worse, and gains larger, than "
            "they are."
        )
    if np.allclose(problem.scene.incidence, problem.scene.look_angle, rtol=0.0, atol=1e-9):
        notes.append("The Earth is taken as flat: the incidence equals the look angle.")
    if errors.baseline_decorrelation is BaselineDecorrelation.NONE:
        notes.append(
            "Decorrelation by the perpendicular baseline is neglected: long baselines look better "
            "than they are."
        )
    if errors.held_constant is HeldConstant.AZIMUTH:
        notes.append(
            "Height sensitivity is taken at constant azimuth angle (Li 2009), not at constant "
            "range and Doppler as a SAR image has it; away from broadside they differ."
        )
    return notes


def _of_safety(assessment: Assessment) -> str:
    """Whether along-track phasing alone keeps a pair apart."""
    if assessment.motion is None:
        return (
            "The formation is given by positions at the scene's times, not by orbits: whether the "
            "satellites keep apart at other times was not assessed."
        )
    first, second = assessment.separation_pairs.T
    relative = assessment.motion.states[second] - assessment.motion.states[first]
    radial, normal, radial_rate, normal_rate = relative[:, [0, 2, 3, 5]].T
    # The radial-normal motion of a pair is an ellipse about zero; without area it crosses zero.
    area = np.abs(radial * normal_rate - normal * radial_rate)
    size = np.hypot(radial, normal) * np.hypot(radial_rate, normal_rate)
    note = "The separations hold for unperturbed linear motion."
    if np.any(area <= 1e-6 * size):
        note += (
            " The formation is passively unsafe: the radial-normal separation of a pair passes "
            "through zero, and J2 shifts the along-track phases that keep the satellites apart."
        )
    return note
