"""The error budget: how large each error is, who shares it, and over which scale it is the same."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from .atmosphere import Ionosphere
from .calibration import Calibration
from .coherence.budget import CoherenceBudget
from .scale import Scale

__all__ = [
    "BaselineDecorrelation",
    "ErrorBudget",
    "ErrorSource",
    "HeldConstant",
    "PhaseStatistics",
    "Scale",
    "SharedBy",
    "Weighting",
]


class SharedBy(StrEnum):
    """Which measurements carry one and the same error."""

    IMAGE = "image"
    """Every image has its own."""
    SATELLITE = "satellite"
    """Every image that uses the satellite has it."""
    PAIR = "pair"
    """Every pair of images has its own, as if it were measured apart (Li 2009)."""
    ALL = "all"
    """All images have the same."""


class Weighting(StrEnum):
    """What the least-squares estimate takes for independent."""

    JOINT = "joint"
    """The N images, through their joint Fisher information."""
    PAIRS = "pairs"
    """The N(N−1)/2 pairs: Li 2009's form, better than is possible for more than two images."""


class BaselineDecorrelation(StrEnum):
    """What baselines cost in coherence (the geometric coherence model)."""

    FILTERED = "filtered"
    """Spectral filtering to the common band, in range and azimuth: full coherence, fewer looks."""
    UNFILTERED = "unfiltered"
    """No filtering: the coherence falls with the common share of the bands."""
    NONE = "none"
    """Neglected (Li 2009)."""


class PhaseStatistics(StrEnum):
    """What the phase noise of a pair follows from its coherence and looks by."""

    EXACT = "exact"
    """The exact multilook distribution: `insar.statistics`."""
    CRAMER_RAO = "cramer_rao"
    """The Cramér-Rao bound, which exact noise meets at many looks."""


class HeldConstant(StrEnum):
    """What a target keeps while its height changes, which defines the height sensitivity."""

    DOPPLER = "doppler"
    """Range and Doppler, as a SAR image does."""
    AZIMUTH = "azimuth"
    """Range and azimuth angle: Li 2009's form."""


class ErrorSource(NamedTuple):
    """One source of error.

    Attributes
    ----------
    std : standard deviation, in the unit that the source has in `ErrorBudget`.
    shared_by : which measurements carry the same error.
    scale : how far it stays the same on the ground.
    """

    std: float
    shared_by: SharedBy
    scale: Scale = Scale.SCENE


_MAY_BE_SHARED_BY = {
    "position": (SharedBy.SATELLITE, SharedBy.PAIR),
    "azimuth": (SharedBy.ALL, SharedBy.PAIR),
    "synchronization": (SharedBy.IMAGE, SharedBy.PAIR),
    "range": (SharedBy.ALL,),
    "troposphere": (SharedBy.ALL,),
}


@dataclass(frozen=True, kw_only=True)
class ErrorBudget:
    """Every error that the height model counts, and how the estimate weighs it.

    Parameters
    ----------
    position : error of the satellites' relative positions, per satellite and axis [m]. Shared by
        ``satellite``, or by ``pair``: √2 of it, independent in each pair.
    azimuth : error of the direction of the target along track, seen from the formation [rad].
        One angle for ``all`` images (1 m on the ground at 560 km is 1.8e-6 rad); by ``pair`` is
        Li 2009's independent form.
    range : error of the slant range, common to ``all`` images [m].
    synchronization : residual phase of each bistatic link (an image whose transmitter is not its
        receiver), by ``image``, or by ``pair`` [rad].
    troposphere : zenith delay that is left after its correction, or all of it where there is none,
        common to ``all`` images [m]; see `insar.atmosphere`.
    ionosphere : what is not known of the ionosphere; None neglects it.
    calibration : how the heights are adjusted to control points afterwards; None for not at all.
        It leaves `HeightError` alone, which is of one scene before any adjustment, and acts in
        `insar.accuracy`.
    weighting : what the estimate takes for independent.
    baseline_decorrelation : what a perpendicular baseline costs in coherence, and a separation
        along track where the radar has an azimuth resolution.
    held_constant : what a target keeps while its height changes.
    coherence : the other factors of the coherence.
    phase_statistics : what phase noise follows from coherence and looks by.
    phase_std : standard deviation of the phase of every pair instead of what follows from its
        coherence; only with ``Weighting.PAIRS`` [rad].

    Raises
    ------
    ValueError
        If a deviation is negative or not finite, a source is shared in a way that it can't be, or
        sharing by pair is combined with the joint weighting, which knows no pairs.

    Notes
    -----
    Phase noise is no entry: it follows from the radar's SNR, looks and the coherence model, and
    its scale is the pixel.
    """

    position: ErrorSource = field(default=ErrorSource(0.0, SharedBy.SATELLITE))
    azimuth: ErrorSource = field(default=ErrorSource(0.0, SharedBy.ALL))
    range: ErrorSource = field(default=ErrorSource(0.0, SharedBy.ALL))
    synchronization: ErrorSource = field(default=ErrorSource(0.0, SharedBy.IMAGE))
    troposphere: ErrorSource = field(default=ErrorSource(0.0, SharedBy.ALL, Scale.DATA_TAKE))
    ionosphere: Ionosphere | None = None
    calibration: Calibration | None = None
    weighting: Weighting = Weighting.JOINT
    baseline_decorrelation: BaselineDecorrelation = BaselineDecorrelation.FILTERED
    held_constant: HeldConstant = HeldConstant.DOPPLER
    coherence: CoherenceBudget = field(default=CoherenceBudget())
    phase_statistics: PhaseStatistics = PhaseStatistics.EXACT
    phase_std: float | None = None

    def __post_init__(self) -> None:
        for name, allowed in _MAY_BE_SHARED_BY.items():
            source: ErrorSource = getattr(self, name)
            if not (math.isfinite(source.std) and source.std >= 0.0):
                raise ValueError(f"{name}.std = {source.std!r} must be finite and not negative")
            if source.shared_by not in allowed:
                raise ValueError(
                    f"{name}.shared_by = {str(source.shared_by)!r} is not possible; "
                    f"choose {' or '.join(repr(str(a)) for a in allowed)}"
                )
            if source.shared_by is SharedBy.PAIR and self.weighting is not Weighting.PAIRS:
                raise ValueError(
                    f"{name}.shared_by = 'pair' needs the weighting 'pairs': "
                    "the joint weighting is of images, not of pairs"
                )
        if self.phase_std is not None:
            if not (math.isfinite(self.phase_std) and self.phase_std > 0.0):
                raise ValueError(f"phase_std = {self.phase_std!r} must be finite and positive")
            if self.weighting is not Weighting.PAIRS:
                raise ValueError(
                    f"phase_std = {self.phase_std!r} is a pair's: it needs the weighting 'pairs'"
                )

    @property
    def common_scales(self) -> dict[str, Scale]:
        """Scale of each of `insar.height.common_height_errors`."""
        scales = {"range": self.range.scale, "troposphere": self.troposphere.scale}
        if self.ionosphere is not None:
            scales |= dict.fromkeys(("ionosphere", "ionosphere_gradient"), self.ionosphere.scale)
        return scales

    @classmethod
    def li2009(
        cls, *, position_std: float = 0.01, range_std: float = 0.01, snr: float = 10.0
    ) -> ErrorBudget:
        """Return the budget that reproduces the twelve published figures of Li 2009.

        The covariance of the paper is in a reference that is not available; this is recovered
        from its figures. The azimuth error is independent from pair to pair, although there is
        only one target and one azimuth; that, not the optimizer, makes the published gain of 28.

        Parameters
        ----------
        position_std : scalar — error per satellite and axis, Table 1 [m].
        range_std : scalar — error of the slant range, Table 1 [m].
        snr : scalar — signal-to-noise ratio, Table 1, as a power ratio.

        Notes
        -----
        The printed azimuth error of 0.01° does not give the published figures; 0.01·√(π/180) rad
        (0.0757°) does: it seems to have been squared in degrees and converted with one factor
        π/180 instead of two. The phase noise 1/√(2·SNR) per pair hardly matters there.
        """
        return cls(
            position=ErrorSource(position_std, SharedBy.SATELLITE),
            azimuth=ErrorSource(0.01 * math.sqrt(math.pi / 180.0), SharedBy.PAIR),
            range=ErrorSource(range_std, SharedBy.ALL),
            weighting=Weighting.PAIRS,
            baseline_decorrelation=BaselineDecorrelation.NONE,
            held_constant=HeldConstant.AZIMUTH,
            phase_std=1.0 / math.sqrt(2.0 * snr),
        )
