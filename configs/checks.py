"""Checks across the blocks of a study; each raises the error of `base.wrong`."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from formation import Orbit, drift_per_orbit, mean_elements_at, satellite_pairs
from formation.constants import EARTH_EQUATORIAL_RADIUS
from formation.separation import NEGLIGIBLE_DRIFT

from .base import wrong
from .blocks import ErrorsBlock, RadarBlock
from .formations import ComparedFormation, RadialStart, Satellite
from .messages import KeyPath, did_you_mean, show
from .observation import ObservationBlock
from .orbits import OrbitBlock, build_trajectory
from .scenes import SceneBlock, StripBlock, TableBlock, check_slope
from .tables import PlacedSatellite

RESULT_LABELS = ("initial", "best", "formation")
"""Labels that reports give to the formations of the study itself."""

MAX_ENTRIES = 50_000_000
"""Entries of the largest array of a run; a few such arrays of 0.4 GB live at a time."""

_ALTITUDE_MARGIN = 0.97
"""Mountains, and an altitude counted from the equatorial radius, bring targets nearer by this."""

_GRAZING = math.radians(89.0)

_ELLIPSOID_DEG = 0.5
"""What the flattening of the Earth and J2's shaking of the orbit add to an incidence."""


def check_strip(strip: StripBlock, orbit: Orbit) -> None:
    """The strip is seen on the Earth, out of layover and shadow."""
    at: KeyPath = ("scene", "strip")
    ratio = orbit.semi_major_axis / EARTH_EQUATORIAL_RADIUS
    sine = ratio * math.sin(math.radians(strip.look_deg))
    if sine > math.sin(_GRAZING):
        limit = math.degrees(math.asin(math.sin(_GRAZING) / ratio))
        raise wrong(
            (*at, "look_deg"),
            f"misses the Earth or grazes it: from {orbit.altitude / 1e3:g} km it must be at most "
            f"{limit:.2f}",
            "choose a smaller look angle",
        )
    check_slope(strip.slope_deg, (math.degrees(math.asin(sine)),), at)


def check_table(table: TableBlock, orbit: Orbit) -> None:
    """No target is nearer than the ground below the orbit."""
    altitude = orbit.altitude / 1e3
    for segment, slant_range in enumerate(table.slant_range_km):
        if slant_range < _ALTITUDE_MARGIN * altitude:
            raise wrong(
                ("scene", "table", "slant_range_km", segment),
                f"is less than the altitude of the orbit, {altitude:g}",
                "check both, and their units",
            )


def check_observation(observation: ObservationBlock, orbit: OrbitBlock) -> None:
    """The orbit is known above the turning Earth, and its beam meets the ground."""
    check_placed(orbit)
    if observation.look_deg is not None:
        check_beam(observation.look_deg, orbit, ("scene", "observation", "look_deg"))
        _check_look_in_strip(observation, observation.look_deg, orbit)


def _check_look_in_strip(observation: ObservationBlock, look_deg: float, orbit: OrbitBlock) -> None:
    """A look angle meets the ground within the strip, somewhere on the orbit."""
    near, far = observation.near_incidence_deg, observation.far_incidence_deg
    lowest, highest = _apsides(orbit)
    sine = math.sin(math.radians(look_deg)) / EARTH_EQUATORIAL_RADIUS
    low, high = (math.degrees(math.asin(min(1.0, radius * sine))) for radius in (lowest, highest))
    if high + _ELLIPSOID_DEG < near or low - _ELLIPSOID_DEG > far:
        least, most = (
            math.degrees(math.asin(EARTH_EQUATORIAL_RADIUS / radius * math.sin(math.radians(edge))))
            for radius, edge in ((highest, near), (lowest, far))
        )
        reached = f"{low:.1f}" if high - low < 0.1 else f"{low:.1f} to {high:.1f}"
        raise wrong(
            ("scene", "observation", "look_deg"),
            f"meets the ground at an incidence of {reached} degrees, outside the strip, "
            f"near_incidence_deg = {near:g} to far_incidence_deg = {far:g}",
            f"choose a look angle from {least:.1f} to {most:.1f}, or widen the strip",
        )


def _apsides(orbit: OrbitBlock) -> tuple[float, float]:
    """Distances of the mean perigee and apogee from the center of the Earth [m]."""
    if orbit.source is None:
        axis, eccentricity = orbit.semi_major_axis, orbit.eccentricity or 0.0
    else:
        trajectory = build_trajectory(orbit)
        mean = mean_elements_at(trajectory, max(0.0, trajectory.span[0]))
        axis, eccentricity = float(mean.semi_major_axis), float(mean.eccentricity)
    return axis * (1.0 - eccentricity), axis * (1.0 + eccentricity)


def check_placed(orbit: OrbitBlock) -> None:
    """It is known when the satellite is above a target."""
    if not orbit.is_placed:
        raise wrong(
            ("orbit",),
            "lacks an epoch, without which nobody knows when the satellite is above the targets",
            "add epoch: 2026-11-23T05:07:00Z, or give tle, tle_file or oem_file",
        )


def check_beam(look_deg: float, orbit: OrbitBlock, at: KeyPath, *, case: str = "") -> None:
    """A look angle meets the Earth at least from the perigee; of a case, which has this name."""
    if orbit.source is not None:
        return
    perigee = orbit.semi_major_axis * (1.0 - (orbit.eccentricity or 0.0))
    limit = math.degrees(math.asin(min(1.0, EARTH_EQUATORIAL_RADIUS / perigee)))
    if look_deg >= limit:
        altitude = (perigee - EARTH_EQUATORIAL_RADIUS) / 1e3
        where = f" in the case {show(case)}" if case else ""
        raise wrong(
            at,
            f"misses the Earth{where}: from {altitude:g} km it must be below {limit:.2f}",
            "choose a smaller look angle"
            + (", or give the case a boresight of its own" if case else ""),
        )


def check_names(names: Sequence[str]) -> None:
    """No two satellites have one name."""
    for index, name in enumerate(names):
        if name in names[:index]:
            raise wrong(
                ("formation", "satellites", index),
                "is the name of two satellites",
                "give every satellite a name of its own",
            )


def check_images(radar: RadarBlock, names: Sequence[str]) -> None:
    """The images use every satellite of the study and no other."""
    if radar.transmitter is not None:
        check_known(radar.transmitter, names, ("radar", "transmitter"))
    if not isinstance(radar.images, tuple):
        return
    for position, image in enumerate(radar.images):
        for end, name in enumerate(image):
            check_known(name, names, ("radar", "images", position, end))
    idle = [name for name in names if not any(name in image for image in radar.images)]
    if idle:
        raise wrong(
            ("radar", "images"),
            f"leaves out the satellite {show(idle[0])}",
            "add an image that it transmits or receives, or remove the satellite",
        )


def check_known(name: str, names: Sequence[str], at: KeyPath) -> None:
    """A name is that of a satellite."""
    if name not in names:
        raise wrong(
            at,
            "is no satellite of this study",
            f"{did_you_mean(name, names)}the satellites are {', '.join(names)}",
        )


def check_members(
    members: Sequence[RadialStart | Satellite | PlacedSatellite], names: Sequence[str], at: KeyPath
) -> None:
    """The members of a formation are the satellites of the study, named or in its order."""
    if len(members) != len(names):
        raise wrong(
            at,
            f"lists {len(members)} and the study has {len(names)} satellites",
            f"list {', '.join(names)}",
        )
    given = [member.name for member in members if member.name is not None]
    if given and len(given) < len(members):
        raise wrong(at, "names some of the satellites", "name all of them or none")
    for index, name in enumerate(given):
        check_known(name, names, (*at, index, "name"))
        if name in given[:index]:
            raise wrong((*at, index, "name"), "is listed twice", "list each satellite once")


def check_drift(satellites: Sequence[Satellite], orbit: Orbit, at: KeyPath) -> None:
    """No two satellites drift apart along track."""
    # A satellite of a family is drift-free, as the zero state is.
    states = np.zeros((len(satellites), 6))
    for row, satellite in zip(states, satellites, strict=True):
        if satellite.state is not None:
            row[:] = satellite.state
    drift = drift_per_orbit(states, mean_motion=orbit.mean_motion)
    pairs = satellite_pairs(len(satellites))
    relative = np.abs(drift[pairs[:, 1]] - drift[pairs[:, 0]])
    worst = int(np.argmax(relative))
    if relative[worst] <= NEGLIGIBLE_DRIFT:
        return
    one, two = (int(index) for index in pairs[worst])
    # Of the two, blame the one that drifts more against the reference orbit.
    blamed, other = (one, two) if abs(drift[one]) > abs(drift[two]) else (two, one)
    drift_free = -2.0 * orbit.mean_motion * states[blamed, 0]
    raise wrong(
        (*at, blamed, "velocity_rtn_m_s"),
        f"drifts {relative[worst]:.3g} m per orbit along track against satellite {other + 1}, and "
        f"{NEGLIGIBLE_DRIFT:g} m is the limit",
        f"the T component of a drift-free velocity is -2 n R, here {drift_free:.6f}",
    )


def check_size(radar: RadarBlock, scene: SceneBlock, satellites: int, population: int) -> None:
    """The arrays of one generation fit into the memory of an ordinary computer."""
    segments = scene.given.count
    if isinstance(radar.images, tuple):
        images = len(radar.images)
    else:
        images = satellites**2 if radar.images == "ping_pong" else satellites
    if population * segments * images**2 > MAX_ENTRIES:
        raise wrong(
            ("scene",),
            f"has {segments} segments, which with {images} images and {population} formations at a "
            f"time is too large for memory: formations x segments x images squared may reach "
            f"{MAX_ENTRIES:.0e}",
            "take fewer segments, or a smaller search.population or fewer search.islands",
        )


def check_shell(errors: ErrorsBlock, orbit: Orbit) -> None:
    """The ionosphere lies below the satellites."""
    ionosphere = errors.ionosphere
    if ionosphere is not None and 1e3 * ionosphere.shell_height_km >= orbit.altitude:
        raise wrong(
            ("errors", "ionosphere", "shell_height_km"),
            f"is not below the orbit at {orbit.altitude / 1e3:g} km, so that no ray passes it",
            "take about 350, and count the electrons below the satellites only",
        )


def check_labels(compared: Sequence[ComparedFormation]) -> None:
    """No two formations of the report have one label."""
    labels = [formation.label for formation in compared]
    for index, label in enumerate(labels):
        if label in RESULT_LABELS:
            raise wrong(
                ("compare", index, "label"), "is what the result is called", "choose another label"
            )
    for index, label in enumerate(labels):
        if label in labels[:index]:
            raise wrong(("compare", index, "label"), "is used twice", "choose another label")
