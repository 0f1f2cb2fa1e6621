"""The block of a printed figure that a study of steering checks."""

from __future__ import annotations

import math
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from .base import Label, Number, wrong
from .messages import show
from .observation import LawName
from .printed import PrintedBlock

QuantityName = Literal[
    "largest_yaw",
    "largest_pitch",
    "largest_roll",
    "largest_angle",
    "largest_residual_doppler",
    "largest_swath_doppler",
    "slew_time",
    "slew_ratio",
    "rate_ratio",
    "crossover_altitude",
    "ellipsoid_effect",
    "compensation",
    "deviation_slope",
]
EffectName = Literal["earth_shape", "j2", "eccentricity", "all"]


class Meaning(NamedTuple):
    """What a quantity is counted in, and which other keys its claim needs and may have.

    Attributes
    ----------
    unit : of `value` and `tolerance`; empty for a pure number.
    scale : factor from this unit to SI.
    needs, may : keys of the claim.
    """

    unit: str
    scale: float
    needs: tuple[str, ...] = ()
    may: tuple[str, ...] = ()


_DEGREE = math.radians(1.0)
_OF_A_LAW = ("case", "law")
_OF_TWO_LAWS = ("case", "law", "other_law")

MEANINGS: dict[QuantityName, Meaning] = {
    "largest_yaw": Meaning("°", _DEGREE, _OF_A_LAW),
    "largest_pitch": Meaning("°", _DEGREE, _OF_A_LAW),
    "largest_roll": Meaning("°", _DEGREE, _OF_A_LAW),
    "largest_angle": Meaning("°", _DEGREE, _OF_A_LAW),
    "largest_residual_doppler": Meaning("Hz", 1.0, _OF_A_LAW),
    "largest_swath_doppler": Meaning("Hz", 1.0, _OF_A_LAW),
    "slew_time": Meaning("min", 60.0, (*_OF_A_LAW, "rate_deg_s")),
    "slew_ratio": Meaning("", 1.0, _OF_TWO_LAWS),
    "rate_ratio": Meaning("", 1.0, _OF_TWO_LAWS),
    "crossover_altitude": Meaning("km", 1e3, ("held", "inclination_deg")),
    "ellipsoid_effect": Meaning("m/s", 1.0),
    "compensation": Meaning("%", 0.01, may=("effect", "eccentricity", "argument_of_perigee_deg")),
    "deviation_slope": Meaning("m/s", 1.0),
}
"""What each quantity of a claim means."""


class ClaimBlock(PrintedBlock):
    """A printed figure of steering, and what it is compared with."""

    quantity: QuantityName = Field(
        description="What is computed: largest_yaw, _pitch, _roll and _angle in degrees, "
        "largest_residual_doppler and _swath_doppler in Hz (of the law none: the unsteered "
        "Doppler), slew_time in minutes, "
        "slew_ratio and rate_ratio, crossover_altitude in km, ellipsoid_effect and deviation_slope "
        "(per unit of eccentricity) in m/s of range rate, compensation in percent."
    )
    case: Label | None = Field(default=None, description="Name of the case that is meant.")
    law: LawName | None = Field(default=None, description="The law that is meant.")
    other_law: LawName | None = Field(
        default=None, description="Of a ratio: the law that is divided by."
    )
    rate_deg_s: Annotated[Number, Field(gt=0, le=10)] | None = Field(
        default=None, description="Of a slew time: the rate at which the satellite turns."
    )
    held: Literal["look", "incidence"] | None = Field(
        default=None, description="Of a crossover: which selection, by what it holds."
    )
    inclination_deg: Annotated[Number, Field(ge=0, le=180)] | None = Field(
        default=None, description="Of a crossover: which inclination of the selection."
    )
    effect: EffectName | None = Field(
        default=None, description="Of a compensation: which effect is switched on."
    )
    eccentricity: Annotated[Number, Field(ge=0, le=0.9)] | None = Field(
        default=None, description="Of a compensation: which eccentricity of the sweep, instead."
    )
    argument_of_perigee_deg: Annotated[Number, Field(ge=-360, le=360)] | None = Field(
        default=None,
        description="Of a compensation under an effect: which argument of perigee; the worst of "
        "all if absent.",
    )

    @property
    def meaning(self) -> Meaning:
        """Unit of the quantity, and the keys that belong to it."""
        return MEANINGS[self.quantity]

    @model_validator(mode="after")
    def _check(self) -> Self:
        needs, may = self.meaning.needs, self.meaning.may
        optional = {key for meaning in MEANINGS.values() for key in (*meaning.needs, *meaning.may)}
        for key in type(self).model_fields:
            absent = getattr(self, key) is None
            if key in needs and absent:
                raise wrong(
                    (), f"lacks {key}, which {self.quantity} needs", f"add {' and '.join(needs)}"
                )
            if key in optional.difference(needs, may) and not absent:
                raise wrong((key,), f"has no meaning for {self.quantity}", "remove it")
        if self.quantity == "compensation" and (self.effect is None) == (self.eccentricity is None):
            raise wrong(
                (),
                "needs exactly one of effect and eccentricity",
                "add one of them" if self.effect is None else "remove one of them",
            )
        if self.other_law is not None and self.other_law == self.law:
            raise wrong(
                ("other_law",), f"is also the law {show(self.law)}", "compare it with another"
            )
        return self
