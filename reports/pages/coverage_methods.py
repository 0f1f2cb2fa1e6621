"""How coverage was computed: equations, assumptions, and where they come from."""

from __future__ import annotations

from insar.observe.coverage.results import CoverageResult

from ..document import Block, Equation, Paragraph, Reference, References, Section
from .citations import Citations
from .video_methods import LIANG

_WALKER = Reference(
    "J. G. Walker, “Satellite constellations,” J. British Interplanetary Society 37, 559–571, "
    "1984.",
    "",
)

_SIZING = Equation(
    latex=r"\alpha = \beta - \arcsin\frac{R_e\sin\beta}{R_e + h},\qquad "
    r"S = \left\lceil\frac{\pi}{\alpha}\right\rceil,\qquad "
    r"P = \left\lceil\frac{2\pi}{|\Delta\varphi|}\right\rceil,\qquad N = P\,S",
    typst="alpha = beta - arcsin (R_e sin beta) / (R_e + h), quad S = ceil(pi / alpha), quad "
    "P = ceil((2 pi) / abs(Delta phi)), quad N = P S",
)


def coverage_methods(result: CoverageResult) -> Section:
    """Methods and references.

    Parameters
    ----------
    result : which decides what was used.
    """
    cite = Citations()
    blocks: list[Block] = [
        Paragraph(
            f"A Walker pattern T/P/F {cite(_WALKER)} has T satellites in P planes, evenly spread, "
            "and is shifted by F from plane to plane. The orbits are circular and turn under the "
            "secular J2, all alike. A satellite sees a place from an annulus around it, between "
            "the least and the largest incidence, or from one half of it. Places are at their "
            "distance from the center of the WGS84 ellipsoid, with a geocentric vertical: the "
            "incidence is off by up to 0.19°."
        ),
        Paragraph(
            "In the simulation closest approaches and edges of views are roots, found to 10⁻⁹ s. "
            "Longitudes a plane apart see the same, some moments shifted, so those between two "
            "planes stand for all."
        ),
    ]
    if result.shortfall is not None:
        blocks += [
            Paragraph(
                f"The sizing {cite(LIANG)} takes the largest zenith angle β at the target; the "
                "printed P is no whole number and is rounded up here:"
            ),
            _SIZING,
        ]
    blocks.append(
        Paragraph(
            "In the long run a place comes everywhere on the torus of its longitude from the node "
            "and the satellite's argument of latitude. What one satellite sees there is a set, and "
            "the pattern a lattice of its shifts: the part of the torus that they cover is the "
            "cover for every longitude, and cover is continuous if nothing is left over."
        )
    )
    if result.search is not None:
        blocks.append(
            Paragraph(
                "The search proves this by boxes of the torus, divided until one satellite sees "
                "each whole box. A constellation locked to a repeating ground track may keep one "
                "longitude in view with fewer satellites; that is not searched."
            )
        )
    return Section("methods", "How it was computed", (*blocks, References(tuple(cite.works))))
