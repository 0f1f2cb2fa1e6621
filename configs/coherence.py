"""The blocks of the coherence budget, of a radar's beams and of the backscatter."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Self

from pydantic import Field, model_validator

from .base import Block, Number, Whole, wrong

Incidence = Annotated[Number, Field(ge=2, le=89)]
Sigma0 = Annotated[Number, Field(ge=-60, le=30)]


class BeamBlock(Block):
    """What a radar's beam offers at one incidence."""

    incidence_deg: Incidence = Field(description="Incidence on flat ground.")
    nesz_db: Number = Field(ge=-80, le=20, description="Noise-equivalent backscatter there.")
    rasr_db: Number | None = Field(
        default=None, ge=-80, le=0, description="Range ambiguities over the signal; or none."
    )
    aasr_db: Number | None = Field(
        default=None, ge=-80, le=0, description="Azimuth ambiguities over the signal; or none."
    )
    swath_km: Number | None = Field(
        default=None,
        ge=1,
        le=1000,
        description="Extent across track on the ground; where dem and errors.calibration give "
        "none, the narrowest of the segments counts.",
    )


class BackscatterBlock(Block):
    """Backscatter of the ground over the local incidence."""

    incidence_deg: tuple[Incidence, ...] = Field(
        min_length=2, max_length=200, description="Incidences of the table, increasing."
    )
    sigma0_db: tuple[Sigma0, ...] | None = Field(
        default=None,
        min_length=2,
        max_length=200,
        description="Normalized radar cross-section at each; or give quantiles.",
    )
    sigma0_quantiles_db: dict[Annotated[str, Field(max_length=6)], tuple[Sigma0, ...]] | None = (
        Field(
            default=None,
            min_length=1,
            max_length=20,
            description="The same for each quantile of the scene, by its name: {p10: [...], "
            "p50: [...]}.",
        )
    )
    quantile: Annotated[str, Field(max_length=6)] | None = Field(
        default=None, description="Name of the quantile to count with."
    )

    @property
    def chosen_db(self) -> tuple[float, ...]:
        """Backscatter at each incidence [dB]."""
        if self.sigma0_quantiles_db is None:
            return self.sigma0_db or ()
        return self.sigma0_quantiles_db[self.quantile or ""]

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_increasing(self.incidence_deg, "incidence_deg")
        if (self.sigma0_db is None) == (self.sigma0_quantiles_db is None):
            raise wrong(
                (), "needs exactly one of sigma0_db and sigma0_quantiles_db", "keep or add one"
            )
        columns = self.sigma0_quantiles_db or {}
        if self.sigma0_quantiles_db is None and self.quantile is not None:
            raise wrong(("quantile",), "is only for sigma0_quantiles_db", "remove it")
        if self.sigma0_quantiles_db is not None and self.quantile not in columns:
            raise wrong(
                (),
                f"lacks the quantile to count with, of {', '.join(columns)}",
                f"set quantile: {next(iter(columns))}",
            )
        if len(self.chosen_db) != len(self.incidence_deg):
            raise wrong(
                (),
                f"has {len(self.chosen_db)} backscatters for {len(self.incidence_deg)} incidences",
                "give one for each",
            )
        return self


def check_increasing(incidence_deg: tuple[float, ...], key: str) -> None:
    """Refuse a table whose incidences do not increase.

    Parameters
    ----------
    incidence_deg : of the table.
    key : where it stands.
    """
    for index, (before, after) in enumerate(pairwise(incidence_deg), 1):
        if after <= before:
            raise wrong((key, index), f"does not exceed the one before, {before:g}", "sort them")


class ProfileBlock(Block):
    """Backscattered power at heights of your own."""

    heights_m: tuple[Annotated[Number, Field(ge=-1000, le=1000)], ...] = Field(
        min_length=1, max_length=1000, description="Heights of the scatterers above the ground."
    )
    powers: tuple[Annotated[Number, Field(ge=0, le=1e12)], ...] = Field(
        min_length=1, max_length=1000, description="What each returns, on any scale."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if len(self.heights_m) != len(self.powers):
            raise wrong(
                ("powers",),
                f"has {len(self.powers)} entries and heights_m has {len(self.heights_m)}",
                "give each height one power",
            )
        if not any(self.powers):
            raise wrong(("powers",), "are all zero", "give one of them a power")
        return self


class VolumeBlock(Block):
    """Scatterers spread in height: decorrelation, and a bias of the height."""

    height_m: Number | None = Field(
        default=None, ge=0, le=200, description="Height of a layer (forest) above the ground."
    )
    extinction_db_m: Number = Field(
        default=0.0,
        ge=0,
        le=100,
        description="One-way extinction in that layer; 0: equal power from every height.",
    )
    penetration_m: Number | None = Field(
        default=None,
        ge=0,
        le=1000,
        description="Vertical two-way penetration depth into snow, ice or sand; instead.",
    )
    profile: ProfileBlock | None = Field(
        default=None, description="A profile of your own; instead."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = (self.height_m, self.penetration_m, self.profile)
        if sum(value is not None for value in given) != 1:
            raise wrong(
                (),
                "needs exactly one of height_m, penetration_m and profile",
                "keep one of them" if any(given) else "add height_m: 10",
            )
        if self.extinction_db_m > 0.0 and self.height_m is None:
            raise wrong(("extinction_db_m",), "is only for a layer of height_m", "remove it")
        return self


class TemporalBlock(Block):
    """Loss of coherence between images that are not taken at one moment."""

    time_constant_s: Number = Field(
        gt=0, le=1e10, description="Time after which 1/e of what can be lost is left."
    )
    lasting: Number = Field(
        default=0.0, ge=0, le=1, description="Share of the coherence that time never takes."
    )
    image_times_s: tuple[Annotated[Number, Field(ge=-1e10, le=1e10)], ...] | None = Field(
        default=None,
        min_length=2,
        max_length=400,
        description="When each image is taken, in the order of the images; one moment if absent. "
        "Monostatic images add the time by which their satellites follow each other.",
    )


class CoherenceBlock(Block):
    """Factors of the coherence beside noise and baselines; a factor left out is neglected."""

    quantization_bits: Whole | None = Field(
        default=None, ge=1, le=8, description="Bits of a raw sample's I and Q, block-adaptive."
    )
    rasr_db: Number | None = Field(
        default=None, ge=-80, le=0, description="Range ambiguities over the signal; or in beams."
    )
    aasr_db: Number | None = Field(
        default=None, ge=-80, le=0, description="Azimuth ambiguities over the signal; or in beams."
    )
    coregistration_range_cells: Number = Field(
        default=0.0, ge=0, le=0.9, description="Co-registration error in range."
    )
    coregistration_azimuth_cells: Number = Field(
        default=0.0, ge=0, le=0.9, description="Co-registration error in azimuth."
    )
    processing: Number = Field(
        default=1.0, gt=0, le=1, description="Coherence that interpolation and focusing leave."
    )
    image_snr_db: tuple[Annotated[Number, Field(ge=-60, le=60)], ...] | None = Field(
        default=None,
        min_length=2,
        max_length=400,
        description="Signal-to-noise ratio of each image over that of the radar, in the order of "
        "the images: unlike antennas.",
    )
    volume: VolumeBlock | None = Field(
        default=None, description="Scatterers spread in height; absent: a surface."
    )
    temporal: TemporalBlock | None = Field(
        default=None, description="Change of the scene between images; absent: none."
    )
