"""Spotlight, video and coverage in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from insar import LookSide
from insar.observe.agile.spotlight_results import Pointing
from insar.observe.agile.video_request import YawLaw
from insar.observe.agile.video_results import Staring, VideoResult
from insar.observe.coverage.results import Verdict
from insar.observe.coverage.walker import Visibility, Walker

from .wording import percent, plain

_POINTING = {
    Pointing.BELOW_HORIZON: "the aim point does not see the satellite above its horizon",
    Pointing.OPPOSITE: "the beam would have to turn by 180°",
}
_STARING = {
    Staring.BELOW_HORIZON: "the aim point does not see the satellite above its horizon",
    Staring.UNDEFINED: "the yaw law leaves the turn about the line of sight open",
    Staring.AXIS_LOST: "no turn keeps the footprint's major axis",
}
_YAW_LAWS = {
    YawLaw.NONE: "roll and pitch only",
    YawLaw.SHORTEST_ROTATION: "shortest rotation",
    YawLaw.AZIMUTH_TRACE: "azimuth trace held",
    YawLaw.RANGE_TRACE: "range trace held",
    YawLaw.MAJOR_AXIS: "major axis held",
}
_VERDICTS = {
    Verdict.GAPS: "gaps",
    Verdict.UNDECIDED: "undecided",
    Verdict.CONTINUOUS: "continuous",
}


def yaw_law_name(law: YawLaw) -> str:
    """Yaw law in words."""
    return _YAW_LAWS[law]


def verdict_name(verdict: int) -> str:
    """Verdict on a constellation in a word."""
    return _VERDICTS[Verdict(verdict)]


def pointing_reason(pointing: NDArray[np.int_]) -> str | None:
    """Why the beam can't be pointed at some samples of a spotlight; None where it can at all."""
    return _reason(pointing, _POINTING)


def staring_reason(staring: NDArray[np.int_]) -> str | None:
    """The same of a film."""
    return _reason(staring, _STARING)


def common_reason(result: VideoResult) -> str | None:
    """Why it is not known what all footprints see; None where it is."""
    prints = result.footprints
    if np.isfinite(prints.common_area):
        return None
    drawn = np.isfinite(prints.latitude).any(axis=-1)
    past = int(np.count_nonzero(drawn & ~np.isfinite(prints.area)))
    if past:
        return f"the beam reaches past the horizon in {past} of {drawn.size} outlines"
    return "there is no outline"


def _reason(found: NDArray[np.int_], words: Mapping[Any, str]) -> str | None:
    missing = found[found != 0]
    if missing.size == 0:
        return None
    return " or ".join(
        f"{words[int(value)]} at {percent(count / found.size)} of the samples"
        for value, count in zip(*np.unique(missing, return_counts=True), strict=True)
    )


def side_name(side: LookSide) -> str:
    """Side to which a radar looks."""
    return "left" if side is LookSide.LEFT else "right"


def heading_name(*, ascending: bool) -> str:
    """Direction of flight."""
    return "northward" if ascending else "southward"


def visibility_text(visibility: Visibility) -> str:
    """What a satellite sees."""
    side = "either side" if visibility.side is None else f"the {side_name(visibility.side)} only"
    low, high = (
        plain(math.degrees(angle)) for angle in (visibility.min_incidence, visibility.max_incidence)
    )
    return f"incidence {low}° … {high}°, to {side}"


def walker_name(walker: Walker) -> str:
    """Altitude and Walker's notation."""
    return f"{plain(walker.altitude / 1e3)} km, {walker.name}"
