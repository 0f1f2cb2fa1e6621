"""The blocks of a study of attitude steering."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from formation.constants import EARTH_EQUATORIAL_RADIUS, EARTH_GRAVITATIONAL_PARAMETER

from .base import Block, Label, Number, Whole, missing, wrong
from .observation import Incidence, LawName, LookAngle, SideName
from .orbits import OrbitBlock, check_perigee

LAWS: tuple[LawName, ...] = ("none", "yaw", "yaw_pitch_approximate", "yaw_pitch", "pitch_roll")

_Altitude = Annotated[Number, Field(ge=150, le=50_000)]
_Inclination = Annotated[Number, Field(ge=0, le=180)]
_Eccentricity = Annotated[Number, Field(ge=0, le=0.9)]
_Perigee = Annotated[Number, Field(ge=-360, le=360)]
SwathOffset = Annotated[Number, Field(ge=-20, le=20)]

Laws = Annotated[tuple[LawName, ...], Field(min_length=1, max_length=len(LAWS))]


class SteeredRadarBlock(Block):
    """The radar whose Doppler is steered."""

    wavelength_m: Number = Field(
        ge=0.002, le=2, description="Carrier wavelength; X band is 0.031, L band 0.24."
    )


class BoresightBlock(Block):
    """What the beam's center holds constant around the orbit."""

    incidence_deg: Incidence | None = Field(
        default=None, description="Incidence on the ellipsoid, held constant."
    )
    look_deg: LookAngle | None = Field(
        default=None, description="Angle from the geocentric nadir, held constant."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.incidence_deg is None) == (self.look_deg is None):
            raise wrong(
                (),
                "needs exactly one of incidence_deg and look_deg",
                "add incidence_deg: 35" if self.look_deg is None else "remove one of them",
            )
        return self


def check_laws(laws: tuple[LawName, ...]) -> None:
    """No law is listed twice."""
    for position, law in enumerate(laws):
        if law in laws[:position]:
            raise wrong(("laws", position), "is listed twice", "list each law once")


class CaseBlock(Block):
    """One orbit on which the laws are compared."""

    name: Label = Field(description="What the report calls it.")
    orbit: OrbitBlock = Field(description="The orbit.")
    side: SideName | None = Field(
        default=None, description="Side of the flight direction; that of the study if absent."
    )
    boresight: BoresightBlock | None = Field(
        default=None, description="What is held constant; as the study has it if absent."
    )
    laws: Laws | None = Field(
        default=None, description="Laws to compare; those of the study if absent."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_laws(self.laws or ())
        return self


class SelectionBlock(Block):
    """Yaw-pitch against pitch-roll steering, over altitude and inclination."""

    held: Literal["look", "incidence"] = Field(
        description="What is the same at all altitudes: the look angle or the incidence."
    )
    angle_deg: Incidence = Field(description="The angle that is held.")
    altitudes_km: tuple[_Altitude, _Altitude] = Field(
        default=(500, 36_000),
        description="Of the semi-major axis above the equatorial radius: from, to.",
    )
    altitude_samples: Whole = Field(
        default=72, ge=2, le=500, description="Altitudes between the two, equally spaced."
    )
    inclinations_deg: Annotated[tuple[_Inclination, ...], Field(min_length=1, max_length=12)] = (
        Field(description="Inclinations, a curve each.")
    )
    eccentricity: _Eccentricity = Field(default=0.0, description="Of all orbits.")
    argument_of_perigee_deg: _Perigee = Field(
        default=90.0, description="From the ascending node to the perigee, of all orbits."
    )
    side: SideName | None = Field(
        default=None, description="Side of the flight direction; that of the study if absent."
    )
    samples: Whole = Field(
        default=361, ge=9, le=10_001, description="Samples of a revolution, evenly in time."
    )
    slew_rate_deg_s: Number = Field(
        default=0.02,
        gt=0,
        le=10,
        description="Rate at which the satellite can turn, for the slew times.",
    )
    swath_offset_deg: Annotated[Number, Field(gt=0, le=20)] = Field(
        default=0.5, description="Elevation off the boresight at which the price is counted."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        low, high = self.altitudes_km
        if low >= high:
            raise wrong(
                ("altitudes_km",), "must grow: from, to", "check that the two are not swapped"
            )
        lowest = EARTH_EQUATORIAL_RADIUS + 1e3 * low
        check_perigee(lowest, self.eccentricity, ("eccentricity",))
        for position, inclination in enumerate(self.inclinations_deg):
            if inclination in self.inclinations_deg[:position]:
                raise wrong(
                    ("inclinations_deg", position), "is listed twice", "list each inclination once"
                )
        # The beam must meet the Earth all around the orbit, from the apogee too.
        apogee = lowest * (1.0 + self.eccentricity)
        limit = math.degrees(math.asin(EARTH_EQUATORIAL_RADIUS / apogee))
        if self.held == "look" and self.angle_deg >= limit:
            raise wrong(
                ("angle_deg",),
                f"misses the Earth at all of the altitudes_km: from the lowest, {low:g} km, it "
                f"must be below {limit:.2f}",
                "choose a smaller look angle, or hold the incidence",
            )
        return self


class CompensationBlock(Block):
    """How much of the Doppler the simplified yaw law of Meng 2003 compensates."""

    altitude_km: _Altitude | None = Field(
        default=None, description="Height above the equatorial radius of the Earth, 6378.137 km."
    )
    semi_major_axis_km: Annotated[Number, Field(ge=6_500, le=100_000)] | None = Field(
        default=None, description="Instead of altitude_km."
    )
    period_min: Annotated[Number, Field(ge=86, le=6_000)] | None = Field(
        default=None, description="Time of one revolution, instead of altitude_km."
    )
    inclination_deg: _Inclination = Field(
        description="Angle between the orbit and the equator; above 90 retrograde."
    )
    look_deg: LookAngle = Field(description="Look angle of the beam's center.")
    side: SideName = Field(default="right", description="Side of the flight direction.")
    eccentricity: _Eccentricity = Field(
        default=0.002, description="Of the orbit whose effects are shown one by one."
    )
    arguments_of_perigee_deg: Annotated[tuple[_Perigee, ...], Field(min_length=1, max_length=4)] = (
        Field(
            default=(0, 90),
            description="Arguments of perigee for which they are shown; the sweep takes the first.",
        )
    )
    eccentricities: tuple[_Eccentricity, _Eccentricity] = Field(
        default=(0, 0.005), description="Eccentricities that are swept: from, to."
    )
    eccentricity_samples: Whole = Field(
        default=51, ge=2, le=1000, description="Eccentricities between the two, equally spaced."
    )
    samples: Whole = Field(
        default=721,
        ge=9,
        le=100_001,
        description="Samples of a revolution, evenly in the true anomaly.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        sizes = ("altitude_km", "semi_major_axis_km", "period_min")
        given = [key for key in sizes if getattr(self, key) is not None]
        if not given:
            raise missing("altitude_km")
        if len(given) > 1:
            raise wrong((given[1],), f"excludes {given[0]}, which says the same", "keep one")
        first, last = self.eccentricities
        if first >= last:
            raise wrong(
                ("eccentricities",), "must grow: from, to", "check that the two are not swapped"
            )
        for key, eccentricity in (("eccentricity", self.eccentricity), ("eccentricities", last)):
            check_perigee(self.semi_major_axis, eccentricity, (key,))
        return self

    @property
    def semi_major_axis(self) -> float:
        """Of the orbit, however its size is given [m]."""
        if self.period_min is not None:
            mean_motion = 2.0 * math.pi / (60.0 * self.period_min)
            return math.cbrt(EARTH_GRAVITATIONAL_PARAMETER / mean_motion**2)
        if self.semi_major_axis_km is not None:
            return 1e3 * self.semi_major_axis_km
        return EARTH_EQUATORIAL_RADIUS + 1e3 * (self.altitude_km or 0.0)
