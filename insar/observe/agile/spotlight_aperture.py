"""How long a point must be seen for a resolution: solved on the Doppler history itself."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from formation import reference_orbit

from ..look import look_at
from .plans import PassPlan
from .smooth_orbit import SmoothOrbit, smooth_orbit
from .spotlight_attitude import Antenna
from .spotlight_echo import echo
from .spotlight_results import SpotlightRequest

Array = NDArray[np.float64]

_FIRST_TRY: Final = 1.05
_LONGER: Final = 1.5
"""Factors on the time of first order, and from one try to the next."""
_HORIZON: Final = 1e-3
"""To which the moment of rising above the horizon is found [s]."""
_PRECISION: Final = 1e-10
"""Of the aperture time [s]."""
_REVOLUTIONS: Final = 0.25
"""To either side: beyond, the Doppler of a satellite that never sets would return."""


class _Bound(NamedTuple):
    """Half of the longest aperture [s], and what it ends at."""

    half: float
    why: str


def solve_aperture(
    request: SpotlightRequest,
    plan: PassPlan,
    place: Array,
    *,
    rotation_center: Array,
    first_order: float,
) -> float:
    """Time about zero Doppler in which the point's Doppler runs through the bandwidth.

    Parameters
    ----------
    request : resolution and weighting, antenna, orbit.
    plan : moment of zero Doppler.
    place : (3,) — aim point, Earth-fixed [m].
    rotation_center : (3,) — where the beam points, Earth-fixed [m].
    first_order : scalar — k_wa V_g/(ρ_a|f_a|), Han 2016 eq. (4) [s].

    Returns
    -------
    scalar — T with f(−T/2) − f(T/2) = k_wa V_g/ρ_a, f the Doppler from the phase center [s].

    Raises
    ------
    ValueError
        If the Doppler does not run through so much while the point sees the satellite, or the
        orbit is known; the message says what resolution it would be enough for.

    Notes
    -----
    On a straight path f = −(2/λ) v²t/√(r² + v²t²): the rate at zero Doppler gives too short a time
    by 1/√(1 − (λB/4v)²), and none at all gives a bandwidth of 4v/λ.
    """
    wanted = request.weighting * plan.ground_speed / request.resolution
    bound = _known(request, plan)
    half = 0.5 * _FIRST_TRY * first_order
    while True:
        half = min(half, bound.half)
        if not _in_view(request, plan, place, half):
            bound = _horizon(request, plan, place, half)
            half = bound.half
        orbit = smooth_orbit(request.trajectory, plan.time - half, plan.time + half)
        swept = _Swept(request, plan, place, rotation_center, orbit)
        reached = swept.beyond(2.0 * half, 0.0)
        if reached >= wanted:
            return float(brentq(swept.beyond, 0.0, 2.0 * half, args=(wanted,), xtol=_PRECISION))
        if half >= bound.half:
            raise ValueError(_out_of_reach(request, plan, reached, bound))
        half *= _LONGER


class _Swept(NamedTuple):
    """Bandwidth of the point's Doppler about zero Doppler."""

    request: SpotlightRequest
    plan: PassPlan
    place: Array
    rotation_center: Array
    orbit: SmoothOrbit

    def beyond(self, duration: float, wanted: float) -> float:
        """Bandwidth over a duration [s] beyond what is wanted [Hz]."""
        begin, end = echo(
            self.orbit,
            self.plan.time + 0.5 * duration * np.array([-1.0, 1.0]),
            self.place,
            rotation_center=self.rotation_center,
            antenna=Antenna.of(self.request),
            wavelength=self.request.wavelength,
        ).doppler
        return float(begin - end - wanted)


def _known(request: SpotlightRequest, plan: PassPlan) -> _Bound:
    """How far the orbit is known to both sides, and its Doppler falls."""
    first, last = request.trajectory.span
    known = min(plan.time - first, last - plan.time)
    quarter = _REVOLUTIONS * reference_orbit(request.trajectory, plan.time).period
    if known < quarter:
        return _Bound(known, "the orbit is known")
    return _Bound(quarter, "a quarter of a revolution passes")


def _in_view(request: SpotlightRequest, plan: PassPlan, place: Array, half: float) -> bool:
    """Whether the point sees the satellite at both ends."""
    ends = plan.time + np.array([-half, half])
    return bool(np.all(look_at(request.trajectory.earth_fixed(ends), place).visible))


def _horizon(request: SpotlightRequest, plan: PassPlan, place: Array, half: float) -> _Bound:
    """The longest aperture above the horizon, by halving; `half` is longer."""
    low, high = 0.0, half
    while high - low > _HORIZON:
        middle = 0.5 * (low + high)
        if _in_view(request, plan, place, middle):
            low = middle
        else:
            high = middle
    return _Bound(low, "the aim point sees the satellite")


def _out_of_reach(request: SpotlightRequest, plan: PassPlan, reached: float, bound: _Bound) -> str:
    best = request.weighting * plan.ground_speed / reached if reached > 0.0 else math.inf
    remedy = (
        f"ask for {_rounded_up(best):.4g} m or coarser, a smaller weighting factor, or take a "
        "shorter wavelength"
        if math.isfinite(best)
        else "choose another pass"
    )
    return (
        f"resolution = {request.resolution:.6g} m: is out of reach: while {bound.why}, "
        f"{bound.half:.1f} s before and after zero Doppler, the Doppler runs through "
        f"{reached:.5g} Hz only, which resolves {best:.4g} m; {remedy}"
    )


def _rounded_up(value: float) -> float:
    """To three digits, upward: what is asked for next is within reach."""
    step = 10.0 ** (math.floor(math.log10(value)) - 2)
    return step * math.ceil(1.0001 * value / step)
