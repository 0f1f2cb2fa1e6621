"""Refutes a prediction, or fails to: a Monte-Carlo of one formation beside what was predicted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..acquisitions import combine_acquisitions
from ..errors import ErrorBudget
from ..height import height_error_of
from ..phase_model import phase_model
from ..radar import Radar
from ..scene import Scene
from ..unwrapping import unwrapping_ladder
from .combining import combined_nature
from .comparison import Comparison, Simulated, simulated_rms
from .draws import Draw, draw
from .nature import natural_errors, segment_nature

Array = NDArray[np.float64]

_FULL_SAMPLES = 6
"""Images up to which every sample asked for is drawn."""

MAX_IMAGES = 100
"""Images up to which a simulation takes seconds."""

_USELESS_BITS = 0.1
"""Gain below which nothing was measured: an error that is not 7 % smaller than the prior's."""

_ONE_SIGMA = 0.6827
"""Probability that a Gaussian keeps within one standard deviation."""

_TOO_OFTEN_WRONG = 0.1
"""Share of wrong cycles from which on the error with right cycles says little."""


class Verdict(StrEnum):
    """What a simulation says of a prediction."""

    AGREES = "agrees"
    """The simulated errors are those predicted, within their sampling error or 5 %."""
    DISAGREES = "disagrees"
    """They are not."""
    OFTEN_WRONG = "often_wrong"
    """The prediction holds for right cycles only, and too many are wrong."""
    MEASURES_NOTHING = "measures_nothing"
    """No estimator knows the height better than the prior did."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SegmentRefutation:
    """Simulation and prediction of one segment.

    Attributes
    ----------
    segment : index of the segment, 0-based.
    predicted_total, predicted_relative : standard deviations by the model of the study, with right
        cycles [m]; `inf` where it measures no height.
    predicted_failure : probability that a cycle is wrong, by the model of the study.
    right_cycles : RMS height error of weighted least squares with every cycle right [m].
    relative : the part of it that varies between pixels that share the scene's errors [m].
    unwrapped : RMS height error of the same estimate with the cycles that bootstrapping finds [m].
    wrong : share of samples in which it finds a wrong one.
    most_likely : RMS height error of maximum likelihood with the prior height [m].
    two_thirds : what the size of that error keeps within in 68.3 % of the samples, as one standard
        deviation of a Gaussian would; wrong cycles that are rarer do not show in it [m].
    best : RMS height error of the posterior mean, the smallest that an estimate can have [m].
    prior_height_std : of the height known beforehand [m].
    prior : RMS error of that height in the samples drawn [m].
    errors : (samples,) — height errors of the bootstrapped estimate [m].
    likely_errors : (samples,) — height errors of maximum likelihood [m].
    """

    segment: int
    predicted_total: float
    predicted_relative: float
    predicted_failure: float
    right_cycles: Simulated
    relative: Simulated
    unwrapped: Simulated
    wrong: Simulated
    most_likely: Simulated
    two_thirds: float
    best: Simulated
    prior_height_std: float
    prior: Simulated
    errors: Array
    likely_errors: Array

    @property
    def gain(self) -> float:
        """What was gained over the prior height [m]: its error less the smallest error.

        Both are of the same samples, so that chance in the heights drawn cancels.
        """
        return self.prior.value - self.best.value

    @property
    def bits(self) -> float:
        """What was gained over the prior height [bits]: log2 of prior over smallest error.

        The least information on a Gaussian height that an estimate with this error can rest on
        (its rate-distortion function), and the mutual information itself where what remains is
        Gaussian.
        """
        return max(0.0, math.log2(self.prior.value / self.best.value))

    @property
    def total(self) -> Comparison:
        """Total error with right cycles, predicted and simulated [m]."""
        return Comparison(self.predicted_total, self.right_cycles)

    @property
    def relative_error(self) -> Comparison:
        """Relative error with right cycles, predicted and simulated [m]."""
        return Comparison(self.predicted_relative, self.relative)

    @property
    def wrong_cycles(self) -> Comparison:
        """Share of samples with a wrong cycle, predicted and simulated."""
        return Comparison(self.predicted_failure, self.wrong)

    @property
    def verdict(self) -> Verdict:
        """What the simulation says."""
        if self.bits < _USELESS_BITS:
            return Verdict.MEASURES_NOTHING
        if (
            self.total.height_differs
            or self.relative_error.height_differs
            or self.wrong_cycles.share_differs
        ):
            return Verdict.DISAGREES
        often = max(self.wrong.value, self.predicted_failure) > _TOO_OFTEN_WRONG
        return Verdict.OFTEN_WRONG if often else Verdict.AGREES


@dataclass(frozen=True, kw_only=True, eq=False)
class Refutation:
    """What a simulation says of the predictions for one formation.

    Attributes
    ----------
    segments : the segment with the least probability of right cycles, and a typical one.
    samples : pixels drawn in each.
    draws : of the errors that stay the same over the scene, in each.
    departures : where nature, as drawn, differs from the error model of the study.
    """

    segments: tuple[SegmentRefutation, ...]
    samples: int
    draws: int
    departures: tuple[str, ...]

    @property
    def verdict(self) -> Verdict:
        """The worst over the segments."""
        order = list(Verdict)
        return max((segment.verdict for segment in self.segments), key=order.index)


def refute(
    positions: ArrayLike,
    scene: Scene,
    *,
    radar: Radar,
    errors: ErrorBudget,
    prior_height_std: float,
    samples: int,
    rng: np.random.Generator,
    combined: bool = False,
) -> Refutation:
    """Simulate one formation and compare with what the error model predicts.

    Parameters
    ----------
    positions : (S, N, 3) — RTN positions at the scene's times [m].
    scene : the S segments.
    radar : the radar and its images.
    errors : the error budget of the study.
    prior_height_std : scalar — standard deviation of the height known beforehand [m].
    samples : pixels to draw, in pairs that share the errors of the scene; at least 100. With more
        than six images, whose estimates take long, fewer are drawn.
    rng : source of random numbers.
    combined : whether the positions are (A, S, N, 3), of A acquisitions that are combined to one
        height.

    Raises
    ------
    ValueError
        If there are fewer than 100 samples, more than 100 images, or the prior is not positive.

    Notes
    -----
    Speckle is drawn look by look from the coherence matrix, errors at their scales, the height from
    the prior; the heights are then estimated from wrapped phases. The Fisher information that the
    prediction rests on enters only as the weights of the estimators, which can make them worse and
    never better than what was drawn.
    """
    if samples < 100:
        raise ValueError(f"samples = {samples} must be at least 100: fewer refute nothing")
    if len(radar.images) > MAX_IMAGES:
        raise ValueError(
            f"images: {len(radar.images)} are too many to simulate; at most {MAX_IMAGES}"
        )
    if not (math.isfinite(prior_height_std) and prior_height_std > 0.0):
        raise ValueError(f"prior_height_std = {prior_height_std!r} must be finite and positive")
    natural = natural_errors(errors)
    each = list(np.asarray(positions)) if combined else [positions]
    models = [phase_model(one, scene, radar=radar, errors=errors) for one in each]
    model = combine_acquisitions(models) if combined else models[0]
    predicted = height_error_of(model, scene=scene, radar=radar, errors=errors)
    failure = unwrapping_ladder(model, prior_height_std=prior_height_std).failure
    count = model.vertical_wavenumber.shape[-1]
    draws = max(min(samples, int(samples * (_FULL_SAMPLES / count) ** 2)), 200) // 2
    segments = []
    for segment in _telling(failure, predicted.total):
        natures = [
            segment_nature(one, scene, segment=segment, radar=radar, errors=natural.errors)
            for one in each
        ]
        nature = combined_nature(natures) if combined else natures[0]
        drawn = draw(nature, prior_height_std=prior_height_std, draws=draws, pixels=2, rng=rng)
        segments.append(
            _compared(
                drawn,
                segment=segment,
                total=float(predicted.total[segment]),
                relative=float(predicted.relative[segment]),
                failure=float(failure[segment]),
                prior_height_std=prior_height_std,
            )
        )
    return Refutation(
        segments=tuple(segments), samples=2 * draws, draws=draws, departures=natural.departures
    )


def _telling(failure: Array, total: Array) -> tuple[int, ...]:
    """The worst segment, and the one in the middle of all; one where they coincide."""
    order = np.lexsort((np.where(np.isfinite(total), total, np.inf), failure))
    worst, median = int(order[-1]), int(order[len(order) // 2])
    return (worst,) if worst == median else (worst, median)


def _compared(
    drawn: Draw,
    *,
    segment: int,
    total: float,
    relative: float,
    failure: float,
    prior_height_std: float,
) -> SegmentRefutation:
    shared = drawn.right_cycles.mean(axis=-1, keepdims=True)
    pixels = drawn.right_cycles.shape[-1]
    within = ((drawn.right_cycles - shared) ** 2).sum(axis=-1) / (pixels - 1)
    wrong = (~drawn.right).mean(axis=-1)
    # Of a share that is nearly 0, the sampling error is that of the share predicted.
    least = math.sqrt(max(failure * (1.0 - failure), 1.0 / wrong.size) / drawn.right.size)
    return SegmentRefutation(
        segment=segment,
        predicted_total=total,
        predicted_relative=relative,
        predicted_failure=failure,
        right_cycles=_rms(drawn.right_cycles),
        relative=simulated_rms(within),
        unwrapped=_rms(drawn.unwrapped),
        wrong=Simulated(
            float(wrong.mean()), max(float(wrong.std(ddof=1)) / math.sqrt(wrong.size), least)
        ),
        most_likely=_rms(drawn.most_likely),
        two_thirds=float(np.quantile(np.abs(drawn.most_likely), _ONE_SIGMA)),
        best=_rms(drawn.mean),
        prior_height_std=prior_height_std,
        prior=_rms(drawn.prior),
        errors=drawn.unwrapped.ravel(),
        likely_errors=drawn.most_likely.ravel(),
    )


def _rms(errors: Array) -> Simulated:
    """RMS of (draws, pixels) [m]."""
    return simulated_rms((errors**2).mean(axis=-1))
