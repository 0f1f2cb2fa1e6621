"""The block that describes a scene as a radar on a real orbit observes it."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .base import Block, Moment, Number, Whole, wrong
from .files import File

LawName = Literal["none", "yaw", "yaw_pitch_approximate", "yaw_pitch", "pitch_roll"]
SideName = Literal["left", "right"]

_TARGETS = ("points", "geojson_file", "latitude_deg", "argument_of_latitude_deg")
_BANDS = ("latitude_deg", "argument_of_latitude_deg")
_ANGLES = ("incidence_deg", "look_deg")
_ONLY_FOR = {
    "samples": ("geojson_file",),
    "height_m": ("geojson_file",),
    "segments": _BANDS,
    "pass_number": ("points", "geojson_file"),
}
_SAMPLES, _SEGMENTS = 25, 10

Latitude = Annotated[Number, Field(ge=-90, le=90)]
Height = Annotated[Number, Field(ge=-500, le=9_000)]
Incidence = Annotated[Number, Field(ge=1, le=85)]
LookAngle = Annotated[Number, Field(ge=1, le=80)]


class TargetPoint(Block):
    """A place on the ground."""

    latitude_deg: Latitude = Field(description="Geodetic latitude (WGS84), north positive.")
    longitude_deg: Annotated[Number, Field(ge=-180, le=360)] = Field(
        description="Longitude, east positive."
    )
    height_m: Height = Field(default=0.0, description="Height above the WGS84 ellipsoid.")


class ObservationBlock(Block):
    """Targets on the real Earth, observed in strip mode from the study's orbit."""

    points: tuple[TargetPoint, ...] | None = Field(
        default=None, min_length=1, max_length=1000, description="Targets, place by place."
    )
    geojson_file: File | None = Field(
        default=None,
        description="File with the outline of an area: GeoJSON, Polygon or MultiPolygon, "
        "longitude and latitude on WGS84.",
    )
    samples: Whole | None = Field(
        default=None,
        ge=1,
        le=1000,
        description="About how many targets are spread over the area of geojson_file; default "
        f"{_SAMPLES}.",
    )
    height_m: Height | None = Field(
        default=None,
        description="Height of the area of geojson_file above the ellipsoid; default 0.",
    )
    latitude_deg: tuple[Latitude, Latitude] | None = Field(
        default=None, description="Latitudes that the boresight sweeps: from, to."
    )
    argument_of_latitude_deg: (
        tuple[Annotated[Number, Field(ge=-360, le=720)], Annotated[Number, Field(ge=-360, le=720)]]
        | None
    ) = Field(
        default=None,
        description="An arc of the orbit, counted from the ascending node: from, to.",
    )
    segments: Whole | None = Field(
        default=None,
        ge=1,
        le=1000,
        description="Segments of the band or arc, equally spaced in time, both ends included; "
        f"default {_SEGMENTS}.",
    )
    side: SideName = Field(description="Side of the flight direction that is observed.")
    steering: LawName = Field(
        default="yaw_pitch",
        description="Attitude law: none, yaw (Raney), yaw_pitch_approximate (Fiedler), yaw_pitch "
        "(exact), or pitch_roll (Zhao).",
    )
    incidence_deg: Incidence | None = Field(
        default=None,
        description="Incidence of the boresight on the ellipsoid; aimed at the center of the "
        "targets if absent.",
    )
    look_deg: LookAngle | None = Field(
        default=None, description="Look angle of the boresight, instead of incidence_deg."
    )
    near_incidence_deg: Incidence = Field(
        default=20.0, description="Incidence at the near edge of the strip that can be reached."
    )
    far_incidence_deg: Incidence = Field(
        default=55.0, description="Incidence at the far edge of the strip that can be reached."
    )
    reference: Literal["zero_doppler", "as_observed"] = Field(
        default="zero_doppler",
        description="Moment whose geometry counts: of closest approach, to which images are "
        "focused, or of the beam's center.",
    )
    start: Moment | None = Field(
        default=None,
        description="From when a pass is searched (UTC); the epoch of the orbit if absent.",
    )
    search_days: Number = Field(
        default=11.0, gt=0, le=60, description="How long a pass is searched, in days."
    )
    direction: Literal["either", "ascending", "descending"] = Field(
        default="either", description="Whether the satellite flies northward or southward."
    )
    pass_number: Whole | None = Field(
        default=None,
        ge=1,
        le=10_000,
        description="Which pass that sees a target is taken, counted from 1; the first of those "
        "that see most targets if absent.",
    )
    slope_deg: Annotated[Number, Field(ge=-60, le=60)] = Field(
        default=0.0, description="Slope of the terrain in range, positive towards the radar."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = [key for key in _TARGETS if getattr(self, key) is not None]
        if len(given) != 1:
            raise wrong(
                (given[1],) if given else (),
                f"is given beside {given[0]}" if given else "lacks its targets",
                "keep one of them" if given else f"add one of {', '.join(_TARGETS)}",
            )
        self._check_counts(given[0])
        self._check_boresight(given[0])
        if self.near_incidence_deg >= self.far_incidence_deg:
            raise wrong(
                ("near_incidence_deg",),
                f"must be below far_incidence_deg, {self.far_incidence_deg:g}",
                "check that the two are not swapped",
            )
        self._check_strip()
        return self

    def _check_strip(self) -> None:
        """The boresight is within the strip; that of a look angle waits for the orbit."""
        incidence, near, far = self.incidence_deg, self.near_incidence_deg, self.far_incidence_deg
        if incidence is not None and not near <= incidence <= far:
            raise wrong(
                ("incidence_deg",),
                f"lies outside the strip, near_incidence_deg = {near:g} to far_incidence_deg = "
                f"{far:g}",
                "choose an incidence within, or widen the strip",
            )

    def _check_counts(self, targets: str) -> None:
        for key, homes in _ONLY_FOR.items():
            if getattr(self, key) is not None and targets not in homes:
                raise wrong((key,), f"is only for {' and '.join(homes)}", "remove it")
        if targets in _BANDS:
            first, last = getattr(self, targets)
            if first == last:
                raise wrong((targets,), "begins where it ends", "give two different values")
        if self.argument_of_latitude_deg is not None:
            first, last = self.argument_of_latitude_deg
            if not 0 < last - first <= 360:
                turned = f"write [{first:g}, {last + 360:g}] to pass the ascending node"
                raise wrong(
                    ("argument_of_latitude_deg",),
                    "must grow, by 360 at most",
                    turned if 0 < last + 360 - first <= 360 else "begin the arc nearer to its end",
                )

    def _check_boresight(self, targets: str) -> None:
        given = [key for key in _ANGLES if getattr(self, key) is not None]
        if len(given) > 1:
            raise wrong(("look_deg",), "excludes incidence_deg", "keep one")
        if targets in _BANDS and not given:
            raise wrong(
                (),
                f"lacks incidence_deg or look_deg, without which {targets} is no line on the "
                "ground",
                "add incidence_deg: 35",
            )

    @property
    def count(self) -> int:
        """Number of segments, about."""
        if self.points is not None:
            return len(self.points)
        if self.geojson_file is not None:
            return self.samples or _SAMPLES
        return self.segments or _SEGMENTS
