"""The blocks that describe the instrument: radar and errors."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .base import Block, Name, Number, wrong
from .coherence import BeamBlock, CoherenceBlock
from .systematic import CalibrationBlock, IonosphereBlock, ScaleWord, TroposphereBlock


def _form_of_images(value: Any) -> str:
    return "list" if isinstance(value, list | tuple) else "word"


ImagePattern = Literal["one_transmitter", "monostatic", "ping_pong"]
ImageList = Annotated[tuple[tuple[Name, Name], ...], Field(min_length=2, max_length=400)]


class RadarBlock(Block):
    """The radar, and which satellites transmit and receive each image."""

    wavelength_m: Number = Field(
        ge=0.002, le=2, description="Carrier wavelength; X band is 0.031, L band 0.24."
    )
    slant_range_resolution_m: Number = Field(
        ge=0.05, le=200, description="Resolution along the line of sight: c/2B, not on the ground."
    )
    azimuth_resolution_m: Number | None = Field(
        default=None,
        ge=0.05,
        le=200,
        description="Resolution along track, on the ground: the band that images keep in common "
        "when they are apart along track, and the looks of a posting; absent: along-track "
        "separations cost no coherence.",
    )
    doppler_bandwidth_hz: Number | None = Field(
        default=None,
        ge=1,
        le=1e6,
        description="Processed Doppler bandwidth; instead of azimuth_resolution_m, which follows "
        "from it and the speed of the zero-Doppler line on the ground.",
    )
    looks: Number = Field(
        default=1.0,
        ge=1,
        le=10_000,
        description="Independent looks averaged in an interferogram; need not be whole.",
    )
    snr_db: Number | None = Field(
        default=None,
        ge=-20,
        le=40,
        description="Signal-to-noise ratio of an image; or give nesz_db and backscatter_db.",
    )
    nesz_db: Number | None = Field(
        default=None,
        ge=-80,
        le=20,
        description="Noise-equivalent backscatter; together with backscatter_db instead of snr_db.",
    )
    backscatter_db: Number | None = Field(
        default=None,
        ge=-60,
        le=30,
        description="Normalized radar cross-section of the ground; together with nesz_db.",
    )
    beams: tuple[BeamBlock, ...] | None = Field(
        default=None,
        min_length=2,
        max_length=200,
        description="Noise and ambiguities over the incidence, interpolated in dB; instead of "
        "nesz_db.",
    )
    other_coherence: Number = Field(
        default=1.0,
        gt=0,
        le=1,
        description="Coherence left by what errors.coherence does not name, the same in every "
        "pair.",
    )
    images: Annotated[
        Annotated[ImagePattern, Tag("word")] | Annotated[ImageList, Tag("list")],
        Discriminator(_form_of_images),
    ] = Field(
        default="one_transmitter",
        description="Who transmits and receives: one_transmitter (all receive), monostatic (each "
        "its own echo), ping_pong (all transmit in turn, all receive), or a list of "
        "[transmitter, receiver] satellite names.",
    )
    transmitter: Name | None = Field(
        default=None,
        description="Satellite that transmits, with images: one_transmitter; the first if absent.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if None not in (self.azimuth_resolution_m, self.doppler_bandwidth_hz):
            raise wrong(
                ("doppler_bandwidth_hz",),
                "excludes azimuth_resolution_m, which says the same",
                "keep one of them",
            )
        if self.snr_db is not None and (self.nesz_db, self.backscatter_db) != (None, None):
            raise wrong(
                ("snr_db",),
                "excludes nesz_db and backscatter_db, which also give the signal-to-noise ratio",
                "keep snr_db, or the other two",
            )
        if self.beams is not None:
            if self.snr_db is not None or self.nesz_db is not None:
                raise wrong(
                    ("beams",),
                    "excludes snr_db and nesz_db: it gives the noise itself",
                    "keep one of them",
                )
            for index in range(1, len(self.beams)):
                if self.beams[index].incidence_deg <= self.beams[index - 1].incidence_deg:
                    raise wrong(
                        ("beams", index, "incidence_deg"),
                        f"does not exceed the one before, {self.beams[index - 1].incidence_deg:g}",
                        "sort the beams",
                    )
        elif self.snr_db is None and self.nesz_db is None:
            raise wrong(
                (),
                "lacks the signal-to-noise ratio",
                "add snr_db (-20 to 40), or both nesz_db and backscatter_db",
            )
        if self.transmitter is not None and self.images != "one_transmitter":
            raise wrong(
                ("transmitter",),
                "is only for images: one_transmitter",
                "remove it, or set images: one_transmitter",
            )
        if isinstance(self.images, tuple):
            self._check_list(self.images)
        return self

    @staticmethod
    def _check_list(images: tuple[tuple[str, str], ...]) -> None:
        for position, image in enumerate(images):
            if image in images[:position]:
                raise wrong(("images", position), "is listed twice", "list each image once")
        if len({tuple(sorted(image)) for image in images}) < 2:
            raise wrong(
                ("images",),
                "are two images with one phase center, between the same satellites",
                "add an image with another transmitter or receiver",
            )


class ErrorsBlock(Block):
    """How large each error is, who shares it, and what the estimate takes for independent."""

    preset: Literal["li2009"] | None = Field(
        default=None,
        description="li2009: the covariance that reproduces Li 2009 (pairs, azimuth independent "
        "in each pair, no decorrelation); the other keys override it, but for weighting.",
    )
    position_m: Number | None = Field(
        default=None,
        ge=0,
        le=1,
        description="Standard deviation of the relative position, per satellite and axis. "
        "Required without a preset; 0 neglects it.",
    )
    position_shared_by: Literal["satellite", "pair"] | None = Field(
        default=None,
        description="satellite (default): one error in all images of a satellite; pair: an "
        "independent one in each pair.",
    )
    position_scale: ScaleWord | None = Field(
        default=None,
        description="How far it stays the same: scene (default), data_take, orbit, mission; "
        "pixel: random.",
    )
    azimuth_on_ground_m: Number | None = Field(
        default=None,
        ge=0,
        le=10_000,
        description="Standard deviation of the target's place along track; turned into an angle "
        "by the mean slant range (by its ground part with held_constant: azimuth). Or give "
        "azimuth_deg.",
    )
    azimuth_deg: Number | None = Field(
        default=None,
        ge=0,
        le=1,
        description="Standard deviation of the target's azimuth as an angle; 0.0001 is about 1 m "
        "on the ground from low orbit.",
    )
    azimuth_shared_by: Literal["all", "pair"] | None = Field(
        default=None,
        description="all (default): there is one target, so one error; pair: Li 2009's form.",
    )
    azimuth_scale: ScaleWord | None = Field(
        default=None,
        description="How far it stays the same: scene (default), data_take, orbit, mission; "
        "pixel: random.",
    )
    range_m: Number | None = Field(
        default=None,
        ge=0,
        le=1000,
        description="Standard deviation of the slant range, common to all images; default 0.",
    )
    range_scale: ScaleWord | None = Field(
        default=None,
        description="How far it stays the same: scene (default), data_take, orbit, mission; "
        "pixel: random.",
    )
    synchronization_deg: Number | None = Field(
        default=None,
        ge=0,
        le=180,
        description="Residual phase of each bistatic link; default 0. TanDEM-X stays below 1.",
    )
    synchronization_shared_by: Literal["image", "pair"] | None = Field(
        default=None, description="image (default): each image has its own; pair: each pair."
    )
    synchronization_scale: ScaleWord | None = Field(
        default=None,
        description="How far it stays the same: scene (default), data_take, orbit, mission; "
        "pixel: random.",
    )
    troposphere: TroposphereBlock | None = Field(
        default=None, description="The differential troposphere; absent: neglected."
    )
    ionosphere: IonosphereBlock | None = Field(
        default=None, description="The differential ionosphere; absent: neglected."
    )
    calibration: CalibrationBlock | None = Field(
        default=None,
        description="Adjustment of the heights to control points; leaves the height error of the "
        "search alone and acts on the relative and absolute errors at 90 %.",
    )
    weighting: Literal["joint", "pairs"] | None = Field(
        default=None,
        description="joint (default): the images by their Fisher information; pairs: every pair "
        "as if measured apart, which promises more than is possible.",
    )
    baseline_decorrelation: Literal["filtered", "unfiltered", "none"] | None = Field(
        default=None,
        description="What a baseline costs: filtered (default): looks, by range spectral "
        "filtering; unfiltered: coherence; none: neglected.",
    )
    coherence: CoherenceBlock | None = Field(
        default=None,
        description="Quantization, ambiguities, co-registration, volume, time; absent: neglected.",
    )
    held_constant: Literal["doppler", "azimuth"] | None = Field(
        default=None,
        description="What a target keeps while its height changes: doppler (default), as in a "
        "SAR image; azimuth: Li 2009's form.",
    )
    phase_statistics: Literal["exact", "cramer_rao"] | None = Field(
        default=None,
        description="What phase noise follows from coherence and looks by: exact (default), the "
        "multilook distribution; cramer_rao: its bound, met at many looks.",
    )
    phase_std_deg: Number | None = Field(
        default=None,
        gt=0,
        le=180,
        description="Phase noise of every pair, whatever its coherence; needs weighting: pairs.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.preset is None and self.position_m is None:
            raise wrong(
                (),
                "lacks position_m, the relative position error per satellite and axis, 0 to 1 m",
                "add position_m: 0.001 for 1 mm, or 0 to neglect it",
            )
        if self.azimuth_deg is not None and self.azimuth_on_ground_m is not None:
            raise wrong(
                ("azimuth_deg",), "excludes azimuth_on_ground_m, the same error", "keep one"
            )
        if self.preset is not None and self.weighting == "joint":
            raise wrong(
                ("weighting",),
                "contradicts the preset li2009, which weighs pairs",
                "remove it, or remove the preset and write the errors out",
            )
        noiseless = self.preset is not None or self.phase_std_deg is not None
        if self.coherence is not None and noiseless:
            raise wrong(
                ("coherence",),
                "has no effect where the phase noise itself is given (preset li2009, "
                "phase_std_deg)",
                "remove it, or what gives the phase noise",
            )
        pairwise = self.preset is not None or self.weighting == "pairs"
        for key in ("position_shared_by", "azimuth_shared_by", "synchronization_shared_by"):
            if getattr(self, key) == "pair" and not pairwise:
                raise wrong(
                    (key,),
                    "is possible only with weighting: pairs, since joint weighs images",
                    "set weighting: pairs, or remove this key",
                )
        stated = self.preset is not None or self.phase_std_deg is not None
        if self.phase_statistics is not None and stated:
            raise wrong(
                ("phase_statistics",),
                "has no effect where the phase noise is stated, by phase_std_deg or the preset",
                "remove it, or state the errors without a preset and without phase_std_deg",
            )
        if self.phase_std_deg is not None and not pairwise:
            raise wrong(
                ("phase_std_deg",),
                "is the noise of a pair and possible only with weighting: pairs",
                "set weighting: pairs, or remove this key",
            )
        return self
