"""How a spotlight imaging was computed: conventions, equations, and where they come from."""

from __future__ import annotations

from insar.observe.agile.spotlight_results import SpotlightResult

from ..document import Block, Equation, Paragraph, Reference, References, Section, Symbol
from ..wording import plain
from .citations import Citations

HAN = Reference(
    "X. Han et al., “Study on attitude maneuver strategy of spotlight mode of agile SAR "
    "satellite,” Spacecraft Engineering 25(4), 2016.",
    "10.3969/j.issn.1673-8748.2016.04.003",
)
CUMMING = Reference(
    "I. G. Cumming and F. H. Wong, Digital Processing of Synthetic Aperture Radar Data, Artech "
    "House, 2005.",
    "",
)

_TIME = Equation(
    latex=r"T = \frac{k V_g}{\rho_a |f_a|},\qquad "
    r"f_a = \frac{2}{\lambda}\left[\mathbf{u}\cdot\mathbf{a} - \frac{v^2}{r}\right],\qquad "
    r"\rho = \frac{k V_g}{B}",
    typst="T = (k V_g) / (rho_a abs(f_a)), quad f_a = 2 / lambda [bold(u) dot bold(a) - v^2 / r], "
    "quad rho = (k V_g) / B",
)
_CLOSED_FORM = Equation(
    latex=r"s = -\mathbf{b}\cdot\mathbf{p} + "
    r"\sqrt{(\mathbf{b}\cdot\mathbf{p})^2 + |\mathbf{T}|^2 - |\mathbf{p}|^2}",
    typst="s = -bold(b) dot bold(p) + sqrt((bold(b) dot bold(p))^2 + abs(bold(T))^2 - "
    "abs(bold(p))^2)",
)
_SLIDING = Equation(
    latex=r"r_\mathrm{rot} = \frac{r}{1 - A\,\lambda r |f_a|/2v^2}",
    typst='r_"rot" = r / (1 - A lambda r abs(f_a) \\/ 2 v^2)',
)


def spotlight_methods(result: SpotlightResult) -> Section:
    """Methods and references.

    Parameters
    ----------
    result : whose request decides what was used.
    """
    cite = Citations()
    blocks: list[Block] = [
        Paragraph(
            "The middle of the imaging is the moment of zero Doppler of the aim point, found on "
            "the orbit as it is. The aperture time follows from the resolution and the Doppler "
            f"rate {cite(HAN)}, all in Earth-fixed axes:",
        ),
        _TIME,
        Paragraph(
            (
                "with the weighting factor ",
                Symbol("k"),
                ", velocity and acceleration of the satellite, the line of sight u and range ",
                Symbol("r"),
                ". ",
                Symbol("V_g"),
                " is the speed at which the line of zero Doppler sweeps over the ground, across "
                "itself. ",
                Symbol("B"),
                " is taken from the Doppler history itself.",
            )
        ),
        Paragraph(
            "The beam b leaves the body at the phase center p, off the body's Z axis towards −Y. "
            "With the aim point at T in the orbit frame it meets the point at the distance s for "
            "which p + s b is as long as T:"
        ),
        _CLOSED_FORM,
        Paragraph(
            "The attitude is the shortest turn of p + s b onto T. The iteration of the source "
            "reaches the same aim point; both are given. Rates are derivatives of the closed "
            "form and do not depend on the sampling."
        ),
    ]
    if result.request.sliding_factor:
        blocks += _sliding(cite)
    blocks += [*conventions("3-1-2 (yaw, roll, pitch)"), misfit_paragraph(result.orbit_misfit)]
    return Section("methods", "How it was computed", (*blocks, References(tuple(cite.works))))


def _sliding(cite: Citations) -> tuple[Block, ...]:
    return (
        Paragraph(
            f"In sliding spotlight {cite(CUMMING)} the beam turns about a point beyond the aim "
            "point, on the line of sight at zero Doppler; with the sliding factor A, the speed of "
            "the beam over the ground by that of the line of zero Doppler, at the range"
        ),
        _SLIDING,
    )


def conventions(sequence: str) -> tuple[Block, ...]:
    """Axes and signs, which spotlight and video share."""
    return (
        Paragraph(
            "Attitude is that of the body against the orbit frame: X forward and horizontal, Y "
            f"against the orbit normal, Z to the geocentric nadir. Euler angles are in the "
            f"sequence {sequence}; a positive yaw turns the nose to the right, a positive pitch "
            "lifts it. Quaternions are scalar-last and have no jumps of sign. Rates and "
            "accelerations are those of the body, in body axes, against the orbit frame and "
            "against inertial space."
        ),
    )


def misfit_paragraph(misfit: float) -> Paragraph:
    """How smooth the orbit is."""
    return Paragraph(
        "Positions, velocities and accelerations come from a polynomial through the orbit around "
        f"the imaging, which departs from it by at most {plain(misfit)} m."
    )
