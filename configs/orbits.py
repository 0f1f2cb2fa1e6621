"""The block that describes an orbit, and building the trajectory that it stands for."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Strict, Tag, model_validator

from formation import (
    ElementKind,
    Elements,
    Ephemeris,
    KeplerianOrbit,
    Orbit,
    Trajectory,
    TwoLineOrbit,
    raan_from_local_time,
    raan_from_longitude,
    reference_orbit,
)
from formation.constants import EARTH_EQUATORIAL_RADIUS
from formation.keplerian import LOWEST_PERIGEE

from .base import Block, Moment, Number, TimeOfDay, missing, refused, utc, wrong
from .files import File
from .messages import KeyPath

SOURCES = ("tle", "tle_file", "oem_file")
"""Keys that give a whole orbit."""

DEFAULT_EPOCH = utc("2000-01-01T12:00:00Z")
"""Of an orbit that gives none, where only the shape of the orbit matters."""

_Line = Annotated[str, Strict(), Field(min_length=1, max_length=100)]


def _form_of_lines(value: Any) -> str:
    return "list" if isinstance(value, list | tuple) else "text"


class OrbitBlock(Block):
    """An orbit: Keplerian elements, two-line elements, or an ephemeris file."""

    altitude_km: Number | None = Field(
        default=None,
        ge=150,
        le=36_000,
        description="Height above the equatorial radius of the Earth, 6378.137 km.",
    )
    semi_major_axis_km: Number | None = Field(
        default=None,
        ge=6_500,
        le=100_000,
        description="Mean distance from the center of the Earth, instead of altitude_km.",
    )
    inclination_deg: Number | None = Field(
        default=None,
        ge=0,
        le=180,
        description="Angle between the orbit and the equator; above 90 retrograde.",
    )
    eccentricity: Number | None = Field(
        default=None,
        ge=0,
        le=0.9,
        description="0 (default): a circle; then altitude_km is that of the semi-major axis.",
    )
    argument_of_perigee_deg: Number | None = Field(
        default=None,
        ge=-360,
        le=360,
        description="From the ascending node to the perigee; default 0.",
    )
    raan_deg: Number | None = Field(
        default=None,
        ge=-360,
        le=360,
        description="Right ascension of the ascending node, in the true equator and equinox of "
        "the epoch; default 0.",
    )
    node_longitude_deg: Number | None = Field(
        default=None,
        ge=-180,
        le=360,
        description="Longitude on the Earth below the ascending node at the epoch, instead of "
        "raan_deg.",
    )
    node_local_time: TimeOfDay | None = Field(
        default=None,
        description="Local mean solar time of the ascending node, instead of raan_deg; a dusk-dawn "
        "orbit has '18:00'.",
    )
    mean_anomaly_deg: Number | None = Field(
        default=None,
        ge=-360,
        le=360,
        description="Where the satellite is at the epoch, from the perigee.",
    )
    argument_of_latitude_deg: Number | None = Field(
        default=None,
        ge=-360,
        le=360,
        description="Where the satellite is at the epoch, from the ascending node; default 0. Or "
        "give mean_anomaly_deg.",
    )
    epoch: Moment | None = Field(
        default=None,
        description="Moment of the elements (UTC); needed wherever the satellite must be above a "
        "certain place.",
    )
    elements: Literal["mean", "osculating"] | None = Field(
        default=None,
        description="mean (default): freed of the short periods that J2 causes; osculating: of "
        "the moment.",
    )
    j2: Annotated[bool, Strict()] | None = Field(
        default=None,
        description="Whether the flattening of the Earth turns and shakes the orbit: true "
        "(default), or false for an orbit of two bodies.",
    )
    tle: (
        Annotated[
            Annotated[
                Annotated[str, Strict(), Field(max_length=300, examples=["1 25544U 98067A ..."])],
                Tag("text"),
            ]
            | Annotated[
                Annotated[tuple[_Line, ...], Field(min_length=2, max_length=3)], Tag("list")
            ],
            Discriminator(_form_of_lines),
        ]
        | None
    ) = Field(
        default=None,
        description="Two-line elements, with or without a line for the name, instead of all "
        "others.",
    )
    tle_file: File | None = Field(
        default=None, description="File of the two-line elements of one satellite."
    )
    oem_file: File | None = Field(
        default=None,
        description="Ephemeris of one satellite, a CCSDS OEM file in keyword notation (KVN).",
    )

    @property
    def source(self) -> str | None:
        """The key that gives the orbit as a whole, if one does."""
        return next((key for key in SOURCES if getattr(self, key) is not None), None)

    @property
    def is_placed(self) -> bool:
        """Whether it is known where above the Earth the satellite is, and when."""
        return self.source is not None or self.epoch is not None

    @property
    def blamed(self) -> KeyPath:
        """Path in this block of what is to blame if the trajectory does not serve."""
        return () if self.source is None else (self.source,)

    @property
    def semi_major_axis(self) -> float:
        """Semi-major axis of the elements [m]."""
        if self.semi_major_axis_km is not None:
            return 1e3 * self.semi_major_axis_km
        return EARTH_EQUATORIAL_RADIUS + 1e3 * (self.altitude_km or 0.0)

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = [key for key in type(self).model_fields if getattr(self, key) is not None]
        if self.source is None:
            self._check_elements()
        elif len(given) > 1:
            other = next(key for key in given if key != self.source)
            raise wrong(
                (other,), f"contradicts {self.source}, which gives the whole orbit", "keep one"
            )
        if self.tle is not None and (name := _file_named(self.tle)):
            raise wrong(
                ("tle",),
                "looks like the name of a file, and takes the two lines themselves",
                f"write tle_file: {name}",
            )
        try:
            if self.is_placed:
                build_trajectory(self)
            build_reference(self)
        except ValueError as error:
            raise refused(self.blamed, error) from None
        return self

    def _check_elements(self) -> None:
        if self.altitude_km is None and self.semi_major_axis_km is None:
            raise missing("altitude_km")
        if self.inclination_deg is None:
            raise missing("inclination_deg")
        for first, *others in (
            ("altitude_km", "semi_major_axis_km"),
            ("raan_deg", "node_longitude_deg", "node_local_time"),
            ("node_longitude_deg", "node_local_time"),
            ("mean_anomaly_deg", "argument_of_latitude_deg"),
        ):
            for other in others:
                if None not in (getattr(self, first), getattr(self, other)):
                    raise wrong((other,), f"excludes {first}, which says the same", "keep one")
        for key in ("node_longitude_deg", "node_local_time"):
            if getattr(self, key) is not None and self.epoch is None:
                raise wrong(
                    (key,),
                    "needs an epoch, since the Earth turns below the orbit",
                    "add epoch: 2026-11-23T05:07:00Z, the moment that you mean",
                )
        check_perigee(self.semi_major_axis, self.eccentricity or 0.0, ("eccentricity",))


def _file_named(tle: str | tuple[str, ...]) -> str | None:
    """The file that was given in place of two-line elements; None for what may be elements."""
    lines = tle.strip().splitlines() if isinstance(tle, str) else tle
    first = lines[0].strip() if lines else ""
    like_a_name = " " not in first and ("/" in first or "\\" in first or "." in first)
    no_elements = not any(line.startswith(("1 ", "2 ")) for line in lines)
    return first if like_a_name and no_elements else None


def check_perigee(semi_major_axis: float, eccentricity: float, at: KeyPath) -> None:
    """Refuse an orbit that dips into the air.

    Parameters
    ----------
    semi_major_axis, eccentricity : of the orbit [m, 1].
    at : path of the eccentricity, from the block that is checked.
    """
    perigee = (semi_major_axis * (1.0 - eccentricity) - EARTH_EQUATORIAL_RADIUS) / 1e3
    lowest = LOWEST_PERIGEE / 1e3
    if perigee < lowest:
        raise wrong(
            at,
            f"brings the perigee to {perigee:.0f} km, and below {lowest:g} km an orbit decays at "
            "once",
            "choose a smaller eccentricity or a higher orbit",
        )


@lru_cache(maxsize=32)
def build_trajectory(block: OrbitBlock) -> Trajectory:
    """Build the orbit on the real Earth.

    Parameters
    ----------
    block : the orbit; one without an epoch is put at `DEFAULT_EPOCH`.

    Raises
    ------
    ValueError
        If the elements or the file are refused.
    """
    if block.oem_file is not None:
        return Ephemeris.from_oem(block.oem_file.text)
    lines = block.tle if block.tle_file is None else block.tle_file.text
    if lines is not None:
        return TwoLineOrbit.from_text(lines if isinstance(lines, str) else "\n".join(lines))
    epoch = DEFAULT_EPOCH if block.epoch is None else utc(block.epoch)
    eccentricity = block.eccentricity or 0.0
    perigee = math.radians(block.argument_of_perigee_deg or 0.0)
    if block.mean_anomaly_deg is not None:
        anomaly = math.radians(block.mean_anomaly_deg)
    else:
        latitude = math.radians(block.argument_of_latitude_deg or 0.0)
        anomaly = _mean_anomaly(latitude - perigee, eccentricity)
    elements = Elements(
        semi_major_axis=block.semi_major_axis,
        eccentricity=eccentricity,
        inclination=math.radians(block.inclination_deg or 0.0),
        raan=_raan(block),
        argument_of_perigee=perigee,
        mean_anomaly=anomaly,
    )
    kind = ElementKind.OSCULATING if block.elements == "osculating" else ElementKind.MEAN
    return KeplerianOrbit(elements=elements, epoch=epoch, kind=kind, j2=block.j2 is not False)


def build_reference(block: OrbitBlock) -> Orbit:
    """Build the circular orbit that a formation flies around.

    Parameters
    ----------
    block : the orbit; of its mean elements, semi-major axis and inclination count.
    """
    if block.source is None and block.elements != "osculating":
        return Orbit(
            semi_major_axis=block.semi_major_axis,
            inclination=math.radians(block.inclination_deg or 0.0),
        )
    trajectory = build_trajectory(block)
    return reference_orbit(trajectory, max(0.0, trajectory.span[0]))


def _raan(block: OrbitBlock) -> float:
    epoch = DEFAULT_EPOCH if block.epoch is None else utc(block.epoch)
    if block.node_longitude_deg is not None:
        return float(raan_from_longitude(math.radians(block.node_longitude_deg), epoch=epoch))
    if block.node_local_time is not None:
        hours, minutes, seconds = map(int, f"{block.node_local_time}:00".split(":")[:3])
        time_of_day = 3600.0 * hours + 60.0 * minutes + seconds
        return float(raan_from_local_time(time_of_day, epoch=epoch))
    return math.radians(block.raan_deg or 0.0)


def _mean_anomaly(true_anomaly: float, eccentricity: float) -> float:
    """Mean anomaly of a true one, by way of the eccentric anomaly [rad]."""
    root = math.sqrt((1.0 - eccentricity) / (1.0 + eccentricity))
    half = true_anomaly / 2.0
    eccentric = 2.0 * math.atan2(root * math.sin(half), math.cos(half))
    return eccentric - eccentricity * math.sin(eccentric)
