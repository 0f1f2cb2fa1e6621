"""Builds what a study of steering computes with: km and degrees end here."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from insar import Relation
from insar.observe import (
    Boresight,
    ClaimSpec,
    CompensationRequest,
    Effect,
    FixedIncidence,
    FixedLook,
    Held,
    Law,
    Quantity,
    SelectionRequest,
    SteeringCase,
)

from .claims import ClaimBlock
from .observing import SIDES
from .orbits import build_reference
from .placed import placed_trajectory
from .steering import BoresightBlock, CaseBlock, CompensationBlock, SelectionBlock
from .studies import SteeringStudy


class SteeringSetup(NamedTuple):
    """Everything that a study of kind `steering` computes with.

    Attributes
    ----------
    cases : one or more.
    selections : one for each block; may be empty.
    compensation : None if the study asks for none.
    claims : printed figures; may be empty.
    """

    cases: tuple[SteeringCase, ...]
    selections: tuple[SelectionRequest, ...]
    compensation: CompensationRequest | None
    claims: tuple[ClaimSpec, ...]


def build_steering(study: SteeringStudy) -> SteeringSetup:
    """Build what a study of kind `steering` computes with.

    Parameters
    ----------
    study : the study.

    Raises
    ------
    BuildError
        If an ephemeris does not know the satellite during the revolutions of the study, or
        two-line elements have it decay.
    """
    compensation = study.compensation
    return SteeringSetup(
        cases=tuple(_case(study, index) for index in range(len(study.cases))),
        selections=tuple(_selection(block, study) for block in study.selections),
        compensation=None if compensation is None else _compensation(compensation),
        claims=tuple(_claim(block) for block in study.claims),
    )


def _case(study: SteeringStudy, index: int) -> SteeringCase:
    block: CaseBlock = study.cases[index]
    trajectory = placed_trajectory(block.orbit, ("cases", index, "orbit"))
    period = build_reference(block.orbit).period
    count = study.revolutions * (study.samples - 1) + 1
    times = trajectory.start + np.linspace(0.0, study.revolutions * period, count)
    if block.orbit.source is not None:
        trajectory.earth_fixed(times)  # what is not known is better said now than during the run
    return SteeringCase(
        name=block.name,
        trajectory=trajectory,
        times=times,
        wavelength=study.radar.wavelength_m,
        side=SIDES[block.side or study.side],
        boresight=_boresight(block.boresight or study.boresight),
        laws=tuple(Law(law) for law in block.laws or study.laws),
        swath_offsets=np.radians(study.swath_offsets_deg),
    )


def _boresight(block: BoresightBlock) -> Boresight:
    if block.look_deg is not None:
        return FixedLook(math.radians(block.look_deg))
    return FixedIncidence(math.radians(block.incidence_deg or 0.0))


def _selection(block: SelectionBlock, study: SteeringStudy) -> SelectionRequest:
    low, high = block.altitudes_km
    return SelectionRequest(
        altitudes=1e3 * np.linspace(low, high, block.altitude_samples),
        inclinations=np.radians(block.inclinations_deg),
        held=Held(block.held),
        boresight_angle=math.radians(block.angle_deg),
        wavelength=study.radar.wavelength_m,
        side=SIDES[block.side or study.side],
        eccentricity=block.eccentricity,
        argument_of_perigee=math.radians(block.argument_of_perigee_deg),
        slew_rate=math.radians(block.slew_rate_deg_s),
        swath_offset=math.radians(block.swath_offset_deg),
        samples=block.samples,
    )


def _compensation(block: CompensationBlock) -> CompensationRequest:
    first, last = block.eccentricities
    return CompensationRequest(
        semi_major_axis=block.semi_major_axis,
        inclination=math.radians(block.inclination_deg),
        look_angle=math.radians(block.look_deg),
        side=SIDES[block.side],
        eccentricity=block.eccentricity,
        arguments_of_perigee=tuple(math.radians(a) for a in block.arguments_of_perigee_deg),
        eccentricities=np.linspace(first, last, block.eccentricity_samples),
        samples=block.samples,
    )


def _claim(block: ClaimBlock) -> ClaimSpec:
    meaning = block.meaning
    return ClaimSpec(
        text=block.text,
        printed=block.printed,
        quantity=Quantity(block.quantity),
        value=block.value * meaning.scale,
        tolerance=block.tolerance * meaning.scale,
        relation=Relation(block.relation),
        unit=meaning.unit,
        scale=meaning.scale,
        case=block.case,
        law=None if block.law is None else Law(block.law),
        other_law=None if block.other_law is None else Law(block.other_law),
        rate=_radians(block.rate_deg_s),
        held=None if block.held is None else Held(block.held),
        inclination=_radians(block.inclination_deg),
        effect=None if block.effect is None else Effect(block.effect),
        eccentricity=block.eccentricity,
        argument_of_perigee=_radians(block.argument_of_perigee_deg),
        note=block.note,
    )


def _radians(degrees: float | None) -> float | None:
    return None if degrees is None else math.radians(degrees)
