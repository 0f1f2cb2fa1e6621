"""From targets and moments to an observation: geometry of each segment, and the map around it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from formation import Trajectory, mean_elements_at, reference_orbit

from ...scene import Scene
from ..boresight import FixedIncidence
from ..doppler import doppler_centroid
from ..earth import Geodetic, to_geodetic
from ..frames import rtn_axes
from ..look import look_at, swath
from ..steering import antenna_plane, off_boresight
from ..vectors import dot, rotate, unit
from .crossings import nearest_crossings, zero_doppler
from .observation import Observation, Reference
from .passes import Strip
from .targets import Targets
from .windows import Window, moment, window_around

Array = NDArray[np.float64]

TRACK_POINTS: Final = 121
TRACK_MARGIN: Final = 1.0 / 60.0
"""Of the map before the first segment and after the last, in revolutions."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """What an observation is made with, whatever its targets are.

    Parameters
    ----------
    trajectory, strip : the satellite and its beam.
    wavelength, slope : scalars — as in `observe` [m, rad].
    reference : moment to which the geometry is referred.
    window : of the search.

    Raises
    ------
    ValueError
        If the wavelength is not positive.
    """

    trajectory: Trajectory
    strip: Strip
    wavelength: float
    slope: float
    reference: Reference
    window: Window

    def __post_init__(self) -> None:
        if not (math.isfinite(self.wavelength) and self.wavelength > 0.0):
            raise ValueError(f"wavelength = {self.wavelength!r} m must be a finite positive number")


class Missed(NamedTuple):
    """Targets that a pass does not see, (M,) [rad], and why, in words."""

    latitude: Array
    longitude: Array
    reasons: tuple[str, ...]


NOTHING_MISSED: Final = Missed(np.empty(0), np.empty(0), ())


def record(
    recording: Recording,
    targets: Targets,
    times: Array,
    *,
    passes: int,
    number: int,
    missed: Missed = NOTHING_MISSED,
) -> Observation:
    """Observation of targets at the moments at which the plane of the beam passes over them.

    Parameters
    ----------
    recording : orbit, beam and reference.
    targets : S of them, all seen.
    times : (S,) — since the trajectory's epoch [s].
    passes, number : how many there are, and which this is.
    missed : targets that are not seen.

    Raises
    ------
    ValueError
        If a target has no moment of zero Doppler to refer it to, or the scene is impossible.
    """
    referred = _reference_times(recording, targets, times)
    order = np.argsort(referred, kind="stable")
    seen, observed, referred = targets.subset(order), times[order], referred[order]
    trajectory, strip = recording.trajectory, recording.strip
    first = float(referred[0])
    beam = _beam(recording, seen, observed)
    chart = _chart(recording, np.concatenate([observed, referred]))
    return Observation(
        scene=_scene(recording, seen, referred),
        orbit=reference_orbit(trajectory, first),
        epoch=moment(trajectory, first),
        orbit_source=trajectory.source,
        orbit_epoch=trajectory.epoch,
        side=strip.side,
        law=strip.law,
        boresight=strip.boresight,
        reference=recording.reference,
        eccentricity=float(mean_elements_at(trajectory, first).eccentricity),
        ascending=bool(trajectory.earth_fixed(np.median(observed)).velocity[2] > 0.0),
        passes=passes,
        pass_number=number,
        latitude=seen.latitude,
        longitude=seen.longitude,
        height=seen.height,
        doppler=beam.doppler,
        off_boresight=beam.elevation,
        missed_latitude=missed.latitude,
        missed_longitude=missed.longitude,
        missed_reasons=missed.reasons,
        track_latitude=chart.track.latitude,
        track_longitude=chart.track.longitude,
        near_latitude=chart.near.latitude,
        near_longitude=chart.near.longitude,
        far_latitude=chart.far.latitude,
        far_longitude=chart.far.longitude,
        near_incidence=strip.near_incidence,
        far_incidence=strip.far_incidence,
        outlines=targets.outlines,
    )


def _reference_times(recording: Recording, targets: Targets, times: Array) -> Array:
    """Moments to which the geometry of targets seen at `times` is referred."""
    if recording.reference is Reference.AS_OBSERVED:
        return times
    referred = nearest_crossings(
        recording.trajectory,
        targets.position,
        zero_doppler,
        times,
        period=recording.window.period,
    )
    lost = np.count_nonzero(np.isnan(referred))
    if lost:
        raise ValueError(
            f"{lost} of {len(times)} targets have no moment of zero Doppler in view within a "
            f"quarter of a revolution of their observation (steering law {recording.strip.law}); "
            "refer the geometry to the moment as observed, or steer to zero Doppler"
        )
    return referred


def _scene(recording: Recording, targets: Targets, times: Array) -> Scene:
    """Lines of sight in the RTN axes of each moment."""
    states = recording.trajectory.earth_fixed(times)
    look = look_at(states, targets.position)
    return Scene(
        times=times - times[0],
        slant_range=look.slant_range,
        look_angle=look.look_angle,
        azimuth=look.azimuth,
        incidence=look.incidence,
        velocity_direction=rotate(rtn_axes(states), unit(states.velocity)),
        slope=np.asarray(recording.slope, dtype=np.float64),
    )


class _Beam(NamedTuple):
    """Doppler centroid [Hz], and elevation off the boresight [rad], of targets (S,)."""

    doppler: Array
    elevation: Array


def _beam(recording: Recording, targets: Targets, times: Array) -> _Beam:
    """Targets in the beam as observed."""
    states = recording.trajectory.earth_fixed(times)
    steering = recording.strip.steer(states)
    line = look_at(states, targets.position).line_of_sight
    outward = off_boresight(steering, math.pi / 2)
    return _Beam(
        doppler=doppler_centroid(states, targets.position, wavelength=recording.wavelength),
        elevation=np.arctan2(dot(line, outward), dot(line, steering.boresight)),
    )


class _Chart(NamedTuple):
    """Ground track and edges of the strip."""

    track: Geodetic
    near: Geodetic
    far: Geodetic


def _chart(recording: Recording, times: Array) -> _Chart:
    """Lines of the map around some moments; NaN where the beam does not reach an edge."""
    window = window_around(
        recording.trajectory, times, period=recording.window.period, revolutions=TRACK_MARGIN
    )
    states = recording.trajectory.earth_fixed(np.linspace(window.start, window.stop, TRACK_POINTS))
    strip = recording.strip
    edges = swath(
        states.position,
        antenna_plane(strip.steer(states), states),
        near=FixedIncidence(strip.near_incidence),
        far=FixedIncidence(strip.far_incidence),
    )
    return _Chart(to_geodetic(states.position), to_geodetic(edges.near), to_geodetic(edges.far))
